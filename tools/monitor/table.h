// SPDX-License-Identifier: Apache-2.0
// A live table on a terminal: rows of a name and a value, redrawn in place as often as values arrive, as far as they
// fit in the window. In: events of a stream. Called by recording.cpp.
#pragma once

#include <cstdio>
#include <string>

#include "stdlib/runtime/host/json.h"

namespace rung::monitor {

class Table {
 public:
  explicit Table(std::FILE* out) : out_(out) {}
  ~Table();
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  void show(const host::Json& event);

 private:
  std::FILE* out_;
  size_t lines_ = 0;  // that are on the terminal, of the last event
};

}  // namespace rung::monitor

// SPDX-License-Identifier: Apache-2.0
// The sink of the command line: messages go to stderr, results to stdout, progress to a terminal.
#pragma once

#include <chrono>

#include "tools/driver/sink.h"
#include "tools/rung/options.h"

namespace rung::tool {

class Console : public driver::Sink {
 public:
  void message(std::string_view text) override;
  std::string output(std::string_view text) override;
  void internalError(std::string_view what) override;
  void progress(const char* label, size_t done, size_t all) override;
  void programRuns(bool runs, bool checked) override;

 private:
  const char* label_ = nullptr;
  std::chrono::steady_clock::time_point begin_;
  bool shown_ = false;
};

// Tells whether what goes to this descriptor has colors.
bool useColor(Color choice, int descriptor);

}  // namespace rung::tool

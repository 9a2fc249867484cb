// SPDX-License-Identifier: Apache-2.0
// A sink that keeps what a command writes.
#pragma once

#include <string>

#include "tools/driver/sink.h"

namespace rung {

class TextSink : public driver::Sink {
 public:
  void message(std::string_view text) override { messages += text; }
  std::string output(std::string_view text) override {
    outputs += text;
    return {};
  }

  std::string messages, outputs;
};

}  // namespace rung

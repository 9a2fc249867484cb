// SPDX-License-Identifier: Apache-2.0
// From the options of a command to a program that can be debugged: compiled without optimization, so that each
// statement is one, and loaded. Used by the terminal and by the adapter of editors.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tools/debug/debugger.h"
#include "tools/driver/options.h"
#include "tools/driver/sink.h"
#include "tools/driver/source_watch.h"

namespace rung::debug {

struct TargetOptions {
  driver::ProjectOptions project;
  driver::RunOptions run;
  std::string test;  // its name; empty: the program
  uint32_t history_mb = 64;
};

struct Target {
  std::shared_ptr<driver::ProgramVersion> version;  // the first
  std::unique_ptr<Execution> execution;
  std::unique_ptr<Debugger> debugger;

  // Returns an exit code; what is wrong with the project goes to the sink, what is wrong with the options to `error`.
  int make(const TargetOptions& options, std::function<void(const std::string& text, bool is_error)> print,
           driver::Sink& sink, std::string& error);

 private:
  void watchFiles(const driver::ProjectOptions& project, const driver::RunOptions& run);
};

}  // namespace rung::debug

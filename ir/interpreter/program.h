// SPDX-License-Identifier: Apache-2.0
// A module that the interpreter runs, as its host sees it. It fills the same tables (ir/description.h) that codegen
// prints, has the same memory layout, and leaves code by the same longjmp; so scheduler, image, traces, forcing,
// retained data, faults and tests exist once. One function serves all tasks: `rung_context::entry` says which. In: a
// verified module after its passes. Out: a description whose functions interpret. Called by the tool; the IR may be
// freed then.
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <string>

#include "ir/interpreter/code.h"
#include "ir/ir.h"
#include "rung/module.h"

namespace rung::ir::interpreter {

struct ProgramOptions {
  std::string module_name = "plc";
  bool with_tests = false;
  std::span<const Native> natives;  // sorted by name
  bool coverage = false;            // counters() returns how often each line ran
  bool trace_calls = false;         // rung_host::called is called for each call of a POU
  bool debug = false;               // debug() is there
};

class Program {
 public:
  Program(const Module& module, const ProgramOptions& options);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // Why it cannot be interpreted: `the native function NAME is not part of rung`, `NAME has a body in
  // C++`; empty: it can.
  const std::string& refusal() const;
  const rung_module& description() const;
  DebugCode* debug() const;  // null: not asked for
  const std::deque<Counter>& counters() const;
  // Their values as bytes, and those of another process that ran this program.
  std::string counts() const;
  void addCounts(std::string_view counts);

  // What runs in this thread, or ran last: for a host that is asked for something by an activation. Null: nothing.
  static const Machine* running();
  // For a signal while this thread runs a program: the current site, or RUNG_NONE. `details`: ucontext_t.
  static uint32_t siteOfCrash(const rung_context* ctx, const void* details);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rung::ir::interpreter

// SPDX-License-Identifier: Apache-2.0
// The code of a body tells this about its run: the source location of each statement, how often lines and branches run,
// the steps that a limit counts, which POU is called. In: statements and calls as they are translated. Out: entries of
// Code, and instructions for what was asked for. The base of BodyTranslator (translate.h).
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "ir/interpreter/frame_code.h"

namespace rung::ir::interpreter {

struct TranslateOptions {
  std::span<const Native> natives;  // sorted by name
  bool bounded = false;             // calls of library functions are steps, too
  bool coverage = false;            // count how often lines run (Code::counters)
  bool trace_calls = false;         // report each call of a POU to the host
  bool debug = false;               // record where statements and variables are (debug.h)
};

class RecordedCode : protected FrameCode {
 protected:
  RecordedCode(const Module& module, StringPool& pool, const TranslateOptions& options, Code& code)
      : FrameCode(module, pool, code), options_(options) {}

  void recordLocation(Loc loc);
  void recordPoint(Loc loc);
  uint32_t networkOf(Loc loc);
  uint32_t lastNetwork(Loc body, Loc loc);
  const std::vector<uint32_t>& networksOf(FileId file);
  void count(Loc loc, const char* function);
  bool countsBranches(Loc loc) const;
  void countBranch(Loc loc, uint32_t branch);
  void countStep();
  void traceCall(BodyId callee, const Address* self);

  const TranslateOptions& options_;

 private:
  Loc recorded_loc_;  // the last one of code_.line_table
  Loc point_loc_;     // and of code_.points
  uint32_t point_body_ = 0;
  std::unordered_map<uint32_t, std::vector<uint32_t>> networks_;  // by file; offsets of locations
};

}  // namespace rung::ir::interpreter

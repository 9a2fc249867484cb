// SPDX-License-Identifier: Apache-2.0
// What a debugger sees of a program that the interpreter runs: its bodies and their variables, the points at which it
// can stop (each statement of the source), the calls that lead to the present one, and a callback at points that are
// armed. A point costs nothing while it is not armed: arming puts another function into the instruction that begins it.
// In: code translated with TranslateOptions::debug. Out: tables that refer neither to the IR nor to the tree. Made by
// Program.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "ir/interpreter/frame_code.h"

namespace rung::ir::interpreter {

struct DebugLocal {
  const char* name;
  uint32_t type;    // of the module
  uint32_t offset;  // in the frame; of the address, where the variable is elsewhere
  bool by_reference;
  LocalKind kind;
};

struct DebugBody {
  const char *name, *file;  // as messages have them: `Belt.run`
  uint32_t line, column;
  uint32_t first, end;  // instructions
  uint32_t self;        // the type of the instance; RUNG_NONE: none
  bool is_library;
  bool is_shown;  // a POU of the source, not code that Rung makes around them
  std::vector<DebugLocal> locals;
};

struct DebugPoint {
  uint32_t insn, body, line, column;
  uint32_t network;  // in which network of the body, as a number that only tells them apart; 0: in none
  const char* file;
};

struct DebugFrame {
  uint32_t body;
  const char* file;
  uint32_t line, column;  // of the statement that runs, or of the call
  uint8_t *fp, *self;
};

class DebugCode {
 public:
  // Called in the thread of the activation: at an armed point, before its statement, and when a check of the
  // interpreted code raises a fault, which a __TRY may handle. Either may leave the activation by rung_raise.
  class Listener {
   public:
    virtual void atPoint(uint32_t point, const Machine& machine) = 0;
    virtual void atFault(const Machine& machine, uint8_t kind, uint32_t site) = 0;

   protected:
    ~Listener() = default;
  };

  DebugCode(const Module& module, const Description& description, Code& code);
  DebugCode(const DebugCode&) = delete;
  DebugCode& operator=(const DebugCode&) = delete;

  void listen(Listener* to) { listener_ = to; }
  const std::vector<DebugPoint>& points() const { return points_; }
  const std::vector<DebugBody>& bodies() const { return bodies_; }

  // While no code runs, or from the listener.
  void arm(uint32_t point);
  void armAll();
  // All, but the listener is called only at these points and where one of the variables has another value.
  struct Watched {
    const uint8_t* at;
    uint32_t size;  // at most 8
    uint8_t value[8];
  };
  void armForChanges(std::vector<Watched> watched, const std::vector<uint32_t>& points);
  void takeValues();  // of the variables as they are now
  void disarmAll();
  bool areAllArmed() const { return all_armed_; }

  // The calls, the innermost first, while the listener is called. `point`: where the first is; RUNG_NONE: at the
  // instruction that runs.
  std::vector<DebugFrame> frames(const Machine& machine, uint32_t point) const;
  uint32_t instruction(const Insn* ip) const { return static_cast<uint32_t>(ip - code_.insns.data()); }
  // The point of the statement that an instruction is part of; RUNG_NONE: none.
  uint32_t pointOf(uint32_t instruction) const;
  // The depth of the calls as a number that grows with it, and is the same at each point of a call.
  static size_t depth(const Machine& machine) { return static_cast<size_t>(machine.fp - machine.base); }

  // From any thread: a loop that runs arms all points, so that the next one is noticed.
  void interrupt() { interrupted_.store(true, std::memory_order_relaxed); }
  bool isInterrupted() const { return interrupted_.load(std::memory_order_relaxed); }
  void forgetInterrupt() { interrupted_.store(false, std::memory_order_relaxed); }

  // From instructions.
  bool isQuiet(const Insn* ip) const {
    if (watched_.empty() || isInterrupted() || asks_[static_cast<size_t>(ip - code_.insns.data())]) return false;
    for (const Watched& one : watched_)
      if (memcmp(one.at, one.value, one.size) != 0) return false;
    return true;
  }
  void stopAt(const Insn* ip, const Machine& machine) const {
    listener_->atPoint(point_of_[static_cast<size_t>(ip - code_.insns.data())], machine);
  }
  Handler original(const Insn* ip) const { return originals_[static_cast<size_t>(ip - code_.insns.data())]; }
  void fault(const Machine& machine, uint8_t kind, uint32_t site) const {
    if (listener_ != nullptr) listener_->atFault(machine, kind, site);
  }
  // The instruction of a check, whose site counts from 0, or a little before it.
  const Insn* insnOfSite(uint32_t site) const { return &code_.insns[code_.site_insns[site]]; }

 private:
  const DebugBody* bodyAt(const Insn* ip) const;
  DebugFrame frameAt(const Insn* ip, uint8_t* fp, uint8_t* self) const;

  Code& code_;
  Listener* listener_ = nullptr;
  std::vector<DebugPoint> points_;
  std::vector<DebugBody> bodies_;       // by their first instruction
  std::vector<uint32_t> point_of_;      // by instruction
  std::vector<Handler> originals_;      // by instruction
  std::vector<uint32_t> armed_points_;  // unless all are
  std::vector<Watched> watched_;
  std::vector<uint8_t> asks_;  // by instruction: while variables are watched
  bool all_armed_ = false;
  std::atomic<bool> interrupted_{false};
};

}  // namespace rung::ir::interpreter

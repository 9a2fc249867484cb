// SPDX-License-Identifier: Apache-2.0
// A program under control: it runs until a judge says stop, and returns to any moment of its past. In: an interpreted
// program with debug information, and the options of `rung run`. Out: outcomes, and the frames of where it is. The
// program has a thread of its own that is parked, with its frames, while the client does anything else; so exactly one
// of the two works at a time.
//
// The past is checkpoints of the session's state and the log of its services: a moment is reached by restoring the
// checkpoint before it and running again, which has no effect outside. A moment is named by what is the same in each
// such run: the unit (an activation, or what lies between activations), the steps that were counted in it, and the
// point. Since each iteration of a loop, label and call counts a step, no point is passed twice with the same count.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "frontend/source/dialect.h"
#include "ir/interpreter/debug.h"
#include "rung/host.h"
#include "stdlib/runtime/host/condition.h"
#include "stdlib/runtime/host/inputs.h"
#include "stdlib/runtime/host/retain.h"
#include "stdlib/runtime/host/session.h"
#include "stdlib/runtime/host/trace.h"
#include "tools/debug/service_log.h"
#include "tools/driver/program_version.h"

namespace rung::debug {

using ir::interpreter::DebugCode;
using ir::interpreter::DebugFrame;
using ir::interpreter::DebugPoint;
using ir::interpreter::Machine;

// In Moment::point: an instruction, where the program is not at a point but at a fault or an assertion.
inline constexpr uint32_t kAtInstruction = 0x80000000u;

struct Moment {
  int64_t unit = 0, steps = 0;
  uint32_t point = RUNG_NONE;  // none: before the unit
  friend bool operator==(const Moment&, const Moment&) = default;
};

struct ExecutionOptions {
  host::RunOptions run;
  std::string test;                   // the name of a test; empty: the program
  Dialect dialect = kDefaultDialect;  // of expressions
  size_t history_bytes = size_t{64} << 20;
  // What the program prints; `is_error`: on stderr.
  std::function<void(const std::string& text, bool is_error)> print;
};

// What the program did.
struct Outcome {
  enum Kind : uint8_t {
    Stopped,      // the judge said so
    Interrupted,  // interrupt()
    Reached,      // the moment of goTo()
    Ended,        // for good: `exit_code`
  } kind = Ended;
  int exit_code = 0;
};

// Decides where the program stops; called in its thread.
class Judge {
 public:
  virtual bool stopsAt(const Moment&, const Machine&) { return false; }
  // `is_handled`: a __TRY handles it.
  virtual bool stopsAtFault(const Moment&, bool is_handled) {
    (void)is_handled;
    return false;
  }
  virtual bool stopsAtAssertion(const Moment&) { return false; }
  // Before the first activation of a cycle.
  virtual bool stopsAtCycle(const Moment&, int64_t cycle) {
    (void)cycle;
    return false;
  }

 protected:
  ~Judge() = default;
};

class Execution : DebugCode::Listener {
 public:
  Execution(std::shared_ptr<driver::ProgramVersion> version, ExecutionOptions options);
  ~Execution();
  Execution(const Execution&) = delete;
  Execution& operator=(const Execution&) = delete;

  // Loads what the options name. False: `error`.
  bool load(std::string& error);

  // ---- forward; nothing runs when they return
  // At which points the judge is asked.
  struct Armed {
    bool all = false;
    std::vector<uint32_t> points;
    // Of `all`: only at the points, and where one of these has another value. Empty: at each.
    std::vector<DebugCode::Watched> watched;
  };
  Outcome run(Judge& judge, const Armed& armed);
  // The program has the turn: only the judge may ask.
  bool isRunning() const { return is_running_.load(std::memory_order_relaxed); }
  // From any thread: run() returns soon.
  void interrupt();

  // ---- the past
  Moment now() const { return now_; }
  // Goes to a moment that the program has been at; no judge is asked.
  void goTo(const Moment& moment);
  // The same of the begin of a cycle, which may be one that has not run yet. False: the program has ended before it, or
  // it was so long ago that it is forgotten.
  bool goToCycle(int64_t cycle);
  // Runs on to a moment that the program has been at, and asks the judge; its answers do not matter.
  void replay(const Moment& to, Judge& judge, const Armed& armed);
  // The last checkpoint at or before a unit, which is one of the history.
  Moment checkpointFor(int64_t unit) const;
  // Where the history begins: the first unit, unless there was too much of it.
  int64_t firstUnit() const { return past_.checkpoints.front().unit; }
  // From the begin, as another run: there is no past any more.
  void restart();
  // Changes the state of the program, now and when this moment is repeated. What came after it did not happen.
  void edit(std::function<void()> change);

  // ---- another version of the program
  // Before a cycle; an error message, or an empty string, and then `report` says what becomes of the variables. The
  // history begins here.
  std::string change(std::shared_ptr<driver::ProgramVersion> next, std::string& report);
  bool isBeforeCycle() const { return place_.phase == Phase::Cycles && !place_.is_in_cycle && !isInside(); }

  // ---- where it is
  bool isInside() const { return machine_ != nullptr; }  // an activation
  size_t depth() const { return DebugCode::depth(*machine_); }
  // The calls, the innermost first; none between two activations.
  std::vector<DebugFrame> frames();
  int64_t cycle() const { return place_.cycle; }
  bool hasEnded() const { return place_.phase == Phase::Over; }
  std::string faultText();  // of the fault at which it is
  uint64_t memoryHash();    // of all variables

  host::Session& session() { return *session_; }
  DebugCode& code() const { return *version_->program->debug(); }
  const rung_module& module() const { return *version_->module; }
  const host::ShownPaths& paths() const { return options_.run.paths; }
  const ExecutionOptions& options() const { return options_; }
  // How much the past takes.
  size_t historyBytes() const { return past_.checkpoint_bytes + log_.bytes(); }
  bool hasDiverged() const { return log_.hasDiverged(); }

 private:
  // What runs next.
  enum class Phase : uint8_t { Init, Begin, Cycles, TestEnd, End, Over };
  struct Place {
    Phase phase = Phase::Init;
    bool is_in_cycle = false;
    bool has_failed = false;  // an assertion
    int64_t cycle = 0;
  };
  struct Checkpoint {
    int64_t unit = 0;
    size_t log = 0;
    Place place;
    host::SessionState state;  // none: of Phase::Init
  };
  struct Edit {
    Moment at;
    std::function<void()> change;
  };

  void atPoint(uint32_t point, const Machine& machine) override;
  void atFault(const Machine& machine, uint8_t kind, uint32_t site) override;
  static void onFaulted(void* data, const rung_context* context);
  void onAssertion(const rung_assertion& assertion, bool passed, const char* expected, const char* actual);
  void onMessage(uint8_t severity, const char* text);

  void work();
  void park(Outcome outcome);
  Outcome resume();
  void runOn();
  bool runUnit();
  bool runCycles(host::Ending& ending);
  void finish(const host::Ending& ending);
  bool parksAtBorder();
  void applyEdits(const Moment& at);
  bool reaches(const Moment& at);
  void parkAt(const Moment& at, const Machine& machine, Outcome outcome);
  Moment instructionOf(const Machine& machine) const;
  void arm();
  void keepCheckpoint();
  void thinOut();
  void forgetOldest();
  void forgetPast();
  void restore(const Checkpoint& checkpoint);
  const Checkpoint& findCheckpoint(int64_t unit) const;
  void leaveActivation();
  static int64_t stepsOf(const Machine& machine);

  std::shared_ptr<driver::ProgramVersion> version_;
  const ExecutionOptions options_;
  ServiceLog log_;
  std::unique_ptr<host::Session> session_;
  std::optional<host::Inputs> inputs_;
  std::optional<host::Trace> trace_;
  std::optional<host::Condition> stop_on_;
  std::optional<host::Retain> retain_;
  int64_t cycles_ = 0;
  bool is_test_ = false;
  std::vector<std::string> reported_;

  // Where the program is.
  Moment now_;
  Place place_;
  int exit_code_ = 0;
  const Machine* machine_ = nullptr;  // while parked in an activation
  bool is_asked_ = false;             // at the border where it is

  struct Past {
    std::deque<Checkpoint> checkpoints;
    size_t checkpoint_bytes = 0;
    int64_t next_checkpoint_ns = 0;
    int64_t last_unit = -1;  // that has begun at some time
    int64_t traced_cycles = 0;
    std::vector<Edit> edits;  // in the order of their moments
    size_t next_edit = 0;     // the first that is not done yet
  } past_;

  // What it is to do.
  struct Order {
    Judge* judge = nullptr;  // null: none is asked
    Armed armed;
    std::vector<bool> is_armed;  // by point
    std::optional<Moment> goal;  // nothing else stops it then
    int64_t goal_cycle = -1;
    bool hasGoal() const { return goal || goal_cycle >= 0; }
  } order_;
  bool leaves_ = false;  // the activation
  bool quits_ = false;
  std::atomic<bool> interrupted_{false};

  // The hand-over.
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable handed_over_;
  enum class Turn : uint8_t { Client, Program } turn_ = Turn::Client;
  std::atomic<bool> is_running_{false};
  Outcome outcome_;
};

}  // namespace rung::debug

// SPDX-License-Identifier: Apache-2.0
// The debugger as its users know it: breakpoints, steps forward and back, watches. In: an execution, and what a user
// asks, in files and lines of the source. Out: why the program stopped, and everything about where it is. Without a
// protocol and a terminal: `rung dap` and `rung debug` are both on top of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/debug/execution.h"
#include "tools/debug/expressions.h"
#include "tools/debug/values.h"

namespace rung::debug {

// What a user wants of a breakpoint, wherever it is.
struct BreakpointWish {
  uint32_t line = 0, column = 0;  // column 0: the whole line
  std::string name;               // of a POU, instead of a line; or the path of a variable
  std::string condition;          // ST
  std::string hits;               // `5`, `>= 3`, `% 10`
  std::string log;                // a text with {expressions} that is printed instead of a stop
};

struct Breakpoint {
  uint32_t id = 0;
  BreakpointWish wish;
  bool is_bound = false;
  std::string file;  // as the module has it
  uint32_t line = 0, column = 0;
  std::string problem;  // why it is not bound
  // Of its run.
  std::vector<uint32_t> points;
  uint64_t count = 0;
  Variable watched;  // of a data breakpoint
  std::vector<uint8_t> last_value;
};

struct Stop {
  enum Reason : uint8_t {
    Entry,
    Breakpoint,
    FunctionBreakpoint,
    DataBreakpoint,
    Step,
    Pause,
    Exception,
    Goto,
    HistoryBegins,
    Ended
  } reason = Ended;
  std::string text;           // more about it
  std::vector<uint32_t> ids;  // of breakpoints
  int exit_code = 0;
};

enum class StepKind : uint8_t { Into, Over, Out, Cycle, Activation };
enum class Granularity : uint8_t { Statement, Line, Network };

class Debugger : Judge {
 public:
  explicit Debugger(Execution& execution);
  // Asked when the program is to run: another version of it, or null, and what is wrong with it.
  using NewVersion = std::function<std::shared_ptr<driver::ProgramVersion>(std::string& problem)>;
  void newVersion(NewVersion make) { new_version_ = std::move(make); }

  // ---- breakpoints; each call replaces those of its kind, those of a file that of this file
  const std::vector<Breakpoint>& setBreakpoints(const std::string& file, std::vector<BreakpointWish> wishes);
  void forgetLines() { by_file_.clear(); }  // all breakpoints of files
  const std::vector<Breakpoint>& setFunctionBreakpoints(std::vector<BreakpointWish> wishes);
  const std::vector<Breakpoint>& setDataBreakpoints(std::vector<BreakpointWish> wishes);
  struct Exceptions {
    bool faults = false, uncaught = true, assertions = false;
  };
  void setExceptions(const Exceptions& exceptions) { exceptions_ = exceptions; }
  // Where breakpoints can be in these lines of a file.
  std::vector<DebugPoint> possiblePoints(const std::string& file, uint32_t first, uint32_t last) const;

  // ---- running; the program is parked when they return, unless it was interrupted with pauses() false
  Stop resume();
  Stop step(StepKind kind, Granularity granularity, uint32_t task = 0);  // task: of Activation, from 1
  Stop runTo(const std::string& file, uint32_t line);
  Stop stepBack(Granularity granularity);
  Stop reverse();
  Stop lastWrite(const std::string& path);
  Stop goToCycle(int64_t cycle);
  // The one that was interrupted goes on.
  Stop goOn();

  // ---- where it is
  std::vector<DebugFrame>& frames();       // the innermost first
  uint32_t task() const { return task_; }  // from 1; 0: between activations
  Evaluated evaluate(std::string_view expression, const DebugFrame* frame);
  // Sets a variable; returns an error message, or an empty string.
  std::string set(const std::string& expression, const std::string& value, const DebugFrame* frame);
  std::string setPlace(const Variable& place, const std::string& value);
  std::string force(const std::string& path, const std::string& value);
  std::string unforce(const std::string& path);

  Execution& execution() { return execution_; }
  Values& values() { return values_; }
  // The path of a file as messages show it, and the file of the module that has a path; empty: none.
  std::string shownFile(const char* file) const;
  std::string fileOf(const std::string& path) const;

 private:
  struct StepState {
    bool is_active = false;
    StepKind kind = StepKind::Over;
    Granularity granularity = Granularity::Statement;
    size_t depth = 0;
    uint32_t point = RUNG_NONE, task = 0;
    int64_t unit = 0, cycle = 0;
  };

  bool stopsAt(const Moment& at, const Machine& machine) override;
  bool stopsAtFault(const Moment& at, bool is_handled) override;
  bool stopsAtAssertion(const Moment& at) override;

  void placeBreakpoints();
  void attendChange();
  void bindAgain();
  Stop run();
  Stop stopOf(const Outcome& outcome);
  void bind(Breakpoint& breakpoint, const std::string& file);
  void bindFunction(Breakpoint& breakpoint);
  void bindData(Breakpoint& breakpoint);
  void rememberWatched();
  bool hitsBreakpoint(uint32_t point, const Machine& machine);
  bool hits(Breakpoint& breakpoint, uint32_t point, const Machine& machine);
  bool hasChanged(Breakpoint& breakpoint, std::string* text);
  void log(const Breakpoint& breakpoint, const Machine& machine, uint32_t point);
  bool completesStep(uint32_t point, const Machine& machine) const;
  bool isSamePart(Granularity granularity, uint32_t one, uint32_t other) const;
  Execution::Armed armed() const;
  template <class Predicate>
  bool searchBack(const Execution::Armed& armed, Predicate predicate);
  bool lookBeforeCycle(const std::function<void()>& look);
  void beginStep(StepKind kind, Granularity granularity);
  void standAt();
  uint32_t pointOf(const Moment& moment) const;
  std::string obey(const host::Command& command);

  Execution& execution_;
  Values values_;
  Expressions expressions_;
  std::map<std::string, std::vector<Breakpoint>> by_file_;
  std::vector<Breakpoint> functions_, data_;
  std::vector<std::vector<Breakpoint*>> at_point_;
  Exceptions exceptions_;
  uint32_t next_id_ = 1;
  StepState step_;
  NewVersion new_version_;
  Stop found_;  // by the judge
  std::vector<DebugFrame> frames_;
  bool has_frames_ = false;
  uint32_t task_ = 0;
  size_t depth_ = 0;
  std::vector<uint32_t> run_to_points_;
};

}  // namespace rung::debug

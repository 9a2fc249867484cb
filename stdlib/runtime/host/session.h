// SPDX-License-Identifier: Apache-2.0
// A program that is loaded and can run: its module, memory, tasks, clock, devices and faults. In: a module, and what a
// user asks. Out: values; it prints nothing and ends no process. Driven by `rung run` (run.cpp), `rung test`
// (test.cpp), and whatever else runs, watches or changes a program.
//
//     Session session(module, options, hooks);
//     session.load(error);               // devices and tasks, as the project describes them
//     session.init();                    // initial values
//     session.begin();                   // time begins
//     while (session.cycle().isComplete()) session.completeCycle();
//     session.end();                     // FB_Exit
//
// Virtual time goes on in cycle() and activate(); in real time runInRealTime() runs the tasks as threads. All other
// functions are called where no activation runs, from one thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "change.h"
#include "channels.h"
#include "commands.h"
#include "controller.h"
#include "files.h"
#include "numerical_control.h"
#include "program.h"
#include "realtime.h"
#include "served_image.h"
#include "simulated_channels.h"

namespace rung::host {

struct RunOptions;

struct SessionOptions {
  int64_t interval_ns = 10'000'000;  // of cyclic tasks without one, and of a cycle when there is no cyclic task
  int64_t max_steps = 0;             // of an activation; 0: any
  bool others_go_on = false;         // a fault stops its task alone
  bool realtime = false;
  // Of a test: no files, sockets or machine outside; the network is simulated.
  bool is_isolated = false;
  std::string files_root = ".";
  SerialDevices serial;
  std::vector<std::string> drivers;  // PATH[=ARGUMENT]

  static SessionOptions of(const RunOptions& run);
};

// What the program says while it runs, in the thread of the task. Each may be empty.
struct SessionHooks {
  std::function<void(uint8_t severity, const char* text)> message;  // to its operator; a rung_severity
  std::function<void(const rung_assertion& assertion, bool passed, const char* expected, const char* actual)> assertion;
  std::function<void(const char* pou, const void* instance)> called;  // of interpreted modules that report calls
  // May put others in the place of the services for files and channels, before anything runs.
  std::function<void(rung_host& host)> serving;
  // Another version has taken over; no activation runs. All that refers to module(), memory(), symbols(), tasks() and
  // forces() of the one before has to refer to those of this one.
  std::function<void()> changed;
};

// The answer to a command.
struct Answer {
  bool goes_on = true;   // false: the run ends
  std::string text;      // what was asked for: about the run
  std::string values;    // and values of variables
  std::string error;     // what the user asked cannot be done, and nothing was
  bool is_busy = false;  // because some task is always within an activation
  std::string warning;   // why nothing was done
  Ending ending;         // of activations that the command began
  bool hangs = false;    // in real time: a task did not end its activation
};

// Everything that decides how the program goes on: its memory, time and tasks, the devices and the numerical control
// that the host simulates, forces, and the simulated network of a test. It is restored in the session that saved it.
// Not in it is what others hold, which restoring leaves as it is: the content and position of files, connections and
// bytes on their way, messages that were printed, values of devices that a driver serves, and the time of the machine.
using SessionState = std::vector<uint8_t>;

class Session {
 public:
  // The module runs here (refusal) and outlives the session.
  Session(const rung_module& module, const SessionOptions& options, SessionHooks hooks);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Loads devices, simulates the modules that none serves, and finds triggers. False: `error` says what is wrong. Not
  // for a test.
  bool load(std::string& error);
  // The program is a test of the module, instead of its tasks.
  void chooseTest(uint32_t number) { test_ = number; }

  // Everything as at power on, and all variables with their initial values.
  Ending init();
  // Time begins at that of the context; devices give the first inputs; a test sets itself up.
  Ending begin();
  // The rest of the cycle in virtual time. Nothing while stopped.
  Ending cycle();
  // The next activation of the cycle. False: it is complete, or `ending` says why it is not.
  bool activate(Ending& ending);
  // The cycle counts, and the next one begins with the next call.
  void completeCycle();
  // A command asked for one cycle; after it the program is stopped again.
  bool isSingleCycle() const { return is_single_cycle_; }
  void stopAfterSingleCycle();
  // Of a test: the variable `done` is TRUE, or there is none.
  bool isDone() const;
  // A test takes down what it set up; then all objects end (FB_Exit). Outputs stay as they are.
  Ending endTest();
  Ending end();

  // Runs until a signal, the last row, a command or a fault ends it. Not for a test.
  RealtimeResult runInRealTime(const RealtimeOptions& options, const RealtimeHooks& hooks);
  void endThreads() { threads_->end(); }  // from a hook
  // Where interrupts of simulated devices start tasks in real time: from the hook `idle`.
  void raiseInterrupts();

  // From the hook `idle` in real time; tasks rest meanwhile.
  Answer obey(const Command& command);
  // Calls `act` where no activation runs. False: there was no such moment within a second.
  bool between(const std::function<void()>& act);
  // Realtime::beAtEase
  void beAtEase() {
    if (threads_) threads_->beAtEase();
  }
  bool isStopped() const { return is_stopped_; }
  // All outputs get their safe values.
  void makeOutputsSafe() { program_->tasks.makeOutputsSafe(nowNs()); }
  void markStopped() { controller_.diagnosis().stopped = 1; }

  // Puts another version in the place of this one, where no activation runs: in virtual time between two cycles, in
  // real time from the hook `idle`. `rollback_cycles`: how long goBack() can undo it; 0: not. A report with an error:
  // nothing has changed.
  ChangeReport change(const rung_module& next_module, std::shared_ptr<const void> keeper, bool is_only_asked,
                      int64_t rollback_cycles);
  // After a fault of a version that took over a few cycles ago: the one before goes on with its values of then. False:
  // there is none.
  bool goBack();

  SessionState save();
  void restore(const SessionState& state);

  // What runs has run before: it does not wait for the clock, and channels do nothing.
  void setReplaying(bool is_replaying) { is_replaying_ = is_replaying; }

  int64_t cyclesDone() const { return (rows_done_ + rows_per_cycle_ - 1) / rows_per_cycle_; }
  // A cycle is one row, the period of the fastest cyclic task; of an NCT program the period of T_PLC.
  int64_t rowsPerCycle() const { return rows_per_cycle_; }
  int64_t cycleNs() const { return rows_per_cycle_ * program_->tasks.rowNs(); }
  int64_t beginNs() const { return begin_ns_; }
  // The program's time from the begin to a row.
  int64_t rowTimeNs(int64_t row) const { return base_ns_ + row * program_->tasks.rowNs() - begin_ns_; }
  // The program's time at which the next row begins.
  int64_t nextRowNs() const { return base_ns_ + rows_done_ * program_->tasks.rowNs(); }
  // The program's time now.
  int64_t nowNs() const { return threads_ ? threads_->programNs() : program_->memory.context().now_ns; }
  // No activation is between its begin and its end.
  bool isIdle() const { return program_->schedule.isIdle(); }

  // Until another version of the program takes over.
  const LoadedModule& module() const { return program_->module; }
  rung_context& context() { return program_->memory.context(); }
  Memory& memory() { return program_->memory; }
  Symbols& symbols() { return program_->symbols; }
  Tasks& tasks() { return program_->tasks; }
  const Forces& forces() const { return program_->forces; }
  const Drivers& drivers() const { return drivers_; }

 private:
  void serve();
  void switchOn();
  Ending reset(rung_start kind);
  void stop();
  void resume();
  bool cycleOnce();
  bool raise(const std::string& event);
  void obeyAtRest(const Command& command, Answer& answer);
  Answer obeyForValues(const Command& command);
  bool findAll(const Command& command, std::vector<Variable>& variables, std::string& error) const;
  std::string get(const Command& command, std::string& values) const;
  std::string set(const Command& command);
  std::string force(const Command& command);
  std::string unforce(const Command& command);
  Program::Around around() { return {drivers_, hsio_, options_.interval_ns, options_.others_go_on}; }
  void countRows();
  int64_t cyclesNow() const { return threads_ ? (rows_done_ + threads_->rowsDone()) / rows_per_cycle_ : cycle_; }
  bool prepare(Program& next, ChangeReport& report);
  std::vector<std::string> takeOver(std::unique_ptr<Program> next);
  void endLeft();
  // Another version that is ready to take over.
  struct Next {
    std::unique_ptr<Program> program;
    std::unique_ptr<Realtime> threads;  // in real time
    std::vector<uint8_t> saved;         // memory of this version
  };
  void changeAtRest(Change& change, Next& next, bool is_only_asked, int64_t rollback_cycles, ChangeReport& outcome);
  void saveMemory(std::vector<uint8_t>& to);
  Ending testCycle();
  Ending call(void (*function)(rung_context*));  // of the module; null: it has none
  Ending endingOf(uint8_t fault) {
    return fault == RUNG_FAULT_NONE ? Ending{} : Ending::faulted(program_->memory.context());
  }
  void keepPace();
  int64_t unsetClock() const;
  void transfer(StateArchive& archive);

  // The services of rung_host.
  static int64_t onClock(void* data);
  static bool onSetClock(void* data, int64_t ns);
  static bool onNetwork(void* data, uint32_t port, rung_network* addresses);
  static bool onSetNetwork(void* data, uint32_t port, const rung_network* addresses);
  static void onMessage(void* data, uint8_t severity, const char* text);
  static void onAssertion(void* data, const rung_assertion* assertion, bool passed, const char* expected,
                          const char* actual);
  static void onCall(void* data, const char* pou, const void* instance);

  const SessionOptions options_;
  const SessionHooks hooks_;
  Drivers drivers_;
  Hsio hsio_;
  std::unique_ptr<Program> program_;
  Controller controller_;
  ServedImage served_;
  NumericalControl control_;
  std::optional<Files> files_;
  std::optional<Channels> channels_;
  std::optional<SimulatedChannels> simulated_channels_;
  std::unique_ptr<Realtime> threads_;  // since the run in real time began
  rung_host host_{};
  char machine_name_[256] = {}, machine_address_[32] = {};

  uint32_t test_ = RUNG_NONE;
  int64_t cycle_ = 0;           // the number of the cycle that runs, or runs next
  int64_t row_ = 0;             // the same of the row
  int64_t rows_done_ = 0;       // of complete cycles
  int64_t rows_per_cycle_ = 1;  // the last of them is the cycle's time; cycle 0 has one
  int64_t begin_ns_ = 0;        // the program's time at the begin
  int64_t base_ns_ = 0;         // and at row 0; another one when a version with other rows has taken over
  int64_t pace_ns_ = 0;         // in virtual time: the clock at row 0, while a channel is open
  bool is_stopped_ = false;     // by a command
  bool is_single_cycle_ = false;
  bool is_replaying_ = false;

  // The version before, while goBack() can return to it.
  struct Before {
    std::unique_ptr<Program> program;
    std::vector<uint8_t> memory;
    int64_t last_cycle = 0;
  };
  std::optional<Before> before_;
  // In real time: programs and threads that other versions have followed, until the threads have ended.
  std::vector<std::unique_ptr<Program>> left_programs_;
  std::vector<std::unique_ptr<Realtime>> left_threads_;
};

}  // namespace rung::host

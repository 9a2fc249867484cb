// SPDX-License-Identifier: Apache-2.0
// `rung dap`: the Debug Adapter Protocol for programs that the interpreter runs. In: requests of an editor. Out:
// responses and events; whatever is sent, the adapter goes on. A request that makes the program run is answered first;
// while the program runs, other requests interrupt it for a moment.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/dap/attached.h"
#include "tools/dap/connection.h"
#include "tools/debug/target.h"

namespace rung::dap {

// The words of a command line as options of a project and of `rung run`; an error message, or an empty string.
using ParseArguments = std::function<std::string(const std::vector<std::string>& words, debug::TargetOptions& options)>;

class Adapter {
 public:
  Adapter(Connection& connection, ParseArguments parse);
  ~Adapter();

  // Serves until the client is gone or disconnects. Returns the exit code of the program, 0 where it did not end.
  int serve();

 private:
  using Answer = void (Adapter::*)(const Json& request, const Json& arguments);
  struct Request {
    const char* name;
    Answer answer;
    enum Needs : uint8_t { Nothing, Program, Stopped } needs;
  };
  static const Request kRequests[];

  void take(const Received& received);
  void runProgram();
  void report(const debug::Stop& stop);
  void run(const Json& request, Json body, std::function<debug::Stop()> how);

  // ---- the session
  void initialize(const Json& request, const Json& arguments);
  void launch(const Json& request, const Json& arguments);
  void attach(const Json& request, const Json& arguments);
  void configurationDone(const Json& request, const Json& arguments);
  void disconnect(const Json& request, const Json& arguments);
  void terminate(const Json& request, const Json& arguments);
  void restart(const Json& request, const Json& arguments);
  void cancel(const Json& request, const Json& arguments);

  // ---- breakpoints (breakpoints.cpp)
  void setBreakpoints(const Json& request, const Json& arguments);
  void setFunctionBreakpoints(const Json& request, const Json& arguments);
  void setExceptionBreakpoints(const Json& request, const Json& arguments);
  void dataBreakpointInfo(const Json& request, const Json& arguments);
  void setDataBreakpoints(const Json& request, const Json& arguments);
  void breakpointLocations(const Json& request, const Json& arguments);
  Json breakpointsOf(const std::vector<debug::Breakpoint>& all);
  debug::BreakpointWish wishOf(const Json& breakpoint) const;

  // ---- running
  void threads(const Json& request, const Json& arguments);
  void resume(const Json& request, const Json& arguments);
  void next(const Json& request, const Json& arguments);
  void stepIn(const Json& request, const Json& arguments);
  void stepOut(const Json& request, const Json& arguments);
  void stepBack(const Json& request, const Json& arguments);
  void reverseContinue(const Json& request, const Json& arguments);
  void pause(const Json& request, const Json& arguments);
  void stepCycle(const Json& request, const Json& arguments);
  void stepActivation(const Json& request, const Json& arguments);
  void gotoCycle(const Json& request, const Json& arguments);
  void lastWrite(const Json& request, const Json& arguments);
  void memoryHash(const Json& request, const Json& arguments);
  void exceptionInfo(const Json& request, const Json& arguments);

  // ---- values (values.cpp)
  void stackTrace(const Json& request, const Json& arguments);
  void scopes(const Json& request, const Json& arguments);
  void variables(const Json& request, const Json& arguments);
  void setVariable(const Json& request, const Json& arguments);
  void setExpression(const Json& request, const Json& arguments);
  void evaluate(const Json& request, const Json& arguments);
  void completions(const Json& request, const Json& arguments);
  void loadedSources(const Json& request, const Json& arguments);
  Json variableOf(const debug::ShownVariable& variable, const std::string& path);
  const debug::DebugFrame* frameOf(const Json& id);
  int64_t reference(const debug::Variable& place, const std::string& path);
  Json sourceOf(const char* file) const;
  uint32_t task() const;

  debug::Debugger& debugger() { return *target_->debugger; }
  bool isRunning() const { return static_cast<bool>(runs_); }

  Connection& connection_;
  ParseArguments parse_;
  std::unique_ptr<debug::Target> target_;
  std::unique_ptr<Attached> attached_;  // instead of a target
  bool is_initialized_ = false, is_configured_ = false, ends_ = false, stops_on_entry_ = false;
  bool is_entering_ = false;  // the first stop is the one at the entry
  bool pauses_ = false;       // the client asked for it
  bool has_ended_ = false;    // and the client was told
  int exit_code_ = 0;
  int64_t line_base_ = 1, column_base_ = 1;
  std::function<debug::Stop()> runs_;
  std::string last_reason_, last_text_;
  std::string folder_;  // of relative paths
  // What a variablesReference stands for until the program goes on.
  struct Handle {
    enum Kind : uint8_t { Locals, Instance, Globals, Image, Inside } kind;
    size_t frame = 0;
    debug::Variable place;
    std::string path;                                         // an expression for it; empty: none
    std::string expressionOf(const std::string& name) const;  // of what is inside
  };
  std::vector<Handle> handles_;
};

// On these descriptors.
int runAdapter(int input, int output, ParseArguments parse);
// On a port of this machine, for one client; 0: any, which is printed.
int runAdapterOnPort(uint32_t port, ParseArguments parse, driver::Sink& sink);

}  // namespace rung::dap

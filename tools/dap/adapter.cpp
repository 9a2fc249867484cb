// SPDX-License-Identifier: Apache-2.0
#include "tools/dap/adapter.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tools/driver/commands.h"

namespace rung::dap {
namespace {

using debug::Granularity;
using debug::StepKind;
using debug::Stop;

// The diagnostics of the project, as output of the session.
class OutputSink final : public driver::Sink {
 public:
  explicit OutputSink(Connection& connection) : connection_(connection) {
    cookie_io_functions_t functions{};
    functions.write = [](void* to, const char* text, size_t size) -> ssize_t {
      static_cast<OutputSink*>(to)->print(std::string(text, size), "stdout");
      return static_cast<ssize_t>(size);
    };
    out_ = fopencookie(this, "w", functions);
  }
  ~OutputSink() override {
    if (out_ != nullptr) fclose(out_);
  }
  void message(std::string_view text) override { print(std::string(text), "stderr"); }
  std::string output(std::string_view text) override { return print(std::string(text), "stdout"), std::string(); }
  std::FILE* programOutput() override { return out_; }
  std::FILE* programErrors() override { return out_; }

 private:
  void print(const std::string& text, const char* category) {
    connection_.event("output", {{"category", category}, {"output", text}});
  }
  Connection& connection_;
  std::FILE* out_ = nullptr;
};

Granularity granularityOf(const Json& arguments) {
  const std::string_view wanted = arguments["granularity"].text();
  if (wanted == "statement") return Granularity::Statement;
  return wanted == "instruction" ? Granularity::Network : Granularity::Line;
}

Json capabilities() {
  Json filters;
  filters.add({{"filter", "faults"}, {"label", "All faults"}, {"default", false}});
  filters.add({{"filter", "uncaught"}, {"label", "Faults that no __TRY handles"}, {"default", true}});
  filters.add({{"filter", "assertions"}, {"label", "Failed assertions"}, {"default", false}});
  return {{"supportsConfigurationDoneRequest", true},
          {"supportsFunctionBreakpoints", true},
          {"supportsConditionalBreakpoints", true},
          {"supportsHitConditionalBreakpoints", true},
          {"supportsLogPoints", true},
          {"supportsDataBreakpoints", true},
          {"supportsBreakpointLocationsRequest", true},
          {"supportsEvaluateForHovers", true},
          {"supportsStepBack", true},
          {"supportsSetVariable", true},
          {"supportsSetExpression", true},
          {"supportsSteppingGranularity", true},
          {"supportsExceptionInfoRequest", true},
          {"supportsCompletionsRequest", true},
          {"supportsLoadedSourcesRequest", true},
          {"supportsRestartRequest", true},
          {"supportsTerminateRequest", true},
          {"supportsCancelRequest", true},
          {"exceptionBreakpointFilters", filters}};
}

}  // namespace

const Adapter::Request Adapter::kRequests[] = {
    {"initialize", &Adapter::initialize, Request::Nothing},
    {"launch", &Adapter::launch, Request::Nothing},
    {"attach", &Adapter::attach, Request::Nothing},
    {"configurationDone", &Adapter::configurationDone, Request::Program},
    {"disconnect", &Adapter::disconnect, Request::Nothing},
    {"terminate", &Adapter::terminate, Request::Nothing},
    {"restart", &Adapter::restart, Request::Program},
    {"cancel", &Adapter::cancel, Request::Nothing},
    {"setBreakpoints", &Adapter::setBreakpoints, Request::Program},
    {"setFunctionBreakpoints", &Adapter::setFunctionBreakpoints, Request::Program},
    {"setExceptionBreakpoints", &Adapter::setExceptionBreakpoints, Request::Program},
    {"dataBreakpointInfo", &Adapter::dataBreakpointInfo, Request::Program},
    {"setDataBreakpoints", &Adapter::setDataBreakpoints, Request::Program},
    {"breakpointLocations", &Adapter::breakpointLocations, Request::Program},
    {"threads", &Adapter::threads, Request::Program},
    {"continue", &Adapter::resume, Request::Stopped},
    {"next", &Adapter::next, Request::Stopped},
    {"stepIn", &Adapter::stepIn, Request::Stopped},
    {"stepOut", &Adapter::stepOut, Request::Stopped},
    {"stepBack", &Adapter::stepBack, Request::Stopped},
    {"reverseContinue", &Adapter::reverseContinue, Request::Stopped},
    {"pause", &Adapter::pause, Request::Program},
    {"exceptionInfo", &Adapter::exceptionInfo, Request::Stopped},
    {"stackTrace", &Adapter::stackTrace, Request::Stopped},
    {"scopes", &Adapter::scopes, Request::Stopped},
    {"variables", &Adapter::variables, Request::Stopped},
    {"setVariable", &Adapter::setVariable, Request::Stopped},
    {"setExpression", &Adapter::setExpression, Request::Stopped},
    {"evaluate", &Adapter::evaluate, Request::Stopped},
    {"completions", &Adapter::completions, Request::Stopped},
    {"loadedSources", &Adapter::loadedSources, Request::Program},
    {"rung/stepCycle", &Adapter::stepCycle, Request::Stopped},
    {"rung/stepActivation", &Adapter::stepActivation, Request::Stopped},
    {"rung/gotoCycle", &Adapter::gotoCycle, Request::Stopped},
    {"rung/lastWrite", &Adapter::lastWrite, Request::Stopped},
    {"rung/memoryHash", &Adapter::memoryHash, Request::Stopped},
};

Adapter::Adapter(Connection& connection, ParseArguments parse) : connection_(connection), parse_(std::move(parse)) {}

Adapter::~Adapter() { connection_.whenReceived(nullptr); }

int Adapter::serve() {
  while (!ends_) {
    if (isRunning() && !connection_.hasNext()) {
      runProgram();
      continue;
    }
    const std::optional<Received> received = connection_.next();
    if (!received) break;
    take(*received);
  }
  return exit_code_;
}

void Adapter::take(const Received& received) {
  const Json& message = received.message;
  if (!received.error.empty()) {
    connection_.event("output", {{"category", "important"}, {"output", "rung dap: " + received.error + "\n"}});
    return;
  }
  if (message["type"].text() != "request" || !message["command"].isText()) return;  // no answer is expected
  const std::string_view command = message["command"].text();
  if (attached_ && attached_->take(message, command, message["arguments"])) return;
  for (const Request& request : kRequests) {
    if (command != request.name) continue;
    if (!is_initialized_ && request.answer != &Adapter::initialize && request.answer != &Adapter::disconnect)
      return connection_.refuse(message, "the first request must be `initialize`");
    if (request.needs != Request::Nothing && attached_)
      return connection_.refuse(message, "this needs a program that the debugger has launched");
    if (request.needs != Request::Nothing && !target_)
      return connection_.refuse(message, "no program is loaded: `launch` comes first");
    if (request.needs == Request::Stopped && isRunning()) return connection_.refuse(message, "the program runs");
    return (this->*request.answer)(message, message["arguments"]);
  }
  connection_.refuse(message, "unknown request `" + std::string(command) + "`");
}

// Until it stops, or a message comes.
void Adapter::runProgram() {
  const Stop stop = runs_();
  if (stop.reason == Stop::Pause && !pauses_) {
    runs_ = [this] { return debugger().goOn(); };
    return;
  }
  runs_ = nullptr;
  pauses_ = false;
  report(stop);
}

void Adapter::report(const Stop& stop) {
  handles_.clear();
  if (stop.reason == Stop::Ended && stop.text.empty()) {
    exit_code_ = stop.exit_code;
    has_ended_ = true;
    connection_.event("exited", {{"exitCode", stop.exit_code}});
    connection_.event("terminated", Json::emptyObject());
    return;
  }
  static const std::pair<Stop::Reason, const char*> kReasons[] = {
      {Stop::Entry, "entry"},         {Stop::Breakpoint, "breakpoint"},
      {Stop::Step, "step"},           {Stop::FunctionBreakpoint, "function breakpoint"},
      {Stop::Pause, "pause"},         {Stop::DataBreakpoint, "data breakpoint"},
      {Stop::Exception, "exception"}, {Stop::Goto, "goto"},
      {Stop::HistoryBegins, "entry"}, {Stop::Ended, "goto"}};
  for (const auto& [reason, name] : kReasons)
    if (reason == stop.reason) last_reason_ = name;
  if (is_entering_ && stop.reason == Stop::Step) last_reason_ = "entry";
  is_entering_ = false;
  last_text_ = stop.text;
  Json body = {{"reason", last_reason_}, {"threadId", static_cast<int64_t>(task())}, {"allThreadsStopped", true}};
  if (!stop.text.empty()) body.set("text", stop.text);
  if (!stop.text.empty()) body.set("description", stop.text);
  if (!stop.ids.empty()) {
    Json ids;
    for (const uint32_t id : stop.ids) ids.add(id);
    body.set("hitBreakpointIds", ids);
  }
  connection_.event("stopped", std::move(body));
}

void Adapter::run(const Json& request, Json body, std::function<Stop()> how) {
  handles_.clear();
  pauses_ = false;
  connection_.respond(request, std::move(body));
  runs_ = std::move(how);
}

// ---- the session

void Adapter::initialize(const Json& request, const Json& arguments) {
  if (is_initialized_) return connection_.refuse(request, "the adapter is initialized already");
  is_initialized_ = true;
  if (arguments["linesStartAt1"] == Json(false)) line_base_ = 0;
  if (arguments["columnsStartAt1"] == Json(false)) column_base_ = 0;
  connection_.respond(request, capabilities());
}

void Adapter::launch(const Json& request, const Json& arguments) {
  if (target_ || attached_) return connection_.refuse(request, "a program is loaded already");
  if (arguments["cwd"].isText() && chdir(std::string(arguments["cwd"].text()).c_str()) != 0)
    return connection_.refuse(request, "there is no folder `" + std::string(arguments["cwd"].text()) + "`");
  std::vector<std::string> words;
  const auto add = [&](const char* option, const Json& value) {
    if (value.isText()) words.push_back(std::string(option) + '=' + std::string(value.text()));
    if (value.isInteger()) words.push_back(std::string(option) + '=' + std::to_string(value.integer()));
  };
  if (arguments["program"].isText() && !arguments["program"].text().empty())
    words.emplace_back(arguments["program"].text());
  for (const Json& program : arguments["program"].items()) words.emplace_back(program.text());
  for (const Json& argument : arguments["args"].items()) words.emplace_back(argument.text());
  add("--cycles", arguments["cycles"]);
  add("--interval", arguments["interval"]);
  add("--inputs", arguments["inputs"]);
  add("--test", arguments["test"]);
  add("--history", arguments["history"]);
  debug::TargetOptions options;
  std::string error = parse_(words, options);
  OutputSink sink(connection_);
  auto made = std::make_unique<debug::Target>();
  const auto print = [this](const std::string& text, bool is_error) {
    connection_.event("output", {{"category", is_error ? "stderr" : "stdout"}, {"output", text}});
  };
  if (error.empty() && made->make(options, print, sink, error) != driver::kSuccess && error.empty())
    error = "the project has errors";
  if (!error.empty()) return connection_.refuse(request, error);
  target_ = std::move(made);
  stops_on_entry_ = arguments["stopOnEntry"].isTrue();
  connection_.whenReceived([execution = target_->execution.get()] { execution->interrupt(); });
  connection_.respond(request, {});
  connection_.event("initialized", Json::emptyObject());
}

void Adapter::attach(const Json& request, const Json& arguments) {
  if (target_ || attached_) return connection_.refuse(request, "a program is loaded already");
  if (!arguments["url"].isText())
    return connection_.refuse(request, "`url` is missing: the one that `rung run --monitor` has printed");
  auto made = std::make_unique<Attached>(connection_);
  if (const std::string error = made->connect(std::string(arguments["url"].text())); !error.empty())
    return connection_.refuse(request, error);
  attached_ = std::move(made);
  connection_.respond(request, {});
  connection_.event("initialized", Json::emptyObject());
}

void Adapter::configurationDone(const Json& request, const Json&) {
  if (is_configured_) return connection_.refuse(request, "the program has been started");
  is_configured_ = true;
  run(request, {}, [this] {
    return stops_on_entry_ ? debugger().step(StepKind::Into, Granularity::Statement) : debugger().resume();
  });
  is_entering_ = stops_on_entry_;
}

void Adapter::disconnect(const Json& request, const Json&) {
  connection_.respond(request, {});
  ends_ = true;
}

void Adapter::terminate(const Json& request, const Json&) {
  connection_.respond(request, {});
  runs_ = nullptr;
  if (!has_ended_) connection_.event("terminated", Json::emptyObject());
  has_ended_ = true;
}

void Adapter::restart(const Json& request, const Json&) {
  debugger().execution().restart();
  has_ended_ = false;
  is_configured_ = false;
  configurationDone(request, {});
}

// Nothing that is answered takes long.
void Adapter::cancel(const Json& request, const Json&) { connection_.respond(request, {}); }

// ---- running

uint32_t Adapter::task() const {
  const uint32_t number = target_->debugger->task();
  return number == 0 ? 1 : number;
}

void Adapter::threads(const Json& request, const Json&) {
  Json all;
  const auto& tasks = debugger().execution().session().module().tasks;
  const char* const strings = debugger().execution().module().strings;
  for (size_t i = 0; i < tasks.size(); ++i) {
    const std::string name = strings + tasks[i].name;
    all.add({{"id", static_cast<int64_t>(i + 1)}, {"name", name.empty() ? "program" : name}});
  }
  if (tasks.size() == 0 || debugger().task() > tasks.size())
    all.add({{"id", static_cast<int64_t>(tasks.size() + 1)}, {"name", "test"}});
  connection_.respond(request, {{"threads", all}});
}

void Adapter::resume(const Json& request, const Json&) {
  run(request, {{"allThreadsContinued", true}}, [this] { return debugger().resume(); });
}
void Adapter::next(const Json& request, const Json& arguments) {
  run(request, {}, [this, size = granularityOf(arguments)] { return debugger().step(StepKind::Over, size); });
}
void Adapter::stepIn(const Json& request, const Json& arguments) {
  run(request, {}, [this, size = granularityOf(arguments)] { return debugger().step(StepKind::Into, size); });
}
void Adapter::stepOut(const Json& request, const Json& arguments) {
  run(request, {}, [this, size = granularityOf(arguments)] { return debugger().step(StepKind::Out, size); });
}
void Adapter::stepBack(const Json& request, const Json& arguments) {
  run(request, {}, [this, size = granularityOf(arguments)] { return debugger().stepBack(size); });
}
void Adapter::reverseContinue(const Json& request, const Json&) {
  run(request, {}, [this] { return debugger().reverse(); });
}
void Adapter::stepCycle(const Json& request, const Json&) {
  run(request, {}, [this] { return debugger().step(StepKind::Cycle, Granularity::Statement); });
}
void Adapter::stepActivation(const Json& request, const Json& arguments) {
  const auto wanted = static_cast<uint32_t>(arguments["threadId"].integer(task()));
  run(request, {}, [this, wanted] { return debugger().step(StepKind::Activation, Granularity::Statement, wanted); });
}
void Adapter::gotoCycle(const Json& request, const Json& arguments) {
  if (!arguments["cycle"].isInteger() || arguments["cycle"].integer() < 0)
    return connection_.refuse(request, "`cycle` must be the number of a cycle");
  run(request, {}, [this, cycle = arguments["cycle"].integer()] { return debugger().goToCycle(cycle); });
}
void Adapter::lastWrite(const Json& request, const Json& arguments) {
  run(request, {}, [this, path = std::string(arguments["dataId"].text())] { return debugger().lastWrite(path); });
}

void Adapter::pause(const Json& request, const Json&) {
  connection_.respond(request, {});
  pauses_ = true;
  if (!isRunning()) return;
  // It was interrupted for this request.
  runs_ = nullptr;
  pauses_ = false;
  report({Stop::Pause, "", {}, 0});
}

// Of all variables: for tests.
void Adapter::memoryHash(const Json& request, const Json&) {
  connection_.respond(request, {{"hash", std::to_string(debugger().execution().memoryHash())}});
}

void Adapter::exceptionInfo(const Json& request, const Json&) {
  connection_.respond(request, {{"exceptionId", last_text_.substr(0, last_text_.find('\n'))},
                                {"description", last_text_},
                                {"breakMode", "always"}});
}

// ---- the ends of the wire

int runAdapter(int input, int output, ParseArguments parse) {
  signal(SIGPIPE, SIG_IGN);
  Connection connection(input, output);
  return Adapter(connection, std::move(parse)).serve();
}

int runAdapterOnPort(uint32_t port, ParseArguments parse, driver::Sink& sink) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const int yes = 1;
  setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (listener < 0 || bind(listener, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(listener, 1) != 0)
    return driver::usageError(sink, "--port " + std::to_string(port) + ": the port cannot be opened");
  getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  sink.message("rung dap: 127.0.0.1:" + std::to_string(ntohs(address.sin_port)) + "\n");
  const int client = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
  close(listener);
  if (client < 0) return driver::usageError(sink, "--port: no client came");
  const int exit = runAdapter(client, client, std::move(parse));
  close(client);
  return exit;
}

}  // namespace rung::dap

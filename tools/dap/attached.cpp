// SPDX-License-Identifier: Apache-2.0
#include "tools/dap/attached.h"

#include <algorithm>

#include "stdlib/runtime/host/symbols.h"

namespace rung::dap {
namespace {

constexpr int64_t kPrograms = 1;  // the variablesReference of the scope
constexpr int kMostVariables = 1000;

}  // namespace

std::string Attached::connect(const std::string& url) {
  if (std::string error = client_.readUrl(url); !error.empty()) return error;
  return client_.get("/api/info").error;
}

bool Attached::take(const Json& request, std::string_view name, const Json& arguments) {
  if (name == "threads") return threads(request), true;
  if (name == "stackTrace") return stackTrace(request), true;
  if (name == "scopes") return scopes(request), true;
  if (name == "variables") return variables(request, arguments), true;
  if (name == "evaluate") return evaluate(request, arguments), true;
  if (name == "setVariable") return setVariable(request, arguments), true;
  if (name == "setExpression")
    return write(request, std::string(arguments["expression"].text()), arguments["value"].text()), true;
  if (name == "pause") return command(request, "stop", "pause"), true;
  if (name == "continue") return command(request, "start", nullptr), true;
  if (name == "setBreakpoints" || name == "setFunctionBreakpoints" || name == "setDataBreakpoints")
    return refuseBreakpoints(request, arguments), true;
  if (name == "configurationDone" || name == "setExceptionBreakpoints") return connection_.respond(request, {}), true;
  return false;
}

// The program goes on at lines; only `launch` stops there.
void Attached::refuseBreakpoints(const Json& request, const Json& arguments) {
  Json list = Json(Json::Array());
  for (size_t i = 0; i < arguments["breakpoints"].items().size(); ++i)
    list.add({{"verified", false}, {"message", "a program that was started elsewhere does not stop here; launch it"}});
  connection_.respond(request, {{"breakpoints", std::move(list)}});
}

void Attached::threads(const Json& request) {
  const monitor::Client::Answer tasks = client_.get("/api/tasks");
  if (!tasks.error.empty()) return connection_.refuse(request, tasks.error);
  Json list = Json(Json::Array());
  int64_t id = 0;
  for (const Json& task : tasks.value.items()) list.add({{"id", ++id}, {"name", task["name"].text()}});
  if (id == 0) list.add({{"id", 1}, {"name", "program"}});
  connection_.respond(request, {{"threads", std::move(list)}});
}

void Attached::stackTrace(const Json& request) {
  const monitor::Client::Answer info = client_.get("/api/info");
  if (!info.error.empty()) return connection_.refuse(request, info.error);
  Json list;
  list.add(
      {{"id", 1},
       {"name", std::string(info.value["name"].text()) + ", cycle " + std::to_string(info.value["cycle"].integer())},
       {"line", 0},
       {"column", 0},
       {"presentationHint", "label"}});
  connection_.respond(request, {{"stackFrames", list}, {"totalFrames", 1}});
}

void Attached::scopes(const Json& request) {
  Json list;
  list.add({{"name", "Globals"}, {"variablesReference", kPrograms}, {"expensive", false}});
  connection_.respond(request, {{"scopes", list}});
}

// The roots of all paths, then the variables of one.
void Attached::variables(const Json& request, const Json& arguments) {
  const int64_t number = arguments["variablesReference"].integer();
  const auto root = static_cast<size_t>(number - kPrograms - 1);
  if (number < kPrograms || (number > kPrograms && root >= roots_.size()))
    return connection_.refuse(request, "there is no such variable any more");
  const std::string prefix = number == kPrograms ? "" : roots_[root];
  const monitor::Client::Answer found = client_.get("/api/symbols?count=" + std::to_string(kMostVariables) +
                                                    "&prefix=" + monitor::percentEncoded(prefix));
  if (!found.error.empty()) return connection_.refuse(request, found.error);
  Json list = Json(Json::Array()), paths = Json(Json::Array());
  std::vector<std::string> shown;
  for (const Json& symbol : found.value["symbols"].items()) {
    const std::string path(symbol["path"].text());
    const size_t end = path.find_first_of(".[");
    if (prefix.empty() && end != std::string::npos) {
      const std::string name = path.substr(0, end);
      if (std::find(roots_.begin(), roots_.end(), name) == roots_.end()) roots_.push_back(name);
      if (std::find(shown.begin(), shown.end(), name) != shown.end()) continue;
      shown.push_back(name);
      const auto at = static_cast<int64_t>(std::find(roots_.begin(), roots_.end(), name) - roots_.begin());
      list.add({{"name", name}, {"value", ""}, {"variablesReference", at + kPrograms + 1}});
    } else if (symbol["kind"].text() != "record" && symbol["kind"].text() != "array") {
      paths.add(path);
    }
  }
  const monitor::Client::Answer values = client_.post("/api/values", {{"paths", paths}});
  if (!values.error.empty()) return connection_.refuse(request, values.error);
  for (const protocol::JsonMember& value : values.value["values"].members()) {
    const size_t cut = prefix.empty() ? 0 : prefix.size() + (value.name[prefix.size()] == '.' ? 1 : 0);
    list.add({{"name", value.name.substr(std::min(cut, value.name.size()))},
              {"value", value.value},
              {"evaluateName", value.name},
              {"variablesReference", 0}});
  }
  connection_.respond(request, {{"variables", std::move(list)}});
}

Json Attached::valueOf(const std::string& path, std::string& error) {
  const monitor::Client::Answer answer = client_.get("/api/values?paths=" + monitor::percentEncoded(path));
  error = answer.error;
  const Json::Object& values = answer.value["values"].members();
  return values.empty() ? Json("") : values.front().value;
}

void Attached::write(const Json& request, const std::string& path, std::string_view value) {
  Json values = Json::emptyObject();
  values.set(path, value);
  const monitor::Client::Answer answer = client_.post("/api/write", {{"values", values}});
  if (!answer.error.empty()) return connection_.refuse(request, answer.error);
  std::string error;
  connection_.respond(request, {{"value", valueOf(path, error)}});
}

void Attached::setVariable(const Json& request, const Json& arguments) {
  const int64_t number = arguments["variablesReference"].integer();
  const auto root = static_cast<size_t>(number - kPrograms - 1);
  std::string path(arguments["name"].text());
  if (number > kPrograms && root < roots_.size()) path = roots_[root] + (path.starts_with('[') ? "" : ".") + path;
  write(request, path, arguments["value"].text());
}

// In the console `x := 5` writes, `force x := 5` and `unforce x` force.
void Attached::evaluate(const Json& request, const Json& arguments) {
  std::string text(host::trimmed(arguments["expression"].text()));
  const size_t sign = text.find(":=");
  monitor::Client::Answer answer;
  if (text.starts_with("unforce ")) {
    Json paths;
    paths.add(std::string(host::trimmed(text.substr(8))));
    answer = client_.post("/api/unforce", {{"paths", paths}});
    text = host::trimmed(text.substr(8));
  } else if (sign != std::string::npos) {
    const bool forces = text.starts_with("force ");
    const std::string path(host::trimmed(text.substr(forces ? 6 : 0, sign - (forces ? 6 : 0))));
    Json values = Json::emptyObject();
    values.set(path, std::string(host::trimmed(text.substr(sign + 2))));
    answer = client_.post(forces ? "/api/force" : "/api/write", {{"values", values}});
    text = path;
  }
  if (!answer.error.empty()) return connection_.refuse(request, answer.error);
  std::string error;
  const Json value = valueOf(text, error);
  if (!error.empty()) return connection_.refuse(request, error);
  connection_.respond(request, {{"result", value}, {"variablesReference", 0}});
}

void Attached::command(const Json& request, const char* what, const char* reason) {
  const monitor::Client::Answer answer = client_.post("/api/command", {{"command", what}});
  if (!answer.error.empty()) return connection_.refuse(request, answer.error);
  connection_.respond(request, {});
  if (reason == nullptr) return connection_.event("continued", {{"threadId", 1}, {"allThreadsContinued", true}});
  connection_.event("stopped", {{"reason", reason}, {"threadId", 1}, {"allThreadsStopped", true}});
}

}  // namespace rung::dap

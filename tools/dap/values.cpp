// SPDX-License-Identifier: Apache-2.0
// Frames, scopes, variables and expressions: see adapter.h.
#include <limits.h>
#include <stdlib.h>

#include <algorithm>
#include <set>

#include "tools/dap/adapter.h"

namespace rung::dap {

Json Adapter::sourceOf(const char* file) const {
  const std::string shown = target_->debugger->shownFile(file);
  char resolved[PATH_MAX];
  const std::string path = realpath(shown.c_str(), resolved) != nullptr ? resolved : shown;
  return {{"name", path.substr(path.find_last_of('/') + 1)}, {"path", path}};
}

std::string Adapter::Handle::expressionOf(const std::string& name) const {
  if (kind != Inside) return name;
  return path + (name.starts_with('[') || name.starts_with('^') ? "" : ".") + name;
}

const debug::DebugFrame* Adapter::frameOf(const Json& id) {
  const std::vector<debug::DebugFrame>& frames = debugger().frames();
  const int64_t number = id.integer();
  return number >= 1 && number <= static_cast<int64_t>(frames.size()) ? &frames[static_cast<size_t>(number - 1)]
                                                                      : nullptr;
}

int64_t Adapter::reference(const debug::Variable& place, const std::string& path) {
  handles_.push_back({Handle::Inside, 0, place, path});
  return static_cast<int64_t>(handles_.size());
}

void Adapter::stackTrace(const Json& request, const Json& arguments) {
  Json list = Json(Json::Array());
  const std::vector<debug::DebugFrame>& frames = debugger().frames();
  const bool is_here = arguments["threadId"].integer(task()) == task();
  const auto first = static_cast<size_t>(std::max<int64_t>(arguments["startFrame"].integer(), 0));
  const int64_t levels = arguments["levels"].integer();
  for (size_t i = first; is_here && i < frames.size() && (levels <= 0 || i - first < static_cast<size_t>(levels));
       ++i) {
    const debug::DebugFrame& frame = frames[i];
    Json shown = {{"id", static_cast<int64_t>(i + 1)},
                  {"name", debugger().values().nameOf(frame)},
                  {"line", static_cast<int64_t>(frame.line) - 1 + line_base_},
                  {"column", static_cast<int64_t>(frame.column) - 1 + column_base_}};
    if (debugger().execution().code().bodies()[frame.body].is_library)
      shown.set("presentationHint", "subtle");
    else
      shown.set("source", sourceOf(frame.file));
    list.add(std::move(shown));
  }
  connection_.respond(
      request, {{"stackFrames", std::move(list)}, {"totalFrames", static_cast<int64_t>(is_here ? frames.size() : 0)}});
}

void Adapter::scopes(const Json& request, const Json& arguments) {
  const debug::DebugFrame* const frame = frameOf(arguments["frameId"]);
  if (frame == nullptr) return connection_.refuse(request, "there is no such frame");
  const auto number = static_cast<size_t>(arguments["frameId"].integer() - 1);
  Json list;
  const auto add = [&](const char* name, Handle::Kind kind, bool is_expensive) {
    handles_.push_back({kind, number, {}, ""});
    Json scope = {
        {"name", name}, {"variablesReference", static_cast<int64_t>(handles_.size())}, {"expensive", is_expensive}};
    if (kind == Handle::Locals) scope.set("presentationHint", "locals");
    list.add(std::move(scope));
  };
  const ir::interpreter::DebugBody& body = debugger().execution().code().bodies()[frame->body];
  if (!body.locals.empty()) add("Locals", Handle::Locals, false);
  if (body.self != RUNG_NONE) add("Instance", Handle::Instance, false);
  add("Globals", Handle::Globals, true);
  add("Image", Handle::Image, true);
  connection_.respond(request, {{"scopes", list}});
}

Json Adapter::variableOf(const debug::ShownVariable& variable, const std::string& path) {
  const int64_t inside = variable.named + variable.indexed != 0 ? reference(variable.place, path) : 0;
  Json shown = {
      {"name", variable.name}, {"value", variable.value}, {"type", variable.type}, {"variablesReference", inside}};
  if (variable.named != 0) shown.set("namedVariables", static_cast<int64_t>(variable.named));
  if (variable.indexed != 0) shown.set("indexedVariables", static_cast<int64_t>(variable.indexed));
  if (!path.empty()) shown.set("evaluateName", path);
  return shown;
}

void Adapter::variables(const Json& request, const Json& arguments) {
  const int64_t number = arguments["variablesReference"].integer();
  if (number < 1 || number > static_cast<int64_t>(handles_.size()))
    return connection_.refuse(request, "there is no such variable any more");
  const Handle handle = handles_[static_cast<size_t>(number - 1)];
  const auto start = static_cast<uint64_t>(std::max<int64_t>(arguments["start"].integer(), 0));
  const int64_t count = arguments["count"].integer();
  constexpr uint64_t kMost = 10'000;  // without a page
  std::vector<debug::ShownVariable> found;
  const std::vector<debug::DebugFrame>& frames = debugger().frames();
  const bool has_frame = handle.frame < frames.size();
  debug::Values& values = debugger().values();
  switch (handle.kind) {
    case Handle::Locals: found = has_frame ? values.locals(frames[handle.frame]) : found; break;
    case Handle::Instance: found = has_frame ? values.instance(frames[handle.frame]) : found; break;
    case Handle::Globals: found = values.globals(); break;
    case Handle::Image: found = values.image(); break;
    case Handle::Inside:
      found = values.inside(handle.place, start, count > 0 ? static_cast<uint64_t>(count) : kMost);
      break;
  }
  Json list = Json(Json::Array());
  for (const debug::ShownVariable& variable : found) list.add(variableOf(variable, handle.expressionOf(variable.name)));
  connection_.respond(request, {{"variables", std::move(list)}});
}

void Adapter::setVariable(const Json& request, const Json& arguments) {
  const int64_t number = arguments["variablesReference"].integer();
  if (number < 1 || number > static_cast<int64_t>(handles_.size()))
    return connection_.refuse(request, "there is no such variable any more");
  const Handle handle = handles_[static_cast<size_t>(number - 1)];
  const std::string path = handle.expressionOf(std::string(arguments["name"].text()));
  const std::vector<debug::DebugFrame>& frames = debugger().frames();
  const debug::DebugFrame* const frame = handle.frame < frames.size() ? &frames[handle.frame] : nullptr;
  const std::string error = debugger().set(path, std::string(arguments["value"].text()), frame);
  if (!error.empty()) return connection_.refuse(request, error);
  const debug::Evaluated now = debugger().evaluate(path, frame);
  connection_.respond(request, {{"value", now.value}, {"type", now.type}});
}

void Adapter::setExpression(const Json& request, const Json& arguments) {
  const std::string expression(arguments["expression"].text());
  const debug::DebugFrame* const frame = frameOf(arguments["frameId"]);
  const std::string error = debugger().set(expression, std::string(arguments["value"].text()), frame);
  if (!error.empty()) return connection_.refuse(request, error);
  const debug::Evaluated now = debugger().evaluate(expression, frame);
  connection_.respond(request, {{"value", now.value}, {"type", now.type}});
}

// In the console `x := 5` sets, `force x := 5` and `unforce x` force.
void Adapter::evaluate(const Json& request, const Json& arguments) {
  std::string text(host::trimmed(arguments["expression"].text()));
  const debug::DebugFrame* const frame = frameOf(arguments["frameId"]);
  const size_t sign = text.find(":=");
  if (arguments["context"].text() == "repl") {
    const bool forces = text.starts_with("force ");
    std::string error;
    if (text.starts_with("unforce ")) {
      error = debugger().unforce(std::string(host::trimmed(text.substr(8))));
      return error.empty() ? connection_.respond(request, {{"result", ""}, {"variablesReference", 0}})
                           : connection_.refuse(request, error);
    }
    if (sign != std::string::npos) {
      const std::string value(host::trimmed(text.substr(sign + 2)));
      text = host::trimmed(text.substr(forces ? 6 : 0, sign - (forces ? 6 : 0)));
      error = forces ? debugger().force(text, value) : debugger().set(text, value, frame);
      if (!error.empty()) return connection_.refuse(request, error);
    }
  }
  const debug::Evaluated value = debugger().evaluate(text, frame);
  if (!value.error.empty()) return connection_.refuse(request, value.error);
  Json body = {{"result", value.value},
               {"type", value.type},
               {"variablesReference", value.named + value.indexed != 0 ? reference(value.place, text) : 0}};
  if (value.named != 0) body.set("namedVariables", static_cast<int64_t>(value.named));
  if (value.indexed != 0) body.set("indexedVariables", static_cast<int64_t>(value.indexed));
  connection_.respond(request, std::move(body));
}

// The names that a frame knows.
void Adapter::completions(const Json& request, const Json& arguments) {
  std::string text(arguments["text"].text());
  const auto column = static_cast<size_t>(std::max<int64_t>(arguments["column"].integer() - column_base_, 0));
  text.resize(std::min(text.size(), column));
  const size_t begin = text.find_last_of(" ()+-*/=<>,:[&") + 1;
  const size_t dot = text.find_last_of('.');
  const bool is_member = dot != std::string::npos && dot >= begin;
  const std::string prefix = host::lowerCase(text.substr(is_member ? dot + 1 : begin));
  const debug::DebugFrame* const frame = frameOf(arguments["frameId"]);
  std::vector<debug::ShownVariable> known;
  if (is_member) {
    const debug::Evaluated base = debugger().evaluate(text.substr(begin, dot - begin), frame);
    if (base.error.empty() && !base.place.isEmpty()) known = debugger().values().inside(base.place, 0, UINT64_MAX);
  } else {
    if (frame != nullptr) known = debugger().values().locals(*frame);
    if (frame != nullptr)
      for (debug::ShownVariable& one : debugger().values().instance(*frame)) known.push_back(std::move(one));
    for (debug::ShownVariable& one : debugger().values().globals()) known.push_back(std::move(one));
  }
  Json list = Json(Json::Array());
  for (const debug::ShownVariable& one : known)
    if (host::lowerCase(one.name).starts_with(prefix))
      list.add({{"label", one.name}, {"type", "variable"}, {"detail", one.type}});
  connection_.respond(request, {{"targets", std::move(list)}});
}

void Adapter::loadedSources(const Json& request, const Json&) {
  std::set<std::string> files;
  for (const debug::DebugPoint& point : debugger().execution().code().points()) files.insert(point.file);
  Json list = Json(Json::Array());
  for (const std::string& file : files) list.add(sourceOf(file.c_str()));
  connection_.respond(request, {{"sources", std::move(list)}});
}

}  // namespace rung::dap

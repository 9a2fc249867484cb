// SPDX-License-Identifier: Apache-2.0
// Breakpoints of all kinds: see adapter.h.
#include "tools/dap/adapter.h"

namespace rung::dap {

debug::BreakpointWish Adapter::wishOf(const Json& breakpoint) const {
  debug::BreakpointWish wish;
  const int64_t line = breakpoint["line"].integer() + 1 - line_base_;
  wish.line = line > 0 && line < UINT32_MAX ? static_cast<uint32_t>(line) : 0;
  if (breakpoint["column"].isInteger()) {
    const int64_t column = breakpoint["column"].integer() + 1 - column_base_;
    wish.column = column > 0 && column < UINT32_MAX ? static_cast<uint32_t>(column) : 0;
  }
  wish.condition = breakpoint["condition"].text();
  wish.hits = breakpoint["hitCondition"].text();
  wish.log = breakpoint["logMessage"].text();
  return wish;
}

Json Adapter::breakpointsOf(const std::vector<debug::Breakpoint>& all) {
  Json list = Json(Json::Array());
  for (const debug::Breakpoint& one : all) {
    Json shown = {{"id", one.id}, {"verified", one.is_bound}};
    if (!one.problem.empty()) shown.set("message", one.problem);
    if (one.is_bound && !one.file.empty()) {
      shown.set("source", sourceOf(one.file.c_str()));
      shown.set("line", static_cast<int64_t>(one.line) - 1 + line_base_);
      shown.set("column", static_cast<int64_t>(one.column) - 1 + column_base_);
    }
    list.add(std::move(shown));
  }
  return {{"breakpoints", std::move(list)}};
}

void Adapter::setBreakpoints(const Json& request, const Json& arguments) {
  const std::string path(arguments["source"]["path"].text());
  if (path.empty()) return connection_.refuse(request, "the source has no path");
  std::vector<debug::BreakpointWish> wishes;
  for (const Json& one : arguments["breakpoints"].items()) wishes.push_back(wishOf(one));
  connection_.respond(request, breakpointsOf(debugger().setBreakpoints(path, std::move(wishes))));
}

void Adapter::setFunctionBreakpoints(const Json& request, const Json& arguments) {
  std::vector<debug::BreakpointWish> wishes;
  for (const Json& one : arguments["breakpoints"].items()) {
    wishes.push_back(wishOf(one));
    wishes.back().name = one["name"].text();
  }
  connection_.respond(request, breakpointsOf(debugger().setFunctionBreakpoints(std::move(wishes))));
}

void Adapter::setExceptionBreakpoints(const Json& request, const Json& arguments) {
  debug::Debugger::Exceptions wanted{false, false, false};
  for (const Json& filter : arguments["filters"].items()) {
    wanted.faults |= filter.text() == "faults";
    wanted.uncaught |= filter.text() == "uncaught";
    wanted.assertions |= filter.text() == "assertions";
  }
  debugger().setExceptions(wanted);
  connection_.respond(request, {});
}

// A variable of an instance or a global one; those of a call are gone when it returns.
void Adapter::dataBreakpointInfo(const Json& request, const Json& arguments) {
  if (isRunning()) return connection_.refuse(request, "the program runs");
  std::string path(arguments["name"].text());
  const int64_t number = arguments["variablesReference"].integer();
  if (number > 0 && number <= static_cast<int64_t>(handles_.size())) {
    const Handle& handle = handles_[static_cast<size_t>(number - 1)];
    const std::vector<debug::DebugFrame>& frames = debugger().frames();
    if (handle.kind == Handle::Instance && handle.frame < frames.size())
      path = debugger().values().instancePath(frames[handle.frame]) + '.' + path;
    if (handle.kind == Handle::Inside) path = handle.expressionOf(path);
    if (handle.kind == Handle::Locals) path.clear();
  } else if (const debug::DebugFrame* const frame = frameOf(arguments["frameId"])) {
    const std::string inside = debugger().values().instancePath(*frame) + '.' + path;
    debug::Variable found;
    std::string error;
    if (debugger().execution().session().symbols().find(inside, found, error)) path = inside;
  }
  debug::Variable variable;
  std::string error = "a variable of a call";
  Json body;
  if (!path.empty() && debugger().execution().session().symbols().find(path, variable, error)) {
    Json accesses;
    accesses.add("write");
    body = {{"dataId", path}, {"description", path}, {"accessTypes", accesses}, {"canPersist", true}};
  } else {
    body = {{"dataId", nullptr}, {"description", error}};
  }
  connection_.respond(request, std::move(body));
}

void Adapter::setDataBreakpoints(const Json& request, const Json& arguments) {
  std::vector<debug::BreakpointWish> wishes;
  for (const Json& one : arguments["breakpoints"].items()) {
    wishes.push_back(wishOf(one));
    wishes.back().name = one["dataId"].text();
  }
  connection_.respond(request, breakpointsOf(debugger().setDataBreakpoints(std::move(wishes))));
}

void Adapter::breakpointLocations(const Json& request, const Json& arguments) {
  const auto first = static_cast<uint32_t>(arguments["line"].integer() + 1 - line_base_);
  const auto last = static_cast<uint32_t>(arguments["endLine"].integer(arguments["line"].integer()) + 1 - line_base_);
  Json list = Json(Json::Array());
  for (const debug::DebugPoint& point :
       debugger().possiblePoints(std::string(arguments["source"]["path"].text()), first, last))
    list.add({{"line", static_cast<int64_t>(point.line) - 1 + line_base_},
              {"column", static_cast<int64_t>(point.column) - 1 + column_base_}});
  connection_.respond(request, {{"breakpoints", std::move(list)}});
}

}  // namespace rung::dap

// SPDX-License-Identifier: Apache-2.0
// Requests of the monitor for the scope of the run (scope.h), which are served without waiting for the run: the scope
// has the lock of the image.
#include <algorithm>
#include <limits>

#include "monitor.h"
#include "trace.h"

namespace rung::host {
namespace {

constexpr const char* kStateNames[] = {"off", "running", "waiting", "triggered", "complete"};
constexpr const char* kConditionNames[] = {"none", "rising", "falling", "above", "below"};

// A member that is a number; false: something else, or too large.
bool readCount(const Json& body, const char* name, uint32_t& count) {
  const Json& value = body[name];
  if (value.isNull()) return true;
  if (!value.isInteger() || value.integer() < 0 || value.integer() > std::numeric_limits<int32_t>::max()) return false;
  count = static_cast<uint32_t>(value.integer());
  return true;
}

// Empty, or what is wrong.
std::string readTrigger(const Json& trigger, ScopeOrder& order) {
  if (trigger.isNull()) return "";
  const std::string_view condition = trigger["condition"].isNull() ? "rising" : trigger["condition"].text();
  const auto found = std::find(std::begin(kConditionNames) + 1, std::end(kConditionNames), condition);
  if (found == std::end(kConditionNames)) return "the `condition` of a trigger is rising, falling, above or below";
  order.condition = static_cast<rung_scope_condition>(found - std::begin(kConditionNames));
  order.trigger = trigger["path"].text();
  order.level = trigger["level"].text();
  return readCount(trigger, "before", order.rows_before) ? "" : "`before` is a number of rows";
}

std::string readTask(const Tasks& tasks, const Json& body, ScopeOrder& order) {
  const std::string_view name = body["task"].text();
  if (name.empty()) {
    order.task = tasks.fastest() != nullptr ? tasks.fastest()->index : 0;
    return "";
  }
  for (const Task& task : tasks.all()) {
    order.task = task.index;
    if (lowerCase(tasks.nameOf(task)) == lowerCase(name)) return "";
  }
  return "there is no task " + backquoted(name);
}

std::string readOrder(const Tasks& tasks, const Json& body, ScopeOrder& order) {
  for (const Json& path : body["paths"].items()) order.paths.emplace_back(path.text());
  if (order.paths.empty()) return "`paths` is missing: the paths of variables";
  if (!readCount(body, "rows", order.rows) || !readCount(body, "divider", order.divider))
    return "`rows` and `divider` are numbers";
  std::string error = readTask(tasks, body, order);
  return error.empty() ? readTrigger(body["trigger"], order) : error;
}

void appendState(std::string& json, const ScopeState& state) {
  ((json += "\"state\":\"") += kStateNames[state.state]) += "\",\"first\":" + std::to_string(state.first);
  json += ",\"next\":" + std::to_string(state.next);
  const bool has_trigger = state.trigger_row != RUNG_NONE;
  json += ",\"trigger_row\":" + (has_trigger ? std::to_string(state.trigger_row) : "null");
}

HttpReply replyOf(std::string json) {
  HttpReply reply;
  reply.body = std::move(json);
  return reply;
}

}  // namespace

// ---- requests

void Monitor::serveScope(HttpServer::Client client, const HttpRequest&) {
  const Scope& scope = session_.tasks().scope();
  std::string json = "{";
  appendState(json, scope.state());
  json += ",\"task\":";
  const std::vector<Task>& tasks = session_.tasks().all();
  appendJsonText(json, scope.task() < tasks.size() ? session_.tasks().nameOf(tasks[scope.task()]) : "");
  json += ",\"paths\":[";
  for (const Variable& variable : scope.variables()) {
    if (json.back() != '[') json += ',';
    appendJsonText(json, variable.path);
  }
  server_.reply(client, replyOf(json += "]}"));
}

void Monitor::serveScopeStart(HttpServer::Client client, const HttpRequest& request) {
  Json body;
  if (!readBody(client, request, body)) return;
  ScopeOrder order;
  std::string error = readOrder(session_.tasks(), body, order);
  if (!error.empty()) return fail(client, 400, error);
  Variable variable;
  for (const std::string& path : order.paths)
    if (!session_.symbols().find(path, variable, error)) return fail(client, 404, error);
  error = session_.tasks().scope().start(order);
  if (!error.empty()) return fail(client, 400, error);
  serveScope(client, request);
}

void Monitor::serveScopeStop(HttpServer::Client client, const HttpRequest& request) {
  session_.tasks().scope().stop();
  serveScope(client, request);
}

// Rows from the number `from` on, or from the oldest: their times, and the values of each variable.
void Monitor::serveScopeData(HttpServer::Client client, const HttpRequest& request) {
  uint64_t from = 0, count = 1000;
  if (!readNumber(request, "from", UINT32_MAX, from) || !readNumber(request, "count", Scope::kMostRows, count))
    return fail(client, 400, "`from` and `count` are numbers of rows");
  const Scope& scope = session_.tasks().scope();
  const ScopeRows rows = scope.read(static_cast<uint32_t>(from), static_cast<uint32_t>(count));
  std::string json = "{";
  appendState(json, scope.state());
  json += ",\"from\":" + std::to_string(rows.first) + ",\"times_ms\":[";
  for (uint32_t i = 0; i < rows.count; ++i)
    json += (i == 0 ? "" : ",") + millisecondsOf(Scope::timeOf(scope.row(rows, i)));
  json += "],\"values\":{";
  for (uint32_t c = 0; c < scope.variables().size(); ++c) {
    if (c > 0) json += ',';
    appendJsonText(json, scope.variables()[c].path);
    json += ":[";
    for (uint32_t i = 0; i < rows.count; ++i) {
      if (i > 0) json += ',';
      appendJsonText(json, scope.value(scope.row(rows, i), c));
    }
    json += ']';
  }
  server_.reply(client, replyOf(json += "}}"));
}

}  // namespace rung::host

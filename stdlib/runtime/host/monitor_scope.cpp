// SPDX-License-Identifier: Apache-2.0
// Requests of the monitor for the scope of the run (scope.h). They are served where the run has time, since another
// version of the program, with a scope of its own, may take over between two cycles.
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

// What the body says but the task, which the program knows. Empty, or what is wrong.
std::string readOrder(const Json& body, ScopeOrder& order) {
  for (const Json& path : body["paths"].items()) order.paths.emplace_back(path.text());
  if (order.paths.empty()) return "`paths` is missing: the paths of variables";
  if (!readCount(body, "rows", order.rows) || !readCount(body, "divider", order.divider))
    return "`rows` and `divider` are numbers";
  return readTrigger(body["trigger"], order);
}

bool findTask(const Tasks& tasks, const std::string& name, uint32_t& task) {
  if (name.empty()) {
    task = tasks.fastest() != nullptr ? tasks.fastest()->index : 0;
    return true;
  }
  for (const Task& other : tasks.all()) {
    task = other.index;
    if (lowerCase(tasks.nameOf(other)) == lowerCase(name)) return true;
  }
  return false;
}

void appendState(std::string& json, const ScopeState& state) {
  ((json += "\"state\":\"") += kStateNames[state.state]) += "\",\"first\":" + std::to_string(state.first);
  json += ",\"next\":" + std::to_string(state.next);
  const bool has_trigger = state.trigger_row != RUNG_NONE;
  json += ",\"trigger_row\":" + (has_trigger ? std::to_string(state.trigger_row) : "null");
}

std::string stateJson(Tasks& tasks) {
  const Scope& scope = tasks.scope();
  std::string json = "{";
  appendState(json, scope.state());
  json += ",\"task\":";
  appendJsonText(json, scope.task() < tasks.all().size() ? tasks.nameOf(tasks.all()[scope.task()]) : "");
  json += ",\"paths\":[";
  for (const Variable& variable : scope.variables()) {
    if (json.back() != '[') json += ',';
    appendJsonText(json, variable.path);
  }
  return json += "]}";
}

// Rows from the number `from` on, or from the oldest: their times, and the values of each variable.
std::string dataJson(const Scope& scope, uint32_t from, uint32_t count) {
  const ScopeRows rows = scope.read(from, count);
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
  return json += "}}";
}

MonitorGate::Finish replying(std::string json) {
  return [json = std::move(json)] {
    HttpReply reply;
    reply.body = json;
    return reply;
  };
}

MonitorGate::Finish refusing(int status, std::string sentence) {
  return [status, sentence = std::move(sentence)] { return httpError(status, sentence); };
}

}  // namespace

// ---- requests

void Monitor::serveScope(HttpServer::Client client, const HttpRequest&) {
  ask(client, [this] { return replying(stateJson(session_.tasks())); });
}

void Monitor::serveScopeStart(HttpServer::Client client, const HttpRequest& request) {
  Json body;
  if (!readBody(client, request, body)) return;
  ScopeOrder order;
  if (const std::string error = readOrder(body, order); !error.empty()) return fail(client, 400, error);
  ask(client, [this, order, task = std::string(body["task"].text())]() mutable {
    Tasks& tasks = session_.tasks();
    if (!findTask(tasks, task, order.task)) return refusing(400, "there is no task " + backquoted(task));
    Variable variable;
    std::string error;
    for (const std::string& path : order.paths)
      if (!session_.symbols().find(path, variable, error)) return refusing(404, error);
    error = tasks.scope().start(order);
    return error.empty() ? replying(stateJson(tasks)) : refusing(400, error);
  });
}

void Monitor::serveScopeStop(HttpServer::Client client, const HttpRequest&) {
  ask(client, [this] {
    session_.tasks().scope().stop();
    return replying(stateJson(session_.tasks()));
  });
}

void Monitor::serveScopeData(HttpServer::Client client, const HttpRequest& request) {
  uint64_t from = 0, count = 1000;
  if (!readNumber(request, "from", UINT32_MAX, from) || !readNumber(request, "count", Scope::kMostRows, count))
    return fail(client, 400, "`from` and `count` are numbers of rows");
  ask(client, [this, from, count] {
    return replying(dataJson(session_.tasks().scope(), static_cast<uint32_t>(from), static_cast<uint32_t>(count)));
  });
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// The requests of the monitor, in the order of docs/monitor.md: see monitor.h.
#include <algorithm>
#include <charconv>
#include <sstream>

#include "clock.h"
#include "monitor.h"
#include "monitor_symbols.h"
#include "monitor_views.h"
#include "page_text.h"
#include "value_format.h"

namespace rung::host {
namespace {

constexpr uint64_t kMostSymbols = 100'000;  // of a page
constexpr size_t kMostWritten = 1000, kMostForced = 100;
constexpr uint64_t kFastest = 1000, kUsual = 10;  // events a second

HttpReply jsonReply(std::string body) {
  HttpReply reply;
  reply.body = std::move(body);
  return reply;
}

void appendField(std::string& json, const char* name, int64_t value) {
  ((json += ",\"") += name) += "\":" + std::to_string(value);
}

// A number of microseconds with one digit after the point.
void appendMicroseconds(std::string& json, const char* name, int64_t ns) {
  char text[32];
  snprintf(text, sizeof text, "%.1f", static_cast<double>(ns) / 1000);
  (((json += ",\"") += name) += "\":") += text;
}

const char* const kTaskKinds[] = {"cyclic", "freewheeling", "event", "status", "external"};

void appendTask(std::string& json, const Tasks& tasks, const Task& task) {
  const rung_task_state& state = tasks.stateOf(task);
  json += json.back() == '[' ? "{\"name\":" : ",{\"name\":";
  appendJsonText(json, tasks.nameOf(task));
  ((json += ",\"kind\":\"") += kTaskKinds[task.row->kind]) += '"';
  appendField(json, "priority", task.row->priority);
  appendMicroseconds(json, "interval_us", task.interval_ns);
  appendField(json, "activations", state.activations);
  appendField(json, "overruns", state.overruns);
  appendMicroseconds(json, "last_us", state.last_ns);
  appendMicroseconds(json, "shortest_us", state.shortest_ns);
  appendMicroseconds(json, "average_us", state.activations == 0 ? 0 : state.total_ns / state.activations);
  appendMicroseconds(json, "longest_us", state.longest_ns);
  appendMicroseconds(json, "earliest_us", state.earliest_ns);
  appendMicroseconds(json, "latest_us", state.latest_ns);
  appendMicroseconds(json, "late_us", task.latest_start);
  json += task.stopped ? ",\"stopped\":true}" : ",\"stopped\":false}";
}

std::string tasksJson(Tasks& tasks) {
  const std::lock_guard<Exchange> lock(tasks.exchange());
  std::string json = "[";
  for (const Task& task : tasks.all()) appendTask(json, tasks, task);
  return json += ']';
}

// Of `status`: a line for each fault that the program reports.
std::string reportedFaults(const std::string& status) {
  std::string json;
  std::istringstream lines(status);
  for (std::string line; std::getline(lines, line);) {
    if (line.compare(0, 6, "fault ") != 0) continue;
    json += json.empty() ? "{\"text\":" : ",{\"text\":";
    appendJsonText(json, line);
    json += '}';
  }
  return json;
}

}  // namespace

bool readNumber(const HttpRequest& request, std::string_view name, uint64_t most, uint64_t& number) {
  const std::string* const text = request.parameter(name);
  if (text == nullptr) return true;
  const std::from_chars_result read = std::from_chars(text->data(), text->data() + text->size(), number);
  return !text->empty() && read.ec == std::errc{} && read.ptr == text->data() + text->size() && number <= most;
}

const Monitor::Route Monitor::kRoutes[] = {
    {"GET", "/", &Monitor::servePage},
    {"GET", "/api/info", &Monitor::serveInfo},
    {"GET", "/api/symbols", &Monitor::serveSymbols},
    {"GET", "/api/values", &Monitor::serveValues},
    {"POST", "/api/values", &Monitor::serveValues},
    {"POST", "/api/watch", &Monitor::serveWatch},
    {"GET", "/api/stream", &Monitor::serveStream},
    {"POST", "/api/write", &Monitor::serveWrite},
    {"POST", "/api/force", &Monitor::serveForce},
    {"POST", "/api/unforce", &Monitor::serveUnforce},
    {"GET", "/api/forces", &Monitor::serveForces},
    {"GET", "/api/tasks", &Monitor::serveTasks},
    {"GET", "/api/faults", &Monitor::serveFaults},
    {"GET", "/api/messages", &Monitor::serveMessages},
    {"POST", "/api/command", &Monitor::serveCommand},
    {"POST", "/api/change", &Monitor::serveChange},
    {"GET", "/api/pous", &Monitor::servePous},
    {"GET", "/api/diagram", &Monitor::serveDiagram},
    {"GET", "/api/scope", &Monitor::serveScope},
    {"POST", "/api/scope", &Monitor::serveScopeStart},
    {"POST", "/api/scope/stop", &Monitor::serveScopeStop},
    {"GET", "/api/scope/data", &Monitor::serveScopeData},
};

void Monitor::onRequest(HttpServer::Client client, const HttpRequest& request) {
  const std::lock_guard<std::mutex> held(program_mutex_);
  if (const std::optional<HttpReply> refusal = access_.refusal(request)) return server_.reply(client, *refusal);
  server_.trust(client);
  std::string methods;
  for (const Route& route : kRoutes) {
    if (request.path != route.path) continue;
    if (request.method == route.method) return (this->*route.serve)(client, request);
    methods += (methods.empty() ? "" : ", ") + std::string(route.method);
  }
  if (methods.empty()) return fail(client, 404, "there is no `" + request.path + "` here; docs/monitor.md lists all");
  HttpReply reply = httpError(405, "`" + request.path + "` takes " + methods + ", not " + request.method);
  reply.allow = methods;
  server_.reply(client, reply);
}

// ---- what requests have in common

void Monitor::fail(HttpServer::Client client, int status, std::string_view sentence) {
  server_.reply(client, httpError(status, sentence));
}

void Monitor::ask(HttpServer::Client client, MonitorGate::Act act) { gate_.ask(client, std::move(act), monotonicNs()); }

// The body of a POST, an object. False: the client has its answer.
bool Monitor::readBody(HttpServer::Client client, const HttpRequest& request, Json& body) {
  JsonLimits limits;
  limits.depth = 8;
  limits.values = 100'000;
  JsonResult result = parseJson(request.body, limits);
  if (!result.error.empty()) return fail(client, 400, "the body is not JSON: " + result.error), false;
  if (!result.value.isObject()) return fail(client, 400, "the body is not an object of JSON"), false;
  body = std::move(result.value);
  return true;
}

bool Monitor::readPaths(HttpServer::Client client, const HttpRequest& request, std::vector<std::string>& paths) {
  if (request.method == "GET") {
    if (const std::string* const list = request.parameter("paths")) paths = splitList(*list);
  } else {
    Json body;
    if (!readBody(client, request, body)) return false;
    for (const Json& path : body["paths"].items()) paths.emplace_back(path.text());
  }
  if (!paths.empty()) return true;
  return fail(client, 400, "`paths` is missing: the paths of variables"), false;
}

// Null: the client has its answer.
SharedList Monitor::makeList(HttpServer::Client client, const std::vector<std::string>& paths) {
  auto list = std::make_shared<WatchList>();
  std::string error;
  bool is_unknown = false;
  for (const std::string& path : paths)
    if (!list->add(session_.symbols(), path, error, is_unknown))
      return fail(client, is_unknown ? 404 : 400, error), nullptr;
  return list;
}

// {"values": {path: value}}
bool Monitor::readAssignments(HttpServer::Client client, const HttpRequest& request, Command& command) {
  Json body;
  if (!readBody(client, request, body)) return false;
  for (const JsonMember& member : body["values"].members()) {
    const Json& value = member.value;
    if (!value.isText() && !value.isInteger())
      return fail(client, 400, "the value of `" + member.name + "` is not a text"), false;
    const std::string text = value.isText() ? std::string(value.text()) : value.toText();
    Variable variable;
    std::string error;
    if (!session_.symbols().find(member.name, variable, error)) return fail(client, 404, error), false;
    error = checkValue(session_.module(), variable, text);
    if (error.empty() && !isWritableOutside(variable)) error = "`" + member.name + "` is read only for tools outside";
    if (!error.empty()) return fail(client, 400, error), false;
    command.values.push_back({member.name, text});
  }
  if (!command.values.empty()) return true;
  return fail(client, 400, "`values` is missing: an object of paths and values"), false;
}

const char* Monitor::stateName() const {
  switch (state_.load()) {
    case State::Running: return "running";
    case State::Stopped: return "stopped";
    case State::Faulted: return "faulted";
  }
  return "";
}

// In the run's thread.
HttpReply Monitor::obey(const Command& command) {
  const Answer answer = obey_(command);
  if (!answer.error.empty()) return httpError(answer.is_busy ? 409 : 400, answer.error);
  if (answer.hangs) return httpError(409, "a task does not end its activation");
  std::string json = "{\"cycle\":" + std::to_string(cycle_.load() + 1);
  if (const std::string text = answer.text + answer.values; !text.empty()) {
    json += ",\"text\":";
    appendJsonText(json, text);
  }
  if (!answer.warning.empty()) {
    json += ",\"warning\":";
    appendJsonText(json, answer.warning);
  }
  return jsonReply(json += '}');
}

// What is done between activations delays those that are due meanwhile, so its amount has a bound.
void Monitor::askCommand(HttpServer::Client client, Command command) {
  const size_t most = command.kind == Command::Set ? kMostWritten : kMostForced;
  if (command.values.size() > most)
    return fail(client, 400, "more than " + std::to_string(most) + " variables at once");
  ask(client, [this, command = std::move(command)] { return [reply = obey(command)] { return reply; }; });
}

// ---- requests

void Monitor::servePage(HttpServer::Client client, const HttpRequest&) {
  HttpReply reply;
  reply.type = "text/html; charset=utf-8";
  reply.script_nonce = access_.scriptNonce();
  reply.body = pageText(reply.script_nonce);
  server_.reply(client, reply);
}

void Monitor::serveInfo(HttpServer::Client client, const HttpRequest&) {
  const rung_module& module = session_.module().description;
  char hash[20];
  snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(module.layout_hash));
  const Json info{{"name", module.name},
                  {"version", options_.version.empty() ? module.compiler : options_.version},
                  {"engine", options_.engine},
                  {"state", stateName()},
                  {"cycle", cycle_.load()},
                  {"time_ms", static_cast<double>(time_ns_.load()) / 1e6},
                  {"layout_hash", hash},
                  {"changes", changes_.load()},
                  {"rolled_back", was_rolled_back_.load()}};
  server_.reply(client, jsonReply(info.toText()));
}

void Monitor::serveSymbols(HttpServer::Client client, const HttpRequest& request) {
  SymbolPage page;
  if (const std::string* const prefix = request.parameter("prefix")) page.prefix = *prefix;
  if (!readNumber(request, "from", UINT64_MAX, page.from) || !readNumber(request, "count", kMostSymbols, page.count))
    return fail(client, 400, "`from` and `count` are numbers, `count` of at most " + std::to_string(kMostSymbols));
  ask(client, [this, page] {
    return [this, page, forced = session_.forces().names()] {
      return jsonReply(listSymbols(session_.module(), page, forced));
    };
  });
}

void Monitor::serveValues(HttpServer::Client client, const HttpRequest& request) {
  std::vector<std::string> paths;
  if (!readPaths(client, request, paths)) return;
  if (SharedList list = makeList(client, paths)) readers_[client] = {std::move(list), monotonicNs(), false};
}

void Monitor::serveWatch(HttpServer::Client client, const HttpRequest& request) {
  Json body;
  if (!readBody(client, request, body)) return;
  const bool skips_unknown = body["skip_unknown"].isTrue();
  Variable variable;
  std::string error;
  std::vector<std::string> paths;
  Json::Array unknown;
  for (const Json& path : body["paths"].items()) {
    if (skips_unknown && !session_.symbols().find(path.text(), variable, error))
      unknown.push_back(path);
    else
      paths.emplace_back(path.text());
  }
  if (paths.empty() && unknown.empty()) return fail(client, 400, "`paths` is missing: the paths of variables");
  SharedList list = makeList(client, paths);
  if (list == nullptr) return;
  if (lists_.size() == kMostLists) lists_.erase(lists_.begin());  // the oldest one
  lists_[next_list_] = std::move(list);
  std::string json = "{\"id\":" + std::to_string(next_list_++);
  if (skips_unknown) json += ",\"unknown\":" + Json(std::move(unknown)).toText();
  server_.reply(client, jsonReply(json += '}'));
}

// Of `watch=ID` or `paths=…`. Null: the client has its answer.
SharedList Monitor::listOf(HttpServer::Client client, const HttpRequest& request) {
  if (request.parameter("watch") != nullptr) {
    uint64_t id = 0;
    if (!readNumber(request, "watch", UINT64_MAX, id)) return fail(client, 400, "`watch` is a number"), nullptr;
    const auto list = lists_.find(id);
    if (list != lists_.end()) return list->second;
    return fail(client, 404, "there is no list " + std::to_string(id) + " any more; POST its paths to /api/watch"),
           nullptr;
  }
  std::vector<std::string> paths;
  return readPaths(client, request, paths) ? makeList(client, paths) : nullptr;
}

void Monitor::serveStream(HttpServer::Client client, const HttpRequest& request) {
  uint64_t rate = kUsual;
  if (!readNumber(request, "rate", kFastest, rate) || rate == 0)
    return fail(client, 400, "`rate` is a number from 1 to " + std::to_string(kFastest) + ", events a second");
  SharedList list = listOf(client, request);
  if (list == nullptr) return;
  if (streams_.size() == kMostStreams)
    return fail(client, 409, "there are " + std::to_string(kMostStreams) + " streams already");
  server_.beginStream(client);
  streams_[client] = {std::move(list), 1'000'000'000 / static_cast<int64_t>(rate), monotonicNs()};
}

void Monitor::serveWrite(HttpServer::Client client, const HttpRequest& request) {
  Command command;
  command.kind = Command::Set;
  if (readAssignments(client, request, command)) askCommand(client, std::move(command));
}

void Monitor::serveForce(HttpServer::Client client, const HttpRequest& request) {
  Command command;
  command.kind = Command::Force;
  if (readAssignments(client, request, command)) askCommand(client, std::move(command));
}

void Monitor::serveUnforce(HttpServer::Client client, const HttpRequest& request) {
  Json body;
  if (!readBody(client, request, body)) return;
  Command command;
  command.kind = Command::Unforce;
  if (body["all"].isTrue()) command.values.push_back({"*", ""});
  for (const Json& path : body["paths"].items()) {
    Variable variable;
    std::string error;
    if (!session_.symbols().find(path.text(), variable, error)) return fail(client, 404, error);
    command.values.push_back({std::string(path.text()), ""});
  }
  if (command.values.empty()) return fail(client, 400, "either `paths` or `all` is missing");
  askCommand(client, std::move(command));
}

void Monitor::serveForces(HttpServer::Client client, const HttpRequest&) {
  ask(client, [this] {
    return [forced = session_.forces().values()] {
      Json values = Json::emptyObject();
      for (const auto& [path, value] : forced) values.set(path, value);
      return jsonReply(Json{{"values", values}}.toText());
    };
  });
}

void Monitor::serveTasks(HttpServer::Client client, const HttpRequest&) {
  ask(client, [this] { return [json = tasksJson(session_.tasks())] { return jsonReply(json); }; });
}

void Monitor::serveFaults(HttpServer::Client client, const HttpRequest&) {
  ask(client, [this] {
    Command command;
    command.kind = Command::Status;
    return [this, status = session_.obey(command).text] {
      std::string json = log_.faults();
      const std::string reported = reportedFaults(status);
      if (!json.empty() && !reported.empty()) json += ',';
      return jsonReply('[' + json + reported + ']');
    };
  });
}

void Monitor::serveMessages(HttpServer::Client client, const HttpRequest&) {
  server_.reply(client, jsonReply(log_.messages()));
}

void Monitor::serveCommand(HttpServer::Client client, const HttpRequest& request) {
  Json body;
  if (!readBody(client, request, body)) return;
  Command command;
  const std::string error = parseCommand(trimmed(body["command"].text()), command);
  if (!error.empty()) return fail(client, 400, error);
  if (command.kind == Command::Change) return askChange(client, std::move(command));
  if (command.kind != Command::Get) return askCommand(client, std::move(command));
  std::vector<std::string> paths;
  for (const Command::Value& value : command.values) paths.push_back(value.path);
  if (SharedList list = makeList(client, paths)) readers_[client] = {std::move(list), monotonicNs(), true};
}

void Monitor::serveChange(HttpServer::Client client, const HttpRequest& request) {
  Json body;
  if (!readBody(client, request, body)) return;
  Command command;
  command.kind = Command::Change;
  command.project = body["project"].text();
  command.is_only_asked = body["dry_run"].isTrue();
  command.rollback_cycles = body["rollback"].integer(-1);
  askChange(client, std::move(command));
}

// In real time it is compiled while the program goes on, and the client waits.
void Monitor::askChange(HttpServer::Client client, Command command) {
  ask(client, [this, client, command = std::move(command)]() -> MonitorGate::Finish {
    if (is_changing_) return [] { return httpError(409, "another change has begun and is not complete"); };
    const std::optional<Changes::Outcome> outcome = change_(command);
    if (outcome) return [reply = changeReply(*outcome)] { return reply; };
    is_changing_ = true;
    changing_ = client;
    return {};
  });
}

HttpReply Monitor::changeReply(const Changes::Outcome& outcome) const {
  const auto items = [](const std::vector<ChangeReport::Item>& list) {
    Json::Array all;
    for (const ChangeReport::Item& item : list) all.push_back(Json{{"path", item.path}, {"reason", item.reason}});
    return Json(std::move(all));
  };
  Json json = Json::emptyObject();
  const std::string& error = outcome.report.error;
  const size_t line_end = error.find('\n');
  if (!error.empty()) json.set("error", error.substr(0, line_end));
  if (!outcome.is_compiled) {
    json.set("diagnostics", line_end == std::string::npos ? "" : error.substr(line_end + 1));
  } else {
    Json::Array removed;
    for (const ChangeReport::Item& item : outcome.report.removed) removed.push_back(item.path);
    json.set("kept", outcome.report.kept);
    json.set("initialised", items(outcome.report.initialised));
    json.set("removed", std::move(removed));
    json.set("refused", items(outcome.report.refused));
    Json::Array unforced;
    for (const std::string& path : outcome.report.unforced) unforced.push_back(path);
    if (!unforced.empty()) json.set("unforced", std::move(unforced));
    json.set("cycle", cycle_.load() + 1);
  }
  HttpReply reply;
  reply.status = error.empty() ? 200 : outcome.is_compiled ? 409 : 400;
  reply.body = json.toText();
  return reply;
}

void Monitor::servePous(HttpServer::Client client, const HttpRequest&) {
  server_.reply(client, jsonReply(listPous(session_.module(), pous_())));
}

void Monitor::serveDiagram(HttpServer::Client client, const HttpRequest& request) {
  const std::string* const name = request.parameter("pou");
  if (name == nullptr) return fail(client, 400, "`pou` is missing: the name of a POU");
  const rung_pou_view* const pou = findPou(pous_(), *name);
  if (pou == nullptr) return fail(client, 404, "there is no POU `" + *name + "` with a body");
  HttpReply reply;
  reply.body = pou->content;
  if (reply.body[0] == '<') reply.type = "image/svg+xml";
  server_.reply(client, reply);
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
#include "tools/monitor/monitor.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "rung/host.h"
#include "stdlib/runtime/host/change.h"
#include "stdlib/runtime/host/symbols.h"
#include "tools/driver/commands.h"
#include "tools/monitor/client.h"
#include "tools/monitor/recording.h"

namespace rung::monitor {
namespace {

using driver::Sink;

// What a command needs; `rest` are the words after its name, joined by blanks.
struct Call {
  Client& client;
  std::string_view name;
  std::string rest;
  Recording recording;
  Sink& sink;
};

int refused(const Call& call, const Client::Answer& answer) {
  call.sink.error(answer.error);
  return answer.is_refused ? driver::kInputErrors : driver::kUsage;
}

// ---- values

int get(const Call& call) {
  Json paths{Json::Array()};
  for (const std::string& path : host::splitList(call.rest)) paths.add(path);
  const Client::Answer answer = call.client.post("/api/values", Json{{"paths", paths}});
  if (!answer.error.empty()) return refused(call, answer);
  std::string text;
  for (const host::JsonMember& value : answer.value["values"].members())
    text += value.name + " = " + std::string(value.value.text()) + '\n';
  return driver::printResult(call.sink, text);
}

// `PATH=VALUE,…` of `set` and `force`.
int assign(const Call& call) {
  Json values = Json::emptyObject();
  for (const std::string& item : host::splitList(call.rest)) {
    const size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0)
      return driver::usageError(call.sink, "expected PATH=VALUE, not `" + item + "`");
    values.set(std::string(host::trimmed(item.substr(0, equals))), std::string(host::trimmed(item.substr(equals + 1))));
  }
  const std::string path = call.name == "set" ? "/api/write" : "/api/force";
  const Client::Answer answer = call.client.post(path, Json{{"values", values}});
  return answer.error.empty() ? int{driver::kSuccess} : refused(call, answer);
}

int unforce(const Call& call) {
  Json paths{Json::Array()};
  for (const std::string& path : host::splitList(call.rest)) paths.add(path);
  const Json body = call.rest == "*" ? Json{{"all", true}} : Json{{"paths", paths}};
  const Client::Answer answer = call.client.post("/api/unforce", body);
  return answer.error.empty() ? int{driver::kSuccess} : refused(call, answer);
}

int listForces(const Call& call) {
  const Client::Answer answer = call.client.get("/api/forces");
  if (!answer.error.empty()) return refused(call, answer);
  std::string text;
  for (const host::JsonMember& value : answer.value["values"].members())
    text += value.name + " = " + std::string(value.value.text()) + '\n';
  return driver::printResult(call.sink, text);
}

int listSymbols(const Call& call) {
  constexpr int64_t kPage = 10'000;
  for (int64_t from = 0, total = 1; from < total; from += kPage) {
    const Client::Answer answer = call.client.get("/api/symbols?prefix=" + percentEncoded(call.rest) +
                                                  "&from=" + std::to_string(from) + "&count=" + std::to_string(kPage));
    if (!answer.error.empty()) return refused(call, answer);
    total = answer.value["total"].integer();
    std::string text;
    for (const Json& symbol : answer.value["symbols"].items())
      text += std::string(symbol["path"].text()) + " : " + std::string(symbol["type"].text()) +
              (symbol["forced"].isTrue() ? "  (forced)\n" : "\n");
    if (const int exit = driver::printResult(call.sink, text); exit != driver::kSuccess) return exit;
  }
  return driver::kSuccess;
}

int watch(const Call& call) {
  Recording recording = call.recording;
  recording.paths = call.rest;
  recording.file = "-";
  recording.is_table = isatty(fileno(call.sink.programOutput())) != 0;
  return record(call.client, recording, call.sink);
}

// `FILE PATH,…`
int trace(const Call& call) {
  Recording recording = call.recording;
  const size_t blank = call.rest.find(' ');
  if (blank == std::string::npos)
    return driver::usageError(call.sink, "`trace` needs a file and paths: trace out.csv Main.n,Main.level");
  recording.file = call.rest.substr(0, blank);
  recording.paths = call.rest.substr(blank + 1);
  return record(call.client, recording, call.sink);
}

// ---- the program

int showInfo(const Call& call) {
  const Client::Answer answer = call.client.get("/api/info");
  if (!answer.error.empty()) return refused(call, answer);
  std::string text;
  for (const host::JsonMember& member : answer.value.members())
    text +=
        member.name + ": " + (member.value.isText() ? std::string(member.value.text()) : member.value.toText()) + '\n';
  return driver::printResult(call.sink, text);
}

// An array of objects with a `text`, such as faults.
int listTexts(const Call& call) {
  const Client::Answer answer = call.client.get("/api/" + std::string(call.name));
  if (!answer.error.empty()) return refused(call, answer);
  std::string text;
  for (const Json& entry : answer.value.items()) {
    if (!entry["time_ms"].isNull()) text += entry["time_ms"].toText() + " ms: ";
    if (entry["severity"].isText()) text += std::string(entry["severity"].text()) + ": ";
    text += std::string(entry["text"].text()) + '\n';
  }
  return driver::printResult(call.sink, text);
}

int command(const Call& call, const std::string& words) {
  const Client::Answer answer = call.client.post("/api/command", Json{{"command", words}});
  if (!answer.error.empty()) return refused(call, answer);
  if (const std::string_view warning = answer.value["warning"].text(); !warning.empty())
    call.sink.message("warning: " + std::string(warning) + '\n');
  return driver::printResult(call.sink, answer.value["text"].text());
}

// `[dry-run] [rollback=N] [PROJECT]`
Json changeOf(const std::string& text) {
  Json body = Json::emptyObject();
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word == "dry-run")
      body.set("dry_run", true);
    else if (word.starts_with("rollback="))
      body.set("rollback", host::parseJson(word.substr(9)).value);
    else
      body.set("project", std::filesystem::absolute(word).string());
  }
  return body;
}

// Prints what `change` of --control prints.
int change(const Call& call) {
  constexpr int64_t kPatienceMs = 600'000;
  call.client.setPatience(kPatienceMs);
  const Client::Answer answer = call.client.post("/api/change", changeOf(call.rest));
  host::ChangeReport report;
  const auto read = [&](const char* name, std::vector<host::ChangeReport::Item>& items) {
    for (const Json& item : answer.value[name].items())
      items.push_back({std::string(item["path"].text()), std::string(item["reason"].text())});
  };
  report.error = answer.error;
  report.kept = static_cast<uint32_t>(answer.value["kept"].integer());
  read("initialised", report.initialised);
  read("refused", report.refused);
  for (const Json& path : answer.value["removed"].items())
    report.removed.push_back({std::string(path.text()), "the program does not have it any more"});
  for (const Json& path : answer.value["unforced"].items()) report.unforced.emplace_back(path.text());
  if (answer.error.empty()) return driver::printResult(call.sink, report.text());
  call.sink.message(report.text());
  if (const std::string_view said = answer.value["diagnostics"].text(); !said.empty())
    call.sink.message(std::string(said) + '\n');
  return refused(call, answer);
}

int giveCommand(const Call& call) {
  return command(call, call.rest.empty() ? std::string(call.name) : std::string(call.name) + ' ' + call.rest);
}
int showTasks(const Call& call) { return command(call, "status"); }

enum class Needs : uint8_t { Nothing, Anything, Something };
const struct {
  const char* name;
  int (*run)(const Call&);
  Needs needs;
} kCommands[] = {{"get", get, Needs::Something},           {"set", assign, Needs::Something},
                 {"force", assign, Needs::Something},      {"unforce", unforce, Needs::Something},
                 {"forces", listForces, Needs::Nothing},   {"watch", watch, Needs::Something},
                 {"trace", trace, Needs::Something},       {"symbols", listSymbols, Needs::Anything},
                 {"info", showInfo, Needs::Nothing},       {"tasks", showTasks, Needs::Nothing},
                 {"faults", listTexts, Needs::Nothing},    {"messages", listTexts, Needs::Nothing},
                 {"change", change, Needs::Anything},      {"stop", giveCommand, Needs::Nothing},
                 {"start", giveCommand, Needs::Nothing},   {"cycle", giveCommand, Needs::Nothing},
                 {"reset", giveCommand, Needs::Something}, {"event", giveCommand, Needs::Something},
                 {"status", giveCommand, Needs::Nothing},  {"quit", giveCommand, Needs::Nothing}};

std::string commandNames() {
  std::string names;
  for (const auto& row : kCommands)
    names += std::string(&row == kCommands ? "" : &row + 1 == std::end(kCommands) ? " or " : ", ") + row.name;
  return names;
}

}  // namespace

int runMonitor(const std::vector<std::string>& words, uint32_t rate, const driver::RunOptions& run, Sink& sink) {
  Client client;
  if (std::string error = client.readUrl(words[0]); !error.empty()) return driver::usageError(sink, error);
  if (words.size() < 2) return driver::usageError(sink, "expected a command after the URL: " + commandNames());
  host::RunOptions limits;
  std::vector<std::string> others;
  if (std::string error = host::parseRunOptions(run.host_arguments, limits, others); !error.empty())
    return driver::usageError(sink, error);
  Call call{client, words[1], "", {}, sink};
  for (size_t i = 2; i < words.size(); ++i) call.rest += (i == 2 ? "" : " ") + words[i];
  call.recording.rate = rate;
  call.recording.for_ns = limits.for_ns;
  call.recording.rows = limits.cycles;
  for (const auto& row : kCommands) {
    if (call.name != row.name) continue;
    if (row.needs == Needs::Nothing && !call.rest.empty())
      return driver::usageError(sink, "`" + words[1] + "` has nothing after it");
    if (row.needs == Needs::Something && call.rest.empty())
      return driver::usageError(sink, "`" + words[1] + "` needs more words after it; docs/cli/monitor.md shows them");
    return row.run(call);
  }
  return driver::usageError(sink, "`" + words[1] + "` is not a command of the monitor; write " + commandNames());
}

}  // namespace rung::monitor

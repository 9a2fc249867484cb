// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/suite.h"

#include <algorithm>

#include "frontend/source/files.h"
#include "frontend/source/render.h"

namespace rung::conformance {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  for (size_t at = 0; at <= line.size();) {
    const size_t end = std::min(line.find('\t', at), line.size());
    all.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  return all;
}

class Json {
 public:
  void field(const char* name, const std::string& value) {
    if (!value.empty()) add(name, jsonQuote(value));
  }
  void field(const char* name, int64_t value) { add(name, std::to_string(value)); }
  void field(const char* name, const std::vector<std::string>& values) {
    std::string list;
    for (const std::string& value : values) list += (list.empty() ? "" : ", ") + jsonQuote(value);
    add(name, "[" + list + "]");
  }
  void add(const char* name, const std::string& value) {
    text_ += (text_.empty() ? "" : ", ") + jsonQuote(name) + ": " + value;
  }
  std::string object() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

std::string caseObject(const Case& one) {
  Json json;
  json.field("id", one.id);
  json.field("profile", std::string(one.profile->name));
  json.field("edition", one.profile->edition);
  json.field("purpose", one.purpose);
  json.field("features", one.features);
  json.field("source", one.source);
  json.field("kind", std::string(one.isRun() ? "run" : "reject"));
  if (one.isRun()) {
    json.field("cycles", one.cycles);
    json.field("interval_ms", one.interval_ns / 1'000'000);
    if (one.restart_after > 0) json.field("restart_after", one.restart_after);
    json.field("watch", one.watch);
    if (!one.checks.empty()) json.field("checks", one.checks);
    json.field("trace", one.id + ".trace.csv");
    if (!one.inputs.empty()) json.field("inputs", one.id + ".inputs.csv");
  } else {
    json.field("line", one.line);
    json.field("rule", one.rule);
    json.field("control", one.control);
  }
  Json needs;
  needs.field("types", one.types);
  needs.field("blocks", one.blocks);
  needs.field("languages", one.languages);
  json.add("needs", needs.object());
  json.field("program", one.program);
  json.field("test", one.test);
  return json.object();
}

}  // namespace

const Profile kProfiles[5] = {{"ed2-text", Dialect::Iec2, 2},
                              {"ed3-text", Dialect::Iec3, 3},
                              {"ed3-oop", Dialect::Iec3, 3},
                              {"plcopen-xml", Dialect::Iec3, 3},
                              {"motion", Dialect::Iec3, 3}};

const Profile* findProfile(std::string_view name) {
  for (const Profile& profile : kProfiles)
    if (profile.name == name) return &profile;
  return nullptr;
}

std::set<std::string> Suite::exported() const {
  std::set<std::string> all;
  for (const Case& one : cases) all.insert(one.features.begin(), one.features.end());
  return all;
}

std::string readTables(const std::string& root, Suite& suite) {
  const ReadResult features = readFile(root + "/tests/conformance/features.tsv");
  if (!features.error.empty()) return "tests/conformance/features.tsv: " + features.error;
  std::string table;
  for (const std::string& line : linesOf(features.content)) {
    const std::vector<std::string> row = cells(line);
    if (row.size() < 3 || row[0] == "feature") continue;
    if (row[1].empty())
      table = row[2];
    else
      suite.features.push_back({row[0], row[1], row[2], table});
  }
  const ReadResult reasons = readFile(root + "/tools/conformance/reasons.tsv");
  if (!reasons.error.empty()) return "tools/conformance/reasons.tsv: " + reasons.error;
  for (const std::string& line : linesOf(reasons.content)) {
    const std::vector<std::string> row = cells(line);
    if (row.size() < 2 || row[0] == "feature") continue;
    for (const std::string& feature : wordsOf(row[0])) suite.reasons[feature] = row[1];
  }
  return {};
}

std::string manifest(const Suite& suite, const std::vector<const Profile*>& profiles) {
  const std::set<std::string> exported = suite.exported();
  std::string out = "{\n\"format\": 1,\n\"profiles\": [";
  for (size_t i = 0; i < profiles.size(); ++i) out += (i == 0 ? "" : ", ") + jsonQuote(profiles[i]->name);
  out += "],\n\"features\": [\n";
  const char* separator = "";
  for (const Feature& feature : suite.features) {
    if (exported.count(feature.id) == 0) continue;
    Json json;
    json.field("id", feature.id);
    json.field("name", feature.name);
    json.field("table", feature.table);
    json.field("editions", feature.editions);
    out += separator + json.object();
    separator = ",\n";
  }
  out += "\n],\n\"cases\": [\n";
  separator = "";
  for (const Case& one : suite.cases) {
    out += separator + caseObject(one);
    separator = ",\n";
  }
  return out + "\n]\n}\n";
}

std::string rowTable(const Suite& suite) {
  std::map<std::string, std::vector<std::string>> by_feature;
  for (const Case& one : suite.cases)
    for (const std::string& feature : one.features) by_feature[feature].push_back(one.id);
  std::string out = "feature\tname\tcases\treason\n";
  for (const Feature& feature : suite.features) {
    if (feature.editions.find('3') == std::string::npos) continue;
    const auto found = by_feature.find(feature.id);
    const auto reason = suite.reasons.find(feature.id);
    out += feature.id + "\t" + feature.name + "\t" + (found == by_feature.end() ? "" : joined(found->second, " ")) +
           "\t" + (found != by_feature.end() || reason == suite.reasons.end() ? "" : reason->second) + "\n";
  }
  return out;
}

std::string refusalTable(const Suite& suite) {
  std::string out = "program\ttest\treason\tfeatures\n";
  for (const Refusal& refusal : suite.refusals)
    out += refusal.program + "\t" + refusal.test + "\t" + refusal.reason + "\t" + joined(refusal.features, " ") + "\n";
  return out;
}

}  // namespace rung::conformance

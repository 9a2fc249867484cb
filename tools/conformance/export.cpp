// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/export.h"

#include <algorithm>
#include <filesystem>

#include "frontend/source/files.h"
#include "frontend/source/scanner.h"
#include "tools/conformance/edition.h"
#include "tools/conformance/parts.h"
#include "tools/driver/output_files.h"

namespace rung::conformance {
namespace {

namespace fs = std::filesystem;

// Longer tests are run to this cycle to find their end.
constexpr int64_t kMostCycles = 100'000;
constexpr int kMostRemovals = 60;

constexpr const char* kTypes[] = {
    "BOOL",  "SINT",   "INT",     "DINT", "LINT",  "USINT",       "UINT", "UDINT", "ULINT",         "REAL",
    "LREAL", "TIME",   "LTIME",   "DATE", "LDATE", "TIME_OF_DAY", "TOD",  "LTOD",  "DATE_AND_TIME", "DT",
    "LDT",   "STRING", "WSTRING", "CHAR", "WCHAR", "BYTE",        "WORD", "DWORD", "LWORD"};

// The libraries whose blocks are those of the standard, and of PLCopen's motion control.
constexpr const char* kStandardLibrary = "Standard";

std::vector<std::string> typesIn(std::string_view text) {
  std::set<std::string> found;
  Scanner scanner(text);
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
    if (unit.kind != UnitKind::Name) continue;
    const std::string name = upper(scanner.textOf(unit));
    if (std::find(std::begin(kTypes), std::end(kTypes), name) != std::end(kTypes)) found.insert(name);
  }
  return {found.begin(), found.end()};
}

std::string firstError(const Checked& checked) {
  if (checked.errors.empty()) return "it cannot be read";
  const Complaint& first = checked.errors[0];
  return "line " + std::to_string(first.line) + ": " + first.code + ": " + first.message;
}

uint32_t lineAt(const std::string& text, size_t at) {
  return 1 + static_cast<uint32_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

std::string commentOf(std::string text) {
  std::string out;
  for (const char c : text)
    if (c != '*' && c != '{' && c != '}' && c != '$' && static_cast<unsigned char>(c) >= 32 &&
        static_cast<unsigned char>(c) < 127)
      out += c;
  return "(* " + out + " *)";
}

class Exporter {
 public:
  Exporter(const ExportOptions& options, Suite& suite) : options_(options), suite_(suite) {}

  std::string run() {
    if (std::string error = readRules(); !error.empty()) return error;
    std::vector<std::string> paths;
    if (std::string error = findPrograms(options_, paths); !error.empty()) return error;
    for (const std::string& path : paths) {
      Program program = readProgram(options_.root, path);
      if (path.starts_with("tests/programs/") && (program.features.empty() || program.trace.empty())) continue;
      exportProgram(program);
      if (!problem_.empty()) return problem_;
    }
    return {};
  }

 private:
  std::string readRules() {
    const ReadResult rules = readFile(options_.root + "/tools/conformance/rules.tsv");
    if (!rules.error.empty()) return "tools/conformance/rules.tsv: " + rules.error;
    for (const std::string& line : linesOf(rules.content)) {
      const size_t tab = line.find('\t');
      if (tab != std::string::npos) rules_[line.substr(0, tab)] = line.substr(tab + 1);
    }
    if (std::string error = readVocabulary(options_.root, vocabulary_); !error.empty()) return error;
    const ReadResult kept = readFile(options_.root + "/tools/conformance/kept.tsv");
    if (!kept.error.empty()) return "tools/conformance/kept.tsv: " + kept.error;
    for (const std::string& line : linesOf(kept.content)) {
      const size_t tab = line.find('\t');
      if (tab != std::string::npos) kept_[line.substr(0, tab)] = line.substr(tab + 1);
    }
    return {};
  }

  // Returns what the text has that the edition of the profile does not; empty: nothing.
  std::string foreignIn(const std::string& text, const Profile& profile) const {
    const Source source(text, profile.dialect);
    return foreignTo(profile.edition, source, vocabulary_);
  }

  // Without the folder, which is another one each time.
  void refuse(const Program& program, const std::string& test, std::string reason) {
    const std::string folder = options_.folder + "/";
    for (size_t at = reason.find(folder); at != std::string::npos; at = reason.find(folder))
      reason.erase(at, folder.size());
    suite_.refusals.push_back({program.path, test, std::move(reason), program.features});
  }

  // tests/conformance/standard/table43/rs.st → table43/rs
  static std::string stemOf(const Program& program) {
    std::string path = program.path.substr(program.path.find('/') + 1);
    if (path.starts_with("conformance/")) path = path.substr(path.find('/', 12) + 1);  // without the group
    return path.substr(0, path.rfind('.'));
  }

  void exportProgram(Program& program) {
    const bool is_xml = program.path.ends_with(".xml");
    if (!program.others.empty()) return refuse(program, {}, "needs further files");
    if (program.faults) return refuse(program, {}, "ends in a fault, whose form the standard leaves open");
    if (program.features.empty() && !program.expects && program.path.find("/motion/plcopen_") == std::string::npos)
      return refuse(program, {}, "names no row of the standard's tables");
    if (isOfEdition4(program)) return refuse(program, {}, "of edition 4");
    if (const auto reason = kept_.find(program.path); reason != kept_.end()) return refuse(program, {}, reason->second);
    if (is_xml) {
      program.text = asSt(options_.root + "/" + program.path);
      if (program.text.empty()) return refuse(program, {}, "it cannot be read");
    }
    for (auto one = kept_.lower_bound(program.path + ":"); one != kept_.end(); ++one) {
      if (!one->first.starts_with(program.path + ":")) break;
      program.choices.insert(one->first.substr(program.path.size() + 1));
    }
    for (Draft& draft : neutralDrafts(program)) {
      if (const auto reason = kept_.find(program.path + ":" + draft.test); reason != kept_.end())
        draft.reason = reason->second;
      if (!draft.reason.empty()) {
        refuse(program, draft.test, draft.reason);
        continue;
      }
      exportDraft(program, draft, is_xml);
      if (!problem_.empty()) return;
    }
  }

  bool isOfEdition4(const Program& program) const {
    return !program.features.empty() &&
           std::all_of(program.features.begin(), program.features.end(), [&](const auto& id) {
             return std::any_of(suite_.features.begin(), suite_.features.end(),
                                [&](const Feature& one) { return one.id == id && one.editions == "4"; });
           });
  }

  bool isWanted(const char* name) const {
    return std::any_of(options_.profiles.begin(), options_.profiles.end(),
                       [&](const Profile* profile) { return std::string_view(profile->name) == name; });
  }

  void exportDraft(const Program& program, const Draft& draft, bool is_xml) {
    std::string why;
    size_t made = 0;
    std::vector<const char*> names;
    if (draft.has_networks || is_xml)
      names = {"plcopen-xml"};
    else if (draft.has_objects)
      names = {"ed3-oop", "motion"};
    else
      names = {"ed2-text", "ed3-text", "motion"};
    for (const char* name : names) {
      if (!isWanted(name)) continue;
      const size_t before = suite_.cases.size();
      const auto kept =
          kept_.find(std::string(name) + ":" + program.path + (draft.test.empty() ? "" : ":" + draft.test));
      std::string foreign = kept == kept_.end() ? std::string() : kept->second;
      if (foreign.empty() && !program.expects && !is_xml && !draft.has_networks)
        foreign = foreignIn(draft.text, *findProfile(name));
      if (!foreign.empty()) {
        if (why.empty() || std::string_view(name) == "ed3-text") why = foreign;
        continue;
      }
      std::string reason = program.expects ? exportErrors(program, draft, *findProfile(name))
                                           : exportRun(program, draft, *findProfile(name));
      made += suite_.cases.size() - before;
      if (!reason.empty() && (why.empty() || std::string_view(name) == "ed3-text")) why = reason;
      if (!problem_.empty()) return;
    }
    if (made == 0 && !why.empty()) refuse(program, draft.test, why);
  }

  Case caseOf(const Program& program, const Draft& draft, const Profile& profile, const std::string& last) const {
    Case one;
    one.id = std::string(profile.name) + "/" + stemOf(program) + (last.empty() ? "" : "/" + last);
    one.profile = &profile;
    one.program = program.path;
    one.test = draft.test;
    one.purpose = program.purpose;
    one.features = program.features;
    one.languages = draft.languages;
    one.types = typesIn(draft.text);
    return one;
  }

  bool write(const std::string& path, const std::string& text) {
    const std::string full = options_.folder + "/" + path;
    std::error_code error;
    fs::create_directories(fs::path(full).parent_path(), error);
    const std::string problem = driver::writeFile(full, text);
    if (!problem.empty()) problem_ = "cannot write `" + full + "`: " + problem;
    return problem.empty();
  }
  void remove(const std::string& path) const {
    std::error_code error;
    fs::remove(options_.folder + "/" + path, error);
    for (fs::path folder = fs::path(options_.folder + "/" + path).parent_path(); !error && folder != options_.folder;
         folder = folder.parent_path())
      if (!fs::is_empty(folder, error) || !fs::remove(folder, error)) break;
  }

  // ---- runs

  std::string libraryReason(const Checked& checked, const Profile& profile, Case& one) const {
    bool has_motion = false;
    for (const auto& [name, library] : checked.library_pous) {
      one.blocks.push_back(name);
      if (library == kStandardLibrary) continue;
      const bool is_motion =
          name.starts_with("MC_") && !name.starts_with("MC_CAM_") && (library == "SM3_Basic" || library == "Motion");
      if (!is_motion) return "uses `" + name + "` of the library " + library;
      has_motion = true;
    }
    const bool for_motion = std::string_view(profile.name) == "motion";
    if (has_motion && !for_motion) return "uses motion control";
    if (!has_motion && for_motion) return "uses no motion control";
    return {};
  }

  // Empty: a case was made.
  std::string exportRun(const Program& program, const Draft& draft, const Profile& profile) {
    if (draft.test.empty() && program.trace.empty()) return "has no test";
    Case one = caseOf(program, draft, profile, draft.test);
    const std::string file = one.id + ".st";
    if (!write(file, commentOf(one.id) + draft.text)) return {};
    const std::string reason = tryRun(program, draft, file, one);
    if (!reason.empty()) {
      remove(file);
      return reason;
    }
    one.source = file;
    if (std::string_view(profile.name) == "plcopen-xml") {
      const std::string problem = printXml(program, draft, one);
      remove(file);
      if (!problem.empty()) return problem;
    }
    std::string trace;
    for (const std::string& line : one.trace) trace += line + "\n";
    if (!write(one.id + ".trace.csv", trace)) return {};
    if (!one.inputs.empty() && !write(one.id + ".inputs.csv", one.inputs)) return {};
    suite_.cases.push_back(std::move(one));
    return {};
  }

  std::string tryRun(const Program& program, const Draft& draft, const std::string& file, Case& one) {
    const std::string path = options_.folder + "/" + file;
    const Checked checked = check(path, one.profile->dialect);
    if (!checked.errors.empty() || checked.refused) return firstError(checked);
    if (one.profile->edition == 2 && !checked.conversions.empty())
      return "line " + std::to_string(checked.conversions[0]) + ": an implicit conversion, which is of edition 3";
    const bool is_draft_of_xml = std::string_view(one.profile->name) == "plcopen-xml" && !file.ends_with(".xml");
    if (std::string reason = libraryReason(checked, *one.profile, one); !reason.empty() && !is_draft_of_xml)
      return reason;
    return program.trace.empty() ? tryTest(draft, path, one) : tryTrace(program, path, one);
  }

  // Of a test: every check holds in the plain form, too.
  static std::string tryTest(const Draft& draft, const std::string& path, Case& one) {
    one.watch = draft.watch;
    one.checks = draft.checks;
    one.cycles = std::max<int64_t>(draft.cycles, 1);
    if (!draft.done.empty()) {
      one.cycles = cyclesUntil(draft.done, path, one.profile->dialect);
      if (one.cycles == 0) return "`done` does not become TRUE";
    }
    RunSetting setting;
    setting.cycles = one.cycles;
    setting.watch = one.watch;
    const Ran ran = conformance::run(path, one.profile->dialect, setting);
    if (ran.exit != 0) return "faults: " + ran.messages.substr(0, ran.messages.find('\n'));
    if (ran.trace.size() != static_cast<size_t>(one.cycles) + 1) return "has no trace";
    const std::vector<std::string> last = valuesOf(ran.trace.back());
    bool any = false;
    for (size_t i = 0; i < last.size(); ++i) {
      if (last[i] == "2") return "in its plain form the check `" + draft.checks[i] + "` fails";
      any = any || last[i] == "1";
    }
    if (!any) return "no check is reached";
    one.trace = changedRows(ran.trace);
    return {};
  }
  static int64_t cyclesUntil(const std::string& done, const std::string& path, Dialect dialect) {
    for (int64_t most = 500; most <= kMostCycles; most *= 200) {
      RunSetting setting;
      setting.cycles = most;
      setting.watch = {done};
      const Ran ran = conformance::run(path, dialect, setting);
      for (size_t row = 1; row < ran.trace.size(); ++row)
        if (ran.trace[row].ends_with(",TRUE")) return static_cast<int64_t>(row);
      if (ran.exit != 0) return 0;
    }
    return 0;
  }
  // The cells after `cycle,time_ms`.
  static std::vector<std::string> valuesOf(const std::string& row) {
    std::vector<std::string> values;
    size_t at = row.find(',', row.find(',') + 1) + 1;
    while (at <= row.size()) {
      const size_t end = std::min(row.find(',', at), row.size());
      values.push_back(row.substr(at, end - at));
      at = end + 1;
    }
    return values;
  }
  static std::string withoutTime(const std::string& row) {
    const size_t first = row.find(','), second = row.find(',', first + 1);
    return row.substr(0, first) + row.substr(second);
  }
  // The first row, each that differs from the one before it, and the last one.
  static std::vector<std::string> changedRows(const std::vector<std::string>& trace) {
    std::vector<std::string> rows = {withoutTime(trace[0])};
    std::string before;
    for (size_t i = 1; i < trace.size(); ++i) {
      const std::string row = withoutTime(trace[i]);
      const std::string values = row.substr(row.find(','));
      if (values != before || i + 1 == trace.size()) rows.push_back(row);
      before = values;
    }
    return rows;
  }

  // Of a program with a trace: the author's.
  std::string tryTrace(const Program& program, const std::string& path, Case& one) {
    RunSetting setting;
    const size_t time = program.trace[0].find("cycle,time_ms,");
    if (time != 0) return "its trace has no `cycle,time_ms`";
    if (program.text.find("CONFIGURATION") == std::string::npos) return "its task is Rung's own";
    std::string sets[] = {"cycle", "0"};
    const std::string folder = options_.root + "/" + program.path.substr(0, program.path.rfind('/') + 1);
    for (size_t i = 0; i < program.arguments.size(); ++i) {
      const std::string& option = program.arguments[i];
      const bool has_value = i + 1 < program.arguments.size();
      if (option == "--cycles" && has_value) {
        setting.cycles = std::strtoll(program.arguments[++i].c_str(), nullptr, 10);
      } else if (option == "--watch" && has_value) {
        ++i;
      } else if (option == "--inputs" && has_value) {
        one.inputs = readFile(folder + program.arguments[++i]).content;
        setting.options.push_back("--inputs=" + folder + program.arguments[i]);
      } else if (option == "--set" && has_value) {
        const std::string& set = program.arguments[++i];
        const size_t equals = set.find('=');
        sets[0] += "," + set.substr(0, equals);
        sets[1] += "," + set.substr(equals + 1);
      } else if (!option.starts_with("--std=")) {
        return "is run with `" + option + "`";
      }
    }
    if (sets[0] != "cycle") {
      if (!one.inputs.empty()) return "is run with --set and --inputs";
      one.inputs = sets[0] + "\n" + sets[1] + "\n";
      const std::string given = path + ".inputs";
      problem_ = driver::writeFile(given, one.inputs);
      setting.options.push_back("--inputs=" + given);
    }
    const std::string state = path + ".state";
    one.restart_after = program.restart;
    if (program.restart > 0) {
      setting.options.push_back("--retain=" + state);
      RunSetting before = setting;
      before.cycles = program.restart;
      conformance::run(path, one.profile->dialect, before);
      std::erase_if(setting.options, [](const std::string& option) { return option.starts_with("--inputs="); });
    }
    one.watch = {};
    for (const std::string& name : valuesOf(program.trace[0])) one.watch.push_back(name);
    setting.watch = one.watch;
    one.cycles = setting.cycles;
    const Ran ran = conformance::run(path, one.profile->dialect, setting);
    std::error_code error;
    fs::remove(path + ".inputs", error);
    fs::remove(state, error);
    if (ran.exit != 0) return "faults: " + ran.messages.substr(0, ran.messages.find('\n'));
    if (ran.trace != program.trace) return "in its plain form the trace differs";
    one.trace.clear();
    for (const std::string& row : ran.trace) one.trace.push_back(withoutTime(row));
    return {};
  }

  // The element `<name key …>…</name>` that contains `key` in its opening tag; empty: there is none.
  static std::string_view elementOf(std::string_view xml, const std::string& name, const std::string& key) {
    for (size_t at = xml.find("<" + name); at != std::string_view::npos; at = xml.find("<" + name, at + 1)) {
      const size_t tag = xml.find('>', at);
      if (tag == std::string_view::npos) return {};
      if (!key.empty() && xml.substr(at, tag - at).find(key) == std::string_view::npos) continue;
      if (xml[tag - 1] == '/') return xml.substr(at, tag + 1 - at);
      const size_t end = xml.find("</" + name + ">", tag);
      return end == std::string_view::npos ? std::string_view() : xml.substr(at, end + name.size() + 3 - at);
    }
    return {};
  }
  static void replaceElement(std::string& in, const std::string& name, const std::string& key, std::string_view by) {
    const std::string_view old = elementOf(in, name, key);
    if (!old.empty()) in.replace(static_cast<size_t>(old.data() - in.data()), old.size(), by);
  }

  // A drawing stays as its author drew it; only the test and the configuration are replaced by the printed ones, and
  // what vendors added is left out.
  std::string withPrintedTest(const Program& program, const Draft& draft, const std::string& printed) const {
    std::string xml = readFile(options_.root + "/" + program.path).content;
    for (size_t at = xml.find("<!--"); at != std::string::npos; at = xml.find("<!--")) {
      const size_t end = xml.find("-->", at);
      if (end == std::string::npos) break;
      xml.erase(at, end + 3 + (xml.substr(end + 3, 1) == "\n" ? 1 : 0) - at);
    }
    while (!elementOf(xml, "addData", {}).empty()) replaceElement(xml, "addData", {}, {});
    if (draft.test.empty()) return xml;
    const std::string key = "name=\"" + draft.test + "\"";
    replaceElement(xml, "pou", key, elementOf(printed, "pou", key));
    replaceElement(xml, "instances", {}, elementOf(printed, "instances", {}));
    return xml;
  }

  // The case as TC6 XML, which Rung reads back and passes.
  std::string printXml(const Program& program, const Draft& draft, Case& one) {
    std::string xml = asXml(options_.folder + "/" + one.source, options_.folder + "/scratch");
    std::error_code error;
    fs::remove_all(options_.folder + "/scratch", error);
    if (program.path.ends_with(".xml")) xml = withPrintedTest(program, draft, xml);
    if (xml.empty()) return "has no form in PLCopen XML";
    const std::string file = one.id + ".xml";
    if (!write(file, xml)) return {};
    one.blocks.clear();
    const std::string reason = tryRun(program, draft, file, one);
    if (!reason.empty()) {
      remove(file);
      return "as XML: " + reason;
    }
    one.source = file;
    return {};
  }

  // ---- errors that are due

  std::string exportErrors(const Program& program, const Draft& draft, const Profile& profile) {
    if (std::string_view(profile.name) == "plcopen-xml") return "expects errors of a drawing";
    const std::string scratch = std::string(profile.name) + "/scratch.st";
    const std::vector<Complaint> found = tryText(scratch, draft.text, profile.dialect);
    std::string why = program.errors.empty() ? "expects warnings" : "expects no error that the standard demands";
    std::set<uint32_t> done;
    for (const Expectation& due : program.errors) {
      const bool is_there = std::any_of(found.begin(), found.end(), [&](const Complaint& one) {
        return one.code == due.code && one.line == due.line;
      });
      const auto rule = rules_.find(due.code);
      if (rule == rules_.end() || rule->second.starts_with("-") || !done.insert(due.line).second) continue;
      if (!is_there) {
        why = due.code + " of line " + std::to_string(due.line) + " is an error of another dialect";
        continue;
      }
      if (!exportError(program, draft, profile, due, rule->second)) why = due.code + " cannot be isolated";
    }
    remove(scratch);
    return why;
  }

  std::vector<Complaint> tryText(const std::string& file, const std::string& text, Dialect dialect) {
    if (!write(file, text)) return {};
    return check(options_.folder + "/" + file, dialect).errors;
  }

  bool exportError(const Program& program, const Draft& draft, const Profile& profile, const Expectation& due,
                   const std::string& rule) {
    const std::string scratch = std::string(profile.name) + "/scratch.st";
    std::string alone = draft.text, control;
    if (!removeErrors(scratch, alone, profile.dialect, due.line)) return false;
    control = alone;
    if (!removeErrors(scratch, control, profile.dialect, 0)) return false;
    if (control.find_first_not_of(" \n") == std::string::npos || !foreignIn(control, profile).empty()) return false;
    if (!foreignWordIn(Source(alone, profile.dialect), profile.edition, vocabulary_).empty()) return false;
    Case one = caseOf(program, draft, profile, "line_" + std::to_string(due.line));
    one.line = due.line;
    one.code = due.code;
    one.rule = rule;
    one.types = typesIn(alone);
    one.source = one.id + ".st";
    one.control = one.id + ".control.st";
    const Checked libraries = [&] {
      write(one.control, commentOf(one.id) + control);
      return check(options_.folder + "/" + one.control, profile.dialect);
    }();
    const bool converts = profile.edition == 2 && !libraries.conversions.empty();
    if (!libraries.errors.empty() || converts || !libraryReason(libraries, profile, one).empty() ||
        !write(one.source, commentOf(one.id) + alone)) {
      remove(one.control);
      return false;
    }
    suite_.cases.push_back(std::move(one));
    return true;
  }

  // Blanks what is wrong on other lines than `kept` (0: on all), from the innermost part outwards.
  bool removeErrors(const std::string& scratch, std::string& text, Dialect dialect, uint32_t kept) {
    std::map<uint32_t, size_t> tried;
    for (int i = 0; i < kMostRemovals; ++i) {
      const std::vector<Complaint> errors = tryText(scratch, text, dialect);
      const bool is_left =
          std::any_of(errors.begin(), errors.end(), [&](const Complaint& one) { return one.line == kept; });
      if (kept != 0 && !is_left) return false;
      const auto other =
          std::find_if(errors.begin(), errors.end(), [&](const Complaint& one) { return one.line != kept; });
      if (other == errors.end()) {
        blankEmptySections(text);
        return true;
      }
      if (other->line == 0) return false;
      std::vector<Part> parts = partsAround(text, dialect, other->line);
      std::erase_if(parts, [&](const Part& part) {
        return text.find_first_not_of(" \n", part.begin) >= part.end ||
               (kept != 0 && lineAt(text, part.begin) <= kept && kept <= lineAt(text, part.end));
      });
      const size_t level = tried[other->line]++;
      if (level > 6 || parts.empty()) return false;
      blank(text, parts[0]);
    }
    return false;
  }

  const ExportOptions& options_;
  Suite& suite_;
  std::map<std::string, std::string> rules_, kept_;
  Vocabulary vocabulary_;
  std::string problem_;
};

}  // namespace

std::string findPrograms(const ExportOptions& options, std::vector<std::string>& paths) {
  paths = filesBelow(options.root, "tests/conformance", {".st", ".xml"});
  for (const std::string& path : filesBelow(options.root, "tests/programs", {".st", ".xml"})) paths.push_back(path);
  const auto isAmong = [](const std::vector<std::string>& all, const std::string& path) {
    return std::find(all.begin(), all.end(), path) != all.end();
  };
  for (const std::string& wanted : options.programs)
    if (!isAmong(paths, wanted))
      return "`" + wanted + "` is not a program of tests/conformance or tests/programs below `" + options.root + "`";
  if (!options.programs.empty())
    std::erase_if(paths, [&](const std::string& path) { return !isAmong(options.programs, path); });
  return {};
}

std::string exportSuite(const ExportOptions& options, Suite& suite) { return Exporter(options, suite).run(); }

}  // namespace rung::conformance

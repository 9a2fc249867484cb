// SPDX-License-Identifier: Apache-2.0
// rung.project; see project_file.h.
#include "tools/driver/project_file.h"

#include <charconv>

#include "frontend/import/source_mapped_text.h"
#include "frontend/parse/literals.h"
#include "frontend/parse/parse.h"
#include "frontend/source/scanner.h"
#include "tools/driver/diagnostics.h"
#include "tools/driver/libraries.h"
#include "tools/driver/project_axes.h"
#include "tools/driver/project_modules.h"

namespace rung::driver {
namespace {

constexpr ProjectSchema kSchemas[] = {
    {"project", false, "name sources std native-width edge-coils libraries checks optimize warnings defines globals"},
    {"task", true, "kind interval priority trigger watchdog sensitivity duration programs"},
    {"module", true, "type station task inputs outputs"},
    {"axis", true, nullptr},  // project_axes.cpp checks them
    {"area", true, "owner bytes"},
    {"safe", false, nullptr},  // PATH = VALUE
    {"nc", false, nullptr},
    {"fmt", false, "keywords align width indent blank_lines"},
    {"nct", false, "plc_period time_slice plcnvram plcram"},
    {"pool", true, nullptr},  // `new`: bytes
};

const ProjectSchema* findSchema(std::string_view kind) {
  for (const ProjectSchema& schema : kSchemas)
    if (kind == schema.kind) return &schema;
  return nullptr;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

std::vector<std::string> list(std::string_view value) {
  std::vector<std::string> items;
  for (std::string_view part : split(value, ','))
    if (std::string_view item = trim(part); !item.empty()) items.emplace_back(item);
  return items;
}

class Reader {
 public:
  Reader(const Sources& sources, FileId file, Diagnostics& diagnostics, ProjectFile& project)
      : source_(sources.sourceText(file)), base_(sources.begin(file)), diagnostics_(diagnostics), project_(project) {}

  void read() {
    for (size_t begin = 0; begin < source_.size();) {
      size_t end = source_.find('\n', begin);
      if (end == std::string_view::npos) end = source_.size();
      readLine(trim(source_.substr(begin, end - begin)));
      begin = end + 1;
    }
  }

 private:
  Loc loc(std::string_view part) const { return {base_.offset + static_cast<uint32_t>(part.data() - source_.data())}; }

  void readLine(std::string_view line) {
    if (line.empty() || line[0] == '#' || line[0] == ';') return;
    if (line[0] == '[') return readHeader(line);

    size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      diagnostics_.report(diag::ProjectLine, loc(line)).length(static_cast<uint32_t>(line.size()));
      return;
    }
    std::string_view key = trim(line.substr(0, equals)), value = trim(line.substr(equals + 1));
    if (project_.sections.empty()) {
      diagnostics_.report(diag::ProjectNoSection, loc(line), {key}).length(static_cast<uint32_t>(key.size()));
      return;
    }
    if (schema_ == nullptr) return;  // the section was reported
    if (schema_->keys != nullptr && !known(key)) return;
    for (const ProjectEntry& entry : project_.sections.back().entries) {
      if (entry.key != key) continue;
      diagnostics_.report(diag::DuplicateKey, loc(key), {key})
          .length(static_cast<uint32_t>(key.size()))
          .declaredHere(entry.key_loc);
      return;
    }
    // An empty value still has a location: one past the sign.
    Loc value_loc = value.empty() ? loc(line.substr(equals)) : loc(value);
    project_.sections.back().entries.push_back({std::string(key), std::string(value), loc(key), value_loc});
  }

  void readHeader(std::string_view line) {
    size_t close = line.find(']');
    std::string_view inner = trim(line.substr(1, close == std::string_view::npos ? close : close - 1));
    size_t blank = inner.find_first_of(" \t");
    std::string_view kind = inner.substr(0, blank);
    std::string_view name = blank == std::string_view::npos ? std::string_view() : trim(inner.substr(blank));
    schema_ = findSchema(kind);
    if (close == std::string_view::npos || inner.empty()) {
      diagnostics_.report(diag::ProjectLine, loc(line)).length(static_cast<uint32_t>(line.size()));
    } else if (schema_ == nullptr) {
      std::vector<std::string_view> kinds;
      for (const ProjectSchema& schema : kSchemas) kinds.push_back(schema.kind);
      diagnostics_.report(diag::ProjectUnknownSection, loc(kind), {kind})
          .length(static_cast<uint32_t>(kind.size()))
          .didYouMean(nearest(kind, kinds));
    } else if (schema_->named != !name.empty()) {
      diagnostics_.report(schema_->named ? diag::ProjectSectionName : diag::ProjectSectionNoName, loc(kind), {kind})
          .length(static_cast<uint32_t>(inner.size()));
    }
    project_.sections.push_back({std::string(kind), std::string(name), loc(line), {}});
  }

  bool known(std::string_view key) {
    std::vector<std::string_view> keys = split(schema_->keys, ' ');
    for (std::string_view k : keys)
      if (k == key) return true;
    diagnostics_.report(diag::ProjectUnknownKey, loc(key), {key, schema_->kind})
        .length(static_cast<uint32_t>(key.size()))
        .didYouMean(nearest(key, keys));
    return false;
  }

  std::string_view source_;
  Loc base_;
  Diagnostics& diagnostics_;
  ProjectFile& project_;
  const ProjectSchema* schema_ = nullptr;
};

void readProjectSection(const ProjectSection& section, Diagnostics& diagnostics, ProjectFile& project) {
  for (const ProjectEntry& entry : section.entries) {
    std::string error;
    if (entry.key == "name") {
      project.name = entry.value;
      if (!isModuleName(entry.value)) error = "it takes letters, digits and `_`";
    } else if (entry.key == "sources") {
      project.sources = list(entry.value);
      if (project.sources.empty()) error = "it takes paths, separated by commas";
    } else if (entry.key == "libraries") {
      project.libraries = list(entry.value);
    } else if (entry.key == "std") {
      project.has_dialect = true;
      error = parseDialect(entry.value, project.dialect);
    } else if (entry.key == "native-width") {
      project.has_native_width = true;
      error = parseNativeWidth(entry.value, project.native_width);
    } else if (entry.key == "edge-coils") {
      project.has_edge_coils = true;
      error = parseEdgeCoils(entry.value, project.edge_coils);
    } else if (entry.key == "checks") {
      project.has_checks = true;
      std::string checks;
      for (const std::string& item : list(entry.value)) checks += (checks.empty() ? "" : ",") + item;
      error = parseChecks(checks, project.checks);
    } else if (entry.key == "optimize") {
      project.has_level = true;
      if (entry.value.size() != 1 || entry.value[0] < '0' || entry.value[0] > '2')
        error = "it takes 0, 1 or 2";
      else
        project.level = entry.value[0] - '0';
    } else if (entry.key == "defines") {
      for (const std::string& item : list(entry.value))
        if (error.empty()) error = parseDefine(item, project.defines);
    } else if (entry.key == "globals") {
      project.aligned_globals = entry.value == "aligned";
      if (!project.aligned_globals && entry.value != "shared") error = "it takes `shared` or `aligned`";
    } else if (entry.key == "warnings") {
      for (const std::string& item : list(entry.value)) {
        bool on = !item.starts_with("no-");
        project.warnings.push_back({on ? item : item.substr(3), on});
      }
    }
    if (!error.empty()) badValue(diagnostics, entry, error);
  }
}

bool readNumber(std::string_view text, uint64_t low, uint64_t high, uint32_t& out) {
  uint64_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || number < low || number > high) return false;
  out = static_cast<uint32_t>(number);
  return true;
}

// [pool new]: the memory for __NEW.
void readPoolSection(const ProjectSection& section, Diagnostics& diagnostics, ProjectFile& project) {
  constexpr uint64_t kMax = uint64_t{1} << 30;
  if (section.name != "new") return;
  for (const ProjectEntry& entry : section.entries) {
    if (entry.key != "bytes") {
      diagnostics.report(diag::ProjectUnknownKey, entry.key_loc, {entry.key, "pool new"})
          .length(static_cast<uint32_t>(entry.key.size()))
          .didYouMean("bytes");
      continue;
    }
    if (!readNumber(entry.value, 16, kMax, project.pool_bytes))
      badValue(diagnostics, entry, "it takes a number of bytes from 16 to 1073741824");
  }
}

// [area R]: a memory area of the product, whose addresses are %RW4 and the like.
void readAreaSection(const ProjectSection& section, Diagnostics& diagnostics, ProjectFile& project) {
  const char letter = section.name.size() == 1 ? upper(section.name[0]) : '\0';
  types::MemoryArea area{.letter = letter, .owner = types::AreaOwner::Memory};
  const bool is_known = types::findArea(project.areas, letter).has_value();
  if (!types::isAreaLetter(letter) || is_known) {
    diagnostics.report(diag::AreaName, section.loc,
                       {section.name, is_known ? "an area has this letter already"
                                               : "use a letter other than the sizes X, B, W, D and L"});
    return;
  }
  const ProjectEntry* const bytes = section.find("bytes");
  if (bytes == nullptr) {
    diagnostics.report(diag::AreaNoBytes, section.loc, {section.name});
  } else if (!readNumber(bytes->value, 1, types::kMaxAreaBytes, area.bytes)) {
    badValue(diagnostics, *bytes, "it takes a number of bytes from 1 to 16777216");
  }
  if (const ProjectEntry* const owner = section.find("owner")) {
    if (const auto known = types::ownerCalled(owner->value))
      area.owner = *known;
    else
      badValue(diagnostics, *owner, "it takes input, output, memory or shared");
  }
  project.areas.push_back(area);
}

// `10ms` and `T#10ms` are the same time.
std::string duration(const std::string& value) {
  if (value.find('#') != std::string::npos) return value;
  return "T#" + value;
}

// How long a task runs in virtual time. Not in the generated ST: the section may be about a task of the program.
void readDuration(const ProjectSection& section, Diagnostics& diagnostics, ProjectFile& project) {
  const ProjectEntry* const entry = section.find("duration");
  if (entry == nullptr) return;
  const bool has_prefix = entry->value.find('#') != std::string::npos;
  const Loc begin = has_prefix ? entry->value_loc : Loc{entry->value_loc.offset - 2};
  text::TimeValue time;
  if (!text::readDuration(duration(entry->value), begin, diagnostics, time)) return;
  if (time.is_negative) return badValue(diagnostics, *entry, "it takes a time of 0 or more");
  project.task_durations.push_back({section.name, static_cast<int64_t>(time.value), section.loc});
}

// [nct]: what an NCT control is set to. The control's own variables end below 1312, and its TimeSlice memory has 4000
// words.
void readLadderSection(const ProjectSection& section, Diagnostics& diagnostics, ProjectFile& project) {
  importer::LadderSettings& ladder = project.ladder;
  for (const ProjectEntry& entry : section.entries) {
    if (entry.key == "plcnvram" || entry.key == "plcram") {
      const bool kept = entry.key == "plcnvram";
      if (!readNumber(entry.value, kept ? 1312 : 1313, kept ? 4000 : 9999, kept ? ladder.kept : ladder.volatile_))
        badValue(diagnostics, entry, kept ? "it takes an address from 1312 to 4000" : "it takes an address up to 9999");
      continue;
    }
    const bool has_prefix = entry.value.find('#') != std::string::npos;
    const Loc begin = has_prefix ? entry.value_loc : Loc{entry.value_loc.offset - 2};
    text::TimeValue time;
    if (!text::readDuration(duration(entry.value), begin, diagnostics, time)) continue;
    if (time.is_negative || time.value == 0) {
      badValue(diagnostics, entry, "it takes a time above 0");
      continue;
    }
    (entry.key == "plc_period" ? ladder.plc_period_ns : ladder.time_slice_ns) = static_cast<int64_t>(time.value);
  }
  const ProjectEntry* const limit = section.find(section.find("plcram") != nullptr ? "plcram" : "plcnvram");
  if (limit != nullptr && ladder.volatile_ <= ladder.kept) badValue(diagnostics, *limit, "PLCRAM is above PLCNVRAM");
}

// [fmt]: how `rung fmt` writes.
void readStyle(const ProjectSection& section, Diagnostics& diagnostics, ProjectFile& project) {
  format::Style& style = project.style;
  for (const ProjectEntry& entry : section.entries) {
    uint32_t choice = 0;
    if (entry.key == "keywords") {
      if (parseChoice("keywords", entry.value, "upper|lower|keep", choice).empty())
        style.keywords = static_cast<format::KeywordCase>(choice);
      else
        badValue(diagnostics, entry, "it takes upper, lower or keep");
    } else if (entry.key == "align") {
      if (parseChoice("align", entry.value, "no|yes", choice).empty())
        style.align = choice == 1;
      else
        badValue(diagnostics, entry, "it takes yes or no");
    } else if (entry.key == "width") {
      if (!readNumber(entry.value, 0, 1000, style.width))
        badValue(diagnostics, entry, "it takes 0 to 1000 columns; 0: no limit");
    } else if (entry.key == "indent") {
      if (!readNumber(entry.value, 0, 16, style.indent)) badValue(diagnostics, entry, "it takes 0 to 16 blanks");
    } else if (!readNumber(entry.value, 0, 100, style.blank_lines)) {
      badValue(diagnostics, entry, "it takes 0 to 100 lines");
    }
  }
}

// True for `[task NAME]` with nothing but a duration: NAME is a task of the program.
bool isAboutDeclaredTask(const ProjectSection& section) {
  return section.entries.size() == 1 && section.entries[0].key == "duration";
}

// Everything that goes into the generated ST must be a word, number or path of ST, so that no value can inject other
// code.
bool isPlain(std::string_view value) {
  if (value.empty()) return false;
  for (char c : value)
    if (!((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '.' ||
          c == '#' || c == '%'))
      return false;
  return true;
}

// A value as it is in the file; where the file has it otherwise, at its place.
void addValue(xml::SourceMappedText& text, const Sources& sources, Loc at, std::string_view value) {
  const FileId file = sources.fileOf(at);
  const uint32_t begin = at.offset - sources.begin(file).offset;
  if (sources.original(file).substr(begin, value.size()) == value)
    text.add(at, {at.offset + static_cast<uint32_t>(value.size())});
  else
    text.put(at, value);
}

// Where `[task NAME]` has its name.
Loc nameOfSection(const Sources& sources, const ProjectSection& section) {
  const FileId file = sources.fileOf(section.loc);
  const uint32_t begin = section.loc.offset - sources.begin(file).offset;
  const std::string_view text = sources.original(file);
  const size_t kind = text.find(section.kind, begin);
  const size_t name = kind == std::string_view::npos ? kind : text.find(section.name, kind + section.kind.size());
  return name == std::string_view::npos ? section.loc : Loc{section.loc.offset + static_cast<uint32_t>(name - begin)};
}

struct ProjectProgram {
  const ProjectSection* task;
  std::string name, type;
  Loc name_loc, type_loc;
};

// `programs = Type, instance : Type`.
void collectPrograms(const ProjectSection& section, Diagnostics& diagnostics, std::vector<ProjectProgram>& programs) {
  const ProjectEntry* const entry = section.find("programs");
  if (entry == nullptr) return;
  for (const std::string_view part : split(entry->value, ',')) {
    const std::string_view item = trim(part);
    if (item.empty()) continue;
    const auto locOf = [&](std::string_view at) {
      return Loc{entry->value_loc.offset + static_cast<uint32_t>(at.data() - entry->value.data())};
    };
    const size_t colon = item.find(':');
    const std::string_view type = trim(item.substr(colon == std::string_view::npos ? 0 : colon + 1));
    const std::string_view name = trim(item.substr(0, colon));
    const std::string keyword(text::isReservedWord(name) ? name : text::isReservedWord(type) ? type : "");
    if (!keyword.empty() || !isModuleName(name) || !isModuleName(type)) {
      const std::string why = keyword.empty() ? "it takes `Program` or `instance : Program`, separated by commas"
                                              : "`" + keyword + "` is a keyword";
      diagnostics.report(diag::ProjectValue, locOf(item), {entry->key, why}).length(static_cast<uint32_t>(item.size()));
      continue;
    }
    programs.push_back({&section, std::string(name), std::string(type), locOf(name), locOf(type)});
  }
}

// TASK NAME(…) of a section.
void writeTask(xml::SourceMappedText& text, const Sources& sources, Diagnostics& diagnostics,
               const ProjectSection& section) {
  text.put(section.loc, "TASK ");
  addValue(text, sources, nameOfSection(sources, section), section.name);
  text.put(section.loc, "(");
  const char* separator = "";
  for (const ProjectEntry& entry : section.entries) {
    if (entry.key == "programs" || entry.key == "duration") continue;
    if (!isPlain(entry.value)) {
      badValue(diagnostics, entry, "it takes one number, time or name");
      continue;
    }
    std::string value = entry.value;
    if (entry.key == "kind") value = upper(value);
    if (entry.key == "interval" || entry.key == "watchdog") value = duration(value);
    text.put(entry.key_loc, separator + upper(entry.key) + " := ");
    addValue(text, sources, entry.value_loc, value);
    separator = ", ";
  }
  text.put(section.loc, ");\n");
}

// TASK and PROGRAM declarations of the [task] sections, each value at its place in the file.
FileId writeTasks(Sources& sources, Diagnostics& diagnostics, const ProjectFile& project) {
  xml::SourceMappedText text(sources);
  std::vector<ProjectProgram> programs;
  for (const ProjectSection& section : project.sections) {
    if (section.kind != "task" || section.name.empty() || isAboutDeclaredTask(section)) continue;
    if (const bool reserved = text::isReservedWord(section.name); reserved || !isModuleName(section.name)) {
      diagnostics.report(diag::TaskName, section.loc,
                         {section.name, reserved ? "it is a keyword" : "use letters, digits and `_`"});
      continue;
    }
    if (text.empty()) text.put(section.loc, "CONFIGURATION rung_project RESOURCE rung_project_resource ON PLC\n");
    writeTask(text, sources, diagnostics, section);
    collectPrograms(section, diagnostics, programs);
  }
  if (text.empty()) return {};
  for (const ProjectProgram& program : programs) {
    text.put(program.name_loc, "PROGRAM ");
    addValue(text, sources, program.name_loc, program.name);
    text.word(" WITH ");
    addValue(text, sources, nameOfSection(sources, *program.task), program.task->name);
    text.word(" : ");
    addValue(text, sources, program.type_loc, program.type);
    text.word(";\n");
  }
  text.word("END_RESOURCE END_CONFIGURATION\n");
  return text.finish(sources, project.file);
}

// The section [safe]: a function that gives outputs their values, each path and value at its place in the file.
FileId writeSafeValues(Sources& sources, Diagnostics& diagnostics, const ProjectFile& project) {
  xml::SourceMappedText text(sources);
  for (const ProjectSection& section : project.sections) {
    if (section.kind != "safe") continue;
    for (const ProjectEntry& entry : section.entries) {
      std::string path;
      for (const char c : entry.key)
        if (c != '[' && c != ']' && c != ',' && c != ' ') path += c;  // `lamps[2, 3]`
      const std::string_view digits = std::string_view(entry.value).substr(entry.value.starts_with('-') ? 1 : 0);
      if (!isPlain(path) || !isPlain(digits)) {
        badValue(diagnostics, entry, "[safe] takes lines `OUTPUT = VALUE`, with one literal or constant");
        continue;
      }
      if (text.empty()) text.put(section.loc, "{safe_values}\nFUNCTION rung_project_safe_values\n");
      text.put(entry.key_loc, entry.key + " := ");
      text.put(entry.value_loc, entry.value);
      text.put(entry.value_loc, ";\n");
    }
  }
  if (text.empty()) return {};
  text.word("END_FUNCTION\n");
  return text.finish(sources, project.file);
}

}  // namespace

void badValue(Diagnostics& diagnostics, const ProjectEntry& entry, std::string_view why) {
  diagnostics.report(diag::ProjectValue, entry.value_loc, {entry.key, why})
      .length(static_cast<uint32_t>(entry.value.size()));
}

const ProjectEntry* ProjectSection::find(std::string_view key) const {
  for (const ProjectEntry& entry : entries)
    if (entry.key == key) return &entry;
  return nullptr;
}

void parseProjectFile(Sources& sources, FileId file, Diagnostics& diagnostics, ProjectFile& project) {
  project.file = file;
  Reader(sources, file, diagnostics, project).read();
  for (const ProjectSection& section : project.sections)
    if (section.kind == "project")
      readProjectSection(section, diagnostics, project);
    else if (section.kind == "pool" && !section.name.empty())
      readPoolSection(section, diagnostics, project);
    else if (section.kind == "area" && !section.name.empty())
      readAreaSection(section, diagnostics, project);
    else if (section.kind == "task")
      readDuration(section, diagnostics, project);
    else if (section.kind == "nct")
      readLadderSection(section, diagnostics, project);
    else if (section.kind == "fmt")
      readStyle(section, diagnostics, project);
  readModules(sources, diagnostics, project);
  readAxes(sources, diagnostics, project);
  project.configuration = writeTasks(sources, diagnostics, project);
  project.safe_values = writeSafeValues(sources, diagnostics, project);
}

void applyProjectFile(const ProjectFile& project, ProjectOptions& options) {
  if (project.has_dialect && !options.dialect_given) options.dialect = project.dialect;
  if (project.has_native_width && !options.code.native_width_given) options.code.native_width = project.native_width;
  if (project.has_edge_coils && !options.code.edge_coils_given) options.code.edge_coils = project.edge_coils;
  if (project.has_checks && !options.code.checks_given) options.code.checks = project.checks;
  if (project.has_level && !options.code.level_given) options.code.level = project.level;
  if (options.name.empty()) options.name = project.name;
  options.report.warnings.insert(options.report.warnings.begin(), project.warnings.begin(), project.warnings.end());
  // The last of two defines with one name counts: the command line's.
  options.defines.insert(options.defines.begin(), project.defines.begin(), project.defines.end());
  for (std::string& library : libraryPaths(project)) options.library_paths.push_back(std::move(library));
}

std::vector<std::string> libraryPaths(const ProjectFile& project) {
  std::vector<std::string> paths;
  for (const std::string& written : project.libraries) {
    const LibraryPath library = libraryPath(written);
    const std::string called = library.called.empty() ? std::string() : library.called + "=";
    paths.push_back(called + project.folder + "/" + library.path);
  }
  return paths;
}

std::span<const ProjectSchema> projectSchemas() { return kSchemas; }

}  // namespace rung::driver

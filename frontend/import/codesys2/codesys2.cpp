// SPDX-License-Identifier: Apache-2.0
// CODESYS 2.3 exports (.EXP): a sequence of objects, each below comments like `(* @PATH := '\/Pumps' *)`. POUs, their
// actions (which follow the END_…), types and lists of globals are plain ST, except drawn bodies: `_FBD_BODY` and the
// like. The task configuration becomes a CONFIGURATION, the named channels of the PLC's configuration global variables.
// Other objects (visualisations, lists of libraries) are skipped; an unknown keyword is left to the parser.
#include "frontend/import/codesys2/codesys2.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frontend/import/diagnostics.h"
#include "frontend/import/source_mapped_text.h"
#include "frontend/import/tool_comments.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::importer::codesys2 {
namespace {

// The first word of an object that is not part of the program.
bool isForeign(std::string_view word) {
  for (const std::string_view known :
       {"VISUALISATION", "VISUALIZATION", "LIBRARY", "PLC_CONFIGURATION", "PLC_CONFIG", "TASK_CONFIGURATION",
        "TASKCONFIG", "ALARM_CONFIGURATION", "TRACE", "SAMPLING_TRACE", "WATCH", "WORKSPACE", "CNC", "CAM"})
    if (sameIdentifier(word, known)) return true;
  return word.starts_with("_");
}

class Codesys2Reader {
 public:
  // `task_configurations`: those of other files.
  Codesys2Reader(const Sources& sources, FileId file, Diagnostics& diagnostics,
                 std::vector<std::string>& task_configurations)
      : diagnostics_(diagnostics),
        task_configurations_(task_configurations),
        source_(sources.sourceText(file)),
        base_(sources.begin(file).offset),
        program_(sources) {}

  // False: the file can be parsed unchanged.
  bool run() {
    Scanner scanner(source_);
    while (std::optional<Unit> unit = nextName(scanner)) {
      const size_t begin = unit->begin;
      std::string_view word = scanner.textOf(*unit);
      if (sameIdentifier(word, "FUNCTIONBLOCK")) {  // accepted by CODESYS 2.3
        keep(begin);
        word = "FUNCTION_BLOCK";
        program_.replace(loc(begin), loc(unit->end), word);
        kept_ = unit->end;
        changed_ = true;
      }
      if (sameIdentifier(word, "TYPE")) {
        beginPart(begin);
        skipObject(scanner, "END_TYPE");
        endPart(scanner.at());
      } else if (sameIdentifier(word, "VAR_GLOBAL") || sameIdentifier(word, "VAR_CONFIG")) {
        beginPart(begin);
        skipObject(scanner, "END_VAR");
        endPart(scanner.at());
      } else if (!endWordOf(word).empty()) {
        beginPart(begin);
        skipPou(scanner, endWordOf(word));
        endPart(scanner.at());
      } else if (sameIdentifier(word, "RESOURCE")) {
        readTasks(scanner, begin);
      } else if (sameIdentifier(word, "PLC_CONFIGURATION")) {
        scanner.moveTo(readChannels(begin));
      } else if (isForeign(word)) {
        const size_t next = std::min(source_.find("(* @NESTEDCOMMENTS", begin), source_.size());
        exclude(begin, next);
        scanner.moveTo(next);
      }
    }
    if (!changed_) findSpellings(0, source_.size());
    if (!changed_ && spellings_.empty()) return false;
    keep(source_.size());
    return true;
  }

  xml::SourceMappedText& program() { return program_; }
  std::vector<TextPart>& parts() { return parts_; }

 private:
  // The first comment of an object says whether comments nest in it.
  void beginPart(size_t begin) {
    const size_t last = parts_.empty() ? 0 : parts_.back().end;
    const size_t header = source_.substr(last, begin - last).rfind("(* @NESTEDCOMMENTS");
    part_ = header == std::string_view::npos ? begin : last + header;
  }
  void endPart(size_t end) { parts_.push_back({static_cast<uint32_t>(part_), static_cast<uint32_t>(end)}); }

  Loc loc(size_t at) const { return {base_ + static_cast<uint32_t>(at)}; }
  void keep(size_t to) {
    findSpellings(kept_, to);
    for (const Spelling& spelling : spellings_) {
      if (spelling.at > kept_) program_.add(loc(kept_), loc(spelling.at));
      program_.replace(loc(spelling.at), loc(spelling.at + spelling.length), spelling.text);
      kept_ = spelling.at + spelling.length;
    }
    if (to > kept_) program_.add(loc(kept_), loc(to));
    kept_ = to;
  }

  // CODESYS 2.3 alone writes these so: `10.` for 10.0, and the channel %IR3.0, a REAL of 32 bits.
  void findSpellings(size_t from, size_t to) {
    spellings_.clear();
    Scanner scanner(source_.substr(0, to));
    scanner.moveTo(from);
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
      const auto at = [&](size_t i) { return i < to ? source_[i] : ' '; };
      if (unit.kind == UnitKind::Number) {
        const bool is_fraction = unit.begin > 0 && source_[unit.begin - 1] == '.';
        if (!is_fraction && at(unit.end) == '.' && at(unit.end + 1) != '.' && !isNameCharacter(at(unit.end + 1)))
          spellings_.push_back({unit.end + 1, 0, "0"});
      } else if (source_[unit.begin] == '%' && std::string_view("IQM").find(upper(at(unit.begin + 1))) < 3 &&
                 upper(at(unit.begin + 2)) == 'R' && at(unit.begin + 3) >= '0' && at(unit.begin + 3) <= '9') {
        spellings_.push_back({unit.begin + 2, 1, "D"});
        scanner.moveTo(unit.begin + 3);
      }
    }
  }
  void exclude(size_t begin, size_t end) {
    keep(begin);
    kept_ = end;
    changed_ = true;
  }

  static std::optional<Unit> nextName(Scanner& scanner) {
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode())
      if (unit.kind == UnitKind::Name) return unit;
    return std::nullopt;
  }
  static void skipObject(Scanner& scanner, std::string_view closing) {
    while (const std::optional<Unit> unit = nextName(scanner))
      if (sameIdentifier(scanner.textOf(*unit), closing)) break;
  }
  // The part of a line between its first two quotes; empty: there is none.
  static std::string_view quoted(std::string_view line) {
    const size_t open = line.find('\'');
    if (open == std::string_view::npos) return {};
    const size_t close = line.find('\'', open + 1);
    return close == std::string_view::npos ? std::string_view() : line.substr(open + 1, close - open - 1);
  }
  Loc locIn(std::string_view part) const { return loc(static_cast<size_t>(part.data() - source_.data())); }

  // name AT address : the type of a channel, by the letter of its address and the name of its kind.
  void writeChannel(std::string_view name, std::string_view address, std::string_view section) {
    if (!isIdentifier(name) || address.size() < 3) return;
    const char size = address[2];
    const bool real = size == 'R' || section.find("Float") != std::string_view::npos;
    const char* type = real ? "REAL" : size == 'X' ? "BOOL" : size == 'B' ? "BYTE" : size == 'W' ? "WORD" : "DWORD";
    program_.put(locIn(name), "VAR_GLOBAL ");
    program_.add(locIn(name), {locIn(name).offset + static_cast<uint32_t>(name.size())});
    std::string place(address);
    if (size == 'R') place[2] = 'D';
    program_.put(locIn(address), " AT " + place + " : " + type + "; END_VAR\n");
  }

  // The channels and bits of a PLC configuration that have names are global variables. Returns where it ends.
  size_t readChannels(size_t begin) {
    const size_t end = std::min(source_.find("(* @NESTEDCOMMENTS", begin), source_.size());
    exclude(begin, begin);
    std::string_view section, name;
    for (size_t at = begin; at < end;) {
      const size_t next = std::min(source_.find('\n', at), end);
      const std::string_view line = source_.substr(at, next - at);
      at = next + 1;
      const size_t percent = line.find('%');
      const std::string_view from = percent == std::string_view::npos ? std::string_view() : line.substr(percent);
      const std::string_view address = from.substr(0, from.find_first_of(" \t\r'"));
      if (line.starts_with("_SECTION_NAME:")) {
        section = quoted(line);
        name = {};
      } else if (line.starts_with("_SYMBOLIC_NAME:")) {
        name = quoted(line);
      } else if (line.starts_with("_IECADR:")) {
        writeChannel(name, address, section);
      } else if (line.starts_with("_BIT ")) {
        writeChannel(quoted(line), address, {});
      }
    }
    kept_ = end;
    return end;
  }

  // The tasks, `RESOURCE {TASK name (…); {Prog();} END_TASK} END_RESOURCE`, become a CONFIGURATION.
  // An export repeats it in a file of another name when it was made in another language.
  void readTasks(Scanner& scanner, size_t begin) {
    const Loc here = loc(begin);
    exclude(begin, begin);
    Scanner ahead = scanner;
    skipObject(ahead, "END_RESOURCE");
    std::string text(source_.substr(begin, ahead.at() - begin));
    std::erase_if(text, isBlankCharacter);
    if (std::find(task_configurations_.begin(), task_configurations_.end(), text) != task_configurations_.end()) {
      scanner.moveTo(ahead.at());
      kept_ = ahead.at();
      return;
    }
    task_configurations_.push_back(std::move(text));
    bool has_task = false;
    std::string_view task;
    while (const std::optional<Unit> unit = nextName(scanner)) {
      const std::string_view word = scanner.textOf(*unit);
      if (sameIdentifier(word, "END_RESOURCE")) {
        kept_ = unit->end;
        break;
      }
      if (sameIdentifier(word, "END_TASK")) {
        task = {};
      } else if (sameIdentifier(word, "TASK")) {
        if (!has_task) program_.put(here, "CONFIGURATION _configuration RESOURCE _resource ON PLC\n");
        has_task = true;
        if (const std::optional<Unit> name = nextName(scanner)) task = scanner.textOf(*name);
        const size_t end = std::min(source_.find(';', unit->begin), source_.size() - 1) + 1;
        program_.add(loc(unit->begin), loc(end));
        program_.put(loc(end), "\n");
        scanner.moveTo(end);
      } else if (!task.empty()) {  // a program; its inputs are given in its own variables
        program_.put(loc(unit->begin), "PROGRAM ");
        program_.add(loc(unit->begin), loc(unit->end));
        program_.put(loc(unit->begin), " WITH " + std::string(task) + " : ");
        program_.add(loc(unit->begin), loc(unit->end));
        program_.put(loc(unit->end), ";\n");
        scanner.moveTo(std::min(source_.find(';', unit->begin), source_.size()));
      }
    }
    if (has_task) program_.put(here, "END_RESOURCE END_CONFIGURATION\n");
  }
  // Nothing but blanks before it on its line.
  bool isAtLineStart(size_t begin) const {
    const size_t last = source_.find_last_not_of(" \t", begin - 1);
    return begin == 0 || last == std::string_view::npos || source_[last] == '\n';
  }

  // Skips the POU or action whose first word has been read, excluding a drawn body.
  void skipPou(Scanner& scanner, std::string_view closing) {
    std::string_view name;
    while (const std::optional<Unit> unit = nextName(scanner)) {
      const std::string_view word = scanner.textOf(*unit);
      if (name.empty()) name = word;
      if (sameIdentifier(word, closing)) break;
      if (!word.starts_with("_") || !word.ends_with("_BODY") || !isAtLineStart(unit->begin)) continue;
      const std::string how = "drawn in " + std::string(word.substr(1, word.size() - 6));
      diagnostics_.report(diag::NetworkBody, loc(unit->begin), {name, how}).length(static_cast<uint32_t>(word.size()));
      // A drawn body is not ST: search for the line that closes the POU.
      size_t end = source_.find("\n" + std::string(closing), unit->begin);
      end = end == std::string_view::npos ? source_.size() : end + 1;
      exclude(unit->begin, end);
      endPart(unit->begin);
      part_ = end;
      scanner.moveTo(end);
    }
  }

  Diagnostics& diagnostics_;
  std::vector<std::string>& task_configurations_;
  std::string_view source_;
  uint32_t base_;
  xml::SourceMappedText program_;
  size_t kept_ = 0;  // everything before is copied or excluded
  bool changed_ = false;
  struct Spelling {
    size_t at, length;
    std::string_view text;
  };
  std::vector<Spelling> spellings_;  // in what is kept next
  std::vector<TextPart> parts_;
  size_t part_ = 0;  // where the current one begins
};

}  // namespace

bool isCodesys2(std::string_view text) {
  return hasToolComment(text, {"@NESTEDCOMMENTS", "@PATH", "@OBJECTFLAGS", "@GLOBAL_VARIABLE_LIST"});
}

FileId readProgram(ReadContext& context, FileId file) {
  Codesys2Reader reader(context.sources, file, context.diagnostics, context.task_configurations);
  return reader.run() ? reader.program().finish(context.sources, file) : file;
}

std::vector<TextPart> programParts(Sources& sources, FileId file, Diagnostics& diagnostics) {
  std::vector<std::string> task_configurations;
  Codesys2Reader reader(sources, file, diagnostics, task_configurations);
  reader.run();
  return std::move(reader.parts());
}

}  // namespace rung::importer::codesys2

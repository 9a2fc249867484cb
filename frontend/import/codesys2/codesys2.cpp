// CODESYS 2.3 exports (.EXP): a sequence of objects, each below comments like `(* @PATH := '\/Pumps' *)`. POUs, their
// actions (which follow the END_…), types and lists of globals are plain ST, except drawn bodies: `_FBD_BODY` and the
// like. Other exported objects (visualisations, the PLC's configuration, lists of libraries) are skipped; an unknown
// keyword is left to the parser, which reports it.
#include "frontend/import/diagnostics.h"
#include "frontend/import/readers.h"
#include "frontend/import/scanner.h"
#include "frontend/import/source_mapped_text.h"
#include "frontend/source/names.h"

namespace rung::vendor {
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
  Codesys2Reader(const Sources& sources, FileId file, Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        source_(sources.sourceText(file)),
        base_(sources.begin(file).offset),
        program_(sources) {}

  // False: the file can be parsed unchanged.
  bool run() {
    Scanner scanner(source_);
    while (scanner.next()) {
      const size_t begin = scanner.begin();
      std::string_view word = scanner.word();
      if (sameIdentifier(word, "FUNCTIONBLOCK")) {  // accepted by CODESYS 2.3
        keep(begin);
        word = "FUNCTION_BLOCK";
        program_.replace(loc(begin), loc(scanner.end()), word);
        kept_ = scanner.end();
        changed_ = true;
      }
      if (sameIdentifier(word, "TYPE")) {
        scanner.moveTo(endOfObject(scanner, "END_TYPE"));
      } else if (sameIdentifier(word, "VAR_GLOBAL") || sameIdentifier(word, "VAR_CONFIG")) {
        scanner.moveTo(endOfObject(scanner, "END_VAR"));
      } else if (!endWordOf(word).empty()) {
        scanner.moveTo(endOfPou(scanner, endWordOf(word)));
      } else if (isForeign(word)) {
        size_t next = source_.find("(* @NESTEDCOMMENTS", begin);
        if (next == std::string_view::npos) next = source_.size();
        exclude(begin, next);
        scanner.moveTo(next);
      }
    }
    if (!changed_) return false;
    keep(source_.size());
    return true;
  }

  xml::SourceMappedText& program() { return program_; }

 private:
  Loc loc(size_t at) const { return {base_ + static_cast<uint32_t>(at)}; }
  void keep(size_t to) {
    if (to > kept_) program_.add(loc(kept_), loc(to));
    kept_ = to;
  }
  void exclude(size_t begin, size_t end) {
    keep(begin);
    kept_ = end;
    changed_ = true;
  }

  static size_t endOfObject(Scanner& scanner, std::string_view closing) {
    while (scanner.next())
      if (sameIdentifier(scanner.word(), closing)) break;
    return scanner.end();
  }

  // Skips the POU or action whose first word has been read, excluding a drawn body. Returns its end.
  size_t endOfPou(Scanner& scanner, std::string_view closing) {
    std::string_view name;
    while (scanner.next()) {
      const std::string_view word = scanner.word();
      if (name.empty()) name = word;
      if (sameIdentifier(word, closing)) break;
      if (!word.starts_with("_") || !word.ends_with("_BODY") || !scanner.atLineStart()) continue;
      const std::string how = "drawn in " + std::string(word.substr(1, word.size() - 6));
      diagnostics_.report(diag::NetworkBody, loc(scanner.begin()), {name, how})
          .length(static_cast<uint32_t>(word.size()));
      // A drawn body is not ST: search for the line that closes the POU.
      size_t end = source_.find("\n" + std::string(closing), scanner.begin());
      end = end == std::string_view::npos ? source_.size() : end + 1;
      exclude(scanner.begin(), end);
      scanner.moveTo(end);
    }
    return scanner.end();
  }

  Diagnostics& diagnostics_;
  std::string_view source_;
  uint32_t base_;
  xml::SourceMappedText program_;
  size_t kept_ = 0;  // everything before is copied or excluded
  bool changed_ = false;
};

}  // namespace

FileId readCodesys2(Sources& sources, FileId file, Diagnostics& diagnostics) {
  Codesys2Reader reader(sources, file, diagnostics);
  return reader.run() ? reader.program().finish(sources, file) : file;
}

}  // namespace rung::vendor

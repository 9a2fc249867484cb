// SPDX-License-Identifier: Apache-2.0
// Diagnostics: what is wrong, where, and how to fix it. In: reports from all phases. Out: an ordered list that render.h
// prints as text, JSON or SARIF. Reporting does not stop a phase: it continues and uses the Error type to suppress
// follow-up errors.
// Each folder lists its messages in a diagnostics.def; the diagnostics.h beside it turns them into constants.
// registry.cpp is the one file that includes all lists.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/source/function_ref.h"

namespace rung {

enum class Severity : uint8_t { Note, Info, Warning, Error };

// The code of a message: its number times four plus its severity, so that the lists are independent of each other.
enum class Diag : uint16_t;

consteval Diag diagOf(const char* code) {  // "E0412"
  unsigned number = 0;
  for (const char* at = code + 1; *at != '\0'; ++at) number = number * 10 + static_cast<unsigned>(*at - '0');
  const Severity severity = *code == 'E' ? Severity::Error : *code == 'W' ? Severity::Warning : Severity::Info;
  return static_cast<Diag>(number * 4 + static_cast<unsigned>(severity));
}

// The message of a note below a diagnostic; {0} {1} are its arguments.
struct Note {
  const char* text;
};

// How a header expands the rows of a diagnostics.def. {0} {1} in the message are the arguments of report().
#define RUNG_ERROR(code, name, text) inline constexpr Diag name = diagOf(#code);
#define RUNG_WARNING(code, name, text) inline constexpr Diag name = diagOf(#code);
#define RUNG_INFO(code, name, text) inline constexpr Diag name = diagOf(#code);
#define RUNG_NOTE(name, text) inline constexpr Note name{text};

struct DiagInfo {
  Diag diag;
  const char* code;  // "E0412"
  const char* name;  // "UnknownName"
  const char* text;  // the template
  Severity severity;
};
const DiagInfo& diagInfo(Diag diag);
// The row with this code ("E0412", any case), or null.
const DiagInfo* findDiag(std::string_view code);
// A template with its arguments in place of {0} {1}, each cut to a few hundred bytes.
std::string formatMessage(const char* text, std::initializer_list<std::string_view> args);
// The warnings with this code or name ("W0108", "unused-variable"), or those that correspond to this code of CODESYS
// ("C0195"); see codesys_warnings.def.
std::vector<Diag> warningsNamed(std::string_view name);
// C and digits.
bool isCodesysCode(std::string_view name);
// The name of a row in `-W` that is nearest to this one, or empty.
std::string nearestWarning(std::string_view name);
// The name of the row in `-W`: "unused-variable" for UnusedVariable.
std::string switchName(const DiagInfo& info);
// All rows, by number.
std::span<const DiagInfo> allDiags();

// A change of the sources after which what a diagnostic is about is right. Its locations are in what was parsed;
// fixes.h leads them to the files.
struct Fix {
  struct Edit {
    Loc begin, end;  // equal: an insertion; none: what the diagnostic marks
    std::string text;
  };
  std::string title;  // begins with a verb: "Insert `;`"
  std::vector<Edit> edits;
  bool is_sure =
      false;  // a tool may apply it unasked: it makes what was written what was taken for it, and loses nothing
};
enum class Sureness : uint8_t { Proposal, Sure };

struct Diagnostic {
  struct Attached {
    Loc loc;  // none: belongs to the whole diagnostic
    std::string message;
  };
  Diag diag;
  Severity severity;
  Loc loc;
  Loc original_loc;     // the location of `loc` in the file on disk; filled by sort()
  std::string path;     // used when there is no loc: for example, a file that could not be read
  uint32_t length = 0;  // bytes to underline; 0: the token at loc
  std::string message;
  std::string element;  // of a diagram: `POU main, network 3, contact "start", localId 12`
  std::vector<Attached> notes;
  uint32_t reporter = 0;        // Diagnostics::reporter, when it was reported
  std::vector<Fix> fixes = {};  // the best one first
};

// Chained after a report: diagnostics.error(...).note(...). Does nothing when the report was dropped.
class Report {
 public:
  explicit Report(Diagnostic* diagnostic) : diagnostic_(diagnostic) {}
  Report& note(Loc loc, Note note, std::initializer_list<std::string_view> args = {});
  Report& declaredHere(Loc loc);
  Report& alsoDeclaredHere(Loc loc);
  // The note, and the fix that writes the candidate in place of the name. Empty: nothing is added.
  Report& didYouMean(std::string_view candidate);
  Report& didYouMean(std::string_view candidate, Loc begin, Loc end);  // in place of what is there
  Report& length(uint32_t bytes);
  Report& element(std::string text);
  Report& path(std::string path);
  // False: the report was dropped, and a fix of it need not be made.
  explicit operator bool() const { return diagnostic_ != nullptr; }
  Report& fix(Fix fix);  // without edits: nothing is added
  // "Write `text`" in place of what is marked, or of a part of what was parsed.
  Report& replace(std::string_view text, Sureness sureness);
  Report& replace(Loc begin, Loc end, std::string_view text, Sureness sureness);
  // "Insert `text`", with the blanks around it.
  Report& insert(Loc at, std::string_view text, Sureness sureness);
  Report& remove(Loc begin, Loc end, std::string_view what, Sureness sureness);

 private:
  Diagnostic* diagnostic_;
};

class Diagnostics {
 public:
  explicit Diagnostics(const Sources& sources) : sources_(sources) {}

  // Drops a second diagnostic with the same code at the same location, disabled warnings, and all errors after
  // max_errors (they are counted). The reference is valid until the next report.
  Report report(Diag diag, Loc loc, std::initializer_list<std::string_view> args = {});

  // Who reports, so that it can be taken back: a number of the caller's. 0: who reads and parses.
  uint32_t reporter = 0;
  // What was reported there with this code, to add what is known only later; null: nothing.
  Diagnostic* reportedAt(Diag diag, Loc loc);
  // Takes back what was reported, as if it had never been. No line is closed then.
  void retract(FunctionRef<bool(const Diagnostic&)> is_gone);
  // Suppresses further diagnostics on the lines with errors of reporter 0: later phases would report what follows from
  // them.
  void closeLines();

  bool hasErrors() const { return error_count_ > 0; }
  uint32_t errorCount() const { return error_count_; }
  uint32_t warningCount() const { return warning_count_; }
  uint32_t droppedCount() const { return dropped_count_; }                 // errors
  uint32_t droppedWarningCount() const { return dropped_warning_count_; }  // beyond ten times max_errors
  // True once max_errors is reached: parsers and checkers may stop early.
  bool full() const { return error_count_ >= max_errors; }
  const std::vector<Diagnostic>& all() const { return list_; }
  // Adds to each diagnostic the diagram element that contains it; `at` names the element at a location.
  void nameElements(FunctionRef<std::string(Loc)> at);
  // In the order of files, then by location; equal locations keep the order of reporting. Diagnostics for a whole file
  // come first.
  void sort();

  uint32_t max_errors = 100;
  bool keeps_all_warnings = false;  // beyond ten times max_errors
  bool warnings_are_errors = false;
  // -W options such as "no-W0101" or "no-unused-variable", see docs/cli/README.md. False when the name is unknown.
  bool setWarning(std::string_view name, bool on);
  bool enabled(Diag diag) const;
  // {warning disable CODE} and {warning restore CODE}: `on` from `loc` to `end` of its source or the next such call.
  void switchWarning(Diag diag, bool on, Loc loc, Loc end);

 private:
  const Sources& sources_;
  std::vector<Diagnostic> list_;
  std::vector<Diag> disabled_;
  struct DisabledRange {
    Diag diag;
    Loc begin, end;
  };
  std::vector<DisabledRange> disabled_ranges_;
  uint32_t error_count_ = 0, warning_count_ = 0, dropped_count_ = 0, dropped_warning_count_ = 0;
  bool firstAt(Diag diag, Loc loc);
  bool isDisabledAt(Diag diag, Loc loc) const;

  std::vector<uint64_t> seen_;  // (code, loc) hash set, open addressing
  size_t seen_count_ = 0;
  std::vector<uint64_t> closed_lines_;  // file and line, sorted
};

// The candidate nearest to `written` (Damerau-Levenshtein, case folded), or empty when none is near enough.
std::string_view nearest(std::string_view written, const std::vector<std::string_view>& candidates);
// The shortest candidate that begins as `written` does, or the longest that `written` continues with `_`, or empty: for
// names that are known to be wrong.
std::string_view nearestByBeginning(std::string_view written, const std::vector<std::string_view>& candidates);

}  // namespace rung

// SPDX-License-Identifier: Apache-2.0
// The list of diagnostics: warning switches, limits, duplicates, order.
#include "frontend/source/diagnostics.h"

#include <algorithm>

#include "frontend/source/names.h"
#include "frontend/source/text.h"

namespace rung {
namespace {

constexpr size_t kMaxArgumentBytes = 400;  // a name of a megabyte must not make a message of a megabyte

void appendArgument(std::string& out, std::string_view argument) {
  if (argument.size() <= kMaxArgumentBytes) {
    out += argument;
    return;
  }
  size_t end = kMaxArgumentBytes;
  while (end > 0 && (static_cast<unsigned char>(argument[end]) & 0xc0) == 0x80) --end;
  out += argument.substr(0, end);
  out += "...";
}

std::string_view withoutBlanksAround(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\n") + 1 - first);
}

}  // namespace

std::string formatMessage(const char* text, std::initializer_list<std::string_view> args) {
  std::string out;
  for (const char* at = text; *at != '\0'; ++at) {
    const bool placeholder = at[0] == '{' && at[1] >= '0' && at[1] <= '9' && at[2] == '}';
    if (!placeholder) {
      out += *at;
      continue;
    }
    const auto index = static_cast<size_t>(at[1] - '0');
    if (index < args.size()) appendArgument(out, args.begin()[index]);
    at += 2;
  }
  return out;
}

std::string switchName(const DiagInfo& info) {
  std::string name;
  for (const char* at = info.name; *at != '\0'; ++at) {
    const char folded = foldedCharacter(*at);
    if (folded != *at && !name.empty()) name += '-';
    name += folded;
  }
  return name;
}

Report& Report::note(Loc loc, Note note, std::initializer_list<std::string_view> args) {
  if (diagnostic_ != nullptr) diagnostic_->notes.push_back({loc, formatMessage(note.text, args)});
  return *this;
}

Report& Report::declaredHere(Loc loc) { return note(loc, Note{"declared here"}); }

Report& Report::alsoDeclaredHere(Loc loc) { return note(loc, Note{"also declared here"}); }

Report& Report::didYouMean(std::string_view candidate) { return didYouMean(candidate, {}, {}); }

Report& Report::didYouMean(std::string_view candidate, Loc begin, Loc end) {
  if (candidate.empty()) return *this;
  return note({}, Note{"did you mean `{0}`?"}, {candidate}).replace(begin, end, candidate, Sureness::Proposal);
}

Report& Report::fix(Fix fix) {
  if (diagnostic_ != nullptr && !fix.edits.empty()) diagnostic_->fixes.push_back(std::move(fix));
  return *this;
}

Report& Report::replace(std::string_view text, Sureness sureness) { return replace({}, {}, text, sureness); }

Report& Report::replace(Loc begin, Loc end, std::string_view text, Sureness sureness) {
  if (diagnostic_ == nullptr) return *this;
  return fix({formatMessage("Write `{0}`", {withoutBlanksAround(text)}),
              {{begin, end, std::string(text)}},
              sureness == Sureness::Sure});
}

Report& Report::insert(Loc at, std::string_view text, Sureness sureness) {
  if (diagnostic_ == nullptr) return *this;
  return fix({formatMessage("Insert `{0}`", {withoutBlanksAround(text)}),
              {{at, at, std::string(text)}},
              sureness == Sureness::Sure});
}

Report& Report::remove(Loc begin, Loc end, std::string_view what, Sureness sureness) {
  if (diagnostic_ == nullptr) return *this;
  return fix({formatMessage("Remove `{0}`", {what}), {{begin, end, {}}}, sureness == Sureness::Sure});
}

Report& Report::length(uint32_t bytes) {
  if (diagnostic_ != nullptr) diagnostic_->length = bytes;
  return *this;
}

Report& Report::element(std::string text) {
  if (diagnostic_ != nullptr) diagnostic_->element = std::move(text);
  return *this;
}

Report& Report::path(std::string path) {
  if (diagnostic_ != nullptr) diagnostic_->path = std::move(path);
  return *this;
}

namespace {

uint64_t lineKey(const Sources& sources, Loc loc) {
  return uint64_t{sources.editedFile(sources.fileOf(loc)).index} << 32 | sources.lineNumber(loc);
}

}  // namespace

void Diagnostics::nameElements(FunctionRef<std::string(Loc)> at) {
  for (Diagnostic& diagnostic : list_)
    if (diagnostic.loc && diagnostic.element.empty()) diagnostic.element = at(diagnostic.loc);
}

void Diagnostics::closeLines() {
  closed_lines_.clear();
  for (const Diagnostic& diagnostic : list_)
    if (diagnostic.reporter == 0 && diagnostic.loc && diagInfo(diagnostic.diag).severity == Severity::Error)
      closed_lines_.push_back(lineKey(sources_, diagnostic.loc));
  std::sort(closed_lines_.begin(), closed_lines_.end());
}

Report Diagnostics::report(Diag diag, Loc loc, std::initializer_list<std::string_view> args) {
  if (!closed_lines_.empty() && loc &&
      std::binary_search(closed_lines_.begin(), closed_lines_.end(), lineKey(sources_, loc)))
    return Report(nullptr);
  if (isDisabledAt(diag, loc)) return Report(nullptr);
  if (!enabled(diag) || !firstAt(diag, sources_.originalLocation(loc))) return Report(nullptr);
  const DiagInfo& info = diagInfo(diag);
  Severity severity = info.severity;
  if (severity == Severity::Warning && warnings_are_errors) severity = Severity::Error;
  if (severity == Severity::Error) {
    if (error_count_++ >= max_errors) {
      ++dropped_count_;
      return Report(nullptr);
    }
  } else if (severity == Severity::Warning) {
    if (warning_count_++ >= uint64_t{max_errors} * 10 && !keeps_all_warnings) {
      ++dropped_warning_count_;
      return Report(nullptr);
    }
  }
  list_.push_back({diag, severity, loc, {}, {}, 0, formatMessage(info.text, args), {}, {}, reporter, {}});
  return Report(&list_.back());
}

Diagnostic* Diagnostics::reportedAt(Diag diag, Loc loc) {
  const auto found = std::find_if(list_.rbegin(), list_.rend(), [&](const Diagnostic& diagnostic) {
    return diagnostic.diag == diag && diagnostic.loc == loc;
  });
  return found == list_.rend() ? nullptr : &*found;
}

void Diagnostics::retract(FunctionRef<bool(const Diagnostic&)> is_gone) {
  std::erase_if(list_, [&](const Diagnostic& diagnostic) { return is_gone(diagnostic); });
  error_count_ = warning_count_ = 0;
  closed_lines_.clear();
  seen_.clear();
  seen_count_ = 0;
  for (const Diagnostic& diagnostic : list_) {
    if (diagnostic.severity == Severity::Error) ++error_count_;
    if (diagnostic.severity == Severity::Warning) ++warning_count_;
    firstAt(diagnostic.diag, sources_.originalLocation(diagnostic.loc));
  }
}

// A location is reported once per code. Diagnostics without a location are told apart by path and message, so none of
// them is lost.
bool Diagnostics::firstAt(Diag diag, Loc loc) {
  if (!loc) return true;
  if ((seen_count_ + 1) * 2 > seen_.size()) {
    std::vector<uint64_t> old(seen_.empty() ? 64 : seen_.size() * 2);
    old.swap(seen_);
    for (const uint64_t key : old) {
      if (key == 0) continue;
      size_t at = key * 0x9e3779b97f4a7c15u >> 32 & (seen_.size() - 1);
      while (seen_[at] != 0) at = (at + 1) & (seen_.size() - 1);
      seen_[at] = key;
    }
  }
  const uint64_t key = uint64_t{loc.offset} << 16 | static_cast<uint64_t>(diag);
  size_t at = key * 0x9e3779b97f4a7c15u >> 32 & (seen_.size() - 1);
  for (; seen_[at] != 0; at = (at + 1) & (seen_.size() - 1)) {
    if (seen_[at] == key) return false;
  }
  seen_[at] = key;
  ++seen_count_;
  return true;
}

void Diagnostics::sort() {
  // Paths order diagnostics without a location.
  for (Diagnostic& diagnostic : list_) diagnostic.original_loc = sources_.originalLocation(diagnostic.loc);
  std::stable_sort(list_.begin(), list_.end(), [&](const Diagnostic& a, const Diagnostic& b) {
    return a.original_loc != b.original_loc ? sources_.isBefore(a.original_loc, b.original_loc) : a.path < b.path;
  });
}

bool Diagnostics::enabled(Diag diag) const {
  return std::find(disabled_.begin(), disabled_.end(), diag) == disabled_.end();
}

void Diagnostics::switchWarning(Diag diag, bool on, Loc loc, Loc end) {
  if (!on) {
    disabled_ranges_.push_back({diag, loc, end});
    return;
  }
  for (DisabledRange& range : disabled_ranges_)
    if (range.diag == diag && range.begin < loc && loc < range.end) range.end = loc;
}

bool Diagnostics::isDisabledAt(Diag diag, Loc loc) const {
  return std::any_of(disabled_ranges_.begin(), disabled_ranges_.end(), [&](const DisabledRange& range) {
    return range.diag == diag && !(loc < range.begin) && loc < range.end;
  });
}

bool Diagnostics::setWarning(std::string_view name, bool on) {
  if (name.starts_with("no-")) {
    name.remove_prefix(3);
    on = !on;
  }
  bool known = name == "all";
  for (const DiagInfo& info : allDiags()) {
    if (info.severity == Severity::Error) continue;
    if (name != "all" && !sameIdentifier(name, info.code) && name != switchName(info)) continue;
    std::erase(disabled_, info.diag);
    if (!on) disabled_.push_back(info.diag);
    known = true;
  }
  return known;
}

}  // namespace rung

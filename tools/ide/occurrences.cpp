// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/occurrences.h"

#include <algorithm>
#include <unordered_set>

#include "frontend/source/names.h"
#include "frontend/source/scanner.h"
#include "frontend/source/text.h"
#include "tools/ide/meanings.h"

namespace rung::ide {
namespace {

class Occurrences {
 public:
  Occurrences(const View& view, std::string_view name, const Edits& known, bool only_edits,
              const std::vector<Range>& where)
      : view_(view),
        project_(*view.snapshot().project()),
        name_(name),
        folded_(foldedIdentifier(name)),
        only_edits_(only_edits),
        where_(where) {
    for (const TextEdit& edit : known.all()) known_.insert(keyOf(edit.range));
    const NameId id = view.names().find(name);
    key_ = id ? view.names().key(id) : NameId{};
    if (only_edits) return;
    add(project_.mentions);
    for (const sema::Pou& pou : project_.pous) add(pou.body.mentions);
  }

  bool areKnown() {
    return std::all_of(view_.tree().files.begin(), view_.tree().files.end(),
                       [&](const FileUnit& unit) { return areKnownIn(unit); });
  }

 private:
  static uint64_t keyOf(const FileRange& at) { return uint64_t{at.file.index} << 32 | at.begin; }

  void add(const std::vector<sema::Mention>& mentions) {
    const Scope& scope = view_.meanings().scope();
    for (const sema::Mention& mention : mentions)
      if (const NameId name = scope.nameOf(mention.entity); name && view_.names().key(name) == key_)
        known_.insert(keyOf(view_.nameInFile(mention.loc)));
  }

  bool areKnownIn(const FileUnit& unit) {
    const std::string_view source = view_.sources().sourceText(unit.file);
    const uint32_t base = view_.sources().begin(unit.file).offset;
    if (!isAsked({{base}, {base + static_cast<uint32_t>(source.size())}}) || !mayHaveName(source)) return true;
    if (hasConditions(unit)) return false;
    Scanner scanner(source);
    for (Unit piece = scanner.next(); piece.kind != UnitKind::End; piece = scanner.next()) {
      const std::string_view text = scanner.textOf(piece);
      if (piece.kind == UnitKind::Comment || piece.kind == UnitKind::String || text.size() < name_.size()) continue;
      const Loc begin{base + static_cast<uint32_t>(piece.begin)};
      if (!isAsked({begin, {begin.offset + 1}})) continue;
      if (piece.kind == UnitKind::Name && text.size() == name_.size()) {
        const Loc loc{base + static_cast<uint32_t>(piece.begin)};
        if (sameIdentifier(text, name_) && known_.count(keyOf(view_.nameInFile(loc))) == 0 &&
            (only_edits_ || !isDeclared(loc)))
          return false;
      } else if (piece.kind == UnitKind::Name ? isConversion(text) : hasWord(text)) {
        return false;
      }
    }
    return true;
  }

  bool isAsked(Range part) const {
    return where_.empty() || std::any_of(where_.begin(), where_.end(), [&](const Range& range) {
             return range.begin < part.end && part.begin < range.end;
           });
  }

  // {IF defined (type: Color)}, which the parsed text has not any more.
  bool hasConditions(const FileUnit& unit) const {
    const std::vector<Segment>& segments = view_.sources().segments(unit.file);
    const FileId from = segments.empty() ? unit.file : view_.sources().fileOf(segments.front().from);
    return from && view_.sources().original(from).find("defined") != std::string_view::npos;
  }

  // Color_TO_INT, TO_Color.
  bool isConversion(std::string_view word) const {
    constexpr std::string_view kTo = "_TO_";
    const size_t size = name_.size();
    if (word.size() <= size + 3) return false;
    const bool is_source = sameIdentifier(word.substr(0, size), name_) && sameIdentifier(word.substr(size, 4), kTo);
    const size_t last = word.size() - size;
    return is_source ||
           (sameIdentifier(word.substr(last), name_) && sameIdentifier(word.substr(last - 3, 3), kTo.substr(1)));
  }

  bool hasWord(std::string_view text) const {
    for (size_t at = 0; at + name_.size() <= text.size(); ++at) {
      const size_t end = at + name_.size();
      if (sameIdentifier(text.substr(at, name_.size()), name_) && (at == 0 || !isNameCharacter(text[at - 1])) &&
          (end == text.size() || !isNameCharacter(text[end])))
        return true;
    }
    return false;
  }

  bool isDeclared(Loc loc) const {
    const std::optional<NamePlace> place = view_.meanings().at(loc);
    return place && place->loc == loc;
  }

  // In any case.
  bool mayHaveName(std::string_view text) const {
    const auto is_same = [](char a, char b) { return foldedCharacter(a) == b; };
    return std::search(text.begin(), text.end(), folded_.begin(), folded_.end(), is_same) != text.end();
  }

  const View& view_;
  const sema::Project& project_;
  std::string_view name_;
  std::string folded_;
  bool only_edits_;
  const std::vector<Range>& where_;
  NameId key_;
  std::unordered_set<uint64_t> known_;  // places in files
};

}  // namespace

bool knowsAllOccurrences(const View& view, std::string_view name, const Edits& known, const std::vector<Range>& where) {
  return Occurrences(view, name, known, false, where).areKnown();
}

bool areAllOccurrences(const View& view, std::string_view name, const Edits& known) {
  return Occurrences(view, name, known, true, {}).areKnown();
}

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/matching_words.h"

#include <algorithm>
#include <array>
#include <string>

#include "frontend/source/scanner.h"

namespace rung::ide {
namespace {

enum Construct : uint16_t {
  kIf = 1,
  kCase = 2,
  kFor = 4,
  kWhile = 8,
  kRepeat = 16,
  kTry = 32,
  kVar = 64,
  kStruct = 128,
  kType = 256,
  kPou = 512,
  kMember = 1024,
  kLoop = kFor | kWhile | kRepeat,
};
enum class Role : uint8_t { Opens, Continues, Closes };
struct BlockWord {
  std::string_view text;
  uint16_t of;  // Construct
  Role role;
};
constexpr BlockWord kWords[] = {
    {"IF", kIf, Role::Opens},
    {"THEN", kIf, Role::Continues},
    {"ELSIF", kIf, Role::Continues},
    {"ELSE", kIf | kCase, Role::Continues},
    {"END_IF", kIf, Role::Closes},
    {"CASE", kCase, Role::Opens},
    {"OF", kCase, Role::Continues},
    {"END_CASE", kCase, Role::Closes},
    {"FOR", kFor, Role::Opens},
    {"TO", kFor, Role::Continues},
    {"BY", kFor, Role::Continues},
    {"DO", kFor | kWhile, Role::Continues},
    {"END_FOR", kFor, Role::Closes},
    {"WHILE", kWhile, Role::Opens},
    {"END_WHILE", kWhile, Role::Closes},
    {"REPEAT", kRepeat, Role::Opens},
    {"UNTIL", kRepeat, Role::Continues},
    {"END_REPEAT", kRepeat, Role::Closes},
    {"EXIT", kLoop, Role::Continues},
    {"CONTINUE", kLoop, Role::Continues},
    {"__TRY", kTry, Role::Opens},
    {"__CATCH", kTry, Role::Continues},
    {"__FINALLY", kTry, Role::Continues},
    {"__ENDTRY", kTry, Role::Closes},
    {"VAR", kVar, Role::Opens},
    {"END_VAR", kVar, Role::Closes},
    {"STRUCT", kStruct, Role::Opens},
    {"UNION", kStruct, Role::Opens},
    {"END_STRUCT", kStruct, Role::Closes},
    {"END_UNION", kStruct, Role::Closes},
    {"TYPE", kType, Role::Opens},
    {"END_TYPE", kType, Role::Closes},
    {"FUNCTION", kPou, Role::Opens},
    {"FUNCTION_BLOCK", kPou, Role::Opens},
    {"PROGRAM", kPou, Role::Opens},
    {"CLASS", kPou, Role::Opens},
    {"INTERFACE", kPou, Role::Opens},
    {"METHOD", kMember, Role::Opens},
    {"ACTION", kMember, Role::Opens},
    {"PROPERTY", kMember, Role::Opens},
    {"RETURN", kPou | kMember, Role::Continues},
    {"END_FUNCTION", kPou, Role::Closes},
    {"END_FUNCTION_BLOCK", kPou, Role::Closes},
    {"END_PROGRAM", kPou, Role::Closes},
    {"END_CLASS", kPou, Role::Closes},
    {"END_INTERFACE", kPou, Role::Closes},
    {"END_METHOD", kMember, Role::Closes},
    {"END_ACTION", kMember, Role::Closes},
    {"END_PROPERTY", kMember, Role::Closes},
};

// What the word continues from further out than the innermost construct: EXIT in an IF of a loop.
bool reachesOut(const BlockWord& word) { return (word.of & (kLoop | kPou | kMember)) != 0; }

const BlockWord* findWord(std::string_view text) {
  constexpr size_t kLongest = 18;
  if (text.size() > kLongest) return nullptr;
  std::string word = upper(text);
  if (word.starts_with("VAR_")) word = "VAR";
  const auto found =
      std::find_if(std::begin(kWords), std::end(kWords), [&](const BlockWord& of) { return of.text == word; });
  return found == std::end(kWords) ? nullptr : found;
}

class Matcher {
 public:
  explicit Matcher(size_t offset) : offset_(offset) {}

  // The units of the construct that has the offset.
  std::vector<Unit> match(std::string_view source) {
    Scanner scanner(source);
    bool after_dot = false;  // `a.of` is a member
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
      const std::string_view text = scanner.textOf(unit);
      const BlockWord* const word = unit.kind == UnitKind::Name && !after_dot ? findWord(text) : nullptr;
      after_dot = text == ".";
      if (word != nullptr && take(*word, unit)) return std::move(open_.back().units);
      if (open_.empty() && unit.begin > offset_) return {};
    }
    for (Open& open : open_)
      if (hasOffset(open)) return std::move(open.units);
    return {};
  }

 private:
  struct Open {
    uint16_t of;
    std::vector<Unit> units;
  };

  bool hasOffset(const Open& open) const {
    return std::any_of(open.units.begin(), open.units.end(),
                       [&](const Unit& unit) { return unit.begin <= offset_ && offset_ <= unit.end; });
  }

  // True: the innermost construct ends, and has the offset.
  bool take(const BlockWord& word, const Unit& unit) {
    if (word.role == Role::Opens) {
      open_.push_back({word.of, {unit}});
      return false;
    }
    auto at = open_.rbegin();
    const bool searches = word.role == Role::Closes || reachesOut(word);
    while (at != open_.rend() && (at->of & word.of) == 0 && searches) ++at;
    if (at == open_.rend() || (at->of & word.of) == 0) return false;
    at->units.push_back(unit);
    if (word.role != Role::Closes) return false;
    while (&open_.back() != &*at) {  // it has no end
      if (hasOffset(open_.back())) return true;
      open_.pop_back();
    }
    if (hasOffset(open_.back())) return true;
    open_.pop_back();
    return false;
  }

  size_t offset_;
  std::vector<Open> open_;
};

}  // namespace

std::vector<FileRange> matchingWords(const View& view, FileId file, uint32_t byte) {
  const Loc parsed = view.parsedAt(file, byte);
  const FileUnit* const unit = parsed ? view.unitWith(parsed) : nullptr;
  if (unit == nullptr) return {};
  const Loc base = view.sources().begin(unit->file);
  std::vector<FileRange> words;
  for (const Unit& word : Matcher(parsed.offset - base.offset).match(view.sources().sourceText(unit->file))) {
    const Loc loc{base.offset + static_cast<uint32_t>(word.begin)};
    const FileRange at = view.bytesInFile(loc, static_cast<uint32_t>(word.end - word.begin));
    if (at.file == file) words.push_back(at);
  }
  return words;
}

}  // namespace rung::ide

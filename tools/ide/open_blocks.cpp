// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/open_blocks.h"

#include <algorithm>
#include <array>

#include "frontend/source/text.h"

namespace rung::ide {
namespace {

enum class BodyWord : uint8_t { Other, Opens, Closes, Branch, EndOfPou, BeginOfPou };

BodyWord meaningOf(std::string_view text) {
  constexpr std::array<std::string_view, 5> kOpens = {"IF", "CASE", "FOR", "WHILE", "REPEAT"};
  constexpr std::array<std::string_view, 8> kPous = {"PROGRAM", "FUNCTION",  "FUNCTION_BLOCK", "METHOD",
                                                     "ACTION",  "INTERFACE", "CLASS",          "PROPERTY"};
  const std::string word = upper(text);
  const auto is = [&](const auto& words) { return std::find(words.begin(), words.end(), word) != words.end(); };
  if (is(kOpens)) return BodyWord::Opens;
  if (is(kPous)) return BodyWord::BeginOfPou;
  if (word == "ELSE" || word == "ELSIF") return BodyWord::Branch;
  if (!word.starts_with("END_")) return BodyWord::Other;
  const std::string of = word.substr(4);
  const bool closes = std::find(kOpens.begin(), kOpens.end(), of) != kOpens.end();
  return closes ? BodyWord::Closes : BodyWord::EndOfPou;
}

// The tokens of a CASE from its OF on, until its end or that of the POU.
class LabelReader {
 public:
  explicit LabelReader(Branches& into) : into_(into) {}

  // False: the block ends.
  bool take(std::string_view text, bool is_name, std::string_view next, bool is_before) {
    const BodyWord word = is_name ? meaningOf(text) : BodyWord::Other;
    if (word == BodyWord::Opens) ++depth_;
    if (word == BodyWord::Closes && depth_-- == 0) return false;
    if (word == BodyWord::EndOfPou) return false;
    if (depth_ != 0) return true;
    if (word == BodyWord::Branch && is_before) into_.is_in_else = true;
    if (text == "(" || text == "[") ++parentheses_;
    if (text == ")" || text == "]") --parentheses_;
    if (text == ";" || text == "=") pending_.clear();
    if (parentheses_ != 0) return true;
    if (is_name) last_ = upper(text);
    if (text == "," || (text == ":" && next != "=")) {
      if (!last_.empty()) pending_.push_back(last_);
      last_.clear();
    }
    if (text == ":" && next != "=") {
      into_.has_label = into_.has_label || is_before;
      into_.labels.insert(into_.labels.end(), pending_.begin(), pending_.end());
      pending_.clear();
    }
    return true;
  }

 private:
  Branches& into_;
  int depth_ = 0, parentheses_ = 0;
  std::string last_;
  std::vector<std::string> pending_;
};

std::vector<Unit> unitsAfter(const Cursor& cursor) {
  Scanner scanner(cursor.source);
  size_t at = cursor.offset;
  while (at < cursor.source.size() && isNameCharacter(cursor.source[at])) ++at;
  scanner.moveTo(at);
  std::vector<Unit> units;
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
    units.push_back(unit);
    const BodyWord word = unit.kind == UnitKind::Name ? meaningOf(scanner.textOf(unit)) : BodyWord::Other;
    if (word == BodyWord::EndOfPou || word == BodyWord::BeginOfPou) break;
  }
  return units;
}

}  // namespace

Following followingOf(const Cursor& cursor) {
  Following result;
  size_t depth = 0;
  bool is_in_label = true;  // what precedes a colon
  const std::vector<Unit> units = unitsAfter(cursor);
  const auto textOf = [&](size_t at) {
    return at < units.size() ? cursor.source.substr(units[at].begin, units[at].end - units[at].begin)
                             : std::string_view();
  };
  for (size_t at = 0; at < units.size(); ++at) {
    const std::string_view text = textOf(at);
    const BodyWord word = units[at].kind == UnitKind::Name ? meaningOf(text) : BodyWord::Other;
    if (word == BodyWord::EndOfPou) result.closes_pou = true;
    if (word == BodyWord::EndOfPou || word == BodyWord::BeginOfPou) break;
    if (word == BodyWord::Opens) ++depth;
    if (word == BodyWord::Closes && depth == 0) ++result.closed;
    if (word == BodyWord::Closes && depth > 0) --depth;
    if (word == BodyWord::Branch && depth == 0 && result.closed == 0) result.has_branch = true;
    if (text == ";" || text == "(") is_in_label = text == ";";
    if (text == ":" && textOf(at + 1) != "=" && is_in_label && depth == 0 && result.closed == 0)
      result.has_branch = true;
    result.has_statement = true;
  }
  return result;
}

Branches branchesAt(const Cursor& cursor, const CompletionContext& context) {
  Branches result;
  if (context.blocks.empty()) return result;
  const size_t count = cursor.units.size();
  size_t at = context.blocks.back() + 1;
  const bool is_case = sameIdentifier(cursor.text(at - 1), "CASE");
  while (is_case && at < count && !sameIdentifier(cursor.text(at), "OF")) ++at;
  LabelReader labels(result);
  for (++at; at < count; ++at)
    labels.take(cursor.text(at), cursor.units[at].kind == UnitKind::Name, at + 1 < count ? cursor.text(at + 1) : "",
                true);
  if (!is_case) return result;
  const std::vector<Unit> units = unitsAfter(cursor);
  const auto textOf = [&](size_t i) {
    return i < units.size() ? cursor.source.substr(units[i].begin, units[i].end - units[i].begin) : std::string_view();
  };
  for (size_t i = 0; i < units.size(); ++i)
    if (!labels.take(textOf(i), units[i].kind == UnitKind::Name, textOf(i + 1), false)) break;
  return result;
}

}  // namespace rung::ide

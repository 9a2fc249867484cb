// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/clause.h"

#include <algorithm>
#include <array>

#include "tools/ide/keywords.h"

namespace rung::ide {
namespace {

template <size_t count>
bool isOneOf(std::string_view word, const std::array<std::string_view, count>& words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view other) { return sameIdentifier(word, other); });
}

constexpr std::array<std::string_view, 7> kBeforeStatement = {"THEN",  "ELSE",    "DO",       "REPEAT",
                                                              "__TRY", "__CATCH", "__FINALLY"};
constexpr std::array<std::string_view, 6> kEndsClause = {"THEN", "DO", "OF", "ELSE", "ELSIF", "UNTIL"};
constexpr std::array<std::string_view, 9> kBeginsStatement = {"IF",     "CASE", "FOR", "WHILE",   "REPEAT",
                                                              "RETURN", "EXIT", "JMP", "CONTINUE"};
constexpr std::array<std::string_view, 7> kOperators = {"AND", "OR", "XOR", "MOD", "AND_THEN", "OR_ELSE", "NOT"};

// The sign of `TOD#12:30:01`.
bool isInTime(std::string_view source, const Unit& sign) {
  const auto is_digit = [&](size_t at) { return at < source.size() && source[at] >= '0' && source[at] <= '9'; };
  return sign.begin > 0 && is_digit(sign.begin - 1) && is_digit(sign.end);
}

bool isEnd(std::string_view word) { return upper(word).starts_with("END_"); }

class ClauseReader {
 public:
  ClauseReader(const View& view, const Cursor& cursor, const CompletionContext& context)
      : view_(view), cursor_(cursor), context_(context) {}

  Clause read() {
    const size_t count = cursor_.units.size(), first = firstUnit();
    const size_t end = cursor_.offset - cursor_.prefix.size();
    const size_t begin = first < count ? cursor_.units[first].begin : end;
    clause_.before = flat(begin, end);
    readAfter();
    const std::string_view head = first < count ? cursor_.text(first) : std::string_view();
    clause_.is_begin = first == count || (cursor_.before() == "." && beginOfPath(cursor_, count - 1) == first);
    close();
    finish(head);
    return std::move(clause_);
  }

 private:
  // After what ends the statement before.
  size_t firstUnit() const {
    for (size_t at = cursor_.units.size(); at-- > context_.body;) {
      const std::string_view text = cursor_.text(at);
      const bool is_name = cursor_.units[at].kind == UnitKind::Name;
      if (text == ";" || (is_name && (isOneOf(text, kBeforeStatement) || isEnd(text)))) return at + 1;
      if (is_name && sameIdentifier(text, "OF")) return at + 1;
      const bool assigns = at + 1 < cursor_.units.size() && cursor_.text(at + 1) == "=";
      if (text == ":" && !assigns && !isInTime(cursor_.source, cursor_.units[at])) return at + 1;
    }
    return std::min(context_.body, cursor_.units.size());
  }

  // Without comments and line ends.
  std::string flat(size_t begin, size_t end) const {
    std::string out;
    Scanner scanner(cursor_.source);
    scanner.moveTo(begin);
    size_t last = begin;
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End && unit.begin < end; unit = scanner.nextCode()) {
      if (unit.begin > last) out += ' ';
      last = std::min<size_t>(unit.end, end);
      out += cursor_.source.substr(unit.begin, last - unit.begin);
    }
    if (end > last) out += ' ';
    return out;
  }

  bool isOnLaterLine(size_t from, size_t to) const {
    return cursor_.source.substr(from, to - from).find('\n') != std::string_view::npos;
  }

  void readAfter() {
    size_t begin = cursor_.offset;
    while (begin < cursor_.source.size() && isNameCharacter(cursor_.source[begin])) ++begin;
    Scanner scanner(cursor_.source);
    scanner.moveTo(begin);
    size_t last = begin;
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
      if (endsBefore(unit, scanner.textOf(unit), last, last == begin)) break;
      last = unit.end;
    }
    clause_.after = flat(begin, last);
    clause_.ends_here = last == begin && !isLabel();
  }

  bool endsBefore(const Unit& unit, std::string_view text, size_t last, bool is_first) const {
    if (text == ";") return true;
    const bool is_later = isOnLaterLine(last, unit.begin);
    if (is_first && is_later) return true;
    if (text == ":" && !cursor_.source.substr(unit.end).starts_with('=') && isInLabel() &&
        !isInTime(cursor_.source, unit))
      return true;
    if (unit.kind != UnitKind::Name) return false;
    if (isEnd(text) || isOneOf(text, kEndsClause) || (is_later && isOneOf(text, kBeginsStatement))) return true;
    return is_first && !isOneOf(text, kOperators) && context_.writes == Writes::Statement;  // of the next statement
  }

  // Where the label of a CASE may be.
  bool isInLabel() const {
    return !context_.blocks.empty() && sameIdentifier(cursor_.text(context_.blocks.back()), "CASE");
  }

  // Closes what is open.
  void close() {
    std::string open;
    for (const std::string* part : {&clause_.before, &clause_.after}) {
      Scanner scanner(*part);
      for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
        const std::string_view text = scanner.textOf(unit);
        if (text == "(") open += ')';
        if (text == "[") open += ']';
        if ((text == ")" || text == "]") && !open.empty()) open.pop_back();
      }
    }
    clause_.after.append(open.rbegin(), open.rend());
  }

  bool hasWord(std::string_view word) const {
    for (const std::string* part : {&clause_.before, &clause_.after}) {
      Scanner scanner(*part);
      for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode())
        if (sameIdentifier(scanner.textOf(unit), word)) return true;
    }
    return false;
  }

  void wrap(std::string_view head, std::string_view by, std::string_view end) {
    clause_.before = std::string(by) + clause_.before.substr(head.size());
    clause_.after += end;
  }

  void finish(std::string_view head) {
    if (isOneOf(head, std::array<std::string_view, 2>{"IF", "ELSIF"})) return wrap(head, "IF", " THEN END_IF;");
    if (sameIdentifier(head, "WHILE")) return wrap(head, "WHILE", " DO END_WHILE;");
    if (sameIdentifier(head, "CASE")) return wrap(head, "CASE", " OF ELSE END_CASE;");
    if (sameIdentifier(head, "UNTIL")) return wrap(head, "REPEAT UNTIL", " END_REPEAT;");
    if (sameIdentifier(head, "FOR")) {
      if (!hasWord("=")) clause_.after += " := 0";
      if (!hasWord("TO")) clause_.after += " TO 9";
      return wrap(head, "FOR", " DO END_FOR;");
    }
    if (isLabel()) return wrap({}, "CASE " + selector() + " OF ", ": ; END_CASE;");
    if (clause_.before.empty() && clause_.after.empty()) return;  // a statement has its `;`
    clause_.after += ';';
  }

  bool isLabel() const {
    if (!isInLabel() || hasWord("=")) return false;
    size_t at = cursor_.offset;
    Scanner scanner(cursor_.source);
    scanner.moveTo(at);
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
      const std::string_view text = scanner.textOf(unit);
      if (text == ";" || text == "(" || text == "=") return false;
      if (text == ":" && !isInTime(cursor_.source, unit)) return !cursor_.source.substr(unit.end).starts_with('=');
    }
    return false;
  }
  std::string selector() const {
    const size_t at = context_.blocks.back() + 1;
    for (size_t end = at; end < cursor_.units.size(); ++end)
      if (sameIdentifier(cursor_.text(end), "OF")) return flat(cursor_.units[at].begin, cursor_.units[end].begin);
    return "0";
  }

  const View& view_;
  const Cursor& cursor_;
  const CompletionContext& context_;
  Clause clause_;
};

}  // namespace

Clause clauseAround(const View& view, const Cursor& cursor, const CompletionContext& context) {
  return ClauseReader(view, cursor, context).read();
}

}  // namespace rung::ide

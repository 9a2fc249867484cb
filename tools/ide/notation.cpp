// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/notation.h"

#include <algorithm>

#include "tools/ide/default_values.h"

namespace rung::ide {
namespace {

bool is(std::string_view a, std::string_view b) { return sameIdentifier(a, b); }

// The tokens of one element, up to its `;`.
struct Element {
  std::vector<std::string_view> tokens;

  std::string_view token(size_t at) const { return at < tokens.size() ? tokens[at] : std::string_view(); }
  std::string_view word() const { return token(0); }
  // `TON` and `timer` of `box 3 TON (timer) […]`
  std::string_view callee() const { return is(word(), "box") && token(2) != "(" ? token(2) : std::string_view(); }
  std::string_view operand() const {
    const auto open = std::find(tokens.begin(), tokens.end(), "(");
    const auto end =
        std::find_if(tokens.begin(), tokens.end(), [](std::string_view t) { return t == "[" || t == ":"; });
    return open < end && open + 1 != tokens.end() && open + 2 != tokens.end() && open[2] == ")" ? open[1] : "";
  }
};

class NotationReader {
 public:
  NotationReader(const View& view, const Cursor& cursor)
      : view_(view), cursor_(cursor), scope_(view.meanings().scope()), pou_(declOf(view, cursor)) {}

  Notation read() {
    readElement();
    if (pou_.body_kind == BodyKind::Sfc)
      inChart();
    else
      inNetworks();
    return std::move(notation_);
  }

 private:
  static const PouDecl& declOf(const View& view, const Cursor& cursor) {
    return view.tree().as<PouDecl>(view.meanings().scope().project().pou(cursor.pou).decl);
  }

  // What the cursor is in, before it and after it.
  void readElement() {
    size_t at = cursor_.units.size();
    while (at > 0 && cursor_.text(at - 1) != ";" && !endsSection(cursor_.text(at - 1))) --at;
    for (; at < cursor_.units.size(); ++at) before_.tokens.push_back(cursor_.text(at));
    size_t from = cursor_.offset;
    while (from < cursor_.source.size() && isNameCharacter(cursor_.source[from])) ++from;
    Scanner scanner(cursor_.source);
    scanner.moveTo(from);
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End && scanner.textOf(unit) != ";";
         unit = scanner.nextCode())
      after_.tokens.push_back(scanner.textOf(unit));
  }
  static bool endsSection(std::string_view text) {
    return is(text, "END_VAR") || is(text, "END_STEP") || is(text, "END_TRANSITION");
  }

  // ---- charts

  void inChart() {
    const std::vector<std::string_view>& tokens = before_.tokens;
    const std::string_view word = before_.word();
    if (is(word, "TRANSITION")) {
      const auto sign = std::find(tokens.begin(), tokens.end(), "FROM");
      bool is_value = false;
      for (size_t at = 1; at < tokens.size(); ++at)
        is_value =
            is_value || (tokens[at] == "=" && tokens[at - 1] == ":" && sign < tokens.begin() + static_cast<long>(at));
      if (is_value)
        value(afterSign(), types::kBool);
      else if (sign != tokens.end())
        notation_.place = NotationPlace::Step;
      return;
    }
    const bool is_step = is(word, "STEP") || is(word, "INITIAL_STEP");
    const bool begins = tokens.empty() || (is_step && tokens.back() == ":");
    if (begins && isInStep()) notation_.place = NotationPlace::Action;
  }

  bool isInStep() const {
    for (size_t at = cursor_.units.size(); at-- > 0;) {
      if (is(cursor_.text(at), "STEP") || is(cursor_.text(at), "INITIAL_STEP")) return true;
      if (endsSection(cursor_.text(at))) return false;
    }
    return false;
  }

  // What precedes the cursor after the last `:=`.
  std::string afterSign() const {
    std::string out;
    for (size_t at = before_.tokens.size(); at-- > 1;) {
      if (before_.tokens[at] == "=" && before_.tokens[at - 1] == ":") break;
      out.insert(0, std::string(before_.tokens[at]) + " ");
    }
    return out;
  }

  // ---- values

  std::string joined(const std::vector<std::string_view>& tokens, size_t end) const {
    std::string out;
    for (size_t at = 0; at < std::min(end, tokens.size()); ++at) out += " " + std::string(tokens[at]);
    return out;
  }
  // The rest of what is in the parentheses around the cursor.
  std::string restOfOperand() const {
    int depth = 0;
    size_t at = 0;
    for (; at < after_.tokens.size(); ++at) {
      if (after_.tokens[at] == "(" || after_.tokens[at] == "[") ++depth;
      if ((after_.tokens[at] == ")" || after_.tokens[at] == "]") && depth-- == 0) break;
    }
    return joined(after_.tokens, at);
  }

  void value(std::string before, TypeId expected) {
    notation_.place = NotationPlace::Value;
    notation_.expected = expected;
    std::string after = pou_.body_kind == BodyKind::Sfc ? joined(after_.tokens, after_.tokens.size()) : restOfOperand();
    notation_.clause = {"IF " + before, after + " THEN END_IF;", false, false};
  }

  // ---- networks

  void inNetworks() {
    const std::vector<std::string_view>& tokens = before_.tokens;
    std::vector<size_t> open;
    for (size_t at = 0; at < tokens.size(); ++at) {
      if (tokens[at] == "(" || tokens[at] == "[") open.push_back(at);
      if ((tokens[at] == ")" || tokens[at] == "]") && !open.empty()) open.pop_back();
    }
    if (open.empty()) {
      if (is(before_.word(), "box") && tokens.size() == 2) {
        notation_.place = NotationPlace::Callee;
        const auto parenthesis = after_.token(0) == "(" ? after_.token(1) : std::string_view();
        notation_.instance = parenthesis;
        givenPins();
      }
      return;
    }
    const size_t at = open.back();
    const bool follows_number =
        at > 0 && !tokens[at - 1].empty() && tokens[at - 1][0] >= '0' && tokens[at - 1][0] <= '9';
    if (tokens[at] == "[") {
      if (tokens.back() == "[" || tokens.back() == ",") pin();
    } else if (follows_number && (open.size() > 1 || at > 2)) {
      wire(tokens[at - 1]);
    } else {
      operand(at);
    }
  }

  void givenPins() {
    for (const Element* part : {&before_, &after_})
      for (size_t at = 0; at + 1 < part->tokens.size(); ++at) {
        const std::string_view next = part->tokens[at + 1], before = at > 0 ? part->tokens[at - 1] : "";
        const bool is_name = !part->tokens[at].empty() && isNameStart(part->tokens[at][0]);
        const bool begins = before == "[" || before == "," || (part == &after_ && at == 0);
        if (is_name && begins &&
            (next == ":" || next == "=" || is(next, "NOT") || is(next, "RISING") || is(next, "FALLING") ||
             is(next, "SET") || is(next, "RESET")))
          notation_.given.emplace_back(part->tokens[at]);
      }
  }
  static bool isNameStart(char c) { return isNameCharacter(c) && (c < '0' || c > '9'); }

  void pin() {
    notation_.place = NotationPlace::Pin;
    notation_.callee = calleeOf(before_);
    givenPins();
    notation_.is_output = after_.token(0) == "=";
  }

  void wire(std::string_view number) {
    const std::optional<Element> from = elementOf(number);
    notation_.callee = from ? calleeOf(*from) : PouId{};
    if (notation_.callee) notation_.place = NotationPlace::Output;
  }

  PouId calleeOf(const Element& element) const {
    const std::string_view name = element.callee();
    const NameId id = name.empty() ? NameId{} : view_.names().find(name);
    if (!id) return {};
    const NameId key = view_.names().key(id);
    if (const Entity type = scope_.typeNamed(key); type.entityKind() == EntityKind::Pou) return {type.index};
    const Entity member = scope_.lookUp(cursor_.pou, key);  // a method or an action
    return member.entityKind() == EntityKind::Pou ? PouId{member.index} : PouId{};
  }

  // Of the elements of the body, as tokens: the tree has not those with an error.
  template <class Use>
  void forEachElement(Use use) const {
    const Loc base = cursor_.base;
    const size_t begin = pou_.body_begin ? pou_.body_begin.offset - base.offset : 0;
    const size_t end = pou_.body_end ? pou_.body_end.offset - base.offset : cursor_.source.size();
    if (begin > end || end > cursor_.source.size()) return;
    Scanner scanner(cursor_.source);
    scanner.moveTo(begin);
    Element element;
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End && unit.begin < end; unit = scanner.nextCode()) {
      const std::string_view text = scanner.textOf(unit);
      if (text != ";") {
        element.tokens.push_back(text);
        continue;
      }
      if (use(element)) return;
      element.tokens.clear();
    }
  }

  std::optional<Element> elementOf(std::string_view number) const {
    std::optional<Element> found;
    forEachElement([&](const Element& element) {
      if (element.token(1) == number) found = element;
      return found.has_value();
    });
    return found;
  }

  void operand(size_t open) {
    std::string before;
    for (size_t at = open + 1; at < before_.tokens.size(); ++at) before += std::string(before_.tokens[at]) + " ";
    const std::string_view word = before_.word();
    if (is(word, "contact")) return value(before, types::kBool);
    if (is(word, "coil")) return target(before, types::kBool, "TRUE");
    if (is(word, "output")) return target(before, {}, sourceOf());
    if (is(word, "input") || is(word, "inout")) return input(before);
    if (is(word, "box")) {
      notation_.place = NotationPlace::Instance;
      notation_.callee = calleeOf(before_);
    }
  }

  void target(const std::string& before, TypeId expected, const std::string& source) {
    notation_.place = NotationPlace::Target;
    notation_.expected = expected;
    const std::string rest = restOfOperand();
    notation_.clause = {before, rest + " := " + source + ";", false, false};
  }

  // Of `output 4 (|) := 3(Q)`, `timer.Q`; else a value that any type can hold.
  std::string sourceOf() const {
    for (size_t at = 0; at + 3 < after_.tokens.size(); ++at) {
      if (after_.tokens[at] != ":" || after_.tokens[at + 1] != "=") continue;
      const std::optional<Element> from = elementOf(after_.tokens[at + 2]);
      if (!from) break;
      if (is(from->word(), "input") || is(from->word(), "contact")) return std::string(from->operand());
      if (after_.tokens[at + 3] != "(") break;
      const std::string_view pin = after_.token(at + 4);
      if (!from->operand().empty()) return std::string(from->operand()) + "." + std::string(pin);
      return valueOfPin(calleeOf(*from), pin);
    }
    return "0";
  }

  // Of the type of a pin.
  std::string valueOfPin(PouId callee, std::string_view name) const {
    for (const VarId pin : scope_.pinsOf(callee))
      if (is(view_.names().string(scope_.project().var(pin).name), name))
        if (std::string value = DefaultValues(view_, cursor_.pou).literalOf(scope_.project().var(pin).type);
            !value.empty())
          return value;
    return "0";
  }

  // What reads `input 3 (|)`: a pin of an instance, an output.
  void input(const std::string& before) {
    value(before, {});
    const std::string_view number = before_.token(1);
    forEachElement([&](const Element& element) {
      for (size_t at = 2; at < element.tokens.size(); ++at) {
        const bool begins_wire = is(element.tokens[at - 1], "OR") || element.tokens[at - 1] == "=";
        if (element.tokens[at] != number || !begins_wire) continue;
        readBy(element, at, before);
        return true;
      }
      return false;
    });
  }

  void readBy(const Element& reader, size_t wire, const std::string& before) {
    const std::string rest = restOfOperand();
    if (is(reader.word(), "output")) {
      notation_.clause = {std::string(reader.operand()) + " := " + before, rest + ";", false, false};
    } else if (is(reader.word(), "coil") || is(reader.word(), "contact")) {
      notation_.expected = types::kBool;
    } else if (is(reader.word(), "box")) {
      size_t at = wire;
      while (at > 0 && reader.tokens[at] != "[" && reader.tokens[at] != ",") --at;
      const std::string pin(reader.token(at + 1));
      const PouId callee = calleeOf(reader);
      const std::string called(reader.operand().empty() ? reader.callee() : reader.operand());
      for (const VarId var : scope_.pinsOf(callee)) {
        if (!is(view_.names().string(scope_.project().var(var).name), pin)) continue;
        const TypeId type = scope_.project().var(var).type;
        if (!types::TypeTable::isGeneric(scope_.project().types.kind(type))) notation_.expected = type;
        if (!reader.operand().empty())
          notation_.clause = {called + "(" + pin + " := " + before, rest + ");", false, false};
      }
    }
  }

  const View& view_;
  const Cursor& cursor_;
  const Scope& scope_;
  const PouDecl& pou_;
  Element before_, after_;
  Notation notation_;
};

}  // namespace

bool isInNotation(const View& view, const Cursor& cursor) {
  if (!cursor.pou) return false;
  const DeclId decl = view.meanings().scope().project().pou(cursor.pou).decl;
  if (!decl || view.tree().kind(decl) != DeclKind::Pou) return false;
  const PouDecl& pou = view.tree().as<PouDecl>(decl);
  if (pou.body_kind == BodyKind::Sfc || pou.body_kind == BodyKind::Network) return true;
  // Networks with a mistake have no elements.
  if (pou.body_kind != BodyKind::None || !pou.body_begin) return false;
  return view.sources().tokenAt(pou.body_begin).starts_with("{network") ||
         cursor.source.substr(pou.body_begin.offset - cursor.base.offset).starts_with("{network");
}

Notation notationAt(const View& view, const Cursor& cursor) { return NotationReader(view, cursor).read(); }

}  // namespace rung::ide

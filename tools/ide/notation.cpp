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
  // The operand when it is one name.
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
    size_t at = before_.tokens.size();
    while (at > 1 && !(before_.tokens[at - 1] == "=" && before_.tokens[at - 2] == ":")) --at;
    return joined(before_.tokens, at, before_.tokens.size()) + " ";
  }

  // ---- values

  // As they are in the source, on one line.
  static std::string joined(const std::vector<std::string_view>& tokens, size_t begin, size_t end) {
    std::string out;
    for (size_t at = begin; at < std::min(end, tokens.size()); ++at) {
      const bool is_adjacent = at > begin && tokens[at - 1].data() + tokens[at - 1].size() == tokens[at].data();
      out += (is_adjacent ? "" : " ") + std::string(tokens[at]);
    }
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
    return joined(after_.tokens, 0, at);
  }

  void value(std::string before, TypeId expected) {
    notation_.place = NotationPlace::Value;
    notation_.expected = expected;
    std::string after =
        pou_.body_kind == BodyKind::Sfc ? joined(after_.tokens, 0, after_.tokens.size()) : restOfOperand();
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
    if (after_.token(0) != ":" || after_.token(1) != "=") return;
    const std::string value = valueOf(after_, 2, kMostBoxes);
    if (!value.empty()) notation_.clause = {calledBy(before_) + "(", " := " + value + ");", false, false};
  }

  void wire(std::string_view number) {
    const std::optional<Element> from = elementOf(number);
    notation_.callee = from ? calleeOf(*from) : PouId{};
    if (!notation_.callee) return;
    notation_.place = NotationPlace::Output;
    notation_.box = from->operand();
    size_t sign = before_.tokens.size();
    while (sign > 1 && !(before_.token(sign - 1) == "=" && before_.token(sign - 2) == ":")) --sign;
    if (sign > 1) notation_.clause = readerAt(before_, sign);
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
    const std::string before = joined(before_.tokens, open + 1, before_.tokens.size());
    const std::string_view word = before_.word();
    if (is(word, "contact")) return value(before, types::kBool);
    if (is(word, "coil")) return target(before, types::kBool, "TRUE");
    if (is(word, "output")) return target(before, {}, sourceOf());
    if (is(word, "input") || is(word, "inout")) return input(before);
    if (is(word, "box")) {
      notation_.place = NotationPlace::Instance;
      notation_.callee = calleeOf(before_);
      notation_.box = before_.callee();
      Element whole = before_;
      whole.tokens.insert(whole.tokens.end(), after_.tokens.begin(), after_.tokens.end());
      const std::string call = callOf(whole, {}, kMostBoxes);
      notation_.clause = {{}, call.substr(call.find('(')) + ");", false, false};
    }
  }

  void target(const std::string& before, TypeId expected, const std::string& source) {
    notation_.place = NotationPlace::Target;
    notation_.expected = expected;
    const std::string rest = restOfOperand();
    notation_.clause = {before, rest + " := " + source + ";", false, false};
  }

  // Of `output 4 (|) := 3(Q)`, `timer.Q`; else a value that many types can hold.
  std::string sourceOf() const {
    for (size_t at = 0; at + 2 < after_.tokens.size(); ++at) {
      if (after_.tokens[at] != ":" || after_.tokens[at + 1] != "=") continue;
      const std::string value = valueOf(after_, at + 2, kMostBoxes);
      return value.empty() ? "0" : value;
    }
    return "0";
  }

  // ---- boxes and wires as ST

  std::string operandOf(const Element& element) const {
    const auto open = std::find(element.tokens.begin(), element.tokens.end(), "(");
    if (open == element.tokens.end()) return {};
    size_t end = static_cast<size_t>(open - element.tokens.begin()) + 1, depth = 1;
    const size_t begin = end;
    for (; end < element.tokens.size(); ++end) {
      if (element.tokens[end] == "(") ++depth;
      if (element.tokens[end] == ")" && --depth == 0) break;
    }
    return joined(element.tokens, begin, end);
  }

  // The instance, or the function.
  static std::string calledBy(const Element& box) {
    return std::string(box.operand().empty() ? box.callee() : box.operand());
  }

  // Of the wire `3(Q)` that begins at a token; empty: it has no value that can be written.
  std::string valueOf(const Element& reader, size_t at, int boxes) const {
    const std::optional<Element> from = elementOf(reader.token(at));
    if (!from || boxes == 0) return {};
    if (is(from->word(), "contact")) return "FALSE";
    if (is(from->word(), "input") || is(from->word(), "inout")) return operandOf(*from);
    if (is(from->word(), "compose")) {
      const TypeId type = scope_.typeOf(scope_.typeNamed(keyOf(from->token(2))));
      return type ? DefaultValues(view_, cursor_.pou).variableOf(type) : std::string();
    }
    if (!is(from->word(), "box")) return {};
    const std::string_view pin = reader.token(at + 1) == "(" ? reader.token(at + 2) : std::string_view();
    if (!from->operand().empty()) return pin.empty() ? std::string() : calledBy(*from) + "." + std::string(pin);
    const PouId callee = calleeOf(*from);
    if (callee && scope_.project().pou(callee).kind == PouKind::Function && isResult(callee, pin))
      return callOf(*from, {}, boxes - 1) + ")";
    return valueOfPin(callee, pin);
  }
  bool isResult(PouId function, std::string_view pin) const {
    const std::vector<VarId> pins = scope_.pinsOf(function);
    return std::none_of(pins.begin(), pins.end(), [&](VarId of) {
      return scope_.project().var(of).section == SectionKind::Output &&
             is(view_.names().string(scope_.project().var(of).name), pin);
    });
  }

  // `SUB(IN2 := ambient`: without one pin.
  std::string callOf(const Element& box, std::string_view without, int boxes) const {
    std::string out = calledBy(box) + "(";
    bool is_first = true;
    for (size_t at = 1; at + 3 < box.tokens.size(); ++at) {
      if (box.tokens[at] != "[" && box.tokens[at] != ",") continue;
      if (box.tokens[at + 2] != ":" || box.tokens[at + 3] != "=" || is(box.tokens[at + 1], without)) continue;
      const std::string value = is(box.tokens[at + 1], "EN") ? std::string() : valueOf(box, at + 4, boxes);
      if (value.empty()) continue;
      out += (is_first ? "" : ", ") + std::string(box.tokens[at + 1]) + " := " + value;
      is_first = false;
    }
    return out;
  }

  // Of the type of a pin.
  std::string valueOfPin(PouId callee, std::string_view name) const {
    for (const VarId pin : scope_.pinsOf(callee))
      if (is(view_.names().string(scope_.project().var(pin).name), name))
        return DefaultValues(view_, cursor_.pou).typedLiteralOf(scope_.project().var(pin).type);
    return {};
  }

  // What reads `input 3 (|)`: a pin of a box, an output.
  void input(const std::string& before) {
    value(before, {});
    const std::string_view number = before_.token(1);
    forEachElement([&](const Element& element) {
      for (size_t at = 2; at < element.tokens.size(); ++at) {
        const bool begins_wire = is(element.tokens[at - 1], "OR") || element.tokens[at - 1] == "=";
        if (element.tokens[at] != number || !begins_wire) continue;
        Clause clause = readerAt(element, at);
        if (clause.before.empty()) continue;
        clause.before += before;
        clause.after = restOfOperand() + clause.after;
        notation_.clause = std::move(clause);
        return true;
      }
      return false;
    });
  }

  // The statement around the wire that begins at a token. Notes the type that is expected.
  Clause readerAt(const Element& reader, size_t wire) {
    if (is(reader.word(), "output")) return {operandOf(reader) + " := ", ";", false, false};
    if (is(reader.word(), "coil") || is(reader.word(), "contact")) {
      notation_.expected = types::kBool;
      return {"IF ", " THEN END_IF;", false, false};
    }
    size_t at = std::min(wire, reader.tokens.size());
    while (at > 0 && reader.token(at) != "[" && reader.token(at) != ",") --at;
    const std::string_view pin = reader.token(at + 1);
    if (is(reader.word(), "compose")) {  // a member of a structure
      const TypeId type = scope_.typeOf(scope_.typeNamed(keyOf(reader.token(2))));
      const std::string whole = type ? DefaultValues(view_, cursor_.pou).variableOf(type) : std::string();
      if (whole.empty()) return {};
      return {whole + "." + std::string(pin) + " := ", ";", false, false};
    }
    if (!is(reader.word(), "box")) return {};
    for (const VarId var : scope_.pinsOf(calleeOf(reader))) {
      const TypeId type = scope_.project().var(var).type;
      const bool is_it = is(view_.names().string(scope_.project().var(var).name), pin);
      if (is_it && !types::TypeTable::isGeneric(scope_.project().types.kind(type))) notation_.expected = type;
    }
    const std::string call = callOf(reader, pin, kMostBoxes);
    return {call + (call.ends_with('(') ? "" : ", ") + std::string(pin) + " := ", ");", false, false};
  }

  NameId keyOf(std::string_view name) const { return view_.names().key(view_.names().find(name)); }

  static constexpr int kMostBoxes = 3;  // within each other

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

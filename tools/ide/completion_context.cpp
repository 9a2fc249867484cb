// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion_context.h"

#include <algorithm>
#include <initializer_list>

#include "tools/ide/keywords.h"

namespace rung::ide {
namespace {

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view other) { return sameIdentifier(word, other); });
}

bool beginsSection(std::string_view word) {
  return isOneOf(word, {"VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "VAR_EXTERNAL", "VAR_GLOBAL",
                        "VAR_STAT", "VAR_INST", "VAR_ACCESS", "VAR_CONFIG", "VAR_GENERIC"});
}
bool beginsPou(std::string_view word) {
  return isOneOf(word, {"PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "CLASS", "INTERFACE", "METHOD", "ACTION", "PROPERTY",
                        "GET", "SET"});
}
bool endsPou(std::string_view word) {
  return isOneOf(word, {"END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK", "END_CLASS", "END_INTERFACE", "END_METHOD",
                        "END_ACTION", "END_PROPERTY", "END_GET", "END_SET", "END_NAMESPACE"});
}
bool opensBlock(std::string_view word) { return isOneOf(word, {"IF", "CASE", "FOR", "WHILE", "REPEAT"}); }
bool closesBlock(std::string_view word) {
  return isOneOf(word, {"END_IF", "END_CASE", "END_FOR", "END_WHILE", "END_REPEAT"});
}
bool isModifier(std::string_view word) {
  return isOneOf(word, {"PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "ABSTRACT", "FINAL", "OVERRIDE"});
}

class Reader {
 public:
  Reader(const View& view, const Cursor& cursor) : view_(view), cursor_(cursor) {}

  CompletionContext read() {
    scan();
    if (cursor_.before() == ".") return after(Writes::Member);
    if (cursor_.before() == "#") return after(Writes::Item);
    if (cursor_.before() == "%")
      context_.writes = Writes::Address;
    else if (section_ != kNone)
      inSection();
    else if (is_configuration_)
      inConfiguration();
    else if (context_.is_in_body)
      inBody();
    else
      outside();
    return std::move(context_);
  }

 private:
  static constexpr size_t kNone = ~size_t{0};

  // Which section, POU and blocks the cursor is in.
  void scan() {
    for (size_t at = 0; at < cursor_.units.size(); ++at) {
      if (cursor_.units[at].kind != UnitKind::Name) continue;
      const std::string_view word = cursor_.text(at);
      if (beginsSection(word)) {
        section_ = at;
        context_.is_in_body = false;
      } else if (isOneOf(word, {"STRUCT", "UNION"}) || (isOneOf(word, {"TYPE"}) && section_ == kNone)) {
        section_ = at;
      } else if (isOneOf(word, {"END_VAR", "END_TYPE"})) {
        section_ = kNone;
        context_.is_in_body = pou_ != kNone;
        context_.body = at + 1;
      } else if (section_ == kNone) {
        scanOutsideOfSections(at, word);
      }
    }
  }

  void scanOutsideOfSections(size_t at, std::string_view word) {
    if (endsPou(word) || isOneOf(word, {"CONFIGURATION", "END_CONFIGURATION"})) {
      is_configuration_ = isOneOf(word, {"CONFIGURATION"});
      pou_ = kNone;
      context_.is_in_body = context_.has_body = false;
      context_.blocks.clear();
      return;
    }
    if (is_configuration_) return;
    const bool follows_statement =
        at == 0 || cursor_.text(at - 1) == ";" || upper(cursor_.text(at - 1)).starts_with("END_");
    const bool is_accessor = isOneOf(word, {"GET", "SET"});
    const bool may_be_accessor = pou_ != kNone && isOneOf(cursor_.text(pou_), {"PROPERTY", "GET", "SET"});
    if (beginsPou(word) && (!is_accessor || may_be_accessor) &&
        !(context_.is_in_body && context_.has_body && !follows_statement)) {
      pou_ = at;
      context_.is_in_body = context_.has_body = false;
      context_.blocks.clear();
    } else if (opensBlock(word)) {
      context_.blocks.push_back(at);
      if (!context_.is_in_body) context_.body = at;
      context_.is_in_body = context_.has_body = true;
    } else if (closesBlock(word)) {
      if (!context_.blocks.empty()) context_.blocks.pop_back();
    } else if (pou_ != kNone && at > pou_ + 1 && !context_.is_in_body) {
      header(at, word);
    } else if (context_.is_in_body) {
      context_.has_body = true;
    }
  }

  // `FUNCTION f : INT` and what relates a block to others; any other name begins the body.
  void header(size_t at, std::string_view word) {
    const std::string_view before = cursor_.text(at - 1);
    const bool is_header =
        !isOneOf(cursor_.text(pou_), {"ACTION"}) &&
        (before == ":" || before == "," || before == "." || isModifier(before) ||
         isOneOf(word, {"EXTENDS", "IMPLEMENTS", "USING"}) || isOneOf(before, {"EXTENDS", "IMPLEMENTS", "USING"}));
    if (is_header) return;
    context_.is_in_body = context_.has_body = true;
    context_.body = at;
  }

  CompletionContext after(Writes writes) {
    const size_t sign = cursor_.units.size() - 1;
    context_.writes = writes;
    context_.base = valueBefore(view_, cursor_, sign);
    if (sign > 0) context_.base_name = cursor_.text(sign - 1);
    return std::move(context_);
  }

  // ---- declarations

  void outside() {
    const std::string_view last = cursor_.before();
    if (pou_ == kNone) {
      const bool begins = last.empty() || last == ";" || upper(last).starts_with("END_");
      context_.writes = begins ? Writes::Declaration : Writes::Nothing;
      return;
    }
    const size_t since = cursor_.units.size() - pou_;
    if (isBodyAfterHeader(since)) {
      context_.is_in_body = true;
      context_.body = cursor_.units.size();
      context_.writes = Writes::Statement;
      return;
    }
    if (since == 1 || isModifier(last)) {
      context_.writes = Writes::Nothing;  // the name
    } else if (last == ":" || isOneOf(last, {"EXTENDS", "IMPLEMENTS"}) || (last == "," && since > 2)) {
      context_.writes = Writes::Type;
    } else {
      context_.writes = Writes::Header;
    }
  }

  // A name alone on a line after the header: its body may begin there.
  bool isBodyAfterHeader(size_t since) const {
    if (since >= 2 && isOneOf(cursor_.text(pou_), {"ACTION"})) return true;
    if (since < 2 || cursor_.before() == ":" || cursor_.before() == "," || isModifier(cursor_.before())) return false;
    if (isOneOf(cursor_.before(), {"EXTENDS", "IMPLEMENTS"}) || isOneOf(cursor_.text(pou_), {"INTERFACE"}))
      return false;
    const size_t last = cursor_.units.back().end, begin = cursor_.offset - cursor_.prefix.size();
    return cursor_.source.substr(last, begin - last).find('\n') != std::string_view::npos;
  }

  void inConfiguration() {
    const std::string_view last = cursor_.before();
    if (last == ":") context_.writes = Writes::Program;
    if (last == ";" || upper(last).starts_with("END_") || isOneOf(cursor_.before(1), {"CONFIGURATION", "ON"}))
      context_.writes = Writes::Configuration;
  }

  // The current declaration has a `:=` or a bound, so that values may follow.
  bool hasValue() const {
    for (size_t at = cursor_.units.size(); at-- > section_;) {
      const std::string_view text = cursor_.text(at);
      if (text == ";") return false;
      if (text == "[" || (text == "=" && at > 0 && cursor_.text(at - 1) == ":")) return true;
    }
    return false;
  }

  void inSection() {
    const std::string_view last = cursor_.before(), before = cursor_.before(1);
    if (cursor_.units.size() == section_ + 1 && beginsSection(last)) {
      context_.writes = Writes::Section;
    } else if (last == ";" || isOneOf(last, {"CONSTANT", "RETAIN", "PERSISTENT", "NON_RETAIN", "STRUCT", "UNION"}) ||
               cursor_.units.size() == section_ + 1) {
      context_.writes = Writes::Variable;
    } else if (last == "=" && before == ":") {
      context_.writes = Writes::Expression;
      context_.expected = writtenType(cursor_.units.size() - 2);
    } else if (last == ":" || isOneOf(last, {"OF", "TO", "REF_TO"})) {
      context_.writes = Writes::Type;
    } else if ((last == "(" || last == "[" || last == ",") && hasValue()) {
      context_.writes = Writes::Expression;
    } else if (cursor_.units.back().kind == UnitKind::Name && (before == ";" || beginsSection(before)) &&
               !isOneOf(cursor_.text(section_), {"TYPE", "STRUCT", "UNION"})) {
      context_.writes = Writes::Location;
    }
  }

  // Of `name : Type :=`, the type whose name ends before a unit.
  TypeId writtenType(size_t end) const {
    if (end == 0 || cursor_.units[end - 1].kind != UnitKind::Name) return {};
    const std::string_view name = cursor_.text(end - 1);
    const NameId key = view_.names().key(view_.names().find(name));
    const Scope& scope = view_.meanings().scope();
    if (const Entity entity = scope.typeNamed(key)) return scope.typeOf(entity);
    return key ? scope.project().types.elementary(key) : TypeId{};
  }

  // ---- bodies

  void inBody() {
    const std::string_view last = cursor_.before(), before = cursor_.before(1);
    if (beginsStatement()) {
      context_.writes = Writes::Statement;
      return;
    }
    const bool is_operand = cursor_.units.back().kind == UnitKind::Number ||
                            cursor_.units.back().kind == UnitKind::String || last == ")" || last == "]" ||
                            last == "^" || (cursor_.units.back().kind == UnitKind::Name && !isKeyword(last));
    if (is_operand) {
      context_.writes = Writes::Operator;
      context_.expected = typeBefore(cursor_.units.size());
      return;
    }
    context_.writes = Writes::Expression;
    if (last == "(" || last == ",") {
      context_.call = openCallAt(view_, cursor_);
      if (context_.call && context_.call->is_at_beginning) context_.expected = typeOfArgument(*context_.call);
    } else {
      context_.expected = expectedAfter(last, before);
      if (isOneOf(last, {"CASE"})) context_.needs = Needs::Selector;
      if (last == ">" && before == "=") context_.needs = Needs::Lvalue;
    }
  }

  static bool isKeyword(std::string_view word) { return kindOfWord(word) == WordKind::Keyword; }

  bool beginsStatement() const {
    const std::string_view last = cursor_.before();
    if (cursor_.units.empty() || last == ";" || upper(last).starts_with("END_")) return true;
    if (isOneOf(last, {"THEN", "ELSE", "DO", "REPEAT", "OF", "__TRY", "__FINALLY"})) return true;
    return last == ":" && (context_.blocks.empty() || cursor_.before(1) != ":");
  }

  TypeId typeBefore(size_t unit) const { return valueBefore(view_, cursor_, unit).type; }

  // After `:=`, a comparison, or a word that a condition follows.
  TypeId expectedAfter(std::string_view last, std::string_view before) const {
    const size_t count = cursor_.units.size();
    if (last == "=" && (before == ":" || before == "<" || before == ">")) {
      const std::optional<OpenCall> call = before == ":" ? openCallAt(view_, cursor_) : std::nullopt;
      return call && !call->pin.empty() ? typeOfPin(*call) : typeBefore(count - 2);
    }
    if (last == ">" && before == "=") {
      const std::optional<OpenCall> call = openCallAt(view_, cursor_);
      return call && !call->pin.empty() ? typeOfPin(*call) : TypeId{};
    }
    if (last == ">" && before == "<") return typeBefore(count - 2);
    if (last == "=" || last == "<" || last == ">") return typeBefore(count - 1);
    const bool is_condition = isOneOf(last, {"IF", "ELSIF", "WHILE", "UNTIL", "NOT", "AND_THEN", "OR_ELSE"});
    return is_condition ? types::kBool : TypeId{};
  }

  TypeId typeOfPin(const OpenCall& call) const {
    const Scope& scope = view_.meanings().scope();
    for (const VarId pin : scope.pinsOf(calledBy(scope, call.callee)))
      if (sameIdentifier(view_.names().string(scope.project().var(pin).name), call.pin))
        return scope.project().var(pin).type;
    return {};
  }
  // By position.
  TypeId typeOfArgument(const OpenCall& call) const {
    const Scope& scope = view_.meanings().scope();
    const std::vector<VarId> pins = scope.pinsOf(calledBy(scope, call.callee));
    if (call.argument >= pins.size() || !call.given.empty()) return {};
    const TypeId type = scope.project().var(pins[call.argument]).type;
    return types::TypeTable::isGeneric(scope.project().types.kind(type)) ? TypeId{} : type;
  }

  const View& view_;
  const Cursor& cursor_;
  CompletionContext context_;
  size_t section_ = kNone, pou_ = kNone;  // units that begin the innermost ones
  bool is_configuration_ = false;
};

}  // namespace

CompletionContext contextAt(const View& view, const Cursor& cursor) { return Reader(view, cursor).read(); }

}  // namespace rung::ide

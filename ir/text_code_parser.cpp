// SPDX-License-Identifier: Apache-2.0
// Reads the code of a body: statements, places, values (docs/ir.md). Called by text_parser.cpp when all declarations
// have been read.
#include <charconv>
#include <cmath>

#include "ir/diagnostics.h"
#include "ir/text_reader.h"

namespace rung::ir::text_form {

using types::Field;
using types::TypeInfo;
using types::TypeKind;

void Reader::code() {
  Body& body = builder_->body;
  local_by_name_.clear();
  temp_by_name_.clear();
  label_by_name_.clear();
  result_ = ~0u;
  for (uint32_t i = 0; i < body.locals.size(); ++i) {
    if (body.locals[i].kind == LocalKind::Result)
      result_ = i;
    else if (!local_by_name_.emplace(body.locals[i].name.index, i).second)
      fail(diag::IrRepeatedName, body.locals[i].loc, {module_.names.string(body.locals[i].name)});
  }
  const StmtId first = block();
  body.first = first;
  if (!failed_ && !token().first_in_line) expected("the end of the line");
}

StmtId Reader::block() {
  const Block outer = builder_->open();
  if (++depth_ > kMaxDepth) fail(diag::IrTooDeep, token().loc, {"1000"});
  expect("{");
  while (!failed_ && !accept("}")) stmt();
  --depth_;
  return builder_->close(outer);
}

void Reader::stmt() {
  Builder& b = *builder_;
  const Loc loc = b.loc = token().loc;
  if (accept("temp")) return localDeclaration(LocalKind::Temp);
  if (accept("var")) return localDeclaration(LocalKind::Variable);
  if (accept("assert_eq")) return assertion(Assertion::AssertEq);
  if (accept("assert_near")) return assertion(Assertion::AssertNear);
  const bool is_word = token().kind == TokenKind::Name && !token().quoted;
  const StmtKind kind = is_word ? statementOf(token().text) : StmtKind::None;
  if (kind != StmtKind::None) ++at_;
  switch (kind) {
    case StmtKind::None:
    case StmtKind::Assign: return assignment();
    case StmtKind::Bind: {
      const ExprId field = expr({});
      expect("=");
      return append(loc, BindStmt{.field = field, .place = accept("null") ? ExprId{} : expr({})});
    }
    case StmtKind::Call: return callStmt({});
    case StmtKind::If: {
      IfStmt node{.condition = expr(types::kBool)};
      node.then_block = block();
      node.else_block = optionalBlock("else");
      return append(loc, node);
    }
    case StmtKind::Switch: return switchStmt();
    case StmtKind::Loop: {
      LoopStmt node{.body_block = block()};
      node.next_block = optionalBlock("next");
      return append(loc, node);
    }
    case StmtKind::For: return forStmt();
    case StmtKind::Break: return append(loc, BreakStmt{});
    case StmtKind::Continue: return append(loc, ContinueStmt{});
    case StmtKind::Return: return returnStmt();
    case StmtKind::Jump: return append(loc, JumpStmt{.label = label()});
    case StmtKind::Label: return append(loc, LabelStmt{.label = label()});
    case StmtKind::Try: return tryStmt();
    case StmtKind::Fault: return faultStmt();
    case StmtKind::Assert: return assertion(Assertion::Assert);
    case StmtKind::Evaluate: return append(loc, EvaluateStmt{.value = expr({})});
  }
}

void Reader::localDeclaration(LocalKind kind) {
  const Loc loc = token().loc;
  const NameId id = name();
  expect(":");
  const TypeId local_type = type();
  if (failed_) return;
  const uint32_t index = builder_->local(id, local_type, kind);
  Map& by_name = kind == LocalKind::Temp ? temp_by_name_ : local_by_name_;
  if (!by_name.emplace(id.index, index).second) fail(diag::IrRepeatedName, loc, {module_.names.string(id)});
}

void Reader::assignment() {
  const Loc loc = builder_->loc;
  const ExprId place = expr({});
  expect("=");
  if (failed_) return;
  if (accept("call")) return callStmt(place);
  append(loc, AssignStmt{.place = place, .value = expr(typeOf(place))});
}

// for i = 0 to 9 by 1 { … }
void Reader::forStmt() {
  const Loc loc = builder_->loc;
  ForStmt node{.control = expr({})};
  if (failed_) return;
  const TypeId type = typeOf(node.control);
  expect("=");
  node.from = expr(type);
  expect("to");
  node.to = expr(type);
  expect("by");
  node.step = expr(type);
  node.body_block = block();
  append(loc, node);
}

// return   return x
void Reader::returnStmt() {
  if (!token().first_in_line && !isPunct("}")) {
    if (result_ == ~0u) return fail(diag::IrUnknownName, builder_->loc, {"result", "local"});
    const ExprId place = builder_->localPlace(result_);
    const ExprId value = expr(typeOf(place));
    append(builder_->loc, AssignStmt{.place = place, .value = value});
  }
  append(builder_->loc, ReturnStmt{});
}

// The number of the label whose name follows.
uint32_t Reader::label() {
  const NameId id = name();
  if (failed_) return 0;
  auto [found, is_new] = label_by_name_.emplace(id.index, 0);
  if (is_new) found->second = builder_->label(id);
  return found->second;
}

// try { … } catch n { … } finally { … }
void Reader::tryStmt() {
  const Loc loc = builder_->loc;
  TryStmt node{.body_block = block()};
  node.catches = accept("catch");
  if (node.catches) {
    if (!isPunct("{")) node.number = expr({});
    node.catch_block = block();
  }
  node.finally_block = optionalBlock("finally");
  append(loc, node);
}

// fault div   fault index(i)
void Reader::faultStmt() {
  const Loc loc = builder_->loc;
  constexpr types::Fault kFaults[] = {types::Fault::Div,      types::Fault::Index,    types::Fault::Null,
                                      types::Fault::Cast,     types::Fault::Subrange, types::Fault::Convert,
                                      types::Fault::Overflow, types::Fault::Lock};
  FaultStmt node;
  for (types::Fault one : kFaults)
    if (isWord(types::word(one))) node.fault = one;
  if (node.fault == types::Fault::None) return expected("the fault's kind");
  ++at_;
  if (!token().first_in_line && accept("(")) {
    node.value = expr({});
    expect(")");
  }
  append(loc, node);
}

// assert x shows a, b as '…' text '…'   assert_eq a, b message s   assert_near a, b, c
void Reader::assertion(Assertion kind) {
  const Loc loc = builder_->loc;
  AssertStmt node{.assertion = kind};
  node.first = expr(kind == Assertion::Assert ? types::kBool : TypeId{});
  if (failed_) return;
  const TypeId first_type = typeOf(node.first);
  if (kind == Assertion::Assert && accept("shows")) {
    node.second = expr({});
    if (failed_) return;
    expect(",");
    node.third = expr(typeOf(node.second));
    expect("as");
    node.shown = module_.names.intern(quotedText(TokenKind::Text));
  }
  if (kind != Assertion::Assert) {
    expect(",");
    node.second = expr(first_type);
  }
  if (kind == Assertion::AssertNear) {
    expect(",");
    node.third = expr(first_type);
  }
  if (accept("text"))
    node.text = module_.names.intern(quotedText(TokenKind::Text));
  else if (accept("message"))
    node.message = expr({});
  append(loc, node);
}

// call @F(a, _)   call @Ramp on r   call init @Ramp on r
void Reader::callStmt(ExprId result) {
  Builder& b = *builder_;
  const Loc loc = b.loc;
  const bool is_init = accept("init"), is_virtual = !is_init && accept("virtual");
  const bool is_checked = is_virtual && accept("checked");
  const Loc name_loc = token().loc;
  const std::string text = sigilName();
  if (failed_) return;
  const Map& by_name = is_init ? init_by_name_ : body_by_name_;
  auto found = by_name.find(module_.names.intern(text).index);
  if (found == by_name.end()) return fail(diag::IrUnknownName, name_loc, {text, "body"});
  const BodyId callee{found->second};
  std::vector<ExprId> given;
  if (isPunct("(") && !token().first_in_line) given = operands(module_.body(callee));
  const ExprId self = accept("on") ? expr({}) : ExprId{};
  append(loc, CallStmt{.callee = callee,
                       .self = self,
                       .operands = b.list(given),
                       .result = result,
                       .is_virtual = is_virtual,
                       .is_checked = is_checked});
}

std::vector<ExprId> Reader::operands(const Body& callee) {
  std::vector<ExprId> given;
  expect("(");
  if (accept(")")) return given;
  const Parameters wanted = parameters(callee);
  auto parameter = wanted.begin();
  do {
    const bool is_known = !(parameter == wanted.end());
    const TypeId type = is_known ? (*parameter).type : TypeId{};
    if (is_known) ++parameter;
    given.push_back(accept("_") ? ExprId{} : expr(type));
  } while (accept(","));
  expect(")");
  return given;
}

void Reader::switchStmt() {
  Builder& b = *builder_;
  const Loc loc = b.loc;
  const ExprId selector = expr({});
  std::vector<Case> cases;
  StmtId else_block;
  expect("{");
  while (!failed_ && accept("case")) {
    std::vector<CaseRange> ranges;
    do {
      CaseRange range;
      range.low = integer();
      range.high = accept("..") ? integer() : range.low;
      ranges.push_back(range);
    } while (accept(","));
    const StmtId case_block = block();
    cases.push_back(b.makeCase(ranges, case_block));
  }
  if (accept("else")) else_block = block();
  expect("}");
  b.loc = loc;
  if (!failed_) b.switchStmt(selector, cases, else_block);
}

// `!` or `!(div, overflow)`. `natural`: the check that `!` alone means on this node.
uint8_t Reader::checks(uint8_t natural) {
  if (failed_ || !isPunct("!") || token().first_in_line) return 0;
  ++at_;
  if (!isPunct("(") || token().first_in_line) return natural;
  uint8_t result = 0;
  expect("(");
  do {
    bool known = false;
    for (const CheckKeyword& row : checkKeywords()) {
      if (!isWord(row.word)) continue;
      result |= row.check;
      known = true;
    }
    if (!known) expected("the name of a check");
    ++at_;
  } while (!failed_ && accept(","));
  expect(")");
  return result;
}

uint32_t Reader::fieldOf(TypeId record_type, NameId field) {
  if (fields_known_.size() < types_.count()) fields_known_.resize(types_.count());
  const std::vector<Field>& fields = types_.info(record_type).fields;
  if (!fields_known_[record_type.index]) {
    fields_known_[record_type.index] = true;
    for (uint32_t i = 0; i < fields.size(); ++i)
      field_by_name_.emplace(uint64_t{record_type.index} << 32 | fields[i].name.index, i);
  }
  auto found = field_by_name_.find(uint64_t{record_type.index} << 32 | field.index);
  return found == field_by_name_.end() ? ~0u : found->second;
}

// expr := primary postfix*
ExprId Reader::expr(TypeId wanted) {
  if (failed_) return {};
  if (++depth_ > kMaxDepth) {
    fail(diag::IrTooDeep, token().loc, {"1000"});
    return {};
  }
  ExprId id = primary(wanted ? types_.resolve(wanted) : wanted);
  --depth_;
  return failed_ ? ExprId{} : id;
}

ExprId Reader::primary(TypeId wanted) {
  Builder& b = *builder_;
  b.loc = token().loc;
  if (accept("(")) {
    const ExprId inner = expr(wanted);
    expect(")");
    return postfix(inner);
  }
  if (isPunct("@")) return afterSigil();
  if (accept("$")) {
    const uint32_t found = numberOf(program_by_name_, "program", true);
    return failed_ ? ExprId{} : postfix(b.program(found));
  }
  if (accept("%")) {
    const uint32_t found = numberOf(temp_by_name_, "temp");
    return failed_ ? ExprId{} : postfix(b.localPlace(found));
  }
  if (token().kind == TokenKind::Number || token().kind == TokenKind::Text || isPunct("-")) return literal(wanted);
  if (token().kind != TokenKind::Name) {
    expected("an expression");
    return {};
  }
  if (token().quoted) return variable();
  if (atType()) {
    const TypeId of = type();
    return failed_ ? ExprId{} : afterType(of);
  }
  for (const char* word : {"true", "false", "inf", "nan", "null", "zero", "class"})
    if (isWord(word)) return literal(wanted);
  return afterWord();
}

// An expression that begins with a word of its own, or with the name of a variable.
ExprId Reader::afterWord() {
  Builder& b = *builder_;
  if (accept("data")) {
    const Loc loc = b.loc;
    const auto number = static_cast<uint64_t>(integer());
    if (!failed_ && number >= module_.data.size()) fail(diag::IrUnknownName, loc, {"data", "data item"});
    return failed_ ? ExprId{} : b.data(static_cast<uint32_t>(number));
  }
  if (accept("self")) {
    if (b.body.self) return postfix(b.self());
    fail(diag::IrUnknownName, b.loc, {"self", "instance"});
    return {};
  }
  if (accept("result")) {
    if (result_ != ~0u) return postfix(b.localPlace(result_));
    fail(diag::IrUnknownName, b.loc, {"result", "local"});
    return {};
  }
  if (accept("convert")) return conversion(types::Rounding::ToEven);
  if (accept("round")) return conversion(types::Rounding::AwayFromZero);
  if (accept("select")) {  // select int condition, yes, no
    const Loc loc = b.loc;
    const TypeId of = type();
    SelectExpr node{.condition = expr(types::kBool)};
    expect(",");
    node.when_true = expr(of);
    expect(",");
    node.when_false = expr(of);
    return failed_ ? ExprId{} : b.add(loc, types_.resolve(of), node);
  }
  if (accept("address")) {
    const Loc loc = b.loc;
    const TypeId of = type();
    const ExprId place = expr({});
    b.loc = loc;
    return failed_ ? ExprId{} : b.address(of, place);
  }
  Op op;
  if (types::findOp(token().text, op)) return operation(op);
  return variable();
}

// The row of a table for the name that follows; fails when it is not there.
uint32_t Reader::numberOf(const Map& by_name, std::string_view what, bool numbered) {
  const Loc loc = token().loc;
  NameId base;
  const NameId id = numbered ? numberedName(base) : name();
  if (failed_) return 0;
  const auto found = by_name.find(id.index);
  if (found != by_name.end()) return found->second;
  fail(diag::IrUnknownName, loc, {module_.names.string(id), what});
  return 0;
}

// After `@`: a type before `#` or `%`, a function before `(`, else a global list.
ExprId Reader::afterSigil() {
  Builder& b = *builder_;
  const size_t start = at_;
  const Loc loc = token().loc;
  const std::string text = sigilName();
  if (failed_) return {};
  if (isPunct("#") || isPunct("%")) {
    at_ = start;
    const TypeId of = type();
    return failed_ ? ExprId{} : afterType(of);
  }
  const NameId id = module_.names.intern(text);
  const bool is_call = isPunct("(") && !token().first_in_line;
  const Map& by_name = is_call ? body_by_name_ : list_by_name_;
  const auto found = by_name.find(id.index);
  if (found == by_name.end()) {
    fail(diag::IrUnknownName, loc, {text, is_call ? "function" : "list"});
    return {};
  }
  if (!is_call) return postfix(b.global(found->second));
  const std::vector<ExprId> given = operands(module_.body(BodyId{found->second}));
  b.loc = loc;
  return failed_ ? ExprId{} : postfix(b.call(BodyId{found->second}, given));
}

// convert! int x   round int x. The check that `!` alone means depends on the type after it.
ExprId Reader::conversion(types::Rounding rounding) {
  Builder& b = *builder_;
  const Loc loc = b.loc;
  const size_t mark = at_;
  if (isPunct("!")) {  // skipped, and read again below
    ++at_;
    if (isPunct("("))
      while (token().kind != TokenKind::End && !accept(")")) ++at_;
  }
  const bool is_proven = accept("=");
  const TypeId to = type();
  const ExprId operand = expr({});
  if (failed_) return {};
  b.loc = loc;
  const ExprId id = b.convert(to, operand, 0, rounding);
  b.body.expr(id).proven = is_proven ? 1 : 0;
  const size_t end = at_;
  at_ = mark;
  const uint8_t set = checks(naturalCheck(types_, b.body.expr(id)));
  at_ = end;
  b.body.expr(id).checks = set;
  return id;
}

// add! int x, y   not bool x   sub= int x, y. The type is that of the operands.
ExprId Reader::operation(Op op) {
  const Loc loc = builder_->loc;
  ++at_;
  const uint8_t set = checks(naturalCheck(op));
  const bool is_proven = accept("=");
  const TypeId of = type();
  const bool is_unary = types::operandCount(op) == 1;
  const ExprId first = expr(of);
  if (!is_unary) expect(",");
  const ExprId second = is_unary ? ExprId{} : expr(of);
  if (failed_) return {};
  const TypeId result = types::isComparison(op) ? types::kBool : types_.resolve(of);
  const ExprId id = is_unary ? builder_->add(loc, result, UnaryExpr{first, op}, set)
                             : builder_->add(loc, result, BinaryExpr{first, second, op}, set);
  builder_->body.expr(id).proven = is_proven ? 1 : 0;
  return id;
}

// A local, or a field of self.
ExprId Reader::variable() {
  Builder& b = *builder_;
  const Loc loc = token().loc;
  const NameId id = name();
  if (failed_) return {};
  if (auto found = local_by_name_.find(id.index); found != local_by_name_.end())
    return postfix(b.localPlace(found->second));
  const uint32_t field = b.body.self ? fieldOf(b.body.self, id) : ~0u;
  if (field == ~0u) {
    fail(diag::IrUnknownName, loc, {module_.names.string(id), "variable"});
    return {};
  }
  const ExprId place = b.field(b.self(), field);
  b.body.expr(place).checks = checks(kCheckNull);
  return postfix(place);
}

// int#3   @Color#Red   bool%I0.5
ExprId Reader::afterType(TypeId of) {
  Builder& b = *builder_;
  if (accept("#")) return literal(types_.resolve(of));
  expect("%");
  if (failed_) return {};
  const std::optional<AddressInArea> address = addressInArea();
  if (!address) return {};
  uint32_t bit = kNoBit;
  if (isPunct(".") && token(1).kind == TokenKind::Number) {
    ++at_;
    bit = static_cast<uint32_t>(integer());
  }
  return failed_ ? ExprId{} : postfix(b.image(of, address->area.index, address->byte, bit));
}

ExprId Reader::misfit(std::string_view seen, TypeId of) {
  fail(diag::IrLiteralType, builder_->loc, {seen, of ? types_.toString(of) : "an unknown type"});
  return {};
}

ExprId Reader::literal(TypeId of) {
  Builder& b = *builder_;
  if (failed_) return {};
  b.loc = token().loc;
  const TypeKind kind = of ? types_.plainKind(of) : TypeKind::None;
  if (token().kind == TokenKind::Text) {
    if (!TypeTable::isString(kind)) return misfit("a string", of);
    return b.string(of, module_.names.intern(quotedText(TokenKind::Text)));
  }
  if (accept("zero")) return of ? b.zero(of) : misfit("zero", of);
  if (isWord("true") || isWord("false")) {
    const bool value = tokens_[at_++].text == "true";
    if (of && kind != TypeKind::Bool) return misfit(value ? "true" : "false", of);
    return b.constant(of ? of : types::kBool, value);
  }
  if (accept("class")) return classNumber();
  if (accept("null")) {
    const bool is_pointer = kind == TypeKind::Pointer || kind == TypeKind::Reference;
    return is_pointer ? b.constant(of, 0) : misfit("null", of);
  }
  if (token().kind == TokenKind::Name && of && types_.kind(of) == TypeKind::Enum) return enumItem(of);
  const bool negative = accept("-");
  if (isWord("inf") || (!negative && isWord("nan"))) return specialReal(of ? of : types::kReal, negative);
  if (token().kind == TokenKind::Number) return number(of, negative);
  expected("a literal");
  return {};
}

// The number of the class whose objects have a record.
ExprId Reader::classNumber() {
  const Loc loc = builder_->loc;
  const TypeId record = type();
  ConstExpr number{.number_of = record};
  for (size_t i = 0; i < module_.classes.size(); ++i)
    if (module_.classes[i].record == record) number.bits = i + 1;
  return builder_->add(loc, types::kUDInt, number);
}

ExprId Reader::enumItem(TypeId of) {
  const Loc loc = builder_->loc;
  const NameId item = name();
  for (const auto& [item_name, value] : types_.info(of).items)
    if (item_name == item) return builder_->integer(of, value);
  fail(diag::IrUnknownName, loc, {module_.names.string(item), "item"});
  return {};
}

// inf, nan, or nan with its bits.
ExprId Reader::specialReal(TypeId of, bool negative) {
  Builder& b = *builder_;
  const bool is_real = TypeTable::isReal(types_.plainKind(of));
  if (accept("inf")) return is_real ? b.real(of, negative ? -INFINITY : INFINITY) : misfit("inf", of);
  accept("nan");
  if (!is_real) return misfit("nan", of);
  if (!isPunct("(") || token().first_in_line) return b.real(of, std::nan(""));
  expect("(");
  const auto bits = static_cast<uint64_t>(integer());
  expect(")");
  return failed_ ? ExprId{} : b.constant(of, bits);
}

ExprId Reader::number(TypeId of, bool negative) {
  Builder& b = *builder_;
  const std::string_view text = token().text;
  const bool is_integer = text.find_first_of(".eE") == std::string_view::npos;
  if (!of) of = is_integer ? kDefaultInteger : types::kReal;
  const TypeKind kind = types_.plainKind(of);
  if (TypeTable::isReal(kind)) {
    double value = 0;
    float narrow = 0;
    if (kind == TypeKind::Real)
      std::from_chars(text.data(), text.data() + text.size(), narrow);
    else
      std::from_chars(text.data(), text.data() + text.size(), value);
    if (kind == TypeKind::Real) value = narrow;
    ++at_;
    return b.real(of, negative ? -value : value);
  }
  const bool is_pointer = kind == TypeKind::Pointer || kind == TypeKind::Reference;
  uint64_t magnitude = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), magnitude);
  if (!is_integer || parsed.ec != std::errc() || (!TypeTable::isScalar(kind) && !is_pointer)) return misfit(text, of);
  ++at_;
  const uint32_t width = is_pointer ? 64 : TypeTable::bitWidth(kind);
  const bool is_signed = types_.isSigned(kind);
  const uint64_t limit = is_signed ? (uint64_t{1} << (width - 1)) - (negative ? 0 : 1)
                                   : (width >= 64 ? ~uint64_t{0} : (uint64_t{1} << width) - 1);
  if (magnitude > limit || (negative && !is_signed && magnitude != 0)) return misfit(text, of);
  return b.constant(of, negative ? 0 - magnitude : magnitude);
}

ExprId Reader::postfix(ExprId base) {
  Builder& b = *builder_;
  while (!failed_ && base) {
    b.loc = token().loc;
    ExprId created;
    if (isPunct(".") && isPunct("%", 1) && token(2).kind == TokenKind::Name)
      created = part(base);
    else if (isPunct(".") && token(1).kind == TokenKind::Name)
      created = field(base);
    else if (isPunct("[") && !token().first_in_line)
      created = element(base);
    else if (isPunct("^"))
      created = target(base);
    else
      return base;
    if (!created) return {};
    b.body.expr(created).checks = checks(naturalCheck(types_, b.body.expr(created)));
    base = created;
  }
  return base;
}

bool Reader::requireBase(ExprId base, bool holds, std::string_view access, std::string_view what) {
  if (!holds) fail(diag::IrWrongBase, builder_->loc, {access, what, types_.toString(typeOf(base))});
  return holds;
}

// base.%X3
ExprId Reader::part(ExprId base) {
  at_ += 2;
  const std::string_view part = token().text;
  const TypeKind kind = part[0] == 'X'   ? TypeKind::Bool
                        : part[0] == 'B' ? TypeKind::Byte
                        : part[0] == 'W' ? TypeKind::Word
                        : part[0] == 'D' ? TypeKind::DWord
                                         : TypeKind::None;
  uint32_t position = 0;
  const auto parsed = std::from_chars(part.data() + 1, part.data() + part.size(), position);
  if (kind == TypeKind::None || parsed.ec != std::errc() || parsed.ptr != part.data() + part.size()) {
    expected("X, B, W or D and a position");
    return {};
  }
  ++at_;
  return builder_->bits(base, types::idOf(kind), position);
}

// base.name
ExprId Reader::field(ExprId base) {
  const TypeInfo& info = types_.info(types_.resolve(typeOf(base)));
  ++at_;
  const Loc loc = token().loc;
  const NameId id = name();
  if (failed_ || !requireBase(base, info.kind == TypeKind::Record, "`.`", "a record")) return {};
  const uint32_t found = fieldOf(types_.resolve(typeOf(base)), id);
  if (found != ~0u) return builder_->field(base, found);
  fail(diag::IrUnknownName, loc, {module_.names.string(id), "field"});
  return {};
}

// base[i, =j]
ExprId Reader::element(ExprId base) {
  const TypeInfo& info = types_.info(types_.resolve(typeOf(base)));
  if (!requireBase(base, info.kind == TypeKind::Array, "`[`", "an array")) return {};
  const Loc loc = builder_->loc;
  ++at_;
  std::vector<ExprId> indices;
  uint16_t proven = 0;
  do {
    if (indices.size() < kMostProven && accept("=")) proven = static_cast<uint16_t>(proven | 1u << indices.size());
    indices.push_back(expr({}));
  } while (accept(","));
  expect("]");
  if (failed_) return {};
  builder_->loc = loc;
  const ExprId created = builder_->index(base, indices);
  builder_->body.expr(created).proven = proven;
  return created;
}

// base^
ExprId Reader::target(ExprId base) {
  const TypeInfo& info = types_.info(types_.resolve(typeOf(base)));
  const bool is_pointer = info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference;
  if (!requireBase(base, is_pointer, "`^`", "a pointer")) return {};
  ++at_;
  return builder_->deref(base);
}

}  // namespace rung::ir::text_form

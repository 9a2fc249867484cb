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
  b.loc = token().loc;
  if (accept("temp") || accept("var")) {
    const bool is_temp = tokens_[at_ - 1].text == "temp";
    const Loc loc = token().loc;
    const NameId id = name();
    expect(":");
    const TypeId local_type = type();
    if (failed_) return;
    const uint32_t index = b.local(id, local_type, is_temp ? LocalKind::Temp : LocalKind::Variable);
    if (!(is_temp ? temp_by_name_ : local_by_name_).emplace(id.index, index).second)
      fail(diag::IrRepeatedName, loc, {module_.names.string(id)});
  } else if (accept("bind")) {
    const ExprId field = expr({});
    expect("=");
    const ExprId place = accept("null") ? ExprId{} : expr({});
    if (!failed_) b.bind(field, place);
  } else if (accept("call")) {
    callStmt({});
  } else if (accept("if")) {
    const Loc loc = b.loc;
    const ExprId condition = expr(types::kBool);
    const StmtId then_block = block();
    const StmtId else_block = accept("else") ? block() : StmtId{};
    b.loc = loc;
    if (!failed_) b.ifElse(condition, then_block, else_block);
  } else if (accept("switch")) {
    switchStmt();
  } else if (accept("loop")) {
    const Loc loc = b.loc;
    const StmtId body_block = block();
    const StmtId next_block = accept("next") ? block() : StmtId{};
    b.loc = loc;
    if (!failed_) b.loop(body_block, next_block);
  } else if (accept("for")) {
    const Loc loc = b.loc;
    const ExprId control = expr({});
    if (failed_) return;
    const TypeId control_type = typeOf(control);
    expect("=");
    const ExprId from = expr(control_type);
    expect("to");
    const ExprId to = expr(control_type);
    expect("by");
    const ExprId step = expr(control_type);
    const StmtId body_block = block();
    b.loc = loc;
    if (!failed_) b.forLoop(control, from, to, step, body_block);
  } else if (accept("break")) {
    b.breakLoop();
  } else if (accept("continue")) {
    b.continueLoop();
  } else if (accept("return")) {
    if (!token().first_in_line && !isPunct("}")) {
      if (result_ == ~0u) return fail(diag::IrUnknownName, b.loc, {"result", "local"});
      const ExprId place = b.localPlace(result_);
      const ExprId value = expr(typeOf(place));
      if (!failed_) b.assign(place, value);
    }
    if (!failed_) b.returnBody();
  } else if (isWord("jump") || isWord("label")) {
    const bool is_jump = isWord("jump");
    ++at_;
    const NameId id = name();
    if (failed_) return;
    auto [found, is_new] = label_by_name_.emplace(id.index, 0);
    if (is_new) found->second = b.label(id);
    is_jump ? b.jump(found->second) : b.placeLabel(found->second);
  } else if (accept("try")) {
    const Loc loc = b.loc;
    const StmtId body_block = block();
    ExprId number;
    StmtId catch_block;
    const bool catches = accept("catch");
    if (catches) {
      if (!isPunct("{")) number = expr({});
      catch_block = block();
    }
    const StmtId finally_block = accept("finally") ? block() : StmtId{};
    b.loc = loc;
    if (!failed_) b.body.stmts[b.tryCatch(body_block, catch_block, finally_block, number).index].op = catches;
  } else if (accept("fault")) {
    constexpr types::Fault kFaults[] = {types::Fault::Div,      types::Fault::Index,    types::Fault::Null,
                                        types::Fault::Cast,     types::Fault::Subrange, types::Fault::Convert,
                                        types::Fault::Overflow, types::Fault::Lock};
    auto kind = types::Fault::None;
    for (types::Fault one : kFaults)
      if (isWord(types::word(one))) kind = one;
    if (kind == types::Fault::None) return expected("the fault's kind");
    ++at_;
    ExprId value;
    if (!token().first_in_line && accept("(")) {
      value = expr({});
      expect(")");
    }
    if (!failed_) b.fault(kind, value);
  } else if (isWord("assert") || isWord("assert_eq") || isWord("assert_near")) {
    const auto assertion = isWord("assert")      ? Assertion::Assert
                           : isWord("assert_eq") ? Assertion::AssertEq
                                                 : Assertion::AssertNear;
    ++at_;
    const ExprId first = expr(assertion == Assertion::Assert ? types::kBool : TypeId{});
    ExprId second, third;
    NameId shown;
    if (failed_) return;
    const TypeId first_type = typeOf(first);
    if (assertion == Assertion::Assert && accept("shows")) {
      second = expr({});
      if (failed_) return;
      expect(",");
      third = expr(typeOf(second));
      expect("as");
      shown = module_.names.intern(quotedText(TokenKind::Text));
    }
    if (assertion != Assertion::Assert) {
      expect(",");
      second = expr(first_type);
    }
    if (assertion == Assertion::AssertNear) {
      expect(",");
      third = expr(first_type);
    }
    NameId text;
    if (accept("text")) text = module_.names.intern(quotedText(TokenKind::Text));
    if (!failed_) b.assertion(assertion, first, second, third, text, shown);
  } else if (accept("evaluate")) {
    const ExprId value = expr({});
    if (!failed_) b.evaluate(value);
  } else {
    const Loc loc = b.loc;
    const ExprId place = expr({});
    expect("=");
    if (failed_) return;
    if (accept("call")) return callStmt(place);
    const ExprId value = expr(typeOf(place));
    b.loc = loc;
    if (!failed_) b.assign(place, value);
  }
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
  b.loc = loc;
  if (failed_) return;
  const StmtId created = b.callStmt(callee, self, given, result);
  if (is_virtual) b.body.stmt(created).op = is_checked ? kVirtual | kChecked : kVirtual;
}

std::vector<ExprId> Reader::operands(const Body& callee) {
  std::vector<ExprId> given;
  expect("(");
  if (accept(")")) return given;
  size_t parameter = 0;
  do {
    while (parameter < callee.locals.size() && !isParameter(callee.locals[parameter])) ++parameter;
    const TypeId wanted = parameter < callee.locals.size() ? callee.locals[parameter].type : TypeId{};
    ++parameter;
    given.push_back(accept("_") ? ExprId{} : expr(wanted));
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

// `!` or `!(div, overflow)`
uint8_t Reader::checks(ExprId id) {
  if (failed_ || !isPunct("!") || token().first_in_line) return 0;
  ++at_;
  if (!isPunct("(") || token().first_in_line) return naturalCheck(types_, builder_->body.expr(id));
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
  if (isPunct("@")) {
    // A type before `#` or `%`, a function before `(`, else a global list.
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
    if (isPunct("(") && !token().first_in_line) {
      auto found = body_by_name_.find(id.index);
      if (found == body_by_name_.end()) {
        fail(diag::IrUnknownName, loc, {text, "function"});
        return {};
      }
      const std::vector<ExprId> given = operands(module_.body(BodyId{found->second}));
      b.loc = loc;
      return failed_ ? ExprId{} : postfix(b.call(BodyId{found->second}, given));
    }
    auto found = list_by_name_.find(id.index);
    if (found == list_by_name_.end()) {
      fail(diag::IrUnknownName, loc, {text, "list"});
      return {};
    }
    return postfix(b.global(found->second));
  }
  if (accept("$")) {
    const Loc loc = token().loc;
    const NameId id = name();
    auto found = program_by_name_.find(id.index);
    if (!failed_ && found == program_by_name_.end())
      fail(diag::IrUnknownName, loc, {module_.names.string(id), "program"});
    return failed_ ? ExprId{} : postfix(b.program(found->second));
  }
  if (accept("%")) {
    const Loc loc = token().loc;
    const NameId id = name();
    auto found = temp_by_name_.find(id.index);
    if (!failed_ && found == temp_by_name_.end()) fail(diag::IrUnknownName, loc, {module_.names.string(id), "temp"});
    return failed_ ? ExprId{} : postfix(b.localPlace(found->second));
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
  const Loc loc = b.loc;
  if (accept("data")) {
    const auto number = static_cast<uint64_t>(integer());
    if (!failed_ && number >= module_.data.size()) fail(diag::IrUnknownName, loc, {"data", "data item"});
    return failed_ ? ExprId{} : b.data(static_cast<uint32_t>(number));
  }
  if (accept("self")) {
    if (!b.body.self) {
      fail(diag::IrUnknownName, loc, {"self", "instance"});
      return {};
    }
    return postfix(b.self());
  }
  if (accept("result")) {
    if (result_ == ~0u) {
      fail(diag::IrUnknownName, loc, {"result", "local"});
      return {};
    }
    return postfix(b.localPlace(result_));
  }
  auto finish = [&](ExprId id, uint8_t set) {
    if (id) b.body.expr(id).checks = set;
    return id;
  };
  // The checks follow the keyword, before the type is known: read as if the node existed.
  if (accept("convert")) {
    const size_t mark = at_;
    const bool checked = isPunct("!");
    if (checked) {  // skipped, and read again below
      ++at_;
      if (isPunct("("))
        while (token().kind != TokenKind::End && !accept(")")) ++at_;
    }
    const TypeId to = type();
    const ExprId operand = expr({});
    if (failed_) return {};
    b.loc = loc;
    const ExprId id = b.convert(to, operand);
    const size_t end = at_;
    at_ = mark;
    const uint8_t set = checks(id);
    at_ = end;
    return finish(id, set);
  }
  if (accept("select")) {
    const TypeId of = type();
    const ExprId condition = expr(types::kBool);
    expect(",");
    const ExprId yes = expr(of);
    expect(",");
    const ExprId no = expr(of);
    if (failed_) return {};
    b.loc = loc;
    const ExprId id = b.select(condition, yes, no);
    b.body.expr(id).type = types_.resolve(of);
    return id;
  }
  if (accept("address")) {
    const TypeId of = type();
    const ExprId place = expr({});
    b.loc = loc;
    return failed_ ? ExprId{} : b.address(of, place);
  }
  Op op;
  if (types::findOp(token().text, op)) {
    ++at_;
    const bool is_unary = types::operandCount(op) == 1;
    Expr probe;
    probe.kind = is_unary ? ExprKind::Unary : ExprKind::Binary;
    probe.op = op;
    b.body.exprs.resize(std::max<size_t>(b.body.exprs.size(), 1));
    b.body.exprs[0] = probe;
    const uint8_t set = checks(ExprId{0});
    b.body.exprs[0] = Expr{};
    const TypeId of = type();
    const ExprId first = expr(of);
    ExprId second;
    if (!is_unary) {
      expect(",");
      second = expr(of);
    }
    if (failed_) return {};
    b.loc = loc;
    const ExprId id = is_unary ? b.unary(op, first) : b.binary(op, first, second);
    if (!types::isComparison(op)) b.body.expr(id).type = types_.resolve(of);
    return finish(id, set);
  }
  return variable();
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
  b.body.expr(place).checks = checks(place);
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

ExprId Reader::literal(TypeId of) {
  Builder& b = *builder_;
  if (failed_) return {};
  b.loc = token().loc;
  const Loc loc = b.loc;
  auto kindOf = [&](TypeId id) { return id ? types_.plainKind(id) : TypeKind::None; };
  auto misfit = [&](std::string_view seen) {
    fail(diag::IrLiteralType, loc, {seen, of ? types_.toString(of) : "an unknown type"});
    return ExprId{};
  };
  if (token().kind == TokenKind::Text) {
    if (!TypeTable::isString(kindOf(of))) return misfit("a string");
    return b.string(of, module_.names.intern(quotedText(TokenKind::Text)));
  }
  if (accept("zero")) return of ? b.zero(of) : misfit("zero");
  if (isWord("true") || isWord("false")) {
    const bool value = tokens_[at_++].text == "true";
    if (!of) of = types::kBool;
    return kindOf(of) == TypeKind::Bool ? b.constant(of, value) : misfit(value ? "true" : "false");
  }
  if (accept("class")) {
    const TypeId record = type();
    const ExprId number = b.constant(types::kUDInt, 0);
    Expr& created = b.body.expr(number);
    created.c = record.index;
    for (size_t i = 0; i < module_.classes.size(); ++i)
      if (module_.classes[i].record == record) created.a = static_cast<uint32_t>(i) + 1;
    return number;
  }
  if (accept("null")) {
    const TypeKind kind = kindOf(of);
    return kind == TypeKind::Pointer || kind == TypeKind::Reference ? b.constant(of, 0) : misfit("null");
  }
  if (token().kind == TokenKind::Name && of && types_.kind(of) == TypeKind::Enum) {
    const NameId item = name();
    for (const auto& [item_name, value] : types_.info(of).items)
      if (item_name == item) return b.integer(of, value);
    fail(diag::IrUnknownName, loc, {module_.names.string(item), "item"});
    return {};
  }
  const bool negative = accept("-");
  if (accept("inf")) {
    if (!of) of = types::kReal;
    return TypeTable::isReal(kindOf(of)) ? b.real(of, negative ? -INFINITY : INFINITY) : misfit("inf");
  }
  if (!negative && accept("nan")) {
    if (!of) of = types::kReal;
    if (!TypeTable::isReal(kindOf(of))) return misfit("nan");
    if (!isPunct("(") || token().first_in_line) return b.real(of, std::nan(""));
    expect("(");
    const auto bits = static_cast<uint64_t>(integer());
    expect(")");
    return failed_ ? ExprId{} : b.constant(of, bits);
  }
  if (token().kind != TokenKind::Number) {
    expected("a literal");
    return {};
  }
  const std::string_view text = token().text;
  const bool is_integer = text.find_first_of(".eE") == std::string_view::npos;
  if (!of) of = is_integer ? kDefaultInteger : types::kReal;
  const TypeKind kind = kindOf(of);
  if (TypeTable::isReal(kind)) {
    double value = 0;
    if (kind == TypeKind::Real) {
      float narrow = 0;
      std::from_chars(text.data(), text.data() + text.size(), narrow);
      value = narrow;
    } else {
      std::from_chars(text.data(), text.data() + text.size(), value);
    }
    ++at_;
    return b.real(of, negative ? -value : value);
  }
  const bool is_pointer = kind == TypeKind::Pointer || kind == TypeKind::Reference;
  uint64_t magnitude = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), magnitude);
  if (!is_integer || parsed.ec != std::errc() || (!TypeTable::isScalar(kind) && !is_pointer)) return misfit(text);
  ++at_;
  const uint32_t width = is_pointer ? 64 : TypeTable::bitWidth(kind);
  const bool is_signed = types_.isSigned(kind);
  const uint64_t limit = is_signed ? (uint64_t{1} << (width - 1)) - (negative ? 0 : 1)
                                   : (width >= 64 ? ~uint64_t{0} : (uint64_t{1} << width) - 1);
  if (magnitude > limit || (negative && !is_signed && magnitude != 0)) return misfit(text);
  return b.constant(of, negative ? 0 - magnitude : magnitude);
}

ExprId Reader::postfix(ExprId base) {
  Builder& b = *builder_;
  while (!failed_ && base) {
    b.loc = token().loc;
    const TypeInfo& info = types_.info(types_.resolve(typeOf(base)));
    auto need = [&](bool holds, std::string_view access, std::string_view what) {
      if (!holds) fail(diag::IrWrongBase, b.loc, {access, what, types_.toString(typeOf(base))});
      return holds;
    };
    ExprId created;
    if (isPunct(".") && isPunct("%", 1) && token(2).kind == TokenKind::Name) {
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
      created = b.bits(base, types::idOf(kind), position);
    } else if (isPunct(".") && token(1).kind == TokenKind::Name) {
      ++at_;
      const Loc loc = token().loc;
      const NameId id = name();
      if (failed_ || !need(info.kind == TypeKind::Record, "`.`", "a record")) return {};
      const uint32_t field = fieldOf(types_.resolve(typeOf(base)), id);
      if (field == ~0u) {
        fail(diag::IrUnknownName, loc, {module_.names.string(id), "field"});
        return {};
      }
      created = b.field(base, field);
    } else if (isPunct("[") && !token().first_in_line) {
      if (!need(info.kind == TypeKind::Array, "`[`", "an array")) return {};
      const Loc loc = b.loc;
      ++at_;
      std::vector<ExprId> indices;
      do indices.push_back(expr({}));
      while (accept(","));
      expect("]");
      if (failed_) return {};
      b.loc = loc;
      created = b.index(base, indices);
    } else if (isPunct("^")) {
      if (!need(info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference, "`^`", "a pointer")) return {};
      ++at_;
      created = b.deref(base);
    } else {
      return base;
    }
    const uint8_t set = checks(created);
    b.body.expr(created).checks = set;
    base = created;
  }
  return base;
}

}  // namespace rung::ir::text_form

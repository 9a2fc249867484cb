// Lowering of calls: functions, FB and program instances, operators in call form, assertions. In: calls that sema has
// resolved. Out: Call statements with temporaries for their results; pure functions stay expressions.
// By-reference inputs (arrays, structures, strings of functions) are copied by the caller unless the callee is pure or
// nothing can change them during the call. Only a callee that writes such an input copies it, at its entry
// (statements.cpp), so callers never pay for callees that only read.
#include <algorithm>

#include "ir/assertion.h"
#include "ir/lower/lowering.h"

namespace rung::ir {

ExprId BodyLowering::placeOf(Target& target) {
  if (!target.place) target.place = stable(lowerPlace(target.expr));
  return target.place;
}

ExprId BodyLowering::lowerCall(rung::ExprId id, Target* target) {
  const rung::CallExpr& node = tree_.as<rung::CallExpr>(id);
  const sema::Call& call = project_.call(node.call);
  Loc loc = node.h.loc;

  auto plain = [&](Target* to) -> ExprId {
    switch (call.kind) {
      case sema::CallKind::Function: return lowerFunctionCall(call, node, to);
      case sema::CallKind::Method: return lowerMethodCall(call, node, to);
      case sema::CallKind::Operator: return lowerOperator(call, node);
      case sema::CallKind::Instance: lowerBlockCall(call, node, stable(lowerPlace(call.instance))); return {};
      case sema::CallKind::Program: lowerBlockCall(call, node, lowerPlace(node.callee)); return {};
      case sema::CallKind::Assertion: lowerAssertion(call, node); return {};
      case sema::CallKind::Attempt: return lowerAttempt(call, loc);
      case sema::CallKind::Delete: lowerDelete(call, loc); return {};
    }
    return {};
  };
  if (!call.en && !call.eno) return plain(target);

  // EN and ENO: nothing runs when EN is FALSE; a check that fails inside sets ENO FALSE and keeps the outputs.
  ExprId en = call.en ? lowerValue(call.en) : constantBool(true, loc);
  ExprId eno = temp(types::kBool, loc);
  assign(eno, en, loc);
  ExprId result;
  TypeId result_type = node.h.type ? strip(node.h.type) : TypeId{};
  bool has_result = result_type && types_.kind(result_type) != TypeKind::None &&
                    call.kind != sema::CallKind::Instance && call.kind != sema::CallKind::Program &&
                    call.kind != sema::CallKind::Assertion;
  if (has_result && !target) {
    result = temp(result_type, loc);
    assign(result, zero(result_type, loc), loc);
  }
  StmtId body = block([&] {
    ExprId value = plain(nullptr);
    if (!has_result || !value) return;
    if (target) {
      ExprId place = lowerAfter({&value}, [&] { return placeOf(*target); });
      assign(place, convertValue(value, typeOf(place), loc), loc);
    } else {
      assign(result, value, loc);
    }
  });
  if (call.eno) {
    StmtId guarded = body;
    body = block([&] {
      StmtId failed = block([&] { assign(eno, constantBool(false, loc), loc); });
      append(loc, TryStmt{.body_block = guarded, .catch_block = failed, .catches = true});
    });
  }
  append(loc, IfStmt{.condition = eno, .then_block = body});
  if (call.eno && call.eno_is_pin) {  // the callee has set it, if it ran
    const StmtId none = block([&] { storeOutput(call.eno, constantBool(false, loc), false, loc); });
    append(loc, IfStmt{.condition = unary(Op::Not, types::kBool, eno, loc), .then_block = none});
  } else if (call.eno) {
    storeOutput(call.eno, eno, false, loc);
  }
  if (has_result && target) target->stored = true;
  return result;
}

void BodyLowering::storeOutput(rung::ExprId target, ExprId value, bool negated, Loc loc) {
  if (negated) value = unary(Op::Not, typeOf(value), value, loc);
  ExprId place = lowerAfter({&value}, [&] { return lowerPlace(target); });
  assign(place, convertValue(value, typeOf(place), loc), loc);
}

// ---- operators in call form ------------------------------------------------------------------------------------

ExprId BodyLowering::operandOr0(const sema::Binding& binding, TypeId type, Loc loc) {
  return binding.value ? lowerValue(binding.value) : ofValue(types::defaultValue(types_, in_.module.names, type), loc);
}

ExprId BodyLowering::lowerOperator(const sema::Call& call, const rung::CallExpr& node) {
  const sema::Pou& pou = project_.pou(call.pou);
  switch (pou.pragmas.operator_kind) {
    case sema::OperatorKind::Op: return lowerArithmeticOperator(call, node);
    case sema::OperatorKind::Select: return lowerSelect(call, node);
    case sema::OperatorKind::Mux: return lowerMux(call, node);
    case sema::OperatorKind::Move:
    case sema::OperatorKind::Convert:
    case sema::OperatorKind::None:
      return convertValue(operandOr0(call.bindings.front(), strip(node.h.type), node.h.loc), node.h.type, node.h.loc);
  }
  return {};
}

ExprId BodyLowering::lowerArithmeticOperator(const sema::Call& call, const rung::CallExpr& node) {
  Op op = project_.pou(call.pou).pragmas.op;
  Loc loc = node.h.loc;
  TypeId type = strip(node.h.type);
  TypeId operand_type = type;
  for (const sema::Binding& binding : call.bindings)
    if (binding.value) {
      operand_type = strip(tree_.expr(binding.value).type);
      break;
    }
  std::vector<ExprId> operands;
  for (const sema::Binding& binding : call.bindings) {
    InsertionPoint point = here();
    ExprId operand = operandOr0(binding, operand_type, loc);
    for (size_t i = operands.size(); i-- > 0;) spill(point, {&operands[i]});
    operands.push_back(operand);
  }
  if (types::operandCount(op) == 1) return unary(op, type, operands[0], loc);
  if (!types::isComparison(op) || operands.size() == 2) {
    ExprId value = operands[0];
    for (size_t i = 1; i < operands.size(); ++i) value = binary(op, type, value, operands[i], loc);
    return value;
  }
  // A chain: GT(a, b, c) is (a > b) AND (b > c), each operand evaluated once.
  ExprId value;
  for (size_t i = 0; i + 1 < operands.size(); ++i) {
    ExprId& right = operands[i + 1];
    if (i + 2 < operands.size() && !isStable(right) && !isAggregate(typeOf(right))) right = toTemp(right, loc);
    ExprId link = binary(op, types::kBool, operands[i], right, loc);
    value = value ? binary(Op::And, types::kBool, value, link, loc) : link;
  }
  return value;
}

// SEL(G, IN0, IN1): only the chosen input is evaluated, if evaluating the other could be observed.
ExprId BodyLowering::lowerSelect(const sema::Call& call, const rung::CallExpr& node) {
  Loc loc = node.h.loc;
  TypeId type = strip(node.h.type);
  RUNG_INVARIANT(call.bindings.size() == 3, "SEL has a selector and two inputs");
  ExprId selector = operandOr0(call.bindings[0], types::kBool, loc);
  if (guard_ && mayFault(selector)) selector = toTemp(selector, loc);
  auto branch = [&](const sema::Binding& binding, Block& created) {
    const Block outer = build_.open();
    ExprId value = convertValue(operandOr0(binding, type, loc), type, loc);
    created = build_.block();
    build_.close(outer);
    return value;
  };
  Block created0, created1;
  ExprId value0 = branch(call.bindings[1], created0);
  ExprId value1 = branch(call.bindings[2], created1);
  bool plain = !created0.first && !created1.first && !mayFault(value0) && !mayFault(value1);
  if (plain && !isAggregate(type))
    return add(loc, type, SelectExpr{.condition = selector, .when_true = value1, .when_false = value0});
  ExprId result = temp(type, loc);
  auto finish = [&](Block created, ExprId value) {
    return block([&] {
      build_.block() = created;
      assign(result, value, loc);
    });
  };
  StmtId when_true = finish(created1, value1);
  StmtId when_false = finish(created0, value0);
  append(loc, IfStmt{.condition = selector, .then_block = when_true, .else_block = when_false});
  return result;
}

// MUX(K, IN0, IN1, …): any K outside 0..n-1 chooses the last input (syntax manual 5.4.1.3.4, TM/TP 6.2.2).
ExprId BodyLowering::lowerMux(const sema::Call& call, const rung::CallExpr& node) {
  Loc loc = node.h.loc;
  TypeId type = strip(node.h.type);
  RUNG_INVARIANT(call.bindings.size() >= 2, "MUX has a selector and inputs");
  ExprId selector = lowerValue(call.bindings[0].value);
  if (guard_ && mayFault(selector)) selector = toTemp(selector, loc);
  ExprId result = temp(type, loc);
  uint32_t inputs = static_cast<uint32_t>(call.bindings.size()) - 1;
  std::vector<StmtId> blocks;
  for (uint32_t i = 0; i < inputs; ++i)
    blocks.push_back(
        block([&] { assign(result, convertValue(operandOr0(call.bindings[i + 1], type, loc), type, loc), loc); }));
  uint32_t first_case = static_cast<uint32_t>(body_.cases.size());
  for (uint32_t i = 0; i + 1 < inputs; ++i) {
    body_.cases.push_back({{static_cast<uint32_t>(body_.ranges.size()), 1}, blocks[i]});
    body_.ranges.push_back({i, i});
  }
  append(loc, SwitchStmt{.selector = selector, .cases = {first_case, inputs - 1}, .else_block = blocks.back()});
  return result;
}

// ---- functions -------------------------------------------------------------------------------------------------

ExprId BodyLowering::defaultArgument(sema::VarId pin_id, Loc loc) {
  const sema::Var& pin = project_.var(pin_id);
  TypeId type = strip(pin.type);
  if (!isAggregate(type)) {
    if (pin.init)
      if (auto value = constantOf(project_, pin.init)) return convertValue(ofValue(*value, loc), type, loc);
    if (in_.isZero(type)) return zero(type, loc);
  }
  ExprId place = temp(type, loc);
  storeInitial(place, type, pin.init, false);
  return place;
}

// The place of a by-reference input: the variable itself when nothing can change it during the call, else a copy.
ExprId BodyLowering::argumentPlace(ExprId value, TypeId pin_type, bool may_alias, Loc loc) {
  const Expr expr = body_.expr(value);
  bool constant_memory = expr.kind == ExprKind::String || expr.kind == ExprKind::Data || expr.kind == ExprKind::Zero;
  bool is_value = expr.kind == ExprKind::Convert || expr.kind == ExprKind::Select || expr.kind == ExprKind::Call;
  bool same = typeOf(value) == strip(pin_type) || TypeTable::isString(types_.kind(pin_type));
  if (constant_memory || (same && !is_value && !may_alias)) return value;
  if (const uint32_t* index = localOf(expr); index != nullptr && body_.locals[*index].kind == LocalKind::Temp)
    return value;
  ExprId copy = temp(same ? typeOf(value) : strip(pin_type), expr.loc);
  assign(copy, value, loc);
  return copy;
}

// The place of a VAR_IN_OUT: the variable, or a copy of the value that a VAR_IN_OUT CONSTANT is given.
ExprId BodyLowering::inOutPlace(rung::ExprId argument, TypeId pin_type) {
  Loc loc = tree_.loc(argument);
  ExprId place = lowerPlace(argument);
  if (sema::PouId wanted = in_.pouOfRecord(strip(pin_type))) place = asBase(place, wanted, loc);
  if (isPlace(body_.expr(place).kind)) return stable(place);
  ExprId copy = temp(strip(pin_type), loc);
  assign(copy, convertValue(place, strip(pin_type), loc), loc);
  return copy;
}

// An unconditional call: without EN and ENO.
bool BodyLowering::isPlainCall(rung::ExprId expr) const {
  if (tree_.kind(expr) != rung::ExprKind::Call) return false;
  const sema::Call& call = project_.call(tree_.as<rung::CallExpr>(expr).call);
  return !call.en && !call.eno;
}

// Whether the first input of a native string function may be built in the target of its result, as in
// `s := CONCAT(CONCAT(a, b), c)`: a and b go to s, then c is appended in place. The other arguments must not see that,
// and cutting to the target's capacity must not change the result.
bool BodyLowering::mayChain(const sema::Call& call, const Target& target) const {
  const sema::Pou& pou = project_.pou(call.pou);
  if (!target.early) return false;
  if (!pou.pragmas.prefix && types_.info(typeOf(target.place)).length < types_.info(strip(pou.result)).length)
    return false;
  if (isTemp(target.place)) return true;
  for (size_t i = 1; i < call.bindings.size(); ++i)
    if (call.bindings[i].value && !isApart(call.bindings[i].value, rootVar(target.expr))) return false;
  return true;
}

ExprId BodyLowering::lowerMethodCall(const sema::Call& call, const rung::CallExpr& node, Target* target) {
  const sema::PouId owner = project_.pou(call.pou).owner;
  ExprId object;
  if (call.instance)
    object = stable(lowerPlace(call.instance));
  else
    object = self(node.h.loc);
  if (!call.bindings.empty() && project_.pou(call.pou).kind == PouKind::Action) {
    lowerBlockCall(call, node, object);
    return {};
  }
  return lowerFunctionCall(call, node, target, asBase(object, owner, node.h.loc));
}

ExprId BodyLowering::lowerFunctionCall(const sema::Call& call, const rung::CallExpr& node, Target* target,
                                       ExprId object) {
  const sema::Pou& pou = project_.pou(call.pou);
  BodyId callee_id = in_.bodyOf(call.pou);
  Loc loc = node.h.loc;

  struct AfterCall {
    rung::ExprId target;
    ExprId value;
    bool negated;
  };
  std::vector<ExprId> arguments, hidden;
  std::vector<AfterCall> after;
  std::vector<bool> is_variable;  // an in-out: the variable itself, reached through temporaries only
  auto spillArguments = [&](InsertionPoint point) {
    for (size_t i = 0; i < arguments.size(); ++i)
      if (!is_variable[i]) spill(point, {&arguments[i]});
  };
  bool callee_is_pure = in_.module.body(callee_id).pure;
  bool has_reference_outputs = false;
  for (const sema::Binding& binding : call.bindings) {
    SectionKind section = project_.var(binding.pin).section;
    if (section == SectionKind::InOut || section == SectionKind::Output) has_reference_outputs = true;
  }

  // A native string function writes directly into the target: it allows inputs that are the target itself.
  TypeId result_type = pou.result ? strip(pou.result) : TypeId{};
  bool makes_string = result_type && pou.pragmas.native && TypeTable::isString(types_.kind(result_type));
  Target own;
  if (target && makes_string) {
    TypeId type = target->place ? typeOf(target->place) : strip(tree_.expr(target->expr).type);
    if (types_.kind(type) != types_.kind(result_type)) target = nullptr;
  }
  if (!makes_string || !target) {
    target = nullptr;
    if (makes_string) {
      own = {.place = temp(result_type, loc), .early = true};
      target = &own;
    }
  }
  bool chains = makes_string && callee_is_pure && target->early && placeOf(*target) && mayChain(call, *target);

  size_t next_binding = 0;
  for (sema::VarId pin_id : pou.vars) {
    const sema::Var& pin = project_.var(pin_id);
    if (pin.section != SectionKind::Input && pin.section != SectionKind::Output && pin.section != SectionKind::InOut)
      continue;
    // Bindings are in the order of the pins; an open pin may be absent.
    const sema::Binding* binding = nullptr;
    for (size_t i = 0; i < call.bindings.size(); ++i) {
      const sema::Binding& candidate = call.bindings[(next_binding + i) % call.bindings.size()];
      if (candidate.pin == pin_id) {
        binding = &candidate;
        next_binding += i + 1;
        break;
      }
    }
    bool open = binding == nullptr || !binding->value;
    TypeId pin_type = strip(pin.type);
    InsertionPoint point = here();
    ExprId argument;
    if (types_.isOpenArray(pin_type)) {
      OpenArray array =
          open ? noOpenArray(pin_type, loc)
               : passOpenArray(binding->value, pin_type, pin.section == SectionKind::Input && !callee_is_pure);
      argument = array.pointer;
      hidden.insert(hidden.end(), array.bounds.begin(), array.bounds.end());
    } else if (pin.section == SectionKind::Input) {
      if (open) {
        argument = defaultArgument(pin_id, loc);
      } else if (isAggregate(pin_type)) {
        bool may_alias = !callee_is_pure && (!pou.pragmas.native || has_reference_outputs);
        ExprId value;
        if (chains && arguments.empty() && isPlainCall(binding->value)) {
          Target inner = *target;
          value = lowerCall(binding->value, &inner);
          if (inner.stored) value = inner.place;
        } else {
          value = lowerValue(binding->value);
        }
        Loc at = tree_.loc(binding->value);
        // A body in ST sees no more of a string than its pin takes; the library's C functions take any length.
        bool cut = !pou.pragmas.native && TypeTable::isString(types_.kind(pin_type)) &&
                   types_.info(typeOf(value)).length > types_.info(pin_type).length;
        if (cut) {
          argument = temp(pin_type, at);
          assign(argument, value, at);
        } else {
          argument = argumentPlace(value, pin_type, may_alias, at);
        }
      } else {
        argument = lowerValue(binding->value);
        if (guard_ && mayFault(argument)) argument = toTemp(argument, loc);
      }
    } else if (pin.section == SectionKind::InOut) {
      RUNG_INVARIANT(!open, "sema reports an open VAR_IN_OUT");
      argument = inOutPlace(binding->value, pin_type);
      const Expr& place = body_.expr(argument);
      bool part_of_byte = place.kind == ExprKind::Bits || isImageBit(place);
      if (part_of_byte) {  // a copy that is written back
        ExprId copy = toTemp(argument, loc);
        after.push_back({binding->value, copy, false});
        argument = copy;
      }
    } else if (!open) {
      argument = temp(pin_type, loc);
      after.push_back({binding->value, argument, binding->negated});
    }
    spillArguments(point);
    arguments.push_back(argument);
    is_variable.push_back(pin.section == SectionKind::InOut && !types_.isOpenArray(pin_type));
  }
  for (ExprId bound : hidden) {
    arguments.push_back(bound);
    is_variable.push_back(false);
  }

  ExprId result;
  if (makes_string) {
    InsertionPoint point = here();
    result = placeOf(*target);
    spillArguments(point);
    target->stored = true;
  }
  const Slice<ExprId> operands = list(arguments);
  if (callee_is_pure && result_type && !isAggregate(result_type) && after.empty())
    return add(loc, result_type, CallExpr{.callee = callee_id, .operands = operands});

  if (result_type && !result) result = temp(result_type, loc);
  append(loc, CallStmt{.callee = callee_id,
                       .self = object,
                       .operands = operands,
                       .result = result,
                       .is_virtual = call.is_virtual,
                       .is_checked = call.is_virtual && in_.checksCasts()});
  for (const AfterCall& output : after) storeOutput(output.target, output.value, output.negated, loc);
  if (pou.pragmas.faults && !(pou_ && project_.pou(pou_).library)) {
    const StmtId fault = block(
        [&] { append(loc, FaultStmt{.value = convert(result, types::kLInt, loc), .fault = types::Fault::Lock}); });
    const ExprId bad = binary(Op::Ne, types::kBool, result, constant(result_type, 0, loc), loc);
    append(loc, IfStmt{.condition = bad, .then_block = fault});
  }
  return result;
}

// ---- function blocks and programs ------------------------------------------------------------------------------

void BodyLowering::lowerBlockCall(const sema::Call& call, const rung::CallExpr& node, ExprId instance) {
  Loc loc = node.h.loc;
  struct CopyBack {
    rung::ExprId target;
    ExprId value;
  };
  std::vector<CopyBack> copies;
  std::vector<ExprId> short_lived;  // in-outs of an instance that outlives their variable
  const auto isLocal = [&](ExprId place) { return body_.expr(rootOf(body_, place)).kind == ExprKind::Local; };
  for (const sema::Binding& binding : call.bindings) {
    if (binding.is_output || !binding.value) continue;
    const sema::Var& pin = project_.var(binding.pin);
    TypeId type = strip(pin.type);
    Loc at = tree_.loc(binding.value);
    if (types_.isOpenArray(type)) {
      OpenArray array = passOpenArray(binding.value, type, false);
      assign(field(asBase(instance, pin.pou, at), pin.field, typeOf(array.pointer), at), array.pointer, at);
      for (uint32_t i = 0; i < array.bounds.size(); ++i) {
        const sema::Var& bound = project_.var({pin.open_array.bounds.index + i});
        assign(field(asBase(instance, pin.pou, at), bound.field, bound.type, at), array.bounds[i], at);
      }
      continue;
    }
    ExprId place = pinPlace(instance, pin, at);
    if (pin.section == SectionKind::InOut) {
      ExprId variable = inOutPlace(binding.value, type);
      const Expr& expr = body_.expr(variable);
      if (expr.kind == ExprKind::Bits || isImageBit(expr)) {
        ExprId copy = toTemp(variable, at);
        copies.push_back({binding.value, copy});
        variable = copy;
      }
      if (isLocal(variable) && !isLocal(instance)) short_lived.push_back(place);
      append(at, BindStmt{.field = place, .place = variable});
    } else {
      assign(place, lowerValue(binding.value), at);
    }
  }
  if (project_.pou(call.pou).kind == PouKind::Action) {
    sema::Call action = call;
    action.bindings.clear();
    lowerFunctionCall(action, node, nullptr, asBase(instance, project_.pou(call.pou).owner, loc));
  } else {
    const BodyId callee = call.is_virtual ? in_.blockCallOf(call.pou) : in_.bodyOf(call.pou);
    append(loc, CallStmt{.callee = callee,
                         .self = instance,
                         .is_virtual = call.is_virtual,
                         .is_checked = call.is_virtual && in_.checksCasts()});
  }
  // The variables that they refer to end with this body or sooner, and a trace must not follow them there.
  for (const ExprId field : short_lived) append(loc, BindStmt{.field = field});
  for (const CopyBack& copy : copies) storeOutput(copy.target, copy.value, false, loc);
  for (const sema::Binding& binding : call.bindings) {
    if (!binding.is_output || !binding.value) continue;
    const sema::Var& pin = project_.var(binding.pin);
    storeOutput(binding.value, pinPlace(instance, pin, loc), binding.negated, loc);
  }
}

// ---- assertions ------------------------------------------------------------------------------------------------

namespace {

// One line, without blanks at its ends and without parentheses that open or close outside of it.
std::string collapseBlanks(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (!blank) out += c;
    if (blank && !out.empty() && out.back() != ' ') out += ' ';
  }
  const auto count = [&](char c) { return std::count(out.begin(), out.end(), c); };
  while (!out.empty() && (out.back() == ' ' || (out.back() == ')' && count(')') > count('(')))) out.pop_back();
  while (!out.empty() && (out[0] == ' ' || (out[0] == '(' && count('(') > count(')')))) out.erase(0, 1);
  return out;
}

}  // namespace

// The condition, its left and its right side as written, a line each; a literal's side is empty.
NameId BodyLowering::comparedOperands(const rung::CallExpr& node, const rung::BinaryExpr& condition) {
  const Sources& sources = project_.sources;
  const FileId file = sources.fileOf(node.h.loc);
  const std::string_view source = sources.sourceText(file);
  const uint32_t base = sources.begin(file).offset;
  const size_t open = source.find('(', tree_.begin(node.callee).offset - base);
  const size_t at = condition.h.loc.offset - base, op_size = sources.tokenAt(condition.h.loc).size();
  size_t end = node.end.offset - base;
  if (node.arguments.count > 1) end = source.rfind(',', tree_.begin(tree_.list(node.arguments)[1].value).offset - base);
  if (end == std::string_view::npos || open >= at || at + op_size > end || end > source.size()) return {};
  const std::string left = collapseBlanks(source.substr(open + 1, at - open - 1)), op(source.substr(at, op_size)),
                    right = collapseBlanks(source.substr(at + op_size, end - at - op_size));
  const auto name = [&](rung::ExprId side, const std::string& text) {
    while (tree_.kind(side) == rung::ExprKind::Convert) side = tree_.as<rung::ConvertExpr>(side).operand;
    const TypeKind kind = types_.info(strip(tree_.expr(side).type)).kind;
    const bool is_self_explanatory =
        tree_.kind(side) == rung::ExprKind::Literal || (kind == TypeKind::Enum && constantOf(project_, side));
    return is_self_explanatory ? std::string() : text;
  };
  const std::string left_name = name(condition.left, left), right_name = name(condition.right, right);
  if (left_name.empty() && right_name.empty()) return {};
  return in_.module.names.intern(left + ' ' + op + ' ' + right + '\n' + left_name + '\n' + right_name);
}

void BodyLowering::lowerAssertion(const sema::Call& call, const rung::CallExpr& node) {
  AssertStmt stmt{.assertion = static_cast<Assertion>(call.assertion)};
  size_t count = call.bindings.size();
  size_t operands = call.assertion == sema::Assertion::Assert ? 1 : call.assertion == sema::Assertion::AssertEq ? 2 : 3;
  RUNG_INVARIANT(count >= operands, "an assertion has its operands");
  const rung::ExprId condition = call.bindings[0].value;
  if (operands == 1 && tree_.kind(condition) == rung::ExprKind::Binary) {
    const rung::BinaryExpr& node_of = tree_.as<rung::BinaryExpr>(condition);
    const BinaryOp op = node_of.op();
    const TypeId type = strip(tree_.expr(node_of.left).type);
    const bool compares = op >= BinaryOp::Equal && op <= BinaryOp::GreaterEqual;
    if (compares && assertedKind(types_, type) != RUNG_POINTER) stmt.shown = comparedOperands(node, node_of);
  }
  ExprId a, b, c;
  if (stmt.shown) {
    const rung::BinaryExpr& compared = tree_.as<rung::BinaryExpr>(condition);
    const auto once = [&](ExprId value) { return isStable(value) ? value : toTemp(value, compared.h.loc); };
    b = lowerValue(compared.left);
    c = lowerAfter({&b}, [&] { return lowerValue(compared.right); });
    b = once(b);
    c = once(c);
    a = binary(sema::operatorOf(compared.op()), types::kBool, b, c, compared.h.loc);
  } else {
    a = lowerValue(condition);
    if (operands > 1) b = lowerAfter({&a}, [&] { return lowerValue(call.bindings[1].value); });
    if (operands > 2) c = lowerAfter({&a, &b}, [&] { return lowerValue(call.bindings[2].value); });
  }
  stmt.first = a;
  stmt.second = b;
  stmt.third = c;
  if (count > operands && call.bindings[operands].value)
    if (auto text = constantOf(project_, call.bindings[operands].value))
      stmt.text = NameId{static_cast<uint32_t>(text->bits)};
  append(node.h.loc, stmt);
}

}  // namespace rung::ir

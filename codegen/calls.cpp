// SPDX-License-Identifier: Apache-2.0
// Calls in C++: a call becomes a plan (what is passed how, what is copied, where the result goes) and then C++. In: a
// CallStmt or a CallExpr. Out: the call, with the copies before and after it. Called by statements.cpp, expressions.cpp
// and strings.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
#include "codegen/cxx/print.h"
#include "codegen/signature.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

// ---- the plan

CallWriter::CallPlan CallWriter::planCall(const ir::CallStmt& stmt) const {
  const Body& callee = module_.body(stmt.callee);
  const std::span<const ExprId> operands = body_->list(stmt.operands);
  CallPlan plan;
  if (!stmt.self && lengths().isSizedCall(callee, stmt.operands, stmt.result)) {
    const bool makes_slice = stmt.result && isSlice(stmt.result);
    plan.form = makes_slice ? CallPlan::Form::Slice : CallPlan::Form::Sized;
  } else if (stmt.is_virtual) {
    plan.form = CallPlan::Form::Virtual;
  }
  for (const ir::Local& parameter : ir::parameters(callee)) {
    if (plan.arguments.size() >= operands.size()) break;
    const ExprId operand = operands[plan.arguments.size()];
    // Bits and views of the image are not variables in memory.
    const bool is_copied = operand && ir::isPlace(expr(operand).kind) && !places().isLvalue(operand);
    const CallPlan::Way way = !parameter.by_reference ? CallPlan::Way::Value
                              : is_copied             ? CallPlan::Way::Copy
                                                      : CallPlan::Way::Reference;
    plan.arguments.push_back({&parameter, operand, way});
  }
  if (callee.result && ir::isAggregate(types_, callee.result)) {
    plan.result = writesInPlace(stmt) ? CallPlan::Result::InPlace : CallPlan::Result::Copied;
  } else if (callee.result && stmt.result) {
    plan.result = CallPlan::Result::Value;
  }
  plan.is_measured = stmt.result && isMeasured(stmt.result);
  return plan;
}

// An aggregate is written by the callee to an address of ours, which must not be one of its inputs.
bool CallWriter::writesInPlace(const ir::CallStmt& stmt) const {
  const Body& callee = module_.body(stmt.callee);
  const ExprId to = stmt.result;
  if (!to || !places().isLvalue(to)) return false;
  const TypeId type = expr(to).type;
  if (isString(callee.result) && isWide(type) != isWide(callee.result)) return false;
  if (callee.native) return true;
  if (isString(callee.result) && capacityOf(type) < capacityOf(callee.result)) return false;
  const uint32_t* root = ir::localOf(expr(ir::rootOf(*body_, to)));
  if (root == nullptr || body_->locals[*root].by_reference) return false;
  for (const ExprId operand : body_->list(stmt.operands)) {
    if (!operand || !ir::isPlace(expr(operand).kind)) continue;
    const uint32_t* other = ir::localOf(expr(ir::rootOf(*body_, operand)));
    if (other != nullptr && *other == *root) return false;
  }
  return true;
}

// ---- the statements

void CallWriter::callStatement(StmtId id) {
  const ir::CallStmt& stmt = body_->stmt(id).as<ir::CallStmt>();
  const Body& callee = module_.body(stmt.callee);
  const StmtId appended_by = analysis_->appends.find(id);
  if (appended_by == id) return;
  if (stmt.self) checks().prepare(stmt.self);
  for (const ExprId operand : body_->list(stmt.operands)) {
    if (operand) checks().prepare(operand);
  }
  if (stmt.result) checks().prepare(stmt.result);
  if (appended_by) return appendText(stmt, body_->stmt(appended_by).as<ir::CallStmt>().result);
  const CallPlan plan = planCall(stmt);
  if (plan.form == CallPlan::Form::Slice) return sliceCall(stmt);
  if (plan.form == CallPlan::Form::Virtual) {
    dispatch(stmt, body_->stmt(id).loc);
  } else if ((callee.kind == ir::BodyKind::Function || callee.native || facts_.is_inlined[stmt.callee.index] != 0) &&
             plan.form != CallPlan::Form::Sized) {
    call(stmt.callee);  // the other blocks are declared with their records
  }
  Made made;
  if (plan.is_measured) made.length = strings().lengthName(stmt.result);
  passArguments(stmt, plan, made);
  add(made.before);
  if (const WriteBacks::Call* before = analysis_->write_backs.find(id))
    for (const uint32_t field : before->fields) perform(writeBack(field));
  passResult(stmt, plan, made);
  cxx::Stmt* const performed = tree_.stmt(cxx::StmtKind::Expression, callOf(stmt, plan, made));
  if (!callee.native) performed->text = "RUNG_CALL ";
  add(performed);
  if (!callee.native) noteCall(stmt, body_->stmt(id).loc);
  add(made.lengths);
  if (made.copy != nullptr && stmt.result) copyResult(stmt.result, callee.result, made);
  if (plan.is_measured && !callee.native && made.copy == nullptr)
    assign(made.length, tree_.call("rung_string_length", {places().place(stmt.result)}));
  add(made.after);
}

// The call with what becomes of its result.
cxx::Ex CallWriter::callOf(const ir::CallStmt& stmt, const CallPlan& plan, const Made& made) {
  const Ex result = functionCall(stmt, plan, made);
  if (plan.result == CallPlan::Result::Value) return places().store(stmt.result, result);
  const bool gives_length = module_.body(stmt.callee).native && made.copy == nullptr && plan.is_measured;
  return gives_length ? tree_.infix(Operator::Assign, made.length, result) : result;
}

// After a call: what a fault inside of it notes. Where a pointer leads may have changed by then.
void CallWriter::noteCall(const ir::CallStmt& stmt, Loc loc) {
  const Ex site =
      tree_.infix(Operator::Add, tree_.name("sites_" + group_.stem), tree_.number(checks().addSite(loc), "u"));
  uint32_t pointers = 0;  // to be read for the address; that of `p^` is p
  if (stmt.self)
    ir::forEachExpr(*body_, stmt.self, [&](ExprId at) { pointers += expr(at).kind == ExprKind::Deref ? 1 : 0; });
  const bool is_known = stmt.self && pointers == (expr(stmt.self).kind == ExprKind::Deref ? 1u : 0u);
  const Ex instance = is_known ? addressOf(places().place(stmt.self)) : tree_.fixed("nullptr");
  add(tree_.stmt(cxx::StmtKind::Macro, tree_.call("RUNG_CALLED", {site, instance})));
}

// line_n += rung_standard_TO_STRING__DINT_sized(n, line + line_n, 80 - line_n); an in-out may be longer than its type.
void CallWriter::appendText(const ir::CallStmt& make, ExprId to) {
  const Ex length = strings().lengthName(to);
  const Body& callee = module_.body(make.callee);
  const uint32_t capacity = capacityOf(expr(to).type);
  if (!lengths().isOwn(to)) assign(length, tree_.call("rung_min_u32", {length, tree_.number(capacity)}));
  Parts made;
  if (isSized(module_, callee)) {
    made = strings().sizedCall(callee, make.operands, "sized");
  } else {
    call(make.callee);
    made = {ir::nativeName(module_, callee), {tree_.fixed("ctx")}};
    for (const ExprId operand : body_->list(make.operands)) made.arguments.push_back(values().value(operand));
  }
  made.arguments.push_back(tree_.infix(Operator::Add, places().place(to), length));
  made.arguments.push_back(tree_.infix(Operator::Subtract, tree_.number(capacity, "u"), length));
  perform(tree_.infix(Operator::AssignAdd, length, tree_.call(made.function, made.arguments)));
}

void CallWriter::sliceCall(const ir::CallStmt& stmt) {
  Parts made = strings().sizedCall(module_.body(stmt.callee), stmt.operands, "slice");
  made.arguments.push_back(tree_.number(capacityOf(expr(stmt.result).type)));
  made.arguments.push_back(addressOf(strings().lengthName(stmt.result)));
  assign(strings().sliceName(stmt.result), tree_.call(made.function, made.arguments));
}

void CallWriter::passArguments(const ir::CallStmt& stmt, const CallPlan& plan, Made& made) {
  for (const CallPlan::Argument& argument : plan.arguments) {
    switch (argument.way) {
      case CallPlan::Way::Value: made.arguments.push_back(values().value(argument.operand)); break;
      case CallPlan::Way::Reference:
        made.arguments.push_back(places().reference(*argument.parameter, argument.operand));
        break;
      case CallPlan::Way::Copy: passCopy(argument, made); break;
    }
    if (passesLength(module_, module_.body(stmt.callee), *argument.parameter)) passLength(stmt, argument.operand, made);
  }
}

void CallWriter::passCopy(const CallPlan::Argument& argument, Made& made) {
  const ir::Local& parameter = *argument.parameter;
  const TypeId type = expr(argument.operand).type;
  const bool is_input = parameter.kind == ir::LocalKind::Input;
  if (ir::isAggregate(types_, type)) {  // its bytes, which have any alignment in the image
    const Ex copy = newVariable(type, "v"), place = places().imageAddress(argument.operand);
    const auto move = [&](Ex to, Ex from) { perform(tree_.call("memcpy", {to, from, sizeOf(copy)})); };
    made.before.append(nested([&] { move(addressOf(copy), place); }));
    if (!is_input) made.after.append(nested([&] { move(place, addressOf(copy)); }));
    made.arguments.push_back(isString(type) ? copy : addressOf(copy));
    return;
  }
  const Ex copy = newVariable(parameter.type, "v");
  made.before.append(nested([&] { assign(copy, values().value(argument.operand)); }));
  if (!is_input) made.after.append(nested([&] { perform(places().store(argument.operand, copy)); }));
  made.arguments.push_back(addressOf(copy));
}

// Through a variable: the length itself stays in a register. What is passed twice has no known length in either.
void CallWriter::passLength(const ir::CallStmt& stmt, ExprId operand, Made& made) {
  const Ex name = tree_.name(newName("n"));
  declare("uint32_t", name->text);
  made.arguments.push_back(addressOf(name));
  const uint32_t number = operand ? analysis_->uses.variables.stringAt(operand) : kNoVariable;
  const bool is_known = number != kNoVariable && isPassedOnce(&stmt, number);
  const Ex length = is_known ? strings().lengthName(operand) : tree_.fixed("RUNG_UNCOUNTED");
  made.before.append(nested([&] { assign(name, length); }));
  if (is_known) made.lengths.append(nested([&] { assign(length, name); }));
}

void CallWriter::passResult(const ir::CallStmt& stmt, const CallPlan& plan, Made& made) {
  const Body& callee = module_.body(stmt.callee);
  TypeId type = callee.result;
  Ex to = nullptr;
  if (plan.result == CallPlan::Result::InPlace) {
    to = places().place(stmt.result);
    type = expr(stmt.result).type;
  } else if (plan.result == CallPlan::Result::Copied) {
    to = made.copy = newVariable(callee.result, "v");
  } else {
    return;
  }
  made.results.push_back(isString(callee.result) ? to : addressOf(to));
  if (callee.native && isString(callee.result)) made.results.push_back(tree_.number(capacityOf(type)));
}

cxx::Ex CallWriter::functionCall(const ir::CallStmt& stmt, const CallPlan& plan, const Made& made) {
  const Body& callee = module_.body(stmt.callee);
  Parts call;
  if (plan.form == CallPlan::Form::Sized) {
    call = strings().sizedCall(callee, stmt.operands, "sized");
    call.arguments.insert(call.arguments.end(), made.results.begin(), made.results.end());
    return tree_.call(call.function, call.arguments);
  }
  if (callee.native) {
    call.function = ir::nativeName(module_, callee);
    call.arguments.push_back(tree_.fixed("ctx"));
    if (stmt.self) call.arguments.push_back(addressOf(places().place(stmt.self)));
  } else {
    if (plan.form == CallPlan::Form::Virtual) {
      const Ex table = tree_.name(methodName(module_, stmt.callee, "table"));
      call.function = cxx::toString(tree_.element(table, indexOfMethod(stmt)));
    } else {
      appendFunctionName(call.function, module_, callee);
    }
    if (stmt.self) {
      const Ex self = places().place(stmt.self);
      call.arguments.push_back(isMethod(callee) ? addressOf(self) : self);
    }
    call.arguments.push_back(tree_.fixed("ctx"));
  }
  for (const std::vector<Ex>* list : {&made.arguments, &made.results})
    call.arguments.insert(call.arguments.end(), list->begin(), list->end());
  return tree_.call(call.function, call.arguments);
}

void CallWriter::copyResult(ExprId to, TypeId from, const Made& made) {
  const TypeId type = expr(to).type;
  const Ex place = places().place(to);
  if (!isString(type)) {
    perform(tree_.call("memcpy", {addressOf(place), addressOf(made.copy), sizeOf(made.copy)}));
    return;
  }
  const bool wide = isWide(type);
  const char* const function = wide == isWide(from) ? strings().assignFunction(type)
                               : wide               ? "rung_wstring_of_string"
                                                    : "rung_string_of_wstring";
  const Ex copy = tree_.call(function, {place, tree_.number(capacityOf(type)), made.copy});
  made.length != nullptr ? assign(made.length, copy) : perform(copy);
}

cxx::Ex CallWriter::callExpr(const Expr& e) {
  const Parts call = parts(e);
  return tree_.call(call.function, call.arguments);
}

CallWriter::Parts CallWriter::parts(const Expr& e) {
  const auto [id, operands] = e.as<ir::CallExpr>();
  const Body& callee = module_.body(id);
  if (!isString(e.type) && lengths().isSizedCall(callee, operands, {}))
    return strings().sizedCall(callee, operands, "sized");
  call(id);
  Parts made;
  if (callee.native) {
    made.function = ir::nativeName(module_, callee);
  } else {
    appendFunctionName(made.function, module_, callee);
  }
  made.arguments.push_back(tree_.fixed("ctx"));
  uint32_t i = 0;
  for (const ir::Local& parameter : ir::parameters(callee)) {
    if (i >= operands.count) break;
    const ExprId operand = body_->list(operands)[i++];
    made.arguments.push_back(parameter.by_reference ? places().reference(parameter, operand) : values().value(operand));
  }
  return made;
}

// ---- methods

void CallWriter::dispatch(const ir::CallStmt& stmt, Loc loc) {
  if (std::find(group_.virtuals.begin(), group_.virtuals.end(), stmt.callee) == group_.virtuals.end())
    group_.virtuals.push_back(stmt.callee);
  if (stmt.is_checked) classCheck(stmt, loc);
}

// The row of a dispatch table for the object's class.
cxx::Ex CallWriter::indexOfMethod(const ir::CallStmt& stmt) {
  const Ex number = tree_.call("rung_class_of", {addressOf(places().place(stmt.self))});
  return tree_.infix(Operator::Subtract, number, tree_.name(methodName(module_, stmt.callee, "first")));
}

// In front of a virtual call: a pointer bound by mistake has the number of no class, or of an unrelated one.
void CallWriter::classCheck(const ir::CallStmt& stmt, Loc loc) {
  const ir::BodyId method = stmt.callee;
  const Ex index = indexOfMethod(stmt);
  const Ex is_beyond = tree_.infix(Operator::GreaterEqual, index, tree_.name(methodName(module_, method, "count")));
  const Ex row = tree_.element(tree_.name(methodName(module_, method, "table")), index);
  const Ex is_empty = tree_.infix(Operator::Equal, row, tree_.fixed("nullptr"));
  checks().check(tree_.infix(Operator::Or, is_beyond, is_empty), loc, types::Fault::Cast,
                 tree_.fixed("RUNG_NO_SUCH_METHOD"));
}

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// Calls in C++: a call becomes a plan (what is passed how, what is copied, where the result goes) and then text. In: a
// CallStmt or a CallExpr. Out: the call, with the copies before and after it. Called by statements.cpp, expressions.cpp
// and strings.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
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

// ---- the text

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
  if (appended_by) {
    appendText(stmt, body_->stmt(appended_by).as<ir::CallStmt>().result);
    return;
  }
  const CallPlan plan = planCall(stmt);
  if (plan.form == CallPlan::Form::Slice) {
    sliceCall(stmt);
    return;
  }
  if (plan.form == CallPlan::Form::Virtual) {
    dispatch(stmt, body_->stmt(id).loc);
  } else if ((callee.kind == ir::BodyKind::Function || callee.native || facts_.is_inlined[stmt.callee.index] != 0) &&
             plan.form != CallPlan::Form::Sized) {
    call(stmt.callee);  // the other blocks are declared with their records
  }
  CallText text;
  if (plan.is_measured) text.length = captured([&] { strings().lengthName(stmt.result); });
  passArguments(stmt, plan, text);
  out_ += text.before;
  if (const WriteBacks::Call* before = analysis_->write_backs.find(id)) {
    for (const uint32_t field : before->fields) {
      writeBack(out_, field);
      out_ += ' ';
    }
  }
  passResult(stmt, plan, text);
  const std::string function = captured([&] { callFunction(stmt, plan, text); });
  if (!callee.native) out_ += "RUNG_CALL ";
  if (plan.result == CallPlan::Result::Value) {
    places().store(stmt.result, function);
  } else {
    if (callee.native && text.copy.empty() && plan.is_measured) out_ += text.length + " = ";
    out_ += function;
  }
  out_ += ';';
  if (!callee.native) noteCall(stmt, body_->stmt(id).loc);
  out_ += text.lengths;
  if (!text.copy.empty() && stmt.result) copyResult(stmt.result, callee.result, text);
  if (plan.is_measured && !callee.native && text.copy.empty()) {
    out_ += ' ' + text.length + " = rung_string_length(";
    places().place(stmt.result);
    out_ += ");";
  }
  out_ += text.after;
}

// After a call: what a fault inside of it notes. Where a pointer leads may have changed by then.
void CallWriter::noteCall(const ir::CallStmt& stmt, Loc loc) {
  out_ += " RUNG_CALLED(sites_" + group_.stem + " + ";
  appendUnsigned(out_, checks().addSite(loc));
  out_ += "u, ";
  uint32_t pointers = 0;  // to be read for the address; that of `p^` is p
  if (stmt.self)
    ir::forEachExpr(*body_, stmt.self, [&](ExprId at) { pointers += expr(at).kind == ExprKind::Deref ? 1 : 0; });
  if (stmt.self && pointers == (expr(stmt.self).kind == ExprKind::Deref ? 1u : 0u)) {
    out_ += '&';
    places().place(stmt.self);
  } else {
    out_ += "nullptr";
  }
  out_ += ')';
}

// line_n += rung_standard_TO_STRING__DINT_sized(n, line + line_n, 80 - line_n); an in-out may be longer than its type.
void CallWriter::appendText(const ir::CallStmt& make, ExprId to) {
  const std::string length = captured([&] { strings().lengthName(to); });
  const Body& callee = module_.body(make.callee);
  if (!lengths().isOwn(to)) {
    out_ += length + " = rung_min_u32(" + length + ", ";
    appendUnsigned(out_, capacityOf(expr(to).type));
    out_ += "); ";
  }
  out_ += length + " += ";
  if (isSized(module_, callee)) {
    strings().sizedCall(callee, make.operands);
  } else {
    call(make.callee);
    out_ += ir::nativeName(module_, callee) + "(ctx";
    for (const ExprId operand : body_->list(make.operands)) {
      out_ += ", ";
      values().value(operand, Prec::Ternary);
    }
  }
  out_ += ", ";
  places().place(to);
  out_ += " + " + length + ", ";
  appendUnsigned(out_, capacityOf(expr(to).type));
  out_ += "u - " + length + ");";
}

void CallWriter::sliceCall(const ir::CallStmt& stmt) {
  strings().sliceName(stmt.result);
  out_ += " = ";
  strings().sizedCall(module_.body(stmt.callee), stmt.operands, "slice");
  out_ += ", ";
  appendUnsigned(out_, capacityOf(expr(stmt.result).type));
  out_ += ", &";
  strings().lengthName(stmt.result);
  out_ += ");";
}

void CallWriter::passArguments(const ir::CallStmt& stmt, const CallPlan& plan, CallText& text) {
  text.arguments = captured([&] {
    for (const CallPlan::Argument& argument : plan.arguments) {
      out_ += ", ";
      switch (argument.way) {
        case CallPlan::Way::Value: values().value(argument.operand, Prec::Ternary); break;
        case CallPlan::Way::Reference: places().reference(*argument.parameter, argument.operand); break;
        case CallPlan::Way::Copy: passCopy(argument, text); break;
      }
      if (passesLength(module_, module_.body(stmt.callee), *argument.parameter))
        passLength(stmt, argument.operand, text);
    }
  });
}

void CallWriter::passCopy(const CallPlan::Argument& argument, CallText& text) {
  const ir::Local& parameter = *argument.parameter;
  const TypeId type = expr(argument.operand).type;
  const bool is_input = parameter.kind == ir::LocalKind::Input;
  if (ir::isAggregate(types_, type)) {  // its bytes, which have any alignment in the image
    const std::string copy = newVariable(type, "v");
    const std::string place = captured([&] { places().imageAddress(argument.operand); });
    text.before += "memcpy(&" + copy + ", " + place + ", sizeof " + copy + "); ";
    if (!is_input) text.after += " memcpy(" + place + ", &" + copy + ", sizeof " + copy + ");";
    if (!isString(type)) out_ += '&';
    out_ += copy;
    return;
  }
  const std::string copy = newVariable(parameter.type, "v");
  text.before += copy + " = " + captured([&] { values().value(argument.operand, Prec::Ternary); }) + "; ";
  if (!is_input) text.after += ' ' + captured([&] { places().store(argument.operand, copy); }) + ';';
  out_ += '&' + copy;
}

// Through a variable: the length itself stays in a register. What is passed twice has no known length in either.
void CallWriter::passLength(const ir::CallStmt& stmt, ExprId operand, CallText& text) {
  const std::string name = newName("n");
  declarations_ += " uint32_t " + name + ';';
  out_ += ", &" + name;
  text.before += name + " = ";
  const uint32_t number = operand ? analysis_->uses.variables.stringAt(operand) : kNoVariable;
  if (number == kNoVariable || !isPassedOnce(&stmt, number)) {
    text.before += "RUNG_UNCOUNTED; ";
    return;
  }
  const std::string length = captured([&] { strings().lengthName(operand); });
  text.before += length + "; ";
  text.lengths += ' ' + length + " = " + name + ';';
}

void CallWriter::passResult(const ir::CallStmt& stmt, const CallPlan& plan, CallText& text) {
  const Body& callee = module_.body(stmt.callee);
  TypeId type = callee.result;
  if (plan.result == CallPlan::Result::InPlace) {
    text.result = captured([&] { places().place(stmt.result); });
    type = expr(stmt.result).type;
  } else if (plan.result == CallPlan::Result::Copied) {
    text.result = text.copy = newVariable(callee.result, "v");
  } else {
    return;
  }
  if (!isString(callee.result)) text.result.insert(0, "&");
  if (callee.native && isString(callee.result)) {
    text.result += ", ";
    appendUnsigned(text.result, capacityOf(type));
  }
  text.result.insert(0, ", ");
}

void CallWriter::callFunction(const ir::CallStmt& stmt, const CallPlan& plan, const CallText& text) {
  const Body& callee = module_.body(stmt.callee);
  if (plan.form == CallPlan::Form::Sized) {
    strings().sizedCall(callee, stmt.operands);
    out_ += text.result;
    out_ += ')';
    return;
  }
  if (callee.native) {
    out_ += ir::nativeName(module_, callee);
    out_ += "(ctx";
    if (stmt.self) {
      out_ += ", &";
      places().place(stmt.self);
    }
  } else {
    if (plan.form == CallPlan::Form::Virtual) {
      out_ += methodName(module_, stmt.callee, "table") + '[' + indexOfMethod(stmt) + ']';
    } else {
      appendFunctionName(out_, module_, callee);
    }
    out_ += '(';
    if (stmt.self) {
      if (isMethod(callee)) out_ += '&';
      places().place(stmt.self);
      out_ += ", ";
    }
    out_ += "ctx";
  }
  out_ += text.arguments;
  out_ += text.result;
  out_ += ')';
}

void CallWriter::copyResult(ExprId to, TypeId from, const CallText& text) {
  out_ += ' ';
  const TypeId type = expr(to).type;
  if (!isString(type)) {
    out_ += "memcpy(&";
    places().place(to);
    out_ += ", &" + text.copy + ", sizeof " + text.copy + ");";
    return;
  }
  const bool wide = isWide(type);
  if (!text.length.empty()) out_ += text.length + " = ";
  if (wide == isWide(from)) {
    out_ += wide ? "rung_wstring_assign(" : isUtf8(type) ? "rung_ustring_assign(" : "rung_string_assign(";
  } else {
    out_ += wide ? "rung_wstring_of_string(" : "rung_string_of_wstring(";
  }
  places().place(to);
  out_ += ", ";
  appendUnsigned(out_, capacityOf(type));
  out_ += ", " + text.copy + ");";
}

void CallWriter::callExpr(const Expr& e) {
  const auto [id, operands] = e.as<ir::CallExpr>();
  const Body& callee = module_.body(id);
  if (!isString(e.type) && lengths().isSizedCall(callee, operands, {})) {
    strings().sizedCall(callee, operands);
    out_ += ')';
    return;
  }
  call(id);
  if (callee.native) {
    out_ += ir::nativeName(module_, callee);
  } else {
    appendFunctionName(out_, module_, callee);
  }
  out_ += "(ctx";
  uint32_t i = 0;
  for (const ir::Local& parameter : ir::parameters(callee)) {
    if (i >= operands.count) break;
    const ExprId operand = body_->list(operands)[i++];
    out_ += ", ";
    if (parameter.by_reference) {
      places().reference(parameter, operand);
    } else {
      values().value(operand, Prec::Ternary);
    }
  }
  out_ += ')';
}

// ---- methods

void CallWriter::dispatch(const ir::CallStmt& stmt, Loc loc) {
  if (std::find(group_.virtuals.begin(), group_.virtuals.end(), stmt.callee) == group_.virtuals.end())
    group_.virtuals.push_back(stmt.callee);
  if (stmt.is_checked) classCheck(stmt, loc);
}

// The row of a dispatch table for the object's class.
std::string CallWriter::indexOfMethod(const ir::CallStmt& stmt) {
  return "rung_class_of(&" + captured([&] { places().place(stmt.self); }) + ") - " +
         methodName(module_, stmt.callee, "first");
}

// In front of a virtual call: a pointer bound by mistake has the number of no class, or of an unrelated one.
void CallWriter::classCheck(const ir::CallStmt& stmt, Loc loc) {
  const ir::BodyId method = stmt.callee;
  const std::string index = indexOfMethod(stmt);
  checks().beginCheck();
  out_ += index + " >= " + methodName(module_, method, "count") + " || " + methodName(module_, method, "table") + '[' +
          index + "] == nullptr";
  checks().endCheck(loc, types::Fault::Cast, "RUNG_NO_SUCH_METHOD");
}

}  // namespace rung::codegen

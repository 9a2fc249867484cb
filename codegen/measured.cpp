// SPDX-License-Identifier: Apache-2.0
// Measured strings and slices in C++: the declarations of their lengths and addresses, the counting, the sized forms of
// native functions. In: what lengths.h and slices.h decided. Out: C++. Called by body.cpp, statements.cpp, calls.cpp,
// expressions.cpp and strings.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
#include "codegen/signature.h"

namespace rung::codegen {

void StringWriter::declareLengths() {
  const Variables& variables = analysis_->uses.variables;
  for (uint32_t i = 0; i < variables.count(); ++i) {
    if (!analysis_->measured.has(i) || analysis_->appends.has(i)) continue;
    std::string name = captured([&] { lengthName(i); });
    name.pop_back();
    declarations_ += " uint32_t " + name + "n = ";
    declarations_ += returnsLength(i) ? '*' + name + "np" : analysis_->measured.isShared(i) ? "RUNG_UNCOUNTED" : "0";
    declarations_ += ';';
    if (analysis_->slices.has(i)) declarations_ += " const char* " + name + "v = nullptr;";
  }
  for (const ir::Local& local : body_->locals) {
    const uint32_t i = static_cast<uint32_t>(&local - body_->locals.data());
    if (!passesLength(module_, *body_, local) || analysis_->measured.has(i)) continue;
    declarations_ += " *";
    variable(declarations_, local);
    declarations_ += "np = RUNG_UNCOUNTED;";
  }
}

// At the exits: the caller gets the lengths of its strings.
void StringWriter::returnLengths() {
  for (uint32_t i = 0; i < body_->locals.size(); ++i) {
    if (!returnsLength(i)) continue;
    const std::string name = captured([&] { variable(out_, body_->locals[i]); });
    out_ += " *" + name + "np = " + name + "n;";
  }
}

// After a statement that may have changed shared strings: all but the one that it writes.
void StringWriter::forgetLengths(StmtId id) {
  if (!analysis_->lengths.forgetsAfter(id)) return;
  const Variables& variables = analysis_->uses.variables;
  const Stmt& stmt = body_->stmt(id);
  const auto* assign = stmt.tryAs<ir::AssignStmt>();
  const auto* call = stmt.tryAs<ir::CallStmt>();
  const ExprId place = assign != nullptr ? assign->place : call != nullptr ? call->result : ExprId{};
  const uint32_t written = place ? variables.stringAt(place) : kNoVariable;
  for (uint32_t i = 0; i < variables.count(); ++i) {
    if (!analysis_->measured.isShared(i) || i == written || isPassedOnce(call, i)) continue;
    out_ += ' ';
    lengthName(i);
    out_ += " = RUNG_UNCOUNTED;";
  }
}

// In front of a statement: counts the lengths that it needs; for a loop, all that its iterations need.
void StringWriter::countLengths(StmtId id) {
  const StmtId appended_by = analysis_->appends.find(id);
  if (appended_by == id) return;
  if (appended_by) id = appended_by;
  if (!analysis_->lengths.countsBefore(id)) return;
  for (const ExprId place_id : analysis_->lengths.counted[id.index]) {
    if (!lengths().isOwn(place_id)) {
      out_ += "if (";
      lengthName(place_id);
      out_ += " == RUNG_UNCOUNTED) ";
    }
    lengthName(place_id);
    out_ += " = rung_string_length(";
    places().place(place_id);
    out_ += "); ";
  }
}

void StringWriter::lengthName(ExprId id) { lengthName(analysis_->uses.variables.stringAt(id)); }

void StringWriter::lengthName(uint32_t number) {
  const Variables& variables = analysis_->uses.variables;
  if (variables.isField(number)) {
    appendMangled(out_, string(variables.field(number).name));
  } else {
    variable(out_, variables.local(number));
  }
  out_ += 'n';
}

void StringWriter::stringLength(ExprId id) {
  const Expr& e = expr(id);
  if (e.kind == ExprKind::String) {
    appendUnsigned(out_, literalLength(e));
  } else if (e.kind == ExprKind::Zero) {
    out_ += '0';
  } else if (isMeasured(id)) {
    lengthName(id);
  } else {
    out_ += "rung_string_length(";
    stringValue(id);
    out_ += ')';
  }
}

// Name and inputs of a sized form, without the closing parenthesis.
void StringWriter::sizedCall(const Body& callee, Slice<ExprId> operands, const char* form) {
  if (std::find(group_.libraries.begin(), group_.libraries.end(), callee.library_name) == group_.libraries.end())
    group_.libraries.push_back(callee.library_name);
  out_ += ir::nativeName(module_, callee);
  out_ += '_';
  out_ += form;
  out_ += '(';
  const char* separator = "";
  for (const ExprId operand : body_->list(operands)) {
    out_ += separator;
    separator = ", ";
    if (isString(expr(operand).type)) {
      stringValue(operand);
      out_ += ", ";
      stringLength(operand);
    } else {
      values().value(operand, Prec::Ternary);
    }
  }
}

void StringWriter::sliceName(ExprId id) {
  lengthName(id);
  out_.back() = 'v';
}

void StringWriter::assignSlice(ExprId to, ExprId from) {
  uint32_t capacity = capacityOf(expr(to).type);
  const ExprId whole = uncut(module_, *body_, from);
  for (ExprId cut = from; cut != whole; cut = expr(cut).as<ir::ConvertExpr>().operand)
    capacity = std::min(capacity, capacityOf(expr(cut).type));
  from = whole;
  sliceName(to);
  out_ += " = ";
  stringValue(from);
  out_ += "; ";
  lengthName(to);
  out_ += " = ";
  const Expr& source = expr(from);
  if (source.kind == ExprKind::String) {
    appendUnsigned(out_, std::min(literalLength(source), capacity));
  } else if (source.kind == ExprKind::Zero || capacityOf(source.type) <= capacity) {
    stringLength(from);
  } else {
    out_ += "rung_min_u32(";
    stringLength(from);
    out_ += ", ";
    appendUnsigned(out_, capacity);
    out_ += ')';
  }
  out_ += ';';
}

}  // namespace rung::codegen

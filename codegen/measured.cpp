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
    const std::string name = nameOf(i);
    const Ex length = returnsLength(i)                  ? tree_.prefix("*", tree_.name(name + "np"))
                      : analysis_->measured.isShared(i) ? tree_.fixed("RUNG_UNCOUNTED")
                                                        : tree_.number(0);
    declare("uint32_t", name + 'n', length);
    if (analysis_->slices.has(i)) declare(cxx::Type{"const char", "*", {}}, name + 'v', tree_.fixed("nullptr"));
  }
  for (const ir::Local& local : body_->locals) {
    const uint32_t i = static_cast<uint32_t>(&local - body_->locals.data());
    if (!passesLength(module_, *body_, local) || analysis_->measured.has(i)) continue;
    std::string name;
    variable(name, local);
    const Ex length = tree_.prefix("*", tree_.name(name + "np"));
    const Ex unknown = tree_.infix(Operator::Assign, length, tree_.fixed("RUNG_UNCOUNTED"));
    state_.declarations.add(tree_.stmt(cxx::StmtKind::Expression, unknown));
  }
}

// At the exits: the caller gets the lengths of its strings.
void StringWriter::returnLengths() {
  for (uint32_t i = 0; i < body_->locals.size(); ++i) {
    if (!returnsLength(i)) continue;
    assign(tree_.prefix("*", tree_.name(nameOf(i) + "np")), lengthName(i));
  }
}

// After a statement that may have changed shared strings: all but the one that it writes.
void StringWriter::forgetLengths(StmtId id) {
  if (!analysis_->lengths.forgetsAfter(id)) return;
  const Variables& variables = analysis_->uses.variables;
  const Stmt& stmt = body_->stmt(id);
  const auto* assignment = stmt.tryAs<ir::AssignStmt>();
  const auto* call = stmt.tryAs<ir::CallStmt>();
  const ExprId place = assignment != nullptr ? assignment->place : call != nullptr ? call->result : ExprId{};
  const uint32_t written = place ? variables.stringAt(place) : kNoVariable;
  for (uint32_t i = 0; i < variables.count(); ++i) {
    if (!analysis_->measured.isShared(i) || i == written || isPassedOnce(call, i)) continue;
    assign(lengthName(i), tree_.fixed("RUNG_UNCOUNTED"));
  }
}

// In front of a statement: counts the lengths that it needs; for a loop, all that its iterations need.
void StringWriter::countLengths(StmtId id) {
  const StmtId appended_by = analysis_->appends.find(id);
  if (appended_by == id) return;
  if (appended_by) id = appended_by;
  if (!analysis_->lengths.countsBefore(id)) return;
  for (const ExprId place_id : analysis_->lengths.counted[id.index]) {
    const Ex length = lengthName(place_id);
    const auto count = [&] { assign(length, tree_.call("rung_string_length", {places().place(place_id)})); };
    if (lengths().isOwn(place_id)) {
      count();
      continue;
    }
    cxx::Stmt* const once =
        tree_.stmt(cxx::StmtKind::ShortIf, tree_.infix(Operator::Equal, length, tree_.fixed("RUNG_UNCOUNTED")));
    add(once);
    once->first = nested(count).first();
  }
}

cxx::Ex StringWriter::lengthName(ExprId id) { return lengthName(analysis_->uses.variables.stringAt(id)); }
cxx::Ex StringWriter::lengthName(uint32_t number) { return tree_.name(nameOf(number) + 'n'); }

std::string StringWriter::nameOf(uint32_t number) const {
  const Variables& variables = analysis_->uses.variables;
  if (variables.isField(number)) return mangled(variables.field(number).name);
  std::string out;
  variable(out, variables.local(number));
  return out;
}

cxx::Ex StringWriter::stringLength(ExprId id) {
  const Expr& e = expr(id);
  if (e.kind == ExprKind::String) return tree_.number(literalLength(e));
  if (e.kind == ExprKind::Zero) return tree_.number(0);
  return isMeasured(id) ? lengthName(id) : tree_.call("rung_string_length", {stringValue(id)});
}

// Name and inputs of a sized form.
CallWriter::Parts StringWriter::sizedCall(const Body& callee, Slice<ExprId> operands, const char* form) {
  if (std::find(group_.libraries.begin(), group_.libraries.end(), callee.library_name) == group_.libraries.end())
    group_.libraries.push_back(callee.library_name);
  CallWriter::Parts call{ir::nativeName(module_, callee) + '_' + form, {}};
  for (const ExprId operand : body_->list(operands)) {
    if (isString(expr(operand).type)) {
      call.arguments.push_back(stringValue(operand));
      call.arguments.push_back(stringLength(operand));
    } else {
      call.arguments.push_back(values().value(operand));
    }
  }
  return call;
}

cxx::Ex StringWriter::sliceName(ExprId id) { return tree_.name(nameOf(analysis_->uses.variables.stringAt(id)) + 'v'); }

void StringWriter::assignSlice(ExprId to, ExprId from) {
  uint32_t capacity = capacityOf(expr(to).type);
  const ExprId whole = uncut(module_, *body_, from);
  for (ExprId cut = from; cut != whole; cut = expr(cut).as<ir::ConvertExpr>().operand)
    capacity = std::min(capacity, capacityOf(expr(cut).type));
  from = whole;
  assign(sliceName(to), stringValue(from));
  const Expr& source = expr(from);
  Ex length;
  if (source.kind == ExprKind::String) {
    length = tree_.number(std::min(literalLength(source), capacity));
  } else if (source.kind == ExprKind::Zero || capacityOf(source.type) <= capacity) {
    length = stringLength(from);
  } else {
    length = tree_.call("rung_min_u32", {stringLength(from), tree_.number(capacity)});
  }
  assign(lengthName(to), length);
}

}  // namespace rung::codegen

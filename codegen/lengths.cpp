// Lengths of strings in C++ locals. A string that nothing else can reach while the body runs (as in locals.cpp) and
// that sized functions use keeps its length beside it, so nothing counts its characters again: `s := CONCAT(s, c)`
// appends at the end, MID knows whether its position is inside. Every write of such a string sets its length. The
// length is counted before the first use in a block; a loop counts in front what it will need. Memory stays
// NUL-terminated after each statement.
// Sized functions are natives marked {sized}: their second form in rung/<library>.h takes the length after each string
// and returns the length of the result.
#include <algorithm>

#include "codegen/body.h"
#include "ir/walk.h"

namespace rung::codegen {

using ir::LocalKind;

namespace {

constexpr uint32_t kWorthCounting = 3;  // uses that justify counting the length
constexpr uint32_t kWorthKeeping = 2;   // the same where it is known from the first write

}  // namespace

bool BodyWriter::isSized(const Body& callee) const {
  const auto is_other = [&](TypeId type) { return isString(type) && types_.kind(type) != TypeKind::String; };
  if (!callee.sized || is_other(callee.result)) return false;
  for (const ir::Local& local : callee.locals) {
    if (is_other(local.type)) return false;
  }
  return true;
}

// `out` of a sized function must be one of its strings or overlap none: true when either side is measured.
bool BodyWriter::isSizedCall(const Body& callee, Slice<ExprId> operands, ExprId result) const {
  if (!isSized(callee)) return false;
  if (result && isString(expr(result).type)) {
    if (isWide(expr(result).type)) return false;
    if (measuredString(result) != nullptr) return true;
  }
  bool has_measured = false, all_apart = true;
  for (const ExprId operand : body_->list(operands)) {
    const Expr& e = expr(operand);
    if (!isString(e.type)) continue;
    const bool is_measured = measuredString(operand) != nullptr;
    has_measured = has_measured || is_measured;
    all_apart = all_apart && (is_measured || e.kind == ExprKind::String || e.kind == ExprKind::Zero);
  }
  return has_measured && (all_apart || !result || !isString(expr(result).type));
}

// ---- choosing the strings

BodyWriter::Variable* BodyWriter::stringVariable(ExprId place) {
  const Expr& e = expr(place);
  if (types_.kind(e.type) != TypeKind::String) return nullptr;
  if (const uint32_t* index = ir::localOf(e)) {
    const ir::Local& local = body_->locals[*index];
    // A by-reference result is a variable of the caller that only this call knows.
    const bool is_own = !local.by_reference || local.kind == LocalKind::Input || local.kind == LocalKind::Result;
    return is_own ? &locals_[*index] : nullptr;
  }
  return variableOf(slotOf(place));
}

const BodyWriter::Variable* BodyWriter::measuredString(ExprId place) const {
  const Variable* of = const_cast<BodyWriter*>(this)->stringVariable(place);
  return of != nullptr && of->measured ? of : nullptr;
}

void BodyWriter::noteSizedCall(const Body& callee, Slice<ExprId> operands, uint32_t weight) {
  if (!isSized(callee)) return;
  for (const ExprId operand : body_->list(operands)) {
    if (Variable* of = operand ? stringVariable(operand) : nullptr) of->sized_weight += weight;
  }
}

// An assignment passes the length on.
void BodyWriter::noteStringAssign(const ir::AssignStmt& stmt, uint32_t weight) {
  Variable* to = stringVariable(stmt.place);
  Variable* from = stringVariable(stmt.value);
  if (to == nullptr || from == nullptr) return;
  to->sized_weight += weight;
  from->sized_weight += weight;
}

// Called at the end of the analysis: `exposed` and the reach of the instance are known.
void BodyWriter::chooseMeasured() {
  if (has_try_ || body_->has_labels) return;
  for (uint32_t i = 0; i < locals_.size(); ++i) {
    const bool is_counted = body_->locals[i].kind == LocalKind::Input;
    locals_[i].measured =
        !locals_[i].exposed && locals_[i].sized_weight >= (is_counted ? kWorthCounting : kWorthKeeping);
  }
  const TypeId record = body_->self ? types_.resolve(body_->self) : TypeId{};
  for (uint32_t i = 0; i < fields_.size(); ++i) {
    Variable& of = fields_[i];
    if (of.sized_weight < kWorthCounting || of.exposed || facts_.isExposed(record, i)) continue;
    of.measured = !types_.info(record).fields[i].by_reference;
  }
}

void BodyWriter::declareLengths() {
  for (uint32_t i = 0; i < body_->locals.size(); ++i) {
    Variable& of = locals_[i];
    if (!of.measured) continue;
    declarations_ += " uint32_t ";
    variable(declarations_, body_->locals[i]);
    declarations_ += "n = 0;";
    if (of.slice) {
      declarations_ += " const char* ";
      variable(declarations_, body_->locals[i]);
      declarations_ += "v = nullptr;";
    }
    // All but inputs are written before they are read.
    of.known = body_->locals[i].kind != LocalKind::Input;
    has_measured_ = true;
  }
  for (uint32_t i = 0; i < fields_.size(); ++i) {
    if (!fields_[i].measured) continue;
    has_measured_ = true;
    declarations_ += " uint32_t ";
    const NameId name = types_.info(types_.resolve(body_->self)).fields[i].name;
    appendMangled(declarations_, string(name));
    declarations_ += "n = 0;";
    if (!fields_[i].slice) continue;
    fields_[i].known = true;
    declarations_ += " const char* ";
    appendMangled(declarations_, string(name));
    declarations_ += "v = nullptr;";
  }
}

// ---- where a length is known

bool BodyWriter::needsMeasuring(ExprId id) const {
  const Expr& e = expr(id);
  bool needs = false;
  const auto* call = e.tryAs<ir::CallExpr>();
  if (call != nullptr && isSizedCall(module_.body(call->callee), call->operands, {})) {
    for (const ExprId operand : body_->list(call->operands)) {
      const Variable* of = measuredString(operand);
      needs = needs || (of != nullptr && !of->known);
    }
  }
  ir::forEachOperand(*body_, e, [&](ExprId operand) { needs = needs || needsMeasuring(operand); });
  return needs;
}

void BodyWriter::setKnown(ExprId place) {
  Variable* of = stringVariable(place);
  if (of == nullptr || !of->measured || of->known) return;
  of->known = true;
  known_.push_back(of);
}

void BodyWriter::forgetLengths(size_t mark) {
  for (; known_.size() > mark; known_.pop_back()) known_.back()->known = false;
}

void BodyWriter::measureString(ExprId place) {
  const Variable* of = measuredString(place);
  if (of == nullptr || of->known) return;
  unknown_.push_back(place);
  setKnown(place);
}

void BodyWriter::measureExpr(ExprId id) {
  const Expr& e = expr(id);
  const auto* call = e.tryAs<ir::CallExpr>();
  if (call != nullptr && isSizedCall(module_.body(call->callee), call->operands, {})) {
    for (const ExprId operand : body_->list(call->operands)) measureString(operand);
  }
  ir::forEachOperand(*body_, e, [&](ExprId operand) { measureExpr(operand); });
}

// The lengths that the expressions of one statement need.
void BodyWriter::collectUnknown(const Stmt& stmt) {
  ir::forEachRoot(module_, *body_, stmt, [&](ExprId root, ir::Use) { measureExpr(root); });
  const auto* assign = stmt.tryAs<ir::AssignStmt>();
  if (assign != nullptr && measuredString(assign->place) != nullptr) measureString(assign->value);
  const auto* call = stmt.tryAs<ir::CallStmt>();
  if (call == nullptr || !isSizedCall(module_.body(call->callee), call->operands, call->result)) return;
  for (const ExprId operand : body_->list(call->operands)) measureString(operand);
}

// The lengths that a block needs before it starts, and those that it makes known itself.
void BodyWriter::collectUnknown(StmtId first) {
  const size_t mark = known_.size();
  for (StmtId id = first; id; id = body_->stmt(id).next) {
    const Stmt& stmt = body_->stmt(id);
    collectUnknown(stmt);
    ir::forEachBlock(*body_, stmt, [&](StmtId block) { collectUnknown(block); });
    if (const auto* assign = stmt.tryAs<ir::AssignStmt>()) setKnown(assign->place);
    if (const auto* call = stmt.tryAs<ir::CallStmt>(); call != nullptr && call->result) setKnown(call->result);
  }
  forgetLengths(mark);
}

// In front of a statement: counts the lengths that it needs; for a loop, all that its iterations need.
void BodyWriter::measure(const Stmt& stmt) {
  if (!has_measured_) return;
  unknown_.clear();
  collectUnknown(stmt);
  if (stmt.kind == StmtKind::Loop || stmt.kind == StmtKind::For) {
    const size_t mark = known_.size();
    ir::forEachBlock(*body_, stmt, [&](StmtId block) { collectUnknown(block); });
    forgetLengths(mark);
  }
  for (const ExprId id : unknown_) {
    lengthName(id);
    out_ += " = rung_string_length(";
    place(id);
    out_ += "); ";
    setKnown(id);
  }
}

// ---- writing

void BodyWriter::lengthName(ExprId id) {
  const Expr& e = expr(id);
  if (const uint32_t* index = ir::localOf(e)) {
    variable(out_, body_->locals[*index]);
  } else {
    appendMangled(out_, string(fieldOf(e.as<ir::FieldExpr>()).name));
  }
  out_ += 'n';
}

void BodyWriter::stringLength(ExprId id) {
  const Expr& e = expr(id);
  if (e.kind == ExprKind::String) {
    appendUnsigned(out_, literalLength(e));
  } else if (e.kind == ExprKind::Zero) {
    out_ += '0';
  } else if (measuredString(id) != nullptr) {
    lengthName(id);
  } else {
    out_ += "rung_string_length(";
    stringValue(id);
    out_ += ')';
  }
}

// Name and inputs of a sized form, without the closing parenthesis.
void BodyWriter::sizedCall(const Body& callee, Slice<ExprId> operands, const char* form) {
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
      value(operand, Prec::Ternary);
    }
  }
}

}  // namespace rung::codegen

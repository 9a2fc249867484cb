// Measured strings and slices in C++: the declarations of their lengths and addresses, the counting, the sized forms of
// native functions. In: what lengths.h and slices.h decided. Out: C++. Called by body.cpp, statements.cpp, calls.cpp,
// expressions.cpp and strings.cpp.
#include <algorithm>

#include "codegen/body_parts.h"

namespace rung::codegen {

void StringWriter::declareLengths() {
  const Variables& variables = analysis_->uses.variables;
  for (uint32_t i = 0; i < variables.count(); ++i) {
    if (!analysis_->measured.has(i) || analysis_->appends.has(i)) continue;
    std::string name;
    if (variables.isField(i)) {
      appendMangled(name, string(variables.field(i).name));
    } else {
      variable(name, variables.local(i));
    }
    declarations_ += " uint32_t " + name + "n = 0;";
    if (analysis_->slices.has(i)) declarations_ += " const char* " + name + "v = nullptr;";
  }
}

// In front of a statement: counts the lengths that it needs; for a loop, all that its iterations need.
void StringWriter::countLengths(StmtId id) {
  if (!analysis_->lengths.countsBefore(id)) return;
  for (const ExprId place_id : analysis_->lengths.counted[id.index]) {
    lengthName(place_id);
    out_ += " = rung_string_length(";
    places().place(place_id);
    out_ += "); ";
  }
}

void StringWriter::lengthName(ExprId id) {
  const Expr& e = expr(id);
  if (const uint32_t* index = ir::localOf(e)) {
    variable(out_, body_->locals[*index]);
  } else {
    appendMangled(out_, string(fieldOf(e.as<ir::FieldExpr>()).name));
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

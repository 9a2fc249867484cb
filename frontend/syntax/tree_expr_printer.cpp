// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/tree_expr_printer.h"

#include <charconv>

#include "frontend/source/quoting.h"

namespace rung {

static const char* word(ExprKind kind) {
  static const char* const kKeywords[] = {
#define RUNG_EXPR(kind, word, ...) word,
#include "frontend/syntax/nodes.def"
  };
  return kKeywords[static_cast<size_t>(kind)];
}
void TreeExprPrinter::quoted(std::string_view s) {
  out += '\'';
  for (const char c : s) appendInQuotes(out, c, '\'', isControl(c));
  out += '\'';
}

// The source of a range, after a blank; nothing for an empty one.
void TreeExprPrinter::source(Range range) {
  if (sources_ == nullptr || !(range.begin < range.end)) return;
  const FileId file = sources_->fileOf(range.begin);
  out += ' ';
  quoted(sources_->sourceText(file).substr(range.begin.offset - sources_->begin(file).offset,
                                           range.end.offset - range.begin.offset));
}

void TreeExprPrinter::address(const DirectAddress& a) {
  out += '%';
  if (a.area != '\0') out += a.area;  // none: relative to a structure
  if (a.size_given) out += a.size;
  if (a.incomplete) out += '*';
  bool first = true;
  for (uint32_t n : tree_.list(a.path)) {
    if (!first) out += '.';
    first = false;
    number(n);
  }
}

void TreeExprPrinter::literal(const LiteralExpr& e) {
  if (e.prefix) {
    name(e.prefix);
    out += '#';
  }
  const bool negative = e.form.is_negative;
  const auto nanoseconds = [&](const char* short_prefix, const char* long_prefix) {
    out += e.form.is_long ? long_prefix : short_prefix;
    if (negative)
      out += std::to_string(static_cast<int64_t>(e.value()));
    else
      number(e.value());
    out += "ns";
  };
  switch (e.literal()) {
    case LiteralKind::Bool: out += e.value() != 0 ? "TRUE" : "FALSE"; break;
    case LiteralKind::Integer:
      if (negative) out += '-';
      number(e.value());
      break;
    case LiteralKind::Real: {
      double value = 0;
      const uint64_t bits = e.value();
      std::memcpy(&value, &bits, sizeof value);
      char buffer[40];
      const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
      const std::string_view shown(buffer, static_cast<size_t>(end - buffer));
      out += shown;
      if (shown.find_first_of(".en") == std::string_view::npos) out += ".0";
      break;
    }
    case LiteralKind::String: quoted(tree_.string(e.string())); break;
    case LiteralKind::WString:
      out += 'w';
      quoted(tree_.string(e.string()));
      break;
    case LiteralKind::Duration: nanoseconds("t#", "lt#"); break;
    case LiteralKind::Date: nanoseconds("d#", "ld#"); break;
    case LiteralKind::TimeOfDay: nanoseconds("tod#", "ltod#"); break;
    case LiteralKind::DateTime: nanoseconds("dt#", "ldt#"); break;
    case LiteralKind::Null: out += "NULL"; break;
  }
}

void TreeExprPrinter::arguments(Slice<Argument> list, int depth) {
  for (const Argument& a : tree_.list(list)) {
    out += ' ';
    if (a.pin.name) {
      if (a.negated) out += "NOT ";
      name(a.pin.name);
      out += a.is_output ? " => " : " := ";
    }
    if (a.value)
      expr(a.value, depth + 1);
    else
      out += "open";
  }
}

void TreeExprPrinter::expr(ExprId id, int depth) {
  if (!id) {
    out += "none";
    return;
  }
  if (depth > 5000) {  // left-deep chains; the parser limits them
    out += "...";
    return;
  }
  out += '(';
  out += word(tree_.kind(id));
  out += ' ';
  // clang-format off
  switch (tree_.kind(id)) {
#define RUNG_EXPR(kind, word, ...) \
  case ExprKind::kind:                      \
    print(tree_.as<kind##Expr>(id), depth); \
    break;
#include "frontend/syntax/nodes.def"
  }
  // clang-format on
  out += ')';
}

void TreeExprPrinter::print(const ErrorExpr& e, int) {
  out.pop_back();
  source({e.h.loc, e.h.end});
}

void TreeExprPrinter::print(const LiteralExpr& e, int) { literal(e); }

void TreeExprPrinter::print(const NameExpr& e, int) {
  name(e.name);
  if (e.h.op == kGlobalName) out += " global";
}

void TreeExprPrinter::print(const TypedNameExpr& e, int) {
  name(e.type_name.name);
  out += '#';
  name(e.item.name);
}

void TreeExprPrinter::print(const MemberExpr& e, int depth) {
  expr(e.base, depth + 1);
  spaced(e.member);
}

void TreeExprPrinter::print(const IndexExpr& e, int depth) {
  expr(e.base, depth + 1);
  exprs(e.indices, depth);
}

void TreeExprPrinter::print(const DerefExpr& e, int depth) { expr(e.base, depth + 1); }

void TreeExprPrinter::print(const BitAccessExpr& e, int depth) {
  expr(e.base, depth + 1);
  out += e.width == 1 ? " bit " : e.width == 8 ? " byte " : e.width == 16 ? " word " : " dword ";
  number(e.position);
}

void TreeExprPrinter::print(const AddressExpr& e, int) { address(e.address); }

void TreeExprPrinter::print(const UnaryExpr& e, int depth) {
  out += spelling(e.op());
  spaced(e.operand, depth + 1);
}

void TreeExprPrinter::print(const BinaryExpr& e, int depth) {
  out += spelling(e.op());
  spaced(e.left, depth + 1);
  spaced(e.right, depth + 1);
}

void TreeExprPrinter::print(const CallExpr& e, int depth) {
  expr(e.callee, depth + 1);
  arguments(e.arguments, depth);
}

void TreeExprPrinter::print(const RangeExpr& e, int depth) {
  expr(e.low, depth + 1);
  spaced(e.high, depth + 1);
}

void TreeExprPrinter::print(const ArrayInitExpr& e, int depth) {
  out.pop_back();
  exprs(e.elements, depth);
}

void TreeExprPrinter::print(const RepeatExpr& e, int depth) {
  expr(e.count, depth + 1);
  exprs(e.elements, depth);
}

void TreeExprPrinter::print(const StructInitExpr& e, int depth) {
  out.pop_back();
  for (const FieldInit& f : tree_.list(e.fields)) {
    spaced(f.field.name);
    out += " := ";
    expr(f.value, depth + 1);
  }
}

void TreeExprPrinter::print(const ConvertExpr& e, int depth) { expr(e.operand, depth + 1); }

void TreeExprPrinter::print(const BoundExpr& e, int depth) { expr(e.array, depth + 1); }

void TreeExprPrinter::print(const AnyValueExpr& e, int depth) { expr(e.value, depth + 1); }

void TreeExprPrinter::print(const AssignExpr& e, int depth) {
  expr(e.target, depth + 1);
  expr(e.value, depth + 1);
}

void TreeExprPrinter::print(const NewExpr& e, int depth) {
  typeExpr(e.allocated, depth + 1);
  if (e.count) expr(e.count, depth + 1);
}

void TreeExprPrinter::print(const AddressOfExpr& e, int depth) { expr(e.lvalue, depth + 1); }

}  // namespace rung

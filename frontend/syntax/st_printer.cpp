// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/st_printer.h"

#include <algorithm>
#include <bit>
#include <charconv>

#include "frontend/source/calendar.h"
#include "frontend/source/files.h"
#include "frontend/source/invariant.h"
#include "frontend/source/quoting.h"
#include "frontend/source/text.h"

namespace rung {
namespace {

constexpr int kUnary = 9, kPrimary = 10;

int precedenceOf(BinaryOp op) {
  switch (op) {
    case BinaryOp::Or:
    case BinaryOp::OrElse: return 1;
    case BinaryOp::Xor: return 2;
    case BinaryOp::And:
    case BinaryOp::AndThen: return 3;
    case BinaryOp::Equal:
    case BinaryOp::NotEqual: return 4;
    case BinaryOp::Less:
    case BinaryOp::LessEqual:
    case BinaryOp::Greater:
    case BinaryOp::GreaterEqual: return 5;
    case BinaryOp::Add:
    case BinaryOp::Subtract: return 6;
    case BinaryOp::Multiply:
    case BinaryOp::Divide:
    case BinaryOp::Modulo: return 7;
    case BinaryOp::Power: return 8;
  }
  return 0;
}

// Where a chart comes from.
struct ChartSource {
  const Sources& sources;
  std::vector<Ident> members;  // sorted by location

  std::string_view textOf(Range range) const {
    const FileId file = sources.fileOf(range.begin);
    return sources.sourceText(file).substr(range.begin.offset - sources.begin(file).offset,
                                           range.end.offset - range.begin.offset);
  }
  NameId memberAt(Loc loc) const {
    const auto found = std::lower_bound(members.begin(), members.end(), loc,
                                        [](const Ident& member, Loc wanted) { return member.loc < wanted; });
    return found != members.end() && found->loc == loc ? found->name : NameId{};
  }
};

class StPrinter {
 public:
  StPrinter(const Tree& tree, const Names& names, std::span<const StComment> comments,
            const ChartSource* chart = nullptr)
      : tree_(tree), names_(names), comments_(comments), chart_(chart) {}
  std::string out;
  std::vector<ChartText::Line> lines;  // of a chart

  void stmts(Slice<StmtId> list, uint32_t indent) {
    for (const StmtId id : tree_.list(list)) stmt(id, indent);
  }
  void rest(uint32_t indent) { comments({~0u}, indent); }
  void expr(ExprId id, int least) {
    if (chart_ != nullptr)
      chartExpr(id, least);
    else
      node(id, least);
  }
  void variable(const VarDecl& d);

 private:
  void line(uint32_t indent) { out.append(indent, ' '); }
  void line(uint32_t indent, const char* text) {
    line(indent);
    out += text;
  }
  void section(uint32_t indent, const char* word, Slice<StmtId> body) {
    line(indent, word);
    stmts(body, indent + 2);
  }
  // The expression between two texts.
  void between(const char* before, ExprId id, const char* after) {
    out += before;
    expr(id, 0);
    out += after;
  }
  // Before each element of a list but the first.
  void comma(bool& first) {
    if (!first) out += ", ";
    first = false;
  }
  void name(NameId id) { out += names_.string(id); }
  void comments(Loc before, uint32_t indent);
  void stmt(StmtId id, uint32_t indent);
  void ifStmt(const IfStmt& s, uint32_t indent);
  void caseStmt(const CaseStmt& s, uint32_t indent);
  void loops(StmtId id, uint32_t indent);
  void node(ExprId id, int least);
  void chartExpr(ExprId id, int least);
  void quote(Range range);
  void operand(ExprId id, int least, bool always);
  void list(const char* before, Slice<ExprId> ids, const char* after);
  void arguments(Slice<Argument> arguments);
  void type(TypeExprId id);
  void newExpr(const NewExpr& e);
  void typedName(const TypedNameExpr& e);
  void bitAccess(const BitAccessExpr& e);
  void call(const CallExpr& e);
  void repeat(const RepeatExpr& e);
  void assignment(const AssignExpr& e);
  void unary(ExprId id, int least);
  void binary(ExprId id, int least);
  void structInit(const StructInitExpr& e);
  void literal(const LiteralExpr& e);
  void quoted(std::string_view s, char quote);
  void time(const LiteralExpr& e);
  void date(int64_t days);
  void clock(uint64_t ns);
  void padded(uint64_t n, int width);
  void address(const DirectAddress& a);

  const Tree& tree_;
  const Names& names_;
  std::span<const StComment> comments_;
  const ChartSource* chart_;
};

// ---- literals

void StPrinter::quoted(std::string_view s, char quote) {
  out += quote;
  size_t bad = std::min(findInvalidUtf8(s), s.size());
  for (size_t k = 0; k < s.size(); ++k) {
    const char c = s[k];
    const bool is_bad = k == bad;
    if (is_bad) bad = std::min(findInvalidUtf8(s.substr(k + 1)), s.size() - k - 1) + k + 1;
    appendInQuotes(out, c, quote, isControl(c) || is_bad, quote == '"');
  }
  out += quote;
}

void StPrinter::padded(uint64_t n, int width) {
  const std::string digits = std::to_string(n);
  for (int k = static_cast<int>(digits.size()); k < width; ++k) out += '0';
  out += digits;
}

void StPrinter::date(int64_t days) {
  const CalendarDate date = dateOfDays(days);
  padded(date.year, 4);
  out += '-';
  padded(date.month, 2);
  out += '-';
  padded(date.day, 2);
}

void StPrinter::clock(uint64_t ns) {
  const uint64_t seconds = ns / 1'000'000'000;
  padded(seconds / 3600, 2);
  out += ':';
  padded(seconds / 60 % 60, 2);
  out += ':';
  padded(seconds % 60, 2);
  uint64_t rest = ns % 1'000'000'000;
  if (rest == 0) return;
  int digits = 9;
  for (; rest % 10 == 0; rest /= 10) --digits;
  out += '.';
  padded(rest, digits);
}

void StPrinter::time(const LiteralExpr& e) {
  constexpr uint64_t kDay = 86'400'000'000'000;
  if (e.form.is_long) out += 'L';
  const uint64_t value = e.value();
  const auto days = [&] {  // until 2554, or before 1970
    if (!e.form.is_negative) return static_cast<int64_t>(value / kDay);
    return -static_cast<int64_t>((0 - value + kDay - 1) / kDay);
  };
  if (e.literal() == LiteralKind::Date) {
    out += "D#";
    return date(days());
  }
  if (e.literal() == LiteralKind::TimeOfDay) {
    out += "TOD#";
    return clock(value);
  }
  if (e.literal() == LiteralKind::DateTime) {
    out += "DT#";
    date(days());
    out += '-';
    return clock(value - static_cast<uint64_t>(days()) * kDay);
  }
  struct Unit {
    uint64_t ns;
    const char* name;
  };
  static constexpr Unit kUnits[] = {{86'400'000'000'000, "d"},
                                    {3'600'000'000'000, "h"},
                                    {60'000'000'000, "m"},
                                    {1'000'000'000, "s"},
                                    {1'000'000, "ms"},
                                    {1'000, "us"},
                                    {1, "ns"}};
  out += "T#";
  uint64_t rest = e.value();
  if (e.form.is_negative) {
    out += '-';
    rest = -rest;
  }
  if (rest == 0) out += "0s";
  for (const Unit& unit : kUnits) {
    if (rest < unit.ns) continue;
    out += std::to_string(rest / unit.ns) + unit.name;
    rest %= unit.ns;
  }
}

void StPrinter::literal(const LiteralExpr& e) {
  if (e.prefix) {
    name(e.prefix);
    out += '#';
  }
  switch (e.literal()) {
    case LiteralKind::Bool: out += e.value() != 0 ? "TRUE" : "FALSE"; return;
    case LiteralKind::Integer: {
      if (e.form.is_negative) out += '-';
      char digits[20];
      const bool based = e.form.is_based;
      const auto end = std::to_chars(digits, digits + sizeof digits, e.value(), based ? 16 : 10).ptr;
      if (based) out += "16#";
      for (const char* d = digits; d != end; ++d) out += upper(*d);
      return;
    }
    case LiteralKind::Real: {
      char digits[40];
      const auto end = std::to_chars(digits, digits + sizeof digits, std::bit_cast<double>(e.value())).ptr;
      const std::string_view shown(digits, static_cast<size_t>(end - digits));
      const size_t exponent = shown.find('e');
      out += shown.substr(0, exponent);
      if (shown.find('.') == std::string_view::npos) out += ".0";
      if (exponent != std::string_view::npos) out.append("E").append(shown.substr(exponent + 1));
      return;
    }
    case LiteralKind::String: return quoted(tree_.string(e.string()), '\'');
    case LiteralKind::WString: return quoted(tree_.string(e.string()), '"');
    case LiteralKind::Duration:
    case LiteralKind::Date:
    case LiteralKind::TimeOfDay:
    case LiteralKind::DateTime: return time(e);
    case LiteralKind::Null: out += "NULL"; return;
  }
}

void StPrinter::address(const DirectAddress& a) {
  out += '%';
  out += a.area;
  if (a.size_given) out += a.size;
  if (a.incomplete) out += '*';
  bool first = true;
  for (const uint32_t n : tree_.list(a.path)) {
    if (!first) out += '.';
    first = false;
    out += std::to_string(n);
  }
}

// ---- expressions

void StPrinter::list(const char* before, Slice<ExprId> ids, const char* after) {
  bool first = true;
  out += before;
  for (const ExprId id : tree_.list(ids)) {
    comma(first);
    expr(id, 0);
  }
  out += after;
}

void StPrinter::arguments(Slice<Argument> list) {
  out += '(';
  bool first = true;
  for (const Argument& a : tree_.list(list)) {
    comma(first);
    if (a.pin.name) {
      if (a.negated) out += "NOT ";
      name(a.pin.name);
      out += a.is_output ? " => " : " := ";
    }
    if (a.value) expr(a.value, 0);
  }
  out += ')';
}

// In parentheses where it binds less tightly than `least`, or always.
void StPrinter::operand(ExprId id, int least, bool always) {
  if (always) {
    between("(", id, ")");
  } else {
    expr(id, least);
  }
}

// The types that an expression may name: elementary types and those of the program, strings, pointers, arrays.
void StPrinter::type(TypeExprId id) {
  if (tree_.kind(id) == TypeExprKind::String) {
    const auto& type = tree_.as<StringTypeExpr>(id);
    out += spelling(type.code);
    if (type.length) operand(type.length, 0, true);
  } else if (tree_.kind(id) == TypeExprKind::Named) {
    const auto& type = tree_.as<NamedTypeExpr>(id);
    for (uint32_t i = 0; i < type.path.count; ++i) {
      if (i > 0) out += '.';
      name(tree_.list(type.path)[i].name);
    }
    if (type.has_arguments) arguments(type.arguments);
  } else if (tree_.kind(id) == TypeExprKind::Pointer) {
    const auto& pointer = tree_.as<PointerTypeExpr>(id);
    out += pointer.form == PointerForm::Pointer     ? "POINTER TO "
           : pointer.form == PointerForm::Reference ? "REFERENCE TO "
                                                    : "REF_TO ";
    type(pointer.target);
  } else if (tree_.kind(id) == TypeExprKind::Array) {
    const auto& array = tree_.as<ArrayTypeExpr>(id);
    out += "ARRAY[";
    bool first = true;
    for (const ArrayBound& bound : tree_.list(array.bounds)) {
      comma(first);
      between("", bound.low, "..");
      expr(bound.high, 0);
    }
    out += "] OF ";
    type(array.element);
  }
}

void StPrinter::newExpr(const NewExpr& e) {
  if (e.only_type) return type(e.allocated);
  out += "__NEW(";
  type(e.allocated);
  if (e.count) between(", ", e.count, "");
  out += ')';
}

// Always in parentheses, where it gives no warning.
void StPrinter::assignment(const AssignExpr& e) {
  between("(", e.target, " := ");
  between("", e.value, ")");
}

void StPrinter::unary(ExprId id, int least) {
  const auto& e = tree_.as<UnaryExpr>(id);
  if (least > kUnary) return operand(id, 0, true);
  out += spelling(e.op());
  if (e.op() == UnaryOp::Not) out += ' ';
  const ExprKind inner = tree_.kind(e.operand);
  const bool apart = chart_ == nullptr && (inner == ExprKind::Binary || inner == ExprKind::Unary);
  return operand(e.operand, kPrimary, apart);
}

void StPrinter::binary(ExprId id, int least) {
  const auto& e = tree_.as<BinaryExpr>(id);
  const int own = precedenceOf(e.op());
  if (own < least) return operand(id, 0, true);
  // Mixed comparisons, logic and powers are easier to read with parentheses.
  const auto apart = [&](ExprId side, bool right) {
    if (tree_.kind(side) == ExprKind::Unary) return e.op() == BinaryOp::Power || (right && own > 3);
    if (tree_.kind(side) != ExprKind::Binary || chart_ != nullptr) return false;
    const BinaryOp op = tree_.as<BinaryExpr>(side).op();
    return own <= 5 && op != e.op() && precedenceOf(op) <= 5;
  };
  operand(e.left, own, apart(e.left, false));
  out.append(" ").append(spelling(e.op())).append(" ");
  return operand(e.right, own + 1, apart(e.right, true));
}

void StPrinter::structInit(const StructInitExpr& e) {
  bool first = true;
  out += '(';
  for (const FieldInit& field : tree_.list(e.fields)) {
    comma(first);
    name(field.field.name);
    out += " := ";
    expr(field.value, 0);
  }
  out += ')';
}

// The source as it is, over several lines if need be.
void StPrinter::quote(Range range) {
  for (uint32_t at = range.begin.offset; const char c : chart_->textOf(range)) {
    out += c;
    ++at;
    if (c == '\n') lines.push_back({{at}, out.size()});
  }
}

// An expression of a chart: quoted if it is written there.
void StPrinter::chartExpr(ExprId id, int least) {
  const Range range = tree_.range(id), bare = tree_.bareRange(id);
  const bool is_quoted = bare.begin != bare.end;
  const bool binds_less =
      is_quoted && tree_.kind(id) == ExprKind::Binary && precedenceOf(tree_.as<BinaryExpr>(id).op()) < least;
  const bool parens = range == bare && (binds_less || tree_.expr(id).in_parens != 0);
  if (parens) out += '(';
  if (is_quoted)
    quote(range);
  else
    node(id, parens ? 0 : least);
  if (parens) out += ')';
}

void StPrinter::typedName(const TypedNameExpr& e) {
  name(e.type_name.name);
  out += '#';
  name(e.item.name);
}

void StPrinter::bitAccess(const BitAccessExpr& e) {
  expr(e.base, kPrimary);
  out += e.width == 8 ? ".%B" : e.width == 16 ? ".%W" : e.width == 32 ? ".%D" : ".";
  out += std::to_string(e.position);
}

void StPrinter::call(const CallExpr& e) {
  expr(e.callee, kPrimary);
  if (!e.is_bare) arguments(e.arguments);
}

void StPrinter::repeat(const RepeatExpr& e) {
  expr(e.count, kPrimary);
  list("(", e.elements, ")");
}

void StPrinter::node(ExprId id, int least) {
  switch (tree_.kind(id)) {
    case ExprKind::Literal: return literal(tree_.as<LiteralExpr>(id));
    case ExprKind::Name:
      if (tree_.expr(id).op == kGlobalName) out += '.';
      return name(tree_.as<NameExpr>(id).name);
    case ExprKind::TypedName: return typedName(tree_.as<TypedNameExpr>(id));
    case ExprKind::Member: {
      const auto& e = tree_.as<MemberExpr>(id);
      expr(e.base, kPrimary);
      out += '.';
      return name(e.member);
    }
    case ExprKind::Index: {
      const auto& e = tree_.as<IndexExpr>(id);
      expr(e.base, kPrimary);
      list("[", e.indices, "]");
      return;
    }
    case ExprKind::Deref:
      expr(tree_.as<DerefExpr>(id).base, kPrimary);
      out += '^';
      return;
    case ExprKind::This: out += "THIS"; return;
    case ExprKind::Super: out += "SUPER"; return;
    case ExprKind::BitAccess: return bitAccess(tree_.as<BitAccessExpr>(id));
    case ExprKind::Address: return address(tree_.as<AddressExpr>(id).address);
    case ExprKind::Unary: return unary(id, least);
    case ExprKind::Binary: return binary(id, least);
    case ExprKind::Call: return call(tree_.as<CallExpr>(id));
    case ExprKind::New: return newExpr(tree_.as<NewExpr>(id));
    case ExprKind::Assign: return assignment(tree_.as<AssignExpr>(id));
    case ExprKind::Range: {
      const auto& e = tree_.as<RangeExpr>(id);
      expr(e.low, 0);
      out += "..";
      return expr(e.high, 0);
    }
    case ExprKind::ArrayInit: list("[", tree_.as<ArrayInitExpr>(id).elements, "]"); return;
    case ExprKind::Repeat: return repeat(tree_.as<RepeatExpr>(id));
    case ExprKind::StructInit: return structInit(tree_.as<StructInitExpr>(id));
    case ExprKind::Error:
    case ExprKind::Convert:
    case ExprKind::Bound:
    case ExprKind::AnyValue:
    case ExprKind::AddressOf: break;
  }
  RUNG_INVARIANT(false, "statements are printed where they have no errors");
}

void StPrinter::variable(const VarDecl& d) {
  bool first = true;
  for (const Ident& ident : tree_.list(d.names)) {
    comma(first);
    name(ident.name);
  }
  out += " : ";
  type(d.type);
  if (d.init) between(" := ", d.init, "");
  out += ';';
}

// ---- statements

void StPrinter::comments(Loc before, uint32_t indent) {
  while (!comments_.empty() && comments_.front().at <= before) {
    line(indent);
    out += comments_.front().text;
    out += '\n';
    comments_ = comments_.subspan(1);
  }
}

void StPrinter::ifStmt(const IfStmt& s, uint32_t indent) {
  const std::span<const IfBranch> branches = tree_.list(s.branches);
  const Slice<StmtId> body = branches[0].body;
  const StmtKind first = body.empty() ? StmtKind::Empty : tree_.kind(tree_.list(body)[0]);
  const bool leaves = first == StmtKind::Jump || first == StmtKind::Call || first == StmtKind::Return;
  if (s.h.op == kConditionalOp && body.count == 1 && leaves && s.otherwise.empty()) {  // IF full THEN JMP done; END_IF
    between("IF ", branches[0].condition, " THEN ");
    stmt(tree_.list(body)[0], 0);
    out.back() = ' ';
    out += "END_IF\n";
    return;
  }
  for (size_t k = 0; k < branches.size(); ++k) {
    if (k > 0) line(indent);
    out += k == 0 ? "IF " : "ELSIF ";
    expr(branches[k].condition, 0);
    out += " THEN\n";
    stmts(branches[k].body, indent + 2);
  }
  if (!s.otherwise.empty()) section(indent, "ELSE\n", s.otherwise);
  line(indent, "END_IF\n");
}

void StPrinter::caseStmt(const CaseStmt& s, uint32_t indent) {
  between("CASE ", s.selector, " OF\n");
  for (const CaseBranch& branch : tree_.list(s.branches)) {
    line(indent + 2);
    list("", branch.labels, ":");
    if (const NameId member = chart_ != nullptr ? chart_->memberAt(tree_.loc(tree_.list(branch.labels)[0])) : NameId{})
      out.append("  // ").append(names_.string(member));
    out += '\n';
    stmts(branch.body, indent + 4);
  }
  if (s.has_else) section(indent + 2, "ELSE\n", s.otherwise);
  line(indent, "END_CASE\n");
}

void StPrinter::loops(StmtId id, uint32_t indent) {
  if (tree_.kind(id) == StmtKind::For) {
    const auto& s = tree_.as<ForStmt>(id);
    between("FOR ", s.control, " := ");
    expr(s.from, 0);
    out += " TO ";
    expr(s.to, 0);
    if (s.step) {
      out += " BY ";
      expr(s.step, 0);
    }
    out += " DO\n";
    stmts(s.body, indent + 2);
    line(indent, "END_FOR\n");
  } else if (tree_.kind(id) == StmtKind::While) {
    const auto& s = tree_.as<WhileStmt>(id);
    between("WHILE ", s.condition, " DO\n");
    stmts(s.body, indent + 2);
    line(indent, "END_WHILE\n");
  } else if (tree_.kind(id) == StmtKind::Repeat) {
    const auto& s = tree_.as<RepeatStmt>(id);
    out += "REPEAT\n";
    stmts(s.body, indent + 2);
    line(indent, "UNTIL ");
    expr(s.until, 0);
    out += '\n';
    line(indent, "END_REPEAT\n");
  } else {
    const auto& s = tree_.as<TryStmt>(id);
    out += "__TRY\n";
    stmts(s.body, indent + 2);
    if (s.catches) {
      line(indent, "__CATCH");
      if (s.code) {
        between("(", s.code, ")");
      }
      out += '\n';
      stmts(s.handler, indent + 2);
    }
    if (!s.finally.empty()) section(indent, "__FINALLY\n", s.finally);
    line(indent, "__ENDTRY\n");
  }
}

void StPrinter::stmt(StmtId id, uint32_t indent) {
  comments(tree_.loc(id), indent);
  if (chart_ != nullptr) lines.push_back({tree_.loc(id), out.size()});
  line(indent);
  switch (tree_.kind(id)) {
    case StmtKind::Error:
    case StmtKind::Empty: out += ";\n"; return;
    case StmtKind::Assign: {
      const auto& s = tree_.as<AssignStmt>(id);
      expr(s.target, 0);
      out.append(" ").append(spelling(s.op())).append(" ");
      expr(s.value, 0);
      out += ";\n";
      return;
    }
    case StmtKind::Call:
      expr(tree_.as<CallStmt>(id).call, 0);
      out += ";\n";
      return;
    case StmtKind::If: return ifStmt(tree_.as<IfStmt>(id), indent);
    case StmtKind::Case: return caseStmt(tree_.as<CaseStmt>(id), indent);
    case StmtKind::For:
    case StmtKind::While:
    case StmtKind::Repeat:
    case StmtKind::Try: return loops(id, indent);
    case StmtKind::Exit: out += "EXIT;\n"; return;
    case StmtKind::Continue: out += "CONTINUE;\n"; return;
    case StmtKind::Return: out += "RETURN;\n"; return;
    case StmtKind::Jump:
      out += "JMP ";
      name(tree_.as<JumpStmt>(id).label.name);
      out += ";\n";
      return;
    case StmtKind::Label:
      name(tree_.as<LabelStmt>(id).label.name);
      out += ":\n";
      return;
  }
}

}  // namespace

std::string printSt(const Tree& tree, const Names& names, Slice<StmtId> statements, uint32_t indent,
                    std::span<const StComment> comments) {
  StPrinter printer(tree, names, comments);
  printer.stmts(statements, indent);
  printer.rest(indent);
  return std::move(printer.out);
}

std::string printSt(const Tree& tree, const Names& names, ExprId expr) {
  StPrinter printer(tree, names, {});
  printer.expr(expr, 0);
  return std::move(printer.out);
}

std::string printSt(const Tree& tree, const Names& names, const VarDecl& variable) {
  StPrinter printer(tree, names, {});
  printer.variable(variable);
  return std::move(printer.out);
}

ChartText printChart(const Tree& tree, const Names& names, const Sources& sources, Slice<StmtId> statements,
                     std::span<const Ident> members) {
  ChartSource source{sources, {members.begin(), members.end()}};
  std::sort(source.members.begin(), source.members.end(), [](const Ident& a, const Ident& b) { return a.loc < b.loc; });
  StPrinter printer(tree, names, {}, &source);
  printer.stmts(statements, 0);
  return {std::move(printer.out), std::move(printer.lines)};
}

}  // namespace rung

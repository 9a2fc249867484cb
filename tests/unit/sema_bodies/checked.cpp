// SPDX-License-Identifier: Apache-2.0
// Checks programs and prints the checked tree: see checked.h.
#include "tests/unit/sema_bodies/checked.h"

#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"
#include "sema/types/arithmetic.h"

namespace rung::sema_test {

namespace {

constexpr char kLibrary[] = R"(
{operator 'add'} FUNCTION ADD : ANY_MAGNITUDE
VAR_INPUT IN1 : ANY_MAGNITUDE; {extensible} IN2 : ANY_MAGNITUDE; END_VAR END_FUNCTION
{operator 'mul'} FUNCTION MUL : ANY_NUM
VAR_INPUT IN1 : ANY_NUM; {extensible} IN2 : ANY_NUM; END_VAR END_FUNCTION
{operator 'div'} FUNCTION DIV : ANY_NUM
VAR_INPUT IN1 : ANY_NUM; IN2 : ANY_NUM; END_VAR END_FUNCTION
{operator 'max'} FUNCTION MAX : ANY_ELEMENTARY
VAR_INPUT IN1 : ANY_ELEMENTARY; {extensible} IN2 : ANY_ELEMENTARY; END_VAR END_FUNCTION
{operator 'gt'} FUNCTION GT : BOOL
VAR_INPUT IN1 : ANY_ELEMENTARY; {extensible} IN2 : ANY_ELEMENTARY; END_VAR END_FUNCTION
{operator 'abs'} FUNCTION ABS : ANY_NUM
VAR_INPUT IN : ANY_NUM; END_VAR END_FUNCTION
{operator 'shl'} FUNCTION SHL : ANY_BIT
VAR_INPUT IN : ANY_BIT; N : ANY_INT; END_VAR END_FUNCTION
{operator 'power'} FUNCTION EXPT : ANY_REAL
VAR_INPUT IN1 : ANY_REAL; IN2 : ANY_NUM; END_VAR END_FUNCTION
{operator 'select'} FUNCTION SEL : ANY
VAR_INPUT G : BOOL; IN0 : ANY; IN1 : ANY; END_VAR END_FUNCTION
{operator 'mux'} FUNCTION MUX : ANY
VAR_INPUT K : ANY_INT; IN0 : ANY; {extensible} IN1 : ANY; END_VAR END_FUNCTION
{operator 'move'} FUNCTION MOVE : ANY
VAR_INPUT IN : ANY; END_VAR END_FUNCTION
FUNCTION LIMIT : ANY_ELEMENTARY
VAR_INPUT MN : ANY_ELEMENTARY; IN : ANY_ELEMENTARY; MX : ANY_ELEMENTARY; END_VAR
LIMIT := MN;
END_FUNCTION
{native} FUNCTION SQRT : ANY_REAL
VAR_INPUT IN : ANY_REAL; END_VAR END_FUNCTION
{native} FUNCTION TRUNC : ANY_INT
VAR_INPUT IN : ANY_REAL; END_VAR END_FUNCTION
{native} FUNCTION CONCAT : ANY_STRING
VAR_INPUT IN1 : ANY_STRING; {extensible} IN2 : ANY_STRING; END_VAR END_FUNCTION
{native} FUNCTION LEN : INT
VAR_INPUT IN : ANY_STRING; END_VAR END_FUNCTION
{native} FUNCTION TO_STRING : STRING
VAR_INPUT IN : ANY_ELEMENTARY; END_VAR END_FUNCTION
{native} FUNCTION STRING_TO_INT : INT
VAR_INPUT IN : STRING; END_VAR END_FUNCTION
FUNCTION_BLOCK TON
VAR_INPUT IN : BOOL; PT : TIME; END_VAR
VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR
VAR start : TIME; END_VAR
Q := IN;
END_FUNCTION_BLOCK
)";
const sema::LibraryFile kFiles[] = {{"Standard", "standard.st", kLibrary}};

sema::Options optionsFor(Dialect dialect) {
  sema::Options options;
  options.dialect = dialect;
  options.libraries = kFiles;
  return options;
}

class Printer {
 public:
  explicit Printer(const Checked& checked) : c_(checked), tree_(checked.tree) {}
  std::string out;

  void statements(Slice<StmtId> list) {
    for (const StmtId id : tree_.list(list)) statement(id);
  }

 private:
  void statement(StmtId id) {
    if (tree_.kind(id) == StmtKind::Assign) {
      const AssignStmt& node = tree_.as<AssignStmt>(id);
      const char* ops[] = {":=", "S=", "R=", "REF=", "+=", "-=", "*=", "/="};
      expr(node.target);
      out.append(" ").append(ops[node.h.op]).append(" ");
      expr(node.value);
    } else if (tree_.kind(id) == StmtKind::Call) {
      expr(tree_.as<CallStmt>(id).call);
    } else if (tree_.kind(id) == StmtKind::If) {
      out += "IF ";
      expr(tree_.list(tree_.as<IfStmt>(id).branches)[0].condition);
    } else {
      out += "...";
    }
    out += ";\n";
  }

  void list(Slice<ExprId> items) {
    for (uint32_t i = 0; i < items.count; ++i) {
      if (i > 0) out += ", ";
      expr(tree_.list(items)[i]);
    }
  }

  void literal(const LiteralExpr& node) {
    const std::string type = c_.project.types.toString(sema::meaning(node.h).type);
    if (node.literal() == LiteralKind::String || node.literal() == LiteralKind::WString) {
      out.append("'").append(tree_.string(node.string())).append("'");
      return;
    }
    out.append(type).append("#");
    if (node.form.is_negative) out += "-";
    if (node.literal() == LiteralKind::Real) {
      types::Value value{types::kLReal, node.value()};
      out += types::toString(c_.project.types, c_.names, value);
    } else {
      out += std::to_string(node.value());
    }
  }

  void call(const CallExpr& node) {
    if (!sema::meaning(node.h).call) {
      out += "unresolved";
      return;
    }
    const sema::Call& call = c_.project.call(sema::meaning(node.h).call);
    switch (call.kind) {
      case sema::CallKind::Method:
      case sema::CallKind::Instance: expr(call.instance); break;
      case sema::CallKind::Delete: expr(call.instance); break;
      case sema::CallKind::Assertion: out += "ASSERT"; break;
      case sema::CallKind::Attempt: out += "?="; break;
      case sema::CallKind::Function:
      case sema::CallKind::Program:
      case sema::CallKind::Operator:
        if (call.kind == sema::CallKind::Operator) out += "op:";
        out += c_.names.string(c_.project.pou(call.pou).unique_name);
        break;
    }
    out += "(";
    bool first = true;
    const auto comma = [&] {
      if (!first) out += ", ";
      first = false;
    };
    if (call.en) {
      comma();
      out += "EN:=";
      expr(call.en);
    }
    for (const sema::Binding& binding : call.bindings) {
      comma();
      if (binding.negated) out += "NOT ";
      if (binding.pin)
        out.append(c_.names.string(c_.project.var(binding.pin).name)).append(binding.is_output ? "=>" : ":=");
      if (binding.value) expr(binding.value);
    }
    if (call.eno) {
      comma();
      out += "ENO=>";
      expr(call.eno);
    }
    out += ")";
  }

  void expr(ExprId id) {
    if (!sema::typeOf(tree_, id) && tree_.kind(id) != ExprKind::Call) out += "?";
    switch (tree_.kind(id)) {
      case ExprKind::Literal: literal(tree_.as<LiteralExpr>(id)); return;
      case ExprKind::Name: out += c_.names.string(tree_.as<NameExpr>(id).name); return;
      case ExprKind::TypedName: out += c_.names.string(tree_.as<TypedNameExpr>(id).item.name); return;
      case ExprKind::Member: {
        const MemberExpr& node = tree_.as<MemberExpr>(id);
        expr(node.base);
        out.append(".").append(c_.names.string(node.member));
        return;
      }
      case ExprKind::Index:
        expr(tree_.as<IndexExpr>(id).base);
        out += "[";
        list(tree_.as<IndexExpr>(id).indices);
        out += "]";
        return;
      case ExprKind::Deref:
        expr(tree_.as<DerefExpr>(id).base);
        out += "^";
        return;
      case ExprKind::BitAccess:
        expr(tree_.as<BitAccessExpr>(id).base);
        out += "." + std::to_string(tree_.as<BitAccessExpr>(id).position);
        return;
      case ExprKind::Unary:
        out.append(spelling(tree_.as<UnaryExpr>(id).op())).append(" ");
        expr(tree_.as<UnaryExpr>(id).operand);
        return;
      case ExprKind::Assign:
        out += "(";
        expr(tree_.as<AssignExpr>(id).target);
        out += " := ";
        expr(tree_.as<AssignExpr>(id).value);
        out += ")";
        return;
      case ExprKind::Binary: {
        const BinaryExpr& node = tree_.as<BinaryExpr>(id);
        out += "(";
        expr(node.left);
        out.append(" ").append(spelling(node.op())).append(" ");
        expr(node.right);
        out += ")";
        return;
      }
      case ExprKind::Call: call(tree_.as<CallExpr>(id)); return;
      case ExprKind::Convert:
        out.append(c_.project.types.toString(sema::typeOf(tree_, id))).append("(");
        expr(tree_.as<ConvertExpr>(id).operand);
        out += ")";
        return;
      case ExprKind::AddressOf:
        out += "&";
        expr(tree_.as<AddressOfExpr>(id).lvalue);
        return;
      case ExprKind::This: out += "THIS"; return;
      case ExprKind::Super: out += "SUPER"; return;
      case ExprKind::Error:
      case ExprKind::Bound:
      case ExprKind::New:
      case ExprKind::AnyValue:
      case ExprKind::Address:
      case ExprKind::Range:
      case ExprKind::ArrayInit:
      case ExprKind::Repeat:
      case ExprKind::StructInit: out += "?"; return;
    }
  }

  const Checked& c_;
  const Tree& tree_;
};

std::string programOf(const std::string& vars, const std::string& statements) {
  return "PROGRAM Main VAR " + vars + " END_VAR\n" + statements + "\nEND_PROGRAM\n";
}

}  // namespace

Checked::Checked(const std::string& source, Dialect dialect)
    : project(sources, names, diagnostics, tree, optionsFor(dialect)) {
  const FileId file = sources.add("test.st", source);
  text::parseFile(tree, names, sources, file, dialect, diagnostics);
  sema::check(project);
  diagnostics.sort();
}

std::string Checked::codes() const {
  std::string out;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    const SourceLocation location = sources.location(diagnostic.loc);
    out += std::to_string(location.line) + ":" + std::to_string(location.column) + " " +
           diagInfo(diagnostic.diag).code + "\n";
  }
  return out;
}

std::string Checked::messages() const {
  std::string out;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    const SourceLocation location = sources.location(diagnostic.loc);
    out += std::to_string(location.line) + ":" + std::to_string(location.column) + " " + diagnostic.message + "\n";
    for (const auto& note : diagnostic.notes) out += "  " + note.message + "\n";
  }
  return out;
}

std::string Checked::body(const std::string& pou) const {
  Printer printer(*this);
  for (const sema::Pou& checked : project.pous)
    if (!checked.library && checked.name && names.string(checked.name) == pou) printer.statements(checked.body.code);
  return printer.out;
}

std::string codesOf(const std::string& vars, const std::string& statements, Dialect dialect) {
  const Checked checked(programOf(vars, statements), dialect);
  std::string out;
  for (const Diagnostic& diagnostic : checked.diagnostics.all()) {
    if (std::string_view(diagInfo(diagnostic.diag).code) == "W0758") continue;  // unused: the tests are short
    const SourceLocation location = checked.sources.location(diagnostic.loc);
    if (!out.empty()) out += ", ";
    out += std::to_string(location.line - 1) + ":" + std::to_string(location.column) + " " +
           diagInfo(diagnostic.diag).code;
  }
  return out;
}

std::string treeOf(const std::string& vars, const std::string& statements, Dialect dialect) {
  const Checked checked(programOf(vars, statements), dialect);
  if (checked.diagnostics.hasErrors()) return checked.messages();
  return checked.body("Main");
}

}  // namespace rung::sema_test

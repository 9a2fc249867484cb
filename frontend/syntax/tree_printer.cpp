// The tree as text: a line per declaration, statement and type; expressions in parentheses on the line of their
// statement.
#include <charconv>
#include <string>

#include "frontend/syntax/diagram.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/sfc.h"
#include "frontend/syntax/tree.h"

namespace rung {
namespace {

const char* word(ExprKind kind) {
  static const char* const kKeywords[] = {
#define RUNG_EXPR(kind, word) word,
#include "frontend/syntax/nodes.def"
  };
  return kKeywords[static_cast<size_t>(kind)];
}
const char* word(StmtKind kind) {
  static const char* const kKeywords[] = {
#define RUNG_STMT(kind, word) word,
#include "frontend/syntax/nodes.def"
  };
  return kKeywords[static_cast<size_t>(kind)];
}
const char* word(TypeExprKind kind) {
  static const char* const kKeywords[] = {
#define RUNG_TYPE_EXPR(kind, word) word,
#include "frontend/syntax/nodes.def"
  };
  return kKeywords[static_cast<size_t>(kind)];
}
const char* word(DeclKind kind) {
  static const char* const kKeywords[] = {
#define RUNG_DECL(kind, word) word,
#include "frontend/syntax/nodes.def"
  };
  return kKeywords[static_cast<size_t>(kind)];
}

class Printer {
 public:
  Printer(const Tree& tree, const Names& names) : tree_(tree), names_(names) {}
  std::string out;

  void decl(DeclId id, int depth);

 private:
  void line(int depth) {
    if (!out.empty()) out += '\n';
    out.append(static_cast<size_t>(depth) * 2, ' ');
  }
  void name(NameId id) { out += names_.string(id); }
  void number(uint64_t n) { out += std::to_string(n); }
  void quoted(std::string_view s);
  void path(Slice<Ident> idents, const char* between) {
    bool first = true;
    for (const Ident& ident : tree_.list(idents)) {
      if (!first) out += between;
      first = false;
      name(ident.name);
    }
  }
  void pragmas(const DeclHeader& h);
  void modifiers(AccessLevel access, uint8_t bits);
  void typeList(const char* what, Slice<TypeExprId> list, int depth);
  void address(const DirectAddress& a);
  void literal(const LiteralExpr& e);
  void expr(ExprId id, int depth = 0);
  void exprs(Slice<ExprId> list, int depth) {
    for (ExprId e : tree_.list(list)) {
      out += ' ';
      expr(e, depth + 1);
    }
  }
  void arguments(Slice<Argument> list, int depth);
  void stmts(Slice<StmtId> list, int depth) {
    for (StmtId s : tree_.list(list)) stmt(s, depth);
  }
  void stmt(StmtId id, int depth);
  void instructions(Slice<IlInstruction> list, int depth);
  void element(const Diagram& diagram, const DiagramElement& e, int depth);
  template <class Modifiable>
  void modifiers(const Modifiable& element);
  void chart(const PouDecl& d, int depth);
  void idents(const char* before, Slice<Ident> list);
  void typeExpr(TypeExprId id, int depth);

  const Tree& tree_;
  const Names& names_;
};

void Printer::quoted(std::string_view s) {
  static const char* const kHex = "0123456789ABCDEF";
  out += '\'';
  for (char c : s) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\'' || c == '$') {
      out += '$';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      out += '$';
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  out += '\'';
}

void Printer::modifiers(AccessLevel access, uint8_t bits) {
  static const char* const kAccess[] = {"", " public", " private", " protected", " internal"};
  out += kAccess[static_cast<size_t>(access)];
  if ((bits & kAbstract) != 0) out += " abstract";
  if ((bits & kFinal) != 0) out += " final";
  if ((bits & kOverride) != 0) out += " override";
}

void Printer::typeList(const char* what, Slice<TypeExprId> list, int depth) {
  if (list.empty()) return;
  line(depth + 1);
  out += what;
  for (TypeExprId type : tree_.list(list)) typeExpr(type, depth + 2);
}

void Printer::pragmas(const DeclHeader& h) {
  for (const Pragma& p : tree_.list(h.pragmas)) {
    out += " {";
    name(p.name);
    if (p.value.length > 0) {
      out += ' ';
      quoted(tree_.string(p.value));
    }
    out += '}';
  }
}

void Printer::address(const DirectAddress& a) {
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

void Printer::literal(const LiteralExpr& e) {
  if (e.prefix) {
    name(e.prefix);
    out += '#';
  }
  const bool negative = (e.h.bits & kLiteralNegative) != 0;
  const auto nanoseconds = [&](const char* short_prefix, const char* long_prefix) {
    out += (e.h.bits & kLiteralLong) != 0 ? long_prefix : short_prefix;
    if (e.literal() == LiteralKind::Duration && !negative)
      number(e.value());
    else
      out += std::to_string(static_cast<int64_t>(e.value()));
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

void Printer::arguments(Slice<Argument> list, int depth) {
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

void Printer::expr(ExprId id, int depth) {
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
  switch (tree_.kind(id)) {
    case ExprKind::Error: out.pop_back(); break;
    case ExprKind::Literal: literal(tree_.as<LiteralExpr>(id)); break;
    case ExprKind::Name: name(tree_.as<NameExpr>(id).name); break;
    case ExprKind::TypedName:
      name(tree_.as<TypedNameExpr>(id).type_name.name);
      out += '#';
      name(tree_.as<TypedNameExpr>(id).item.name);
      break;
    case ExprKind::Member:
      expr(tree_.as<MemberExpr>(id).base, depth + 1);
      out += ' ';
      name(tree_.as<MemberExpr>(id).member);
      break;
    case ExprKind::Index:
      expr(tree_.as<IndexExpr>(id).base, depth + 1);
      exprs(tree_.as<IndexExpr>(id).indices, depth);
      break;
    case ExprKind::This:
    case ExprKind::Super: break;
    case ExprKind::Deref: expr(tree_.as<DerefExpr>(id).base, depth + 1); break;
    case ExprKind::BitAccess: {
      const auto& e = tree_.as<BitAccessExpr>(id);
      expr(e.base, depth + 1);
      out += e.width == 1 ? " bit " : e.width == 8 ? " byte " : e.width == 16 ? " word " : " dword ";
      number(e.position);
      break;
    }
    case ExprKind::Address: address(tree_.as<AddressExpr>(id).address); break;
    case ExprKind::Unary:
      out += spelling(tree_.as<UnaryExpr>(id).op());
      out += ' ';
      expr(tree_.as<UnaryExpr>(id).operand, depth + 1);
      break;
    case ExprKind::Binary:
      out += spelling(tree_.as<BinaryExpr>(id).op());
      out += ' ';
      expr(tree_.as<BinaryExpr>(id).left, depth + 1);
      out += ' ';
      expr(tree_.as<BinaryExpr>(id).right, depth + 1);
      break;
    case ExprKind::Call:
      expr(tree_.as<CallExpr>(id).callee, depth + 1);
      arguments(tree_.as<CallExpr>(id).arguments, depth);
      break;
    case ExprKind::Range:
      expr(tree_.as<RangeExpr>(id).low, depth + 1);
      out += ' ';
      expr(tree_.as<RangeExpr>(id).high, depth + 1);
      break;
    case ExprKind::ArrayInit:
      out.pop_back();
      exprs(tree_.as<ArrayInitExpr>(id).elements, depth);
      break;
    case ExprKind::Repeat:
      expr(tree_.as<RepeatExpr>(id).count, depth + 1);
      exprs(tree_.as<RepeatExpr>(id).elements, depth);
      break;
    case ExprKind::StructInit:
      out.pop_back();
      for (const FieldInit& f : tree_.list(tree_.as<StructInitExpr>(id).fields)) {
        out += ' ';
        name(f.field.name);
        out += " := ";
        expr(f.value, depth + 1);
      }
      break;
    case ExprKind::Convert: expr(tree_.as<ConvertExpr>(id).operand, depth + 1); break;
    case ExprKind::Bound: expr(tree_.as<BoundExpr>(id).array, depth + 1); break;
    case ExprKind::AnyValue: expr(tree_.as<AnyValueExpr>(id).value, depth + 1); break;
    case ExprKind::New:
      typeExpr(tree_.as<NewExpr>(id).allocated, depth + 1);
      if (tree_.as<NewExpr>(id).count) expr(tree_.as<NewExpr>(id).count, depth + 1);
      break;
    case ExprKind::AddressOf: expr(tree_.as<AddressOfExpr>(id).lvalue, depth + 1); break;
  }
  out += ')';
}

void Printer::stmt(StmtId id, int depth) {
  line(depth);
  out += word(tree_.kind(id));
  const auto block = [&](const char* label, Slice<StmtId> list) {
    line(depth + 1);
    out += label;
    stmts(list, depth + 2);
  };
  switch (tree_.kind(id)) {
    case StmtKind::Error:
    case StmtKind::Empty:
    case StmtKind::Exit:
    case StmtKind::Continue:
    case StmtKind::Return: break;
    case StmtKind::Assign: {
      const auto& s = tree_.as<AssignStmt>(id);
      out += ' ';
      out += spelling(s.op());
      out += ' ';
      expr(s.target);
      out += ' ';
      expr(s.value);
      break;
    }
    case StmtKind::Call:
      out += ' ';
      expr(tree_.as<CallStmt>(id).call);
      break;
    case StmtKind::If: {
      const auto& s = tree_.as<IfStmt>(id);
      for (const IfBranch& b : tree_.list(s.branches)) {
        line(depth + 1);
        out += "then ";
        expr(b.condition);
        stmts(b.body, depth + 2);
      }
      if (!s.otherwise.empty()) block("else", s.otherwise);
      break;
    }
    case StmtKind::Case: {
      const auto& s = tree_.as<CaseStmt>(id);
      out += ' ';
      expr(s.selector);
      for (const CaseBranch& b : tree_.list(s.branches)) {
        line(depth + 1);
        out += "of";
        exprs(b.labels, 0);
        stmts(b.body, depth + 2);
      }
      if (s.has_else) block("else", s.otherwise);
      break;
    }
    case StmtKind::For: {
      const auto& s = tree_.as<ForStmt>(id);
      out += ' ';
      expr(s.control);
      out += ' ';
      expr(s.from);
      out += ' ';
      expr(s.to);
      if (s.step) {
        out += " by ";
        expr(s.step);
      }
      stmts(s.body, depth + 1);
      break;
    }
    case StmtKind::While:
      out += ' ';
      expr(tree_.as<WhileStmt>(id).condition);
      stmts(tree_.as<WhileStmt>(id).body, depth + 1);
      break;
    case StmtKind::Repeat:
      out += " until ";
      expr(tree_.as<RepeatStmt>(id).until);
      stmts(tree_.as<RepeatStmt>(id).body, depth + 1);
      break;
    case StmtKind::Try: {
      const TryStmt& s = tree_.as<TryStmt>(id);
      stmts(s.body, depth + 1);
      if (s.catches) {
        line(depth + 1);
        out += "catch";
        if (s.code) {
          out += ' ';
          expr(s.code);
        }
        stmts(s.handler, depth + 2);
      }
      if (!s.finally.empty()) {
        line(depth + 1);
        out += "finally";
        stmts(s.finally, depth + 2);
      }
      break;
    }
    case StmtKind::Jump:
      out += ' ';
      name(tree_.as<JumpStmt>(id).label.name);
      break;
    case StmtKind::Label:
      out += ' ';
      name(tree_.as<LabelStmt>(id).label.name);
      break;
  }
}

// One line each: the label, the operator as written, `(` where it is deferred, its operands.
void Printer::instructions(Slice<IlInstruction> list, int depth) {
  for (const IlInstruction& i : tree_.list(list)) {
    line(depth);
    if (i.label.name) {
      name(i.label.name);
      out += i.kind == IlKind::Label ? ":" : ": ";
    }
    if (i.kind == IlKind::Label) continue;
    if (i.kind == IlKind::Close) {
      out += ')';
      continue;
    }
    name(i.word);
    if ((i.flags & kIlDeferred) != 0) out += '(';
    if (i.target.name) {
      out += ' ';
      name(i.target.name);
    }
    if (i.callee) {
      out += ' ';
      expr(i.callee);
    }
    arguments(i.operands, 0);
    for (const IlNested& nested : tree_.list(i.nested)) {
      line(depth + 1);
      out += "operand ";
      number(nested.operand);
      instructions(nested.list, depth + 2);
    }
  }
}

void Printer::typeExpr(TypeExprId id, int depth) {
  if (!id) return;
  line(depth);
  out += word(tree_.kind(id));
  switch (tree_.kind(id)) {
    case TypeExprKind::Error: break;
    case TypeExprKind::Named:
      out += ' ';
      path(tree_.as<NamedTypeExpr>(id).path, ".");
      if (tree_.as<NamedTypeExpr>(id).has_arguments) arguments(tree_.as<NamedTypeExpr>(id).arguments, 0);
      for (ExprId element : tree_.list(tree_.as<NamedTypeExpr>(id).elements))
        arguments(tree_.as<CallExpr>(element).arguments, 0);
      break;
    case TypeExprKind::String: {
      const auto& t = tree_.as<StringTypeExpr>(id);
      out += ' ';
      out += spelling(t.code);
      if (t.length) {
        out += ' ';
        expr(t.length);
      }
      break;
    }
    case TypeExprKind::Subrange: {
      const auto& t = tree_.as<SubrangeTypeExpr>(id);
      out += ' ';
      expr(t.low);
      out += ' ';
      expr(t.high);
      typeExpr(t.base, depth + 1);
      break;
    }
    case TypeExprKind::Enum: {
      const auto& t = tree_.as<EnumTypeExpr>(id);
      for (const EnumItem& item : tree_.list(t.items)) {
        line(depth + 1);
        out += "item ";
        name(item.item.name);
        if (item.value) {
          out += ' ';
          expr(item.value);
        }
      }
      typeExpr(t.base, depth + 1);
      break;
    }
    case TypeExprKind::Array: {
      const auto& t = tree_.as<ArrayTypeExpr>(id);
      for (const ArrayBound& b : tree_.list(t.bounds)) {
        out += " [";
        if (b.low) {
          expr(b.low);
          out += ' ';
          expr(b.high);
        } else {
          out += '*';
        }
        out += ']';
      }
      typeExpr(t.element, depth + 1);
      break;
    }
    case TypeExprKind::Struct: {
      const auto& t = tree_.as<StructTypeExpr>(id);
      if (t.is_union) out += " union";
      if (t.overlaps) out += " overlap";
      if (t.base) {
        line(depth + 1);
        out += "extends";
        typeExpr(t.base, depth + 2);
      }
      for (DeclId d : tree_.list(t.fields)) decl(d, depth + 1);
      break;
    }
    case TypeExprKind::Pointer: {
      const auto& t = tree_.as<PointerTypeExpr>(id);
      out += t.form == PointerForm::Pointer ? " pointer" : t.form == PointerForm::Reference ? " reference" : " ref_to";
      typeExpr(t.target, depth + 1);
      break;
    }
  }
}

void Printer::decl(DeclId id, int depth) {
  line(depth);
  out += word(tree_.kind(id));
  const DeclHeader& h = tree_.decl(id);
  const auto bits = [&](uint8_t b) {
    if ((b & kConstant) != 0) out += " constant";
    if ((b & kRetain) != 0) out += " retain";
    if ((b & kPersistent) != 0) out += " persistent";
    if ((b & kNonRetain) != 0) out += " non_retain";
  };
  switch (h.kind) {
    case DeclKind::Type: {
      const auto& d = tree_.as<TypeDecl>(id);
      out += ' ';
      name(d.name);
      if ((h.bits & kInternal) != 0) out += " internal";
      pragmas(h);
      if (d.init) {
        out += " := ";
        expr(d.init);
      }
      typeExpr(d.type, depth + 1);
      break;
    }
    case DeclKind::Pou: {
      const auto& d = tree_.as<PouDecl>(id);
      static const char* const kKinds[] = {" function ",  " function_block ", " program ", " class ",
                                           " interface ", " method ",         " action "};
      out += kKinds[static_cast<size_t>(d.pou_kind)];
      name(d.name);
      modifiers(d.access, d.modifiers);
      pragmas(h);
      if (!d.closed) out += " open";
      typeList("extends", d.bases, depth);
      typeList("implements", d.implements, depth);
      for (DeclId u : tree_.list(d.usings)) decl(u, depth + 1);
      if (d.result) {
        line(depth + 1);
        out += "result";
        typeExpr(d.result, depth + 2);
      }
      for (DeclId s : tree_.list(d.sections)) decl(s, depth + 1);
      if (d.body_kind == BodyKind::Native) {
        line(depth + 1);
        out += "native";
      }
      if (d.body_kind == BodyKind::Cpp) {
        line(depth + 1);
        out += "cpp";
      }
      if (d.body_kind == BodyKind::Il) {
        line(depth + 1);
        out += "instructions";
        instructions(d.il, depth + 2);
      }
      if (d.body_kind == BodyKind::Sfc) {
        line(depth + 1);
        out += "chart";
        chart(d, depth + 2);
      }
      if (d.body_kind == BodyKind::Network) {
        static const char* const kLanguages[] = {"networks ld", "networks fbd", "networks cfc"};
        line(depth + 1);
        out += kLanguages[static_cast<size_t>(d.diagram.language)];
        for (const DiagramElement& e : tree_.list(d.diagram.elements)) element(d.diagram, e, depth + 2);
      }
      if (!d.body.empty()) {
        line(depth + 1);
        out += "body";
        stmts(d.body, depth + 2);
      }
      for (DeclId m : tree_.list(d.members)) decl(m, depth + 1);
      break;
    }
    case DeclKind::Property: {
      const auto& d = tree_.as<PropertyDecl>(id);
      out += ' ';
      name(d.name);
      modifiers(d.access, d.modifiers);
      pragmas(h);
      typeExpr(d.type, depth + 1);
      for (const DeclId accessor : {d.get, d.set}) {
        if (!accessor) continue;
        line(depth + 1);
        out += accessor == d.get ? "get" : "set";
        decl(accessor, depth + 2);
      }
      break;
    }
    case DeclKind::Namespace: {
      const auto& d = tree_.as<NamespaceDecl>(id);
      out += ' ';
      path(d.path, ".");
      if ((h.bits & kInternal) != 0) out += " internal";
      for (DeclId m : tree_.list(d.decls)) decl(m, depth + 1);
      break;
    }
    case DeclKind::Using:
      out += ' ';
      path(tree_.as<UsingDecl>(id).path, ".");
      break;
    case DeclKind::Section: {
      const auto& d = tree_.as<SectionDecl>(id);
      static const char* const kSections[] = {" local",  " input", " output", " in_out", " temp",  " external",
                                              " global", " stat",  " inst",   " access", " config"};
      out += kSections[static_cast<size_t>(d.section)];
      bits(h.bits);
      modifiers(d.access, 0);
      pragmas(h);
      for (DeclId v : tree_.list(d.vars)) decl(v, depth + 1);
      break;
    }
    case DeclKind::Var: {
      const auto& d = tree_.as<VarDecl>(id);
      if (!d.names.empty()) out += ' ';
      path(d.names, ", ");
      if (d.located) {
        out += " at ";
        address(d.address);
      }
      if (d.edge != EdgeKind::None) out += d.edge == EdgeKind::Rising ? " r_edge" : " f_edge";
      pragmas(h);
      if (d.init) {
        out += " := ";
        expr(d.init);
      }
      typeExpr(d.type, depth + 1);
      break;
    }
    case DeclKind::Configuration: {
      const auto& d = tree_.as<ConfigurationDecl>(id);
      out += ' ';
      name(d.name);
      for (DeclId m : tree_.list(d.members)) decl(m, depth + 1);
      break;
    }
    case DeclKind::Resource: {
      const auto& d = tree_.as<ResourceDecl>(id);
      out += ' ';
      name(d.name);
      out += " on ";
      name(d.target);
      for (DeclId m : tree_.list(d.members)) decl(m, depth + 1);
      break;
    }
    case DeclKind::Task: {
      const auto& d = tree_.as<TaskDecl>(id);
      out += ' ';
      name(d.name);
      arguments(d.settings, 0);
      break;
    }
    case DeclKind::ProgramInstance: {
      const auto& d = tree_.as<ProgramInstanceDecl>(id);
      out += ' ';
      name(d.name);
      bits(d.section_bits);
      if (d.task.name) {
        out += " with ";
        name(d.task.name);
      }
      out += " of ";
      path(d.type, ".");
      arguments(d.arguments, 0);
      break;
    }
  }
}

void Printer::idents(const char* before, Slice<Ident> list) {
  out += before;
  for (const Ident& ident : tree_.list(list)) {
    out += ' ';
    out += names_.string(ident.name);
  }
}

void Printer::chart(const PouDecl& d, int depth) {
  static const char* const kQualifiers[] = {"n",  "r",  "s",  "l",  "d",     "p",      "p0",
                                            "p1", "sd", "ds", "sl", "entry", "active", "exit"};
  for (const SfcStep& step : tree_.list(d.steps)) {
    line(depth);
    out += step.initial ? "initial_step " : "step ";
    out += names_.string(step.name.name);
    for (const SfcExpr* limit : {&step.min, &step.max}) {
      if (!limit->value) continue;
      out += limit == &step.min ? " min " : " max ";
      expr(limit->value);
    }
    for (const SfcAssociation& a : tree_.list(step.actions)) {
      line(depth + 1);
      out += kQualifiers[static_cast<size_t>(a.qualifier)];
      out += ' ';
      out += names_.string(a.action.name);
      if (a.time.value) {
        out += ' ';
        expr(a.time.value);
      }
      if (!a.indicators.empty()) idents(" shows", a.indicators);
    }
  }
  for (const SfcTransition& t : tree_.list(d.transitions)) {
    line(depth);
    out += "transition";
    if (t.name.name) {
      out += ' ';
      out += names_.string(t.name.name);
    }
    if (t.has_priority) out += " priority " + std::to_string(t.priority);
    idents(" from", t.from);
    idents(" to", t.to);
    if (!t.condition.value) continue;
    out += ' ';
    expr(t.condition.value);
  }
}

template <class Modifiable>
void Printer::modifiers(const Modifiable& element) {
  if (element.negated) out += " not";
  if (element.edge != EdgeKind::None) out += element.edge == EdgeKind::Rising ? " rising" : " falling";
  if (element.storage != PinStorage::None) out += element.storage == PinStorage::Set ? " set" : " reset";
}

// A wire is printed as the number of the element that it comes from.
void Printer::element(const Diagram& diagram, const DiagramElement& e, int depth) {
  line(depth);
  out += kElementWords[static_cast<size_t>(e.kind)];
  out += ' ' + std::to_string(e.number);
  if (e.network != 0) out += " network " + std::to_string(tree_.list(diagram.networks)[e.network - 1].number);
  if (e.order != 0) out += " order " + std::to_string(e.order);
  for (const ExprId part : {e.path, e.operand}) {
    if (!part) continue;
    out += ' ';
    expr(part);
  }
  modifiers(e);
  for (const DiagramPin& pin : tree_.list(e.pins)) {
    static const char* const kDirections[] = {"in", "out", "in_out"};
    line(depth + 1);
    out += kDirections[static_cast<size_t>(pin.direction)];
    if (pin.name.name) {
      out += ' ';
      name(pin.name.name);
    }
    modifiers(pin);
    for (const DiagramWire& wire : tree_.list(pin.wires)) {
      out += " from " + std::to_string(tree_.list(diagram.elements)[wire.from].number);
      if (wire.pin.name) out += '.' + std::string(names_.string(wire.pin.name));
    }
  }
  if (!e.body.empty()) stmts(e.body, depth + 1);
}

}  // namespace

std::string printTree(const Tree& tree, const Names& names, const FileUnit& unit) {
  Printer printer(tree, names);
  for (DeclId d : tree.list(unit.decls)) printer.decl(d, 0);
  printer.out += '\n';
  return std::move(printer.out);
}

}  // namespace rung

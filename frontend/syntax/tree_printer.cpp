// SPDX-License-Identifier: Apache-2.0
// The tree as text, as it was written: what a check of the program inserted is left out. A line per declaration,
// statement and type; expressions in parentheses on the line of their statement. Errors print the source that they
// hold, and what recovery skipped is a line in the innermost declaration or statement around it.
#include <string>

#include "frontend/syntax/diagram.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/sfc.h"
#include "frontend/syntax/tree_expr_printer.h"

namespace rung {
namespace {

constexpr const char* kStmtWords[] = {
#define RUNG_STMT(kind, word, ...) word,
#include "frontend/syntax/nodes.def"
};
constexpr const char* kTypeExprWords[] = {
#define RUNG_TYPE_EXPR(kind, word, ...) word,
#include "frontend/syntax/nodes.def"
};
constexpr const char* kDeclWords[] = {
#define RUNG_DECL(kind, word, ...) word,
#include "frontend/syntax/nodes.def"
};
const char* word(StmtKind kind) { return kStmtWords[static_cast<size_t>(kind)]; }
const char* word(TypeExprKind kind) { return kTypeExprWords[static_cast<size_t>(kind)]; }
const char* word(DeclKind kind) { return kDeclWords[static_cast<size_t>(kind)]; }

class Printer : public TreeExprPrinter {
 public:
  Printer(const Tree& tree, const Names& names, const Sources* sources, Slice<Range> skipped = {})
      : TreeExprPrinter(tree, names, sources), skipped_(tree.list(skipped)) {}

  void decl(DeclId id, int depth);
  void expression(ExprId id) { expr(id); }
  // What was skipped before a location, and not printed yet.
  void skippedBefore(Loc end, int depth) {
    for (; !skipped_.empty() && skipped_.front().begin < end; skipped_ = skipped_.subspan(1)) {
      line(depth, "skipped");
      source(skipped_.front());
    }
  }

 private:
  void pragmas(const DeclHeader& h);
  void qualifiers(const Qualifiers& q);
  void modifiers(AccessLevel access, uint8_t bits);
  void typeList(const char* what, Slice<TypeExprId> list, int depth);
  void stmts(Slice<StmtId> list, int depth) {
    for (StmtId s : tree_.list(list)) stmt(s, depth);
  }
  void stmt(StmtId id, int depth);
  void block(const char* label, Slice<StmtId> list, int depth) {
    line(depth + 1, label);
    stmts(list, depth + 2);
  }
  void instructions(Slice<IlInstruction> list, int depth);
  void element(const Diagram& diagram, const DiagramElement& e, int depth);
  template <class Modifiable>
  void modifiers(const Modifiable& element);
  void chart(const PouDecl& d, int depth);
  void idents(const char* before, Slice<Ident> list);
  void typeExpr(TypeExprId id, int depth) override;
  // The rest of a node, after its word.
  void print(const ErrorStmt& s, int) { source({s.h.loc, s.h.end}); }
  void print(const EmptyStmt&, int) {}
  void print(const ExitStmt&, int) {}
  void print(const ContinueStmt&, int) {}
  void print(const ReturnStmt&, int) {}
  void print(const AssignStmt& s, int);
  void print(const CallStmt& s, int);
  void print(const IfStmt& s, int depth);
  void print(const CaseStmt& s, int depth);
  void print(const ForStmt& s, int depth);
  void print(const WhileStmt& s, int depth);
  void print(const RepeatStmt& s, int depth);
  void print(const TryStmt& s, int depth);
  void print(const JumpStmt& s, int);
  void print(const LabelStmt& s, int);
  void print(const ErrorTypeExpr& t, int) { source({t.h.loc, t.h.end}); }
  void print(const NamedTypeExpr& t, int);
  void print(const StringTypeExpr& t, int);
  void print(const SubrangeTypeExpr& t, int depth);
  void print(const EnumTypeExpr& t, int depth);
  void print(const ArrayTypeExpr& t, int depth);
  void print(const StructTypeExpr& t, int depth);
  void print(const PointerTypeExpr& t, int depth);
  void print(const TypeDecl& d, int depth);
  void print(const PouDecl& d, int depth);
  void print(const PropertyDecl& d, int depth);
  void print(const NamespaceDecl& d, int depth);
  void print(const UsingDecl& d, int);
  void print(const SectionDecl& d, int depth);
  void print(const VarDecl& d, int depth);
  void print(const ConfigurationDecl& d, int depth);
  void print(const ResourceDecl& d, int depth);
  void print(const TaskDecl& d, int);
  void print(const ProgramInstanceDecl& d, int);

  std::span<const Range> skipped_;
};

void Printer::modifiers(AccessLevel access, uint8_t bits) {
  static const char* const kAccess[] = {"", " public", " private", " protected", " internal"};
  out += kAccess[static_cast<size_t>(access)];
  if ((bits & kAbstract) != 0) out += " abstract";
  if ((bits & kFinal) != 0) out += " final";
  if ((bits & kOverride) != 0) out += " override";
}

void Printer::typeList(const char* what, Slice<TypeExprId> list, int depth) {
  if (list.empty()) return;
  line(depth + 1, what);
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

void Printer::stmt(StmtId id, int depth) {
  const Range range = tree_.range(id);
  skippedBefore(range.begin, depth);
  line(depth, word(tree_.kind(id)));
  // clang-format off
  switch (tree_.kind(id)) {
#define RUNG_STMT(kind, word, ...) \
  case StmtKind::kind: print(tree_.as<kind##Stmt>(id), depth); break;
#include "frontend/syntax/nodes.def"
  }
  // clang-format on
  skippedBefore(range.end, depth + 1);
}

void Printer::print(const AssignStmt& s, int) {
  out += ' ';
  out += spelling(s.op());
  spaced(s.target);
  spaced(s.value);
}

void Printer::print(const CallStmt& s, int) { spaced(s.call); }

void Printer::print(const IfStmt& s, int depth) {
  for (const IfBranch& b : tree_.list(s.branches)) {
    line(depth + 1, "then ");
    expr(b.condition);
    stmts(b.body, depth + 2);
  }
  if (!s.otherwise.empty()) block("else", s.otherwise, depth);
}

void Printer::print(const CaseStmt& s, int depth) {
  spaced(s.selector);
  for (const CaseBranch& b : tree_.list(s.branches)) {
    line(depth + 1, "of");
    exprs(b.labels, 0);
    stmts(b.body, depth + 2);
  }
  if (s.has_else) block("else", s.otherwise, depth);
}

void Printer::print(const ForStmt& s, int depth) {
  spaced(s.control);
  spaced(s.from);
  spaced(s.to);
  optional(" by ", s.step);
  stmts(s.body, depth + 1);
}

void Printer::print(const WhileStmt& s, int depth) {
  spaced(s.condition);
  stmts(s.body, depth + 1);
}

void Printer::print(const RepeatStmt& s, int depth) {
  out += " until ";
  expr(s.until);
  stmts(s.body, depth + 1);
}

void Printer::print(const TryStmt& s, int depth) {
  stmts(s.body, depth + 1);
  if (s.catches) {
    line(depth + 1, "catch");
    if (s.code) spaced(s.code);
    stmts(s.handler, depth + 2);
  }
  if (!s.finally.empty()) {
    line(depth + 1, "finally");
    stmts(s.finally, depth + 2);
  }
}

void Printer::print(const JumpStmt& s, int) { spaced(s.label.name); }

void Printer::print(const LabelStmt& s, int) { spaced(s.label.name); }

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
    if (i.target.name) spaced(i.target.name);
    if (i.callee) spaced(i.callee);
    arguments(i.operands, 0);
    for (const IlNested& nested : tree_.list(i.nested)) {
      line(depth + 1, "operand ");
      number(nested.operand);
      instructions(nested.list, depth + 2);
    }
  }
}

void Printer::typeExpr(TypeExprId id, int depth) {
  if (!id) return;
  line(depth, word(tree_.kind(id)));
  // clang-format off
  switch (tree_.kind(id)) {
#define RUNG_TYPE_EXPR(kind, word, ...) \
  case TypeExprKind::kind: return print(tree_.as<kind##TypeExpr>(id), depth);
#include "frontend/syntax/nodes.def"
  }
  // clang-format on
}

void Printer::print(const NamedTypeExpr& t, int) {
  out += ' ';
  path(t.path, ".");
  if (!t.generics.empty()) arguments(t.generics, 0);
  if (t.has_arguments) arguments(t.arguments, 0);
  for (ExprId element : tree_.list(t.elements)) arguments(tree_.as<CallExpr>(element).arguments, 0);
}

void Printer::print(const StringTypeExpr& t, int) {
  out += ' ';
  out += spelling(t.code);
  if (t.length) spaced(t.length);
}

void Printer::print(const SubrangeTypeExpr& t, int depth) {
  spaced(t.low);
  spaced(t.high);
  typeExpr(t.base, depth + 1);
}

void Printer::print(const EnumTypeExpr& t, int depth) {
  for (const EnumItem& item : tree_.list(t.items)) {
    line(depth + 1, "item ");
    name(item.item.name);
    if (item.value) spaced(item.value);
  }
  typeExpr(t.base, depth + 1);
}

void Printer::print(const ArrayTypeExpr& t, int depth) {
  for (const ArrayBound& b : tree_.list(t.bounds)) {
    out += " [";
    if (b.low) {
      expr(b.low);
      spaced(b.high);
    } else {
      out += '*';
    }
    out += ']';
  }
  typeExpr(t.element, depth + 1);
}

void Printer::print(const StructTypeExpr& t, int depth) {
  if (t.is_union) out += " union";
  if (t.overlaps) out += " overlap";
  if (t.base) {
    line(depth + 1, "extends");
    typeExpr(t.base, depth + 2);
  }
  for (DeclId d : tree_.list(t.fields)) decl(d, depth + 1);
}

void Printer::print(const PointerTypeExpr& t, int depth) {
  out += t.form == PointerForm::Pointer ? " pointer" : t.form == PointerForm::Reference ? " reference" : " ref_to";
  typeExpr(t.target, depth + 1);
}

void Printer::qualifiers(const Qualifiers& q) {
  if (q.constant) out += " constant";
  if (q.retain) out += " retain";
  if (q.persistent) out += " persistent";
  if (q.non_retain) out += " non_retain";
  if (q.generic) out += " generic";
}

void Printer::decl(DeclId id, int depth) {
  const Range range = tree_.range(id);
  skippedBefore(range.begin, depth);
  line(depth, word(tree_.kind(id)));
  // clang-format off
  switch (tree_.kind(id)) {
#define RUNG_DECL(kind, word, ...) \
  case DeclKind::kind: print(tree_.as<kind##Decl>(id), depth); break;
#include "frontend/syntax/nodes.def"
  }
  // clang-format on
  skippedBefore(range.end, depth + 1);
}

void Printer::print(const TypeDecl& d, int depth) {
  spaced(d.name);
  if (d.is_internal) out += " internal";
  pragmas(d.h);
  optional(" := ", d.init);
  typeExpr(d.type, depth + 1);
}

void Printer::print(const PouDecl& d, int depth) {
  static const char* const kKinds[] = {" function ",  " function_block ", " program ", " class ",
                                       " interface ", " method ",         " action "};
  out += kKinds[static_cast<size_t>(d.pou_kind)];
  name(d.name);
  modifiers(d.access, d.modifiers);
  pragmas(d.h);
  if (!d.closed) out += " open";
  typeList("extends", d.bases, depth);
  typeList("implements", d.implements, depth);
  for (DeclId u : tree_.list(d.usings)) decl(u, depth + 1);
  if (d.result) {
    line(depth + 1, "result");
    typeExpr(d.result, depth + 2);
  }
  for (DeclId s : tree_.list(d.sections)) decl(s, depth + 1);
  if (d.body_kind == BodyKind::Native) line(depth + 1, "native");
  if (d.cpp_file_begin != d.cpp_file_end) line(depth + 1, "cpp file");
  if (d.body_kind == BodyKind::Cpp) line(depth + 1, "cpp");
  if (d.body_kind == BodyKind::Il) {
    line(depth + 1, "instructions");
    instructions(d.il, depth + 2);
  }
  if (d.body_kind == BodyKind::Sfc) {
    line(depth + 1, "chart");
    chart(d, depth + 2);
  }
  if (d.body_kind == BodyKind::Network) {
    static const char* const kLanguages[] = {"networks ld", "networks fbd", "networks cfc"};
    line(depth + 1, kLanguages[static_cast<size_t>(d.diagram.language)]);
    for (const DiagramElement& e : tree_.list(d.diagram.elements)) element(d.diagram, e, depth + 2);
  }
  if (!d.body.empty()) {
    line(depth + 1, "body");
    stmts(d.body, depth + 2);
  }
  for (DeclId m : tree_.list(d.members)) decl(m, depth + 1);
}

void Printer::print(const PropertyDecl& d, int depth) {
  spaced(d.name);
  modifiers(d.access, d.modifiers);
  pragmas(d.h);
  typeExpr(d.type, depth + 1);
  for (const DeclId accessor : {d.get, d.set}) {
    if (!accessor) continue;
    line(depth + 1, accessor == d.get ? "get" : "set");
    decl(accessor, depth + 2);
  }
}

void Printer::print(const NamespaceDecl& d, int depth) {
  out += ' ';
  path(d.path, ".");
  if (d.is_internal) out += " internal";
  for (DeclId m : tree_.list(d.decls)) decl(m, depth + 1);
}

void Printer::print(const UsingDecl& d, int) {
  out += ' ';
  path(d.path, ".");
}

void Printer::print(const SectionDecl& d, int depth) {
  static const char* const kSections[] = {" local",  " input", " output", " in_out", " temp",  " external",
                                          " global", " stat",  " inst",   " access", " config"};
  out += kSections[static_cast<size_t>(d.section)];
  qualifiers(d.qualifiers);
  modifiers(d.access, 0);
  pragmas(d.h);
  for (DeclId v : tree_.list(d.vars)) decl(v, depth + 1);
}

void Printer::print(const VarDecl& d, int depth) {
  if (!d.names.empty()) out += ' ';
  path(d.names, ", ");
  if (d.located) {
    out += " at ";
    address(d.address);
  }
  if (d.edge != EdgeKind::None) out += d.edge == EdgeKind::Rising ? " r_edge" : " f_edge";
  pragmas(d.h);
  optional(" := ", d.init);
  typeExpr(d.type, depth + 1);
}

void Printer::print(const ConfigurationDecl& d, int depth) {
  spaced(d.name);
  for (DeclId m : tree_.list(d.members)) decl(m, depth + 1);
}

void Printer::print(const ResourceDecl& d, int depth) {
  spaced(d.name);
  out += " on ";
  name(d.target);
  for (DeclId m : tree_.list(d.members)) decl(m, depth + 1);
}

void Printer::print(const TaskDecl& d, int) {
  spaced(d.name);
  arguments(d.settings, 0);
}

void Printer::print(const ProgramInstanceDecl& d, int) {
  spaced(d.name);
  qualifiers(d.qualifiers);
  if (d.task.name) {
    out += " with ";
    name(d.task.name);
  }
  out += " of ";
  path(d.type, ".");
  arguments(d.arguments, 0);
}

void Printer::idents(const char* before, Slice<Ident> list) {
  out += before;
  for (const Ident& ident : tree_.list(list)) {
    spaced(ident.name);
  }
}

void Printer::chart(const PouDecl& d, int depth) {
  static const char* const kQualifiers[] = {"n",  "r",  "s",  "l",  "d",     "p",      "p0",
                                            "p1", "sd", "ds", "sl", "entry", "active", "exit"};
  for (const SfcStep& step : tree_.list(d.steps)) {
    line(depth, step.initial ? "initial_step " : "step ");
    out += names_.string(step.name.name);
    for (const SfcExpr* limit : {&step.min, &step.max}) {
      if (!limit->value) continue;
      out += limit == &step.min ? " min " : " max ";
      expr(limit->value);
    }
    for (const SfcAssociation& a : tree_.list(step.actions)) {
      line(depth + 1, kQualifiers[static_cast<size_t>(a.qualifier)]);
      spaced(a.action.name);
      if (a.time.value) spaced(a.time.value);
      if (!a.indicators.empty()) idents(" shows", a.indicators);
    }
  }
  for (const SfcTransition& t : tree_.list(d.transitions)) {
    line(depth, "transition");
    if (t.name.name) spaced(t.name.name);
    if (t.has_priority) out += " priority " + std::to_string(t.priority);
    idents(" from", t.from);
    idents(" to", t.to);
    if (!t.condition.value) continue;
    spaced(t.condition.value);
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
  line(depth, kElementWords[static_cast<size_t>(e.kind)]);
  out += ' ' + std::to_string(e.number);
  if (e.network != 0) out += " network " + std::to_string(tree_.list(diagram.networks)[e.network - 1].number);
  if (e.order != 0) out += " order " + std::to_string(e.order);
  for (const ExprId part : {e.path, e.operand}) {
    if (!part) continue;
    spaced(part);
  }
  modifiers(e);
  for (const DiagramPin& pin : tree_.list(e.pins)) {
    static const char* const kDirections[] = {"in", "out", "in_out"};
    line(depth + 1, kDirections[static_cast<size_t>(pin.direction)]);
    if (pin.name.name) spaced(pin.name.name);
    modifiers(pin);
    for (const DiagramWire& wire : tree_.list(pin.wires)) {
      out += " from " + std::to_string(tree_.list(diagram.elements)[wire.from].number);
      if (wire.pin.name) out += '.' + std::string(names_.string(wire.pin.name));
    }
  }
  if (!e.body.empty()) stmts(e.body, depth + 1);
}

}  // namespace

std::string printExpression(const Tree& tree, const Names& names, ExprId expr) {
  Printer printer(tree, names, nullptr);
  printer.expression(expr);
  return std::move(printer.out);
}

std::string printTree(const Tree& tree, const Names& names, const Sources& sources, const FileUnit& unit) {
  Printer printer(tree, names, &sources, unit.skipped);
  for (DeclId d : tree.list(unit.decls)) printer.decl(d, 0);
  printer.skippedBefore({~0u}, 0);
  printer.out += '\n';
  return std::move(printer.out);
}

}  // namespace rung

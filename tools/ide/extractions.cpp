// SPDX-License-Identifier: Apache-2.0
// An expression becomes a variable that is set before its statement; statements become a method of the block.
//   IF a + b > 3 THEN …     value := a + b; IF value > 3 THEN …
#include <algorithm>

#include "frontend/syntax/children.h"
#include "tools/ide/selection.h"

namespace rung::ide {
namespace {

bool isSame(const Range& a, const Range& b) { return a.begin == b.begin && a.end == b.end; }

// The expression that is selected; none: not a whole one.
ExprId selectedExpression(const Selection& selection) {
  for (const NodeRef& node : selection.path) {
    if (node.category != NodeRef::Category::Expr) continue;
    const ExprId expr{node.word};
    if (isSame(selection.tree().range(expr), selection.parsed) ||
        isSame(selection.tree().bareRange(expr), selection.parsed))
      return expr;
  }
  return {};
}

// The innermost statement around the begin of the selection, and what it is a child of.
struct StatementAt {
  StmtId stmt;
  NodeRef parent;
};
StatementAt statementAt(const Selection& selection) {
  StatementAt found;
  for (size_t i = 1; i < selection.path.size(); ++i)
    if (selection.path[i].category == NodeRef::Category::Stmt)
      found = {StmtId{selection.path[i].word}, selection.path[i - 1]};
  return found;
}

bool contains(const Range& outer, const Range& inner) { return outer.begin <= inner.begin && inner.end <= outer.end; }

// The statement evaluates the expression once, and before all else that it does.
bool isEvaluatedFirst(const Selection& selection, StmtId stmt) {
  const Tree& tree = selection.tree();
  const auto isIn = [&](ExprId expr) { return expr && contains(tree.range(expr), selection.parsed); };
  const StmtKind kind = tree.kind(stmt);
  if (kind == StmtKind::Assign) return isIn(tree.as<AssignStmt>(stmt).value);
  if (kind == StmtKind::Call) return true;
  if (kind == StmtKind::Case) return isIn(tree.as<CaseStmt>(stmt).selector);
  if (kind == StmtKind::For) return isIn(tree.as<ForStmt>(stmt).from);
  if (kind != StmtKind::If) return false;
  const std::span<const IfBranch> branches = tree.list(tree.as<IfStmt>(stmt).branches);
  return !branches.empty() && isIn(branches[0].condition);
}

// `TRANSITION t := a;` is not a statement, although it looks like one from its value on.
bool followsSign(const Selection& selection, Loc begin) {
  Loc before = begin;
  std::string text;
  do {
    --before.offset;
    text = selection.text({before, {before.offset + 1}});
  } while (!text.empty() && isBlankCharacter(text[0]));
  return text == "=" || text == ":";
}

// A type as its name is known in the project; empty: it has none there.
std::string typeName(const Selection& selection, TypeId type) {
  const types::TypeTable& table = selection.project().types;
  const TypeId resolved = table.resolve(type);
  const types::TypeKind kind = table.kind(resolved);
  if (kind == types::TypeKind::Enum || kind == types::TypeKind::Record) {
    const NameId name = table.info(resolved).name;
    if (!name || !selection.scope().typeNamed(selection.view.names().key(name))) return {};
  }
  return table.toString(resolved);
}

void addVariable(const Selection& selection, std::vector<CodeAction>& actions) {
  const Tree& tree = selection.tree();
  const ExprId expr = selectedExpression(selection);
  const StatementAt at = statementAt(selection);
  if (!expr || !at.stmt || listWith(tree, at.parent, at.stmt).empty() || !isEvaluatedFirst(selection, at.stmt)) return;
  const ExprShape shape_of_it = shape(tree.kind(expr));
  if (shape_of_it != ExprShape::Operation && tree.kind(expr) != ExprKind::Literal) return;  // it may be an lvalue
  const TypeId type = selection.typeOf(expr);
  const std::string type_name = type ? typeName(selection, type) : std::string();
  if (type_name.empty() || followsSign(selection, tree.range(at.stmt).begin)) return;
  const std::string name = selection.freshName("value");
  const std::string declaration = name + " : " + type_name;
  const Loc before = tree.range(at.stmt).begin;
  const bool is_first = withBlanks(selection.view.sources(), {before, before}).begin == before &&
                        selection.text({{before.offset - 1}, before}) != " ";
  const std::string line = name + " := " + selection.text(selection.parsed) + ";";
  const std::string apart = is_first || !selection.indent(before).empty() ? "\n" + selection.indent(before) : " ";
  std::vector<Fix::Edit> edits = {{before, before, line + apart}, {selection.parsed.begin, selection.parsed.end, name}};
  edits.push_back(declarationIn(selection.written(), selection.declaringPou(), SectionKind::Local, declaration));
  if (!edits.back().begin) return;
  actions.push_back(
      codeAction(selection.view, "Extract variable `" + name + "`", ActionKind::Extract, std::move(edits)));
}

// ---- methods

// Whether statements can be in a method of their own: nothing leaves them, and all their variables live in the block.
class Movable {
 public:
  explicit Movable(const Selection& selection) : selection_(selection), tree_(selection.tree()) {}

  bool is(std::span<const StmtId> statements) {
    for (const StmtId stmt : statements) visit(stmt);
    return is_movable_;
  }

 private:
  template <class Id>
  void visit(Id id) {
    if constexpr (std::is_same_v<Id, StmtId>) {
      const StmtKind kind = tree_.kind(id);
      if (kind == StmtKind::Return || kind == StmtKind::Exit || kind == StmtKind::Continue || kind == StmtKind::Jump ||
          kind == StmtKind::Label || kind == StmtKind::Error)
        is_movable_ = false;
    }
    if constexpr (std::is_same_v<Id, ExprId>)
      if (tree_.kind(id) == ExprKind::Name && isOfCall(id)) is_movable_ = false;
    if constexpr (!std::is_same_v<Id, DeclId>) forEachChild(tree_, id, [&](const auto& child) { visit(child); });
  }
  bool isOfCall(ExprId name) const {
    const Entity entity = selection_.view.meanings().valueOf(selection_.pou, name).entity;
    if (entity.entityKind() == EntityKind::Pou) return selection_.project().pou(PouId{entity.index}).pragmas.test_only;
    if (entity.entityKind() != EntityKind::Var) return false;
    const sema::Var& var = selection_.project().var(VarId{entity.index});
    return var.section == SectionKind::Temp ||
           (var.pou == selection_.pou && (var.section == SectionKind::InOut || var.section == SectionKind::External));
  }

  const Selection& selection_;
  const Tree& tree_;
  bool is_movable_ = true;
};

// The statements of one list that are selected; none: not whole ones.
std::span<const StmtId> selectedStatements(const Selection& selection) {
  const Tree& tree = selection.tree();
  for (size_t i = 1; i < selection.path.size(); ++i) {
    if (selection.path[i].category != NodeRef::Category::Stmt) continue;
    const StmtId first{selection.path[i].word};
    if (tree.range(first).begin != selection.parsed.begin) continue;
    const std::span<const StmtId> list = listWith(tree, selection.path[i - 1], first);
    const auto begin = std::find(list.begin(), list.end(), first);
    const auto last =
        std::find_if(begin, list.end(), [&](StmtId stmt) { return tree.range(stmt).end == selection.parsed.end; });
    if (begin != list.end() && last != list.end()) return {&*begin, static_cast<size_t>(last - begin) + 1};
  }
  return {};
}

// The lines of the selection with another indent than that of the first.
std::string reindented(const std::string& text, const std::string& from, const std::string& to) {
  std::string out = to;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = std::string_view(text).substr(at, end - at);
    if (at > 0 && line.starts_with(from)) line.remove_prefix(from.size());
    if (at > 0) out += "\n" + (line.empty() ? std::string() : to);
    out += line;
    at = end + 1;
  }
  return out;
}

void addMethod(const Selection& selection, std::vector<CodeAction>& actions) {
  const PouDecl& pou = selection.pouDecl();
  if (pou.pou_kind != PouKind::FunctionBlock && pou.pou_kind != PouKind::Program) return;
  if (!isWholeSource(selection.view.sources(), pou.h.loc)) return;
  const std::span<const StmtId> statements = selectedStatements(selection);
  if (statements.empty() || !Movable(selection).is(statements)) return;
  const Loc at = pou.members.empty() ? endOfSections(selection.written(), pou)
                                     : selection.tree().decl(selection.tree().list(pou.members).back()).end;
  const std::string name = selection.freshName("NewMethod"), indent = selection.indent(pou.h.loc);
  const std::string body =
      reindented(selection.text(selection.parsed), selection.indent(selection.parsed.begin), indent + "  ");
  const std::string method = "\n" + indent + "METHOD " + name + "\n" + body + "\n" + indent + "END_METHOD";
  actions.push_back(codeAction(selection.view, "Extract method `" + name + "`", ActionKind::Extract,
                               {{at, at, method}, {selection.parsed.begin, selection.parsed.end, name + "();"}}));
}

}  // namespace

void addExtractions(const Selection& selection, std::vector<CodeAction>& actions) {
  if (!(selection.parsed.begin < selection.parsed.end)) return;
  addVariable(selection, actions);
  addMethod(selection, actions);
}

}  // namespace rung::ide

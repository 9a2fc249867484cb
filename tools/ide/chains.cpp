// SPDX-License-Identifier: Apache-2.0
// An IF chain that compares one value with constants becomes a CASE, and back; a CASE gets the values of its
// enumeration that it lacks. The source of the branches stays as it is, with its comments.
//   IF mode = 1 OR mode = 2 THEN a(); ELSE b(); END_IF     CASE mode OF 1, 2: a(); ELSE b(); END_CASE
#include <algorithm>

#include "frontend/syntax/children.h"
#include "tools/ide/selection.h"

namespace rung::ide {
namespace {

using types::TypeTable;

// The innermost statement of a kind around the begin of the selection whose keyword it is on; none: it is in its body.
StmtId statementOf(const Selection& selection, StmtKind kind) {
  for (size_t i = selection.path.size(); i-- > 0;) {
    if (selection.path[i].category != NodeRef::Category::Stmt) continue;
    const StmtId stmt{selection.path[i].word};
    return selection.tree().kind(stmt) == kind ? stmt : StmtId{};
  }
  return {};
}

// The source from one place to another, without the blanks at its end.
std::string partOf(const Selection& selection, Loc from, Loc to) {
  std::string text = selection.text({from, to});
  while (!text.empty() && isBlankCharacter(text.back())) text.pop_back();
  return text;
}

Loc after(Loc word, std::string_view spelled) {
  return word ? Loc{word.offset + static_cast<uint32_t>(spelled.size())} : Loc{};
}

// A path that can be evaluated again and again.
bool isPathOfNames(const Tree& tree, ExprId expr) {
  const ExprKind kind = tree.kind(expr);
  if (kind == ExprKind::Name) return true;
  return (kind == ExprKind::Member || kind == ExprKind::Deref) && isPathOfNames(tree, tree.base(expr));
}

bool isWholeNumber(const Selection& selection, TypeId type) {
  if (!type || type == types::kError) return false;
  const types::TypeTable& table = selection.project().types;
  return table.kind(table.resolve(type)) == types::TypeKind::Enum || TypeTable::isInteger(table.plainKind(type)) ||
         TypeTable::isBits(table.plainKind(type));
}

// An item of an enumeration, a number or a constant.
bool isConstant(const Selection& selection, ExprId expr) {
  const Tree& tree = selection.tree();
  const ExprKind kind = tree.kind(expr);
  if (kind == ExprKind::Literal) return tree.as<LiteralExpr>(expr).literal() == LiteralKind::Integer;
  if (kind == ExprKind::TypedName) return true;
  if (kind != ExprKind::Name && kind != ExprKind::Member) return false;
  const Entity entity = selection.view.meanings().valueOf(selection.pou, expr).entity;
  if (entity.entityKind() == EntityKind::EnumValue) return true;
  return entity.entityKind() == EntityKind::Var && selection.project().var(VarId{entity.index}).constant;
}

// ---- from IF to CASE

class Chain {
 public:
  Chain(const Selection& selection, StmtId stmt)
      : selection_(selection), tree_(selection.tree()), range_(tree_.range(stmt)), node_(tree_.as<IfStmt>(stmt)) {}

  void add(std::vector<CodeAction>& actions) {
    const std::span<const IfBranch> branches = tree_.list(node_.branches);
    if (branches.size() < 2 || node_.h.op == kConditionalOp || !(range_.begin < range_.end)) return;
    const std::string indent = selection_.indent(range_.begin);
    std::string text;
    for (size_t i = 0; i < branches.size(); ++i) {
      std::vector<std::string> labels;
      if (!readLabels(branches[i].condition, labels)) return;
      const Loc then =
          after(findSign(selection_.view, tree_.range(branches[i].condition).end, range_.end, "THEN"), "THEN");
      const Loc end = endOf(i);
      if (!then || !end) return;
      text += "\n" + indent + "  ";
      for (size_t k = 0; k < labels.size(); ++k) text += (k == 0 ? "" : ", ") + labels[k];
      const std::string body = partOf(selection_, then, end);
      text += ":" + (body.empty() ? " ;" : body);
    }
    if (selector_ == ExprId{} ||
        !isWholeNumber(selection_, selection_.view.meanings().valueOf(selection_.pou, selector_).type))
      return;
    const Loc last = findSign(selection_.view, endOfLast(), range_.end, "END_IF");
    if (!last) return;
    if (const Loc otherwise = findSign(selection_.view, endOfBody(branches.size() - 1), last, "ELSE"))
      text += "\n" + indent + partOf(selection_, otherwise, last);
    const std::string head = "CASE " + selection_.text(tree_.range(selector_)) + " OF";
    actions.push_back(codeAction(selection_.view, "Convert to CASE", ActionKind::Rewrite,
                                 {{range_.begin, after(last, "END_IF"), head + text + "\n" + indent + "END_CASE"}}));
  }

 private:
  Loc endOfBody(size_t branch) const {
    const IfBranch& of = tree_.list(node_.branches)[branch];
    if (of.body.empty()) return tree_.range(of.condition).end;
    return tree_.range(tree_.list(of.body).back()).end;
  }
  Loc endOfLast() const {
    return node_.otherwise.empty() ? endOfBody(node_.branches.count - 1)
                                   : tree_.range(tree_.list(node_.otherwise).back()).end;
  }
  // Of the body of a branch: the next ELSIF, ELSE or END_IF.
  Loc endOf(size_t branch) const {
    const Loc from = endOfBody(branch);
    if (branch + 1 < node_.branches.count)
      return findSign(selection_.view, from, tree_.range(tree_.list(node_.branches)[branch + 1].condition).begin,
                      "ELSIF");
    const Loc last = findSign(selection_.view, endOfLast(), range_.end, "END_IF");
    const Loc otherwise = last ? findSign(selection_.view, from, last, "ELSE") : Loc{};
    return otherwise ? otherwise : last;
  }

  // `mode = 1 OR mode = 2`
  bool readLabels(ExprId condition, std::vector<std::string>& labels) {
    if (tree_.kind(condition) != ExprKind::Binary) return false;
    const BinaryExpr& node = tree_.as<BinaryExpr>(condition);
    if (node.op() == BinaryOp::Or || node.op() == BinaryOp::OrElse)
      return readLabels(node.left, labels) && readLabels(node.right, labels);
    if (node.op() != BinaryOp::Equal) return false;
    const bool is_reversed = isConstant(selection_, node.left) && !isConstant(selection_, node.right);
    const ExprId value = is_reversed ? node.right : node.left, label = is_reversed ? node.left : node.right;
    if (!isPathOfNames(tree_, value) || !isConstant(selection_, label)) return false;
    if (!selector_) selector_ = value;
    const std::string name = selection_.text(tree_.range(value)), shown = selection_.text(tree_.range(label));
    if (name.empty() || shown.empty() || !sameIdentifier(name, selection_.text(tree_.range(selector_)))) return false;
    if (std::find(known_.begin(), known_.end(), shown) != known_.end()) return false;  // a CASE has each once
    known_.push_back(shown);
    labels.push_back(shown);
    return true;
  }

  const Selection& selection_;
  const Tree& tree_;
  Range range_;
  const IfStmt& node_;
  ExprId selector_;
  std::vector<std::string> known_;
};

// ---- from CASE to IF

class Cases {
 public:
  Cases(const Selection& selection, StmtId stmt)
      : selection_(selection), tree_(selection.tree()), range_(tree_.range(stmt)), node_(tree_.as<CaseStmt>(stmt)) {}

  void addChain(std::vector<CodeAction>& actions) {
    const std::span<const CaseBranch> branches = tree_.list(node_.branches);
    const Loc last = endWord();
    if (branches.empty() || !last || !isPathOfNames(tree_, node_.selector)) return;
    const std::string selector = selection_.text(tree_.range(node_.selector)), indent = selection_.indent(range_.begin);
    std::string text;
    for (size_t i = 0; i < branches.size(); ++i) {
      const std::string condition = conditionOf(selector, branches[i]);
      const Loc body = after(findSign(selection_.view, endOfLabels(branches[i]), last, ":"), ":");
      const Loc end = i + 1 < branches.size() ? beginOf(branches[i + 1]) : otherwiseOr(last);
      if (condition.empty() || !body || !end) return;
      text += (i == 0 ? "IF " : "\n" + indent + "ELSIF ") + condition + " THEN" + partOf(selection_, body, end);
    }
    if (node_.has_else) text += "\n" + indent + partOf(selection_, otherwiseOr(last), last);
    actions.push_back(codeAction(selection_.view, "Convert to IF", ActionKind::Rewrite,
                                 {{range_.begin, after(last, "END_CASE"), text + "\n" + indent + "END_IF"}}));
  }

  void addMissing(std::vector<CodeAction>& actions) {
    const types::TypeTable& table = selection_.project().types;
    const TypeId type = selection_.view.meanings().valueOf(selection_.pou, node_.selector).type;
    const Loc last = endWord();
    if (!last || node_.has_else || !type || table.kind(table.resolve(type)) != types::TypeKind::Enum) return;
    const types::TypeInfo& info = table.info(table.resolve(type));
    std::vector<NameId> known;
    std::string qualifier =
        info.qualified ? std::string(selection_.view.names().string(info.name)) + "." : std::string();
    if (!readItems(info, known, qualifier)) return;
    const std::string indent = indentOfLabels();
    std::string text;
    for (const auto& [item, value] : info.items) {
      const auto isSame = [&, name = item](NameId one) { return selection_.view.names().same(one, name); };
      if (std::any_of(known.begin(), known.end(), isSame)) continue;
      text += indent + qualifier + std::string(selection_.view.names().string(item)) + ":\n" + indent + "  ;\n";
    }
    if (text.empty()) return;
    const Range line = withBlanks(selection_.view.sources(), {last, last});
    const bool is_alone = line.begin < last || selection_.indent(last).empty();
    const Loc at = is_alone ? Loc{last.offset - static_cast<uint32_t>(selection_.indent(last).size())} : last;
    actions.push_back(codeAction(selection_.view, "Add the missing values", ActionKind::Rewrite,
                                 {{at, at, is_alone ? text : "\n" + text}}));
  }

 private:
  Loc endWord() const {
    Loc from = tree_.range(node_.selector).end;
    for (const CaseBranch& branch : tree_.list(node_.branches))
      from = branch.body.empty() ? endOfLabels(branch) : tree_.range(tree_.list(branch.body).back()).end;
    if (!node_.otherwise.empty()) from = tree_.range(tree_.list(node_.otherwise).back()).end;
    return findSign(selection_.view, from, range_.end, "END_CASE");
  }
  Loc beginOf(const CaseBranch& branch) const {
    return branch.labels.empty() ? Loc{} : tree_.range(tree_.list(branch.labels)[0]).begin;
  }
  Loc endOfLabels(const CaseBranch& branch) const {
    return branch.labels.empty() ? Loc{} : tree_.range(tree_.list(branch.labels).back()).end;
  }
  Loc otherwiseOr(Loc last) const {
    if (!node_.has_else) return last;
    const CaseBranch& branch = tree_.list(node_.branches).back();
    const Loc from = branch.body.empty() ? endOfLabels(branch) : tree_.range(tree_.list(branch.body).back()).end;
    return findSign(selection_.view, from, last, "ELSE");
  }

  std::string conditionOf(const std::string& selector, const CaseBranch& branch) const {
    std::string out;
    for (const ExprId label : tree_.list(branch.labels)) {
      if (!out.empty()) out += " OR ";
      if (tree_.kind(label) == ExprKind::Range) {
        const RangeExpr& range = tree_.as<RangeExpr>(label);
        out += "(" + selector + " >= " + selection_.text(tree_.range(range.low)) + " AND " + selector +
               " <= " + selection_.text(tree_.range(range.high)) + ")";
        continue;
      }
      const std::string shown = selection_.text(tree_.range(label));
      if (shown.empty() || tree_.kind(label) == ExprKind::Error) return {};
      out += selector + " = " + shown;
    }
    return out;
  }

  // The items that have a branch, and how they are qualified. False: a label is not an item.
  bool readItems(const types::TypeInfo& info, std::vector<NameId>& known, std::string& qualifier) const {
    const Names& names = selection_.view.names();
    for (const CaseBranch& branch : tree_.list(node_.branches))
      for (const ExprId label : tree_.list(branch.labels)) {
        const NameId name = lastNameOf(label);
        const auto isItem = [&](const auto& item) { return name && names.same(item.first, name); };
        if (std::none_of(info.items.begin(), info.items.end(), isItem)) return false;
        const std::string shown = selection_.text(tree_.range(label));
        const size_t sign = shown.find_last_of("#.");
        if (sign != std::string::npos) qualifier = shown.substr(0, sign + 1);
        known.push_back(name);
      }
    return true;
  }
  NameId lastNameOf(ExprId label) const {
    const ExprKind kind = tree_.kind(label);
    if (kind == ExprKind::TypedName) return tree_.as<TypedNameExpr>(label).item.name;
    if (kind == ExprKind::Member) return tree_.as<MemberExpr>(label).member;
    return kind == ExprKind::Name ? tree_.as<NameExpr>(label).name : NameId{};
  }
  std::string indentOfLabels() const {
    const std::string indent = selection_.indent(range_.begin);
    return node_.branches.empty() ? indent + "  " : selection_.indent(beginOf(tree_.list(node_.branches)[0]));
  }

  const Selection& selection_;
  const Tree& tree_;
  Range range_;
  const CaseStmt& node_;
};

}  // namespace

void addConversionsOfChains(const Selection& selection, std::vector<CodeAction>& actions) {
  if (const StmtId chain = statementOf(selection, StmtKind::If)) Chain(selection, chain).add(actions);
  if (const StmtId cases = statementOf(selection, StmtKind::Case)) {
    Cases(selection, cases).addMissing(actions);
    Cases(selection, cases).addChain(actions);
  }
}

}  // namespace rung::ide

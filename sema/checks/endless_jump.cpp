// SPDX-License-Identifier: Apache-2.0
// Warns of a jump back to statements from which no path leads to the end of the body, to a RETURN or out of a loop: the
// task never ends. TM/TP manual 5.2.4 (its example 5.15) and 5.4.3.7.
//   passes  again: n := n + 1; IF n < 3 THEN JMP again; END_IF
//   warns   again: n := n + 1; JMP again;                             W0887
// Called at the end of each body of any language, after checkJumpLabels. Conditions count as undecided; a FOR or WHILE
// may always end, because a constant condition has a warning of its own (W0756). Linear in the statements.
#include "sema/bodies/body.h"
#include "sema/bodies/limits.h"
#include "sema/checks/rules.h"
#include "sema/shorthands.h"

#include <algorithm>

namespace rung::sema {

namespace {

// The flow from statement to statement. Node 0 is the end of the body; the others are in the order of the source.
class Flow {
 public:
  explicit Flow(Context& context) : context_(context), tree_(context.tree()) {}

  void walk(Slice<StmtId> body) { list(body, kEnd, kEnd, kEnd); }
  void report();

 private:
  using Node = uint32_t;
  static constexpr Node kEnd = 0;
  struct Edge {
    Node to, from;
  };
  struct Jump {
    const JumpStmt* stmt;
    Node node, target;  // the end for an unknown label
  };
  struct Label {
    NameId name;
    Node node;
  };

  // Adds the statements, after which comes `next`; returns the first of them. An EXIT goes to `outside`, a CONTINUE to
  // `again`.
  Node list(Slice<StmtId> statements, Node next, Node outside, Node again);
  void statement(StmtId id, Node node, Node next, Node outside, Node again);
  void edge(Node from, Node to) { edges_.push_back({to, from}); }
  void mark(Node first, Node Edge::*here, Node Edge::*there, std::vector<bool>& marked) const;

  Context& context_;
  const Tree& tree_;
  Node last_ = kEnd;
  uint32_t depth_ = 0;
  std::vector<Edge> edges_;
  std::vector<Jump> jumps_;
  std::vector<Label> labels_;
};

Flow::Node Flow::list(Slice<StmtId> statements, Node next, Node outside, Node again) {
  if (statements.empty() || depth_ == kMaxStmtDepth) return next;
  ++depth_;
  const Node first = ++last_;
  Node node = first;
  const auto all = tree_.list(statements);
  for (size_t i = 0; i < all.size(); ++i) {
    // What a statement contains is numbered before its follower, which therefore gets a joint of its own.
    const bool is_last = i + 1 == all.size();
    const Node joint = is_last ? next : ++last_;
    statement(all[i], node, joint, outside, again);
    if (is_last) break;
    node = ++last_;
    edge(joint, node);
  }
  --depth_;
  return first;
}

void Flow::statement(StmtId id, Node node, Node next, Node outside, Node again) {
  const auto branch = [&](Slice<StmtId> body) { edge(node, list(body, next, outside, again)); };
  const auto loop = [&](Slice<StmtId> body) {
    edge(node, next);
    edge(node, list(body, node, next, node));
  };
  switch (tree_.kind(id)) {
    case StmtKind::If:
      for (const IfBranch& one : tree_.list(tree_.as<IfStmt>(id).branches)) branch(one.body);
      return branch(tree_.as<IfStmt>(id).otherwise);
    case StmtKind::Case:
      for (const CaseBranch& one : tree_.list(tree_.as<CaseStmt>(id).branches)) branch(one.body);
      return branch(tree_.as<CaseStmt>(id).otherwise);
    case StmtKind::For: return loop(tree_.as<ForStmt>(id).body);
    case StmtKind::While: return loop(tree_.as<WhileStmt>(id).body);
    case StmtKind::Repeat: return loop(tree_.as<RepeatStmt>(id).body);
    case StmtKind::Try: {
      const TryStmt& node_of_try = tree_.as<TryStmt>(id);
      edge(node, next);  // a fault may end anything inside
      branch(node_of_try.body);
      branch(node_of_try.handler);
      return branch(node_of_try.finally);
    }
    case StmtKind::Exit: return edge(node, outside);
    case StmtKind::Continue: return edge(node, again);
    case StmtKind::Return: return edge(node, kEnd);
    case StmtKind::Jump: jumps_.push_back({&tree_.as<JumpStmt>(id), node, kEnd}); return;
    case StmtKind::Label:
      labels_.push_back({context_.names().key(tree_.as<LabelStmt>(id).label.name), node});
      return edge(node, next);
    case StmtKind::Error:
    case StmtKind::Empty:
    case StmtKind::Assign:
    case StmtKind::Call: return edge(node, next);
  }
}

// Marks `first` and the nodes that the edges, sorted by `here`, lead to.
void Flow::mark(Node first, Node Edge::*here, Node Edge::*there, std::vector<bool>& marked) const {
  std::vector<Node> open{first};
  marked[first] = true;
  while (!open.empty()) {
    const Node node = open.back();
    open.pop_back();
    auto at = std::lower_bound(edges_.begin(), edges_.end(), node, [&](const Edge& a, Node b) { return a.*here < b; });
    for (; at != edges_.end() && (*at).*here == node; ++at) {
      const Node next = (*at).*there;
      if (!marked[next]) open.push_back(next);
      marked[next] = true;
    }
  }
}

void Flow::report() {
  const auto byName = [](const Label& a, const Label& b) { return a.name.index < b.name.index; };
  std::stable_sort(labels_.begin(), labels_.end(), byName);
  for (Jump& jump : jumps_) {
    const Label wanted{context_.names().key(jump.stmt->label.name), kEnd};
    const auto found = std::lower_bound(labels_.begin(), labels_.end(), wanted, byName);
    if (found != labels_.end() && found->name == wanted.name) jump.target = found->node;
    edge(jump.node, jump.target);
  }
  const auto sortBy = [&](Node Edge::*key) {
    std::sort(edges_.begin(), edges_.end(), [&](const Edge& a, const Edge& b) { return a.*key < b.*key; });
  };
  std::vector<bool> is_done(last_ + 1);  // leads to the end, or belongs to a loop that was reported
  sortBy(&Edge::to);
  mark(kEnd, &Edge::to, &Edge::from, is_done);
  if (std::all_of(jumps_.begin(), jumps_.end(), [&](const Jump& jump) { return is_done[jump.node]; })) return;
  sortBy(&Edge::from);
  for (const Jump& jump : jumps_) {
    if (is_done[jump.node] || jump.target > jump.node) continue;
    mark(jump.node, &Edge::from, &Edge::to, is_done);
    context_.report(diag::EndlessJump, jump.stmt->label.loc, {string(context_, jump.stmt->label.name)});
  }
}

}  // namespace

void checkEndlessJumps(Context& context) {
  const BodyState& body = *context.body;
  if (body.labels.empty() || body.jumps.empty()) return;
  Flow flow(context);
  flow.walk(body.statements);
  flow.report();
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Two rules, applied from the last statement to the first, so that the statements after are already structured:
//   IF c THEN JMP l; END_IF  s…  l:            becomes   IF NOT c THEN s… END_IF  l:
//   IF c THEN r… JMP l; END_IF  s…  l:         becomes   IF c THEN r… ELSE s… END_IF  l:
// where s contains no label. A jump to the label that follows it is removed, and so is a label without jumps. Backward
// jumps stay, and so do jumps that would nest too deeply for compilers.
#include "frontend/schedule/il_structure.h"

#include <algorithm>
#include <unordered_map>

#include "frontend/syntax/tree_builder.h"

namespace rung::text {
namespace {

constexpr uint32_t kMaxIfDepth = 40;

class Structurer {
 public:
  Structurer(Tree& tree, const Names& names, std::vector<StmtId>& statements)
      : tree_(tree), names_(names), from_(statements) {}

  void run();

 private:
  struct Resolved {
    StmtId statement;
    uint32_t depth;
  };
  uint32_t key(const Ident& label) const { return names_.key(label.name).index; }
  bool countJumps();
  const Ident* jumpAt(StmtId statement) const {
    return tree_.kind(statement) == StmtKind::Jump ? &tree_.as<JumpStmt>(statement).label : nullptr;
  }
  void flushPending(StmtId statement);
  size_t findLabel(const Ident& label) const;
  void left(const Ident& label, size_t at);
  Slice<StmtId> takeUpTo(size_t at, uint32_t& depth);

  Tree& tree_;
  const Names& names_;
  std::vector<StmtId>& from_;
  std::vector<Resolved> out_;                     // in reverse: the last one is the next to run
  std::unordered_map<uint32_t, uint32_t> jumps_;  // by label
};

// False: a duplicate label, which is reported when jumps are checked.
bool Structurer::countJumps() {
  std::unordered_map<uint32_t, bool> labels;
  for (const StmtId statement : from_) {
    if (tree_.kind(statement) == StmtKind::Label &&
        !labels.insert({key(tree_.as<LabelStmt>(statement).label), true}).second)
      return false;
    if (const Ident* label = jumpAt(statement)) ++jumps_[key(*label)];
    if (tree_.kind(statement) != StmtKind::If) continue;
    for (const IfBranch& branch : tree_.list(tree_.as<IfStmt>(statement).branches))
      for (const StmtId inner : tree_.list(branch.body))
        if (const Ident* label = jumpAt(inner)) ++jumps_[key(*label)];
  }
  return true;
}

// The index of a label in out_ when no other label precedes it, else out_.size().
size_t Structurer::findLabel(const Ident& label) const {
  for (size_t i = out_.size(); i-- > 0;) {
    if (tree_.kind(out_[i].statement) != StmtKind::Label) continue;
    return key(tree_.as<LabelStmt>(out_[i].statement).label) == key(label) ? i : out_.size();
  }
  return out_.size();
}

// Removes a jump to the label at this index.
void Structurer::left(const Ident& label, size_t at) {
  if (--jumps_[key(label)] == 0) out_.erase(out_.begin() + static_cast<std::ptrdiff_t>(at));
}

// Takes out the statements before the label.
Slice<StmtId> Structurer::takeUpTo(size_t at, uint32_t& depth) {
  std::vector<StmtId> list;
  for (size_t i = out_.size(); i-- > at + 1;) {
    list.push_back(out_[i].statement);
    depth = std::max(depth, out_[i].depth);
  }
  out_.resize(at + 1);
  return tree_.addList<StmtId>(list);
}

void Structurer::flushPending(StmtId statement) {
  if (const Ident* label = jumpAt(statement)) {
    const size_t at = findLabel(*label);
    if (at < out_.size() && at + 1 == out_.size()) return left(Ident(*label), at);
    out_.push_back({statement, 0});
    return;
  }
  if (tree_.kind(statement) != StmtKind::If) {
    out_.push_back({statement, 0});
    return;
  }
  IfStmt node = tree_.as<IfStmt>(statement);
  const IfBranch branch = tree_.list(node.branches)[0];
  std::vector<StmtId> body(tree_.list(branch.body).begin(), tree_.list(branch.body).end());
  const Ident* const jump =
      body.empty() || node.branches.count > 1 || !node.otherwise.empty() ? nullptr : jumpAt(body.back());
  const size_t at = jump == nullptr ? out_.size() : findLabel(*jump);
  uint32_t depth = 0;
  for (size_t i = at + 1; i < out_.size(); ++i) depth = std::max(depth, out_[i].depth);
  if (at >= out_.size() || depth >= kMaxIfDepth) {
    out_.push_back({statement, 1});
    return;
  }
  const Ident label = *jump;
  body.pop_back();
  depth = 0;
  const Slice<StmtId> skipped = takeUpTo(at, depth);
  IfBranch created = branch;
  node.otherwise = {};
  if (body.empty()) {
    const Loc loc = tree_.loc(branch.condition);
    if (tree_.kind(branch.condition) == ExprKind::Unary && tree_.as<UnaryExpr>(branch.condition).op() == UnaryOp::Not)
      created.condition = tree_.as<UnaryExpr>(branch.condition).operand;
    else
      created.condition = TreeBuilder(tree_).unary(UnaryOp::Not, branch.condition, loc);
    created.body = skipped;
  } else {
    created.body = tree_.addList<StmtId>(body);
    node.otherwise = skipped;
  }
  left(label, at);
  node.branches = tree_.addList<IfBranch>({&created, 1});
  flushPending(tree_.add<StmtId>(node));
  out_.back().depth = depth + 1;
}

void Structurer::run() {
  if (!countJumps() || jumps_.empty()) return;
  out_.reserve(from_.size());
  for (size_t i = from_.size(); i-- > 0;) flushPending(from_[i]);
  from_.clear();
  for (size_t i = out_.size(); i-- > 0;) from_.push_back(out_[i].statement);
}

}  // namespace

void structureJumps(Tree& tree, const Names& names, std::vector<StmtId>& statements) {
  Structurer(tree, names, statements).run();
}

}  // namespace rung::text

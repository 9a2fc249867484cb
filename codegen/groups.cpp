// SPDX-License-Identifier: Apache-2.0
// Cuts the bodies into groups: see group.h. A POU and the initialiser of its record stay together. Once a group holds
// kLeast POUs, it ends before the first name whose hash asks for it, so a new POU changes one group only.
#include <algorithm>

#include "codegen/group.h"
#include "codegen/names.h"
#include "frontend/source/names.h"
#include "ir/walk.h"

namespace rung::codegen {

namespace {

constexpr uint32_t kLeast = 32, kUsual = 32, kMax = 128;

struct Row {
  std::string key;  // in lower case
  uint32_t kind;
  ir::BodyId body;
};

}  // namespace

std::vector<Group> makeGroups(const ir::Module& module, const Facts& facts) {
  std::vector<Row> rows;
  rows.reserve(module.bodies.size());
  for (uint32_t i = 1; i < module.bodies.size(); ++i) {
    const ir::Body& body = module.bodies[i];
    if (body.native || body.cpp != 0 || body.abstract || facts.is_inlined[i] != 0 || facts.is_zeroing[i] != 0) continue;
    rows.push_back({foldedIdentifier(module.names.string(body.name)), static_cast<uint32_t>(body.kind), ir::BodyId{i}});
  }
  std::sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
    if (a.key != b.key) return a.key < b.key;
    if (a.kind != b.kind) return a.kind < b.kind;
    return module.types.info(module.body(a.body).self).record_kind <
           module.types.info(module.body(b.body).self).record_kind;
  });

  std::vector<Group> groups;
  uint32_t pous = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const bool is_new = i == 0 || rows[i].key != rows[i - 1].key;
    const bool cut = is_new && (pous >= kMax || (pous >= kLeast && nameHash(rows[i].key) % kUsual == 0));
    if (groups.empty() || cut) {
      groups.emplace_back();
      groups.back().stem =
          groups.size() == 1 ? "code" : "code_" + fileStem(module.names.string(module.body(rows[i].body).name));
      pous = 0;
    }
    pous += is_new;
    groups.back().bodies.push_back(rows[i].body);
  }
  return groups;
}

namespace {

constexpr size_t kHotStmts = 16, kHotExprs = 100;

bool isSmallLeaf(const ir::Body& body) {
  if (body.native || body.cpp != 0 || body.has_labels || body.stmts.size() > kHotStmts || body.exprs.size() > kHotExprs)
    return false;
  return std::none_of(body.stmts.begin(), body.stmts.end(), [](const ir::Stmt& stmt) {
    return stmt.kind == ir::StmtKind::Call || stmt.kind == ir::StmtKind::Loop || stmt.kind == ir::StmtKind::For ||
           stmt.kind == ir::StmtKind::Try;
  });
}

void markCalls(const ir::Module& module, const ir::Body& body, ir::StmtId first, bool in_loop, Marks& marks,
               uint32_t group_number) {
  for (ir::StmtId id = first; id; id = body.stmt(id).next) {
    const ir::Stmt& stmt = body.stmt(id);
    const auto* call = stmt.tryAs<ir::CallStmt>();
    if (in_loop && call != nullptr && isSmallLeaf(module.body(call->callee)))
      marks.hot[call->callee.index] = group_number;
    const bool loops = in_loop || stmt.kind == ir::StmtKind::Loop || stmt.kind == ir::StmtKind::For;
    ir::forEachBlock(body, stmt, [&](ir::StmtId block) { markCalls(module, body, block, loops, marks, group_number); });
  }
}

}  // namespace

void markHot(const ir::Module& module, const Group& group, Marks& marks, uint32_t group_number) {
  for (ir::BodyId id : group.bodies)
    markCalls(module, module.body(id), module.body(id).first, false, marks, group_number);
}

}  // namespace rung::codegen

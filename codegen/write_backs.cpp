// SPDX-License-Identifier: Apache-2.0
// The fields to write back before calls: see write_backs.h. One walk in the order of execution; after a loop, and in a
// body with labels, all that the loop or the body writes counts as written.
#include "codegen/write_backs.h"

#include <algorithm>

#include "ir/walk.h"

namespace rung::codegen {

using ir::Stmt;
using ir::StmtId;

namespace {

class Walk {
 public:
  Walk(const ir::Module& module, const ir::Body& body, const Uses& uses, const CachedFields& fields)
      : module_(module), body_(body), uses_(uses), fields_(fields), dirty_(uses.variables.count()) {}

  WriteBacks run() {
    if (body_.has_labels) markWritten(body_.first);
    block(body_.first);
    std::sort(found_.calls.begin(), found_.calls.end(),
              [](const WriteBacks::Call& a, const WriteBacks::Call& b) { return a.call.index < b.call.index; });
    return std::move(found_);
  }

 private:
  using Dirty = std::vector<uint8_t>;  // by variable: 1 when its place in memory may be old

  void markOwn(const Stmt& stmt) {
    ir::forEachRoot(module_, body_, stmt, [&](ir::ExprId root, ir::Use use) {
      const uint32_t number = use == ir::Use::Read ? kNoVariable : uses_.variables.at(root);
      if (number != kNoVariable && fields_.is_cached[number] != 0) dirty_[number] = 1;
    });
  }

  void markWritten(StmtId first) {
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      markOwn(body_.stmt(id));
      ir::forEachBlock(body_, body_.stmt(id), [&](StmtId inner) { markWritten(inner); });
    }
  }

  void block(StmtId first) {
    for (StmtId id = first; id; id = body_.stmt(id).next) statement(id, body_.stmt(id));
  }

  void statement(StmtId id, const Stmt& stmt) {
    if (const auto* call = stmt.tryAs<ir::CallStmt>(); call != nullptr && mayFault(*call)) writeBack(id);
    const bool loops = stmt.kind == ir::StmtKind::For || stmt.kind == ir::StmtKind::Loop;
    markOwn(stmt);
    if (loops) ir::forEachBlock(body_, stmt, [&](StmtId inner) { markWritten(inner); });
    Dirty before, after;  // only of a statement with blocks
    ir::forEachBlock(body_, stmt, [&](StmtId inner) {
      if (before.empty()) before = after = dirty_;
      dirty_ = before;
      block(inner);
      for (size_t i = 0; i < after.size(); ++i) after[i] |= dirty_[i];
    });
    if (!before.empty()) dirty_ = std::move(after);
  }

  bool mayFault(const ir::CallStmt& call) const { return call.is_virtual || module_.body(call.callee).may_fault; }

  void writeBack(StmtId id) {
    WriteBacks::Call call{id, {}};
    for (uint32_t i = uses_.variables.localCount(); i < dirty_.size(); ++i) {
      if (dirty_[i] != 0) call.fields.push_back(i);
    }
    if (call.fields.empty()) return;
    found_.calls.push_back(std::move(call));
    if (!body_.has_labels) dirty_.assign(dirty_.size(), 0);
  }

  const ir::Module& module_;
  const ir::Body& body_;
  const Uses& uses_;
  const CachedFields& fields_;
  Dirty dirty_;
  WriteBacks found_;
};

}  // namespace

WriteBacks analyzeWriteBacks(const ir::Module& module, const ir::Body& body, const Uses& uses,
                             const CachedFields& fields) {
  if (!uses.has_leaving_calls || std::count(fields.is_cached.begin(), fields.is_cached.end(), 1) == 0) return {};
  return Walk(module, body, uses, fields).run();
}

const WriteBacks::Call* WriteBacks::find(StmtId call) const {
  const auto it = std::lower_bound(calls.begin(), calls.end(), call,
                                   [](const Call& a, StmtId id) { return a.call.index < id.index; });
  return it != calls.end() && it->call == call ? &*it : nullptr;
}

std::string WriteBacks::toString(const Variables& variables) const {
  std::string out;
  for (const Call& call : calls) {
    std::vector<std::string> rows(variables.count());
    for (const uint32_t field : call.fields) rows[field] = " before call";
    out += variables.lines(rows);
  }
  return out;
}

}  // namespace rung::codegen

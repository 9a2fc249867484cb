// The estimate of a body's work: see effort.h.
#include "codegen/effort.h"

#include <algorithm>

#include "ir/walk.h"

namespace rung::codegen {

namespace {

using ir::ExprId;
using ir::ExprKind;
using ir::Stmt;
using ir::StmtId;
using ir::StmtKind;

constexpr uint64_t kSmall = 8;      // statements
constexpr uint64_t kLoopShare = 3;  // work in loops per statement of the body
constexpr uint64_t kSearch = 8, kCounted = 256,
                   kMostWork = 1u << 20;  // turns of a WHILE, of a FOR with variable bounds

struct Work {
  uint64_t statements = 0, runs = 0;
};

uint64_t turns(const ir::Body& body, const Stmt& loop) {
  if (loop.kind == StmtKind::Loop) return kSearch;
  const ir::Expr &from = body.expr(ExprId{loop.b}), &to = body.expr(ExprId{loop.c}), &step = body.expr(ExprId{loop.d});
  if (from.kind != ExprKind::Const || to.kind != ExprKind::Const) return kCounted;
  const auto by = static_cast<int64_t>(step.bits());
  const uint64_t way = by < 0 ? from.bits() - to.bits() : to.bits() - from.bits();
  return way / (by < 0 ? 0 - static_cast<uint64_t>(by) : static_cast<uint64_t>(by)) + 1;
}

void add(const ir::Body& body, StmtId first, uint64_t times, Work& work) {
  for (StmtId id = first; id; id = body.stmt(id).next) {
    const Stmt& stmt = body.stmt(id);
    work.statements += 1;
    work.runs += times;
    const bool loops = stmt.kind == StmtKind::Loop || stmt.kind == StmtKind::For;
    const uint64_t inner = loops ? std::min(times * std::min(turns(body, stmt), kMostWork), kMostWork) : times;
    ir::forEachBlock(body, stmt, [&](const uint32_t& block) { add(body, StmtId{block}, inner, work); });
  }
}

}  // namespace

bool isStraight(const ir::Body& body) {
  if (body.library || body.has_labels) return false;
  Work work;
  add(body, body.first, 1, work);
  return work.statements > kSmall && work.runs <= (1 + kLoopShare) * work.statements;
}

}  // namespace rung::codegen

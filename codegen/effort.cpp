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
                   kMaxWork = 1u << 20;  // iterations of a WHILE, or of a FOR with variable bounds

struct Work {
  uint64_t statements = 0, runs = 0;
  bool loops = false;
};

uint64_t iterations(const ir::Body& body, const Stmt& loop) {
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
    work.loops |= loops;
    const uint64_t inner = loops ? std::min(times * std::min(iterations(body, stmt), kMaxWork), kMaxWork) : times;
    ir::forEachBlock(body, stmt, [&](const uint32_t& block) { add(body, StmtId{block}, inner, work); });
  }
}

}  // namespace

Effort effortFor(const ir::Body& body) {
  if (body.kind == ir::BodyKind::Init && !body.library) return Effort::Straight;
  Work work;
  add(body, body.first, 1, work);
  const bool is_straight =
      !body.library && !body.has_labels && work.statements > kSmall && work.runs <= (1 + kLoopShare) * work.statements;
  if (is_straight) return Effort::Straight;
  return work.loops || body.has_labels ? Effort::Loops : Effort::Plain;
}

}  // namespace rung::codegen

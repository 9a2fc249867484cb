// SPDX-License-Identifier: Apache-2.0
// The estimate of a body's work: see effort.h.
#include "codegen/effort.h"

#include <algorithm>

#include "ir/walk.h"

namespace rung::codegen {

namespace {

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
  const auto* counted = loop.tryAs<ir::ForStmt>();
  if (counted == nullptr) return kSearch;
  if (!ir::isConst(body.expr(counted->from)) || !ir::isConst(body.expr(counted->to))) return kCounted;
  const uint64_t from = ir::bitsOf(body.expr(counted->from)), to = ir::bitsOf(body.expr(counted->to));
  const auto by = static_cast<int64_t>(ir::bitsOf(body.expr(counted->step)));
  const uint64_t way = by < 0 ? from - to : to - from;
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
    ir::forEachBlock(body, stmt, [&](StmtId block) { add(body, block, inner, work); });
  }
}

}  // namespace

Effort effortFor(const ir::Body& body, bool measures_strings) {
  if (body.kind == ir::BodyKind::Init && !body.library) return Effort::Straight;
  Work work;
  add(body, body.first, 1, work);
  const bool is_straight = !body.library && !body.has_labels &&
                           !(measures_strings && body.kind == ir::BodyKind::Function) && work.statements > kSmall &&
                           work.runs <= (1 + kLoopShare) * work.statements;
  if (is_straight) return Effort::Straight;
  if (!work.loops && !body.has_labels) return Effort::Plain;
  const bool has_checks = std::any_of(body.exprs.begin(), body.exprs.end(),
                                      [](const ir::Expr& e) { return (e.checks & ir::kCheckIndex) != 0; });
  return has_checks ? Effort::CheckedLoops : Effort::Loops;
}

}  // namespace rung::codegen

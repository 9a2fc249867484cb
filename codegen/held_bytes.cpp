// SPDX-License-Identifier: Apache-2.0
// See held_bytes.h. Follows the statements of each block with the bytes that are held there, and lets go of one at the
// first statement that may reach it in another way, or leave the block.
#include "codegen/held_bytes.h"

#include <algorithm>

#include "ir/walk.h"

namespace rung::codegen {

using ir::Expr;
using ir::ExprId;
using ir::ExprKind;
using ir::ImageExpr;
using ir::Stmt;
using ir::StmtId;
using ir::StmtKind;

namespace {

constexpr size_t kMostHeld = 4;  // at once: each takes a register
constexpr uint32_t kFewest = 2;  // stores that make a variable worth its load and store

class CoilFollower {
 public:
  CoilFollower(const ir::Module& module, const ir::Body& body) : module_(module), body_(body) {}

  HeldBytes run() {
    uint32_t coils = 0;
    for (const Stmt& stmt : body_.stmts) coils += isCoil(stmt) ? 1 : 0;
    if (coils < kFewest) return {};
    is_opaque_.resize(body_.stmts.size());
    findOpaque(body_.first);
    block(body_.first);
    HeldBytes held;
    for (const Found& found : found_)
      if (found.stores >= kFewest) held.push_back(found.byte);
    return held;
  }

 private:
  struct Range {
    uint32_t area;
    uint64_t begin, end;  // bytes
  };
  struct Found {
    HeldByte byte;
    uint8_t touched = 0;  // bits that were read, or written in some cases only
    uint32_t stores = 0;
  };

  bool isCoil(const Stmt& stmt) const {
    const auto* assign = stmt.tryAs<ir::AssignStmt>();
    return assign != nullptr && ir::isImageBit(body_.expr(assign->place));
  }

  // Tells whether an expression may reach memory that it does not name, or fault.
  bool isOpaque(ExprId root) const {
    bool opaque = false;
    ir::forEachExpr(body_, root, [&](ExprId id) {
      const Expr& e = body_.expr(id);
      const uint32_t* local = ir::localOf(e);
      opaque = opaque || e.checks != 0 || e.kind == ExprKind::Deref || e.kind == ExprKind::Call ||
               e.kind == ExprKind::Address || ir::isReference(module_, body_, e) ||
               (local != nullptr && body_.locals[*local].by_reference);
    });
    return opaque;
  }

  // Marks the statements after which nothing is held: those that may reach any byte, and those that may leave.
  bool findOpaque(StmtId first) {
    bool any = false;
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt& stmt = body_.stmt(id);
      bool opaque = stmt.kind != StmtKind::None && stmt.kind != StmtKind::Assign && stmt.kind != StmtKind::If &&
                    stmt.kind != StmtKind::Switch;
      ir::forEachRoot(module_, body_, stmt, [&](ExprId root, ir::Use) { opaque = opaque || isOpaque(root); });
      ir::forEachBlock(body_, stmt, [&](StmtId inner) { opaque = findOpaque(inner) || opaque; });
      is_opaque_[id.index] = opaque ? 1 : 0;
      any = any || opaque;
    }
    return any;
  }

  void block(StmtId first) {
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt& stmt = body_.stmt(id);
      if (is_opaque_[id.index] == 0) {
        at_ = id;
        prepare(stmt);
        follow(stmt, true);
        continue;
      }
      open_.clear();
      ir::forEachBlock(body_, stmt, [&](StmtId inner) {
        block(inner);
        open_.clear();
      });
    }
  }

  template <class F>
  void forEachImage(const Stmt& stmt, F&& f) const {
    ir::forEachRoot(module_, body_, stmt, [&](ExprId root, ir::Use use) {
      ir::forEachExpr(body_, root, [&](ExprId id) {
        const Expr& e = body_.expr(id);
        if (e.kind == ExprKind::Image) f(e, use);
      });
    });
  }

  // Before a statement is followed: lets go of the bytes that it reaches otherwise, and holds those whose bits it
  // writes.
  void prepare(const Stmt& stmt) {
    reached_.clear();
    collectReached(stmt);
    std::erase_if(open_,
                  [&](uint32_t number) { return isReached(found_[number].byte.area, found_[number].byte.byte); });
    openStored(stmt);
  }

  void collectReached(const Stmt& stmt) {
    forEachImage(stmt, [&](const Expr& e, ir::Use) {
      const auto& image = e.as<ImageExpr>();
      if (ir::isImageBit(e)) return;
      const uint64_t size = module_.types.info(module_.types.resolve(e.type)).size;
      reached_.push_back({image.area, image.byte, image.byte + size});
    });
    ir::forEachBlock(body_, stmt, [&](StmtId first) {
      for (StmtId id = first; id; id = body_.stmt(id).next) collectReached(body_.stmt(id));
    });
  }
  bool isReached(uint32_t area, uint32_t byte) const {
    return std::any_of(reached_.begin(), reached_.end(), [&](const Range& range) {
      return range.area == area && byte >= range.begin && byte < range.end;
    });
  }

  void openStored(const Stmt& stmt) {
    if (isCoil(stmt)) {
      const auto& image = body_.expr(stmt.as<ir::AssignStmt>().place).as<ImageExpr>();
      if (find(image) == open_.end() && !isReached(image.area, image.byte)) {
        if (open_.size() == kMostHeld) open_.erase(open_.begin());
        open_.push_back(static_cast<uint32_t>(found_.size()));
        found_.push_back({{at_, at_, image.area, image.byte, 0}, 0, 0});
      }
    }
    ir::forEachBlock(body_, stmt, [&](StmtId first) {
      for (StmtId id = first; id; id = body_.stmt(id).next) openStored(body_.stmt(id));
    });
  }

  // Notes the bits that are read and written, in this order. `always`: it runs whenever its block does.
  void follow(const Stmt& stmt, bool always) {
    forEachImage(stmt, [&](const Expr& e, ir::Use use) {
      const auto at = find(e.as<ImageExpr>());
      if (at == open_.end() || use != ir::Use::Read) return;
      found_[*at].touched |= static_cast<uint8_t>(1u << e.as<ImageExpr>().bit);
    });
    if (isCoil(stmt)) store(body_.expr(stmt.as<ir::AssignStmt>().place).as<ImageExpr>(), always);
    ir::forEachBlock(body_, stmt, [&](StmtId first) {
      for (StmtId id = first; id; id = body_.stmt(id).next) follow(body_.stmt(id), false);
    });
  }

  void store(const ImageExpr& image, bool always) {
    const auto at = find(image);
    if (at == open_.end()) return;
    Found& found = found_[*at];
    const auto bit = static_cast<uint8_t>(1u << image.bit);
    found.byte.last = at_;
    found.stores += 1;
    if (always && (found.touched & bit) == 0) found.byte.cleared |= bit;
    found.touched |= bit;
  }

  std::vector<uint32_t>::iterator find(const ImageExpr& image) {
    return std::find_if(open_.begin(), open_.end(), [&](uint32_t number) {
      return found_[number].byte.area == image.area && found_[number].byte.byte == image.byte;
    });
  }

  const ir::Module& module_;
  const ir::Body& body_;
  std::vector<uint8_t> is_opaque_;  // by statement
  std::vector<Found> found_;
  std::vector<uint32_t> open_;  // those of found_ that are held now
  StmtId at_;                   // the statement of the block that is looked at
  std::vector<Range> reached_;  // by it, other than by bits
};

}  // namespace

HeldBytes analyzeHeldBytes(const ir::Module& module, const ir::Body& body) { return CoilFollower(module, body).run(); }

}  // namespace rung::codegen

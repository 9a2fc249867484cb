// See image_writes.h. A walk over all bodies that the task can reach; of a virtual call, all that it may call.
#include "ir/image_writes.h"

#include <algorithm>

#include "ir/walk.h"

namespace rung::ir {
namespace {

class Walk {
 public:
  explicit Walk(const Module& module) : module_(module), listed_(module.bodies.size()) {}

  void addRoots(uint32_t task) {
    for (const ProgramInstance& program : module_.programs) {
      if (program.task != task + 1) continue;
      note(program.run ? program.run : program.body);
      note(program.setup);
    }
    for (const BlockTask& block : module_.block_tasks)
      if (block.task == task + 1) note(block.run);
  }

  std::vector<rung_write> run() {
    for (size_t i = 0; i < bodies_.size(); ++i) scan(module_.body(bodies_[i]));
    return disjoint();
  }

 private:
  void note(BodyId id) {
    if (!id || listed_[id.index]) return;
    listed_[id.index] = true;
    bodies_.push_back(id);
  }

  void scan(const Body& body) {
    for (size_t e = 1; e < body.exprs.size(); ++e) {
      const Expr& expr = body.exprs[e];
      if (const auto* call = expr.tryAs<CallExpr>()) note(call->callee);
      if (const auto* address = expr.tryAs<AddressExpr>()) add(body, address->place);
    }
    for (size_t s = 1; s < body.stmts.size(); ++s) {
      const Stmt& stmt = body.stmts[s];
      if (const auto* call = stmt.tryAs<CallStmt>()) noteCall(*call);
      forEachRoot(module_, body, stmt, [&](ExprId root, Use use) {
        if (use != Use::Read) add(body, root);
      });
    }
    if (body.cpp != 0)
      for (const BodyId function : module_.cpp_bodies[body.cpp - 1].functions) note(function);
  }

  void noteCall(const CallStmt& call) {
    note(call.callee);
    if (!call.is_virtual) return;
    const auto row =
        std::lower_bound(module_.dispatches.begin(), module_.dispatches.end(), call.callee,
                         [](const Dispatch& dispatch, BodyId method) { return dispatch.method.index < method.index; });
    if (row == module_.dispatches.end() || !(row->method == call.callee)) return;
    for (const BodyId body : row->bodies) note(body);
  }

  // The whole variable that the place is in.
  void add(const Body& body, ExprId place) {
    const Expr& root = body.expr(rootOf(body, place));
    const auto* image = root.tryAs<ImageExpr>();
    if (image == nullptr || module_.areas[image->area].owner == types::AreaOwner::Input) return;
    const bool is_bit = image->bit != kNoBit;
    const auto size = is_bit ? 1 : static_cast<uint32_t>(module_.types.info(module_.types.resolve(root.type)).size);
    found_.push_back(
        {static_cast<uint8_t>(image->area), static_cast<uint8_t>(is_bit ? 1u << image->bit : 255u), image->byte, size});
  }

  std::vector<rung_write> disjoint() {
    std::sort(found_.begin(), found_.end(), [](const rung_write& a, const rung_write& b) {
      if (a.area != b.area) return a.area < b.area;
      if (a.offset != b.offset) return a.offset < b.offset;
      return (a.mask == 255) > (b.mask == 255);  // whole bytes first
    });
    std::vector<rung_write> all;
    for (const rung_write& next : found_) {
      rung_write* const last = all.empty() || all.back().area != next.area ? nullptr : &all.back();
      const bool is_inside = last != nullptr && next.offset < last->offset + last->size;
      if (is_inside && last->mask == 255) {
        const uint32_t end = std::max(last->offset + last->size, next.offset + next.size);
        last->size = end - last->offset;
      } else if (is_inside) {
        last->mask = static_cast<uint8_t>(last->mask | next.mask);
      } else if (last != nullptr && last->mask == 255 && next.mask == 255 && next.offset == last->offset + last->size) {
        last->size += next.size;
      } else {
        all.push_back(next);
      }
    }
    return all;
  }

  const Module& module_;
  std::vector<bool> listed_;
  std::vector<BodyId> bodies_;
  std::vector<rung_write> found_;
};

}  // namespace

std::vector<rung_write> imageWrites(const Module& module, uint32_t task) {
  Walk walk(module);
  walk.addRoots(task);
  return walk.run();
}

}  // namespace rung::ir

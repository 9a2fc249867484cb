// SPDX-License-Identifier: Apache-2.0
// See image_writes.h.
#include "ir/image_writes.h"

#include <algorithm>

#include "ir/reachable.h"
#include "ir/walk.h"

namespace rung::ir {
namespace {

class Writes {
 public:
  explicit Writes(const Module& module) : module_(module) {}

  void addBody(const Body& body) {
    for (size_t e = 1; e < body.exprs.size(); ++e)
      if (const auto* address = body.exprs[e].tryAs<AddressExpr>()) add(body, address->place);
    for (size_t s = 1; s < body.stmts.size(); ++s)
      forEachRoot(module_, body, body.stmts[s], [&](ExprId root, Use use) {
        if (use != Use::Read) add(body, root);
      });
    if (body.cpp == 0) return;
    for (const CppBody::Variable& variable : module_.cpp_bodies[body.cpp - 1].variables)
      if (variable.in_image && !variable.constant) add(variable.index, variable.offset, variable.bit, variable.type);
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

 private:
  // The whole variable that the place is in.
  void add(const Body& body, ExprId place) {
    const Expr& root = body.expr(rootOf(body, place));
    if (const auto* image = root.tryAs<ImageExpr>()) add(image->area, image->byte, image->bit, root.type);
  }
  void add(uint32_t area, uint32_t byte, uint32_t bit, TypeId type) {
    if (module_.areas[area].owner == types::AreaOwner::Input) return;
    const bool is_bit = bit != kNoBit;
    const auto size = is_bit ? 1 : static_cast<uint32_t>(module_.types.info(module_.types.resolve(type)).size);
    found_.push_back({static_cast<uint8_t>(area), static_cast<uint8_t>(is_bit ? 1u << bit : 255u), byte, size});
  }

  const Module& module_;
  std::vector<rung_write> found_;
};

}  // namespace

std::vector<rung_write> imageWrites(const Module& module, uint32_t task) {
  Writes writes(module);
  for (const BodyId body : reachableBodies(module, rootsOfTask(module, task))) writes.addBody(module.body(body));
  return writes.disjoint();
}

}  // namespace rung::ir

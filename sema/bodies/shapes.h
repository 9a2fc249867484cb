// What the schedulers of IL, diagrams and NCT may ask (frontend/syntax/shapes.h), answered from the declarations.
// In: names and paths of a body as parsed. Out: kinds and pins; the path itself is not marked or changed.
// Made by schedule.cpp for each body that is not in ST.
#pragma once

#include <deque>
#include <unordered_map>
#include <vector>

#include "frontend/syntax/shapes.h"
#include "sema/context.h"

namespace rung::sema {

class ProjectShapes final : public Shapes {
 public:
  explicit ProjectShapes(Context& context) : context_(context) {}
  Shape of(NameId name) override;
  Shape of(ExprId path) override;

 private:
  // What a part of a path is: a thing with a name, or a value of a type.
  struct Place {
    Entity entity;
    TypeId type;
  };
  Place placeOf(ExprId path);
  Place placeOf(Entity entity);
  Place memberOf(const Place& base, NameId member);
  Shape shapeOf(const Place& place);
  Shape shapeOf(PouId pou, ShapeKind kind);
  TypeId plainType(TypeId type) const;

  Context& context_;
  std::unordered_map<uint32_t, std::vector<PinShape>> pins_;  // by PouId
};

}  // namespace rung::sema

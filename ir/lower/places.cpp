// SPDX-License-Identifier: Apache-2.0
// Lowering of lvalues: variables, fields, elements, image views. In: checked expressions. Out: IR place expressions.
#include "ir/lower/lowering.h"

namespace rung::ir {

// The VAR_TEMP of a base in the initial value of another one, as this body or action has it.
sema::VarId PlaceLowering::ownTemporary(sema::VarId id) const {
  if (project_.var(id).section != SectionKind::Temp || !pou_ || project_.var(id).pou == pou_) return {};
  for (sema::PouId at = in_.objectOf(pou_); at; at = project_.pou(at).base)
    for (const sema::VarId own : project_.pou(at).vars)
      if (project_.var(own).sharing.copy_of == id && (at == pou_ || project_.var(own).sharing.field)) return own;
  return {};
}

ExprId PlaceLowering::varPlace(sema::VarId id, Loc loc) {
  const sema::Var* var = &project_.var(id);
  if (var->external) var = &project_.var(id = var->external);
  TypeId type = fieldType(*var);
  switch (var->storage) {
    case sema::Storage::Field: {
      for (const auto& [pin, edge] : state_.edge_locals)
        if (pin == id.index) return local(edge, loc);
      if (!var->pou) return field(self(loc), var->field, type, loc);
      for (sema::PouId at = pou_ ? in_.objectOf(pou_) : sema::PouId{}; at; at = project_.pou(at).base)
        if (at == var->pou) return field(asBase(self(loc), at, loc), var->field, type, loc);
      // A variable of another program, named through the program.
      uint32_t instance = in_.instances.instanceOf(var->pou);
      TypeId record = in_.module.programs[instance].record;
      return field(add(loc, record, ProgramExpr{.program = instance}), var->field, type, loc);
    }
    case sema::Storage::Local: {
      if (var->sharing.field) return varPlace(var->sharing.field, loc);
      if (const sema::VarId own = ownTemporary(id)) return varPlace(own, loc);
      const bool belongs = var->pou == pou_ || var->temporary != 0;
      if (!belongs || var->field >= state_.local_of.size() || state_.local_of[var->field] == 0) {
        const std::string_view name = project_.names.string(var->name);
        setPhaseSubject(name.data(), name.size());
        RUNG_INVARIANT(false, "only the body that declares this variable names it");
      }
      return local(state_.local_of[var->field] - 1, loc);
    }
    case sema::Storage::Global: {
      uint32_t list = in_.instances.listIndex(var->list);
      ExprId base = add(loc, in_.module.lists[list].record, GlobalExpr{.list = list});
      return field(base, var->field, type, loc);
    }
    case sema::Storage::Image:
      return add(loc, type,
                 ImageExpr{.area = var->image.area.index,
                           .byte = var->image.byte,
                           .bit = var->image.is_bit ? var->image.bit : kNoBit});
    case sema::Storage::Constant: return ofValue(var->value, loc);
  }
  return {};
}

// Tells whether a member is a field of what is before it; else that only says where its name is declared.
bool PlaceLowering::isField(const MemberExpr& node, const sema::Var& var) const {
  if (var.storage != sema::Storage::Field) return false;
  const TypeId base = strip(sema::typeOf(tree_, node.base));
  if (base && types_.kind(base) == TypeKind::Record) return true;
  if (tree_.kind(node.base) != rung::ExprKind::Name) return false;
  // `two.limit` of a program's second instance
  return sema::meaning(tree_, node.base).entity.entityKind() == sema::EntityKind::Program;
}

ExprId PlaceLowering::fieldOf(ExprId record, const sema::Var& var, Loc loc) {
  if (var.pou) record = asBase(record, var.pou, loc);
  return field(record, var.field, fieldType(var), loc);
}

ExprId PlaceLowering::memberPlace(rung::ExprId id) {
  const MemberExpr& node = tree_.as<MemberExpr>(id);
  if (sema::meaning(node.h).entity.entityKind() != sema::EntityKind::Var) return values().lowerValue(id);
  const sema::VarId var{sema::meaning(node.h).entity.index};
  if (!isField(node, project_.var(var))) return varPlace(var, node.h.loc);
  return fieldOf(lowerPlace(node.base), project_.var(var), node.h.loc);
}

PlaceLowering::Instance PlaceLowering::lowerInstance(rung::ExprId id, sema::VarId memory) {
  const Loc loc = tree_.loc(id);
  if (tree_.kind(id) == rung::ExprKind::Member) {
    const MemberExpr& node = tree_.as<MemberExpr>(id);
    const sema::Var& var = project_.var({sema::meaning(node.h).entity.index});
    if (isField(node, var)) {
      const ExprId owner = stable(lowerPlace(node.base));
      return {fieldOf(copy(owner), var, loc), fieldOf(owner, project_.var(memory), loc)};
    }
  }
  return {stable(lowerPlace(id)), varPlace(memory, loc)};
}

TypeId PlaceLowering::fieldType(const sema::Var& var) const { return var.bits.is_bit ? types::kByte : strip(var.type); }

// The memory of a place as a variable of another type: a structure as the one that it extends, an array as one with
// other bounds, an enumeration as its base.
ExprId PlaceLowering::seenAs(ExprId place, TypeId type, Loc loc) {
  const TypeKind from = types_.kind(typeOf(place)), to = types_.kind(type);
  const bool is_part = from == to && (to == TypeKind::Record || to == TypeKind::Array) && typeOf(place) != type;
  if (!is_part && (from != TypeKind::Enum || to == TypeKind::Enum)) return place;
  const TypeId own = types_.pointer(typeOf(place)), wanted = types_.pointer(type);
  types_.layout(own);
  types_.layout(wanted);
  const ExprId address = add(loc, own, AddressExpr{.place = place});
  return add(loc, type, DerefExpr{.pointer = add(loc, wanted, ConvertExpr{.operand = address})});
}

ExprId PlaceLowering::pinPlace(ExprId instance, const sema::Var& pin, Loc loc) {
  const ExprId place = field(asBase(instance, pin.pou, loc), pin.field, fieldType(pin), loc);
  if (!pin.bits.is_bit) return place;
  return add(loc, types::kBool, BitsExpr{.base = place, .position = pin.bits.bit});
}

// A string as the array of its bytes or words, including the final zero where it is only read; or of its characters,
// which count from 1.
ExprId PlaceLowering::characters(ExprId string, TypeId unit, bool writes) {
  const Expr place = body_.expr(string);
  const types::TypeInfo& info = types_.info(types_.resolve(place.type));
  const bool from_one = types_.kind(unit) == TypeKind::Char || types_.kind(unit) == TypeKind::WChar;
  const types::Dimension range{from_one ? 1 : 0, int64_t{info.length} - (writes && !from_one ? 1 : 0)};
  if (!isPlace(place.kind)) string = toTemp(string, place.loc);
  const TypeId array = types_.array(unit, {&range, 1});
  const TypeId pointer = types_.pointer(array);
  types_.layout(array);
  types_.layout(pointer);
  string = add(place.loc, pointer, AddressExpr{.place = string});
  return add(place.loc, array, DerefExpr{.pointer = string});
}

ExprId PlaceLowering::named(rung::ExprId id) {
  const Loc loc = tree_.loc(id);
  const sema::Entity entity = sema::meaning(tree_, id).entity;
  switch (entity.entityKind()) {
    case sema::EntityKind::Var: {
      const sema::VarId var{entity.index};
      if (state_.result_local != kNoBit && var == project_.pou(pou_).result_var) return local(state_.result_local, loc);
      const ExprId place = varPlace(var, loc);
      in_.noteGlobal(body_, place, var);
      return place;
    }
    case sema::EntityKind::Pou: return programPlace(in_.instances.instanceOf({entity.index}), loc);
    case sema::EntityKind::Program: return programPlace(in_.instances.programOf(entity.index), loc);
    case sema::EntityKind::None:
    case sema::EntityKind::Error:
    case sema::EntityKind::Type:
    case sema::EntityKind::EnumValue:
    case sema::EntityKind::GlobalList:
    case sema::EntityKind::Property:
    case sema::EntityKind::Namespace: return values().lowerValue(id);
  }
  return {};
}

ExprId PlaceLowering::indexed(const rung::IndexExpr& node) {
  if (isOpenArray(types_, sema::typeOf(tree_, node.base))) return openArrayElement(node);
  ExprId base = lowerPlace(node.base);
  if (TypeTable::isString(types_.kind(body_.expr(base).type)))
    base = characters(base, strip(sema::meaning(node.h).type), sema::meaning(node.h).writes_character);
  std::vector<ExprId> indices;
  for (rung::ExprId index : tree_.list(node.indices)) {
    InsertionPoint point = here();
    ExprId value = values().lowerUncut(index);
    spillPlace(point, base);
    for (ExprId& earlier : indices) spill(point, {&earlier});
    indices.push_back(value);
  }
  return add(node.h.loc, strip(sema::meaning(node.h).type), IndexExpr{.base = base, .indices = list(indices)},
             static_cast<uint8_t>(in_.options.checks & kCheckIndex));
}

ExprId PlaceLowering::dereferenced(rung::ExprId id) {
  const Loc loc = tree_.loc(id);
  const rung::ExprId target = tree_.as<rung::DerefExpr>(id).base;
  if (tree_.kind(target) == rung::ExprKind::This) return self(loc);
  if (tree_.kind(target) == rung::ExprKind::Super) return asBase(self(loc), project_.pou(in_.objectOf(pou_)).base, loc);
  const ExprId pointer = values().lowerValue(target);
  return add(loc, strip(sema::typeOf(tree_, id)), DerefExpr{.pointer = pointer},
             static_cast<uint8_t>(in_.options.checks & kCheckNull));
}

ExprId PlaceLowering::directAddress(rung::ExprId id) {
  const DirectAddress& address = tree_.as<rung::AddressExpr>(id).address;
  auto path = tree_.list(address.path);
  TypeId type = strip(sema::typeOf(tree_, id));
  uint32_t width = TypeTable::bitWidth(types_.kind(type));
  uint32_t byte = path.empty() ? 0 : path[0];
  uint32_t bit = kNoBit;
  if (width == 1) {
    bit = path.size() > 1 ? path[1] : 0;
    if (path.size() == 1) {  // %IX5 is byte 0, bit 5
      bit = byte % 8;
      byte = byte / 8;
    }
  } else {
    byte *= width / 8;
  }
  const uint32_t area = types::findArea(project_.options.areas, address.area)->index;
  return add(tree_.loc(id), type, ImageExpr{.area = area, .byte = byte, .bit = bit});
}

ExprId PlaceLowering::lowerPlace(rung::ExprId id) {
  const rung::ExprKind kind = tree_.kind(id);
  switch (shape(kind)) {
    case ExprShape::Step: return lowerStep(id);
    case ExprShape::Leaf:
      if (kind == rung::ExprKind::Name) return named(id);
      return kind == rung::ExprKind::Address ? directAddress(id) : values().lowerValue(id);
    case ExprShape::Operation:
    case ExprShape::Initializer:
    case ExprShape::Inserted: return values().lowerValue(id);
  }
  return {};
}

ExprId PlaceLowering::lowerStep(rung::ExprId id) {
  const rung::ExprKind kind = tree_.kind(id);
  if (kind == rung::ExprKind::Member) return memberPlace(id);
  if (kind == rung::ExprKind::Index) return indexed(tree_.as<rung::IndexExpr>(id));
  if (kind == rung::ExprKind::Deref) return dereferenced(id);
  const BitAccessExpr& node = tree_.as<BitAccessExpr>(id);
  const ExprId base = lowerPlace(node.base);
  return add(node.h.loc, strip(sema::meaning(node.h).type), BitsExpr{.base = base, .position = node.position});
}

}  // namespace rung::ir

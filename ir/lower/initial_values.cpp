// SPDX-License-Identifier: Apache-2.0
// Lowering of initial values. In: checked initialisers and type defaults. Out: assignments that give a place its
// initial value; arrays of constants become one blob of bytes.
#include <algorithm>
#include <cstring>

#include "ir/lower/lowering.h"
#include "sema/declarations/constants.h"

namespace rung::ir {

namespace {

uint64_t elementCount(const TypeInfo& array) {
  uint64_t count = 1;
  for (const types::Dimension& d : array.dimensions) count *= d.count();
  return count;
}

bool storeString(const TypeTable& types, TypeId type, std::string_view string, uint8_t* to) {
  const TypeInfo& info = types.info(types.resolve(type));
  if (info.kind != TypeKind::WString) {
    size_t length = std::min<size_t>(string.size(), info.length);
    if (info.kind == TypeKind::UString && length < string.size())  // cut between characters
      while (length > 0 && (static_cast<unsigned char>(string[length]) & 0xc0) == 0x80) --length;
    std::copy_n(string.data(), length, to);  // an empty string may have no address
    return true;
  }
  uint32_t unit = 0;
  for (size_t i = 0; i < string.size() && unit < info.length;) {
    unsigned char lead = static_cast<unsigned char>(string[i]);
    uint32_t code = lead;
    size_t extra = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : 0;
    if (extra > 0) code = lead & (0x3fu >> extra);
    for (size_t k = 1; k <= extra && i + k < string.size(); ++k)
      code = (code << 6) | (static_cast<unsigned char>(string[i + k]) & 0x3fu);
    i += extra + 1;
    auto put = [&](uint32_t value) {
      to[2 * unit] = static_cast<uint8_t>(value);
      to[2 * unit + 1] = static_cast<uint8_t>(value >> 8);
      ++unit;
    };
    if (code >= 0x10000) {  // two units, of which the first may stay
      put(0xd800 + ((code - 0x10000) >> 10));
      if (unit < info.length) put(0xdc00 + ((code - 0x10000) & 0x3ff));
    } else {
      put(code);
    }
  }
  return true;
}

bool storeScalar(const TypeTable& types, const Value& value, TypeId type, uint8_t* to) {
  TypeKind kind = types.plainKind(type);
  uint32_t width = TypeTable::bitWidth(kind);
  if (width == 0) return false;
  uint64_t bits = value.bits;
  if (kind == TypeKind::Real) {
    float single = static_cast<float>(value.asReal());
    uint32_t single_bits;
    std::memcpy(&single_bits, &single, sizeof single);
    bits = single_bits;
  }
  for (uint32_t i = 0; i < (width + 7) / 8; ++i) to[i] = static_cast<uint8_t>(bits >> (8 * i));
  return true;
}

}  // namespace

// The bytes of a type's default. False: not expressible as bytes (it needs code).
bool ObjectLowering::writeDefault(TypeId declared, uint8_t* to) {
  for (TypeId t = declared;; t = types_.info(t).base) {
    if (t.index < project_.type_inits.size() && project_.type_inits[t.index])
      return writeBytes(declared, project_.type_inits[t.index], to);
    if (types_.info(t).kind != TypeKind::Alias) break;
  }
  TypeId type = strip(declared);
  const TypeInfo& info = types_.info(type);
  if (info.kind == TypeKind::Array) {
    uint64_t count = elementCount(info), size = types_.info(strip(info.base)).size;
    if (count == 0 || in_.records.isZero(info.base)) return true;
    if (!writeDefault(info.base, to)) return false;
    for (uint64_t i = 1; i < count; ++i) std::memcpy(to + i * size, to, size);
    return true;
  }
  if (info.kind == TypeKind::Record) {
    if (in_.records.isZero(type)) return true;
    if (info.record_kind == types::RecordKind::FunctionBlock || info.record_kind == types::RecordKind::Program)
      return false;
    bool has_inits = type.index < project_.field_inits.size();
    for (size_t i = 0; i < info.fields.size(); ++i) {
      rung::ExprId init;
      if (has_inits && i < project_.field_inits[type.index].size()) init = project_.field_inits[type.index][i];
      uint8_t* at = to + info.fields[i].offset;
      if (!(init ? writeBytes(info.fields[i].type, init, at) : writeDefault(info.fields[i].type, at))) return false;
    }
    return true;
  }
  if (types_.plainKind(type) == TypeKind::Pointer || types_.plainKind(type) == TypeKind::Reference) return true;
  Value value = types::defaultValue(types_, in_.module.names, type);
  if (TypeTable::isString(types_.plainKind(type))) return true;
  return storeScalar(types_, value, type, to);
}

bool ObjectLowering::writeBytes(TypeId type, rung::ExprId init, uint8_t* to) {
  type = strip(type);
  if (tree_.kind(init) == rung::ExprKind::ArrayInit) return writeArray(type, init, to);
  if (tree_.kind(init) == rung::ExprKind::StructInit) {
    const sema::PouId object = in_.records.pouOf(type);
    if ((object && project_.pou(object).base) || !writeDefault(type, to)) return false;
    const TypeInfo& info = types_.info(type);
    for (const FieldInit& given : tree_.list(tree_.as<StructInitExpr>(init).fields)) {
      bool found = false;
      for (const types::Field& f : info.fields)
        if (project_.names.same(f.name, given.field.name)) {
          found = true;
          std::memset(to + f.offset, 0, types_.info(strip(f.type)).size);
          if (!writeBytes(f.type, given.value, to + f.offset)) return false;
        }
      if (!found) return false;  // a property
    }
    return true;
  }
  auto value = sema::constantOf(project_, init);
  if (!value) return false;
  if (TypeTable::isString(types_.plainKind(type)))
    return storeString(types_, type, project_.names.string(NameId{static_cast<uint32_t>(value->bits)}), to);
  if (!TypeTable::isScalar(types_.plainKind(type))) return false;
  return storeScalar(types_, types::convert(types_, *value, type).value, type, to);
}

// Array initial values fill the elements in row-major order; missing elements get the default, surplus values are
// dropped (syntax manual 5.3.3; sema warns).
bool ObjectLowering::writeArray(TypeId type, rung::ExprId init, uint8_t* to) {
  const TypeInfo& info = types_.info(type);
  TypeId element = info.base;
  const uint64_t size = types_.info(strip(element)).size, count = elementCount(info);
  uint64_t next = 0;
  bool ok = true;
  auto fill = [&](auto& self_fill, std::span<const rung::ExprId> elements) -> void {
    for (rung::ExprId item : elements) {
      if (!ok || next >= count) return;
      if (tree_.kind(item) == rung::ExprKind::Repeat) {
        const RepeatExpr& repeat = tree_.as<RepeatExpr>(item);
        auto times = sema::constantOf(project_, repeat.count);
        if (!times) {
          ok = false;
          return;
        }
        uint64_t begin = next;
        uint64_t repetitions = times->bits;
        if (repeat.elements.empty()) {
          for (uint64_t i = 0; i < repetitions && next < count && ok; ++i)
            ok = writeDefault(element, to + next++ * size);
          continue;
        }
        if (repetitions == 0) continue;
        self_fill(self_fill, tree_.list(repeat.elements));
        uint64_t group = next - begin;
        for (uint64_t i = group; i < group * repetitions && next < count; ++i, ++next)
          std::memcpy(to + next * size, to + (next - group) * size, size);
        continue;
      }
      ok = writeBytes(element, item, to + next++ * size);
    }
  };
  fill(fill, tree_.list(tree_.as<ArrayInitExpr>(init).elements));
  for (; ok && next < count; ++next) ok = writeDefault(element, to + next * size);
  return ok;
}

void ObjectLowering::forEachElement(ExprId array, TypeId type, Loc loc, uint32_t dimension,
                                    std::vector<ExprId>& indices, FunctionRef<void(ExprId)> store, bool backwards) {
  const TypeInfo& info = types_.info(type);
  if (dimension == info.dimensions.size()) {
    store(element(array, indices, loc));
    return;
  }
  ExprId control = temp(types::kDInt, loc);
  indices.push_back(copy(control));
  StmtId body = block([&] { forEachElement(array, type, loc, dimension + 1, indices, store, backwards); });
  indices.pop_back();
  const types::Dimension range = types_.info(type).dimensions[dimension];
  auto bound = [&](int64_t value) { return constant(types::kDInt, static_cast<uint64_t>(value), loc); };
  append(loc, ForStmt{.control = control,
                      .from = bound(backwards ? range.high : range.low),
                      .to = bound(backwards ? range.low : range.high),
                      .step = bound(backwards ? -1 : 1),
                      .body_block = body});
}

void ObjectLowering::storeInitialRecord(ExprId place, TypeId type, rung::ExprId init) {
  if (BodyId initializer = in_.initOf(type))
    append(body_.expr(place).loc, CallStmt{.callee = initializer, .self = copy(place)});
  construct(place, type);
  if (init) storeMembers(place, init);
  callAfterInit(place, type);
}

// The base of an object that is being made: the whole is not made yet.
bool ObjectLowering::isBasePart(ExprId place) const {
  while (const auto* index = body_.expr(place).tryAs<IndexExpr>()) place = index->base;
  const auto* part = body_.expr(place).tryAs<FieldExpr>();
  if (part == nullptr) return false;
  const sema::PouId derived = in_.records.pouOf(typeOf(part->base));
  return derived && project_.pou(derived).object.base_var &&
         project_.var(project_.pou(derived).object.base_var).field == part->field;
}

// When FB_Init has run and the values of the declaration are set. CODESYS, "Attribute: call_after_init".
void ObjectLowering::callAfterInit(ExprId place, TypeId type) {
  const sema::PouId object = in_.records.pouOf(type);
  if (!object || isBasePart(place)) return;
  rung::CallExpr node{};
  node.h.loc = body_.expr(place).loc;
  for (const sema::PouId method : in_.calledAfterInit(object)) {
    sema::Call call;
    call.kind = sema::CallKind::Method;
    call.pou = method;
    calls().lowerFunctionCall(call, node, nullptr, asBase(copy(place), project_.pou(method).owner, node.h.loc));
  }
}

// The variable to which a place belongs, if its declaration gives arguments to FB_Init.
const sema::Var* ObjectLowering::constructedVar(ExprId place) const {
  while (const auto* index = body_.expr(place).tryAs<IndexExpr>()) place = index->base;
  const Expr& at = body_.expr(place);
  if (const auto* part = at.tryAs<FieldExpr>()) return in_.records.constructedVar(typeOf(part->base), part->field);
  const uint32_t* index = localOf(at);
  if (index == nullptr || !pou_) return nullptr;
  for (sema::VarId id : project_.pou(pou_).vars) {
    const sema::Var& var = project_.var(id);
    if (var.storage != sema::Storage::Local || var.sharing.field || state_.local_of[var.field] != *index + 1) continue;
    const sema::Var& declared = var.sharing.copy_of ? project_.var(var.sharing.copy_of) : var;
    if (declared.start.constructor.index != 0) return &declared;
  }
  return nullptr;
}

// FB_Init of an instance whose declared values are set, those of its bases first. Codesys.
void ObjectLowering::construct(ExprId place, TypeId type) {
  const sema::PouId object = in_.records.pouOf(type);
  if (!object) return;
  const std::vector<sema::PouId> methods = in_.lifeMethodsOf(object, "FB_Init");
  if (methods.empty()) return;
  if (isBasePart(place)) return;
  ExprId whole = place;
  while (const auto* index = body_.expr(whole).tryAs<IndexExpr>()) whole = index->base;
  const Expr at = body_.expr(whole);
  sema::CallId given;
  if (at.kind == ExprKind::Deref) {
    given = state_.given;
  } else if (const sema::Var* var = constructedVar(place)) {
    given = var->start.constructor;
    if (var->start.element_constructors != 0) given.index += state_.element;
  }
  rung::CallExpr node{};
  node.h.loc = at.loc;
  const std::vector<sema::Binding> none;
  const std::vector<sema::Binding>& bindings = given.index ? project_.call(given).bindings : none;
  const ExprId copies = isCopied(place);
  for (sema::PouId method : methods) {
    sema::Call call;
    call.kind = sema::CallKind::Method;
    call.pou = method;
    for (sema::VarId pin : project_.pou(method).vars)  // a base's parameters by their names
      for (const sema::Binding& binding : bindings)
        if (project_.names.same(project_.var(binding.pin).name, project_.var(pin).name)) {
          call.bindings.push_back(binding);
          call.bindings.back().pin = pin;
        }
    calls().lowerFunctionCall(call, node, nullptr, asBase(copy(place), project_.pou(method).owner, at.loc), copies);
  }
}

// A member that is a property: its SET is called. False for other members.
bool ObjectLowering::setProperty(ExprId place, const FieldInit& given) {
  const sema::PouId object = in_.records.pouOf(typeOf(place));
  for (sema::PouId at = object; at; at = project_.pou(at).base)
    for (const uint32_t index : project_.pou(at).object.properties) {
      const sema::Property& property = project_.properties[index];
      if (!property.set || !project_.names.same(property.name, given.field.name)) continue;
      rung::CallExpr node{};
      node.h.loc = body_.expr(place).loc;
      sema::Call call;
      call.kind = sema::CallKind::Method;
      call.pou = property.set;
      for (const sema::VarId id : project_.pou(property.set).vars)
        if (project_.var(id).section == SectionKind::Input && call.bindings.empty())
          call.bindings.push_back({.pin = id, .value = given.value});
      calls().lowerFunctionCall(call, node, nullptr, asBase(copy(place), project_.pou(property.set).owner, node.h.loc));
      return true;
    }
  return false;
}

// The values that a declaration gives to members of a record whose other values are set.
void ObjectLowering::storeMembers(ExprId place, rung::ExprId init) {
  Loc loc = body_.expr(place).loc;
  for (uint32_t g = 0; g < tree_.as<StructInitExpr>(init).fields.count; ++g) {
    const FieldInit given = tree_.list(tree_.as<StructInitExpr>(init).fields)[g];
    if (setProperty(place, given)) continue;
    ExprId holder = place;
    for (bool found = false; !found;) {  // the member may be inherited
      const TypeInfo& info = types_.info(typeOf(holder));
      for (uint32_t i = 0; i < info.fields.size() && !found; ++i) {
        if (!project_.names.same(info.fields[i].name, given.field.name)) continue;
        found = true;
        const TypeId type = info.fields[i].type;
        const ExprId member = field(copy(holder), i, type, loc);
        if (in_.records.pouOf(strip(type)) && tree_.kind(given.value) == rung::ExprKind::StructInit)
          storeMembers(member, given.value);
        else
          storeInitial(member, type, given.value, false);
      }
      const sema::PouId object = in_.records.pouOf(typeOf(holder));
      if (!object || !project_.pou(object).base) break;
      holder = asBase(copy(holder), project_.pou(object).base, loc);
    }
  }
}

// An element by its number, counted row by row.
ExprId ObjectLowering::elementAt(ExprId array, uint64_t number, Loc loc) {
  const TypeInfo& info = types_.info(typeOf(array));
  std::vector<ExprId> at(info.dimensions.size());
  for (size_t d = info.dimensions.size(); d-- > 0;) {
    const types::Dimension& dimension = info.dimensions[d];
    at[d] = constant(types::kDInt,
                     static_cast<uint64_t>(dimension.low + static_cast<int64_t>(number % dimension.count())), loc);
    number /= dimension.count();
  }
  return element(array, at, loc);
}

void ObjectLowering::storeInitialArray(ExprId place, TypeId type, rung::ExprId init, bool place_is_zero) {
  Loc loc = body_.expr(place).loc;
  const TypeInfo& info = types_.info(type);
  std::vector<uint8_t> bytes(info.size);
  bool constant_bytes = init ? writeBytes(type, init, bytes.data()) : writeDefault(type, bytes.data());
  if (constant_bytes) {
    bool all_zero = true;
    for (uint8_t b : bytes) all_zero = all_zero && b == 0;
    if (all_zero) {
      if (!place_is_zero) assign(place, zero(type, loc), loc);
      return;
    }
    if (storeRepeated(place, type, bytes, place_is_zero)) return;
    in_.module.data.push_back({type, std::move(bytes)});
    uint32_t index = static_cast<uint32_t>(in_.module.data.size() - 1);
    assign(place, add(loc, type, DataExpr{.index = index}), loc);
    return;
  }
  // Elements that need code: FB instances, and types that hold them.
  if (const sema::Var* var = constructedVar(place); var != nullptr && var->start.element_constructors != 0) {
    const bool whole = body_.expr(place).kind != ExprKind::Index;
    if (whole) state_.element = 0;
    for (uint64_t i = 0; i < elementCount(info); ++i) {
      storeInitial(elementAt(copy(place), i, loc), info.base, {}, false);
      if (in_.records.pouOf(strip(info.base))) ++state_.element;
    }
  } else {
    std::vector<ExprId> indices;
    forEachElement(copy(place), type, loc, 0, indices,
                   [&](ExprId element) { storeInitial(element, info.base, {}, false); });
  }
  if (!init || tree_.kind(init) != rung::ExprKind::ArrayInit) return;
  // The elements that the initialiser lists, one by one.
  std::vector<rung::ExprId> items;
  uint64_t count = elementCount(info);
  auto flatten = [&](auto& self_flatten, std::span<const rung::ExprId> elements) -> void {
    for (rung::ExprId item : elements) {
      if (items.size() >= count) return;
      if (tree_.kind(item) != rung::ExprKind::Repeat) {
        items.push_back(item);
        continue;
      }
      const RepeatExpr& repeat = tree_.as<RepeatExpr>(item);
      auto times = sema::constantOf(project_, repeat.count);
      for (uint64_t i = 0; times && i < times->bits && items.size() < count; ++i) {
        if (repeat.elements.empty())
          items.push_back({});
        else
          self_flatten(self_flatten, tree_.list(repeat.elements));
      }
    }
  };
  flatten(flatten, tree_.list(tree_.as<ArrayInitExpr>(init).elements));
  for (uint64_t i = 0; i < items.size() && i < count; ++i) {
    if (!items[i]) continue;
    const ExprId element = elementAt(copy(place), i, loc);
    storeInitial(element, info.base, items[i], false);
  }
}

void ObjectLowering::storeInitial(ExprId place, TypeId declared, rung::ExprId init, bool place_is_zero) {
  Loc loc = body_.expr(place).loc;
  if (!init)
    for (TypeId t = declared;; t = types_.info(t).base) {
      if (t.index < project_.type_inits.size() && project_.type_inits[t.index]) {
        init = project_.type_inits[t.index];
        break;
      }
      if (types_.info(t).kind != TypeKind::Alias) break;
    }
  TypeId type = strip(declared);
  if (!init && in_.records.isZero(type)) {
    if (!place_is_zero) assign(place, zero(type, loc), loc);
    return;
  }
  TypeKind kind = types_.kind(type);
  if (kind == TypeKind::Array && (!init || tree_.kind(init) == rung::ExprKind::ArrayInit))
    return storeInitialArray(place, type, init, place_is_zero);
  if (kind == TypeKind::Record && (!init || tree_.kind(init) == rung::ExprKind::StructInit))
    return storeInitialRecord(place, type, init);
  if (!init) {
    Value value = types::defaultValue(types_, in_.module.names, type);
    assign(place, ofValue(value, loc), loc);
    return;
  }
  ExprId value = convertValue(values().lowerValue(init), type, loc);
  const Expr& expr = body_.expr(value);
  if (place_is_zero && isConst(expr) && bitsOf(expr) == 0) return;
  // The stack is not zero: the unit after the last character, which a program may write alone.
  if (types::TypeTable::isString(kind) && body_.expr(place).kind == ExprKind::Local)
    assign(copy(place), zero(type, loc), loc);
  assign(place, value, loc);
}

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// Initial values of variables, fields and types: lists for arrays, members for structures and instances, and one
// constant for elementary types. In: the expression as written and the type. Out: the same, checked and converted in
// place; surplus array elements are removed and repetition counts are literals.
#include "sema/declarations/initial_values.h"

#include <algorithm>
#include <array>

#include "sema/declarations/bit_members.h"
#include "sema/declarations/call_graph.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/expressions.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/variables.h"
#include "sema/diagnostics.h"
#include "sema/fixes.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

struct Initializer {
  Context& context;
  std::string_view what;  // "the initial value of `x`"
  InitialReads may = InitialReads::Constants;
  bool reads = false;   // variables
  bool broken = false;  // an element could not be parsed: the intended number is unknown

  const Tree& tree() const { return context.tree(); }

  // The literals of long lists, without a full check.
  bool plainLiteral(ExprId id, TypeId type) const {
    if (tree().kind(id) != ExprKind::Literal) return false;
    const LiteralExpr& literal = tree().as<LiteralExpr>(id);
    if (literal.prefix || literal.form.is_negative) return false;
    const TypeKind kind = context.types().kind(type);
    bool ok = false;
    if (literal.literal() == LiteralKind::Integer) {
      if (kind == TypeKind::Bool) {
        ok = literal.value() <= 1;
      } else if (TypeTable::isInteger(kind) || TypeTable::isBits(kind)) {
        const uint32_t width = TypeTable::bitWidth(kind) - (context.types().isSigned(kind) ? 1u : 0u);
        ok = width >= 64 || (literal.value() >> width) == 0;
      }
    } else if (literal.literal() == LiteralKind::Bool) {
      ok = kind == TypeKind::Bool;
    } else if (literal.literal() == LiteralKind::Real) {
      ok = kind == TypeKind::LReal;
    }
    if (!ok) return false;
    meaning(literal.h).type = type;
    meaning(literal.h).is_constant = 1;
    return true;
  }

  // A variable that has its value before this one is set: a global one, one of the same instance, a part of these.
  bool isReadable(ExprId id, uint32_t depth) {
    if (may == InitialReads::Constants) return false;
    reads = true;
    const ExprKind kind = tree().kind(id);
    if (kind == ExprKind::Name || kind == ExprKind::Member) {
      const Entity entity = kind == ExprKind::Name ? meaning(tree(), id).entity : meaning(tree(), id).entity;
      if (entity.entityKind() != EntityKind::Var) return false;
      const Storage storage = context.symbols.vars[entity.index].storage;
      if (storage == Storage::Global || storage == Storage::Image) return true;
      if (storage != Storage::Field || may == InitialReads::Globals) return false;
      return kind == ExprKind::Name || isReadable(tree().as<MemberExpr>(id).base, depth + 1);
    }
    if (kind == ExprKind::Index) {
      for (const ExprId index : tree().list(tree().as<IndexExpr>(id).indices))
        if (!isStatic(index, depth + 1)) return false;
      return isReadable(tree().as<IndexExpr>(id).base, depth + 1);
    }
    if (kind == ExprKind::Deref) return isReadable(tree().as<DerefExpr>(id).base, depth + 1);
    if (kind == ExprKind::BitAccess) return isReadable(tree().as<BitAccessExpr>(id).base, depth + 1);
    return kind == ExprKind::This || kind == ExprKind::Address;
  }

  // Allowed in an initial value: constants, operators and functions on them, addresses, and readable variables.
  bool isStatic(ExprId id, uint32_t depth) {
    if (depth > 1000) return false;
    const ExprHeader& header = tree().expr(id);
    if (meaning(header).type == types::kError) return true;
    const ExprKind kind = header.kind;
    switch (shape(kind)) {
      case ExprShape::Leaf:
        if (kind == ExprKind::Literal || kind == ExprKind::Error) return true;
        if (kind == ExprKind::Address) return isReadable(id, depth + 1);
        return (kind == ExprKind::Name || kind == ExprKind::TypedName) && isKnown(id, depth);
      case ExprShape::Step: return kind == ExprKind::Member ? isKnown(id, depth) : isReadable(id, depth + 1);
      case ExprShape::Operation: return isStaticOperation(id, depth);
      case ExprShape::Inserted:
        return kind == ExprKind::AddressOf ||
               (kind == ExprKind::Convert && isStatic(tree().as<ConvertExpr>(id).operand, depth + 1));
      case ExprShape::Initializer: return false;
    }
    return false;
  }

  bool isKnown(ExprId id, uint32_t depth) { return evaluate(context, id).has_value() || isReadable(id, depth + 1); }

  bool isStaticOperation(ExprId id, uint32_t depth) {
    const ExprKind kind = tree().kind(id);
    if (kind == ExprKind::Unary) return isStatic(tree().as<UnaryExpr>(id).operand, depth + 1);
    if (kind == ExprKind::Binary)
      return isStatic(tree().as<BinaryExpr>(id).left, depth + 1) &&
             isStatic(tree().as<BinaryExpr>(id).right, depth + 1);
    if (kind != ExprKind::Call) return false;
    const Meaning& known = context.meaning(id);
    if (!known.call) return true;
    const Call& call = context.symbols.call(known.call);
    if (call.kind != CallKind::Function && call.kind != CallKind::Operator) return false;
    return std::all_of(call.bindings.begin(), call.bindings.end(), [&](const Binding& binding) {
      return !binding.is_output && (!binding.value || isStatic(binding.value, depth + 1));
    });
  }

  // Forbids initial values that are not known before the program runs. IEC 61131-3 ed. 3, 6.5.1.2. In codesys they may
  // read other variables (initial_order.cpp), but not those of another program; variables of one call (of functions,
  // VAR_TEMP) are set when the call begins, and may read anything known then.
  //   fails   VAR a : INT; b : INT := a; END_VAR in a block of iec2 or iec3      E0325
  Fix withoutBrackets(ExprId list) const {
    if (tree().kind(list) != ExprKind::ArrayInit || tree().as<ArrayInitExpr>(list).elements.count != 1) return {};
    const ExprId element = tree().list(tree().as<ArrayInitExpr>(list).elements)[0];
    const Range all = sourceRange(context, list), value = sourceRange(context, element);
    if (!(all.begin < all.end) || !(value.begin < value.end)) return {};
    return {"Remove the brackets", {{all.begin, value.begin, {}}, {value.end, all.end, {}}}, true};
  }
  void scalar(ExprId& init, TypeId type) {
    const ExprKind kind = tree().kind(init);
    if (kind == ExprKind::ArrayInit || kind == ExprKind::StructInit || kind == ExprKind::Repeat) {
      context.report(diag::ListForOneValue, tree().loc(init), {context.types().toString(type)})
          .fix(withoutBrackets(init));
      init = {};
      return;
    }
    if (plainLiteral(init, type)) return;
    if (context.types().kind(type) == TypeKind::Reference) {
      if (!context.expressions->bindReference(context, init, type)) init = {};
      return;
    }
    if (!context.expressions->checkAs(context, init, type, std::string("used as ") + std::string(what))) return;
    const TypeKind to = context.types().kind(type);
    if (to == TypeKind::Pointer) {
      reads |= may == InitialReads::Variables && !isStatic(init, 0);
      return;
    }
    if (may == InitialReads::Call) return;
    const uint32_t errors = context.symbols.diagnostics.errorCount();
    if (isStatic(init, 0) || context.symbols.diagnostics.errorCount() != errors) {
      if (tree().kind(init) == ExprKind::Binary || tree().kind(init) == ExprKind::Unary) evaluate(context, init);
      return;
    }
    context.report(diag::InitialValueNotConstant, tree().begin(init), {what});
    init = {};
  }

  // The meaning of `N`, `List.N` or `Space.List.N`.
  Entity globalNamed(ExprId path) const {
    std::array<NameId, 6> members;
    size_t count = 0;
    for (; tree().kind(path) == ExprKind::Member && count < members.size(); path = tree().as<MemberExpr>(path).base)
      members[count++] = tree().as<MemberExpr>(path).member;
    if (tree().kind(path) != ExprKind::Name) return {};
    Entity found = lookUp(context, tree().as<NameExpr>(path));
    while (count > 0) found = lookUpIn(context, found, members[--count]);
    return found;
  }

  // N(1, 2) with a constant N is a repetition like 3(1, 2); other calls stay calls.
  void findRepetition(ExprId& id) const {
    const CallExpr& call = tree().as<CallExpr>(id);
    const Entity found = globalNamed(call.callee);
    if (found.entityKind() != EntityKind::Var || !context.symbols.vars[found.index].constant) return;
    if (!TypeTable::isInteger(context.types().plainKind(context.symbols.vars[found.index].type))) return;
    std::vector<ExprId> values;
    for (const Argument& argument : tree().list(call.arguments)) {
      if (argument.pin.name) return;
      values.push_back(argument.value);
    }
    context.replace(id, context.build().repeat(call.callee, context.code().addList<ExprId>(values), call.h.loc));
  }

  // Checks the elements that fit; returns how many values there are, the surplus included.
  uint64_t elements(Slice<ExprId>& slice, TypeId element, uint64_t room, Loc& surplus) {
    uint64_t count = 0;
    uint32_t kept = slice.count;
    for (uint32_t i = 0; i < slice.count; ++i) {
      ExprId& id = context.code().list(slice)[i];
      if (tree().kind(id) == ExprKind::Error) broken = true;
      if (tree().kind(id) == ExprKind::Call) findRepetition(id);
      if (count >= room && kept == slice.count) {
        kept = i;
        if (!surplus) surplus = tree().begin(id);
      }
      if (tree().kind(id) == ExprKind::Repeat) {
        RepeatExpr& repeat = context.code().as<RepeatExpr>(id);
        const auto repetitions = constantBound(context, repeat.count);
        if (!repetitions) {
          count = room;
          continue;
        }
        if (*repetitions < 0) {
          context.report(diag::RepetitionNegative, tree().begin(repeat.count), {std::to_string(*repetitions)});
          continue;
        }
        if (tree().kind(repeat.count) != ExprKind::Literal) {
          context.replace(repeat.count, makeLiteral(context, LiteralKind::Integer, types::idOf(TypeKind::LInt),
                                                    *repetitions, tree().loc(repeat.count)));
        }
        uint64_t group = 1;
        Loc inner;
        if (!repeat.elements.empty()) {
          Slice<ExprId> fitting = repeat.elements;
          group = elements(fitting, element, count < room ? room - count : 0, inner);
          if (fitting.count < repeat.elements.count)
            context.replace(id, context.build().repeat(repeat.count, fitting, repeat.h.loc));
        }
        const uint64_t total = group * std::min<uint64_t>(static_cast<uint64_t>(*repetitions), uint64_t{1} << 32);
        if (count < room && total > room - count && !surplus) surplus = tree().begin(id);
        count += total;
        continue;
      }
      if (count < room) {
        ExprId checked = id;
        value(checked, element);
        if (checked)
          id = checked;
        else  // was reported
          context.replace(id, context.build().error(tree().loc(id)));
      }
      ++count;
    }
    slice.count = kept;
    return count;
  }

  // What was written stays below the value of another variable; without one there is no value.
  void takeOver(ExprId& init, ExprId value) const {
    if (value)
      context.replace(init, context.code().duplicate(value));
    else
      init = {};
  }

  // codesys: `limits : Limits := kLimits` copies the initial value that kLimits is declared with, `all[1]` the
  // element's.
  bool likeAnother(ExprId& init, TypeId type) {
    const ExprKind written = tree().kind(init);
    if (!context.profile().copied_initial_values ||
        (written != ExprKind::Name && written != ExprKind::Member && written != ExprKind::Index))
      return false;
    if (!context.expressions->checkAs(context, init, type, std::string("used as ") + std::string(what))) {
      init = {};
      return true;
    }
    if (written == ExprKind::Index && may != InitialReads::Call && !isStatic(init, 0)) {
      context.report(diag::InitialValueNotConstant, tree().begin(init), {what});
      init = {};
      return true;
    }
    const ExprKind kind = tree().kind(init);
    const Entity entity = kind == ExprKind::Name     ? meaning(tree(), init).entity
                          : kind == ExprKind::Member ? meaning(tree(), init).entity
                                                     : Entity{};
    if (entity.entityKind() != EntityKind::Var) return true;
    const VarId other{entity.index};
    const Var& var = context.symbols.var(other);
    if (var.storage != Storage::Global && var.storage != Storage::Field) return true;
    ensureInitialValue(context, other);
    if (!var.record || var.list) {
      takeOver(init, context.symbols.var(other).init);
      reads |= init && may == InitialReads::Variables;  // what it takes over may read
    }
    return true;
  }

  // Surplus elements are dropped with a warning, missing ones have their default. Manual 5.3.1.2.4, 5.3.3.
  //   passes  a : ARRAY[1..6] OF INT := [1, 2, 3(4), 6];
  //   fails   a : ARRAY[1..6] OF INT := 1;                        E0326
  void array(ExprId& init, TypeId type) {
    const TypeInfo& info = context.types().info(context.types().resolve(type));
    if (tree().kind(init) != ExprKind::ArrayInit) {
      if (likeAnother(init, type)) return;
      context.report(diag::ArrayListExpected, tree().begin(init), {context.types().toString(type)});
      init = {};
      return;
    }
    uint64_t room = 1;
    for (const types::Dimension& dimension : info.dimensions) room *= dimension.count();
    const ArrayInitExpr& node = tree().as<ArrayInitExpr>(init);
    meaning(node.h).type = type;
    Loc surplus;
    Slice<ExprId> fitting = node.elements;
    const uint64_t count = elements(fitting, info.base, room, surplus);
    if (fitting.count < node.elements.count)
      context.replace(init, typed(context, context.build().arrayInit(fitting, node.h.loc), type));
    if (surplus && !broken)
      context.report(diag::SurplusElements, surplus, {std::to_string(count), std::to_string(room)});
  }

  // A record whose value has no members. __VARINFO(x) is one in codesys.
  void wholeRecord(ExprId& init, TypeId type) {
    if (likeAnother(init, type)) return;
    if (tree().kind(init) == ExprKind::Call && context.profile().system_operators) {
      ExprId value = init;
      if (context.expressions->checkAs(context, value, type, std::string("used as ") + std::string(what)) &&
          tree().kind(value) == ExprKind::AnyValue) {
        init = value;
        return;
      }
      if (typeOf(tree(), value) == types::kError) {
        init = {};
        return;
      }
    }
    context.report(diag::MembersExpected, tree().begin(init), {context.types().toString(type)});
    init = {};
  }

  using BitBytes = std::vector<std::pair<VarId, uint8_t>>;  // bytes that hold members of type BIT, and their values

  // Forbids members that do not exist, that are set twice, or that an initial value cannot set: inputs, and in codesys
  // outputs and locals too, are allowed. False: reported.
  //   passes  t : TON := (PT := T#5s);
  //   fails   t : TON := (PTX := T#5s);                           E0329
  bool setMember(FieldInit& given, TypeId type, NameMap& seen, BitBytes& bytes) {
    const std::string_view name = context.names().string(given.field.name);
    const VarId member = findMember(context, type, given.field.name);
    if (!member && setProperty(given, type, seen)) return true;
    if (!member) {
      if (isFirstReportOfMember(context, type, given.field.name))
        context.report(diag::UnknownMember, given.field.loc, {context.types().toString(type), name})
            .didYouMean(nearestMember(type, given.field.name));
      return false;
    }
    noteMention(context, entity(member), given.field.loc, Access::Pin);
    const Var& var = context.symbols.var(member);
    if (!seen.insert(keyOf(context, var.name), entity(member))) {
      context.report(diag::DuplicateMember, given.field.loc, {name});
      return false;
    }
    const bool settable = var.storage == Storage::Field && var.section != SectionKind::InOut &&
                          (!var.pou || var.section == SectionKind::Input || var.access == AccessLevel::Public ||
                           context.profile().initialised_members);
    if (!settable) {
      context.report(diag::MemberNotSettable, given.field.loc, {name, context.types().toString(type)})
          .declaredHere(var.loc);
      return false;
    }
    given.field.name = var.name;  // an alias means its pin
    if (given.value) value(given.value, var.type);
    if (var.bits.is_bit && given.value) {
      setBit(bytes, type, member, given.value);
      given.value = {};
    }
    return true;
  }

  void record(ExprId& init, TypeId type) {
    if (tree().kind(init) != ExprKind::StructInit) return wholeRecord(init, type);
    const StructInitExpr& node = tree().as<StructInitExpr>(init);
    meaning(node.h).type = type;
    std::vector<FieldInit> fields;  // as they are set: by the names of members, with bits together in their bytes
    NameMap seen;
    BitBytes bytes;
    for (FieldInit& written : context.code().list(node.fields)) {
      FieldInit given = written;
      if (!setMember(given, type, seen, bytes)) {
        fields.push_back(written);
        continue;
      }
      if (given.value) written.value = given.value;
      fields.push_back(given);
    }
    const auto same = [](const FieldInit& a, const FieldInit& b) {
      return a.field.name == b.field.name && a.value == b.value;
    };
    std::erase_if(fields, [](const FieldInit& given) { return !given.value; });  // reported, or a bit
    const auto as_written = tree().list(node.fields);
    if (bytes.empty() && fields.size() == as_written.size() &&
        std::equal(fields.begin(), fields.end(), as_written.begin(), same))
      return;
    for (const auto& [byte, bits] : bytes) {
      const Loc loc = node.h.loc;
      fields.push_back(
          {{context.symbols.var(byte).name, loc}, makeLiteral(context, LiteralKind::Integer, types::kByte, bits, loc)});
    }
    context.replace(init, typed(context, context.build().structInit(fields, node.h.loc), type));
  }

  // A property of a block is set by a call of its SET. TwinCAT, "Object Property". False: there is no such property.
  bool setProperty(FieldInit& given, TypeId type, NameMap& seen) {
    const PouId object = pouOf(context, type);
    Entity found = object ? findInObject(context, object, given.field.name) : Entity{};
    if (found.entityKind() != EntityKind::Property) return false;
    const std::string_view name = context.names().string(given.field.name);
    if (!seen.insert(keyOf(context, given.field.name), found)) {
      context.report(diag::DuplicateMember, given.field.loc, {name});
      given.value = {};
      return true;
    }
    noteMention(context, found, given.field.loc, Access::Pin);
    PouId setter = context.symbols.properties[found.index].set;
    for (PouId at = context.symbols.pou(context.symbols.properties[found.index].owner).base; at && !setter;
         at = context.symbols.pou(at).base) {
      found = findInObject(context, at, given.field.name);
      if (found.entityKind() == EntityKind::Property) setter = context.symbols.properties[found.index].set;
    }
    if (!setter) {
      context.report(diag::MemberNotSettable, given.field.loc, {name, context.types().toString(type)})
          .declaredHere(context.symbols.properties[found.index].loc);
      given.value = {};
      return true;
    }
    resolvePou(context, setter);
    const Pou& pou = context.symbols.pou(setter);
    if (!mayAccess(context, pou.access, pou.owner, given.field.name, given.field.loc)) {
      given.value = {};
      return true;
    }
    noteCall(context, setter, given.field.loc);
    given.field.name = pou.name;
    if (given.value) value(given.value, context.symbols.var(pinsOf(context, setter)[0]).type);
    return true;
  }

  // Sets the bit of a member of type BIT in the byte that holds it.
  void setBit(std::vector<std::pair<VarId, uint8_t>>& bytes, TypeId type, VarId member, ExprId given) const {
    const auto bit = requireConstant(context, given, types::kBool);
    if (!bit) return;
    const Var& var = context.symbols.var(member);
    if (bytes.empty() || bytes.back().first != var.bits.holder) {
      auto at =
          std::find_if(bytes.begin(), bytes.end(), [&](const auto& byte) { return byte.first == var.bits.holder; });
      if (at == bytes.end()) {
        const TypeId holder = var.record ? type : context.symbols.pou(var.pou).record;
        bytes.emplace_back(var.bits.holder, initialBits(context, holder, var.bits.holder));
      } else {
        std::rotate(at, at + 1, bytes.end());
      }
    }
    uint8_t& bits = bytes.back().second;
    const auto mask = static_cast<uint8_t>(1u << var.bits.bit);
    bits = static_cast<uint8_t>(bit->bits != 0 ? bits | mask : bits & ~mask);
  }

  std::string_view nearestMember(TypeId type, NameId written) const {
    std::vector<std::string_view> candidates;
    const types::TypeInfo& info = context.types().info(context.types().resolve(type));
    for (const types::Field& field : info.fields)
      if (findMember(context, type, field.name)) candidates.push_back(context.names().string(field.name));
    for (const types::BitMember& bit : info.bits) candidates.push_back(context.names().string(bit.name));
    return nearest(context.names().string(written), candidates);
  }

  void value(ExprId& init, TypeId type) {
    if (tree().kind(init) == ExprKind::Error || type == types::kError || !type) return;
    const TypeKind kind = context.types().kind(type);
    if (kind == TypeKind::Array) return array(init, type);
    if (kind == TypeKind::Record) return record(init, type);
    scalar(init, type);
  }
};

}  // namespace

bool checkInitializerAs(Context& context, ExprId& init, TypeId type, std::string_view what, InitialReads may) {
  constexpr uint64_t kMostBytes = uint64_t{256} << 20;  // the emitted data is as small as its text, the work is not
  const uint64_t bytes = context.types().info(context.types().resolve(type)).size;
  if (bytes > kMostBytes && context.tree().kind(init) == ExprKind::ArrayInit) {
    context.report(diag::InitialValueTooLarge, context.tree().begin(init),
                   {std::to_string(bytes), std::to_string(kMostBytes)});
    context.type(init) = types::kError;
    return false;
  }
  Initializer initializer{.context = context, .what = what, .may = may};
  initializer.value(init, type);
  return initializer.reads;
}

void checkInitializer(Context& context, ExprId& init, TypeId type) {
  checkInitializerAs(context, init, type, "the initial value");
}

}  // namespace rung::sema

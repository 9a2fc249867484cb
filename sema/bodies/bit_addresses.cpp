// SPDX-License-Identifier: Apache-2.0
// BITADR(x): the number of a bit, known at compile time. In: a checked operand. Out: a DWORD literal.
//
// The number counts from the beginning of the memory that the operand's first name is in: an area of the image, a list
// of global variables, a program, or the instance whose code this is. These are what __VARINFO counts from, too, in
// CODESYS and here. The two highest bits are the area: M 1, I 2, Q 3 (CODESYS, "BITADR"), 0 for all other memory. Both
// engines have the memory as it is laid out here.
#include <optional>

#include "sema/access.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/names.h"
#include "sema/bodies/pseudo_functions.h"
#include "sema/declarations/addresses.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

constexpr uint64_t kNumbers = uint64_t{1} << 30;  // below the bits of the area

struct BitNumber {
  Context& context;
  uint64_t bit = 0;
  uint32_t area = 0;
  const char* reason = nullptr;  // why there is no number
  ExprId at;                     // … at this part of the operand

  bool fail(ExprId where, const char* why) {
    at = where;
    reason = why;
    return false;
  }

  // The program or block whose code this is.
  PouId own() const {
    PouId pou = context.pou;
    while (context.symbols.pou(pou).owner) pou = context.symbols.pou(pou).owner;
    return pou;
  }

  // Where a field is in its record. False: reported.
  bool addField(TypeId record, const Var& var) {
    if (!checkLayout(context, "BITADR", record, context.tree().begin(at)) || !ensureLayout(context, record))
      return false;
    bit += uint64_t{context.types().info(context.types().resolve(record)).fields[var.field].offset} * 8;
    return true;
  }

  // A variable of a block, its program or one of its bases, in an instance of `pou`.
  bool addInherited(PouId pou, const Var& var) {
    for (; pou; pou = context.symbols.pou(pou).base) {
      const Pou& object = context.symbols.pou(pou);
      if (object.record == context.symbols.pou(var.pou).record) return addField(object.record, var);
      if (!object.object.base_var) break;
      if (!addField(object.record, context.symbols.var(object.object.base_var))) return false;
    }
    return fail(at, "a variable of another object");
  }

  bool addImage(const ImageView& view) {
    area = view.area == types::kMemoryArea   ? 1
           : view.area == types::kInputArea  ? 2
           : view.area == types::kOutputArea ? 3
                                             : 0;
    bit += uint64_t{view.byte} * 8 + view.bit;
    return true;
  }

  bool addVar(ExprId expr, VarId id) {
    const Var* var = &context.symbols.var(id);
    if (var->external) var = &context.symbols.var(var->external);
    if (var->section == SectionKind::InOut) return fail(expr, "an in-out");
    if (var->section == SectionKind::Temp) return fail(expr, "a variable of one call");
    switch (var->storage) {
      case Storage::Image:
        if (var->hierarchical) return fail(expr, "a variable at a hierarchical address");
        return addImage(var->image);
      case Storage::Global: return addField(context.symbols.global_lists[var->list.index].record, *var);
      case Storage::Field: {
        if (var->open_address) return fail(expr, "a variable with another address in each instance");
        const bool of_program = context.symbols.pou(var->pou).kind == PouKind::Program;  // also of another: `Main.x`
        return addInherited(of_program ? var->pou : own(), *var);
      }
      case Storage::Local: return fail(expr, "a variable of one call");
      case Storage::Constant: break;
    }
    return fail(expr, "a constant");
  }

  bool addMember(ExprId expr, const MemberExpr& member) {
    const Var& var = context.symbols.vars[meaning(member.h).entity.index];
    if (var.section == SectionKind::InOut) return fail(expr, "an in-out");
    if (var.open_address) return fail(expr, "a variable with another address in each instance");
    const TypeId record = context.types().resolve(context.type(member.base));
    if (!var.pou) return addField(record, var);
    return addInherited(pouOf(context, record), var);
  }

  //   fails   BITADR(list[i])                                   E0539
  bool addElement(ExprId expr, const IndexExpr& index) {
    const TypeId array = context.types().resolve(context.type(index.base));
    const types::TypeInfo& info = context.types().info(array);
    if (info.kind != TypeKind::Array || info.dimensions.size() != index.indices.count)
      return fail(expr, "a part of another variable");
    uint64_t element = 0;
    for (uint32_t k = 0; k < index.indices.count; ++k) {
      const types::Dimension& dimension = info.dimensions[k];
      const std::optional<int64_t> value = constantInteger(context, context.tree().list(index.indices)[k]);
      if (!value) return fail(context.tree().list(index.indices)[k], "an element with a variable index");
      if (*value < dimension.low || *value > dimension.high) return false;  // reported
      element = element * dimension.count() + static_cast<uint64_t>(*value - dimension.low);
    }
    if (!checkLayout(context, "BITADR", array, context.tree().begin(expr)) || !ensureLayout(context, array))
      return false;
    bit += element * context.types().info(context.types().resolve(info.base)).size * 8;
    return true;
  }

  // From the operand to its first name. False: there is no number, for `reason`, or an error was reported.
  bool add(ExprId expr) {
    const Tree& tree = context.tree();
    if (tree.kind(expr) == ExprKind::BitAccess) {
      const BitAccessExpr& access = tree.as<BitAccessExpr>(expr);
      bit += uint64_t{access.position} * access.width;
      expr = access.base;
    }
    for (;; expr = tree.base(expr)) {
      at = expr;
      const ExprKind kind = tree.kind(expr);
      if (kind == ExprKind::Error) return false;
      if (kind == ExprKind::This || kind == ExprKind::Super) return addObject(expr);
      if (kind == ExprKind::Deref) {
        const ExprKind object = tree.kind(tree.as<DerefExpr>(expr).base);
        if (object == ExprKind::This || object == ExprKind::Super) return addObject(tree.as<DerefExpr>(expr).base);
        return fail(expr, "the target of a pointer or reference");
      }
      if (kind == ExprKind::Address) {
        const std::optional<ImageView> view =
            resolveAddress(context, tree.as<AddressExpr>(expr).address, tree.loc(expr), {});
        return view ? addImage(*view) : fail(expr, "a hierarchical address");
      }
      if (kind == ExprKind::Index) {
        if (!addElement(expr, tree.as<IndexExpr>(expr))) return false;
        continue;
      }
      if (kind == ExprKind::Member && !isWhole(context, tree.as<MemberExpr>(expr))) {
        if (meaning(tree, expr).entity.entityKind() != EntityKind::Var) return fail(expr, "a value");
        if (!addMember(expr, tree.as<MemberExpr>(expr))) return false;
        continue;
      }
      const Entity entity = entityOf(context, expr);
      if (entity.entityKind() == EntityKind::Var) return addVar(expr, VarId{entity.index});
      const bool is_program =
          entity.entityKind() == EntityKind::Program ||
          (entity.entityKind() == EntityKind::Pou && context.symbols.pou(PouId{entity.index}).kind == PouKind::Program);
      return is_program || fail(expr, "a value");
    }
  }

  // THIS^, and SUPER^, which is a part of it.
  bool addObject(ExprId expr) {
    if (context.tree().kind(expr) == ExprKind::This) return true;
    const Pou& object = context.symbols.pou(own());
    return !object.object.base_var || addField(object.record, context.symbols.var(object.object.base_var));
  }
};

}  // namespace

//   passes  BITADR(ready), BITADR(pumps[2].on), BITADR(%IX0.3), BITADR(word.5)
//   fails   BITADR(p^), BITADR(list[i]), BITADR(x) where x is a variable of a function     E0539
TypeId checkBitAdr(Context& context, ExprId& expr, const PseudoCall& call) {
  ExprId lvalue = call.arguments[0].value;
  const Loc loc = context.tree().loc(expr);
  if (check(context, lvalue, {}, Access::Address) == types::kError) return types::kError;
  BitNumber number{.context = context, .at = lvalue};
  bool known = number.add(lvalue);
  if (known && number.bit >= kNumbers) known = number.fail(lvalue, "a variable beyond 128 MB of its memory");
  if (!known) {
    if (number.reason != nullptr) context.report(diag::NoBitAddress, context.tree().begin(number.at), {number.reason});
    return types::kError;
  }
  const auto value = static_cast<int64_t>(uint64_t{number.area} << 30 | number.bit);
  context.replace(expr, makeLiteral(context, LiteralKind::Integer, types::kDWord, value, loc));
  return types::kDWord;
}

}  // namespace rung::sema

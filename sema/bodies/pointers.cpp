// SPDX-License-Identifier: Apache-2.0
// Pointers and references: taking addresses, binding references, and arithmetic on addresses as in CODESYS.
// In: checked or unchecked operands. Out: AddressOf and Deref nodes, and arithmetic on the 64-bit numbers of addresses.
// TM/TP manual 5.2, 5.3 (ADR, POINTER TO); IEC 61131-3 ed. 3, 6.4.4.10 (REF_TO).
#include "sema/bodies/pointers.h"

#include "sema/access.h"
#include "sema/bodies/addressable.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/implicit_checks.h"
#include "sema/bodies/literal_storage.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/names.h"
#include "sema/bodies/objects.h"
#include "sema/bodies/operators.h"
#include "sema/bodies/pseudo_functions.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/fixes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

// Forbids, in iec, a reference to a variable of one call: VAR_TEMP, and those of functions and methods.
// IEC 61131-3 ed. 3, 6.4.4.10.2.
//   passes  r := REF(level) where level is a VAR of the block      fails  the same in a function      E0641
static bool checkReferable(Context& context, ExprId lvalue, NameId function) {
  if (context.profile().references_to_temporaries || !isNamed(context, function, "REF")) return true;
  const Tree& tree = context.tree();
  ExprId root = lvalue;
  while (shape(tree.kind(root)) == ExprShape::Step && tree.kind(root) != ExprKind::Deref) root = tree.base(root);
  const Entity found = entityOf(context, root);
  if (found.entityKind() != EntityKind::Var) return true;
  const Var& var = context.symbols.vars[found.index];
  if (var.storage != Storage::Local || var.section == SectionKind::InOut) return true;
  context.report(diag::RefOfCall, tree.begin(lvalue), {string(context, var.name)});
  return false;
}

// ADR(x), REF(x): the type is that of the operand, so that the target of the assignment decides whether it fits.
TypeId checkAdr(Context& context, ExprId& expr, const PseudoCall& call) {
  ExprId lvalue = call.arguments[0].value;
  const Loc loc = context.tree().loc(expr);
  TypeId type = check(context, lvalue, {}, Access::Address);
  if (!type || type == types::kError) return types::kError;
  const ExprKind kind = context.tree().kind(lvalue);
  if (kind == ExprKind::This || kind == ExprKind::Super) type = throughObject(context, lvalue, type);
  if (kind == ExprKind::BitAccess && context.meaning(lvalue).is_bit_member) {
    // TwinCAT returns the byte that holds a BIT.
    context.report(diag::AddressOfBitMember, context.tree().begin(lvalue));
    lvalue = context.tree().as<BitAccessExpr>(lvalue).base;
    type = types::kByte;
  }
  if (kind == ExprKind::Literal && types::TypeTable::isString(context.types().kind(type)) &&
      context.profile().addresses_of_strings)
    type = context.type(lvalue = storageOfLiteral(context, lvalue));
  if (!checkAddressable(context, lvalue) || !checkReferable(context, lvalue, call.name)) return types::kError;
  context.replace(expr, makeAddressOf(context, lvalue, context.types().pointer(type), loc));
  return context.type(expr);
}

// VAL(p) is p^. IEC syntax manual 5.3.1.3.2.
TypeId checkVal(Context& context, ExprId& expr, const PseudoCall& call) {
  context.replace(expr, context.build().deref(call.arguments[0].value, context.tree().loc(expr)));
  return check(context, expr, {}, Access::Read);
}

// The reference or pointer itself, when the operand is its target.
TypeId checkIsValid(Context& context, ExprId& expr, const PseudoCall& call) {
  ExprId operand = call.arguments[0].value;
  const Loc loc = context.tree().loc(expr);
  const TypeId type = check(context, operand, {}, Access::Address);
  if (!type || type == types::kError) return types::kError;
  if (context.tree().kind(operand) == ExprKind::Deref) operand = context.tree().as<DerefExpr>(operand).base;
  const TypeId own = context.type(operand);
  if (const Entity entity = entityOf(context, operand); entity.entityKind() == EntityKind::Var) {
    // A VAR_IN_OUT of a block refers to nothing before it is bound; one of a function always refers to a variable.
    const Var& var = context.symbols.vars[entity.index];
    const ExprKind kind = context.tree().kind(operand);
    if (var.section == SectionKind::InOut && (kind == ExprKind::Name || kind == ExprKind::Member)) {
      if (var.storage == Storage::Local) {
        context.replace(expr, makeLiteral(context, LiteralKind::Bool, types::kBool, 1, loc));
        return types::kBool;
      }
      const TypeId pointer = context.types().pointer(type);
      const ExprId address = makeAddressOf(context, operand, pointer, loc);
      const ExprId null = makeLiteral(context, LiteralKind::Null, pointer, 0, loc);
      context.replace(expr, makeBinary(context, BinaryOp::NotEqual, address, null, types::kBool, loc));
      return types::kBool;
    }
  }
  if (context.types().kind(own) != TypeKind::Reference) {
    context.report(diag::NotAReference, context.tree().begin(operand), {"__ISVALIDREF", context.types().toString(own)});
    return types::kError;
  }
  const ExprId null = makeLiteral(context, LiteralKind::Null, own, 0, loc);
  context.replace(expr, makeBinary(context, BinaryOp::NotEqual, operand, null, types::kBool, loc));
  return types::kBool;
}

namespace {

// A pointer as the signed number of its first byte, so that negative steps do not overflow.
void toNumber(Context& context, ExprId& expr) { wrapConvert(context, expr, types::kLInt); }

bool isPointer(const Context& context, TypeId type) { return context.types().kind(type) == TypeKind::Pointer; }
bool isWholeNumber(const Context& context, TypeId type) {
  const TypeKind kind = context.types().plainKind(type);
  return types::TypeTable::isInteger(kind) || types::TypeTable::isBits(kind) || kind == TypeKind::IntegerLiteral;
}

}  // namespace

bool bindReference(Context& context, ExprId& lvalue, TypeId reference) {
  const TypeId wanted = context.types().info(context.types().resolve(reference)).base;
  const bool zero = context.tree().kind(lvalue) == ExprKind::Literal &&
                    context.tree().as<LiteralExpr>(lvalue).literal() == LiteralKind::Integer &&
                    context.tree().as<LiteralExpr>(lvalue).value() == 0;
  const Loc loc = context.tree().loc(lvalue);
  if (zero) {  // REF= 0: it refers to nothing
    context.replace(lvalue, makeLiteral(context, LiteralKind::Null, reference, 0, loc));
    return true;
  }
  const TypeId type = check(context, lvalue, {}, Access::Refer);
  if (!type || type == types::kError || wanted == types::kError) return false;
  if (context.types().info(type).kind == TypeKind::NullLiteral) {
    context.type(lvalue) = reference;
    return true;
  }
  if (!checkAddressable(context, lvalue)) return false;
  const Fit fitness = fit(context, context.types().pointer(type), context.types().pointer(wanted));
  if (fitness == Fit::Lossless) {  // an object of a derived block
    context.replace(lvalue, makeAddressOf(context, lvalue, context.types().pointer(type), loc));
    wrapConvert(context, lvalue, reference);
    return true;
  }
  if (fitness != Fit::Same) {
    context.report(diag::WrongType, context.tree().begin(lvalue),
                   {context.types().toString(type), "bound to the reference", context.types().toString(reference)});
    return false;
  }
  context.replace(lvalue, makeAddressOf(context, lvalue, reference, loc));
  return true;
}

TypeId checkPointerIndex(Context& context, ExprId& expr, Access access) {
  IndexExpr& node = context.code().as<IndexExpr>(expr);
  Meaning& known = meaning(node.h);
  const Loc loc = node.h.loc;
  if (!context.profile().indexed_pointers) {
    context.report(diag::IndexOfPointer, loc).insert(context.tree().expr(node.base).end, "^", Sureness::Sure);
    return known.type = types::kError;
  }
  const ExprId pointer = node.base;
  const TypeId type = context.type(pointer);
  ExprId index = context.tree().list(node.indices)[0];
  const TypeId given = checkExpr(context, index);
  if (given == types::kError) return known.type = types::kError;
  if (!isWholeNumber(context, given)) {
    context.report(diag::IndexNotInteger, context.tree().loc(index), {context.types().toString(given)});
    return known.type = types::kError;
  }
  const TypeId target = context.types().info(context.types().resolve(type)).base;
  if (const PouId pou = pouOf(context, target)) resolvePou(context, pou);
  if (!ensureLayout(context, target)) return known.type = types::kError;
  if (given != types::kLInt) wrapConvert(context, index, types::kLInt);
  const uint64_t size = context.types().info(context.types().resolve(target)).size;
  const ExprId width = makeLiteral(context, LiteralKind::Integer, types::kLInt, size, loc);
  // The address of the pointer's target: a null pointer is found before the offset hides it.
  ExprId sum = makeAddressOf(context, makeDeref(context, pointer, target, loc), type, loc);
  context.meaning(sum).leads_somewhere = true;
  toNumber(context, sum);
  sum = makeBinary(context, BinaryOp::Add, sum,
                   makeBinary(context, BinaryOp::Multiply, index, width, types::kLInt, loc), types::kLInt, loc);
  wrapConvert(context, sum, type);
  callPointerCheck(context, sum, target, access);
  context.replace(expr, makeDeref(context, sum, target, loc));
  return target;
}

// CODESYS counts in bytes: p + 4 is 4 bytes after p, whatever it points to.
TypeId combinePointers(Context& context, ExprId& self, TypeId expected) {
  BinaryExpr& node = context.code().as<BinaryExpr>(self);
  const TypeId left = context.type(node.left), right = context.type(node.right);
  const bool both = isPointer(context, left) && isPointer(context, right);
  if (!both && !isWholeNumber(context, isPointer(context, left) ? right : left)) return {};
  const BinaryOp op = node.op();
  const bool comparison = op >= BinaryOp::Equal && op <= BinaryOp::GreaterEqual;
  if (!context.profile().pointer_arithmetic || (both && comparison)) return {};
  if (isUntyped(context, left)) finalizeUntyped(context, node.left, types::kLInt);
  if (isUntyped(context, right)) finalizeUntyped(context, node.right, types::kLInt);
  const bool step = !both && (op == BinaryOp::Add || (op == BinaryOp::Subtract && isPointer(context, left)));
  if (!step && !(both && op == BinaryOp::Subtract)) {  // a number like any other: masks, MOD, comparisons
    for (ExprId* side : {&node.left, &node.right}) {
      if (isPointer(context, context.type(*side)))
        wrapConvert(context, *side, types::kULInt);
      else if (comparison)
        wrapConvert(context, *side, types::kULInt);
    }
    return combine(context, self, expected);
  }
  for (ExprId* side : {&node.left, &node.right}) {
    if (context.type(*side) != types::kLInt) toNumber(context, *side);
  }
  meaning(node.h).type = types::kLInt;
  meaning(node.h).is_constant = 0;
  if (step) wrapConvert(context, self, isPointer(context, left) ? left : right);
  return context.type(self);
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// __NEW and __DELETE: memory from the bounded pool of the program (stdlib/__system/dynamic_memory.st). codesys.
// In: a NewExpr, a call of __DELETE. Out: the same with the types, the functions of the pool and the arguments of
// FB_Init resolved; lowering sets the initial values and calls FB_Init and FB_Exit.
#include "sema/bodies/dynamic_memory.h"

#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/objects.h"
#include "sema/bodies/pseudo_functions.h"
#include "sema/bodies/writable.h"
#include "sema/declarations/call_graph.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/diagnostics.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

// A function of the pool; the size that the project declares is set before the pool is laid out.
CallId poolCall(Context& context, const char* name, Loc loc) {
  const Entity size = lookUpSystem(context, "POOL_UNITS");
  const Options& options = context.project.options;
  if (size.entityKind() == EntityKind::Var && options.pool_bytes != 0) {
    Var& var = context.symbols.vars[size.index];
    ensureInitialValue(context, VarId{size.index});
    const ExprId init = var.init;
    if (init && context.tree().kind(init) == ExprKind::Literal) {
      const uint64_t units = (uint64_t{options.pool_bytes} + 7) / 8;
      var.init = makeLiteral(context, LiteralKind::Integer, context.type(init), static_cast<int64_t>(units),
                             context.tree().loc(init));
      var.value.bits = units;
    }
  }
  const Entity found = lookUpSystem(context, name);
  if (found.entityKind() != EntityKind::Pou) return {};
  const PouId pou{found.index};
  resolvePou(context, pou);
  noteCall(context, pou, loc);
  Call call;
  call.kind = CallKind::Function;
  call.pou = pou;
  return addCall(context, std::move(call));
}

bool mayBeAllocated(Context& context, TypeId type, TypeExprId what) {
  const Loc loc = context.tree().loc(what);
  if (context.types().isOpenArray(type)) {
    context.report(diag::OpenArray, loc);
    return false;
  }
  const PouId pou = pouOf(context, type);
  if (pou && context.symbols.pou(pou).kind == PouKind::Program) {
    context.report(diag::NotNewable, loc, {context.types().toString(type)});
    return false;
  }
  return checkNotAbstract(context, type, loc);
}

}  // namespace

// Forbids __NEW of a type that cannot have a second instance.
//   passes  p := __NEW(Motor);  p := __NEW(INT, 10);
//   fails   p := __NEW(Main);                                       E0592
TypeId checkNew(Context& context, ExprId& expr) {
  NewExpr& node = context.code().as<NewExpr>(expr);
  Meaning& known = meaning(node.h);
  if (known.type) return known.type;                                         // checked before
  if (!context.profile().dynamic_memory) return known.type = types::kError;  // reported by the lexer
  TypeId type = resolveType(context, node.allocated);
  if (node.count) checkExprAs(context, node.count, types::kLInt, "used as the number of elements");
  if (type == types::kError || !mayBeAllocated(context, type, node.allocated)) return known.type = types::kError;
  if (const PouId pou = pouOf(context, type)) resolvePou(context, pou);
  if (!ensureLayout(context, type)) {
    context.report(diag::TypeTooLarge, context.tree().loc(node.allocated), {context.types().toString(type)});
    return known.type = types::kError;
  }
  uint32_t elements = 0;
  const CallId constructor = checkConstructor(context, node.allocated, elements);
  const CallId memory = poolCall(context, "Allocate", node.h.loc);
  if (!memory) return known.type = types::kError;
  context.symbols.call(memory).constructor = constructor;
  known.call = memory;
  known.type = context.types().pointer(type);
  context.types().layout(known.type);
  return known.type;
}

// Forbids __DELETE of anything but a pointer, and of a pointer that cannot be set to 0.
//   fails   __DELETE(count) where count : INT                       E0593
TypeId checkDelete(Context& context, ExprId& expr, const PseudoCall& pseudo) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  const auto fail = [&] { return context.type(expr) = types::kError; };
  if (!context.profile().dynamic_memory) return fail();  // reported by the lexer
  if (node.arguments.count != 1 || !context.tree().list(node.arguments)[0].value) {
    context.report(diag::WrongArgumentCount, node.h.loc,
                   {string(context, pseudo.name), "1", std::to_string(node.arguments.count)});
    checkLooseArguments(context, node);
    return fail();
  }
  ExprId pointer = context.tree().list(node.arguments)[0].value;
  const TypeId type = check(context, pointer, {}, Access::ReadWrite);
  if (!type || type == types::kError) return fail();
  if (context.types().kind(type) != TypeKind::Pointer) {
    context.report(diag::DeleteOfValue, context.tree().begin(pointer), {context.types().toString(type)});
    return fail();
  }
  const bool is_this = context.tree().kind(pointer) == ExprKind::This;
  if (!is_this && !checkWritable(context, pointer, Purpose{Use::Deleted, {}, {}})) return fail();
  if (!pseudo.as_statement) {
    context.report(diag::NoResult, node.h.loc, {string(context, pseudo.name)});
    return fail();
  }
  const TypeId target = context.types().info(context.types().resolve(type)).base;
  if (const PouId pou = pouOf(context, target)) resolvePou(context, pou);
  if (!ensureLayout(context, target)) return fail();
  Call call;
  call.kind = CallKind::Delete;
  const CallId release = poolCall(context, "GiveBack", node.h.loc);
  const CallId owns = poolCall(context, "Owns", node.h.loc);
  if (release.index == 0 || owns.index == 0) return fail();
  call.pou = context.symbols.call(release).pou;
  call.owns = context.symbols.call(owns).pou;
  call.instance = pointer;
  meaning(node.h).call = addCall(context, std::move(call));
  // A statement without a value: TRUE serves as the type that a call must have.
  return meaning(node.h).type = types::kBool;
}

}  // namespace rung::sema

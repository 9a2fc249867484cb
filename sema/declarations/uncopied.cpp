// SPDX-License-Identifier: Apache-2.0
// Forbids copies of blocks marked {no_copy}, such as MUTEX and SEMA: the owner of a lock must not exist twice, and a
// lock that lives for one call guards nothing. Edition 4, 6.9; which variables: our decision.
//   passes  VAR_GLOBAL m : MUTEX; END_VAR … VAR_IN_OUT m : MUTEX; END_VAR … LOCK(m);
//   fails   a := b; (both MUTEX, or structures that hold one)                                                 E0629
//   fails   VAR CONSTANT m : MUTEX; END_VAR, in VAR_INPUT, VAR_OUTPUT, VAR_TEMP, VAR RETAIN, VAR of a function  E0630
// Called for each conversion to a record or array, and for each variable.
#include "sema/declarations/uncopied.h"

#include <algorithm>
#include <vector>

#include "sema/declarations/diagnostics.h"
#include "sema/declarations/objects.h"
#include "sema/shorthands.h"

namespace rung::sema {

using types::TypeKind;

namespace {

// `seen`: records that hold none, so that one that contains itself, which is reported elsewhere, ends.
PouId firstUncopied(Context& context, TypeId type, std::vector<TypeId>& seen) {
  type = context.types().resolve(type);
  const types::TypeInfo& info = context.types().info(type);
  if (info.kind == TypeKind::Array) return firstUncopied(context, info.base, seen);
  if (info.kind != TypeKind::Record || info.record_kind == types::RecordKind::Interface) return {};
  if (std::find(seen.begin(), seen.end(), type) != seen.end()) return {};
  seen.push_back(type);
  if (const PouId pou = pouOf(context, type); pou && context.symbols.pou(pou).pragmas.no_copy) return pou;
  for (const types::Field& field : info.fields) {
    if (field.by_reference || !field.type) continue;
    if (const PouId found = firstUncopied(context, field.type, seen)) return found;
  }
  return {};
}

}  // namespace

PouId uncopiedIn(Context& context, TypeId type) {
  std::vector<TypeId> seen;
  return firstUncopied(context, type, seen);
}

bool checkCopied(Context& context, ExprId expr, TypeId type) {
  const TypeKind kind = context.types().kind(type);
  if (kind != TypeKind::Record && kind != TypeKind::Array) return true;
  const PouId held = uncopiedIn(context, type);
  if (!held) return true;
  context.report(diag::Uncopied, context.tree().loc(expr), {string(context, context.symbols.pou(held).name)});
  return false;
}

bool checkKept(Context& context, const Var& var, Loc loc) {
  if (context.library) return true;
  const bool by_value = var.section == SectionKind::Input || var.section == SectionKind::Output;
  const bool for_a_call = var.storage == Storage::Local && var.section != SectionKind::InOut;
  const char* where = var.constant         ? "a constant"
                      : var.keeping.retain ? "retained"
                      : by_value           ? "an input or output"
                      : for_a_call         ? "a variable that lives for one call"
                                           : nullptr;
  if (where == nullptr || var.section == SectionKind::External) return true;
  const PouId held = uncopiedIn(context, var.type);
  if (!held) return true;
  context.report(diag::NotKept, loc, {string(context, context.symbols.pou(held).name), where});
  return false;
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Who may use a variable of a block or program through which path. Forbids, from outside: its VAR_TEMP and in-outs; to
// write its locals and outputs, also as the control of a FOR, by S= or +=, as a bit, as an in-out or as the target of a
// REFERENCE; in iec also to read a block's locals and inputs, in codesys those locals of a library. In methods:
// VAR_TEMP, and with a warning the in-outs of the block. IEC 61131-3 ed. 3, 6.6.3.4; CODESYS C0178, C0371, SA0102;
// TwinCAT, "Local Variables - VAR"; docs/language.md "Access from outside". Inputs may be set in every dialect (ed. 3
// table 42, 6a): IL stores them before CAL in edition 2 as well, and sema does not know the language of a body.
//   passes  x := timer.Q;   timer.PT := T#5s;   Line.motor.start := TRUE (an input of a local instance)
//   fails   timer.Q := TRUE;   x := mixer.step (a VAR, iec);   Line.count := 3;   x := mixer.level (an in-out)
//   warns   sort(table := source.table) where both are pins, an in-out and an output: codesys
// Called by names.cpp for each `instance.pin`, and for each name.
#include "sema/bodies/outside_access.h"

#include "sema/access.h"
#include "sema/bodies/diagnostics.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/diagnostics.h"
#include "sema/shorthands.h"

namespace rung::sema {

bool isInstance(const Context& context, TypeId type) {
  const types::TypeInfo& info = context.types().info(context.types().resolve(type));
  return info.kind == TypeKind::Record && info.record_kind != types::RecordKind::Struct &&
         info.record_kind != types::RecordKind::Union;
}

namespace {

// VAR_TEMP: known only to the body and the actions of its POU. CODESYS, "Temporary Variable - VAR_TEMP".
bool refuseTemporary(Context& context, const Var& var, Loc loc) {
  context
      .report(diag::TemporaryOutside, loc,
              {string(context, var.name), string(context, context.symbols.pou(var.pou).name)})
      .declaredHere(var.loc);
  return false;
}

// A test sets what a person would set with the programming system.
bool isInTest(const Context& context) {
  if (!context.pou) return false;
  const auto& pragmas = context.symbols.pou(context.pou).pragmas;
  return pragmas.test || pragmas.test_only;
}

// A local variable of a block or program may be read in codesys. One that is or holds an instance may be passed on:
// the inputs of that instance can be set anyway.
bool mayUseLocal(Context& context, const Var& var, Access access) {
  const bool is_program = context.symbols.pou(var.pou).kind == PouKind::Program;
  const bool passes = access == Access::InOut || access == Access::Refer;
  const bool sets = access == Access::Write || access == Access::ReadWrite || access == Access::Bind;
  bool writes = sets || passes;
  TypeId type = var.type;
  while (type && context.types().kind(type) == TypeKind::Array)
    type = context.types().info(context.types().resolve(type)).base;
  if (type && isInstance(context, type)) writes = access == Access::Write && type == var.type;
  if (writes && !(context.profile().locals_written_by_tests && isInTest(context))) return false;
  return is_program || (context.profile().locals_read_outside && !context.symbols.pou(var.pou).library);
}

}  // namespace

bool checkOutsideAccess(Context& context, const MemberExpr& node, VarId member, Access access) {
  const Var& var = context.symbols.var(member);
  if (!var.pou || var.type == types::kError) return true;  // of a structure or list
  const PouId object = objectOf(context);
  const bool is_own = object && (var.pou == object || isKindOf(context, object, var.pou));
  if (var.section == SectionKind::Temp && is_own) {
    const bool is_bare = !context.type(node.base);  // `Main.t` in the body or an action of Main
    return is_bare ? checkUseInMethod(context, var, node.h.loc) : refuseTemporary(context, var, node.h.loc);
  }
  if (access == Access::Address && var.section != SectionKind::Temp) return true;
  if (is_own)  // THIS^.x, another instance of the same block
    return var.access != AccessLevel::Private || var.pou == object ||
           mayAccess(context, var.access, var.pou, var.name, node.h.loc);
  if (var.access != AccessLevel::None && !mayAccess(context, var.access, var.pou, var.name, node.h.loc)) return false;
  if (var.access == AccessLevel::Public || var.access == AccessLevel::Internal) return true;
  const bool program = context.symbols.pou(var.pou).kind == PouKind::Program;
  const bool sets = access == Access::Write || access == Access::Bind;
  const bool writes = sets || access == Access::ReadWrite || access == Access::InOut;
  const std::string_view pin = string(context, var.name);
  const TypeId base = context.type(node.base);
  const std::string block = context.types().toString(base ? base : context.symbols.pou(var.pou).record);
  const auto refuse = [&](Diag diag) {
    context.report(diag, node.h.loc, {pin, block}).declaredHere(var.loc);
    return false;
  };
  switch (var.section) {
    case SectionKind::Input:  // set for the next call: ed. 3 table 42, 6a, table 69, 2
      if (context.profile().inputs_read_outside || program || sets || access == Access::Qualifier ||
          access == Access::Refer)
        return true;
      return refuse(diag::InputReadOutside);
    case SectionKind::Output:
      if (!writes) return true;
      if (access != Access::InOut || !context.profile().outputs_as_in_outs) return refuse(diag::OutputWrittenOutside);
      context.report(diag::OutputPassed, node.h.loc, {pin, block}).declaredHere(var.loc);
      return true;
    case SectionKind::InOut: return refuse(diag::InOutUsedOutside);
    case SectionKind::Local:
    case SectionKind::Inst:
      return mayUseLocal(context, var, access) || isBroken(context, var.pou) || refuse(diag::InternalVariable);
    case SectionKind::External:
    case SectionKind::Stat: return program || isBroken(context, var.pou) || refuse(diag::InternalVariable);
    case SectionKind::Temp: return isBroken(context, var.pou) || refuse(diag::InternalVariable);
    case SectionKind::Global:
    case SectionKind::Access:
    case SectionKind::Config: return true;
  }
  return true;
}

bool checkUseInMethod(Context& context, const Var& var, Loc loc) {
  if (!var.pou || !context.pou || var.pou == context.pou) return true;
  const Pou& user = context.symbols.pou(context.pou);
  if (!user.owner || user.kind != PouKind::Method) return true;
  if (var.section == SectionKind::Temp) return refuseTemporary(context, var, loc);
  if (var.section == SectionKind::InOut && !context.library && isFirstReport(context, var.name))
    context
        .report(diag::InOutInMethod, loc,
                {string(context, var.name), string(context, context.symbols.pou(var.pou).name)})
        .declaredHere(var.loc);
  return true;
}

}  // namespace rung::sema

// Forbids access to a block's variables from outside: its locals (codesys: those of a library, and setting them);
// writing its outputs and in-outs; in iec also reading its inputs. IEC 61131-3 ed. 3, 6.6.3.4; docs/language.md
// "Dialects". Inputs may be set in every dialect (ed. 3 table 42, 6a): IL stores them before CAL in edition 2 as well,
// and sema does not know the language of a body.
//   passes  x := timer.Q;   timer.PT := T#5s (codesys);
//   fails   timer.Q := TRUE;   x := mixer.step (a VAR)
//   warns   sort(table := source.table) where both are pins, an in-out and an output: codesys
// Called by names.cpp for each `instance.pin`.
#include "sema/checks/outside_access.h"

#include "sema/checks/diagnostics.h"

namespace rung::sema {

bool checkOutsideAccess(Context& context, const MemberExpr& node, VarId member, TypeId record, Access access) {
  if (access == Access::Address) return true;
  const Var& var = context.symbols.var(member);
  const PouId object = objectOf(context);
  if (object &&
      (var.pou == object || isKindOf(context, object, var.pou)))  // THIS^.x, another instance of the same block
    return var.access != AccessLevel::Private || var.pou == object ||
           mayAccess(context, var.access, var.pou, var.name, node.h.loc);
  if (var.access != AccessLevel::None && !mayAccess(context, var.access, var.pou, var.name, node.h.loc)) return false;
  if (var.access == AccessLevel::Public || var.access == AccessLevel::Internal) return true;
  const bool program = context.types().info(record).record_kind == types::RecordKind::Program;
  const bool sets = access == Access::Write || access == Access::Bind;
  const bool writes = sets || writesValue(access);
  const std::string_view pin = string(context, var.name);
  const std::string block = context.types().toString(record);
  const auto refuse = [&](Diag diag) {
    context.report(diag, node.h.loc, {pin, block}).declaredHere(var.loc);
    return false;
  };
  switch (var.section) {
    case SectionKind::Input:  // set for the next call: ed. 3 table 42, 6a, table 69, 2
      if (!context.iec() || program || sets || access == Access::Qualifier) return true;
      return refuse(diag::InputReadOutside);
    case SectionKind::Output:
      if (!writes) return true;
      if (access != Access::InOut || context.iec()) return refuse(diag::OutputWrittenOutside);
      context.report(diag::OutputPassed, node.h.loc, {pin, block}).declaredHere(var.loc);
      return true;
    case SectionKind::InOut: return writes ? refuse(diag::InOutWrittenOutside) : true;
    case SectionKind::Local:
    case SectionKind::Inst:
      if (!context.iec() && !sets && !context.symbols.pou(var.pou).library) return true;
      [[fallthrough]];
    case SectionKind::Temp:
    case SectionKind::External:
    case SectionKind::Stat: return program || isBroken(context, var.pou) ? true : refuse(diag::InternalVariable);
    case SectionKind::Global:
    case SectionKind::Access:
    case SectionKind::Config: return true;
  }
  return true;
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Forbids a call that leaves a VAR_IN_OUT, an ARRAY[*] or a {required} input open, and a call of a function by position
// with too few arguments. IEC 61131-3 ed. 3, table 40 and 6.6.1.4; syntax manual 5.4.1 (an informal call has the exact
// number).
//   passes  mix(level := tank);   LIMIT(0, x, 9)
//   fails   mix();                LIMIT(0, x)
// A native block may have {optional} in-outs: one that is left open keeps its variable, or has none.
// Called for every resolved call of any language.
#include "sema/bodies/required_pins.h"

#include "frontend/syntax/standard_names.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/pin_fixes.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/diagnostics.h"
#include "sema/shorthands.h"

namespace rung::sema {

bool checkRequiredPins(Context& context, const CallExpr& node, PouId id, const Arguments& arguments) {
  const Pou& pou = context.symbols.pou(id);
  const std::span<const VarId> pins = pinsOf(context, id);
  const uint32_t named = node.arguments.count - arguments.positional;
  const bool of_block = !context.profile().open_inputs_of_blocks && arguments.positional > 0;  // ed. 3, 6.6.1.4.2
  const bool by_position = (pou.kind == PouKind::Function || pou.kind == PouKind::Method || of_block) && named == 0;
  bool ok = true;
  for (size_t i = 0; i < pins.size(); ++i) {
    const bool given = i < arguments.slots.size() && arguments.slots[i] != 0;
    const Var& pin = context.symbols.var(pins[i]);
    const bool must = (pin.section == SectionKind::InOut && !pin.pragmas.optional) || pin.pragmas.required ||
                      (pin.section == SectionKind::Input && context.types().isOpenArray(pin.type));
    if (given) {
      const bool open = !context.tree().list(node.arguments)[arguments.slots[i] - 1].value;
      if (!open || !must) continue;
    }
    if (must) {
      context.report(diag::PinNotConnected, node.h.loc, {string(context, pin.name), string(context, pou.name)})
          .declaredHere(pin.loc)
          .fix(given ? Fix{} : boundPin(context, node, pin));
      ok = false;
    } else if (by_position && pin.section == SectionKind::Input && !pin.init) {
      if (!context.profile().enable_by_position && isNamed(context, pin.name, kEnable))
        continue;  // not among arguments without names
      if (!isBroken(context, id))
        context
            .report(diag::MissingArgument, node.end ? node.end : node.h.loc,
                    {string(context, pou.name), string(context, pin.name)})
            .fix(withValues(context, node, id, pins[i]));
      return false;
    }
  }
  return ok;
}

}  // namespace rung::sema

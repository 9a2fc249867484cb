// SPDX-License-Identifier: Apache-2.0
// Warns of the use of what {attribute 'obsolete' := 'text'} precedes. CODESYS, "Attribute: obsolete".
//   warns   {attribute 'obsolete' := 'use Pump2'} FUNCTION_BLOCK Pump … p : Pump;      W0647
#include "sema/checks/rules.h"

#include "sema/declarations/collect.h"
#include "sema/scopes.h"

namespace rung::sema {

void checkObsolete(Context& context, const UsedName& used) {
  if (used.declared.pragmas.empty() || context.library) return;
  const Pragma* const pragma = findPragma(context, used.declared, context.scopes.known_names.attributes.obsolete);
  if (pragma == nullptr) return;
  std::string text(context.tree().string(pragma->value));
  if (!text.empty()) text.insert(0, ": ");
  context.report(diag::Obsolete, used.loc, {context.names().string(used.name), text});
}

}  // namespace rung::sema

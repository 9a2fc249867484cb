// SPDX-License-Identifier: Apache-2.0
// Forbids a duplicate label, a jump to an undeclared one, and a jump into a statement. TM/TP manual 5.2.4.
//   passes  IF done THEN JMP finish; END_IF … finish: …
//   fails   JMP finsh;   finish: … finish: …
// Called at the end of each body.
#include "sema/checks/rules.h"

#include <algorithm>

#include "frontend/syntax/diagnostics.h"
#include "sema/bodies/body.h"

namespace rung::sema {

void checkJumpLabels(Context& context) {
  BodyState& body = *context.body;
  if (body.labels.empty() && body.jumps.empty()) return;
  const Names& names = context.names();
  const auto before = [&](const BodyState::LabelUse& a, const BodyState::LabelUse& b) {
    const uint32_t x = names.key(a.label.name).index, y = names.key(b.label.name).index;
    return x != y ? x < y : a.label.loc < b.label.loc;
  };
  std::sort(body.labels.begin(), body.labels.end(), before);
  for (size_t i = 1; i < body.labels.size(); ++i) {
    if (!names.same(body.labels[i - 1].label.name, body.labels[i].label.name)) continue;
    context.report(diag::DuplicateJumpLabel, body.labels[i].label.loc, {names.string(body.labels[i].label.name)})
        .declaredHere(body.labels[i - 1].label.loc);
  }
  for (const BodyState::LabelUse& jump : body.jumps) {
    const BodyState::LabelUse wanted{{jump.label.name, {}}, 0};
    const auto found = std::lower_bound(body.labels.begin(), body.labels.end(), wanted, before);
    if (found == body.labels.end() || !names.same(found->label.name, jump.label.name)) {
      std::vector<std::string_view> candidates;
      for (const BodyState::LabelUse& label : body.labels) candidates.push_back(names.string(label.label.name));
      context.report(diag::UnknownLabel, jump.label.loc, {names.string(jump.label.name)})
          .didYouMean(nearest(names.string(jump.label.name), candidates));
      continue;
    }
    uint32_t block = jump.block;
    while (block != 0 && block != found->block) block = body.block_parents[block - 1];
    if (block == found->block) continue;
    context.report(diag::JumpIntoStatement, jump.label.loc, {names.string(jump.label.name)})
        .declaredHere(found->label.loc);
  }
}

}  // namespace rung::sema

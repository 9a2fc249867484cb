// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/box_outputs.h"

#include <algorithm>

#include "frontend/syntax/standard_names.h"

namespace rung {

std::vector<std::vector<NameId>> unlistedOutputs(const Tree& tree, const Names& names,
                                                 std::span<const DiagramElement> elements) {
  std::vector<std::vector<NameId>> unlisted(elements.size());
  std::vector<NameId> outputs;
  for (const DiagramElement& e : elements) {
    for (const DiagramPin& pin : tree.list(e.pins)) {
      for (const DiagramWire& wire : tree.list(pin.wires)) {
        if (wire.from == kNoElement || !isBox(elements[wire.from].kind)) continue;
        outputs.clear();
        for (const DiagramPin& listed : tree.list(elements[wire.from].pins))
          if (listed.direction == PinDirection::Output) outputs.push_back(listed.name.name);
        std::vector<NameId>& more = unlisted[wire.from];
        outputs.insert(outputs.end(), more.begin(), more.end());
        if (outputOf(names, outputs, wire.pin.name) == outputs.size()) more.push_back(wire.pin.name);
      }
    }
  }
  return unlisted;
}

size_t outputOf(const Names& names, std::span<const NameId> outputs, NameId wire) {
  const auto isMeant = [&](NameId name) {
    return wire ? name && names.same(name, wire) : !name || !isEnableOutput(names.string(name));
  };
  return static_cast<size_t>(std::find_if(outputs.begin(), outputs.end(), isMeant) - outputs.begin());
}

}  // namespace rung

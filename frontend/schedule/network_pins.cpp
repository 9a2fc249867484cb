// SPDX-License-Identifier: Apache-2.0
#include "frontend/schedule/network_pins.h"

#include <algorithm>
#include <cctype>

namespace rung::diagram {
namespace {

// The pin of the signature to which the next argument without a name belongs; null: there are no more.
const PinSignature* nextInput(const Signature& signature, size_t& at) {
  while (at < signature.pins.size() && signature.pins[at].direction == PinDirection::Output) ++at;
  return at < signature.pins.size() ? &signature.pins[at++] : nullptr;
}

}  // namespace

Signature signatureOf(Signatures& signatures, const DiagramElement& e, NameId hidden) {
  if (e.operand) return signatures.of(e.operand);
  return hidden ? signatures.of(hidden) : signatures.of(e.path);
}

bool hasPin(const Names& names, const Signature& signature, const Ident& pin) {
  if (signature.find(names, pin.name) != nullptr) return true;
  const std::string_view name = names.string(pin.name);
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.back())) == 0) return false;
  return std::any_of(signature.pins.begin(), signature.pins.end(),
                     [](const PinSignature& known) { return known.extensible; });
}

bool bindsByName(const Tree& tree, const Names& names, const DiagramElement& e, const Signature& signature) {
  if (signature.kind != SignatureKind::Function) return true;
  bool any = false, all_unknown = true;
  for (const DiagramPin& pin : tree.list(e.pins)) {
    if (pin.direction == PinDirection::Output || isControl(names, pin.name.name)) continue;
    any = true;
    all_unknown = all_unknown && !hasPin(names, signature, pin.name);
  }
  return !(any && all_unknown && !signature.pins.empty());
}

void markInOuts(const Tree& tree, const Names& names, Signatures& signatures, const NetworkVariables& variables,
                const Diagram& diagram, std::vector<bool>& in_outs) {
  for (const DiagramElement& e : tree.list(diagram.elements)) {
    if (e.kind != ElementKind::Box || (!e.path && !e.operand)) continue;
    Signature signature = signatureOf(signatures, e, variables.hidden(e));
    if (signature.pins.empty() && e.operand && e.path) signature = signatures.of(e.path);  // the instance is unknown
    const bool named = bindsByName(tree, names, e, signature);
    size_t next = 0;
    for (uint32_t k = 0; k < e.pins.count; ++k) {
      const DiagramPin& pin = tree.list(e.pins)[k];
      if (pin.direction == PinDirection::Output || isControl(names, pin.name.name)) continue;
      const PinSignature* const known = !named          ? (pin.wires.empty() ? nullptr : nextInput(signature, next))
                                        : pin.name.name ? signature.find(names, pin.name.name)
                                                        : nullptr;
      if (known == nullptr || known->direction != PinDirection::InOut) continue;
      const size_t index = e.pins.first + k;
      if (in_outs.size() <= index) in_outs.resize(index + 1);
      in_outs[index] = true;
    }
  }
}

}  // namespace rung::diagram

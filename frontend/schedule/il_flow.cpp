// SPDX-License-Identifier: Apache-2.0
#include "frontend/schedule/il_flow.h"

#include <algorithm>

#include "frontend/syntax/diagnostics.h"
#include "frontend/syntax/il.h"

namespace rung::text {

// Tells whether the accumulator is the first argument. In f(a, b) it is not, if f takes only two.
bool takesAccumulator(Signatures& signatures, const IlInstruction& i) {
  if ((i.flags & kIlFormal) != 0) return false;
  const Signature signature = signatures.of(i.callee);
  if (signature.kind != SignatureKind::Function && signature.kind != SignatureKind::Method) return true;
  uint32_t inputs = 0;
  for (const PinSignature& pin : signature.pins) {
    if (pin.extensible) return true;
    if (pin.direction != PinDirection::Output) ++inputs;
  }
  if (inputs == 0) return false;
  return (i.flags & kIlInParens) == 0 || i.operands.count < inputs;
}

// `CU counter`: the input of an instance that the name of a function, or LD, S or R, denotes. Null: not an input
// operator.
const NameId* inputOperator(const Tree& tree, const Names& names, Signatures& signatures, const IlInstruction& i) {
  if (i.operands.count != 1 || (i.flags & ~kIlInParens) != 0) return nullptr;
  const NameId* pin = nullptr;
  if (i.kind == IlKind::Function && tree.kind(i.callee) == ExprKind::Name)
    pin = &tree.as<NameExpr>(i.callee).name;
  else if (i.kind == IlKind::Load || i.kind == IlKind::Set || i.kind == IlKind::Reset)
    pin = &i.word;
  if (pin == nullptr) return nullptr;
  const Signature signature = signatures.of(tree.list(i.operands)[0].value);
  return signature.kind == SignatureKind::Instance && signature.find(names, *pin) != nullptr ? pin : nullptr;
}

namespace {

enum class Effect : uint8_t { Passes, Reads, Replaces, Leaves, Goes };

Effect effectOf(const Tree& tree, const Names& names, Signatures& signatures, const IlInstruction& i) {
  const bool conditional = (i.flags & kIlConditional) != 0;
  switch (i.kind) {
    case IlKind::Label: return Effect::Passes;
    case IlKind::Load: return inputOperator(tree, names, signatures, i) != nullptr ? Effect::Reads : Effect::Replaces;
    case IlKind::Store:
    case IlKind::Set:
    case IlKind::Reset:
    case IlKind::Not:
    case IlKind::Binary:
    case IlKind::Close: return Effect::Reads;
    case IlKind::Jump: return conditional ? Effect::Reads : Effect::Goes;
    case IlKind::Return: return conditional ? Effect::Reads : Effect::Leaves;
    case IlKind::Call:
      if (conditional) return Effect::Reads;
      return signatures.of(i.callee).has_result ? Effect::Replaces : Effect::Passes;
    case IlKind::Function:
      if ((i.flags & kIlFormal) != 0 && signatures.of(i.callee).kind == SignatureKind::Instance) return Effect::Passes;
      return takesAccumulator(signatures, i) ? Effect::Reads : Effect::Replaces;
  }
  return Effect::Passes;
}

void collectLabels(const Tree& tree, const Names& names, Diagnostics& diagnostics, Slice<IlInstruction> list,
                   IlFlow& flow) {
  for (uint32_t k = 0; k < list.count; ++k) {
    const Ident label = tree.list(list)[k].label;
    if (label.name) flow.labels.push_back({names.key(label.name).index, k});
  }
  std::sort(flow.labels.begin(), flow.labels.end());
  const auto twice = [](const auto& a, const auto& b) { return a.first == b.first; };
  for (size_t n = 1; n < flow.labels.size(); ++n) {
    if (!twice(flow.labels[n - 1], flow.labels[n])) continue;
    const Ident second = tree.list(list)[flow.labels[n].second].label;
    diagnostics.report(diag::DuplicateJumpLabel, second.loc, {names.string(second.name)})
        .declaredHere(tree.list(list)[flow.labels[n - 1].second].label.loc);
  }
  flow.labels.erase(std::unique(flow.labels.begin(), flow.labels.end(), twice), flow.labels.end());
}

}  // namespace

uint32_t IlFlow::labelOf(const Names& names, const Ident& target) const {
  const std::pair<uint32_t, uint32_t> wanted{names.key(target.name).index, 0};
  const auto found = std::lower_bound(labels.begin(), labels.end(), wanted);
  return found != labels.end() && found->first == wanted.first ? found->second : kNoInstruction;
}

// An instruction that neither reads nor replaces the accumulator has exactly one successor, so the reader is found by
// following that chain, each link once.
IlFlow flowOf(const Tree& tree, const Names& names, Diagnostics& diagnostics, Signatures& signatures,
              Slice<IlInstruction> list, bool nested) {
  constexpr uint32_t kOpen = kNoInstruction - 1, kBusy = kNoInstruction - 2;
  IlFlow flow;
  collectLabels(tree, names, diagnostics, list, flow);
  flow.reader.assign(list.count + 1, kOpen);
  flow.reached.assign(list.count, nested);
  flow.jumps.assign(list.count, 0);
  flow.temporary.assign(list.count, {});
  flow.reader[list.count] = nested ? list.count : kNoInstruction;
  std::vector<uint32_t> next(list.count), chain{0};
  while (!chain.empty()) {
    uint32_t k = chain.back();
    chain.pop_back();
    for (; k < list.count && !flow.reached[k]; ++k) {
      flow.reached[k] = true;
      const IlInstruction& i = tree.list(list)[k];
      const uint32_t target = i.kind == IlKind::Jump ? flow.labelOf(names, i.target) : kNoInstruction;
      if (target != kNoInstruction) {
        ++flow.jumps[target];
        chain.push_back(target);
      }
      if ((i.kind == IlKind::Jump || i.kind == IlKind::Return) && (i.flags & kIlConditional) == 0) break;
    }
  }
  for (uint32_t k = 0; k < list.count; ++k) {
    const IlInstruction& i = tree.list(list)[k];
    const uint32_t target = i.kind == IlKind::Jump ? flow.labelOf(names, i.target) : kNoInstruction;
    switch (effectOf(tree, names, signatures, i)) {
      case Effect::Reads: flow.reader[k] = k; break;
      case Effect::Replaces:
      case Effect::Leaves: flow.reader[k] = kNoInstruction; break;
      case Effect::Passes: next[k] = k + 1; break;
      case Effect::Goes:
        if (target == kNoInstruction) flow.reader[k] = kNoInstruction;
        next[k] = target;
        break;
    }
  }
  for (uint32_t k = 0; k < list.count; ++k) {
    uint32_t end = k;
    while (flow.reader[end] == kOpen) {
      flow.reader[end] = kBusy;
      chain.push_back(end);
      end = next[end];
    }
    const uint32_t answer = flow.reader[end] == kBusy ? kNoInstruction : flow.reader[end];
    for (const uint32_t link : chain) flow.reader[link] = answer;
    chain.clear();
  }
  return flow;
}

}  // namespace rung::text

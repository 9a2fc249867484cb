// SPDX-License-Identifier: Apache-2.0
// Overload resolution: which of several functions or methods of one name a call means. In: the call, its arguments not
// checked. Out: the best match; its arguments are then checked (Arguments::checked), except literals, which depend on
// the pin. Edition 3.
//
// The best match takes each argument at least as well as every other candidate, and one argument better: the same type
// before an implicit conversion. If that does not decide, fewer open inputs win.
#include "sema/bodies/overloads.h"

#include <algorithm>

#include "frontend/syntax/standard_names.h"
#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/literals.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/overloads.h"
#include "sema/declarations/variables.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

using types::TypeTable;

// How well a pin takes an argument: smaller is better.
constexpr int kExact = 0, kLiteral = 1, kConverted = 2, kNever = 9;

struct Candidate {
  PouId pou;
  std::vector<VarId> pin_of;  // by argument; none: EN, ENO
  std::vector<int> ranks;     // likewise
  size_t open_inputs = 0;
};

// Overridden by a derived object, or declared twice, which was reported.
bool isKnown(const Context& context, std::span<const Candidate> known, PouId pou) {
  return std::any_of(known.begin(), known.end(),
                     [&](const Candidate& candidate) { return sameParameters(context.symbols, candidate.pou, pou); });
}

// The methods of the same name in the bases, except overridden ones.
void addInherited(Context& context, PouId method, std::vector<Candidate>& out) {
  const PouId owner = context.symbols.pou(method).owner;
  for (PouId at = owner ? context.symbols.pou(owner).base : PouId{}; at; at = context.symbols.pou(at).base)
    for (const PouId member : context.symbols.pou(at).members) {
      const Pou& pou = context.symbols.pou(member);
      if (pou.kind != PouKind::Method || pou.object.accessor != AccessorKind::None ||
          !context.names().same(pou.name, context.symbols.pou(method).name))
        continue;
      resolvePou(context, member);
      if (!isKnown(context, out, member)) out.push_back({member, {}, {}, 0});
    }
}

// Whether names and number of the arguments fit.
bool match(Context& context, const CallExpr& node, Candidate& candidate) {
  const std::span<const VarId> pins = pinsOf(context, candidate.pou);
  std::vector<bool> taken(pins.size());
  const auto isOutput = [&](size_t i) { return context.symbols.var(pins[i]).section == SectionKind::Output; };
  size_t input = 0, output = 0;
  for (const Argument& argument : context.tree().list(node.arguments)) {
    size_t slot = 0;
    if (argument.pin.name) {
      while (slot < pins.size() && !context.names().same(context.symbols.var(pins[slot]).name, argument.pin.name))
        ++slot;
      if (slot == pins.size()) {
        const bool control = isNamed(context, argument.pin.name, argument.is_output ? kEnableOutput : kEnable);
        if (!control) return false;
        candidate.pin_of.push_back({});
        continue;
      }
      if (isOutput(slot) != argument.is_output) return false;
    } else {
      while (input < pins.size() && (isOutput(input) || taken[input])) ++input;
      while (input >= pins.size() && output < pins.size() && (!isOutput(output) || taken[output])) ++output;
      slot = input < pins.size() ? input : output;
      if (slot >= pins.size()) return false;
    }
    if (taken[slot]) return false;
    taken[slot] = true;
    candidate.pin_of.push_back(pins[slot]);
  }
  for (size_t i = 0; i < pins.size(); ++i) {
    if (taken[i] || isOutput(i)) continue;
    if (context.symbols.var(pins[i]).section == SectionKind::InOut) return false;
    ++candidate.open_inputs;
  }
  return true;
}

int rankOf(Context& context, const Var& pin, ExprId value) {
  const TypeId actual = context.type(value);
  const TypeId wanted = context.types().resolve(pin.type);
  const types::TypeInfo& info = context.types().info(wanted);
  if (!actual || actual == types::kError || wanted == types::kError) return kExact;
  if (isUntyped(context, actual)) {
    if (pin.section != SectionKind::Input || !untypedFits(context, value, wanted)) return kNever;
    if (defaultType(context, value) == wanted) return kExact;
    const bool is_integer = context.types().info(actual).kind == TypeKind::IntegerLiteral;
    return TypeTable::isReal(info.kind) == is_integer || info.kind == TypeKind::Bool ? kConverted : kLiteral;
  }
  const types::TypeInfo& given = context.types().info(context.types().resolve(actual));
  const bool is_string = TypeTable::isString(info.kind);
  if (is_string && given.kind == info.kind) return kExact;
  if (context.tree().kind(value) == ExprKind::Literal && TypeTable::isString(given.kind) && given.length == 1 &&
      info.kind == TypeTable::characterOf(given.kind))
    return kLiteral;
  if (context.types().isOpenArray(wanted) && given.kind == TypeKind::Array) {
    const size_t dimensions = given.dimensions.empty() ? given.length : given.dimensions.size();
    return dimensions == info.length && sameType(context, info.base, given.base) ? kConverted : kNever;
  }
  if (pin.section == SectionKind::InOut) return sameType(context, wanted, actual) ? kExact : kNever;
  const Fit fits = pin.section == SectionKind::Output ? fit(context, wanted, actual) : fit(context, actual, wanted);
  return fits == Fit::Same ? kExact : fits == Fit::Lossless ? kConverted : kNever;
}

// Each argument once, with the access that the pins need.
void checkArguments(Context& context, const CallExpr& node, std::span<const Candidate> candidates) {
  for (uint32_t i = 0; i < node.arguments.count; ++i) {
    const Argument& argument = context.tree().list(node.arguments)[i];
    if (!argument.value) continue;
    Access access = argument.is_output ? Access::Write : Access::Read;
    for (const Candidate& candidate : candidates) {
      if (!candidate.pin_of[i]) continue;
      const SectionKind section = context.symbols.var(candidate.pin_of[i]).section;
      if (section == SectionKind::Output) access = Access::Write;
      if (section == SectionKind::InOut) access = Access::ReadWrite;
    }
    ExprId value = argument.value;
    check(context, value, {}, access);
    context.code().list(node.arguments)[i].value = value;
  }
}

bool isBetter(const Candidate& one, const Candidate& other) {
  bool better = false;
  for (size_t i = 0; i < one.ranks.size(); ++i) {
    if (one.ranks[i] > other.ranks[i]) return false;
    better = better || one.ranks[i] < other.ranks[i];
  }
  return better || one.open_inputs < other.open_inputs;
}

// `f(INT, REAL)`, `f(STRING[80])`
std::string signatures(Context& context, std::span<const Candidate> candidates) {
  std::string out;
  constexpr size_t kMax = 6;
  for (size_t i = 0; i < candidates.size() && i < kMax; ++i) {
    out += i == 0 ? "`" : ", `";
    out += string(context, context.symbols.pou(candidates[i].pou).name);
    out += '(';
    bool first = true;
    for (const VarId pin : pinsOf(context, candidates[i].pou)) {
      const Var& var = context.symbols.var(pin);
      out += first ? "" : ", ";
      first = false;
      out += (var.section == SectionKind::Output ? "=> " : "") + context.types().toString(var.type);
    }
    out += ")`";
  }
  return candidates.size() > kMax ? out + ", ..." : out;
}

}  // namespace

bool isOverloaded(const Context& context, PouId called) {
  return static_cast<bool>(context.symbols.pou(called).overloads.first);
}

// Forbids a call that no overload takes, or that several take equally well.
//   fails   f(TRUE) where f takes INT or REAL                                          E0627
//   fails   f(SINT#1) where f takes INT or DINT                                        E0628
PouId chooseOverload(Context& context, const CallExpr& node, PouId called, bool& checked) {
  std::vector<Candidate> all;
  const PouId head = context.symbols.pou(called).overloads.first;
  for (PouId id = head ? head : called; id; id = context.symbols.pou(id).overloads.next) {
    resolvePou(context, id);
    if (!isKnown(context, all, id)) all.push_back({id, {}, {}, 0});
  }
  addInherited(context, called, all);
  std::vector<Candidate> fitting;
  for (Candidate& candidate : all)
    if (match(context, node, candidate)) fitting.push_back(candidate);
  if (fitting.size() == 1) return fitting[0].pou;
  const auto name = string(context, context.symbols.pou(called).name);
  if (fitting.empty()) {
    context.report(diag::NoOverload, node.h.loc, {name, signatures(context, all)});
    checkLooseArguments(context, node);
    return {};
  }
  checkArguments(context, node, fitting);
  checked = true;
  bool broken = false;
  std::vector<Candidate> able;
  for (Candidate& candidate : fitting) {
    bool can = true;
    for (uint32_t i = 0; i < node.arguments.count; ++i) {
      const ExprId value = context.tree().list(node.arguments)[i].value;
      int rank = kExact;
      if (value && candidate.pin_of[i]) rank = rankOf(context, context.symbols.var(candidate.pin_of[i]), value);
      broken = broken || (value && context.type(value) == types::kError);
      can = can && rank != kNever;
      candidate.ranks.push_back(rank);
    }
    if (can) able.push_back(candidate);
  }
  for (const Candidate& candidate : able) {
    const bool best = std::all_of(able.begin(), able.end(), [&](const Candidate& other) {
      return other.pou == candidate.pou || isBetter(candidate, other);
    });
    if (best) return candidate.pou;
  }
  if (broken) return {};
  if (able.empty())
    context.report(diag::NoOverload, node.h.loc, {name, signatures(context, fitting)});
  else
    context.report(diag::SeveralOverloads, node.h.loc, {name, signatures(context, able)});
  return {};
}

}  // namespace rung::sema

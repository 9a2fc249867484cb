// SPDX-License-Identifier: Apache-2.0
// Calls: the callee, the pin of each argument, and the result. In: CallExpr. Out: a sema::Call with
// the bindings in the order of the pins. Called by expressions.cpp and statements.cpp.
// Generic and extensible functions are in generic_calls.cpp, operators in operator_calls.cpp, names that follow a rule
// (INT_TO_REAL) in conversion_calls.cpp.
#include "sema/bodies/calls.h"

#include <algorithm>

#include "frontend/syntax/diagnostics.h"
#include "frontend/syntax/standard_names.h"
#include "sema/access.h"
#include "sema/bodies/any_inputs.h"
#include "sema/bodies/conversion_calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/generic_calls.h"
#include "sema/bodies/limits.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/names.h"
#include "sema/bodies/objects.h"
#include "sema/bodies/operator_calls.h"
#include "sema/bodies/outside_access.h"
#include "sema/bodies/overloads.h"
#include "sema/bodies/pin_fixes.h"
#include "sema/bodies/pointers.h"
#include "sema/bodies/pseudo_functions.h"
#include "sema/bodies/required_pins.h"
#include "sema/bodies/writable.h"
#include "sema/declarations/call_graph.h"
#include "sema/declarations/item_names.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/variables.h"
#include "sema/diagnostics.h"
#include "sema/fixes.h"
#include "sema/hooks.h"
#include "sema/project.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

const char* kindName(SectionKind section) {
  if (section == SectionKind::Input) return "an input";
  return section == SectionKind::Output ? "an output" : "an in-out";
}

std::string_view nearestPin(Context& context, PouId pou, NameId written) {
  std::vector<std::string_view> candidates;
  for (const VarId pin : pinsOf(context, pou)) candidates.push_back(string(context, context.symbols.var(pin).name));
  return nearest(string(context, written), candidates);
}

// The slot of `IN5` of a function whose last input, {extensible}, is `IN2`; -1 for another name.
int extensibleSlot(Context& context, PouId pou, NameId written) {
  const std::span<const VarId> pins = pinsOf(context, pou);
  for (size_t i = 0; i < pins.size(); ++i) {
    const Var& pin = context.symbols.var(pins[i]);
    if (!pin.pragmas.extensible) continue;
    const std::string_view own = string(context, pin.name), other = string(context, written);
    size_t stem = own.size();
    while (stem > 0 && own[stem - 1] >= '0' && own[stem - 1] <= '9') --stem;
    if (other.size() <= stem || other.size() > stem + 4 ||
        !sameIdentifier(own.substr(0, stem), other.substr(0, stem))) {
      return -1;
    }
    int first = 0, number = 0;
    for (const char c : own.substr(stem)) first = first * 10 + (c - '0');
    for (const char c : other.substr(stem)) {
      if (c < '0' || c > '9') return -1;
      number = number * 10 + (c - '0');
    }
    if (number <= first) return -1;
    return static_cast<int>(pins.size()) + number - first - 1;
  }
  return -1;
}

// Forbids, in iec, a list of arguments that has names for some of them, and one without names that leaves pins open.
// IEC 61131-3 ed. 3, 6.6.1.4.2: all names or none, and a non-formal call has exactly the parameters of the function.
//   passes  limited := Scale(x := 3, factor := 2);  limited := Scale(3, 2);
//   fails   limited := Scale(x := 3, 2);      E0640
//   fails   limited := Scale(3);              E0605
bool checkFormality(Context& context, const CallExpr& node, PouId pou) {
  const LanguageProfile& profile = context.profile();
  const Pou& callee = context.symbols.pou(pou);
  const std::span<const Argument> arguments = context.tree().list(node.arguments);
  const auto isFormal = [](const Argument& argument) { return static_cast<bool>(argument.pin.name); };
  const auto formal = static_cast<size_t>(std::count_if(arguments.begin(), arguments.end(), isFormal));
  if (!profile.mixed_arguments && formal != 0 && formal != arguments.size()) {
    const auto other = std::find_if_not(arguments.begin(), arguments.end(), isFormal);
    context.report(diag::MixedArguments, other->loc, {string(context, callee.name)});
    return false;
  }
  const bool takes_all = callee.kind != PouKind::Action && callee.kind != PouKind::Program;
  if (profile.open_inputs_of_functions || formal != 0 || arguments.empty() || !takes_all || callee.library) return true;
  size_t given = arguments.size();
  for (const VarId id : pinsOf(context, pou)) {
    const Var& pin = context.symbols.var(id);
    if (isControl(string(context, pin.name))) continue;
    if (pin.section == SectionKind::Output || given > 0) {
      given -= pin.section == SectionKind::Output ? 0 : 1;
      continue;
    }
    context.report(diag::MissingArgument, node.h.loc, {string(context, callee.name), string(context, pin.name)})
        .fix(withValues(context, node, pou, id));
    return false;
  }
  return true;
}

// `f(PT = T#1s)`: a comparison with a pin's name where no such variable is visible.
bool isMistypedBinding(Context& context, PouId pou, ExprId value) {
  if (!value || context.tree().kind(value) != ExprKind::Binary) return false;
  const BinaryExpr& node = context.tree().as<BinaryExpr>(value);
  if (node.op() != BinaryOp::Equal || node.h.in_parens || context.tree().kind(node.left) != ExprKind::Name)
    return false;
  const NameId name = context.tree().as<NameExpr>(node.left).name;
  if (!findPin(context, pou, name) || lookUp(context, name)) return false;
  context.report(diag::BindingWithEqual, node.h.loc, {string(context, name)})
      .replace(node.h.loc, {node.h.loc.offset + 1}, ":=", Sureness::Sure);
  return true;
}

void checkLoose(Context& context, const CallExpr& node, uint32_t index) {
  const Argument& argument = context.tree().list(node.arguments)[index];
  if (!argument.value) return;
  ExprId value = argument.value;
  if (isUntyped(context, check(context, value, {}, argument.is_output ? Access::Write : Access::Read))) {
    finalizeUntyped(context, value);
  }
  context.code().list(node.arguments)[index].value = value;
}

bool sameInOut(const Context& context, TypeId pin, TypeId actual) {
  const types::TypeTable& table = context.types();
  const types::TypeInfo& wanted = table.info(table.resolve(pin));
  const types::TypeInfo& given = table.info(table.resolve(actual));
  if (table.isOpenArray(pin) && given.kind == TypeKind::Array) {
    const size_t dimensions = given.dimensions.empty() ? given.length : given.dimensions.size();
    return dimensions == wanted.length && sameType(context, wanted.base, given.base);
  }
  if (wanted.kind == TypeKind::Record && given.kind == TypeKind::Record) {
    Context here = context;
    const PouId base = pouOf(here, pin), object = pouOf(here, actual);
    if (base && object && isKindOf(here, object, base)) return true;
    if (extendsStructure(context, actual, pin)) return true;
  }
  const LanguageProfile& profile = context.profile();
  if (profile.in_outs_of_equal_bits && types::TypeTable::haveSameBits(wanted.kind, given.kind)) return true;
  // The variable of an enumeration is one of its base type.
  if (profile.in_outs_of_enums && given.kind == TypeKind::Enum && table.resolve(given.base) == table.resolve(pin))
    return true;
  if (types::TypeTable::isString(wanted.kind) && wanted.kind == given.kind) return wanted.length <= given.length;
  return sameType(context, pin, actual);
}

void checkOpenArgument(Context& context, const Var& pin, ExprId value, TypeId actual, const Purpose& purpose) {
  if (actual == types::kError || sameInOut(context, pin.type, actual)) return;
  context.report(diag::WrongType, context.tree().begin(value),
                 {context.types().toString(actual), purpose.toString(context), context.types().toString(pin.type)});
}

// The type of an argument, which the choice of an overload may have checked already; a literal depends on the pin.
TypeId checkArgument(Context& context, ExprId& value, TypeId expected, Access access, bool checked) {
  const bool is_done = checked && context.tree().kind(value) != ExprKind::Literal;
  return is_done ? context.type(value) : check(context, value, expected, access);
}

void bindOutput(Context& context, const Pou& pou, const Var& pin, Binding& binding, const Argument& argument,
                bool checked) {
  binding.is_output = true;
  binding.negated = argument.negated;
  const Purpose purpose{Use::BoundToOutput, pin.name, pou.name};
  const TypeId actual =
      checkArgument(context, binding.value, pin.type, Access::Write, checked);  // temporaries take its type
  if (actual == types::kError || !checkWritable(context, binding.value, purpose)) return;
  if (context.types().isOpenArray(pin.type)) {
    checkOpenArgument(context, pin, binding.value, actual, purpose);
    return;
  }
  if (argument.negated && context.types().plainKind(pin.type) != TypeKind::Bool) {
    context.report(diag::NegatedPin, argument.pin.loc, {string(context, pin.name), context.types().toString(pin.type)});
    return;
  }
  // The value flows from the pin to the lvalue; lowering converts it there.
  reportFit(context, fit(context, pin.type, actual), binding.value, pin.type, actual,
            Purpose{Use::CopiedFromOutput, pin.name, pou.name});
}

void bindInOut(Context& context, const Pou& pou, const Var& pin, Binding& binding, bool checked) {
  const Purpose purpose{Use::BoundToInOut, pin.name, pou.name};
  const Access access = pin.constant ? Access::Read : Access::InOut;
  const TypeId actual = checkArgument(context, binding.value, pin.type, access, checked);
  if (actual == types::kError || pin.type == types::kError) return;
  if (isUntyped(context, actual)) finalizeUntyped(context, binding.value);
  if (pin.constant && !context.types().isOpenArray(pin.type)) {  // VAR_IN_OUT CONSTANT takes any value of the type
    convert(context, binding.value, pin.type, purpose);
    return;
  }
  if (context.types().kind(pin.type) == TypeKind::Reference && context.tree().kind(binding.value) == ExprKind::Deref) {
    const ExprId reference = context.tree().as<DerefExpr>(binding.value).base;  // the reference itself is passed
    if (sameType(context, context.type(reference), pin.type)) {
      binding.value = reference;
      return;
    }
  }
  if (!pin.constant && !checkWritable(context, binding.value, purpose)) return;
  if (!sameInOut(context, pin.type, actual)) {
    context.report(diag::OtherInOutType, context.tree().loc(binding.value),
                   {context.types().toString(actual), string(context, pin.name), string(context, pou.name),
                    context.types().toString(pin.type)});
  }
}

void bindInput(Context& context, const Pou& pou, const Var& pin, Binding& binding, bool checked) {
  const types::TypeInfo& wanted = context.types().info(context.types().resolve(pin.type));
  if (wanted.kind == TypeKind::Reference) {
    bindReference(context, binding.value, pin.type);
    return;
  }
  if (pin.any) return bindAny(context, pou, pin, binding.value);
  if (context.types().isOpenArray(pin.type)) {
    const TypeId actual = checkArgument(context, binding.value, {}, Access::Read, checked);
    if (actual) checkOpenArgument(context, pin, binding.value, actual, Purpose{Use::Passed, pin.name, pou.name});
    return;
  }
  const Purpose purpose{Use::Passed, pin.name, pou.name};
  if (!binding.value) return;
  const TypeId actual = checkArgument(context, binding.value, pin.type, Access::Read, checked);
  if (actual == types::kError) return;
  const bool shortens = pin.pragmas.long_time && context.symbols.profile.timers_of_long_time &&
                        context.types().plainKind(actual) == TypeKind::LTime;
  if (shortens)
    wrapConvert(context, binding.value, pin.type);
  else
    convert(context, binding.value, pin.type, purpose);
}

}  // namespace

TypeId checkRefused(Context& context, CallExpr& node, const Arguments& arguments) {
  for (const uint32_t index : arguments.slots) {
    if (index == 0) continue;
    ExprId value = context.tree().list(node.arguments)[index - 1].value;
    if (value && isUntyped(context, check(context, value, {}, Access::Read))) finalizeUntyped(context, value);
  }
  return meaning(node.h).type = types::kError;
}

// Of Plant.Half the last name.
Loc nameOfCallee(const Context& context, const CallExpr& node) {
  const bool is_path = node.callee && context.tree().kind(node.callee) == ExprKind::Member;
  return is_path ? context.tree().loc(node.callee) : node.h.loc;
}

PouId calledOf(Context& context, const CallExpr& node, PouId named, bool& checked) {
  const PouId pou = isOverloaded(context, named) ? chooseOverload(context, node, named, checked) : named;
  if (!pou) return {};
  resolvePou(context, pou);
  noteCall(context, pou, node.h.loc, nameOfCallee(context, node));
  return pou;
}

TypeId resultOf(Context& context, CallExpr& node, const Pou& callee, bool as_statement) {
  if (callee.result || as_statement) return meaning(node.h).type = callee.result;
  context.report(diag::NoResult, node.h.loc, {string(context, callee.name)});
  return meaning(node.h).type = types::kError;
}

namespace {

// TO_STRING and TO_WSTRING of an enumeration with {attribute 'to_string'} call the function from its numbers to its
// items.
TypeId nameOfItem(Context& context, ExprId& expr, const Pou& callee, TypeId type) {
  const bool wide = isNamed(context, callee.name, "TO_WSTRING");
  if (!context.profile().named_items_as_strings || !callee.library ||
      (!wide && !isNamed(context, callee.name, "TO_STRING")))
    return type;
  if (type == types::kError || context.tree().kind(expr) != ExprKind::Call) return type;
  CallExpr& node = context.code().as<CallExpr>(expr);
  Meaning& known = meaning(node.h);
  if (!known.call || context.symbols.call(known.call).bindings.size() != 1) return type;
  ExprId value = context.symbols.call(known.call).bindings[0].value;
  while (value && context.tree().kind(value) == ExprKind::Convert)
    value = context.tree().as<ConvertExpr>(value).operand;
  const PouId names = value ? itemNamesOf(context, context.type(value)) : PouId{};
  if (!names) return type;
  wrapConvert(context, value, types::kLInt);
  const VarId pin = pinsOf(context, names)[0];
  noteCall(context, names, node.h.loc);
  Call& call = context.symbols.call(known.call);
  call.pou = names;
  call.bindings[0].pin = pin;
  call.bindings[0].value = value;
  known.type = types::idOf(TypeKind::String);
  if (wide) wrapConvert(context, expr, types::idOf(TypeKind::WString));
  return context.type(expr);
}

TypeId callFunction(Context& context, ExprId& expr, PouId pou, TypeId expected, bool as_statement) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  bool checked = false;
  pou = calledOf(context, node, pou, checked);
  if (!pou) return meaning(node.h).type = types::kError;
  const Pou& callee = context.symbols.pou(pou);
  if (callee.pragmas.operator_kind != OperatorKind::None) return checkOperatorCall(context, expr, pou, expected, {});
  if (callee.generic || callee.extensible)
    return nameOfItem(context, expr, callee, checkGenericCall(context, expr, pou, expected, {}));
  Arguments arguments = matchArguments(context, node, pou);
  arguments.checked = checked;
  Call call;
  call.kind = CallKind::Function;
  call.pou = pou;
  bindControlPins(context, node, arguments, call);
  bindArguments(context, node, pou, arguments, call);
  for (const Binding& binding : call.bindings) {
    if (!binding.value || !binding.is_output || !isNamed(context, context.symbols.var(binding.pin).name, kEnableOutput))
      continue;
    call.eno = binding.value;
    call.eno_is_pin = true;
  }
  if (arguments.ok) checkRequiredPins(context, node, pou, arguments);
  meaning(node.h).call = addCall(context, std::move(call));
  return resultOf(context, node, callee, as_statement);
}

TypeId callBlock(Context& context, ExprId expr, PouId pou, CallKind kind, bool as_statement) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  Meaning& known = meaning(node.h);
  resolvePou(context, pou);
  noteCall(context, pou, node.h.loc, nameOfCallee(context, node));
  const Arguments arguments = matchArguments(context, node, pou);
  Call call;
  call.kind = kind;
  call.pou = pou;
  if (kind == CallKind::Instance) {
    call.instance = node.callee;
    call.eno_memory = enoMemoryOf(context, node.callee);
    const Pou& block = context.symbols.pou(pou);
    call.is_virtual =
        block.object.dispatched && (block.object.modifiers & kFinal) == 0 && !isExact(context, node.callee);
  }
  bindControlPins(context, node, arguments, call);
  bindArguments(context, node, pou, arguments, call);
  if (arguments.ok) checkRequiredPins(context, node, pou, arguments);
  context.rules->call(context, node, call);
  known.call = addCall(context, std::move(call));
  if (!as_statement) {
    context.report(diag::BlockCallAsValue, node.h.loc, {string(context, context.symbols.pou(pou).name)});
    return known.type = types::kError;
  }
  return known.type = {};
}

TypeId refuse(Context& context, CallExpr& node) {
  checkLooseArguments(context, node);
  return meaning(node.h).type = types::kError;
}

TypeId callPou(Context& context, ExprId& expr, PouId pou, TypeId expected, bool as_statement) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  const Pou& callee = context.symbols.pou(pou);
  switch (callee.kind) {
    case PouKind::Function: return callFunction(context, expr, pou, expected, as_statement);
    case PouKind::Method:
    case PouKind::Action: {
      const bool of_member = context.tree().kind(node.callee) == ExprKind::Member;
      return callMethod(context, expr, pou, of_member ? context.tree().as<MemberExpr>(node.callee).base : ExprId{},
                        as_statement);
    }
    case PouKind::FunctionBlock:
    case PouKind::Class:
    case PouKind::Interface:
      context.report(diag::CallOfBlockType, node.h.loc, {string(context, callee.name)});
      return refuse(context, node);
    case PouKind::Program:
      if (!context.profile().programs_call_programs) {
        noteEffect(context);
        context.symbols.pou(pou).progress.used = true;  // after this error, the program is not reported as never called
        context.report(diag::CallOfProgram, node.h.loc, {string(context, callee.name)});
        return refuse(context, node);
      }
      return callBlock(context, expr, pou, CallKind::Program, as_statement);
  }
  return types::kError;
}

// The property whose value a callee is; none: it is something else.
NameId calledProperty(const Context& context, ExprId callee) {
  const Tree& tree = context.tree();
  while (tree.kind(callee) == ExprKind::Deref) callee = tree.as<DerefExpr>(callee).base;
  if (tree.kind(callee) != ExprKind::Call || meaning(tree, callee).call.index == 0) return {};
  const PouId called = context.symbols.call(meaning(tree, callee).call).pou;
  return called && context.symbols.pou(called).object.accessor != AccessorKind::None ? context.symbols.pou(called).name
                                                                                     : NameId{};
}

// The callee is a value: an instance, or a value that cannot be called.
TypeId callValue(Context& context, ExprId& expr, TypeId type, bool as_statement) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  if (type == types::kError) return refuse(context, node);
  const PouId pou = pouOf(context, type);
  if (pou && context.symbols.pou(pou).kind == PouKind::FunctionBlock) {
    return callBlock(context, expr, pou, CallKind::Instance, as_statement);
  }
  if (const NameId property = calledProperty(context, node.callee)) {
    context.report(diag::PropertyCalled, context.tree().loc(node.callee), {string(context, property)});
    return refuse(context, node);
  }
  const NameId name = nameOf(context, node.callee);
  const Entity called = entityOf(context, node.callee);
  Report report =
      context.report(diag::NotCallable, node.h.loc,
                     {name ? string(context, name) : std::string_view("this"), context.types().toString(type)});
  if (called.entityKind() == EntityKind::Var) report.declaredHere(context.symbols.vars[called.index].loc);
  return refuse(context, node);
}

TypeId callUnknown(Context& context, ExprId& expr, NameId name, TypeId expected, bool as_statement) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  if (const auto type = checkPseudoCall(context, expr, name, as_statement)) return *type;
  if (const TypeId type = checkRuleCall(context, expr, name, expected)) return type;
  if (isFirstReport(context, name)) {
    std::string_view near = nearestCallable(context, name);
    if (near.empty()) near = nearestPseudoFunction(context, name);
    context.report(diag::UnknownName, node.h.loc, {string(context, name)}).didYouMean(near);
  }
  context.meaning(node.callee).entity = Entity::of(EntityKind::Error, 0);
  return refuse(context, node);
}

}  // namespace

void bindArguments(Context& context, const CallExpr& node, PouId callee, const Arguments& arguments, Call& call) {
  const std::span<const VarId> pins = pinsOf(context, callee);
  const Pou& pou = context.symbols.pou(callee);
  call.bindings.reserve(arguments.slots.size());
  for (size_t i = 0; i < arguments.slots.size() && i < pins.size(); ++i) {
    if (arguments.slots[i] == 0) continue;
    const uint32_t index = arguments.slots[i] - 1;
    const Argument& argument = context.tree().list(node.arguments)[index];
    if (!argument.value) continue;
    Binding binding;
    binding.pin = pins[i];
    binding.value = argument.value;
    const Var& pin = context.symbols.var(pins[i]);
    switch (pin.section) {
      case SectionKind::Output: bindOutput(context, pou, pin, binding, argument, arguments.checked); break;
      case SectionKind::InOut: bindInOut(context, pou, pin, binding, arguments.checked); break;
      case SectionKind::Input:
      case SectionKind::Local:
      case SectionKind::Temp:
      case SectionKind::External:
      case SectionKind::Global:
      case SectionKind::Stat:
      case SectionKind::Inst:
      case SectionKind::Access:
      case SectionKind::Config: bindInput(context, pou, pin, binding, arguments.checked); break;
    }
    context.code().list(node.arguments)[index].value = binding.value;
    call.bindings.push_back(binding);
  }
}

void checkConnections(Context& context, ExprId call, PouId program) {
  callBlock(context, call, program, CallKind::Program, true);
}

CallId addCall(Context& context, Call&& call) {
  context.symbols.calls.push_back(std::move(call));
  return CallId{static_cast<uint32_t>(context.symbols.calls.size() - 1)};
}

void checkLooseArguments(Context& context, const CallExpr& node) {
  for (uint32_t i = 0; i < node.arguments.count; ++i) checkLoose(context, node, i);
}

// Forbids, in iec, a value for a declared EN in a call without names. IEC 61131-3 ed. 3, 6.6.1.4.2.
//   passes  r := g(a, b);  r := g(EN := TRUE, a := a, b := b);      fails   r := g(TRUE, a, b);      E0636
static bool passesEnable(Context& context, const CallExpr& node, PouId pou) {
  if (context.profile().enable_by_position || node.arguments.empty() || context.tree().list(node.arguments)[0].pin.name)
    return false;
  size_t inputs = 0;
  bool has_enable = false;
  for (const VarId id : pinsOf(context, pou)) {
    const Var& pin = context.symbols.var(id);
    if (pin.section == SectionKind::Output) continue;
    const bool is_enable = isEnable(string(context, pin.name));
    has_enable = has_enable || is_enable;
    inputs += is_enable ? 0 : 1;
  }
  if (!has_enable || node.arguments.count != inputs + 1 || context.symbols.pou(pou).extensible) return false;
  context.report(diag::EnableWithoutName, node.h.loc, {string(context, context.symbols.pou(pou).name)});
  return true;
}

namespace {

// Gives each argument of a call its pin.
class ArgumentMatcher {
 public:
  ArgumentMatcher(Context& context, const CallExpr& node, PouId pou)
      : context_(context), node_(node), pou_(pou), pins_(pinsOf(context, pou)), extra_(pins_.size()) {
    out_.slots.reserve(pins_.size());
  }

  Arguments run() {
    if (!checkFormality(context_, node_, pou_)) out_.ok = false;
    if (callee().extensible && node_.arguments.count > kMaxOperands) {
      context_.report(diag::TooManyArguments, argument(kMaxOperands).loc, {calleeName(), std::to_string(kMaxOperands)});
      out_.ok = false;
      return std::move(out_);
    }
    if (out_.ok && passesEnable(context_, node_, pou_)) {
      checkLooseArguments(context_, node_);
      out_.ok = false;
      return std::move(out_);
    }
    for (uint32_t i = 0; i < node_.arguments.count; ++i) {
      if (argument(i).pin.name)
        matchNamed(i);
      else if (isMistypedBinding(context_, pou_, argument(i).value))
        out_.ok = false;
      else
        matchByPosition(i);
    }
    return std::move(out_);
  }

 private:
  const Argument& argument(size_t index) const { return context_.tree().list(node_.arguments)[index]; }
  const Pou& callee() const { return context_.symbols.pou(pou_); }
  std::string_view calleeName() const { return string(context_, callee().name); }
  const Var& pin(size_t slot) const { return context_.symbols.var(pins_[slot]); }
  bool isOutput(size_t slot) const { return pin(slot).section == SectionKind::Output; }

  // f(a := 1, 2): an argument without name goes to the next pin that no argument before it has taken.
  bool isNamedAlready(size_t slot) const {
    return slot < out_.slots.size() && out_.slots[slot] != 0 && argument(out_.slots[slot] - 1).pin.name;
  }
  // iec: a call without names gives no value to EN and ENO that are declared. ed. 3, 6.6.1.4.2.
  bool isLeftOut(size_t slot) const {
    return !context_.profile().enable_by_position && isControl(string(context_, pin(slot).name));
  }

  bool put(size_t slot, uint32_t index) {
    if (out_.slots.size() <= slot) out_.slots.resize(slot + 1);
    if (out_.slots[slot] == 0) {
      out_.slots[slot] = index + 1;
      return true;
    }
    const Argument& second = argument(index);
    const Ident& name = second.pin.name ? second.pin : argument(out_.slots[slot] - 1).pin;
    context_.report(diag::DuplicatePin, second.pin.name ? second.pin.loc : second.loc, {string(context_, name.name)})
        .fix(withoutArgument(context_, node_, second));
    out_.ok = false;
    return false;
  }
  void putOrCheck(size_t slot, uint32_t index) {
    if (!put(slot, index)) checkLoose(context_, node_, index);
  }
  void refuse(uint32_t index) {
    out_.ok = false;
    checkLoose(context_, node_, index);
  }

  // The inputs in their order, more of an extensible function, then the outputs.
  void matchByPosition(uint32_t index) {
    ++out_.positional;
    while (input_ < pins_.size() && (isOutput(input_) || isNamedAlready(input_) || isLeftOut(input_))) ++input_;
    if (input_ < pins_.size()) return putOrCheck(input_++, index);
    if (callee().extensible) {
      put(extra_++, index);
      return;
    }
    while (output_ < pins_.size() && (!isOutput(output_) || isLeftOut(output_))) ++output_;
    if (output_ < pins_.size()) {
      put(output_++, index);
      return;
    }
    if (out_.ok && !isBroken(context_, pou_)) reportTooMany(argument(index));
    refuse(index);
  }

  void reportTooMany(const Argument& argument) {
    size_t inputs = 0;
    for (size_t slot = 0; slot < pins_.size(); ++slot) inputs += isOutput(slot) || isLeftOut(slot) ? 0 : 1;
    const Loc loc = argument.value ? context_.tree().begin(argument.value) : argument.loc;
    context_.report(diag::TooManyArguments, loc, {calleeName(), std::to_string(inputs)})
        .fix(withoutArguments(context_, node_, argument));
  }

  void matchNamed(uint32_t index) {
    const Argument& argument = this->argument(index);
    const size_t slot = slotNamed(argument.pin.name);
    if (slot == pins_.size()) return matchOtherName(index);
    noteMention(context_, entity(pins_[slot]), argument.pin.loc, Access::Pin);
    next_ = slot + 1;
    if (argument.is_output == isOutput(slot)) return putOrCheck(slot, index);
    context_
        .report(argument.is_output ? diag::ArrowToInput : diag::AssignToOutputPin, argument.pin.loc,
                {string(context_, pin(slot).name), calleeName(), kindName(pin(slot).section)})
        .fix(otherArrow(argument));
    refuse(index);
  }

  Fix otherArrow(const Argument& argument) const {
    if (!argument.value) return {};
    return otherSign(context_, argument.pin.loc, context_.tree().begin(argument.value),
                     argument.is_output ? "=>" : ":=", argument.is_output ? ":=" : "=>", Sureness::Sure);
  }

  // The pin of this name; the number of pins: there is none.
  size_t slotNamed(NameId name) const {
    if (next_ < pins_.size() && context_.names().same(pin(next_).name, name)) return next_;
    const VarId found = findPin(context_, pou_, name);
    return found ? static_cast<size_t>(std::find(pins_.begin(), pins_.end(), found) - pins_.begin()) : pins_.size();
  }

  // EN, ENO, and IN5 of an extensible function have no declaration.
  void matchOtherName(uint32_t index) {
    const Argument& argument = this->argument(index);
    const NameId name = argument.pin.name;
    if (isNamed(context_, name, kEnable) && !argument.is_output) {
      out_.en = index + 1;
      return;
    }
    if (isNamed(context_, name, kEnableOutput) && argument.is_output) {
      out_.eno = index + 1;
      return;
    }
    const int more = callee().extensible ? extensibleSlot(context_, pou_, name) : -1;
    if (more >= 0 && !argument.is_output) return putOrCheck(static_cast<size_t>(more), index);
    if (!isBroken(context_, pou_))
      context_.report(diag::UnknownPin, argument.pin.loc, {calleeName(), string(context_, name)})
          .didYouMean(nearestPin(context_, pou_, name));
    refuse(index);
  }

  Context& context_;
  const CallExpr& node_;
  PouId pou_;
  std::span<const VarId> pins_;
  Arguments out_;
  size_t next_ = 0;                // the pin after the last one named: calls mostly keep the order
  size_t input_ = 0, output_ = 0;  // the next pins of arguments without name
  size_t extra_;                   // the next slot of an extensible function's further inputs
};

}  // namespace

Arguments matchArguments(Context& context, const CallExpr& node, PouId pou) {
  return ArgumentMatcher(context, node, pou).run();
}

void bindControlPins(Context& context, const CallExpr& node, const Arguments& arguments, Call& call) {
  if (arguments.en != 0) {
    ExprId en = context.tree().list(node.arguments)[arguments.en - 1].value;
    if (en) checkAs(context, en, types::kBool, Purpose{Use::PassedToEn, {}, {}});
    context.code().list(node.arguments)[arguments.en - 1].value = en;
    call.en = en;
  }
  if (arguments.eno != 0) {
    ExprId eno = context.tree().list(node.arguments)[arguments.eno - 1].value;
    if (eno) {
      const TypeId type = check(context, eno, types::kBool, Access::Write);
      const Purpose purpose{Use::BoundToEno, {}, {}};
      if (type != types::kError && checkWritable(context, eno, purpose)) {
        reportFit(context, fit(context, types::kBool, type), eno, types::kBool, type,
                  Purpose{Use::CopiedFromEno, {}, {}});
      }
    }
    context.code().list(node.arguments)[arguments.eno - 1].value = eno;
    call.eno = eno;
  }
}

namespace {

// The call of GET in `pump.Level` or `pump.State.text`, which is checked; none: no property is read.
ExprId propertyCallIn(Context& context, ExprId value) {
  for (;;) {
    const ExprKind kind = context.tree().kind(value);
    if (kind == ExprKind::Deref)
      value = context.tree().as<DerefExpr>(value).base;
    else if (kind == ExprKind::Member)
      value = context.tree().as<MemberExpr>(value).base;
    else
      return kind == ExprKind::Call ? value : ExprId{};
  }
}

// `pump.Level;` reads a property, so its GET runs; TwinCAT accepts it with a warning.
void readProperty(Context& context, ExprId& expr, ExprId value) {
  value = propertyCallIn(context, value);
  if (!value) return;  // reported
  const CallId get = context.meaning(value).call;
  NameId name = nameOf(context, context.tree().as<CallExpr>(expr).callee);
  for (const Property& property : context.symbols.properties)
    if (get && property.get && property.get == context.symbols.call(get).pou) name = property.name;
  context.report(diag::PropertyUnused, context.tree().begin(expr), {string(context, name)})
      .fix(withoutStatement(context, context.tree().begin(expr), context.tree().as<CallExpr>(expr).end));
  context.replace(expr, value);
}

// `name;` calls an action, a program or a method without parameters, or reads a property (codesys). Anything else does
// nothing.
// False: not a call.
bool isBareCall(Context& context, ExprId& expr) {
  const CallExpr& node = context.tree().as<CallExpr>(expr);
  ExprId callee = node.callee;
  Entity found;
  if (context.tree().kind(callee) == ExprKind::Name) {
    found = lookUp(context, context.tree().as<NameExpr>(callee));
    if (found.entityKind() == EntityKind::Property) check(context, callee, {}, Access::Read);
  } else {
    const uint32_t errors = context.symbols.diagnostics.errorCount();
    check(context, callee, {}, Access::Qualifier);
    found = entityOf(context, node.callee);
    if (context.symbols.diagnostics.errorCount() != errors && found.entityKind() != EntityKind::Pou) return false;
  }
  const Pou* pou = found.entityKind() == EntityKind::Pou ? &context.symbols.pous[found.index] : nullptr;
  if (pou != nullptr && (pou->owner || pou->kind == PouKind::Program)) return true;
  if (found.entityKind() == EntityKind::Property || propertyCallIn(context, callee)) {
    readProperty(context, expr, callee);
    return false;
  }
  const Loc begin = context.tree().begin(node.callee);
  const std::string_view source = context.symbols.sources.sourceText(context.symbols.sources.fileOf(begin));
  const uint32_t from = begin.offset - context.symbols.sources.begin(context.symbols.sources.fileOf(begin)).offset;
  const std::string shown(source.substr(from, node.end.offset - begin.offset));
  if (found.entityKind() == EntityKind::Var && !context.type(node.callee)) check(context, callee, {}, Access::Read);
  const TypeId type = context.type(node.callee);
  const bool is_value = found.entityKind() == EntityKind::Var || found.entityKind() == EntityKind::None;
  const bool is_block = type && isInstance(context, type);  // most likely meant to be called
  if (!type || type == types::kError || !is_value || is_block) {
    if (type != types::kError) {
      Report report = context.report(diag::NoEffect, begin, {shown});
      if (is_block) report.insert(node.end, "()", Sureness::Proposal);
      report.fix(withoutStatement(context, begin, node.end));
    }
    return false;
  }
  // CODESYS, "Compiler error C0139": a warning for a variable.
  context.report(diag::NoEffectWarning, begin, {shown}).fix(withoutStatement(context, begin, node.end));
  context.replace(expr, makeInteger(context, types::kInt, 0, begin));
  return false;
}

}  // namespace

TypeId checkCall(Context& context, ExprId& expr, TypeId expected, bool as_statement) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  if (node.is_bare && !isBareCall(context, expr)) return meaning(node.h).type = types::kError;
  if (context.tree().kind(node.callee) == ExprKind::Name) {
    NameExpr& callee = context.code().as<NameExpr>(node.callee);
    meaning(callee.h).entity = lookUp(context, callee, callee.h.loc);
    switch (meaning(callee.h).entity.entityKind()) {
      case EntityKind::None: return callUnknown(context, expr, callee.name, expected, as_statement);
      case EntityKind::Pou: {
        const PouId pou{meaning(callee.h).entity.index};
        const PouId owner = context.symbols.pou(pou).owner;
        if (owner && !mayAccess(context, context.symbols.pou(pou).access, owner, callee.name, callee.h.loc))
          return refuse(context, node);
        return callPou(context, expr, pou, expected, as_statement);
      }
      case EntityKind::Error: return refuse(context, node);
      case EntityKind::Var:
        if (VarId{meaning(callee.h).entity.index} == context.symbols.pou(context.pou).result_var) {
          return callPou(context, expr, context.pou, expected, as_statement);  // recursion
        }
        [[fallthrough]];
      case EntityKind::Type:
      case EntityKind::EnumValue:
      case EntityKind::GlobalList:
      case EntityKind::Namespace:
      case EntityKind::Property:
      case EntityKind::Program: break;
    }
    return callValue(context, expr, check(context, node.callee, {}, Access::Call), as_statement);
  }
  if (context.tree().kind(node.callee) == ExprKind::Member) {
    TypeId type = check(context, node.callee, {}, Access::Qualifier);
    type = throughObject(context, node.callee, type);
    const Entity entity = entityOf(context, node.callee);
    if (!type && entity.entityKind() == EntityKind::Pou) {
      return callPou(context, expr, PouId{entity.index}, expected, as_statement);
    }
    if (!type) return refuse(context, node);
    if (entity.entityKind() == EntityKind::Var)
      markAccess(context, VarId{entity.index}, Access::ReadWrite, context.tree().loc(node.callee));
    return callValue(context, expr, type, as_statement);
  }
  const TypeId type = check(context, node.callee, {}, Access::Call);
  return callValue(context, expr, throughObject(context, node.callee, type), as_statement);
}

}  // namespace rung::sema

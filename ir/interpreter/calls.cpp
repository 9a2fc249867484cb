// SPDX-License-Identifier: Apache-2.0
// Calls of the translated code: a caller writes the arguments into the frame that the callee is going to have, after
// its own; the result is read from there. See translate.h.
#include <algorithm>

#include "frontend/source/invariant.h"
#include "ir/builder.h"
#include "ir/interpreter/translate.h"
#include "ir/walk.h"

namespace rung::ir::interpreter {

const Native* findNative(std::span<const Native> natives, std::string_view function) {
  const auto at = std::lower_bound(natives.begin(), natives.end(), function,
                                   [](const Native& native, std::string_view wanted) { return native.name < wanted; });
  return at != natives.end() && at->name == function ? &*at : nullptr;
}

NativeThunk BodyTranslator::findNative(const Body& callee) {
  if (const Native* native = interpreter::findNative(options_.natives, nativeName(module_, callee)))
    return native->call;
  if (code_.missing.empty()) code_.missing = module_.names.string(callee.spelling ? callee.spelling : callee.name);
  return nullptr;
}

// The arguments of a call and where they go; `at` is the offset of the first in the callee's frame.
std::vector<BodyTranslator::Argument> BodyTranslator::arguments(const Body& callee, Slice<ExprId> operands,
                                                                uint32_t at) {
  std::vector<Argument> out;
  uint32_t i = 0;
  for (const Local& parameter : parameters(callee)) {
    if (i == operands.count) break;
    out.push_back({&parameter, body_->list(operands)[i], {at + 8 * i, true}, false, {}});
    ++i;
  }
  return out;
}

void BodyTranslator::passArgument(Argument& argument, Ref to) {
  const Local& parameter = *argument.parameter;
  if (!parameter.by_reference) {
    valueInto(argument.operand, {Mode::Frame, to, 0});
    return;
  }
  if (!argument.operand) {  // a discarded output
    const Ref memory = slot(info(parameter.type).size, info(parameter.type).align);
    return pointerInto({Base::Frame, memory, 0, 0, kNoBit}, to);
  }
  const Expr& e = expr(argument.operand);
  if (isPlace(e.kind) && (e.kind == ExprKind::Bits || isImage(*body_, argument.operand))) {
    // Bits and views of the image are not variables in memory: copied in, and back after the call.
    argument.copied = true;
    argument.copy = {Base::Frame, slot(info(parameter.type).size, info(parameter.type).align), 0, 0, kNoBit};
    if (isAggregate(e.type) || isString(e.type)) {
      copyAggregate(argument.copy, place(argument.operand), info(e.type).size);
    } else {
      valueInto(argument.operand, direct(argument.copy));
    }
    return pointerInto(argument.copy, to);
  }
  if (isString(parameter.type) && parameter.kind == LocalKind::Input) return pointerInto(string(argument.operand), to);
  pointerInto(place(argument.operand), to);
}

// A call inside an argument uses the same memory for its own arguments: then all arguments are evaluated before.
void BodyTranslator::passArguments(std::vector<Argument>& arguments) {
  bool nests = false;
  for (const Argument& argument : arguments) {
    nests = nests || (argument.operand && contains(*body_, argument.operand, ExprKind::Call));
  }
  if (!nests) {
    for (Argument& argument : arguments) passArgument(argument, argument.to);
    return;
  }
  std::vector<Ref> created;
  for (Argument& argument : arguments) {
    created.push_back(slot());
    passArgument(argument, created.back());
  }
  for (size_t i = 0; i < arguments.size(); ++i) {
    move(Scalar::U64, {Mode::Frame, created[i], 0}, {Mode::Frame, arguments[i].to, 0});
  }
}

// Reports calls by code of the project, not calls inside libraries, of their functions or of initialisers.
void BodyTranslator::emitCall(BodyId id, const Address* self, uint32_t site) {
  const Ref frame{0, true};
  uint32_t insn;
  if (self == nullptr) {
    insn = emit(callHandler(), frame, {}, {}, 0, site);
  } else if (self->base == Base::Self) {
    insn = emit(callOnSelfHandler(), frame, self->ref, {}, 0, site);
  } else {
    insn = emit(callOnPointerHandler(), frame, pointerTo(*self), {}, 0, site);
  }
  code_.calls.push_back({insn, id});
}

void BodyTranslator::emitVirtualCall(BodyId method, const Address& self, uint32_t site) {
  size_t i = 0;
  while (i < module_.dispatches.size() && module_.dispatches[i].method != method) ++i;
  RUNG_INVARIANT(i < code_.dispatches.size(), "a virtual call has its dispatch");
  const auto count = static_cast<uint32_t>(code_.dispatches[i].size());
  code_.virtual_calls.push_back({module_.dispatches[i].first, count, site, code_.dispatches[i].data()});
  const uint32_t insn = emit(callVirtualHandler(), {0, true}, pointerTo(self), {}, 0,
                             reinterpret_cast<int64_t>(&code_.virtual_calls.back()));
  code_.insns[insn].d = insn;
}

namespace {

// Bytes before the arguments.
uint32_t headerSize(const Body& callee) { return callee.native ? 0 : kFrameHeader; }

// Bytes after the frame that a native function's slots take.
uint32_t slotsOf(const Body& callee, size_t arguments) {
  return static_cast<uint32_t>((arguments + 4 + (callee.self ? 1 : 0)) * 8);
}

}  // namespace

// Passes the operands; where the result will be.
Ref BodyTranslator::passOperands(const CallExpr& call) {
  const Body& callee = module_.body(call.callee);
  std::vector<Argument> passed = arguments(callee, call.operands, headerSize(callee));
  traceCall(call.callee, nullptr);
  passArguments(passed);
  if (callee.native) native_slots_ = std::max(native_slots_, slotsOf(callee, passed.size()));
  return {headerSize(callee) + 8 * static_cast<uint32_t>(passed.size()), true};
}

Operand BodyTranslator::callExpression(const Expr& e, const Operand* want) {
  const CallExpr call = e.as<CallExpr>();
  const Body& callee = module_.body(call.callee);
  const Ref result = passOperands(call);
  if (callee.native)
    emit(nativeHandler(), {0, true}, {}, {}, 0, reinterpret_cast<int64_t>(findNative(callee)));
  else
    emitCall(call.callee, nullptr, site(e.loc));
  const Operand to = target(want);  // another call of the expression would overwrite it
  move(scalarOf(e.type), {Mode::Frame, result, 0}, to);
  return to;
}

Address BodyTranslator::callString(const Expr& e) {
  const CallExpr call = e.as<CallExpr>();
  const Body& callee = module_.body(call.callee);
  const Ref result = passOperands(call);
  const Address to = stringBuffer(callee.result);
  pointerInto(to, result);
  if (callee.native)
    emit(moveHandler(Scalar::U64, Mode::Constant, Mode::Frame), {result.offset + 8, true}, {}, {}, 0,
         capacityOf(callee.result));
  if (callee.native)
    emit(nativeHandler(), {0, true}, {}, {}, 0, reinterpret_cast<int64_t>(findNative(callee)));
  else
    emitCall(call.callee, nullptr, site(e.loc));
  return to;
}

void BodyTranslator::callStatement(const CallStmt& stmt, Loc loc) {
  const BodyId id = stmt.callee;
  const Body& callee = module_.body(id);
  Address self;
  if (stmt.self) {
    self = place(stmt.self);
    if (self.base != Base::Self) self = {Base::Pointer, pointerTo(self), 0, 0, kNoBit};
  }
  traceCall(id, stmt.self ? &self : nullptr);
  const bool has_self_slot = callee.native && callee.self;
  const uint32_t at = callee.native ? (has_self_slot ? 8 : 0) : kFrameHeader;
  std::vector<Argument> passed = arguments(callee, stmt.operands, at);
  passArguments(passed);
  const Ref result{at + 8 * static_cast<uint32_t>(passed.size()), true};
  const ExprId to = stmt.result;
  if (to && ir::mayFault(*body_, to)) place(to);  // its checks come before the call

  // A result in memory is written directly to its target where it can be, else to a slot.
  const bool by_reference = callee.result && ir::isAggregate(types_, callee.result);
  const bool direct_result = by_reference && canHoldResult(stmt, callee, passed);
  Address memory;
  if (by_reference) {
    const TypeId type = direct_result ? expr(to).type : callee.result;
    memory = direct_result ? place(to) : Address{Base::Frame, slot(info(type).size, info(type).align), 0, 0, kNoBit};
    pointerInto(memory, result);
    if (callee.native && isString(callee.result)) {
      emit(moveHandler(Scalar::U64, Mode::Constant, Mode::Frame), {result.offset + 8, true}, {}, {}, 0,
           capacityOf(type));
    }
  }
  emitCallOf(stmt, self, passed.size(), loc);
  if (to && by_reference && !direct_result) {
    const TypeId type = expr(to).type;
    if (isString(type))
      copyString(place(to), capacityOf(type), isWide(type), memory, callee.result);
    else
      copyAggregate(place(to), memory, info(type).size);
  } else if (to && !by_reference && callee.result) {
    storeResult(to, result);
  }
  copyBack(passed);
}

// Nothing that the callee reads can be where the result goes, and it has room there.
bool BodyTranslator::canHoldResult(const CallStmt& stmt, const Body& callee,
                                   const std::vector<Argument>& passed) const {
  const ExprId to = stmt.result;
  if (!to || isImage(*body_, to) || expr(to).kind == ExprKind::Bits) return false;
  const TypeId type = expr(to).type;
  if (isString(callee.result)) {
    if (!callee.native && capacityOf(type) < capacityOf(callee.result)) return false;
    if (isWide(type) != isWide(callee.result)) return false;
  }
  if (callee.native) return true;
  const uint32_t* const root = localOf(expr(rootOf(*body_, to)));
  if (root == nullptr || body_->locals[*root].by_reference) return false;
  return std::none_of(passed.begin(), passed.end(), [&](const Argument& argument) {
    if (!argument.operand || !isPlace(expr(argument.operand).kind)) return false;
    const uint32_t* const other = localOf(expr(rootOf(*body_, argument.operand)));
    return other != nullptr && *other == *root;
  });
}

void BodyTranslator::emitCallOf(const CallStmt& stmt, const Address& self, size_t passed, Loc loc) {
  const Body& callee = module_.body(stmt.callee);
  if (callee.native) {
    native_slots_ = std::max(native_slots_, slotsOf(callee, passed));
    if (callee.self) pointerInto(self, {0, true});
    emit(nativeHandler(), {0, true}, {}, {}, 0, reinterpret_cast<int64_t>(findNative(callee)));
  } else if (stmt.is_virtual) {
    emitVirtualCall(stmt.callee, self, site(loc));
  } else {
    emitCall(stmt.callee, stmt.self ? &self : nullptr, site(loc));
  }
}

void BodyTranslator::storeResult(ExprId to, Ref result) {
  const Scalar type = scalarOf(to);
  Operand value{Mode::Frame, result, 0};
  if (contains(*body_, to, ExprKind::Call)) {  // the place would overwrite it
    value = temp();
    move(type, {Mode::Frame, result, 0}, value);
  }
  write(place(to), type, value);
}

// Variables that were passed as copies get their values.
void BodyTranslator::copyBack(const std::vector<Argument>& passed) {
  for (const Argument& argument : passed) {
    if (!argument.copied || argument.parameter->kind == LocalKind::Input) continue;
    const Expr& e = expr(argument.operand);
    if (isAggregate(e.type) || isString(e.type))
      copyAggregate(place(argument.operand), argument.copy, info(e.type).size);
    else
      write(place(argument.operand), scalarOf(argument.operand), direct(argument.copy));
  }
}

}  // namespace rung::ir::interpreter

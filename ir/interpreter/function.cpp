// SPDX-License-Identifier: Apache-2.0
// Runs one function with a budget: see function.h.
#include "ir/interpreter/function.h"

#include <cstring>
#include <memory>

#include "ir/builder.h"
#include "ir/interpreter/translate.h"
#include "rung/code.h"

namespace rung::ir::interpreter {

using types::TypeKind;
using types::TypeTable;

namespace {

constexpr size_t kConstantStack = size_t{1} << 20;

// The function and all that it may call.
std::vector<BodyId> reachable(const Module& module, BodyId from) {
  std::vector<BodyId> out{from};
  std::vector<bool> is_listed(module.bodies.size());
  is_listed[from.index] = true;
  const auto note = [&](BodyId id) {
    if (is_listed[id.index]) return;
    is_listed[id.index] = true;
    out.push_back(id);
  };
  for (size_t i = 0; i < out.size(); ++i) {
    const Body& body = module.body(out[i]);
    for (size_t e = 1; e < body.exprs.size(); ++e) {
      if (const auto* call = body.exprs[e].tryAs<CallExpr>()) note(call->callee);
    }
    for (size_t s = 1; s < body.stmts.size(); ++s) {
      if (const auto* call = body.stmts[s].tryAs<CallStmt>()) note(call->callee);
    }
  }
  return out;
}

// A value in its form in memory.
uint64_t memoryBits(const TypeTable& types, TypeId type, const types::Value& value) {
  if (types.plainKind(type) == TypeKind::Real) return rung_bits_of_f32(static_cast<float>(value.asReal()));
  return value.bits;
}

types::Value valueOf(const TypeTable& types, TypeId type, uint64_t bits) {
  const TypeKind kind = types.plainKind(type);
  if (kind == TypeKind::Real)
    return types::Value::ofReal(type, static_cast<double>(rung_f32_of(static_cast<uint32_t>(bits))));
  const uint32_t width = TypeTable::bitWidth(kind);
  if (width > 0 && width < 64) {
    bits &= (uint64_t{1} << width) - 1;
    if (types.isSigned(kind) && (bits >> (width - 1)) != 0) bits |= ~uint64_t{0} << width;
  }
  return {type, bits};
}

// The frame of a function that runs alone: its arguments, and the memory that by-reference ones point to.
class Call {
 public:
  Call(const Module& module, const Body& body, uint32_t frame)
      : types_(module.types),
        body_(body),
        stack_(std::make_unique<uint64_t[]>((kConstantStack + 2 * size_t{frame}) / 8)) {
    *reinterpret_cast<Linkage*>(fp()) = {&halt_, nullptr, nullptr};
  }
  uint8_t* fp() { return reinterpret_cast<uint8_t*>(stack_.get()); }

  void pass(std::span<const types::Value> arguments, const Names& names);
  types::Value result(Names& names);

 private:
  uint64_t* room(TypeId type) {
    memory_.push_back(std::make_unique<uint64_t[]>(types_.info(types_.resolve(type)).size / 8 + 1));
    return memory_.back().get();
  }
  void put(uint64_t bits) {
    memcpy(fp() + at_, &bits, 8);
    at_ += 8;
  }
  uint32_t capacityOf(TypeId type) const { return types_.info(types_.resolve(type)).length; }
  void store(const Local& parameter, const types::Value& value, const Names& names, uint64_t* cell);

  const TypeTable& types_;
  const Body& body_;
  const Insn halt_{haltHandler(), 0, 0, 0, 0, 0};
  std::unique_ptr<uint64_t[]> stack_;
  std::vector<std::unique_ptr<uint64_t[]>> memory_;
  uint64_t* result_memory_ = nullptr;
  uint32_t at_ = 0;  // of the next argument, then of the result
};

// A value in the memory of a by-reference parameter.
void Call::store(const Local& parameter, const types::Value& value, const Names& names, uint64_t* cell) {
  const TypeKind kind = types_.kind(parameter.type);
  if (!TypeTable::isString(kind)) {
    if (types_.info(types_.resolve(parameter.type)).size <= 8) cell[0] = memoryBits(types_, parameter.type, value);
    return;
  }
  if (!value.type) return;
  const std::string text(names.string(NameId{static_cast<uint32_t>(value.bits)}));
  const uint32_t capacity = capacityOf(parameter.type);
  if (kind == TypeKind::WString) {
    rung_wstring_of_string(reinterpret_cast<char16_t*>(cell), capacity, text.c_str());
  } else if (kind == TypeKind::UString) {
    rung_ustring_assign(reinterpret_cast<char*>(cell), capacity, text.c_str());
  } else {
    rung_string_assign(reinterpret_cast<char*>(cell), capacity, text.c_str());
  }
}

void Call::pass(std::span<const types::Value> arguments, const Names& names) {
  at_ = body_.native ? 0 : kFrameHeader;
  size_t next = 0;
  for (const Local& parameter : parameters(body_)) {
    types::Value value;
    if (parameter.kind != LocalKind::Output && next < arguments.size()) value = arguments[next++];
    if (parameter.by_reference) {
      uint64_t* const cell = room(parameter.type);
      store(parameter, value, names, cell);
      put(reinterpret_cast<uintptr_t>(cell));
    } else {
      put(memoryBits(types_, parameter.type, value));
    }
  }
  if (!body_.result || !isAggregate(types_, body_.result)) return;
  result_memory_ = room(body_.result);
  memcpy(fp() + at_, &result_memory_, 8);
  const uint64_t capacity = capacityOf(body_.result);
  if (body_.native) memcpy(fp() + at_ + 8, &capacity, 8);
}

types::Value Call::result(Names& names) {
  if (!body_.result) return {};
  const TypeKind kind = types_.kind(body_.result);
  if (result_memory_ == nullptr) {
    uint64_t bits;
    memcpy(&bits, fp() + at_, 8);
    return valueOf(types_, body_.result, bits);
  }
  if (kind == TypeKind::String || kind == TypeKind::UString)
    return {body_.result, names.intern(reinterpret_cast<const char*>(result_memory_)).index};
  if (kind != TypeKind::WString) return {};
  const uint32_t capacity = capacityOf(body_.result);
  std::string text(size_t{capacity} * 3 + 1, '\0');
  rung_string_of_wstring(text.data(), capacity * 3, reinterpret_cast<const char16_t*>(result_memory_));
  return {body_.result, names.intern(text.c_str()).index};
}

// Runs translated or native code in a frame; returns the fault.
uint8_t runGuarded(NativeThunk native, const Insn* ip, uint8_t* fp, int64_t budget) {
  rung_context ctx{};
  Machine machine;
  machine.ctx = &ctx;
  machine.limit = fp + kConstantStack;
  ctx.step_limit = budget;
  ctx.steps = budget;
  struct Start {
    NativeThunk native;
    const Insn* ip;
    uint8_t* fp;
    Machine* m;
  } start{native, ip, fp, &machine};
  return rung_try(
      &ctx,
      [](void* data) {
        const Start& from = *static_cast<Start*>(data);
        if (from.native != nullptr) return from.native(from.m->ctx, reinterpret_cast<uint64_t*>(from.fp));
        execute(from.ip, from.fp, nullptr, from.m);
      },
      &start);
}

}  // namespace

FunctionResult runFunction(const Module& module, BodyId function, std::span<const types::Value> arguments,
                           std::span<const Native> natives, int64_t budget, Names& names) {
  FunctionResult result;
  const MemoryBlocks blocks(module);
  StringPool pool;
  Code code;
  TranslateOptions options;
  options.natives = natives;
  options.bounded = true;
  BodyTranslator translator(module, blocks, pool, options, code);
  code.bodies.resize(module.bodies.size());
  translateData(module, code);
  for (const BodyId id : reachable(module, function)) {
    if (!module.body(id).native) translator.translate(id);
  }
  link(module, code);
  const Body& body = module.body(function);
  NativeThunk native = nullptr;
  if (body.native) native = translator.findNative(body);
  if (!code.missing.empty()) {
    result.trouble = "calls the native function `" + code.missing + "`";
    return result;
  }

  const Code::Entry& entry = code.bodies[function.index];
  Call call(module, body, entry.frame);
  call.pass(arguments, names);
  const uint8_t fault = runGuarded(native, code.insns.data() + entry.at, call.fp(), budget);
  if (fault == RUNG_FAULT_STACK || fault == RUNG_FAULT_STOP) {
    result.trouble = "does not end within its bounds";
  } else if (fault != RUNG_FAULT_NONE) {
    result.fault = static_cast<types::Fault>(fault);
  } else {
    result.value = call.result(names);
  }
  return result;
}

}  // namespace rung::ir::interpreter

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

  const Insn halt{haltHandler(), 0, 0, 0, 0, 0};
  const auto stack = std::make_unique<uint64_t[]>((kConstantStack + 2 * size_t{code.bodies[function.index].frame}) / 8);
  auto* const fp = reinterpret_cast<uint8_t*>(stack.get());
  *reinterpret_cast<Linkage*>(fp) = {&halt, nullptr, nullptr};
  std::vector<std::unique_ptr<uint64_t[]>> memory;
  uint32_t at = body.native ? 0 : kFrameHeader;
  size_t next = 0;
  uint64_t* result_memory = nullptr;
  const auto room = [&](TypeId type) {
    memory.push_back(std::make_unique<uint64_t[]>(module.types.info(module.types.resolve(type)).size / 8 + 1));
    return memory.back().get();
  };
  for (const Local& local : parameters(body)) {
    const bool takes = local.kind != LocalKind::Output;
    uint64_t bits = 0;
    types::Value value;
    if (takes && next < arguments.size()) value = arguments[next++];
    const bool is_string = TypeTable::isString(module.types.kind(local.type));
    if (!is_string) bits = memoryBits(module.types, local.type, value);
    if (local.by_reference) {
      uint64_t* const cell = room(local.type);
      if (is_string && value.type) {
        auto* const to = reinterpret_cast<char*>(cell);
        const uint32_t capacity = module.types.info(module.types.resolve(local.type)).length;
        const std::string text(names.string(NameId{static_cast<uint32_t>(value.bits)}));
        if (module.types.kind(local.type) == TypeKind::WString) {
          rung_wstring_of_string(reinterpret_cast<char16_t*>(to), capacity, text.c_str());
        } else if (module.types.kind(local.type) == TypeKind::UString) {
          rung_ustring_assign(to, capacity, text.c_str());
        } else {
          rung_string_assign(to, capacity, text.c_str());
        }
      } else if (!is_string && module.types.info(module.types.resolve(local.type)).size <= 8) {
        cell[0] = bits;
      }
      bits = reinterpret_cast<uintptr_t>(cell);
    }
    memcpy(fp + at, &bits, 8);
    at += 8;
  }
  if (body.result && isAggregate(module.types, body.result)) {
    result_memory = room(body.result);
    memcpy(fp + at, &result_memory, 8);
    const uint64_t capacity = module.types.info(module.types.resolve(body.result)).length;
    if (body.native) memcpy(fp + at + 8, &capacity, 8);
  }

  rung_context ctx{};
  Machine machine;
  machine.ctx = &ctx;
  machine.limit = fp + kConstantStack;
  machine.budget = budget;
  struct Start {
    NativeThunk native;
    const Insn* ip;
    uint8_t* fp;
    Machine* m;
  } start{native, code.insns.data() + code.bodies[function.index].at, fp, &machine};
  const uint8_t fault = rung_try(
      &ctx,
      [](void* data) {
        const Start& from = *static_cast<Start*>(data);
        if (from.native != nullptr) return from.native(from.m->ctx, reinterpret_cast<uint64_t*>(from.fp));
        execute(from.ip, from.fp, nullptr, from.m);
      },
      &start);
  if (fault == RUNG_FAULT_STACK) {
    result.trouble = "does not end within its bounds";
  } else if (fault != RUNG_FAULT_NONE) {
    result.fault = static_cast<types::Fault>(fault);
  } else if (body.result && result_memory == nullptr) {
    uint64_t bits;
    memcpy(&bits, fp + at, 8);
    result.value = valueOf(module.types, body.result, bits);
  } else if (body.result && (module.types.kind(body.result) == TypeKind::String ||
                             module.types.kind(body.result) == TypeKind::UString)) {
    result.value = {body.result, names.intern(reinterpret_cast<const char*>(result_memory)).index};
  } else if (body.result && module.types.kind(body.result) == TypeKind::WString) {
    const uint32_t capacity = module.types.info(module.types.resolve(body.result)).length;
    std::string text(size_t{capacity} * 3 + 1, '\0');
    rung_string_of_wstring(text.data(), capacity * 3, reinterpret_cast<const char16_t*>(result_memory));
    result.value = {body.result, names.intern(text.c_str()).index};
  }
  return result;
}

}  // namespace rung::ir::interpreter

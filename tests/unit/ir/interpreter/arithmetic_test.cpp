// SPDX-License-Identifier: Apache-2.0
// The interpreter's instructions against the arithmetic kernel: every operator and conversion of every scalar type on
// values at the limits, with operands in the instance, in the frame and constant.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "ir/builder.h"
#include "ir/interpreter/program.h"

namespace rung::ir::interpreter {
namespace {

using types::Op;
using types::TypeKind;
using types::TypeTable;
using types::Value;

// A program whose variable `n` is the operator's result for case n.
class Bench {
 public:
  Bench() : types(names, 8), module(types, names, sources) {
    module.bodies.emplace_back();
    body().kind = BodyKind::Block;
    body().name = body().spelling = names.intern("P");
    body().exprs.emplace_back();
    body().stmts.emplace_back();
    record = types.addRecord(types::RecordKind::Program, names.intern("P"));
    body().self = record;
  }

  Body& body() { return module.bodies[1]; }
  uint32_t field(TypeId type) {
    types::Field created;
    created.name = names.intern("v" + std::to_string(types.info(record).fields.size()));
    created.type = type;
    types.edit(record).fields.push_back(created);
    return static_cast<uint32_t>(types.info(record).fields.size() - 1);
  }

  void make(Builder& b, Block outer) {
    body().first = b.close(outer);
    ASSERT_TRUE(types.layout(record));
    Record row;
    row.type = record;
    row.name = names.intern("P");
    row.body = {1};
    module.records.push_back(row);
    ProgramInstance instance;
    instance.name = names.intern("P");
    instance.record = record;
    instance.body = {1};
    instance.task = 1;
    module.programs.push_back(instance);
    module.tasks.emplace_back();
    module.tasks[0].name = names.intern("T");
    program = std::make_unique<Program>(module, ProgramOptions{});
    ASSERT_EQ(program->refusal(), "");
    memory.resize(types.info(record).size / 8 + 1);
    block = memory.data();
    context.blocks = &block;
    context.module = &program->description();
  }

  void run() {
    const rung_task* const task = rung_task_at(&program->description(), 0);
    context.entry = task;
    ASSERT_EQ(rung_guarded(&context, task->run), RUNG_FAULT_NONE);
  }

  uint8_t* at(uint32_t number) {
    return reinterpret_cast<uint8_t*>(memory.data()) + types.info(record).fields[number].offset;
  }
  void put(uint32_t number, const Value& value) {
    const TypeKind kind = types.plainKind(value.type);
    if (kind == TypeKind::Real) {
      const auto narrow = static_cast<float>(value.asReal());
      memcpy(at(number), &narrow, 4);
    } else {
      memcpy(at(number), &value.bits, types.info(types.resolve(value.type)).size);
    }
  }
  uint64_t get(uint32_t number) {
    const TypeId type = types.info(record).fields[number].type;
    const TypeKind kind = types.plainKind(type);
    uint64_t bits = 0;
    memcpy(&bits, at(number), types.info(types.resolve(type)).size);
    if (kind == TypeKind::Real) {
      float narrow;
      memcpy(&narrow, at(number), 4);
      return Value::ofReal(type, static_cast<double>(narrow)).bits;
    }
    const uint32_t width = TypeTable::bitWidth(kind);
    if (width >= 8 && width < 64 && types.isSigned(kind) && (bits >> (width - 1)) != 0) bits |= ~uint64_t{0} << width;
    return bits;
  }

  Sources sources;
  Names names;
  TypeTable types;
  Module module;
  TypeId record;
  std::unique_ptr<Program> program;
  std::vector<uint64_t> memory;
  void* block = nullptr;
  rung_context context{};
};

std::vector<Value> edges(const TypeTable& types, TypeId type) {
  std::vector<Value> out;
  const TypeKind kind = types.plainKind(type);
  if (TypeTable::isReal(kind)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (double x : {0.0,
                     -0.0,
                     1.0,
                     -1.0,
                     0.5,
                     1.5,
                     2.5,
                     -2.5,
                     0.1,
                     127.5,
                     255.5,
                     32767.5,
                     -32768.5,
                     2147483647.5,
                     4294967295.5,
                     9223372036854775807.0,
                     18446744073709551615.0,
                     1e20,
                     -1e20,
                     3e38,
                     kInfinity,
                     -kInfinity,
                     std::nan("")}) {
      if (kind == TypeKind::Real) x = static_cast<double>(static_cast<float>(x));
      out.push_back(Value::ofReal(type, x));
    }
    return out;
  }
  const uint32_t width = TypeTable::bitWidth(kind);
  if (width == 1) return {{type, 0}, {type, 1}};
  const uint64_t low = types.isSigned(kind) ? ~uint64_t{0} << (width - 1) : 0;
  const uint64_t high = ~low >> (types.isSigned(kind) ? 0 : 64 - width);
  for (const uint64_t bits : {uint64_t{0}, uint64_t{1}, uint64_t{2}, uint64_t{3}, uint64_t{7}, uint64_t{100}, low,
                              low + 1, high, high - 1, high / 2}) {
    out.push_back({type, bits});
  }
  if (types.isSigned(kind)) {
    for (const int64_t n : {-1, -2, -7}) out.push_back({type, static_cast<uint64_t>(n)});
  }
  return out;
}

std::vector<TypeId> scalars() {
  std::vector<TypeId> out;
  for (int kind = static_cast<int>(TypeKind::Bool); kind <= static_cast<int>(TypeKind::WChar); ++kind)
    out.push_back(types::idOf(static_cast<TypeKind>(kind)));
  return out;
}

bool isFor(Op op, TypeKind kind) {
  const bool bits = op == Op::And || op == Op::Or || op == Op::Xor || op == Op::Not;
  if (types::isComparison(op)) return true;
  if (kind == TypeKind::Bool) return bits;
  if (TypeTable::isReal(kind)) return !bits && !(op >= Op::Shl && op <= Op::Ror);
  return true;
}

bool same(const TypeTable& types, TypeId type, uint64_t a, uint64_t b) {
  if (!TypeTable::isReal(types.plainKind(type))) return a == b;
  const double x = Value{type, a}.asReal(), y = Value{type, b}.asReal();
  return a == b || (std::isnan(x) && std::isnan(y));
}

constexpr Op kOps[] = {
#define RUNG_OPERATOR(name, word, operands) Op::name,
#include "sema/types/operators.def"
};

struct Case {
  Op op;
  uint32_t result;
  int constant = 0;  // 1: on the right, 2: on the left
  Value value;
};

void checkOperators(TypeId type) {
  Bench bench;
  const TypeTable& types = bench.types;
  const std::vector<Value> values = edges(types, type);
  const uint32_t left = bench.field(type), right = bench.field(type);
  Builder b(bench.module, bench.body());
  const uint32_t frame_left = b.temp(type), frame_right = b.temp(type);
  const Block outer = b.open();
  b.assign(b.localPlace(frame_left), b.field(b.self(), left));
  b.assign(b.localPlace(frame_right), b.field(b.self(), right));
  std::vector<Case> cases;
  const auto add = [&](Op op, ExprId a, ExprId c, int constant, Value value) {
    const TypeId to = types::isComparison(op) ? types::kBool : type;
    const uint32_t result = bench.field(to);
    b.assign(b.field(b.self(), result), c ? b.binary(op, a, c) : b.unary(op, a));
    cases.push_back({op, result, constant, value});
  };
  for (const Op op : kOps) {
    if (!isFor(op, types.plainKind(type))) continue;
    if (types::operandCount(op) == 1) {
      add(op, b.field(b.self(), left), {}, 0, {});
      add(op, b.localPlace(frame_left), {}, 0, {});
      continue;
    }
    add(op, b.field(b.self(), left), b.field(b.self(), right), 0, {});
    add(op, b.localPlace(frame_left), b.localPlace(frame_right), 0, {});
    add(op, b.localPlace(frame_left), b.field(b.self(), right), 0, {});
    for (const Value& value : values) {
      add(op, b.field(b.self(), left), b.constant(value), 1, value);
      add(op, b.constant(value), b.localPlace(frame_right), 2, value);
    }
  }
  bench.make(b, outer);
  for (const Value& x : values) {
    for (const Value& y : values) {
      bench.put(left, x);
      bench.put(right, y);
      bench.run();
      for (const Case& one : cases) {
        const Value& a = one.constant == 2 ? one.value : x;
        const Value& c = one.constant == 1 ? one.value : y;
        const types::Outcome expected = types::operandCount(one.op) == 1
                                            ? types::apply(types, bench.names, one.op, a)
                                            : types::apply(types, bench.names, one.op, a, c);
        const uint64_t given = bench.get(one.result);
        ASSERT_TRUE(same(types, expected.value.type, expected.value.bits, given))
            << types.toString(type) << ": " << types::word(one.op) << " " << types::toString(types, bench.names, a)
            << ", " << types::toString(types, bench.names, c) << " (constant " << one.constant << ") gives " << std::hex
            << given << " for " << expected.value.bits;
      }
    }
  }
}

TEST(InterpreterArithmetic, OperatorsAgreeWithTheKernel) {
  for (const TypeId type : scalars()) checkOperators(type);
}

TEST(InterpreterArithmetic, ShiftCountsOfAnyIntegerType) {
  for (const TypeId type : {types::kByte, types::kWord, types::kDWord, types::kLWord, types::kInt, types::kLInt}) {
    for (const TypeId count_type : {types::kSInt, types::kUInt, types::kDInt, types::kULInt}) {
      Bench bench;
      const uint32_t left = bench.field(type), count = bench.field(count_type);
      Builder b(bench.module, bench.body());
      const Block outer = b.open();
      std::vector<std::pair<Op, uint32_t>> cases;
      for (const Op op : {Op::Shl, Op::Shr, Op::Sar, Op::Rol, Op::Ror}) {
        const uint32_t result = bench.field(type);
        b.assign(b.field(b.self(), result), b.binary(op, b.field(b.self(), left), b.field(b.self(), count)));
        cases.push_back({op, result});
      }
      bench.make(b, outer);
      for (const Value& x : edges(bench.types, type)) {
        for (uint64_t n : {0, 1, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65, 127, -1}) {
          if (!bench.types.isSigned(bench.types.plainKind(count_type)) && static_cast<int64_t>(n) < 0) continue;
          bench.put(left, x);
          bench.put(count, {count_type, n});
          bench.run();
          for (const auto& [op, result] : cases) {
            const types::Outcome expected = types::apply(bench.types, bench.names, op, x, {count_type, n});
            ASSERT_EQ(bench.get(result), expected.value.bits)
                << types::word(op) << " " << bench.types.toString(type) << " " << x.bits << " by " << n;
          }
        }
      }
    }
  }
}

TEST(InterpreterArithmetic, ConversionsAgreeWithTheKernel) {
  for (const TypeId from : scalars()) {
    Bench bench;
    const TypeTable& types = bench.types;
    const TypeId percent = bench.types.addSubrange(bench.names.intern("Percent"), types::kInt, -5, 100);
    bench.types.layout(percent);
    const uint32_t source = bench.field(from);
    Builder b(bench.module, bench.body());
    const uint32_t frame = b.temp(from);
    const Block outer = b.open();
    b.assign(b.localPlace(frame), b.field(b.self(), source));
    std::vector<TypeId> targets = scalars();
    targets.push_back(percent);
    struct Case {
      TypeId to;
      uint32_t result;
      types::Rounding rounding;
    };
    std::vector<Case> cases;
    for (const TypeId to : targets) {
      const TypeKind kind = types.plainKind(to);
      const bool rounds = TypeTable::isReal(types.kind(from)) && !TypeTable::isReal(kind) && kind != TypeKind::Bool;
      for (const bool in_frame : {false, true}) {
        for (const types::Rounding rounding : {types::Rounding::ToEven, types::Rounding::AwayFromZero}) {
          if (rounding == types::Rounding::AwayFromZero && !rounds) continue;
          const uint32_t result = bench.field(to);
          const ExprId x = in_frame ? b.localPlace(frame) : b.field(b.self(), source);
          b.assign(b.field(b.self(), result), b.convert(to, x, 0, rounding));
          cases.push_back({to, result, rounding});
        }
      }
    }
    bench.make(b, outer);
    for (const Value& x : edges(types, from)) {
      bench.put(source, x);
      bench.run();
      for (const auto& [to, result, rounding] : cases) {
        const types::Outcome expected = types::convert(types, x, to, rounding);
        ASSERT_TRUE(same(types, to, expected.value.bits, bench.get(result)))
            << types.toString(from) << " " << types::toString(types, bench.names, x) << " to " << types.toString(to)
            << " gives " << std::hex << bench.get(result) << " for " << expected.value.bits;
      }
    }
  }
}

TEST(InterpreterArithmetic, PowersAgreeWithTheKernel) {
  for (const TypeId base : {types::kInt, types::kUDInt, types::kLInt, types::kReal, types::kLReal}) {
    for (const TypeId exponent : {types::kInt, types::kULInt, types::kReal, types::kLReal}) {
      Bench bench;
      const TypeTable& types = bench.types;
      if (!TypeTable::isReal(types.plainKind(base)) && TypeTable::isReal(types.plainKind(exponent))) continue;
      const uint32_t left = bench.field(base), right = bench.field(exponent), result = bench.field(base);
      Builder b(bench.module, bench.body());
      const Block outer = b.open();
      b.assign(b.field(b.self(), result), b.binary(Op::Power, b.field(b.self(), left), b.field(b.self(), right)));
      bench.make(b, outer);
      for (const Value& x : edges(types, base)) {
        for (const Value& n : edges(types, exponent)) {
          bench.put(left, x);
          bench.put(right, n);
          bench.run();
          const types::Outcome expected = types::apply(types, bench.names, Op::Power, x, n);
          ASSERT_TRUE(same(types, base, expected.value.bits, bench.get(result)))
              << types::toString(types, bench.names, x) << " ** " << types::toString(types, bench.names, n);
        }
      }
    }
  }
}

}  // namespace
}  // namespace rung::ir::interpreter

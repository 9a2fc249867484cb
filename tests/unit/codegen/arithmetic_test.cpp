// SPDX-License-Identifier: Apache-2.0
// Every operator and conversion on every type, compiled and run, agrees with the arithmetic kernel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "codegen/emit.h"
#include "codegen/names.h"
#include "codegen/types.h"
#include "ir/builder.h"
#include "native.h"

namespace rung::codegen {
namespace {

using types::Op;
using types::TypeKind;
using types::TypeTable;
using types::Value;

struct ArithmeticTest : testing::Test {
  ArithmeticTest() : types(names, 8), module(types, names, sources) {}

  // function NAME : result: in a, in b; returns f(builder, a, b).
  template <class F>
  void function(const std::string& name, TypeId a, TypeId b, TypeId result, F&& f) {
    ir::Body& body = module.bodies.emplace_back();
    body.name = body.spelling = names.intern(name);
    body.result = result;
    ir::Builder builder(module, body);
    const uint32_t first = builder.local(names.intern("a"), a, ir::LocalKind::Input);
    uint32_t second = first;
    if (b) second = builder.local(names.intern("b"), b, ir::LocalKind::Input);
    const uint32_t out = builder.local(names.intern("out"), result, ir::LocalKind::Result);
    builder.open();
    builder.assign(builder.localPlace(out), f(builder, first, second));
    body.first = builder.block().first;
  }

  std::vector<uint64_t> valuesOf(TypeKind kind) {
    if (kind == TypeKind::Bool) return {0, 1};
    if (TypeTable::isReal(kind)) {
      std::vector<uint64_t> bits;
      for (double v : {0.0, -0.0, 1.0, -1.5, 0.5, 2.5, 3.5, 1e10, -3e9, 32767.5, 65536.0, 1e30, HUGE_VAL, -HUGE_VAL,
                       std::nan("")}) {
        bits.push_back(Value::ofReal(types::idOf(kind), kind == TypeKind::Real ? static_cast<float>(v) : v).bits);
      }
      return bits;
    }
    const uint32_t width = TypeTable::bitWidth(kind);
    const bool is_signed = types.isSigned(kind);
    const uint64_t high = is_signed     ? (uint64_t{1} << (width - 1)) - 1
                          : width == 64 ? ~uint64_t{0}
                                        : (uint64_t{1} << width) - 1;
    std::vector<uint64_t> values = {0, 1, 2, 7, 31, high - 1, high, high / 2, high / 3};
    if (is_signed) values.insert(values.end(), {~uint64_t{0}, ~uint64_t{6}, ~high, ~high + 1, ~(high / 2)});
    return values;
  }

  // Adds a row to the driver's table: the function with these operands must give this result.
  void addCall(const std::string& name, TypeId result, TypeId a, uint64_t x, TypeId b, uint64_t y,
               const Value& expected) {
    if (name != last) {
      if (!last.empty()) rows += "};\n";
      last = name;
      const std::string types_of =
          std::string(scalarType(types, a)) + (b ? std::string(", ") + scalarType(types, b) : "");
      prototypes +=
          std::string(scalarType(types, result)) + " " + mangle(name) + "fn(rung_context*, " + types_of + ");\n";
      rows += "static const Row rows_" + mangle(name) + "[] = {\n";
      calls += "  for (const Row& r : rows_" + mangle(name) + ") check(\"" + name +
               "\", r, bits(plc_::" + mangle(name) + "fn(&ctx, of<" + scalarType(types, a) + ">(r.x)" +
               (b ? std::string(", of<") + scalarType(types, b) + ">(r.y)" : "") + ")));\n";
    }
    rows += "{" + std::to_string(x) + "u," + std::to_string(y) + "u," + std::to_string(expected.bits) + "u},";
  }

  void expectAgreement(const std::string& flags) {
    const std::string driver = R"(
#include <stdio.h>
#include <type_traits>
#include "rung/code.h"
static rung_context ctx;
static int wrong;
struct Row { uint64_t x, y, want; };
template <class T> static T of(uint64_t bits) {
  if constexpr (std::is_floating_point_v<T>) return (T)rung_f64_of(bits); else return (T)bits;
}
template <class T> static uint64_t bits(T v) {
  if constexpr (std::is_floating_point_v<T>) return v != v ? 1 : rung_bits_of_f64(v);
  else if constexpr (std::is_signed_v<T>) return (uint64_t)(int64_t)v; else return v;
}
static void check(const char* what, const Row& row, uint64_t got) {
  if (got == row.want || ++wrong > 20) return;
  printf("%s(%llx, %llx) = %llx, not %llx\n", what, (unsigned long long)row.x, (unsigned long long)row.y,
         (unsigned long long)got, (unsigned long long)row.want);
}
namespace plc_ {
)" + prototypes + "}\n" + rows +
                               "};\nint main() {\n" + calls + "  return wrong != 0;\n}\n";
    const NativeResult result = runNatively(module, driver, flags);
    EXPECT_TRUE(result.ok);
    EXPECT_EQ(result.output.substr(0, 2000), "");
  }

  // NaN has many representations.
  static Value plain(Value value, bool is_real) {
    if (is_real && std::isnan(value.asReal())) value.bits = 1;
    return value;
  }

  Names names;
  Sources sources;
  TypeTable types;
  ir::Module module;
  std::string prototypes, rows, calls, last;
};

TEST_F(ArithmeticTest, OperatorsAgreeWithTheKernel) {
  for (uint32_t k = static_cast<uint32_t>(TypeKind::Bool); k <= static_cast<uint32_t>(TypeKind::WChar); ++k) {
    const auto kind = static_cast<TypeKind>(k);
    const TypeId type = types::idOf(kind);
    const bool is_real = TypeTable::isReal(kind), is_bool = kind == TypeKind::Bool;
    for (uint32_t o = 0; o <= static_cast<uint32_t>(Op::Abs); ++o) {
      const auto op = static_cast<Op>(o);
      const bool is_bitwise = op >= Op::And && op <= Op::Ror;
      if (is_real && is_bitwise) continue;
      if (is_bool && !types::isComparison(op) && !(op >= Op::And && op <= Op::Not)) continue;
      const bool is_shift = op >= Op::Shl && op <= Op::Ror;
      const bool binary = types::operandCount(op) == 2;
      const TypeId right = !binary ? TypeId{} : is_shift ? types::kInt : type;
      const TypeId result = types::isComparison(op) ? types::kBool : type;
      const std::string name = std::string(types::word(op)) + "_" + types.toString(type);
      function(name, type, right, result, [&](ir::Builder& b, uint32_t x, uint32_t y) {
        return binary ? b.binary(op, b.localPlace(x), b.localPlace(y)) : b.unary(op, b.localPlace(x));
      });
      const std::vector<uint64_t> shifts = {0, 1, 5, 8, 16, 31, 32, 63, 64, ~uint64_t{0}};
      for (uint64_t x : valuesOf(kind)) {
        if (!binary) {
          addCall(name, result, type, x, {}, 0,
                  plain(types::apply(types, names, op, {type, x}).value, is_real && result == type));
          continue;
        }
        for (uint64_t y : is_shift ? shifts : valuesOf(kind)) {
          const Value value = types::apply(types, names, op, {type, x}, {right, y}).value;
          addCall(name, result, type, x, right, y, plain(value, is_real && result == type));
        }
      }
    }
  }
  expectAgreement("-O1 -fsanitize=undefined -fno-sanitize-recover=undefined");
}

TEST_F(ArithmeticTest, ConversionsAgreeWithTheKernel) {
  const TypeId small = types.addSubrange(names.intern("Small"), types::kInt, -3, 100);
  std::vector<TypeId> targets = {small};
  for (uint32_t k = static_cast<uint32_t>(TypeKind::Bool); k <= static_cast<uint32_t>(TypeKind::WChar); ++k)
    targets.push_back(types::idOf(static_cast<TypeKind>(k)));
  for (size_t s = 1; s < targets.size(); ++s) {
    for (TypeId to : targets) {
      const TypeId from = targets[s];
      const bool is_real = TypeTable::isReal(types.plainKind(to));
      const bool rounds = TypeTable::isReal(types.kind(from)) && !is_real && to != types::kBool;
      for (const types::Rounding rounding : {types::Rounding::ToEven, types::Rounding::AwayFromZero}) {
        const bool away = rounding == types::Rounding::AwayFromZero;
        if (away && !rounds) continue;
        const std::string name = types.toString(from) + (away ? "_ROUND_" : "_TO_") + types.toString(to);
        function(name, from, {}, to,
                 [&](ir::Builder& b, uint32_t x, uint32_t) { return b.convert(to, b.localPlace(x), 0, rounding); });
        for (uint64_t x : valuesOf(types.kind(from)))
          addCall(name, to, from, x, {}, 0, plain(types::convert(types, {from, x}, to, rounding).value, is_real));
      }
    }
  }
  expectAgreement("-O1 -fsanitize=undefined -fno-sanitize-recover=undefined");
}

// Chains of + - * with constants, as in index arithmetic and averages: cut once, at the end.
TEST_F(ArithmeticTest, ChainsAreCutAtTheirWidth) {
  for (TypeKind kind : {TypeKind::SInt, TypeKind::Int, TypeKind::UInt, TypeKind::DInt, TypeKind::UDInt, TypeKind::LInt,
                        TypeKind::Time}) {
    const TypeId type = types::idOf(kind);
    const std::string name = "chain_" + types.toString(type);
    function(name, type, type, type, [&](ir::Builder& b, uint32_t x, uint32_t y) {
      const ir::ExprId product =
          b.binary(Op::Mul, b.binary(Op::Add, b.localPlace(x), b.integer(type, 5)), b.localPlace(y));
      const ir::ExprId square = b.binary(Op::Mul, b.localPlace(x), b.localPlace(x));
      return b.binary(Op::Sub, b.binary(Op::Mul, product, square), b.unary(Op::Neg, b.localPlace(y)));
    });
    auto apply = [&](Op op, Value a, Value b) { return types::apply(types, names, op, a, b).value; };
    for (uint64_t x : valuesOf(kind)) {
      for (uint64_t y : valuesOf(kind)) {
        const Value a{type, x}, b{type, y};
        const Value product = apply(Op::Mul, apply(Op::Add, a, {type, 5}), b);
        addCall(name, type, type, x, type, y,
                apply(Op::Sub, apply(Op::Mul, product, apply(Op::Mul, a, a)), apply(Op::Neg, b, {})));
      }
    }
  }
  expectAgreement("-O2 -fsanitize=undefined -fno-sanitize-recover=undefined");
}

}  // namespace
}  // namespace rung::codegen

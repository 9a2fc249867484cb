// SPDX-License-Identifier: Apache-2.0
// FOR: the number of iterations and the final value of the control, at the limits of every integer type, as a plain
// loop and as one whose body changes the control.
#include <gtest/gtest.h>

#include "codegen/emit.h"
#include "codegen/types.h"
#include "ir/builder.h"
#include "native.h"

namespace rung::codegen {
namespace {

using types::Op;
using types::TypeKind;
using types::TypeTable;

struct Outcome {
  int iterations = 0;
  __int128 last = 0;
};

constexpr int kMaxIterations = 100;

Outcome simulate(__int128 from, __int128 to, __int128 step, __int128 low, __int128 high) {
  Outcome out;
  out.last = from;
  while ((step > 0 ? out.last <= to : out.last >= to) && out.iterations < kMaxIterations) {
    if (++out.iterations == kMaxIterations) return out;
    out.last += step;
    if (out.last > high || out.last < low) {
      out.last = step > 0 ? high : low;
      return out;
    }
  }
  return out;
}

TEST(For, IterationsAndLastValue) {
  Names names;
  Sources sources;
  TypeTable types(names, 8);
  ir::Module module(types, names, sources);
  std::string driver = "#include <stdio.h>\n#include \"rung/code.h\"\nnamespace plc_ {\n", calls;
  for (uint32_t k = static_cast<uint32_t>(TypeKind::SInt); k <= static_cast<uint32_t>(TypeKind::ULInt); ++k) {
    const TypeId type = types::idOf(static_cast<TypeKind>(k));
    const uint32_t width = TypeTable::bitWidth(static_cast<TypeKind>(k));
    const bool is_signed = types.isSigned(static_cast<TypeKind>(k));
    const __int128 low = is_signed ? -(__int128{1} << (width - 1)) : 0;
    const __int128 high = (__int128{1} << (is_signed ? width - 1 : width)) - 1;
    int number = 0;
    struct Case {
      __int128 from, to;
      int64_t step;
    };
    for (const Case& c : {Case{5, 5, 1}, Case{6, 5, 1}, Case{0, 9, 3}, Case{high - 5, high, 1}, Case{high - 5, high, 4},
                          Case{high, high, 7}, Case{low + 5, low, -1}, Case{low + 5, low, -4}, Case{9, 1, -2},
                          Case{low, low + 3, 2}, Case{3, 9, -1}, Case{high - 3, high - 1, 1}}) {
      for (int form = 0; form < 3;
           ++form) {  // 0: constant bounds, 1: bounds from inputs, 2: the body writes the control
        const std::string name = "f" + std::to_string(number++) + "_" + types.toString(type);
        ir::Body& body = module.bodies.emplace_back();
        body.name = body.spelling = names.intern(name);
        body.result = types::kInt;
        ir::Builder b(module, body);
        const uint32_t from = b.local(names.intern("a"), type, ir::LocalKind::Input);
        const uint32_t to = b.local(names.intern("b"), type, ir::LocalKind::Input);
        const uint32_t last = b.local(names.intern("last"), type, ir::LocalKind::Output);
        const uint32_t iterations = b.local(names.intern("turns"), types::kInt, ir::LocalKind::Result);
        const uint32_t control = b.local(names.intern("i"), type, ir::LocalKind::Variable);
        b.open();
        b.assign(b.localPlace(iterations), b.integer(types::kInt, 0));
        ir::Block outer = b.open();
        b.assign(b.localPlace(iterations), b.binary(Op::Add, b.localPlace(iterations), b.integer(types::kInt, 1)));
        ir::Block inner = b.open();
        b.breakLoop();
        const ir::StmtId stop = b.close(inner);
        b.ifElse(b.binary(Op::Ge, b.localPlace(iterations), b.integer(types::kInt, kMaxIterations)), stop);
        if (form == 2) b.assign(b.localPlace(control), b.localPlace(control));
        const ir::StmtId loop = b.close(outer);
        auto bound = [&](__int128 value, uint32_t local) {
          return form == 0 ? b.constant(type, static_cast<uint64_t>(value)) : b.localPlace(local);
        };
        b.forLoop(b.localPlace(control), bound(c.from, from), bound(c.to, to), b.integer(type, c.step), loop);
        b.assign(b.localPlace(last), b.localPlace(control));
        body.first = b.block().first;

        const std::string c_type = scalarType(types, type);
        driver += "int16_t " + mangle(name) + "fn(rung_context*, " + c_type + ", " + c_type + ", " + c_type + "*);\n";
        const Outcome expected = simulate(c.from, c.to, c.step, low, high);
        std::string x, y, z;
        appendConstant(x, types, type, static_cast<uint64_t>(c.from));
        appendConstant(y, types, type, static_cast<uint64_t>(c.to));
        appendConstant(z, types, type, static_cast<uint64_t>(expected.last));
        calls += "  { " + c_type + " last = 0; int turns = plc_::" + mangle(name) + "fn(&ctx, " + x + ", " + y +
                 ", &last); if (turns != " + std::to_string(expected.iterations) + " || last != " + z +
                 ") { printf(\"" + name + ": form " + std::to_string(form) + ", %d turns, last %lld; not " +
                 std::to_string(expected.iterations) + " and " + z + "\\n\", turns, (long long)last); wrong = 1; } }\n";
      }
    }
  }
  driver += "}\nint main() {\n  rung_context ctx = {}; int wrong = 0;\n" + calls + "  return wrong;\n}\n";
  const NativeResult result = runNatively(module, driver, "-O1 -fsanitize=undefined -fno-sanitize-recover=undefined");
  EXPECT_TRUE(result.ok);
  EXPECT_EQ(result.output.substr(0, 3000), "");
}

}  // namespace
}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// Strings in generated code: assignments cut to the capacity, comparisons with literals, and self-assignment.
#include <gtest/gtest.h>

#include "codegen/emit.h"
#include "ir/builder.h"
#include "native.h"

namespace rung::codegen {
namespace {

using types::Op;

struct StringTest : testing::Test {
  StringTest() : types(names, 8), module(types, names, sources) {}

  // function NAME : BOOL with one string variable of this capacity, to which `from` is assigned; f makes the result.
  template <class F>
  void function(const std::string& name, uint32_t capacity, const std::string& from, F&& f) {
    ir::Body& body = module.bodies.emplace_back();
    body.name = body.spelling = names.intern(name);
    body.result = types::kBool;
    ir::Builder b(module, body);
    const TypeId type = types.string(capacity);
    const uint32_t text = b.local(names.intern("text"), type, ir::LocalKind::Variable);
    const uint32_t out = b.local(names.intern("out"), types::kBool, ir::LocalKind::Result);
    b.open();
    b.assign(b.localPlace(text), b.string(types.string(static_cast<uint32_t>(from.size())), names.intern(from)));
    b.assign(b.localPlace(out), f(b, text));
    body.first = b.block().first;
    driver += "uint8_t " + mangle(name) + "fn(rung_context*);\n";
    calls += "  if (!plc_::" + mangle(name) + "fn(&ctx)) { puts(\"" + name + "\"); wrong = 1; }\n";
  }
  ir::ExprId literal(ir::Builder& b, const std::string& text) {
    return b.string(types.string(static_cast<uint32_t>(text.size())), names.intern(text));
  }
  void run() {
    const NativeResult result =
        runNatively(module,
                    "#include <stdio.h>\n#include \"rung/code.h\"\nnamespace plc_ {\n" + driver +
                        "}\nint main() {\n  rung_context ctx = {}; int wrong = 0;\n" + calls + "  return wrong;\n}\n",
                    "-O1 -fsanitize=address,undefined -fno-sanitize-recover=undefined");
    EXPECT_TRUE(result.ok);
    EXPECT_EQ(result.output.substr(0, 3000), "");
  }

  Names names;
  Sources sources;
  types::TypeTable types;
  ir::Module module;
  std::string driver, calls;
};

TEST_F(StringTest, AssignmentAndComparison) {
  auto equals = [&](const std::string& text) {
    return
        [&, text](ir::Builder& b, uint32_t local) { return b.binary(Op::Eq, b.localPlace(local), literal(b, text)); };
  };
  function("cut", 3, "abcdef", equals("abc"));
  function("fits", 6, "abcdef", equals("abcdef"));
  function("empty", 6, "", equals(""));
  function("escapes", 20, "a\"\\?\n$", equals("a\"\\?\n$"));
  function("long_literal", 80, std::string(60, 'x'), equals(std::string(60, 'x')));
  function("shorter_memory", 2, "ab", [&](ir::Builder& b, uint32_t local) {
    return b.binary(Op::Ne, b.localPlace(local), literal(b, "abcdefgh"));
  });
  function("order", 5, "abd",
           [&](ir::Builder& b, uint32_t local) { return b.binary(Op::Gt, b.localPlace(local), literal(b, "abc")); });
  function("high_bytes_are_high", 5, "\xc3\xa4",
           [&](ir::Builder& b, uint32_t local) { return b.binary(Op::Gt, b.localPlace(local), literal(b, "z")); });
  function("cut_by_conversion", 10, "abcdef", [&](ir::Builder& b, uint32_t local) {
    const ir::ExprId cut = b.convert(types.string(2), b.localPlace(local));
    return b.binary(Op::Eq, cut, literal(b, "ab"));
  });
  function("assigned_cut_to_itself", 10, "abcdef", [&](ir::Builder& b, uint32_t local) {
    b.assign(b.localPlace(local), b.convert(types.string(4), b.localPlace(local)));
    return b.binary(Op::Eq, b.localPlace(local), literal(b, "abcd"));
  });
  function("to_wide_and_back", 10, "a\xc3\xa4z", [&](ir::Builder& b, uint32_t local) {
    const ir::ExprId wide = b.convert(types.wstring(10), b.localPlace(local));
    return b.binary(Op::Eq, b.convert(types.string(10), wide), literal(b, "a\xc3\xa4z"));
  });
  run();
}

}  // namespace
}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
#include "tools/protocol/json.h"

#include <gtest/gtest.h>

#include <random>

namespace rung::protocol {
namespace {

std::string again(std::string_view text) {
  const JsonResult result = parseJson(text);
  return result.error.empty() ? result.value.toText() : "error: " + result.error;
}

TEST(Json, ReadsEveryKindOfValue) {
  const JsonResult result = parseJson(R"( {"a": [1, -2, 2.5, 1e3, true, false, null], "b": {"c": "x"}, "a b": "" } )");
  ASSERT_EQ(result.error, "");
  const Json& value = result.value;
  EXPECT_EQ(value["a"].items().size(), 7u);
  EXPECT_EQ(value["a"].items()[1].integer(), -2);
  EXPECT_EQ(value["a"].items()[2].integer(), 2);
  EXPECT_EQ(value["a"].items()[3].integer(), 1000);
  EXPECT_TRUE(value["a"].items()[4].isTrue());
  EXPECT_TRUE(value["a"].items()[6].isNull());
  EXPECT_EQ(value["b"]["c"].text(), "x");
  EXPECT_TRUE(value["a b"].isText());
}

TEST(Json, WhatIsMissingIsNull) {
  const Json value = parseJson(R"({"a": 1})").value;
  EXPECT_TRUE(value["x"]["y"]["z"].isNull());
  EXPECT_TRUE(value["a"]["y"].isNull());
  EXPECT_TRUE(value["a"].items().empty());
  EXPECT_EQ(value["a"].text(), "");
  EXPECT_EQ(value["x"].integer(7), 7);
}

TEST(Json, StringsKeepTheirCharacters) {
  EXPECT_EQ(parseJson(R"("\"\\\/\b\f\n\r\t")").value.text(), "\"\\/\b\f\n\r\t");
  EXPECT_EQ(parseJson(R"("\u00fc\u20AC")").value.text(), "\xc3\xbc\xe2\x82\xac");
  EXPECT_EQ(parseJson(R"("\ud83d\ude00")").value.text(), "\xf0\x9f\x98\x80");
  // Halves of a pair alone.
  EXPECT_EQ(parseJson(R"("\ud83dx")").value.text(), "\xef\xbf\xbdx");
  EXPECT_EQ(parseJson(R"("\ude00")").value.text(), "\xef\xbf\xbd");
  EXPECT_EQ(parseJson(R"("\ud83d\u0041")").value.text(), "\xef\xbf\xbd");
  EXPECT_EQ(again("\"a\\u0000b\""), "\"a\\u0000b\"");
}

TEST(Json, RefusesWhatIsNotJson) {
  for (const char* text :
       {"",      " ",      "{",       "[",         "[1",  "[1,",   "[1,]", "{\"a\"", "{\"a\":", "{\"a\":1,}",
        "{a:1}", "01",     "1.",      ".5",        "+1",  "1e",    "-",    "tru",    "nul",     "'a'",
        "\"a",   "\"\n\"", "\"\\x\"", "\"\\u12\"", "1 2", "[1] x", "NaN",  "/**/1"})
    EXPECT_EQ(again(text).substr(0, 7), "error: ") << text;
  EXPECT_EQ(parseJson("\"\xff\"").error, "the text is not UTF-8");
  EXPECT_EQ(parseJson("[1 2]").error, "expected `,` or `]` at byte 3");
}

TEST(Json, LimitsDepthAndCount) {
  const auto nested = [](size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(parseJson(nested(50), {.depth = 50}).error, "");
  EXPECT_NE(parseJson(nested(52), {.depth = 50}).error, "");
  EXPECT_NE(parseJson(nested(10'000'000)).error, "");
  EXPECT_EQ(parseJson("[1,2,3]", {.values = 4}).error, "");
  EXPECT_NE(parseJson("[1,2,3,4]", {.values = 4}).error, "");
}

TEST(Json, NumbersBeyondTheirRangeStayNumbers) {
  EXPECT_EQ(again("9223372036854775807"), "9223372036854775807");
  EXPECT_EQ(parseJson("9223372036854775808").value.integer(3), 3);
  EXPECT_EQ(parseJson("1e999").error, "");
  EXPECT_EQ(parseJson("-0").value.integer(), 0);
}

TEST(Json, WritesValues) {
  const Json value{{"list", Json::Array{1, "two", Json()}}, {"flag", true}, {"numbers", Json::Numbers{1, 2}}};
  EXPECT_EQ(value.toText(), R"({"list":[1,"two",null],"flag":true,"numbers":[1,2]})");
  EXPECT_EQ(Json::emptyObject().toText(), "{}");
  EXPECT_EQ(Json(Json::Array()).toText(), "[]");
}

// Any bytes give a value or an error, and what is a value is the same when it is written and read again.
TEST(Json, RandomBytesAndDamagedTexts) {
  std::mt19937 random(43);
  const std::string good = R"({"id":1,"params":{"text":"a\n\u00e4","list":[1,2.5,{"x":null}],"ok":true}})";
  for (int round = 0; round < 20'000; ++round) {
    std::string text = good;
    for (uint32_t i = random() % 4; i > 0; --i) text[random() % text.size()] = static_cast<char>(random());
    if (random() % 3 == 0) text.resize(random() % text.size());
    const JsonResult result = parseJson(text);
    if (!result.error.empty()) continue;
    const JsonResult second = parseJson(result.value.toText());
    EXPECT_EQ(second.error, "");
    EXPECT_EQ(second.value.toText(), result.value.toText()) << text;  // 2e0 is written as 2
  }
}

}  // namespace
}  // namespace rung::protocol

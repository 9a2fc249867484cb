// SPDX-License-Identifier: Apache-2.0
// Values of literals. The nanoseconds are computed by hand from the calendar and the units.
#include "frontend/parse/literals.h"
#include "frontend/source/dialect.h"

#include <gtest/gtest.h>

#include "tests/unit/parse/parse_helper.h"

namespace rung::text {
namespace {

std::string value(const std::string& literal, Dialect dialect = Dialect::Codesys) {
  std::string printed = body("x := " + literal + ";", dialect);
  const std::string before = "    assign := (name x) (literal ";
  if (printed.rfind(before, 0) != 0) return printed;
  printed.erase(0, before.size());
  return printed.substr(0, printed.size() - 2);  // ")\n"
}

TEST(Literals, Numbers) {
  EXPECT_EQ(value("0"), "0");
  EXPECT_EQ(value("1_000"), "1000");
  EXPECT_EQ(value("1__000"), "1000");
  EXPECT_EQ(value("16#Ff"), "255");
  EXPECT_EQ(value("2#1010_0101"), "165");
  EXPECT_EQ(value("8#17"), "15");
  EXPECT_EQ(value("18446744073709551615"), "18446744073709551615");
  EXPECT_EQ(value("18446744073709551616"), "2:6 E0118");
  EXPECT_EQ(value("16#1FFFFFFFFFFFFFFFF"), "2:6 E0118");
  EXPECT_EQ(value("1.5"), "1.5");
  EXPECT_EQ(value("1e3"), "1000.0");
  EXPECT_EQ(value("1.25E-2"), "0.0125");
  EXPECT_EQ(value("1e999"), "2:6 E0118");
  EXPECT_EQ(value("1e-999"), "0.0");
  EXPECT_EQ(value("INT#-5"), "INT#-5");
  EXPECT_EQ(value("INT#16#FF"), "INT#255");
  EXPECT_EQ(value("REAL#1"), "REAL#1.0");
  EXPECT_EQ(value("LREAL#-1.5"), "LREAL#-1.5");
  EXPECT_EQ(value("BOOL#1"), "BOOL#TRUE");
  EXPECT_EQ(value("BOOL#FALSE"), "BOOL#FALSE");
  EXPECT_EQ(value("MyInt#7"), "MyInt#7");
}

TEST(Literals, WrongNumbers) {
  EXPECT_EQ(value("2#102"), "2:6 E0120");
  EXPECT_EQ(value("7#1"), "2:6 E0119");
  EXPECT_EQ(value("16#"), "2:6 E0120");
  EXPECT_EQ(value("1__0", Dialect::Iec3), "2:6 E0121");
  EXPECT_EQ(value("1__"), "2:6 E0121");
  EXPECT_EQ(value("1_"), "2:6 E0121");
  EXPECT_EQ(value("12ab"), "2:6 E0122");
  EXPECT_EQ(value("INT#1.5"), "2:10 E0132");
  EXPECT_EQ(value("BOOL#2"), "2:11 E0132");
}

TEST(Literals, Durations) {
  EXPECT_EQ(value("T#0ms"), "t#0ns");
  EXPECT_EQ(value("t#1s500ms"), "t#1500000000ns");
  EXPECT_EQ(value("TIME#1d2h7m19s45.7ms"), "t#94039045700000ns");  // 86400 + 7200 + 420 + 19 s
  EXPECT_EQ(value("T#3d29h27m41s1ms"), value("T#4d5h27m41s1ms"));
  EXPECT_EQ(value("T#100S12ms"), "t#100012000000ns");
  EXPECT_EQ(value("T#-5s"), "t#-5000000000ns");
  EXPECT_EQ(value("T#0.5s"), "t#500000000ns");
  EXPECT_EQ(value("T#1d_2h"), "t#93600000000000ns");
  EXPECT_EQ(value("LTIME#1us3ns"), "lt#1003ns");
  EXPECT_EQ(value("LTIME#213503D23H34M33S709MS551US615NS"), "lt#18446744073709551615ns");
  EXPECT_EQ(value("LTIME#213504D23H34M33S709MS551US616NS"), "2:6 E0126");
  EXPECT_EQ(value("t#4ms13d"), "2:13 E0124");
  EXPECT_EQ(value("T#1s2s"), "2:11 E0124");
  EXPECT_EQ(value("T#1.5s200ms"), "2:8 E0125");
  EXPECT_EQ(value("T#5"), "2:8 E0123");
  EXPECT_EQ(value("T#5x"), "2:9 E0123");
  EXPECT_EQ(value("T#"), "2:6 E0123");
}

TEST(Literals, Dates) {
  EXPECT_EQ(value("D#1970-01-02"), "d#86400000000000ns");
  EXPECT_EQ(value("DATE#2000-03-01"), "d#951868800000000000ns");
  EXPECT_EQ(value("LDATE#1969-12-31"), "ld#-86400000000000ns");
  EXPECT_EQ(value("LDATE#2400-2-29"), "ld#13574563200000000000ns");
  EXPECT_EQ(value("D#2024-2-29"), "d#1709164800000000000ns");
  EXPECT_EQ(value("D#2023-02-29"), "2:6 E0128");
  EXPECT_EQ(value("D#2023-13-01"), "2:6 E0128");
  EXPECT_EQ(value("D#2023-01"), "2:6 E0127");
  EXPECT_EQ(value("TOD#00:01"), "tod#60000000000ns");
  EXPECT_EQ(value("TIME_OF_DAY#23:59:59.999"), "tod#86399999000000ns");
  EXPECT_EQ(value("LTOD#00:00:00.000000001"), "ltod#1ns");
  EXPECT_EQ(value("TOD#12:60:00"), "2:6 E0129");
  EXPECT_EQ(value("TOD#1193:02:47.295"), "2:6 W0151");
  EXPECT_EQ(value("DT#1970-01-01-00:00:01"), "dt#1000000000ns");
  EXPECT_EQ(value("LDATE_AND_TIME#1970-01-01-00:00:00.5"), "ldt#500000000ns");
  EXPECT_EQ(value("DT#1970-01-01"), "2:6 E0127");
}

TEST(Literals, Strings) {
  EXPECT_EQ(value("'a$'b'"), "'a$'b'");
  EXPECT_EQ(value("'$$ $41'"), "'$$ A'");
  EXPECT_EQ(value("'$L$n$R$T$P'"), "'$0A$0A$0D$09$0C'");
  EXPECT_EQ(value("\"$00C4\""), "w'\xC3\x84'");
  EXPECT_EQ(value("\"$D83D$DE00\""), "w'\xF0\x9F\x98\x80'");
  EXPECT_EQ(value("STRING#'x'"), "STRING#'x'");
  EXPECT_EQ(value("WSTRING#\"x\""), "WSTRING#w'x'");
  EXPECT_EQ(value("CHAR#'x'"), "CHAR#'x'");
  EXPECT_EQ(value("STRING#\"x\""), "2:13 E0132");
  EXPECT_EQ(value("'a$q'"), "2:8 E0130");
  EXPECT_EQ(value("'a$4'"), "2:8 E0130");
}

TEST(Literals, Addresses) {
  EXPECT_EQ(body("%QX0.1 := %IW4;"), "    assign := (address %QX0.1) (address %IW4)\n");
  EXPECT_EQ(body("x := %I5;"), "    assign := (name x) (address %I5)\n");
  EXPECT_EQ(body("x := %MB*;"), "    assign := (name x) (address %MB*)\n");
  EXPECT_EQ(body("x := %XX1;"), "2:6 E0131");
  EXPECT_EQ(body("x := %IX;"), "2:6 E0131");
}

}  // namespace
}  // namespace rung::text

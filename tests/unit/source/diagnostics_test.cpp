// SPDX-License-Identifier: Apache-2.0
// The list of diagnostics: duplicates, limits, switches, order.
#include "frontend/source/diagnostics.h"

#include <gtest/gtest.h>

#include <set>

#include "sema/diagnostics.h"

namespace rung {
namespace {

TEST(Diagnostics, CodesAreUniqueAndNamed) {
  std::set<std::string> codes;
  for (const DiagInfo& info : allDiags()) {
    EXPECT_TRUE(codes.insert(info.code).second) << info.code << " is used twice";
    EXPECT_EQ(std::string(info.code).size(), 5u) << info.code;
    EXPECT_EQ(info.code[0], info.severity == Severity::Error ? 'E' : info.severity == Severity::Warning ? 'W' : 'I');
  }
  ASSERT_NE(findDiag("e0401"), nullptr);
  EXPECT_STREQ(findDiag("e0401")->name, "UnknownName");
  EXPECT_EQ(findDiag("E9999"), nullptr);
}

TEST(Diagnostics, SameLocationAndCodeIsReportedOnce) {
  Sources sources;
  const Loc loc = sources.begin(sources.add("a.st", "x y"));
  Diagnostics diagnostics(sources);
  diagnostics.report(diag::UnknownName, loc, {"x"});
  diagnostics.report(diag::UnknownName, loc, {"x"});
  diagnostics.report(diag::UnknownName, {loc.offset + 2}, {"y"});
  EXPECT_EQ(diagnostics.errorCount(), 2u);
  EXPECT_EQ(diagnostics.all()[1].message, "`y` is not declared");
}

TEST(Diagnostics, ErrorsBeyondTheLimitAreCounted) {
  Sources sources;
  const Loc loc = sources.begin(sources.add("a.st", std::string(50000, 'x')));
  Diagnostics diagnostics(sources);
  for (uint32_t i = 0; i < 50000; ++i) diagnostics.report(diag::UnknownName, {loc.offset + i}, {"x"}).didYouMean("y");
  EXPECT_EQ(diagnostics.all().size(), 100u);
  EXPECT_EQ(diagnostics.errorCount(), 50000u);
  EXPECT_EQ(diagnostics.droppedCount(), 49900u);
  EXPECT_TRUE(diagnostics.full());
}

TEST(Diagnostics, SortedByLocation) {
  Sources sources;
  const Loc loc = sources.begin(sources.add("a.st", "x y"));
  Diagnostics diagnostics(sources);
  diagnostics.report(diag::UnknownName, {loc.offset + 2}, {"y"});
  diagnostics.report(diag::UnknownName, loc, {"x"});
  diagnostics.report(diag::UnknownName, {}, {"whole"}).path("b.st");
  diagnostics.sort();
  EXPECT_EQ(diagnostics.all()[0].path, "b.st");
  EXPECT_EQ(diagnostics.all()[1].loc, loc);
}

TEST(Diagnostics, LongArgumentsAreCut) {
  Sources sources;
  Diagnostics diagnostics(sources);
  diagnostics.report(diag::UnknownName, {}, {std::string(1000000, 'x')});
  EXPECT_LT(diagnostics.all()[0].message.size(), 500u);
}

TEST(Diagnostics, SwitchesOfWarnings) {
  Sources sources;
  Diagnostics diagnostics(sources);
  EXPECT_FALSE(diagnostics.setWarning("no-such-warning", false));
  EXPECT_FALSE(diagnostics.setWarning("E0401", false));  // errors cannot be switched off
  EXPECT_TRUE(diagnostics.setWarning("all", true));
  for (const DiagInfo& info : allDiags()) {
    if (info.severity != Severity::Warning) continue;
    EXPECT_TRUE(diagnostics.setWarning(std::string("no-") + info.code, true));
    EXPECT_FALSE(diagnostics.enabled(info.diag));
    diagnostics.report(info.diag, {});
    EXPECT_TRUE(diagnostics.all().empty());
    break;
  }
}

}  // namespace
}  // namespace rung

// SPDX-License-Identifier: Apache-2.0
// Dates of day numbers: leap years, centuries, days before 1970. Expected dates are those of `date -u -d @…`.
#include "frontend/source/calendar.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

void expectDate(int64_t days, uint64_t year, uint64_t month, uint64_t day) {
  const CalendarDate date = dateOfDays(days);
  EXPECT_EQ(date.year, year) << days;
  EXPECT_EQ(date.month, month) << days;
  EXPECT_EQ(date.day, day) << days;
}

TEST(Calendar, LeapDays) {
  expectDate(0, 1970, 1, 1);
  expectDate(789, 1972, 2, 29);
  expectDate(790, 1972, 3, 1);
  expectDate(11016, 2000, 2, 29);  // a century that is a leap year
  expectDate(47540, 2100, 2, 28);  // one that is not
  expectDate(47541, 2100, 3, 1);
}

TEST(Calendar, BeforeTheEpoch) {
  expectDate(-1, 1969, 12, 31);
  expectDate(-719162, 1, 1, 1);
}

TEST(Calendar, EveryDayFollowsTheDayBefore) {
  CalendarDate before = dateOfDays(-1);
  for (int64_t day = 0; day < 150000; ++day) {
    const CalendarDate date = dateOfDays(day);
    const bool same_month = date.day == before.day + 1 && date.month == before.month && date.year == before.year;
    const bool next_month = date.day == 1 && before.day >= 28 &&
                            (date.month == before.month + 1 || (date.month == 1 && before.month == 12));
    ASSERT_TRUE(same_month || next_month) << day;
    before = date;
  }
}

}  // namespace
}  // namespace rung

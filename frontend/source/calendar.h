// SPDX-License-Identifier: Apache-2.0
// Dates of the proleptic Gregorian calendar, for printing literals and values.
#pragma once

#include <cstdint>

namespace rung {

struct CalendarDate {
  uint64_t year, month, day;
};

// Days since 1970-01-01, counted in eras of 400 years from 0000-03-01 (H. Hinnant, "chrono-compatible low-level
// algorithms").
inline CalendarDate dateOfDays(int64_t days) {
  days += 719468;
  const int64_t era = (days >= 0 ? days : days - 146096) / 146097;
  const int64_t day_of_era = days - era * 146097;
  const int64_t year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36524 - day_of_era / 146096) / 365;
  const int64_t day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const int64_t month_index = (5 * day_of_year + 2) / 153;
  const int64_t day = day_of_year - (153 * month_index + 2) / 5 + 1;
  const int64_t month = month_index < 10 ? month_index + 3 : month_index - 9;
  const int64_t year = year_of_era + era * 400 + (month <= 2 ? 1 : 0);
  return {static_cast<uint64_t>(year), static_cast<uint64_t>(month), static_cast<uint64_t>(day)};
}

}  // namespace rung

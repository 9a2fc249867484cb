// SPDX-License-Identifier: Apache-2.0
// Native bodies of time.st: the time of the activation; composes and splits dates. DATE and DT count
// seconds since 1970-01-01, TOD milliseconds since midnight, the L-forms nanoseconds. Dates that do not exist in the
// calendar (month 13, 29 February 2026) carry over into the next month or day.
#include "rung/code.h"

namespace {

constexpr int64_t kNsPerSecond = 1'000'000'000, kSecondsPerDay = 86'400;

// Howard Hinnant's days_from_civil and its inverse, with 1970-01-01 as day 0; months beyond 12 carry into the year.
int64_t dayNumberOf(int64_t year, int64_t month, int64_t day) {
  year += (month - 1) / 12;
  month = (month - 1) % 12 + 1;
  if (month < 1) {
    month += 12;
    --year;
  }
  year -= month <= 2 ? 1 : 0;
  const int64_t era = (year >= 0 ? year : year - 399) / 400;
  const int64_t year_of_era = year - era * 400;
  const int64_t day_of_year = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5 + day - 1;
  return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - 719468;
}

struct DateParts {
  int16_t year, month, day;
};
DateParts datePartsOf(int64_t days) {
  days += 719468;
  const int64_t era = days / 146097;  // never before 1970
  const int64_t day_of_era = days - era * 146097;
  const int64_t year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36524 - day_of_era / 146096) / 365;
  const int64_t day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const int64_t shifted = (5 * day_of_year + 2) / 153;
  const int64_t month = shifted < 10 ? shifted + 3 : shifted - 9;
  return {static_cast<int16_t>(year_of_era + era * 400 + (month <= 2 ? 1 : 0)), static_cast<int16_t>(month),
          static_cast<int16_t>(day_of_year - (153 * shifted + 2) / 5 + 1)};
}

// Outputs omitted in a call may be null.
void put(int16_t* to, int64_t value) {
  if (to != nullptr) *to = static_cast<int16_t>(value);
}
void putDate(int64_t days, int16_t* year, int16_t* month, int16_t* day) {
  const DateParts parts = datePartsOf(days);
  put(year, parts.year);
  put(month, parts.month);
  put(day, parts.day);
}
void putClock(uint64_t ms, int16_t* hour, int16_t* minute, int16_t* second, int16_t* millisecond) {
  put(hour, static_cast<int64_t>(ms / 3'600'000));
  put(minute, static_cast<int64_t>(ms / 60'000 % 60));
  put(second, static_cast<int64_t>(ms / 1000 % 60));
  put(millisecond, static_cast<int64_t>(ms % 1000));
}
int64_t clockMs(int64_t hour, int64_t minute, int64_t second, int64_t millisecond) {
  return ((hour * 60 + minute) * 60 + second) * 1000 + millisecond;
}
uint64_t asNs(int64_t ms) { return static_cast<uint64_t>(ms) * 1'000'000u; }

}  // namespace

extern "C" {

uint32_t rung_standard_TASK_TIME(rung_context* ctx) { return static_cast<uint32_t>(ctx->now_ns / 1'000'000); }
int64_t rung_standard_TASK_LTIME(rung_context* ctx) { return ctx->now_ns; }
void rung_standard_TEST_ADVANCE(rung_context* ctx, uint64_t duration) {
  const int64_t step = static_cast<int64_t>(duration);
  constexpr int64_t kLatest = INT64_MAX / 2;  // the following cycles do not overflow
  if (step > 0) ctx->now_ns = step < kLatest - ctx->now_ns ? ctx->now_ns + step : kLatest;
}
uint32_t rung_standard_TIME(rung_context* ctx) { return rung_standard_TASK_TIME(ctx); }
int64_t rung_standard_LTIME(rung_context* ctx) { return ctx->now_ns; }
uint32_t rung_standard_WALL_CLOCK(rung_context* ctx) {
  const int64_t ns =
      ctx->host != nullptr && ctx->host->wall_clock != nullptr ? ctx->host->wall_clock(ctx->host_data) : ctx->now_ns;
  return static_cast<uint32_t>(ns / kNsPerSecond);
}

uint32_t rung_standard_CONCAT_DATE_TOD(rung_context*, uint32_t date, uint32_t tod) { return date + tod / 1000; }
uint32_t rung_standard_CONTACT_DATE_TOD(rung_context*, uint32_t date, uint32_t tod) { return date + tod / 1000; }
uint64_t rung_standard_CONCAT_DATE_LTOD(rung_context*, uint32_t date, uint64_t tod) {
  return uint64_t{date} * kNsPerSecond + tod;
}
uint32_t rung_standard_CONCAT_DATE(rung_context*, int32_t year, int32_t month, int32_t day) {
  return static_cast<uint32_t>(dayNumberOf(year, month, day) * kSecondsPerDay);
}
uint32_t rung_standard_CONCAT_TOD(rung_context*, int32_t hour, int32_t minute, int32_t second, int32_t millisecond) {
  return static_cast<uint32_t>(clockMs(hour, minute, second, millisecond));
}
uint64_t rung_standard_CONCAT_LTOD(rung_context*, int32_t hour, int32_t minute, int32_t second, int32_t millisecond) {
  return asNs(clockMs(hour, minute, second, millisecond));
}
uint32_t rung_standard_CONCAT_DT(rung_context*, int32_t year, int32_t month, int32_t day, int32_t hour, int32_t minute,
                                 int32_t second, int32_t millisecond) {
  return static_cast<uint32_t>(dayNumberOf(year, month, day) * kSecondsPerDay +
                               clockMs(hour, minute, second, millisecond) / 1000);
}
uint64_t rung_standard_CONCAT_LDT(rung_context*, int32_t year, int32_t month, int32_t day, int32_t hour, int32_t minute,
                                  int32_t second, int32_t millisecond) {
  return asNs(dayNumberOf(year, month, day) * kSecondsPerDay * 1000 + clockMs(hour, minute, second, millisecond));
}

void rung_standard_SPLIT_DATE(rung_context*, uint32_t in, int16_t* year, int16_t* month, int16_t* day) {
  putDate(in / kSecondsPerDay, year, month, day);
}
void rung_standard_SPLIT_TOD(rung_context*, uint32_t in, int16_t* hour, int16_t* minute, int16_t* second,
                             int16_t* millisecond) {
  putClock(in, hour, minute, second, millisecond);
}
void rung_standard_SPLIT_LTOD(rung_context*, uint64_t in, int16_t* hour, int16_t* minute, int16_t* second,
                              int16_t* millisecond) {
  putClock(in / 1'000'000, hour, minute, second, millisecond);
}
void rung_standard_SPLIT_DT(rung_context*, uint32_t in, int16_t* year, int16_t* month, int16_t* day, int16_t* hour,
                            int16_t* minute, int16_t* second, int16_t* millisecond) {
  putDate(in / kSecondsPerDay, year, month, day);
  putClock(uint64_t{static_cast<uint32_t>(in % kSecondsPerDay)} * 1000, hour, minute, second, millisecond);
}
void rung_standard_SPLIT_LDT(rung_context*, uint64_t in, int16_t* year, int16_t* month, int16_t* day, int16_t* hour,
                             int16_t* minute, int16_t* second, int16_t* millisecond) {
  const uint64_t day_ns = uint64_t{kSecondsPerDay} * kNsPerSecond;
  putDate(static_cast<int64_t>(in / day_ns), year, month, day);
  putClock(in % day_ns / 1'000'000, hour, minute, second, millisecond);
}
// 1970-01-01 was a Thursday.
int16_t rung_standard_DAY_OF_WEEK(rung_context*, uint32_t in) {
  return static_cast<int16_t>((in / kSecondsPerDay + 4) % 7);
}

}  // extern "C"

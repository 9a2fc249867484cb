// SPDX-License-Identifier: Apache-2.0
// Distributed clocks: see distributed_clock.h.
#include "fieldbus/distributed_clock.h"
#include "drive/rounding.h"

#include <math.h>

namespace rung::fieldbus {
namespace {

constexpr int64_t kSecond = 1000000000;

// The time that the drift compensation has added until a local time.
double correctionAt(const DcClock& clock, int64_t local) {
  return clock.corrected + clock.speed * static_cast<double>(local - clock.corrected_at);
}

}  // namespace

int64_t systemTimeOf(int64_t unix_nanoseconds) { return unix_nanoseconds - kDcEpoch * kSecond; }
uint32_t shortTimeOf(int64_t system_time) { return static_cast<uint32_t>(system_time); }

int64_t localTime(const DcClock& clock, int64_t true_time) {
  return clock.local_offset + true_time + motion::rounded(clock.drift * static_cast<double>(true_time));
}

int64_t localSystemTime(const DcClock& clock, int64_t true_time) {
  const int64_t local = localTime(clock, true_time);
  return local + clock.system_offset + motion::rounded(correctionAt(clock, local));
}

// The time that a frame is away from a slave is twice the way to the end; the difference of two slaves is twice the way
// between them.
void measureDelays(const PassTimes* times, size_t count, int64_t* delays) {
  if (count == 0) return;
  delays[0] = 0;
  for (size_t i = 1; i < count; ++i) {
    const int64_t away_before = times[i - 1].port_1 - times[i - 1].port_0;
    const int64_t away = times[i].port_1 - times[i].port_0;
    delays[i] = delays[i - 1] + (away_before - away) / 2;
  }
}

int64_t offsetFor(int64_t reference_time, int64_t local_time, int64_t delay) {
  return reference_time + delay - local_time;
}

void compensateDrift(DcClock& clock, int64_t reference_time, int64_t true_time, int64_t interval) {
  const int64_t local = localTime(clock, true_time);
  const double error = static_cast<double>(reference_time + clock.delay - localSystemTime(clock, true_time));
  clock.corrected = correctionAt(clock, local);
  clock.corrected_at = local;
  // Half of the error is made good by the next time; what stays in `speed` is the drift itself.
  if (interval > 0) clock.speed += error / 2 / static_cast<double>(interval);
}

int64_t masterLead(int64_t program, int64_t frame, int64_t line, int64_t reserve) {
  return program + frame + line + reserve;
}

bool arrivesInTime(int64_t before_sync, int64_t copy_time) { return before_sync >= copy_time; }

}  // namespace rung::fieldbus

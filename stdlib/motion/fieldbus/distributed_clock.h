// SPDX-License-Identifier: Apache-2.0
// The distributed clocks of a segment: local clocks with offset and drift, and what a master does to make them one: it
// measures the delays of the line, compensates the offsets, and then the drift, again and again. Times are nanoseconds.
// TM/TP manual 2.1.4; AX manual 7.1.4; IEC 61158-4-12, distributed clocks.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace rung::fieldbus {

// The system time counts from 2001-01-01 00:00: 64 bits of nanoseconds, or the lower 32 bits, which last 4.3 s.
constexpr int64_t kDcEpoch = 978307200;  // in seconds of Unix time
int64_t systemTimeOf(int64_t unix_nanoseconds);
uint32_t shortTimeOf(int64_t system_time);

// The clock of one slave. What it shows at a true time is offset + (1 + drift) * time + correction.
struct DcClock {
  int64_t local_offset;   // of the local clock
  double drift;           // of the local clock: 1e-6 runs 1 µs faster in each second
  int64_t delay;          // of the line from the reference clock to this slave; found by measureDelays
  int64_t system_offset;  // written by the master: from local to system time
  double speed;           // written by the drift compensation: relative
  double corrected;       // sum of what `speed` has added
  int64_t corrected_at;   // local time of that sum
};

int64_t localTime(const DcClock& clock, int64_t true_time);
int64_t localSystemTime(const DcClock& clock, int64_t true_time);

// A line of slaves: a frame passes port 0 of each, reaches the last, and comes back through port 1 of each. In: the
// local times at which it went through, one pair a slave; processing takes `forward` at each slave on the way out and
// `backward` on the way back. Out: the delay of each slave to the first.
struct PassTimes {
  int64_t port_0, port_1;
};
void measureDelays(const PassTimes* times, size_t count, int64_t* delays);

// The offset of each clock, such that its system time is that of the reference clock, the first. `reference_time`: what
// the reference clock shows when the clocks show `local_times`.
int64_t offsetFor(int64_t reference_time, int64_t local_time, int64_t delay);

// Drift compensation: the clock takes the system time that arrives from the reference, and runs faster or slower by a
// part of the difference, over the time until the next one.
void compensateDrift(DcClock& clock, int64_t reference_time, int64_t true_time, int64_t interval);

// How much earlier than the SYNC event the master starts: its program, the frame, the line and a reserve for jitter.
int64_t masterLead(int64_t program, int64_t frame, int64_t line, int64_t reserve);

// Tells whether a frame that arrives `before_sync` ahead of the SYNC event is in time for a slave that needs
// `copy_time` (T1).
bool arrivesInTime(int64_t before_sync, int64_t copy_time);

}  // namespace rung::fieldbus

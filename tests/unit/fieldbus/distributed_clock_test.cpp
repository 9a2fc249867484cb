// SPDX-License-Identifier: Apache-2.0
// Distributed clocks: delays, offsets and drift of a line of three slaves with known clocks.
#include "fieldbus/distributed_clock.h"

#include <gtest/gtest.h>

#include <stdlib.h>

namespace rung::fieldbus {
namespace {

TEST(DistributedClock, SystemTimeBegins2001) {
  EXPECT_EQ(0, systemTimeOf(978307200LL * 1000000000));
  EXPECT_EQ(1u, shortTimeOf((int64_t{1} << 32) + 1));  // wraps after 4.29 s
}

// The frame leaves slave 0 at 1000, passes slave 1 200 ns and slave 2 500 ns later, and comes back: away 1000, 600 and
// 0.
TEST(DistributedClock, DelaysAreHalfOfTheWayAndBack) {
  const PassTimes times[] = {{1000, 2000}, {51200, 51800}, {7500, 7500}};
  int64_t delays[3];
  measureDelays(times, 3, delays);
  EXPECT_EQ(0, delays[0]);
  EXPECT_EQ(200, delays[1]);
  EXPECT_EQ(500, delays[2]);
}

TEST(DistributedClock, OffsetsMakeTheClocksOne) {
  DcClock reference = {}, slave = {};
  reference.local_offset = 123456789;
  slave.local_offset = -987654321;
  slave.delay = 200;
  // The reference is read at 0, and its time arrives 200 ns later.
  const int64_t sent = localSystemTime(reference, 0);
  slave.system_offset = offsetFor(sent, localTime(slave, 200), slave.delay);
  EXPECT_EQ(localSystemTime(reference, 1000000), localSystemTime(slave, 1000000));
}

// A clock 100 ppm too fast (system time < local time) and one too slow, compensated each millisecond: within 1 µs, as
// the manuals say.
TEST(DistributedClock, DriftIsCompensated) {
  for (const double drift : {100e-6, -100e-6}) {
    DcClock reference = {}, slave = {};
    slave.drift = drift;
    slave.delay = 200;
    const int64_t cycle = 1000000;
    for (int64_t at = 0; at < 2000 * cycle; at += cycle) {
      compensateDrift(slave, localSystemTime(reference, at), at + slave.delay, cycle);
      if (at < 100 * cycle) continue;
      const int64_t between = at + cycle / 2;
      EXPECT_LT(llabs(localSystemTime(slave, between) - localSystemTime(reference, between)), 1000);
    }
  }
}

TEST(DistributedClock, TheMasterStartsEarlier) {
  EXPECT_EQ(400000 + 100000 + 3000 + 20000, masterLead(400000, 100000, 3000, 20000));
  EXPECT_TRUE(arrivesInTime(50, 50));
  EXPECT_FALSE(arrivesInTime(49, 50));
}

}  // namespace
}  // namespace rung::fieldbus

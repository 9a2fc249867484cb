// SPDX-License-Identifier: Apache-2.0
// Homing: every method of CiA 402 and every set of digits of P5.10, from both sides of the switch and from it. The
// machine has limit switches at -100 000 and 100 000, a home switch from 30 000 to 50 000, and Z pulses at the
// multiples of 10 000 plus 3 000.
#include "drive/homing.h"

#include <gtest/gtest.h>

#include "drive_fixture.h"

namespace rung::motion {
namespace {

constexpr uint16_t kReached = 0x400, kAttained = 0x1000, kError = 0x2000;

struct Machine : TestDrive {
  Machine(int start, int method, unsigned digits) {
    drive.has_limits_ = 1;
    drive.negative_limit_from_ = -100000;
    drive.positive_limit_from_ = 100000;
    drive.home_from_ = 30000;
    drive.home_to_ = 50000;
    drive.z_pulse_ = 3000;
    drive.homing_method_ = static_cast<int8_t>(method);
    drive.homing_digits_ = static_cast<uint16_t>(digits);
    drive.machine_position_ = start;
    enable(6);
  }
  uint16_t home() {
    step(uint16_t{0x1F});
    for (int i = 0; i < 1000000 && (data.statusword & (kReached | kError)) != kReached &&
                    (data.statusword & (kReached | kError)) != (kReached | kError);
         ++i)
      step();
    while ((data.statusword & kReached) == 0 && (data.statusword & 8) == 0) step();
    return data.statusword & (kReached | kAttained | kError);
  }
};

// The reference for a start left of the switch, on it, and right of it.
struct Row {
  int method;
  int left, on, right;
};
constexpr int kNever = 1 << 30;  // it runs into the limit switch

// Left edge 30 000: its Z pulses are 23 000 and 33 000. Right edge 50 000: 43 000 and 53 000. Limits: -97 000 and 93
// 000 inside.
constexpr Row kRows[] = {
    {1, -97000, -97000, -97000},  {2, 93000, 93000, 93000},   {3, 23000, 23000, kNever},
    {4, 33000, 33000, kNever},    {5, kNever, 53000, 53000},  {6, kNever, 43000, 43000},
    {7, 23000, 23000, 23000},     {8, 33000, 33000, 33000},   {9, 43000, 43000, 43000},
    {10, 53000, 53000, 53000},    {11, 53000, 53000, 53000},  {12, 43000, 43000, 43000},
    {13, 33000, 33000, 33000},    {14, 23000, 23000, 23000},  {17, -100000, -100000, -100000},
    {18, 100000, 100000, 100000}, {19, 30000, 30000, kNever}, {20, 30000, 30000, kNever},
    {21, kNever, 50000, 50000},   {22, kNever, 50000, 50000}, {23, 30000, 30000, 30000},
    {24, 30000, 30000, 30000},    {25, 50000, 50000, 50000},  {26, 50000, 50000, 50000},
    {27, 50000, 50000, 50000},    {28, 50000, 50000, 50000},  {29, 30000, 30000, 30000},
    {30, 30000, 30000, 30000},    {33, -7000, 33000, 73000},  {34, 3000, 43000, 83000},
    {35, 0, 40000, 80000},        {37, 0, 40000, 80000},
};

void expectReference(int start, int method, unsigned digits, int reference) {
  Machine machine(start, method, digits);
  const uint16_t status = machine.home();
  const std::string what = std::to_string(method) + "/" + std::to_string(digits) + " from " + std::to_string(start);
  if (reference == kNever) {
    EXPECT_NE(0, status & kError) << what;
    EXPECT_FALSE(machine.drive.homed_) << what;
    return;
  }
  EXPECT_EQ(kReached | kAttained, status) << what;
  EXPECT_EQ(reference, machine.drive.zero_) << what;
  EXPECT_EQ(static_cast<int>(machine.drive.machine_position_ - reference), machine.data.position) << what;
}

TEST(Homing, MethodsOfTheStandard) {
  for (const Row& row : kRows) {
    expectReference(0, row.method, 0, row.left);
    expectReference(40000, row.method, 0, row.on);
    expectReference(80000, row.method, 0, row.right);
  }
}

TEST(Homing, UnknownMethodsAreErrors) {
  for (const int method : {15, 16, 31, 32, 36, 38, 127, -1}) {
    Machine machine(0, method, 8);
    EXPECT_EQ(kReached | kError, machine.home()) << method;
  }
}

// TM/TP manual 7.1.3: digits R T Z M. Rows of M 0 to 8, with Z 0, 1 and 2 where it matters.
struct DigitRow {
  unsigned digits;
  int start, reference;
};
constexpr DigitRow kDigitRows[] = {
    {20, 0, 100000},     {0, 0, 93000},       {10, 0, 103000},      // forward limit switch: itself, back, on
    {21, 0, -100000},    {1, 0, -97000},      {11, 0, -107000},     // reverse limit switch
    {22, 0, 30000},      {2, 0, 23000},       {12, 0, 33000},       // rising edge of the home switch, forward
    {22, 40000, 30000},  {22, 80000, kNever}, {122, 80000, 30000},  // T 0: fault, 1: reverses
    {23, 80000, 50000},  {3, 80000, 53000},   {13, 80000, 43000},   // reverse
    {23, 0, kNever},     {123, 0, 50000},     {4, 0, 3000},
    {104, 95000, 93000},  // first Z pulse; past the limit it reverses
    {5, 0, -7000},       {26, 0, 50000},      {6, 0, 43000},
    {16, 0, 53000},                                                // falling edge, forward
    {27, 80000, 30000},  {7, 80000, 33000},   {17, 80000, 23000},  // falling edge, reverse
    {8, 40000, 40000},                                             // where it is
};

TEST(Homing, DigitsOfTheManual) {
  for (const DigitRow& row : kDigitRows) expectReference(row.start, 0, row.digits, row.reference);
}

TEST(Homing, WrongDigitsAreErrors) {
  for (const unsigned digits : {9u, 32u, 222u, 30u}) {
    Machine machine(0, 0, digits);
    EXPECT_EQ(kReached | kError, machine.home()) << digits;
  }
}

TEST(Homing, OvertravelIsAFault) {
  Machine machine(0, 0, 23);  // reverse, away from the switch, T 0
  machine.home();
  machine.run(200);
  EXPECT_EQ(0x08, machine.data.statusword & 0x4F);
  EXPECT_EQ(0x8612, machine.data.error_code);
}

TEST(Homing, OffsetMovesTheZero) {
  Machine machine(0, 24, 0);
  machine.drive.home_offset_ = 500;
  machine.home();
  EXPECT_EQ(30500, machine.drive.zero_);
}

TEST(Homing, StatusOfItsPhases) {
  Machine machine(0, 24, 0);
  EXPECT_EQ(kReached, machine.data.statusword & (kReached | kAttained | kError)) << "not started";
  machine.step(uint16_t{0x1F});
  EXPECT_EQ(0, machine.data.statusword & (kReached | kAttained | kError)) << "in progress";
  machine.run(100);
  machine.step(uint16_t{0x0F});
  machine.run(100);
  EXPECT_EQ(kReached, machine.data.statusword & (kReached | kAttained | kError)) << "interrupted";
  EXPECT_FALSE(machine.drive.homed_);
}

TEST(Homing, InjectedFailures) {
  Machine fails(0, 24, 0);
  fails.drive.homing_fails_ = 1;
  EXPECT_EQ(kReached | kError, fails.home());
  Machine ignores(0, 24, 0);
  ignores.drive.homing_ignored_ = 1;
  ignores.step(uint16_t{0x1F});
  ignores.run(100);
  EXPECT_EQ(kReached, ignores.data.statusword & (kReached | kAttained | kError));
  Machine slow(0, 24, 0);
  slow.drive.homing_speed_zero_ = 0;
  EXPECT_EQ(kReached | kError, slow.home()) << "a speed is 0";
}

// By hand, the edge is where the machine is when the input changes.
TEST(Homing, SwitchSetByHand) {
  Machine machine(0, 24, 0);
  machine.drive.home_to_ = 0;
  machine.step(uint16_t{0x1F});
  machine.run(100);
  const double there = machine.drive.machine_position_;
  machine.drive.home_switch_ = 1;
  EXPECT_GE(machine.runUntil(kAttained | kReached), 0);
  EXPECT_EQ(there, machine.drive.zero_);
}

}  // namespace
}  // namespace rung::motion

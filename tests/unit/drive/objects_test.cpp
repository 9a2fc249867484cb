// SPDX-License-Identifier: Apache-2.0
// The object dictionary: every object with its length and access, and the mapping of the process data.
#include "drive/objects.h"

#include <gtest/gtest.h>

#include "drive_fixture.h"

namespace rung::motion {
namespace {

struct Row {
  uint16_t index;
  uint8_t subindex, bytes;
  bool is_writable;
};
constexpr Row kRows[] = {
    {0x1000, 0, 4, false}, {0x1001, 0, 1, false}, {0x1018, 0, 1, false}, {0x1018, 4, 4, false}, {0x1C00, 0, 1, false},
    {0x1C12, 0, 1, false}, {0x1C13, 1, 2, false}, {0x1600, 0, 1, false}, {0x1A00, 1, 4, false}, {0x603F, 0, 2, false},
    {0x6040, 0, 2, true},  {0x6041, 0, 2, false}, {0x605A, 0, 2, true},  {0x605B, 0, 2, true},  {0x605C, 0, 2, true},
    {0x605D, 0, 2, true},  {0x605E, 0, 2, true},  {0x6060, 0, 1, true},  {0x6061, 0, 1, false}, {0x6064, 0, 4, false},
    {0x6065, 0, 4, true},  {0x6066, 0, 2, true},  {0x6067, 0, 4, true},  {0x6068, 0, 2, true},  {0x606C, 0, 4, false},
    {0x606D, 0, 2, true},  {0x606E, 0, 2, true},  {0x6071, 0, 2, true},  {0x6072, 0, 2, true},  {0x6073, 0, 2, true},
    {0x6075, 0, 4, true},  {0x6077, 0, 2, false}, {0x607A, 0, 4, true},  {0x607C, 0, 4, true},  {0x607D, 0, 1, false},
    {0x607D, 1, 4, true},  {0x607D, 2, 4, true},  {0x607F, 0, 4, true},  {0x6081, 0, 4, true},  {0x6083, 0, 4, true},
    {0x6084, 0, 4, true},  {0x6085, 0, 4, true},  {0x6087, 0, 4, true},  {0x6098, 0, 1, true},  {0x6099, 0, 1, false},
    {0x6099, 1, 4, true},  {0x6099, 2, 4, true},  {0x609A, 0, 4, true},  {0x60B8, 0, 2, true},  {0x60B9, 0, 2, false},
    {0x60BA, 0, 4, false}, {0x60BB, 0, 4, false}, {0x60BC, 0, 4, false}, {0x60BD, 0, 4, false}, {0x60C2, 0, 1, false},
    {0x60C2, 1, 1, true},  {0x60C2, 2, 1, true},  {0x60FD, 0, 4, false}, {0x60FE, 1, 4, true},  {0x60FF, 0, 4, true},
    {0x6502, 0, 4, false},
};

// Objects that the process data overwrites.
bool isExchanged(uint16_t index) {
  for (const uint16_t one : {0x6040, 0x6060, 0x6071, 0x607A, 0x60B8, 0x60FE, 0x60FF})
    if (one == index) return true;
  return false;
}

TEST(Objects, LengthAndAccess) {
  for (const Row& row : kRows) {
    TestDrive test;
    test.step();
    uint32_t value = 0;
    EXPECT_EQ(RUNG_OBJECT_DONE, test.access(row.index, row.subindex, row.bytes, false, &value))
        << std::hex << row.index;
    const uint8_t other = row.bytes == 4 ? 2 : 4;
    EXPECT_EQ(RUNG_OBJECT_UNKNOWN, test.access(row.index, row.subindex, other, false, &value)) << std::hex << row.index;
    value = 1;
    const int64_t written = test.access(row.index, row.subindex, row.bytes, true, &value);
    if (row.is_writable) {
      EXPECT_EQ(RUNG_OBJECT_DONE, written) << std::hex << row.index;
      value = 0;
      test.access(row.index, row.subindex, row.bytes, false, &value);
      if (!isExchanged(row.index)) {
        EXPECT_EQ(1u, value) << std::hex << row.index;
      }
    } else {
      EXPECT_NE(RUNG_OBJECT_DONE, written) << std::hex << row.index;
    }
  }
}

// What is written to one is not seen in another.
TEST(Objects, EachHasItsOwnValue) {
  TestDrive test;
  test.step();
  const auto isKept = [](const Row& row) {
    const bool is_choice = row.index >= 0x605A && row.index <= 0x605E;  // of a few values
    return row.is_writable && row.bytes > 1 && !is_choice && !isExchanged(row.index);
  };
  uint32_t value = 40;
  for (const Row& row : kRows) {
    if (!isKept(row)) continue;
    ++value;
    EXPECT_EQ(RUNG_OBJECT_DONE, test.access(row.index, row.subindex, row.bytes, true, &value)) << std::hex << row.index;
  }
  uint32_t written = 40;
  for (const Row& row : kRows) {
    if (!isKept(row)) continue;
    value = 0;
    test.access(row.index, row.subindex, row.bytes, false, &value);
    EXPECT_EQ(++written, value) << std::hex << row.index;
  }
}

TEST(Objects, UnknownReadOnlyAndWrongValues) {
  TestDrive test;
  test.step();
  uint32_t value = 0;
  EXPECT_EQ(RUNG_OBJECT_UNKNOWN, test.access(0x5FFF, 0, 4, false, &value));
  EXPECT_EQ(RUNG_OBJECT_UNKNOWN, test.access(0x6099, 3, 4, false, &value));
  EXPECT_EQ(RUNG_OBJECT_UNKNOWN, test.access(0x6099, 1, 3, false, &value));
  EXPECT_EQ(RUNG_OBJECT_READ_ONLY, test.access(0x6041, 0, 2, true, &value));
  EXPECT_EQ(RUNG_OBJECT_READ_ONLY, test.access(0x1000, 0, 4, true, &value));
  value = 16;
  EXPECT_EQ(RUNG_OBJECT_RANGE, test.access(0x6098, 0, 1, true, &value)) << "method 16 is reserved";
  value = 4;
  EXPECT_EQ(RUNG_OBJECT_RANGE, test.access(0x6060, 0, 1, true, &value));
  EXPECT_EQ(RUNG_OBJECT_UNKNOWN, test.access(0x1008, 0, 4, false, &value)) << "a text of 20 bytes";
}

TEST(Objects, AnswersAfterTheCyclesSet) {
  TestDrive test;
  test.step();
  test.drive.sdo_cycles_ = 3;
  uint32_t value = 0;
  const rung_object_access request = {0x6041, 0, 2, 0, 0};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(RUNG_OBJECT_BUSY, accessObject(test.drive, request, &value));
    test.step();
  }
  EXPECT_EQ(RUNG_OBJECT_DONE, accessObject(test.drive, request, &value));
  EXPECT_EQ(test.data.statusword, value);
}

TEST(Objects, ASilentDriveFailsAfterItsTimeout) {
  TestDrive test;
  test.step();
  test.drive.sdo_silent_ = 1;
  uint32_t value = 0;
  const uint32_t before = test.drive.steps_;
  EXPECT_EQ(RUNG_OBJECT_FAILED, test.access(0x6041, 0, 2, false, &value));
  EXPECT_EQ(100u, test.drive.steps_ - before);
  test.drive.sdo_silent_ = 0;
  test.drive.communication_lost_ = 1;
  EXPECT_EQ(RUNG_OBJECT_FAILED, test.access(0x6041, 0, 2, false, &value));
  test.drive.communication_lost_ = 0;
  EXPECT_EQ(RUNG_OBJECT_DONE, test.access(0x6041, 0, 2, false, &value));
}

TEST(Objects, AllOfTheProcessDataIsMapped) {
  TestDrive test;
  test.step();
  EXPECT_EQ(0x1FF7Fu, test.data.mapped);  // bit 7 is not an object
  uint32_t value = 0;
  test.access(0x1600, 1, 4, false, &value);
  EXPECT_EQ(0x60400010u, value);
  test.access(0x1A00, 1, 4, false, &value);
  EXPECT_EQ(0x60410010u, value);
  test.access(0x1C12, 1, 2, false, &value);
  EXPECT_EQ(0x1600u, value);
  test.access(0x1C13, 2, 2, false, &value);
  EXPECT_EQ(0x1A01u, value);
}

TEST(Objects, WhatIsNotMappedIsNotExchanged) {
  TestDrive test;
  test.drive.mapped_ = 0x1FFFF & ~static_cast<uint32_t>(RUNG_DRIVE_CONTROLWORD | RUNG_DRIVE_POSITION);
  test.enable(8);
  EXPECT_EQ(0x40, test.data.statusword & 0x4F) << "no controlword arrives";
  uint32_t value = 6;
  EXPECT_EQ(RUNG_OBJECT_DONE, test.access(0x6040, 0, 2, true, &value));
  test.step();
  EXPECT_EQ(0x21, test.data.statusword & 0x6F) << "but by SDO";
  test.drive.machine_position_ = 77;
  test.step();
  EXPECT_EQ(0, test.data.position);
}

// The manual's example: 1600h with 6040h and 607Ah, 1601h with 6071h and 6087h, 1602h with 6073h and 6075h.
TEST(Objects, MappingIsChangedInPreOp) {
  TestDrive test;
  test.drive.requested_state_ = 2;
  test.step();
  const auto write = [&](uint16_t index, uint8_t subindex, uint8_t bytes, uint32_t value) {
    return test.access(index, subindex, bytes, true, &value);
  };
  EXPECT_EQ(RUNG_OBJECT_DONE, write(0x1C12, 0, 1, 0));
  const uint32_t entries[3][2] = {{0x60400010, 0x607A0020}, {0x60710010, 0x60870020}, {0x60730010, 0x60750020}};
  for (uint16_t i = 0; i < 3; ++i) {
    const auto pdo = static_cast<uint16_t>(0x1600 + i);
    EXPECT_EQ(RUNG_OBJECT_DONE, write(pdo, 0, 1, 0));
    EXPECT_EQ(RUNG_OBJECT_DONE, write(pdo, 1, 4, entries[i][0]));
    EXPECT_EQ(RUNG_OBJECT_DONE, write(pdo, 2, 4, entries[i][1]));
    EXPECT_EQ(RUNG_OBJECT_DONE, write(pdo, 0, 1, 2));
    EXPECT_EQ(RUNG_OBJECT_DONE, write(0x1C12, static_cast<uint8_t>(i + 1), 2, pdo));
  }
  EXPECT_EQ(RUNG_OBJECT_DONE, write(0x1C12, 0, 1, 3));
  EXPECT_EQ(RUNG_OBJECT_RANGE, write(0x1600, 1, 4, 0x60400010)) << "the list is in use";
  EXPECT_EQ(RUNG_OBJECT_DONE, write(0x1603, 0, 1, 0));
  EXPECT_EQ(RUNG_OBJECT_RANGE, write(0x1603, 1, 4, 0x60410010)) << "the statusword is not for the drive";
  EXPECT_EQ(RUNG_OBJECT_RANGE, write(0x1603, 1, 4, 0x60400020)) << "it has 16 bits";
  test.drive.requested_state_ = 8;
  test.step();
  const uint32_t to_drive = RUNG_DRIVE_CONTROLWORD | RUNG_DRIVE_TARGET_POSITION | RUNG_DRIVE_TARGET_TORQUE;
  EXPECT_EQ(to_drive, test.data.mapped & 0xFF);
  EXPECT_EQ(RUNG_OBJECT_RANGE, write(0x1C12, 0, 1, 0)) << "only in PreOp";
}

}  // namespace
}  // namespace rung::motion

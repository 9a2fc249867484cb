// SPDX-License-Identifier: Apache-2.0
// Sercos over EtherCAT against the tables of the manuals.
#include "fieldbus/soe.h"

#include <gtest/gtest.h>

#include <string.h>

namespace rung::fieldbus {
namespace {

// TM/TP manual, table 2-11.
TEST(Soe, IdnBits) {
  EXPECT_EQ(0x000F, idnCode({false, 0, 15}));
  EXPECT_EQ(0xFFFF, idnCode({true, 7, 4095}));
  EXPECT_EQ(0x8001, idnCode({true, 0, 1}));
  EXPECT_EQ(0x2005, idnCode({false, 2, 5}));
  const Idn idn = idnOf(0xA064);
  EXPECT_TRUE(idn.is_product);
  EXPECT_EQ(2, idn.set);
  EXPECT_EQ(100, idn.number);
}

// Tables 2-12 and 2-13.
TEST(Soe, DeletedAndRedefinedIdns) {
  for (const uint16_t number : {3, 4, 5, 9, 10, 88, 90, 127, 128}) EXPECT_TRUE(isDeletedIdn(number)) << number;
  for (const uint16_t number : {6, 14, 28, 89}) {
    EXPECT_TRUE(isRedefinedIdn(number)) << number;
    EXPECT_FALSE(isDeletedIdn(number));
  }
  EXPECT_FALSE(isDeletedIdn(15));
}

// Table 2-14.
TEST(Soe, StandardTelegrams) {
  struct Row {
    unsigned type;
    uint8_t commands, feedbacks;
    uint16_t command, feedback;
  };
  constexpr Row rows[] = {{0, 0, 0, 0, 0},   {1, 1, 0, 80, 0},  {2, 1, 1, 36, 53}, {3, 1, 1, 36, 51},
                          {4, 1, 1, 47, 53}, {5, 2, 1, 47, 51}, {6, 1, 0, 36, 0}};
  for (const Row& row : rows) {
    Telegram telegram;
    ASSERT_TRUE(standardTelegram(row.type, false, &telegram));
    EXPECT_EQ(row.commands, telegram.command_count) << row.type;
    EXPECT_EQ(row.feedbacks, telegram.feedback_count) << row.type;
    EXPECT_EQ(row.command, telegram.commands[0]) << row.type;
    EXPECT_EQ(row.feedback, telegram.feedbacks[0]) << row.type;
  }
  Telegram telegram;
  ASSERT_TRUE(standardTelegram(5, true, &telegram));
  EXPECT_EQ(36, telegram.commands[1]);
  EXPECT_EQ(53, telegram.feedbacks[0]);
  EXPECT_EQ(51, telegram.feedbacks[1]);
  EXPECT_FALSE(standardTelegram(7, false, &telegram));
  EXPECT_EQ(2u, telegramBytes(kSTorqueCommand));
  for (const uint16_t idn : {kSVelocityCommand, kSPositionCommand, kSPositionFeedback, kSVelocityFeedback})
    EXPECT_EQ(4u, telegramBytes(idn));
}

// Table 2-15: greatest length, actual length, numbers.
TEST(Soe, CustomTelegram) {
  const uint16_t commands[] = {4, 2, kSPositionCommand, kSTorqueCommand}, feedbacks[] = {4, 1, kSPositionFeedback};
  Telegram telegram;
  ASSERT_TRUE(customTelegram(commands, 4, feedbacks, 3, &telegram));
  EXPECT_EQ(2, telegram.command_count);
  EXPECT_EQ(kSTorqueCommand, telegram.commands[1]);
  EXPECT_EQ(kSPositionFeedback, telegram.feedbacks[0]);
  EXPECT_FALSE(customTelegram(commands, 3, feedbacks, 3, &telegram)) << "shorter than it says";
}

// Section 2.4.2.1. The manual prints Op for phase 2; the mailbox works from PreOp on.
TEST(Soe, Phases) {
  EXPECT_EQ(0, phaseOf(EcatState::Init));
  EXPECT_EQ(2, phaseOf(EcatState::PreOp));
  EXPECT_EQ(3, phaseOf(EcatState::SafeOp));
  EXPECT_EQ(4, phaseOf(EcatState::Op));
  EXPECT_EQ(-1, phaseOf(EcatState::Boot));
}

// Table 2-16.
TEST(Soe, HeaderBits) {
  uint8_t bytes[4];
  writeSoeHeader({SoeCommand::ReadRequest, true, false, 5, kValue, 0x1234}, bytes);
  const uint8_t expected[] = {0xA9, 0x40, 0x34, 0x12};
  EXPECT_EQ(0, memcmp(bytes, expected, 4));
  const SoeHeader header = readSoeHeader(bytes);
  EXPECT_EQ(SoeCommand::ReadRequest, header.command);
  EXPECT_TRUE(header.more_follows);
  EXPECT_FALSE(header.error);
  EXPECT_EQ(5, header.drive);
  const SoeCommand commands[] = {SoeCommand::ReadRequest,   SoeCommand::ReadResponse, SoeCommand::WriteRequest,
                                 SoeCommand::WriteResponse, SoeCommand::Notification, SoeCommand::SlaveInfo,
                                 SoeCommand::Reserved};
  for (int i = 0; i < 7; ++i) EXPECT_EQ(i + 1, static_cast<int>(commands[i]));
}

struct Channel {
  SoeParameter parameters[2] = {{kSVelocityCommand, "velocity", "rpm", 0x10, -3000, 3000, 100, 4, false, false, false},
                                {99, "reset", "", 0, 0, 3, 0, 2, false, true, false}};
  uint8_t request[16] = {}, answer[64] = {};

  SoeHeader ask(SoeCommand command, uint8_t elements, uint16_t idn, bool is_single, size_t data = 0) {
    writeSoeHeader({command, false, false, 0, elements, idn}, request);
    size = answerSoe(parameters, 2, is_single, request, kSoeHeaderBytes + data, answer, sizeof answer);
    return readSoeHeader(answer);
  }
  unsigned error() const { return answer[4] | answer[5] << 8; }
  size_t size = 0;
};

TEST(Soe, ReadsElements) {
  Channel channel;
  SoeHeader header = channel.ask(SoeCommand::ReadRequest, kMinimum | kValue, kSVelocityCommand, false);
  EXPECT_EQ(SoeCommand::ReadResponse, header.command);
  EXPECT_EQ(kMinimum | kValue, header.elements);
  const uint8_t data[] = {0x48, 0xF4, 0xFF, 0xFF, 100, 0, 0, 0};
  EXPECT_EQ(12u, channel.size);
  EXPECT_EQ(0, memcmp(data, channel.answer + 4, 8));
  header = channel.ask(SoeCommand::ReadRequest, kMinimum | kValue, kSVelocityCommand, true);
  EXPECT_EQ(kMinimum, header.elements) << "a server of single elements answers the first one";
  channel.ask(SoeCommand::ReadRequest, kName, kSVelocityCommand, false);
  EXPECT_EQ(0, memcmp("\10\0\10\0velocity", channel.answer + 4, 12));
}

TEST(Soe, WritesWithinItsLimits) {
  Channel channel;
  const int32_t value = 3001;
  memcpy(channel.request + 4, &value, 4);
  EXPECT_TRUE(channel.ask(SoeCommand::WriteRequest, kValue, kSVelocityCommand, false, 4).error);
  EXPECT_EQ(kSoeAboveMaximum, channel.error());
  channel.request[4] = 200, channel.request[5] = 0;
  EXPECT_FALSE(channel.ask(SoeCommand::WriteRequest, kValue, kSVelocityCommand, false, 4).error);
  EXPECT_EQ(200, channel.parameters[0].value);
  EXPECT_TRUE(channel.ask(SoeCommand::WriteRequest, kUnit, kSVelocityCommand, false, 4).error);
  EXPECT_EQ(kSoeReadOnly, channel.error());
}

TEST(Soe, UnknownAndDeletedIdns) {
  Channel channel;
  EXPECT_TRUE(channel.ask(SoeCommand::ReadRequest, kValue, 47, false).error);
  EXPECT_EQ(kSoeNoIdn, channel.error());
  channel.parameters[0].idn = 127;
  EXPECT_TRUE(channel.ask(SoeCommand::ReadRequest, kValue, 127, false).error);
}

TEST(Soe, AProcedureLeavesTheChannelFree) {
  Channel channel;
  channel.request[4] = 3, channel.request[5] = 0;
  EXPECT_FALSE(channel.ask(SoeCommand::WriteRequest, kValue, 99, false, 2).error);
  EXPECT_TRUE(channel.parameters[1].is_running);
  EXPECT_FALSE(channel.ask(SoeCommand::ReadRequest, kValue, kSVelocityCommand, false).error);
  channel.ask(SoeCommand::ReadRequest, kDataState, 99, false);
  EXPECT_EQ(7, channel.answer[4]) << "set, enabled and not finished";
}

}  // namespace
}  // namespace rung::fieldbus

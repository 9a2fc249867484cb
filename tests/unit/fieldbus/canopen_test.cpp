// SPDX-License-Identifier: Apache-2.0
// The model of CANopen against AX manual 3.4 and CiA 301.
#include "fieldbus/canopen.h"

#include <gtest/gtest.h>

#include <string.h>

namespace rung::fieldbus {
namespace {

TEST(Canopen, NetworkManagement) {
  EXPECT_EQ(NmtState::Operational, nmtAfter(NmtState::PreOperational, NmtCommand::Start));
  EXPECT_EQ(NmtState::Stopped, nmtAfter(NmtState::Operational, NmtCommand::Stop));
  EXPECT_EQ(NmtState::PreOperational, nmtAfter(NmtState::Stopped, NmtCommand::EnterPreOperational));
  EXPECT_EQ(NmtState::BootUp, nmtAfter(NmtState::Operational, NmtCommand::ResetNode));
  EXPECT_EQ(NmtState::BootUp, nmtAfter(NmtState::Stopped, NmtCommand::ResetCommunication));
  EXPECT_EQ(NmtState::BootUp, nmtAfter(NmtState::BootUp, NmtCommand::Start));
  EXPECT_TRUE(isForNode(0, 5));
  EXPECT_TRUE(isForNode(5, 5));
  EXPECT_FALSE(isForNode(6, 5));
}

TEST(Canopen, ServicesOfTheStates) {
  EXPECT_TRUE(hasSdo(NmtState::PreOperational));
  EXPECT_FALSE(hasPdo(NmtState::PreOperational));
  EXPECT_TRUE(hasPdo(NmtState::Operational));
  EXPECT_FALSE(hasSdo(NmtState::Stopped));
  EXPECT_FALSE(hasSync(NmtState::Stopped));
}

TEST(Canopen, PredefinedIdentifiers) {
  EXPECT_EQ(0x000, cobId(CanFunction::Nmt, 0));
  EXPECT_EQ(0x080, cobId(CanFunction::Sync, 0));
  EXPECT_EQ(0x085, cobId(CanFunction::Emergency, 5));
  EXPECT_EQ(0x185, cobId(CanFunction::TxPdo1, 5));
  EXPECT_EQ(0x57F, cobId(CanFunction::RxPdo4, 127));
  EXPECT_EQ(0x605, cobId(CanFunction::SdoRequest, 5));
  EXPECT_EQ(0x585, cobId(CanFunction::SdoAnswer, 5));
  EXPECT_EQ(0x705, cobId(CanFunction::NodeGuarding, 5));
}

TEST(Canopen, CyclicPdoWithEachNthSync) {
  for (int type = 1; type <= 240; ++type) {
    PdoTransmitter pdo = {};
    pdo.type = static_cast<uint8_t>(type);
    int sent = 0;
    for (int i = 1; i <= 3 * type; ++i) {
      const bool sends = transmits(pdo, {true, false, false, 0}, NmtState::Operational);
      EXPECT_EQ(i % type == 0, sends);
      sent += sends ? 1 : 0;
    }
    EXPECT_EQ(3, sent);
  }
}

TEST(Canopen, AcyclicPdoWaitsForTheNextSync) {
  PdoTransmitter pdo = {};
  EXPECT_FALSE(transmits(pdo, {true, false, false, 0}, NmtState::Operational)) << "no event";
  EXPECT_FALSE(transmits(pdo, {false, false, true, 0}, NmtState::Operational)) << "no SYNC yet";
  EXPECT_TRUE(transmits(pdo, {true, false, false, 0}, NmtState::Operational));
  EXPECT_FALSE(transmits(pdo, {true, false, false, 0}, NmtState::Operational));
}

TEST(Canopen, RemoteRequests) {
  PdoTransmitter sampled = {};
  sampled.type = 252;
  EXPECT_FALSE(transmits(sampled, {false, true, false, 0}, NmtState::Operational)) << "nothing sampled";
  EXPECT_FALSE(transmits(sampled, {true, false, false, 0}, NmtState::Operational));
  EXPECT_TRUE(transmits(sampled, {false, true, false, 0}, NmtState::Operational));
  PdoTransmitter asked = {};
  asked.type = 253;
  EXPECT_FALSE(transmits(asked, {true, false, true, 0}, NmtState::Operational));
  EXPECT_TRUE(transmits(asked, {false, true, false, 0}, NmtState::Operational));
}

TEST(Canopen, EventsWithInhibitTimeAndTimer) {
  PdoTransmitter pdo = {};
  pdo.type = 255;
  pdo.inhibit_time = 50;  // 5 ms
  pdo.event_time = 100;   // 100 ms
  EXPECT_TRUE(transmits(pdo, {false, false, true, 1000}, NmtState::Operational));
  EXPECT_FALSE(transmits(pdo, {false, false, true, 5999}, NmtState::Operational)) << "inhibited";
  EXPECT_TRUE(transmits(pdo, {false, false, false, 6000}, NmtState::Operational)) << "the event was kept";
  EXPECT_FALSE(transmits(pdo, {false, false, false, 105999}, NmtState::Operational));
  EXPECT_TRUE(transmits(pdo, {false, false, false, 106000}, NmtState::Operational)) << "event timer";
}

TEST(Canopen, OnlyAnOperationalNodeSends) {
  PdoTransmitter pdo = {};
  pdo.type = 1;
  EXPECT_FALSE(transmits(pdo, {true, false, false, 0}, NmtState::PreOperational));
  EXPECT_FALSE(transmits(pdo, {true, false, false, 0}, NmtState::Stopped));
}

TEST(Canopen, TransmissionTypes) {
  for (int type = 0; type < 256; ++type)
    EXPECT_EQ(type <= 240 || type >= 252, isTransmissionType(static_cast<uint8_t>(type)));
  EXPECT_TRUE(actsWithSync(0));
  EXPECT_TRUE(actsWithSync(240));
  EXPECT_FALSE(actsWithSync(254));
}

TEST(Canopen, HeartbeatIsLostAfterTheConsumerTime) {
  EXPECT_EQ(240, consumerTime(200));
  HeartbeatConsumer consumer = {};
  consumer.milliseconds = 240;
  watchHeartbeat(consumer, 1000);
  EXPECT_FALSE(consumer.is_lost) << "it begins with the first one";
  receiveHeartbeat(consumer, 1000);
  watchHeartbeat(consumer, 1240);
  EXPECT_FALSE(consumer.is_lost);
  watchHeartbeat(consumer, 1241);
  EXPECT_TRUE(consumer.is_lost);
  receiveHeartbeat(consumer, 1300);
  EXPECT_FALSE(consumer.is_lost);
}

TEST(Canopen, NodeGuardingTogglesAndTimesOut) {
  NodeGuard node = {kGuardTime, kLifeTimeFactor, false, 0, false, false}, master = node;
  EXPECT_EQ(0x05, answerGuard(node, NmtState::Operational, 0));
  EXPECT_TRUE(takeGuardAnswer(master, 0x05, 0));
  EXPECT_EQ(0x85, answerGuard(node, NmtState::Operational, 100));
  EXPECT_FALSE(takeGuardAnswer(master, 0x05, 100)) << "the toggle bit is wrong";
  EXPECT_TRUE(takeGuardAnswer(master, 0x85, 100));
  watchGuard(node, 1100);
  EXPECT_FALSE(node.is_lost);
  watchGuard(node, 1101);
  EXPECT_TRUE(node.is_lost);
}

// 8 bytes: 44 + 64 bits, 24 stuff bits at worst, 3 bits of gap.
TEST(Canopen, BusLoad) {
  EXPECT_EQ(135u, frameBits(8));
  EXPECT_EQ(55u, frameBits(0));
  const CanTraffic traffic[] = {{8, 0.001}, {8, 0.001}, {0, 0.001}};
  EXPECT_DOUBLE_EQ(0.325, busLoad(traffic, 3, 1000));
  EXPECT_GT(busLoad(traffic, 3, 1000), kRealTimeLoad);
  EXPECT_DOUBLE_EQ(0.65, busLoad(traffic, 3, 500));
}

// AX manual 3.4.2.
TEST(Canopen, BitRates) {
  for (const unsigned rate : {10, 20, 50, 100, 125, 250, 500, 800, 1000}) EXPECT_TRUE(isBitRate(rate));
  EXPECT_FALSE(isBitRate(400));
}

TEST(Canopen, ExpeditedSdoFrames) {
  const uint8_t upload[] = {0x40, 0x41, 0x60, 0, 0, 0, 0, 0}, download[] = {0x2B, 0x40, 0x60, 0, 0x0F, 0, 0, 0};
  EXPECT_EQ(0, memcmp(upload, uploadRequest(0x6041, 0).bytes, 8));
  EXPECT_EQ(0, memcmp(download, downloadRequest(0x6040, 0, 15, 2).bytes, 8));
}

}  // namespace
}  // namespace rung::fieldbus

// SPDX-License-Identifier: Apache-2.0
// The model of EtherCAT against the tables of the manuals: working counter, addressing, states, mailbox header.
#include "fieldbus/ethercat.h"

#include <gtest/gtest.h>

#include <string.h>

namespace rung::fieldbus {
namespace {

struct Segment {
  EcatSlave slaves[3] = {};
  uint8_t data[8] = {};

  Segment() {
    for (uint16_t i = 0; i < 3; ++i) {
      slaves[i].configured_address = static_cast<uint16_t>(1001 + i);
      slaves[i].memory[16] = static_cast<uint8_t>(10 + i);
    }
  }
  Datagram send(EcatCommand command, uint32_t address, uint16_t length = 1) {
    Datagram datagram = {command, address, data, length, 0};
    pass(datagram, slaves, 3);
    return datagram;
  }
  // Each slave maps two bytes of outputs (at 16) and two of inputs (at 32) to the same logical bytes.
  void mapLogical() {
    for (uint16_t i = 0; i < 3; ++i) {
      slaves[i].fmmus[0] = {0x1000u + 2u * i, 2, 16, false, true};
      slaves[i].fmmus[1] = {0x1000u + 2u * i, 2, 32, true, false};
      slaves[i].fmmu_count = 2;
      slaves[i].memory[32] = static_cast<uint8_t>(20 + i);
    }
  }
};

// TM/TP manual, table 2-1.
TEST(WorkingCounter, ReadAndWriteCountOneBothInOneThree) {
  Segment segment;
  EXPECT_EQ(1, segment.send(EcatCommand::FPRD, deviceAddress(1002, 16)).working_counter);
  EXPECT_EQ(11, segment.data[0]);
  EXPECT_EQ(1, segment.send(EcatCommand::FPWR, deviceAddress(1002, 16)).working_counter);
  EXPECT_EQ(3, segment.send(EcatCommand::FPRW, deviceAddress(1002, 16)).working_counter);
}

TEST(WorkingCounter, FailuresDoNotCount) {
  Segment segment;
  segment.slaves[1].read_fails = true;
  EXPECT_EQ(0, segment.send(EcatCommand::FPRD, deviceAddress(1002, 16)).working_counter);
  EXPECT_EQ(2, segment.send(EcatCommand::FPRW, deviceAddress(1002, 16)).working_counter);
  segment.slaves[1].read_fails = false;
  segment.slaves[1].write_fails = true;
  EXPECT_EQ(0, segment.send(EcatCommand::FPWR, deviceAddress(1002, 16)).working_counter);
  EXPECT_EQ(1, segment.send(EcatCommand::FPRW, deviceAddress(1002, 16)).working_counter);
  EXPECT_EQ(0, segment.send(EcatCommand::FPRD, deviceAddress(4711, 16)).working_counter) << "no slave has this address";
  EXPECT_EQ(0, segment.send(EcatCommand::FPRD, deviceAddress(1001, 60000)).working_counter) << "beyond the memory";
}

// Test T-Z6 of motion.md: three slaves, all right 9, one write failed 7.
TEST(WorkingCounter, ReadWriteThroughThreeSlaves) {
  Segment segment;
  segment.mapLogical();
  EXPECT_EQ(9, segment.send(EcatCommand::LRW, 0x1000, 6).working_counter);
  EXPECT_EQ(9, expectedCounter(EcatCommand::LRW, 3, 3));
  segment.slaves[2].write_fails = true;
  EXPECT_EQ(7, segment.send(EcatCommand::LRW, 0x1000, 6).working_counter);
  EXPECT_EQ(3, expectedCounter(EcatCommand::LRD, 3, 3));
  EXPECT_EQ(2, expectedCounter(EcatCommand::LWR, 3, 2));
}

// TM/TP manual, figures 2-7 and 2-8: 0, -1 and -2 address the slaves by their position.
TEST(Addressing, AutoIncrement) {
  for (uint16_t position = 0; position < 3; ++position) {
    Segment segment;
    const Datagram back = segment.send(EcatCommand::APRD, deviceAddress(static_cast<uint16_t>(0 - position), 16));
    EXPECT_EQ(1, back.working_counter);
    EXPECT_EQ(10 + position, segment.data[0]);
    EXPECT_EQ(3 - position, static_cast<uint16_t>(back.address)) << "each slave adds 1";
    EXPECT_EQ(16, back.address >> 16);
  }
}

TEST(Addressing, BroadcastReachesAllAndCollects) {
  Segment segment;
  EXPECT_EQ(3, segment.send(EcatCommand::BRD, deviceAddress(0, 16)).working_counter);
  EXPECT_EQ(10 | 11 | 12, segment.data[0]);
  segment.data[0] = 7;
  EXPECT_EQ(3, segment.send(EcatCommand::BWR, deviceAddress(0, 16)).working_counter);
  for (const EcatSlave& slave : segment.slaves) EXPECT_EQ(7, slave.memory[16]);
}

// The reference clock is read by position, and all others are written.
TEST(Addressing, ReadMultipleWriteSpreadsOneSlave) {
  Segment segment;
  EXPECT_EQ(3, segment.send(EcatCommand::ARMW, deviceAddress(0, 16)).working_counter);
  for (const EcatSlave& slave : segment.slaves) EXPECT_EQ(10, slave.memory[16]);
  EXPECT_EQ(3, segment.send(EcatCommand::FRMW, deviceAddress(1001, 16)).working_counter);
}

TEST(Addressing, FmmuMapsLogicalBytes) {
  Segment segment;
  segment.mapLogical();
  const uint8_t sent[] = {1, 2, 3, 4, 5, 6};
  memcpy(segment.data, sent, sizeof sent);
  segment.send(EcatCommand::LRW, 0x1000, 6);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(1 + 2 * i, segment.slaves[i].memory[16]);
    EXPECT_EQ(2 + 2 * i, segment.slaves[i].memory[17]);
    EXPECT_EQ(20 + i, segment.data[2 * i]);
  }
  EXPECT_EQ(0, segment.send(EcatCommand::LRD, 0x2000, 6).working_counter) << "no slave has these bytes";
  EXPECT_EQ(1, segment.send(EcatCommand::LRD, 0x1001, 1).working_counter) << "a part of one slave";
}

TEST(Addressing, Segments) {
  const uint8_t master[6] = {2, 0, 0, 0, 0, 1}, segment[6] = {2, 0, 0, 0, 0, 9};
  EXPECT_EQ(0xFF, directFrame(master).destination[5]);
  SegmentFrame frame = openFrame(master, segment);
  frame.source_ip = 1, frame.destination_ip = 2, frame.source_port = 3, frame.destination_port = 4;
  SegmentFrame plain = frame;
  answerInPlace(frame, true);
  EXPECT_EQ(0, memcmp(frame.destination, master, 6));
  EXPECT_EQ(0, memcmp(frame.source, segment, 6));
  EXPECT_EQ(1u, frame.destination_ip);
  EXPECT_EQ(4, frame.source_port);
  answerInPlace(plain, false);
  EXPECT_EQ(2u, plain.destination_ip);
}

// TM/TP manual 2.3, all pairs of states: upwards one step, downwards any, Boot only from and to Init.
TEST(EcatStates, LegalSteps) {
  const EcatState states[] = {EcatState::Init, EcatState::PreOp, EcatState::SafeOp, EcatState::Op, EcatState::Boot};
  const bool legal[5][5] = {{true, true, false, false, true},
                            {true, true, true, false, false},
                            {true, true, true, true, false},
                            {true, true, true, true, false},
                            {true, false, false, false, true}};
  for (int from = 0; from < 5; ++from)
    for (int to = 0; to < 5; ++to) {
      EXPECT_EQ(legal[from][to], isLegalStep(states[from], states[to])) << from << " to " << to;
      const AlStatus status = requestState({states[from], false}, static_cast<uint8_t>(states[to]));
      EXPECT_EQ(legal[from][to] ? states[to] : states[from], status.state);
      EXPECT_EQ(!legal[from][to], status.error);
    }
  EXPECT_TRUE(requestState({EcatState::Op, false}, 5).error) << "not a state";
}

TEST(EcatStates, TheWayToAnyStateHasLegalSteps) {
  const EcatState states[] = {EcatState::Init, EcatState::PreOp, EcatState::SafeOp, EcatState::Op, EcatState::Boot};
  for (const EcatState from : states)
    for (const EcatState to : states) {
      EcatState at = from;
      for (int steps = 0; at != to; ++steps) {
        ASSERT_LT(steps, 5);
        const EcatState next = nextState(at, to);
        EXPECT_TRUE(isLegalStep(at, next));
        at = next;
      }
    }
}

TEST(EcatStates, Services) {
  EXPECT_FALSE(hasMailbox(EcatState::Init));
  EXPECT_TRUE(hasMailbox(EcatState::PreOp));
  EXPECT_TRUE(hasMailbox(EcatState::Boot));
  EXPECT_FALSE(sendsInputs(EcatState::PreOp));
  EXPECT_TRUE(sendsInputs(EcatState::SafeOp));
  EXPECT_FALSE(takesOutputs(EcatState::SafeOp));
  EXPECT_TRUE(takesOutputs(EcatState::Op));
}

// TM/TP manual, table 2-2: 16, 16, 6, 2, 4 and 4 bits.
TEST(Mailbox, HeaderBits) {
  uint8_t bytes[6];
  writeHeader({0x1234, 0x5678, 0x2A, 3, MailboxType::CoE, 7}, bytes);
  const uint8_t expected[] = {0x34, 0x12, 0x78, 0x56, 0xEA, 0x73};
  EXPECT_EQ(0, memcmp(bytes, expected, 6));
  const MailboxHeader header = readHeader(bytes);
  EXPECT_EQ(0x1234, header.length);
  EXPECT_EQ(0x5678, header.address);
  EXPECT_EQ(0x2A, header.channel);
  EXPECT_EQ(3, header.priority);
  EXPECT_EQ(MailboxType::CoE, header.type);
  EXPECT_EQ(7, header.counter);
}

TEST(Mailbox, Types) {
  EXPECT_EQ(0, static_cast<int>(MailboxType::Error));
  EXPECT_EQ(2, static_cast<int>(MailboxType::EoE));
  EXPECT_EQ(3, static_cast<int>(MailboxType::CoE));
  EXPECT_EQ(4, static_cast<int>(MailboxType::FoE));
  EXPECT_EQ(5, static_cast<int>(MailboxType::SoE));
  EXPECT_EQ(15, static_cast<int>(MailboxType::VoE));
}

TEST(Mailbox, CounterRunsFromOneToSeven) {
  uint8_t counter = 0;
  for (const uint8_t expected : {1, 2, 3, 4, 5, 6, 7, 1}) EXPECT_EQ(expected, counter = nextCounter(counter));
  EXPECT_TRUE(isRepetition(3, 3));
  EXPECT_FALSE(isRepetition(3, 4));
  EXPECT_FALSE(isRepetition(0, 0));
}

}  // namespace
}  // namespace rung::fieldbus

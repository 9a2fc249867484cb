// SPDX-License-Identifier: Apache-2.0
// The model of CANopen: see canopen.h.
#include "fieldbus/canopen.h"

namespace rung::fieldbus {

NmtState nmtAfter(NmtState state, NmtCommand command) {
  // A node that has not finished its boot-up takes no command but a reset.
  if (state == NmtState::BootUp && command != NmtCommand::ResetNode && command != NmtCommand::ResetCommunication)
    return NmtState::BootUp;
  switch (command) {
    case NmtCommand::Start: return NmtState::Operational;
    case NmtCommand::Stop: return NmtState::Stopped;
    case NmtCommand::EnterPreOperational: return NmtState::PreOperational;
    case NmtCommand::ResetNode:
    case NmtCommand::ResetCommunication: return NmtState::BootUp;
  }
  return state;
}

bool isForNode(uint8_t addressed, uint8_t node) { return addressed == 0 || addressed == node; }

bool hasSdo(NmtState state) { return state == NmtState::PreOperational || state == NmtState::Operational; }
bool hasPdo(NmtState state) { return state == NmtState::Operational; }
bool hasSync(NmtState state) { return hasSdo(state); }

bool isTransmissionType(uint8_t type) { return type <= kLastCyclic || type >= kRtrSync; }

bool transmits(PdoTransmitter& pdo, const PdoTrigger& trigger, NmtState state) {
  if (!hasPdo(state)) {
    pdo.syncs = 0;
    pdo.has_event = false;
    return false;
  }
  if (trigger.event) pdo.has_event = true;
  bool sends = false;
  if (pdo.type == kAcyclic) {
    sends = trigger.sync && pdo.has_event;
  } else if (pdo.type <= kLastCyclic) {
    if (trigger.sync && ++pdo.syncs >= pdo.type) sends = true, pdo.syncs = 0;
  } else if (pdo.type == kRtrSync) {
    if (trigger.sync) pdo.is_sampled = true;
    sends = trigger.rtr && pdo.is_sampled;
  } else if (pdo.type == kRtr) {
    sends = trigger.rtr;
  } else if (pdo.type >= kEvent) {
    const uint64_t passed = trigger.now - pdo.last_sent;
    const bool is_due = pdo.event_time != 0 && pdo.was_sent && passed >= uint64_t{pdo.event_time} * 1000;
    const bool is_inhibited = pdo.was_sent && passed < uint64_t{pdo.inhibit_time} * 100;
    sends = (pdo.has_event || is_due || trigger.rtr) && !is_inhibited;
  }
  if (!sends) return false;
  pdo.has_event = false;
  pdo.was_sent = true;
  pdo.last_sent = trigger.now;
  return true;
}

bool actsWithSync(uint8_t type) { return type <= kLastCyclic; }

void receiveHeartbeat(HeartbeatConsumer& consumer, uint64_t now) {
  consumer.has_begun = true;
  consumer.is_lost = false;
  consumer.last = now;
}

void watchHeartbeat(HeartbeatConsumer& consumer, uint64_t now) {
  if (consumer.milliseconds == 0 || !consumer.has_begun) return;
  if (now - consumer.last > consumer.milliseconds) consumer.is_lost = true;
}

uint8_t answerGuard(NodeGuard& guard, NmtState state, uint64_t now) {
  const auto answer = static_cast<uint8_t>(static_cast<unsigned>(state) | (guard.toggle ? 0x80 : 0));
  guard.toggle = !guard.toggle;
  guard.has_begun = true;
  guard.is_lost = false;
  guard.last = now;
  return answer;
}

bool takeGuardAnswer(NodeGuard& guard, uint8_t answer, uint64_t now) {
  if (((answer & 0x80) != 0) != guard.toggle) return false;
  guard.toggle = !guard.toggle;
  guard.has_begun = true;
  guard.is_lost = false;
  guard.last = now;
  return true;
}

void watchGuard(NodeGuard& guard, uint64_t now) {
  const uint64_t life = uint64_t{guard.guard_milliseconds} * guard.life_time_factor;
  if (life == 0 || !guard.has_begun) return;
  if (now - guard.last > life) guard.is_lost = true;
}

uint16_t consumerTime(uint16_t producer_milliseconds) {
  const uint32_t time = uint32_t{producer_milliseconds} * 12 / 10;
  return static_cast<uint16_t>(time > UINT16_MAX ? UINT16_MAX : time);
}

// 44 bits around the data, 34 of which and the data may be stuffed, one bit after each four; and 3 bits between frames.
unsigned frameBits(unsigned data_bytes) { return 44 + 8 * data_bytes + (34 + 8 * data_bytes - 1) / 4 + 3; }

bool isBitRate(unsigned kilobits_per_second) {
  constexpr unsigned kRates[] = {10, 20, 50, 100, 125, 250, 500, 800, 1000};
  for (const unsigned rate : kRates)
    if (rate == kilobits_per_second) return true;
  return false;
}

double busLoad(const CanTraffic* traffic, size_t count, unsigned kilobits_per_second) {
  double bits_per_second = 0;
  for (size_t i = 0; i < count; ++i)
    if (traffic[i].period > 0) bits_per_second += frameBits(traffic[i].data_bytes) / traffic[i].period;
  return bits_per_second / (kilobits_per_second * 1000.0);
}

SdoFrame uploadRequest(uint16_t index, uint8_t subindex) {
  return {{0x40, static_cast<uint8_t>(index), static_cast<uint8_t>(index >> 8), subindex, 0, 0, 0, 0}};
}

SdoFrame downloadRequest(uint16_t index, uint8_t subindex, uint32_t value, unsigned bytes) {
  SdoFrame frame = uploadRequest(index, subindex);
  frame.bytes[0] = static_cast<uint8_t>(0x23 | (4 - bytes) << 2);
  for (unsigned i = 0; i < 4; ++i) frame.bytes[4 + i] = static_cast<uint8_t>(value >> 8 * i);
  return frame;
}

}  // namespace rung::fieldbus

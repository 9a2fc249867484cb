// SPDX-License-Identifier: Apache-2.0
// CANopen as a model, without frames on a wire: network management, the transmission of PDOs, heartbeat and node
// guarding, the identifiers of the messages, and the load of the bus. In and out: plain values.
// AX manual 3.4 and B.3; CiA 301.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace rung::fieldbus {

constexpr unsigned kMaxNode = 127;

// The states of a node, as a heartbeat tells them.
enum class NmtState : uint8_t { BootUp = 0, Stopped = 4, Operational = 5, PreOperational = 127 };
enum class NmtCommand : uint8_t {
  Start = 1,
  Stop = 2,
  EnterPreOperational = 128,
  ResetNode = 129,
  ResetCommunication = 130
};

// A command goes to one node, or with node 0 to all.
NmtState nmtAfter(NmtState state, NmtCommand command);
bool isForNode(uint8_t addressed, uint8_t node);

// Which services a state has.
bool hasSdo(NmtState state);   // PreOperational and Operational
bool hasPdo(NmtState state);   // Operational
bool hasSync(NmtState state);  // PreOperational and Operational

// The predefined identifiers of messages.
enum class CanFunction : uint16_t {
  Nmt = 0x000,
  Sync = 0x080,
  Emergency = 0x080,
  TimeStamp = 0x100,
  TxPdo1 = 0x180,
  RxPdo1 = 0x200,
  TxPdo2 = 0x280,
  RxPdo2 = 0x300,
  TxPdo3 = 0x380,
  RxPdo3 = 0x400,
  TxPdo4 = 0x480,
  RxPdo4 = 0x500,
  SdoAnswer = 0x580,
  SdoRequest = 0x600,
  NodeGuarding = 0x700
};
constexpr uint16_t cobId(CanFunction function, uint8_t node) {
  return static_cast<uint16_t>(static_cast<uint16_t>(function) + node);
}

// The transmission type of a PDO: 0 after an event, with the next SYNC; 1 to 240 with each n-th SYNC; 252 sampled with
// SYNC and sent when asked for by RTR; 253 when asked for by RTR; 254 and 255 at an event.
enum PdoTransmission : uint8_t {
  kAcyclic = 0,
  kLastCyclic = 240,
  kRtrSync = 252,
  kRtr = 253,
  kEvent = 254,
  kProfileEvent = 255
};
bool isTransmissionType(uint8_t type);

// When a transmit PDO is sent. Times are in 100 µs (inhibit time) and ms (event timer), as the objects 1800h have them.
struct PdoTransmitter {
  uint8_t type;
  uint16_t inhibit_time, event_time;
  // State.
  uint8_t syncs;
  bool has_event, is_sampled;
  uint64_t last_sent;  // in µs
  bool was_sent;
};
struct PdoTrigger {
  bool sync, rtr, event;
  uint64_t now;  // µs
};
// True: the PDO is sent now.
bool transmits(PdoTransmitter& pdo, const PdoTrigger& trigger, NmtState state);

// A receive PDO of the types 0 to 240 acts with the next SYNC, the others at once.
bool actsWithSync(uint8_t type);

// A consumer of the heartbeat of another node: it is lost when none came for its time (object 1016h).
struct HeartbeatConsumer {
  uint16_t milliseconds;  // 0: not watched
  uint64_t last;          // ms
  bool has_begun, is_lost;
};
void receiveHeartbeat(HeartbeatConsumer& consumer, uint64_t now);
void watchHeartbeat(HeartbeatConsumer& consumer, uint64_t now);

// Node guarding: the master asks by RTR every guard time, the node answers with its state and a bit that toggles. Each
// of them finds the other lost after guard time times life time factor.
struct NodeGuard {
  uint16_t guard_milliseconds;
  uint8_t life_time_factor;
  bool toggle;
  uint64_t last;  // ms
  bool has_begun, is_lost;
};
uint8_t answerGuard(NodeGuard& guard, NmtState state, uint64_t now);   // in the node
bool takeGuardAnswer(NodeGuard& guard, uint8_t answer, uint64_t now);  // in the master; false: the toggle bit is wrong
void watchGuard(NodeGuard& guard, uint64_t now);

// The AX master sets this up in its slaves: consumers that wait 1.2 times the producer time, or node guarding with life
// time factor 10 and 100 ms.
uint16_t consumerTime(uint16_t producer_milliseconds);
constexpr uint16_t kGuardTime = 100;
constexpr uint8_t kLifeTimeFactor = 10;

// The bits of a data frame with the most stuff bits, and the gap after it.
unsigned frameBits(unsigned data_bytes);
bool isBitRate(unsigned kilobits_per_second);

struct CanTraffic {
  unsigned data_bytes;
  double period;  // s
};
// The part of the time that the bus is busy, 0 to 1 and above.
double busLoad(const CanTraffic* traffic, size_t count, unsigned kilobits_per_second);
constexpr double kRealTimeLoad = 0.3;

// SDO: an expedited transfer in the 8 bytes of a frame.
struct SdoFrame {
  uint8_t bytes[8];
};
SdoFrame uploadRequest(uint16_t index, uint8_t subindex);
SdoFrame downloadRequest(uint16_t index, uint8_t subindex, uint32_t value, unsigned bytes);

}  // namespace rung::fieldbus

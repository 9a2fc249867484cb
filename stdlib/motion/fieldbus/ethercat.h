// SPDX-License-Identifier: Apache-2.0
// EtherCAT as a model, without frames on a wire: what a datagram does in a segment of slaves (addressing, working
// counter, FMMU), the state machine of a slave, its distributed clock, and the header of a mailbox. In and out: plain
// values. The simulated drive uses the state machine and the mailbox; products that test a master use the rest.
// TM/TP manual 2.1 to 2.3; AX manual 7.1 to 7.3; IEC 61158-4-12, ETG.1000.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace rung::fieldbus {

// The state machine. The numbers are those of the registers AL control and AL status.
enum class EcatState : uint8_t { Init = 1, PreOp = 2, Boot = 3, SafeOp = 4, Op = 8 };

bool isState(uint8_t number);

// Upwards one step at a time, downwards any; Boot only from and to Init.
bool isLegalStep(EcatState from, EcatState to);

struct AlStatus {
  EcatState state;
  bool error;  // the last request was refused
};

// The answer of a slave to a request for a state: a refused one leaves the state and raises the error flag.
AlStatus requestState(AlStatus now, uint8_t requested);

// The next state on the way to another.
EcatState nextState(EcatState from, EcatState to);

bool hasMailbox(EcatState state);    // PreOp and above, and Boot
bool sendsInputs(EcatState state);   // SafeOp and Op
bool takesOutputs(EcatState state);  // Op

// The header of a mailbox: 16 bits length, 16 bits address, 6 bits channel, 2 bits priority, 4 bits type, 4 bits
// counter.
enum class MailboxType : uint8_t { Error = 0, EoE = 2, CoE = 3, FoE = 4, SoE = 5, VoE = 15 };
struct MailboxHeader {
  uint16_t length, address;
  uint8_t channel, priority;
  MailboxType type;
  uint8_t counter;  // 1 to 7
};
constexpr size_t kMailboxHeaderBytes = 6;

void writeHeader(const MailboxHeader& header, uint8_t* bytes);
MailboxHeader readHeader(const uint8_t* bytes);

// The counter of the next service: 1 to 7, then 1 again.
uint8_t nextCounter(uint8_t counter);

// A mailbox that already has this counter is a repetition: the slave does not carry it out again. 0 is never one.
bool isRepetition(uint8_t last, uint8_t counter);

// The addresses of a datagram, by its command. The first letter is the way of addressing: auto-increment (position),
// configured (fixed), broadcast, logical; then read, write, read and write, or read and multiple write.
enum class EcatCommand : uint8_t { Nop, APRD, APWR, APRW, FPRD, FPWR, FPRW, BRD, BWR, BRW, LRD, LWR, LRW, ARMW, FRMW };

// A fieldbus memory management unit: maps bytes of a slave's memory to the logical address space.
struct Fmmu {
  uint32_t logical;    // first byte
  uint16_t length;     // bytes
  uint16_t physical;   // first byte in the slave's memory
  bool reads, writes;  // which commands it answers
};

constexpr size_t kFmmus = 4;
constexpr size_t kSlaveBytes = 256;

struct EcatSlave {
  uint16_t configured_address;
  uint8_t memory[kSlaveBytes];
  Fmmu fmmus[kFmmus];
  size_t fmmu_count;
  bool read_fails, write_fails;  // injected: the slave's memory refuses the access
};

struct Datagram {
  EcatCommand command;
  uint32_t address;  // 16 bits of the device and 16 of its memory, or 32 logical ones
  uint8_t* data;
  uint16_t length;
  uint16_t working_counter;
};

constexpr uint32_t deviceAddress(uint16_t device, uint16_t offset) { return uint32_t{offset} << 16 | device; }

// Sends a datagram through a segment. Each slave adds 1 to a device address of auto-increment and broadcast commands,
// and to the working counter what it has done: 1 for a read or a write; for both in one, 1 for the read and 2 for the
// write. The slave with auto-increment address 0 is meant.
void pass(Datagram& datagram, EcatSlave* slaves, size_t count);

// The working counter when all slaves do their part.
uint16_t expectedCounter(EcatCommand command, size_t reading, size_t writing);

// How a frame addresses a segment. Direct: the segment is alone on the port, and the frame goes to all. Open: it is
// connected to a switch, and the first slave has the address of the segment; it swaps source and destination in the
// answer.
struct SegmentFrame {
  uint8_t destination[6], source[6];
  uint32_t destination_ip, source_ip;
  uint16_t destination_port, source_port;
};
SegmentFrame directFrame(const uint8_t* master);
SegmentFrame openFrame(const uint8_t* master, const uint8_t* segment);
void answerInPlace(SegmentFrame& frame, bool has_udp);

}  // namespace rung::fieldbus

// SPDX-License-Identifier: Apache-2.0
// The model of EtherCAT: see ethercat.h.
#include "fieldbus/ethercat.h"

#include <string.h>

namespace rung::fieldbus {
namespace {

struct Access {
  bool reads, writes;
};

Access accessOf(EcatCommand command) {
  switch (command) {
    case EcatCommand::Nop: return {false, false};
    case EcatCommand::APRD:
    case EcatCommand::FPRD:
    case EcatCommand::BRD:
    case EcatCommand::LRD: return {true, false};
    case EcatCommand::APWR:
    case EcatCommand::FPWR:
    case EcatCommand::BWR:
    case EcatCommand::LWR: return {false, true};
    case EcatCommand::APRW:
    case EcatCommand::FPRW:
    case EcatCommand::BRW:
    case EcatCommand::LRW: return {true, true};
    case EcatCommand::ARMW:
    case EcatCommand::FRMW: return {true, true};
  }
  return {false, false};
}

// Read and write in one: 1 for the read, 2 for the write.
uint16_t counted(Access access, bool has_read, bool has_written) {
  const uint16_t of_write = access.reads && access.writes ? 2 : 1;
  return static_cast<uint16_t>((has_read ? 1 : 0) + (has_written ? of_write : 0));
}

// Old data goes to the datagram, new data from it: as if at the same instant. A broadcast read collects with OR.
uint16_t exchange(EcatSlave& slave, Access access, Access kind, uint16_t physical, uint8_t* data, size_t length,
                  bool collects) {
  if (physical + length > kSlaveBytes) return 0;
  const bool reads = access.reads && !slave.read_fails, writes = access.writes && !slave.write_fails;
  for (size_t i = 0; i < length; ++i) {
    const uint8_t sent = data[i], kept = slave.memory[physical + i];
    if (reads) data[i] = collects ? static_cast<uint8_t>(sent | kept) : kept;
    if (writes) slave.memory[physical + i] = sent;
  }
  return counted(kind, reads, writes);
}

// The bytes that one FMMU shares with the datagram.
uint16_t exchangeLogical(EcatSlave& slave, Datagram& datagram, Access access) {
  bool has_read = false, has_written = false;
  for (size_t i = 0; i < slave.fmmu_count; ++i) {
    const Fmmu& fmmu = slave.fmmus[i];
    const Access here = {access.reads && fmmu.reads, access.writes && fmmu.writes};
    const uint64_t begin = fmmu.logical > datagram.address ? fmmu.logical : datagram.address;
    const uint64_t of_fmmu = uint64_t{fmmu.logical} + fmmu.length,
                   of_data = uint64_t{datagram.address} + datagram.length;
    const uint64_t end = of_fmmu < of_data ? of_fmmu : of_data;
    if (begin >= end || (!here.reads && !here.writes)) continue;
    const auto physical = static_cast<uint16_t>(fmmu.physical + (begin - fmmu.logical));
    if (physical + (end - begin) > kSlaveBytes) continue;
    has_read = has_read || (here.reads && !slave.read_fails);
    has_written = has_written || (here.writes && !slave.write_fails);
    exchange(slave, here, access, physical, datagram.data + (begin - datagram.address), end - begin, false);
  }
  return counted(access, has_read, has_written);
}

uint16_t deviceOf(const Datagram& datagram) { return static_cast<uint16_t>(datagram.address); }
uint16_t offsetOf(const Datagram& datagram) { return static_cast<uint16_t>(datagram.address >> 16); }

void incrementDevice(Datagram& datagram) {
  datagram.address = deviceAddress(static_cast<uint16_t>(deviceOf(datagram) + 1), offsetOf(datagram));
}

uint16_t exchangeDevice(EcatSlave& slave, Datagram& datagram, Access access, bool collects) {
  return exchange(slave, access, access, offsetOf(datagram), datagram.data, datagram.length, collects);
}

// The addressed slave reads into the datagram, all others write what it holds.
uint16_t exchangeMultiple(EcatSlave& slave, Datagram& datagram, bool is_addressed) {
  const Access access = {is_addressed, !is_addressed};
  return exchange(slave, access, access, offsetOf(datagram), datagram.data, datagram.length, false);
}

uint16_t visit(EcatSlave& slave, Datagram& datagram) {
  const Access access = accessOf(datagram.command);
  switch (datagram.command) {
    case EcatCommand::Nop: return 0;
    case EcatCommand::APRD:
    case EcatCommand::APWR:
    case EcatCommand::APRW:
      return deviceOf(datagram) == 0 ? exchangeDevice(slave, datagram, access, false) : uint16_t{0};
    case EcatCommand::FPRD:
    case EcatCommand::FPWR:
    case EcatCommand::FPRW:
      return deviceOf(datagram) == slave.configured_address ? exchangeDevice(slave, datagram, access, false)
                                                            : uint16_t{0};
    case EcatCommand::BRD:
    case EcatCommand::BWR:
    case EcatCommand::BRW: return exchangeDevice(slave, datagram, access, true);
    case EcatCommand::LRD:
    case EcatCommand::LWR:
    case EcatCommand::LRW: return exchangeLogical(slave, datagram, access);
    case EcatCommand::ARMW: return exchangeMultiple(slave, datagram, deviceOf(datagram) == 0);
    case EcatCommand::FRMW: return exchangeMultiple(slave, datagram, deviceOf(datagram) == slave.configured_address);
  }
  return 0;
}

bool countsPosition(EcatCommand command) {
  return (command >= EcatCommand::APRD && command <= EcatCommand::APRW) || command == EcatCommand::ARMW ||
         (command >= EcatCommand::BRD && command <= EcatCommand::BRW);
}

// The order of the states upwards.
int levelOf(EcatState state) {
  switch (state) {
    case EcatState::Init:
    case EcatState::Boot: return 0;
    case EcatState::PreOp: return 1;
    case EcatState::SafeOp: return 2;
    case EcatState::Op: return 3;
  }
  return 0;
}

template <class T>
void swapValues(T& a, T& b) {
  const T kept = a;
  a = b;
  b = kept;
}

}  // namespace

bool isState(uint8_t number) { return (number >= 1 && number <= 4) || number == 8; }

bool isLegalStep(EcatState from, EcatState to) {
  if (from == to) return true;
  if (from == EcatState::Boot || to == EcatState::Boot) return from == EcatState::Init || to == EcatState::Init;
  return levelOf(to) <= levelOf(from) + 1;
}

AlStatus requestState(AlStatus now, uint8_t requested) {
  if (!isState(requested) || !isLegalStep(now.state, static_cast<EcatState>(requested))) return {now.state, true};
  return {static_cast<EcatState>(requested), false};
}

EcatState nextState(EcatState from, EcatState to) {
  if (isLegalStep(from, to)) return to;
  if (from == EcatState::Boot || to == EcatState::Boot) return EcatState::Init;
  return from == EcatState::Init ? EcatState::PreOp : EcatState::SafeOp;
}

bool hasMailbox(EcatState state) { return state != EcatState::Init; }
bool sendsInputs(EcatState state) { return state == EcatState::SafeOp || state == EcatState::Op; }
bool takesOutputs(EcatState state) { return state == EcatState::Op; }

void writeHeader(const MailboxHeader& header, uint8_t* bytes) {
  bytes[0] = static_cast<uint8_t>(header.length);
  bytes[1] = static_cast<uint8_t>(header.length >> 8);
  bytes[2] = static_cast<uint8_t>(header.address);
  bytes[3] = static_cast<uint8_t>(header.address >> 8);
  bytes[4] = static_cast<uint8_t>((header.channel & 0x3F) | header.priority << 6);
  bytes[5] = static_cast<uint8_t>((static_cast<unsigned>(header.type) & 0x0F) | header.counter << 4);
}

MailboxHeader readHeader(const uint8_t* bytes) {
  MailboxHeader header = {};
  header.length = static_cast<uint16_t>(bytes[0] | bytes[1] << 8);
  header.address = static_cast<uint16_t>(bytes[2] | bytes[3] << 8);
  header.channel = bytes[4] & 0x3F;
  header.priority = bytes[4] >> 6;
  header.type = static_cast<MailboxType>(bytes[5] & 0x0F);
  header.counter = bytes[5] >> 4;
  return header;
}

uint8_t nextCounter(uint8_t counter) { return counter >= 7 ? 1 : static_cast<uint8_t>(counter + 1); }

bool isRepetition(uint8_t last, uint8_t counter) { return counter != 0 && counter == last; }

void pass(Datagram& datagram, EcatSlave* slaves, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    datagram.working_counter = static_cast<uint16_t>(datagram.working_counter + visit(slaves[i], datagram));
    if (countsPosition(datagram.command)) incrementDevice(datagram);
  }
}

uint16_t expectedCounter(EcatCommand command, size_t reading, size_t writing) {
  const Access access = accessOf(command);
  const bool is_multiple = command == EcatCommand::ARMW || command == EcatCommand::FRMW;
  const size_t of_write = access.reads && access.writes && !is_multiple ? 2 : 1;
  return static_cast<uint16_t>((access.reads ? reading : 0) + (access.writes ? of_write * writing : 0));
}

SegmentFrame directFrame(const uint8_t* master) {
  SegmentFrame frame = {};
  memset(frame.destination, 0xFF, sizeof frame.destination);
  memcpy(frame.source, master, sizeof frame.source);
  return frame;
}

SegmentFrame openFrame(const uint8_t* master, const uint8_t* segment) {
  SegmentFrame frame = {};
  memcpy(frame.destination, segment, sizeof frame.destination);
  memcpy(frame.source, master, sizeof frame.source);
  return frame;
}

void answerInPlace(SegmentFrame& frame, bool has_udp) {
  for (size_t i = 0; i < sizeof frame.source; ++i) swapValues(frame.destination[i], frame.source[i]);
  if (!has_udp) return;
  swapValues(frame.destination_ip, frame.source_ip);
  swapValues(frame.destination_port, frame.source_port);
}

}  // namespace rung::fieldbus

// SPDX-License-Identifier: Apache-2.0
// Answers of a Modbus server: see rung/modbus.h. MODBUS Application Protocol 1.1b3, MODBUS over Serial Line 1.02,
// MODBUS Messaging on TCP/IP 1.0b.
#include "rung/modbus.h"

#include <string.h>

namespace {

enum Function : uint8_t {
  kReadCoils = 1,
  kReadInputs = 2,
  kReadRegisters = 3,
  kReadInputRegisters = 4,
  kWriteCoil = 5,
  kWriteRegister = 6,
  kWriteCoils = 15,
  kWriteRegisters = 16
};

constexpr uint32_t kBits = 4096, kWords = 512;  // of I and Q
constexpr uint32_t kMemoryBits = 60528, kMemoryWords = 8193;
constexpr uint32_t kMaxReadBits = 2000, kMaxReadWords = 125, kMaxWriteBits = 1968, kMaxWriteWords = 123;
constexpr uint32_t kHeaderBytes = 7;  // of a frame over TCP, in front of the data unit

uint32_t wordAt(const uint8_t* bytes) { return static_cast<uint32_t>(bytes[0] << 8 | bytes[1]); }
void putWord(uint8_t* bytes, uint32_t value) {
  bytes[0] = static_cast<uint8_t>(value >> 8);
  bytes[1] = static_cast<uint8_t>(value);
}

// A request with its reply under construction.
struct Exchange {
  const rung_modbus_image& image;
  const uint8_t* request;
  uint32_t size;
  uint8_t* reply;

  uint32_t refuse(uint8_t exception) const {
    reply[0] = static_cast<uint8_t>(request[0] | 0x80);
    reply[1] = exception;
    return 2;
  }
  uint32_t echo() const {
    memcpy(reply, request, 5);
    return 5;
  }
};

// Which part of the image a range of addresses is; null: none, or two.
const rung_modbus_area* findPart(const rung_modbus_image& image, uint32_t& first, uint32_t count, uint32_t outputs,
                                 uint32_t memory) {
  if (first + count <= outputs) return &image.outputs;
  if (first < RUNG_MODBUS_MEMORY_OFFSET || first + count > RUNG_MODBUS_MEMORY_OFFSET + memory) return nullptr;
  first -= RUNG_MODBUS_MEMORY_OFFSET;
  return &image.memory;
}

bool bitAt(const uint8_t* bytes, uint32_t bit) { return (bytes[bit / 8] >> bit % 8 & 1) != 0; }

void setBit(const rung_modbus_area& area, uint32_t bit, bool value) {
  const auto mask = static_cast<uint8_t>(1 << bit % 8);
  uint8_t& byte = area.bytes[bit / 8];
  byte = static_cast<uint8_t>(value ? byte | mask : byte & ~mask);
  area.written[bit / 8] |= mask;
}

void setWord(const rung_modbus_area& area, uint32_t word, uint32_t value) {
  area.bytes[word * 2] = static_cast<uint8_t>(value);
  area.bytes[word * 2 + 1] = static_cast<uint8_t>(value >> 8);
  area.written[word * 2] = area.written[word * 2 + 1] = 0xff;
}

uint32_t readBits(const Exchange& call) {
  if (call.size != 5) return call.refuse(RUNG_MODBUS_ILLEGAL_VALUE);
  uint32_t first = wordAt(call.request + 1);
  const uint32_t count = wordAt(call.request + 3);
  if (count == 0 || count > kMaxReadBits) return call.refuse(RUNG_MODBUS_ILLEGAL_VALUE);
  const rung_modbus_area* part = &call.image.inputs;
  if (call.request[0] == kReadCoils)
    part = findPart(call.image, first, count, kBits, kMemoryBits);
  else if (first + count > kBits)
    part = nullptr;
  if (part == nullptr) return call.refuse(RUNG_MODBUS_ILLEGAL_ADDRESS);
  const uint32_t bytes = (count + 7) / 8;
  call.reply[0] = call.request[0];
  call.reply[1] = static_cast<uint8_t>(bytes);
  memset(call.reply + 2, 0, bytes);
  for (uint32_t i = 0; i < count; ++i)
    if (bitAt(part->bytes, first + i)) call.reply[2 + i / 8] |= static_cast<uint8_t>(1 << i % 8);
  return 2 + bytes;
}

uint32_t readWords(const Exchange& call) {
  if (call.size != 5) return call.refuse(RUNG_MODBUS_ILLEGAL_VALUE);
  uint32_t first = wordAt(call.request + 1);
  const uint32_t count = wordAt(call.request + 3);
  if (count == 0 || count > kMaxReadWords) return call.refuse(RUNG_MODBUS_ILLEGAL_VALUE);
  const rung_modbus_area* part = &call.image.inputs;
  if (call.request[0] == kReadRegisters)
    part = findPart(call.image, first, count, kWords, kMemoryWords);
  else if (first + count > kWords)
    part = nullptr;
  if (part == nullptr) return call.refuse(RUNG_MODBUS_ILLEGAL_ADDRESS);
  const uint32_t given = part == &call.image.outputs && call.image.registers != nullptr ? call.image.register_count : 0;
  call.reply[0] = call.request[0];
  call.reply[1] = static_cast<uint8_t>(count * 2);
  for (uint32_t i = 0; i < count; ++i) {
    const uint8_t* const from = (first + i < given ? call.image.registers : part->bytes) + (first + i) * 2;
    call.reply[2 + i * 2] = from[1];
    call.reply[3 + i * 2] = from[0];
  }
  return 2 + count * 2;
}

uint32_t writeOne(const Exchange& call) {
  if (call.size != 5) return call.refuse(RUNG_MODBUS_ILLEGAL_VALUE);
  const bool is_coil = call.request[0] == kWriteCoil;
  uint32_t first = wordAt(call.request + 1);
  const uint32_t value = wordAt(call.request + 3);
  if (is_coil && value != 0 && value != 0xff00) return call.refuse(RUNG_MODBUS_ILLEGAL_VALUE);
  const rung_modbus_area* const part =
      findPart(call.image, first, 1, is_coil ? kBits : kWords, is_coil ? kMemoryBits : kMemoryWords);
  if (part == nullptr) return call.refuse(RUNG_MODBUS_ILLEGAL_ADDRESS);
  if (is_coil)
    setBit(*part, first, value != 0);
  else
    setWord(*part, first, value);
  return call.echo();
}

uint32_t writeMany(const Exchange& call) {
  const bool are_coils = call.request[0] == kWriteCoils;
  if (call.size < 6) return call.refuse(RUNG_MODBUS_ILLEGAL_VALUE);
  uint32_t first = wordAt(call.request + 1);
  const uint32_t count = wordAt(call.request + 3), bytes = are_coils ? (count + 7) / 8 : count * 2;
  if (count == 0 || count > (are_coils ? kMaxWriteBits : kMaxWriteWords) || call.request[5] != bytes ||
      call.size != 6 + bytes)
    return call.refuse(RUNG_MODBUS_ILLEGAL_VALUE);
  const rung_modbus_area* const part =
      findPart(call.image, first, count, are_coils ? kBits : kWords, are_coils ? kMemoryBits : kMemoryWords);
  if (part == nullptr) return call.refuse(RUNG_MODBUS_ILLEGAL_ADDRESS);
  for (uint32_t i = 0; i < count; ++i) {
    if (are_coils)
      setBit(*part, first + i, bitAt(call.request + 6, i));
    else
      setWord(*part, first + i, wordAt(call.request + 6 + i * 2));
  }
  return call.echo();
}

}  // namespace

extern "C" {

uint32_t rung_modbus_answer(const rung_modbus_image* image, const uint8_t* request, uint32_t size, uint8_t* reply) {
  if (size == 0) return 0;
  const Exchange call{*image, request, size, reply};
  switch (request[0]) {
    case kReadCoils:
    case kReadInputs: return readBits(call);
    case kReadRegisters:
    case kReadInputRegisters: return readWords(call);
    case kWriteCoil:
    case kWriteRegister: return writeOne(call);
    case kWriteCoils:
    case kWriteRegisters: return writeMany(call);
    default: return call.refuse(RUNG_MODBUS_ILLEGAL_FUNCTION);
  }
}

uint16_t rung_modbus_crc(const uint8_t* bytes, size_t count) {
  uint32_t crc = 0xffff;
  for (size_t i = 0; i < count; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xa001 : crc >> 1;
  }
  return static_cast<uint16_t>(crc);
}

int32_t rung_modbus_tcp_frame(const uint8_t* bytes, size_t count) {
  if (count >= 4 && (bytes[2] != 0 || bytes[3] != 0)) return -1;  // another protocol
  if (count < 6) return 0;
  const uint32_t rest = wordAt(bytes + 4);  // the unit's number and the data unit
  if (rest < 2 || rest > RUNG_MODBUS_MAX_UNIT + 1) return -1;
  return count < 6 + rest ? 0 : static_cast<int32_t>(6 + rest);
}

int32_t rung_modbus_rtu_request(const uint8_t* bytes, size_t count) {
  if (count < 2) return 0;
  size_t size = 8;
  if (bytes[1] == kWriteCoils || bytes[1] == kWriteRegisters) {
    if (count < 7) return 0;
    size = 9u + bytes[6];
  } else if (bytes[1] > kWriteRegister || bytes[1] == 0) {
    size = count;  // of unknown length: the silence after it ends it
  }
  if (size > RUNG_MODBUS_MAX_RTU) return -1;
  if (count < size || size < 4) return 0;
  const uint32_t crc = rung_modbus_crc(bytes, size - 2);
  return bytes[size - 2] == (crc & 0xff) && bytes[size - 1] == crc >> 8 ? static_cast<int32_t>(size) : -1;
}

uint32_t rung_modbus_answer_tcp(const rung_modbus_image* image, uint8_t unit, const uint8_t* frame, uint8_t* reply) {
  const uint32_t size = wordAt(frame + 4) - 1;
  const uint8_t* const request = frame + kHeaderBytes;
  // 0 and 255 name the device at this address, whatever its unit.
  const bool is_meant = frame[6] == unit || frame[6] == 0 || frame[6] == 255;
  const Exchange call{*image, request, size, reply + kHeaderBytes};
  const uint32_t answered =
      is_meant ? rung_modbus_answer(image, request, size, reply + kHeaderBytes) : call.refuse(RUNG_MODBUS_NO_TARGET);
  memcpy(reply, frame, kHeaderBytes);
  putWord(reply + 4, answered + 1);
  return kHeaderBytes + answered;
}

uint32_t rung_modbus_answer_rtu(const rung_modbus_image* image, uint8_t unit, const uint8_t* frame, uint32_t size,
                                uint8_t* reply) {
  const bool is_for_all = frame[0] == 0;  // a broadcast is obeyed in silence
  if (frame[0] != unit && !is_for_all) return 0;
  const uint32_t answered = rung_modbus_answer(image, frame + 1, size - 3, reply + 1);
  if (is_for_all || answered == 0) return 0;
  reply[0] = unit;
  const uint32_t crc = rung_modbus_crc(reply, answered + 1);
  reply[answered + 1] = static_cast<uint8_t>(crc);
  reply[answered + 2] = static_cast<uint8_t>(crc >> 8);
  return answered + 3;
}

}  // extern "C"

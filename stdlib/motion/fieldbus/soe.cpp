// SPDX-License-Identifier: Apache-2.0
// Sercos over EtherCAT: see soe.h.
#include "fieldbus/soe.h"

#include <string.h>

namespace rung::fieldbus {
namespace {

constexpr uint16_t kDeleted[] = {3, 4, 5, 9, 10, 88, 90, 127, 128};
constexpr uint16_t kRedefined[] = {kSAtWriteTime, kSInterfaceStatus, kSLossCounter, kSMdtReadTime};
constexpr int32_t kStartProcedure = 3;  // set and enabled

bool isIn(const uint16_t* list, size_t count, uint16_t code) {
  for (size_t i = 0; i < count; ++i)
    if (list[i] == code) return true;
  return false;
}

// TM/TP manual, table 2-14.
constexpr Telegram kTelegrams[] = {
    {{}, {}, 0, 0},
    {{kSTorqueCommand}, {}, 1, 0},
    {{kSVelocityCommand}, {kSVelocityFeedback}, 1, 1},
    {{kSVelocityCommand}, {kSPositionFeedback}, 1, 1},
    {{kSPositionCommand}, {kSVelocityFeedback}, 1, 1},
    {{kSPositionCommand, kSVelocityCommand}, {kSPositionFeedback}, 2, 1},
    {{kSVelocityCommand}, {}, 1, 0},
};

bool takeList(const uint16_t* words, size_t count, uint16_t* idns, uint8_t* idn_count) {
  if (count < 2 || words[1] > words[0] || words[1] > 4 || count < 2u + words[1]) return false;
  for (size_t i = 0; i < words[1]; ++i) idns[i] = words[2 + i];
  *idn_count = static_cast<uint8_t>(words[1]);
  return true;
}

void put(uint8_t* bytes, uint32_t value, size_t count) {
  for (size_t i = 0; i < count; ++i) bytes[i] = static_cast<uint8_t>(value >> 8 * i);
}

SoeParameter* find(SoeParameter* parameters, size_t count, uint16_t idn) {
  for (size_t i = 0; i < count; ++i)
    if (parameters[i].idn == idn) return &parameters[i];
  return nullptr;
}

// A text is preceded by its actual and its greatest length.
size_t putText(const char* text, uint8_t* bytes, size_t room) {
  const size_t length = strlen(text);
  if (length + 4 > room) return 0;
  put(bytes, static_cast<uint32_t>(length), 2);
  put(bytes + 2, static_cast<uint32_t>(length), 2);
  memcpy(bytes + 4, text, length);  // NOLINT(bugprone-not-null-terminated-result): its length is in front of it
  return length + 4;
}

size_t putNumber(int32_t value, size_t count, uint8_t* bytes, size_t room) {
  if (count > room) return 0;
  put(bytes, static_cast<uint32_t>(value), count);
  return count;
}

// 0: it does not fit.
size_t putElement(const SoeParameter& parameter, unsigned element, uint8_t* bytes, size_t room) {
  switch (element) {
    case kDataState: return putNumber(parameter.is_running ? 7 : 0, 2, bytes, room);
    case kName: return putText(parameter.name, bytes, room);
    case kAttribute: return putNumber(static_cast<int32_t>(parameter.attribute), 4, bytes, room);
    case kUnit: return putText(parameter.unit, bytes, room);
    case kMinimum: return putNumber(parameter.minimum, parameter.bytes, bytes, room);
    case kMaximum: return putNumber(parameter.maximum, parameter.bytes, bytes, room);
    case kValue: return putNumber(parameter.value, parameter.bytes, bytes, room);
    default: return 0;
  }
}

size_t refuse(SoeHeader header, SoeError error, uint8_t* answer) {
  header.error = true;
  writeSoeHeader(header, answer);
  put(answer + kSoeHeaderBytes, error, 2);
  return kSoeHeaderBytes + 2;
}

size_t read(const SoeParameter& parameter, SoeHeader header, bool is_single, uint8_t* answer, size_t capacity) {
  const unsigned asked = header.elements & 0x7F;
  size_t size = kSoeHeaderBytes;
  unsigned answered = 0;
  for (unsigned element = 1; element <= kValue; element <<= 1) {
    if ((asked & element) == 0) continue;
    const size_t more = putElement(parameter, element, answer + size, capacity - size);
    if (more == 0) return refuse(header, kSoeTooLong, answer);
    size += more;
    answered |= element;
    if (is_single) break;
  }
  if (answered == 0) return refuse(header, kSoeNoElement, answer);
  header.elements = static_cast<uint8_t>(answered);
  writeSoeHeader(header, answer);
  return size;
}

size_t write(SoeParameter& parameter, SoeHeader header, const uint8_t* data, size_t size, uint8_t* answer) {
  if ((header.elements & 0x7F) != kValue || parameter.is_read_only) return refuse(header, kSoeReadOnly, answer);
  if (size != parameter.bytes) return refuse(header, kSoeTooLong, answer);
  uint32_t bits = 0;
  for (size_t i = 0; i < size; ++i) bits |= uint32_t{data[i]} << 8 * i;
  const int32_t value = size == 2 ? static_cast<int16_t>(bits) : static_cast<int32_t>(bits);
  if (value < parameter.minimum) return refuse(header, kSoeBelowMinimum, answer);
  if (value > parameter.maximum) return refuse(header, kSoeAboveMaximum, answer);
  parameter.value = value;
  if (parameter.is_procedure) parameter.is_running = value == kStartProcedure;
  writeSoeHeader(header, answer);
  return kSoeHeaderBytes;
}

}  // namespace

bool isDeletedIdn(uint16_t code) { return isIn(kDeleted, sizeof kDeleted / sizeof kDeleted[0], code); }
bool isRedefinedIdn(uint16_t code) { return isIn(kRedefined, sizeof kRedefined / sizeof kRedefined[0], code); }

bool standardTelegram(unsigned type, bool with_velocity, Telegram* telegram) {
  if (type >= sizeof kTelegrams / sizeof kTelegrams[0]) return false;
  *telegram = kTelegrams[type];
  if (type == 5 && with_velocity) {
    telegram->feedbacks[0] = kSVelocityFeedback;
    telegram->feedbacks[telegram->feedback_count++] = kSPositionFeedback;
  }
  return true;
}

bool customTelegram(const uint16_t* commands, size_t command_words, const uint16_t* feedbacks, size_t feedback_words,
                    Telegram* telegram) {
  *telegram = {};
  return takeList(commands, command_words, telegram->commands, &telegram->command_count) &&
         takeList(feedbacks, feedback_words, telegram->feedbacks, &telegram->feedback_count);
}

size_t telegramBytes(uint16_t idn) { return idn == kSTorqueCommand ? 2 : 4; }

int phaseOf(EcatState state) {
  switch (state) {
    case EcatState::Init: return 0;  // and 1
    case EcatState::PreOp: return 2;
    case EcatState::SafeOp: return 3;
    case EcatState::Op: return 4;
    case EcatState::Boot: return -1;
  }
  return -1;
}

void writeSoeHeader(const SoeHeader& header, uint8_t* bytes) {
  bytes[0] = static_cast<uint8_t>((static_cast<unsigned>(header.command) & 7) | (header.more_follows ? 8 : 0) |
                                  (header.error ? 16 : 0) | header.drive << 5);
  bytes[1] = header.elements;
  put(bytes + 2, header.idn, 2);
}

SoeHeader readSoeHeader(const uint8_t* bytes) {
  SoeHeader header = {};
  header.command = static_cast<SoeCommand>(bytes[0] & 7);
  header.more_follows = (bytes[0] & 8) != 0;
  header.error = (bytes[0] & 16) != 0;
  header.drive = bytes[0] >> 5;
  header.elements = bytes[1];
  header.idn = static_cast<uint16_t>(bytes[2] | bytes[3] << 8);
  return header;
}

size_t answerSoe(SoeParameter* parameters, size_t count, bool is_single, const uint8_t* request, size_t size,
                 uint8_t* answer, size_t capacity) {
  if (size < kSoeHeaderBytes || capacity < kSoeHeaderBytes + 2) return 0;
  SoeHeader header = readSoeHeader(request);
  const bool is_read = header.command == SoeCommand::ReadRequest;
  if (!is_read && header.command != SoeCommand::WriteRequest) return 0;
  header.command = is_read ? SoeCommand::ReadResponse : SoeCommand::WriteResponse;
  SoeParameter* const parameter = find(parameters, count, header.idn);
  if (parameter == nullptr || isDeletedIdn(header.idn)) return refuse(header, kSoeNoIdn, answer);
  if (is_read) return read(*parameter, header, is_single, answer, capacity);
  return write(*parameter, header, request + kSoeHeaderBytes, size - kSoeHeaderBytes, answer);
}

}  // namespace rung::fieldbus

// SPDX-License-Identifier: Apache-2.0
// Sercos over EtherCAT: identification numbers, telegrams of process data, and the service channel that reads and
// writes elements of them. In: a table of parameters. TM/TP manual 2.4.2; AX manual 7.4.2; IEC 61800-7-204 and -304.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "fieldbus/ethercat.h"

namespace rung::fieldbus {

// 16 bits: bit 15 is 0 for a standard and 1 for a product parameter, 14 to 12 the parameter set, 11 to 0 the number.
struct Idn {
  bool is_product;
  uint8_t set;      // 0 to 7
  uint16_t number;  // 0 to 4095
};
constexpr uint16_t idnCode(Idn idn) {
  return static_cast<uint16_t>((idn.is_product ? 0x8000 : 0) | (idn.set & 7) << 12 | (idn.number & 0xFFF));
}
constexpr Idn idnOf(uint16_t code) {
  return {(code & 0x8000) != 0, static_cast<uint8_t>(code >> 12 & 7), static_cast<uint16_t>(code & 0xFFF)};
}

// Sercos has numbers for its own line that EtherCAT does not use.
bool isDeletedIdn(uint16_t code);
bool isRedefinedIdn(uint16_t code);

enum IdnCode : uint16_t {
  kSAtWriteTime = 6,        // S-0-0006
  kSInterfaceStatus = 14,   // S-0-0014
  kSTelegramType = 15,      // S-0-0015
  kSFeedbackList = 16,      // S-0-0016
  kSCommandList = 24,       // S-0-0024
  kSLossCounter = 28,       // S-0-0028
  kSVelocityCommand = 36,   // S-0-0036, 4 bytes
  kSPositionCommand = 47,   // S-0-0047, 4 bytes
  kSPositionFeedback = 51,  // S-0-0051, 4 bytes
  kSVelocityFeedback = 53,  // S-0-0053 in the manual (S-0-0040 in Sercos), 4 bytes
  kSTorqueCommand = 80,     // S-0-0080, 2 bytes
  kSMdtReadTime = 89        // S-0-0089
};

// The seven elements of a data block, by their bits in the element mask of a telegram.
enum SoeElement : uint8_t {
  kDataState = 1,
  kName = 2,
  kAttribute = 4,
  kUnit = 8,
  kMinimum = 16,
  kMaximum = 32,
  kValue = 64
};

// The data that a telegram type of S-0-0015 carries.
struct Telegram {
  uint16_t commands[4], feedbacks[4];
  uint8_t command_count, feedback_count;
};

// Types 0 to 6. Type 5 has the position, or velocity and position as feedback: `with_velocity`. False for 7, which
// S-0-0016 and S-0-0024 describe, and for unknown types.
bool standardTelegram(unsigned type, bool with_velocity, Telegram* telegram);

// Type 7: lists of words, the greatest and the actual length, then the numbers. False: the list does not have its
// length.
bool customTelegram(const uint16_t* commands, size_t command_words, const uint16_t* feedbacks, size_t feedback_words,
                    Telegram* telegram);

// Bytes of the data of a number in a telegram.
size_t telegramBytes(uint16_t idn);

// The phases 0 to 4 of Sercos by the state of the slave; -1 in Boot.
int phaseOf(EcatState state);

enum class SoeCommand : uint8_t {
  ReadRequest = 1,
  ReadResponse = 2,
  WriteRequest = 3,
  WriteResponse = 4,
  Notification = 5,
  SlaveInfo = 6,
  Reserved = 7
};

// 4 bytes: 3 bits command, 1 bit more follows, 1 bit error, 3 bits drive; 8 bits elements; 16 bits number, or what is
// left to come.
struct SoeHeader {
  SoeCommand command;
  bool more_follows, error;
  uint8_t drive, elements;
  uint16_t idn;
};
constexpr size_t kSoeHeaderBytes = 4;
void writeSoeHeader(const SoeHeader& header, uint8_t* bytes);
SoeHeader readSoeHeader(const uint8_t* bytes);

enum SoeError : uint16_t {
  kSoeNoIdn = 0x1001,
  kSoeNoElement = 0x1009,
  kSoeTooLong = 0x7003,
  kSoeReadOnly = 0x7004,
  kSoeBelowMinimum = 0x7006,
  kSoeAboveMaximum = 0x7007
};

// A parameter. Attributes, name and unit are read-only.
struct SoeParameter {
  uint16_t idn;
  const char* name;
  const char* unit;
  uint32_t attribute;
  int32_t minimum, maximum, value;
  uint8_t bytes;  // of minimum, maximum and value: 2 or 4
  bool is_read_only;
  bool is_procedure;  // writing 3 starts it; it runs on by itself, and the channel is free
  bool is_running;
};

// Answers a request of one mailbox without its header. A server of single elements answers only the first one asked
// for.
size_t answerSoe(SoeParameter* parameters, size_t count, bool is_single, const uint8_t* request, size_t size,
                 uint8_t* answer, size_t capacity);

}  // namespace rung::fieldbus

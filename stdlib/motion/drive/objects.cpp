// SPDX-License-Identifier: Apache-2.0
// The object dictionary: see objects.h. Each row is an object with the field that holds it.
#include "drive/objects.h"

#include <string.h>

#include "drive/homing.h"

namespace rung::motion {
namespace {

using fieldbus::EcatState;
using fieldbus::MappedObject;

enum Access : uint8_t { kReadWrite, kReadOnly };

struct Object {
  uint16_t index;
  uint8_t subindex, bytes;
  Access access;
  size_t offset;  // in SimulatedDrive
};

#define RUNG_FIELD(name) offsetof(SimulatedDrive, name##_)
constexpr Object kObjects[] = {
    {0x603F, 0, 2, kReadOnly, RUNG_FIELD(error)},
    {0x6040, 0, 2, kReadWrite, RUNG_FIELD(controlword)},
    {0x6041, 0, 2, kReadOnly, RUNG_FIELD(statusword)},
    {0x605A, 0, 2, kReadWrite, RUNG_FIELD(quick_stop_option)},
    {0x605B, 0, 2, kReadWrite, RUNG_FIELD(shutdown_option)},
    {0x605C, 0, 2, kReadWrite, RUNG_FIELD(disable_option)},
    {0x605D, 0, 2, kReadWrite, RUNG_FIELD(halt_option)},
    {0x605E, 0, 2, kReadWrite, RUNG_FIELD(fault_option)},
    {0x6060, 0, 1, kReadWrite, RUNG_FIELD(mode)},
    {0x6061, 0, 1, kReadOnly, RUNG_FIELD(mode_display)},
    {0x6065, 0, 4, kReadWrite, RUNG_FIELD(following_error_window)},
    {0x6066, 0, 2, kReadWrite, RUNG_FIELD(following_error_timeout)},
    {0x6067, 0, 4, kReadWrite, RUNG_FIELD(position_window)},
    {0x6068, 0, 2, kReadWrite, RUNG_FIELD(position_window_time)},
    {0x606D, 0, 2, kReadWrite, RUNG_FIELD(velocity_window)},
    {0x606E, 0, 2, kReadWrite, RUNG_FIELD(velocity_window_time)},
    {0x6071, 0, 2, kReadWrite, RUNG_FIELD(target_torque)},
    {0x6072, 0, 2, kReadWrite, RUNG_FIELD(max_torque)},
    {0x6073, 0, 2, kReadWrite, RUNG_FIELD(max_current)},
    {0x6075, 0, 4, kReadWrite, RUNG_FIELD(rated_current)},
    {0x607A, 0, 4, kReadWrite, RUNG_FIELD(target_position)},
    {0x607C, 0, 4, kReadWrite, RUNG_FIELD(home_offset)},
    {0x607D, 1, 4, kReadWrite, RUNG_FIELD(min_position_limit)},
    {0x607D, 2, 4, kReadWrite, RUNG_FIELD(max_position_limit)},
    {0x607F, 0, 4, kReadWrite, RUNG_FIELD(max_profile_velocity)},
    {0x6081, 0, 4, kReadWrite, RUNG_FIELD(profile_velocity)},
    {0x6083, 0, 4, kReadWrite, RUNG_FIELD(profile_acceleration)},
    {0x6084, 0, 4, kReadWrite, RUNG_FIELD(profile_deceleration)},
    {0x6085, 0, 4, kReadWrite, RUNG_FIELD(quick_stop_deceleration)},
    {0x6087, 0, 4, kReadWrite, RUNG_FIELD(torque_slope)},
    {0x6098, 0, 1, kReadWrite, RUNG_FIELD(homing_method)},
    {0x6099, 1, 4, kReadWrite, RUNG_FIELD(homing_speed_search)},
    {0x6099, 2, 4, kReadWrite, RUNG_FIELD(homing_speed_zero)},
    {0x609A, 0, 4, kReadWrite, RUNG_FIELD(homing_acceleration)},
    {0x60B8, 0, 2, kReadWrite, RUNG_FIELD(probe_function)},
    {0x60B9, 0, 2, kReadOnly, RUNG_FIELD(probe_status)},
    {0x60BA, 0, 4, kReadOnly, RUNG_FIELD(probe_positions)},
    {0x60BB, 0, 4, kReadOnly, RUNG_FIELD(probe_positions) + 4},
    {0x60BC, 0, 4, kReadOnly, RUNG_FIELD(probe_positions) + 8},
    {0x60BD, 0, 4, kReadOnly, RUNG_FIELD(probe_positions) + 12},
    {0x60C2, 1, 1, kReadWrite, RUNG_FIELD(interpolation_period)},
    {0x60C2, 2, 1, kReadWrite, RUNG_FIELD(interpolation_exponent)},
    {0x60FD, 0, 4, kReadOnly, RUNG_FIELD(inputs)},
    {0x60FE, 1, 4, kReadWrite, RUNG_FIELD(digital_outputs)},
    {0x60FF, 0, 4, kReadWrite, RUNG_FIELD(target_velocity)},
};
#undef RUNG_FIELD

// Objects whose value does not change.
struct Constant {
  uint16_t index;
  uint8_t subindex, bytes;
  uint32_t value;
};
constexpr Constant kConstants[] = {
    {0x1000, 0, 4, 0x00020192},                     // servo drive by profile 402
    {0x1018, 0, 1, 4},          {0x1018, 1, 4, 0},  // vendor: none
    {0x1018, 2, 4, 402},                            // product
    {0x1018, 3, 4, 1},                              // revision
    {0x1018, 4, 4, 0},                              // serial number
    {0x1C00, 0, 1, 4},                              // sync managers: mailbox out and in, process data out and in
    {0x1C00, 1, 1, 1},          {0x1C00, 2, 1, 2}, {0x1C00, 3, 1, 3}, {0x1C00, 4, 1, 4},     {0x607D, 0, 1, 2},
    {0x6099, 0, 1, 2},          {0x60C2, 0, 1, 2}, {0x60FE, 0, 1, 1}, {0x6502, 0, 4, 0x3A5},  // supported modes: pp,
                                                                                              // pv, hm, csp, csv, cst
};

struct Text {
  uint16_t index;
  const char* text;
};
constexpr Text kTexts[] = {{0x1008, "Rung simulated drive"}, {0x1009, "1.0"}, {0x100A, "1.0"}};

constexpr Mappable kMappable[] = {
    {RUNG_DRIVE_CONTROLWORD, 0x6040, 0, 16, true},
    {RUNG_DRIVE_MODE, 0x6060, 0, 8, true},
    {RUNG_DRIVE_TARGET_POSITION, 0x607A, 0, 32, true},
    {RUNG_DRIVE_TARGET_VELOCITY, 0x60FF, 0, 32, true},
    {RUNG_DRIVE_TARGET_TORQUE, 0x6071, 0, 16, true},
    {RUNG_DRIVE_PROBE_FUNCTION, 0x60B8, 0, 16, true},
    {RUNG_DRIVE_DIGITAL_OUTPUTS, 0x60FE, 1, 32, true},
    {0, 0x6087, 0, 32, true},
    {0, 0x6073, 0, 16, true},
    {0, 0x6075, 0, 32, true},
    {RUNG_DRIVE_STATUSWORD, 0x6041, 0, 16, false},
    {RUNG_DRIVE_MODE_DISPLAY, 0x6061, 0, 8, false},
    {RUNG_DRIVE_POSITION, 0x6064, 0, 32, false},
    {RUNG_DRIVE_VELOCITY, 0x606C, 0, 32, false},
    {RUNG_DRIVE_TORQUE, 0x6077, 0, 16, false},
    {RUNG_DRIVE_ERROR_CODE, 0x603F, 0, 16, false},
    {RUNG_DRIVE_PROBE_STATUS, 0x60B9, 0, 16, false},
    {RUNG_DRIVE_PROBE_POSITIONS, 0x60BA, 0, 32, false},
    {RUNG_DRIVE_PROBE_POSITIONS, 0x60BB, 0, 32, false},
    {RUNG_DRIVE_PROBE_POSITIONS, 0x60BC, 0, 32, false},
    {RUNG_DRIVE_PROBE_POSITIONS, 0x60BD, 0, 32, false},
    {RUNG_DRIVE_DIGITAL_INPUTS, 0x60FD, 0, 32, false},
};

// The PDOs are kept as 8 lists of a count and up to 8 entries: 1600h to 1603h, then 1A00h to 1A03h.
constexpr unsigned kPdos = 4, kEntries = 8, kPdoWords = kEntries + 1;

// Where the list of a PDO begins in `pdo`; -1: there is no such PDO.
int pdoAt(uint16_t index) {
  if (index >= 0x1600 && index < 0x1600 + kPdos) return static_cast<int>((index - 0x1600) * kPdoWords);
  if (index >= 0x1A00 && index < 0x1A00 + kPdos) return static_cast<int>((index - 0x1A00 + kPdos) * kPdoWords);
  return -1;
}

uint32_t* pdoOf(SimulatedDrive& drive, uint16_t index) {
  const int at = pdoAt(index);
  return at < 0 ? nullptr : drive.pdo_ + at;
}

uint16_t* assignmentsOf(SimulatedDrive& drive, uint16_t index) {
  return index == fieldbus::assignmentOf(2)   ? drive.rx_assignment_
         : index == fieldbus::assignmentOf(3) ? drive.tx_assignment_
                                              : nullptr;
}

const Mappable* findMappable(const MappedObject& object, bool to_drive) {
  for (const Mappable& row : kMappable)
    if (row.index == object.index && row.subindex == object.subindex && row.to_drive == to_drive) return &row;
  return nullptr;
}

void map(SimulatedDrive& drive, uint32_t mapped, bool to_drive) {
  uint16_t index = to_drive ? 0x1600 : 0x1A00;
  uint16_t* const assigned = to_drive ? drive.rx_assignment_ : drive.tx_assignment_;
  for (const Mappable& row : kMappable) {
    if (row.to_drive != to_drive || (row.bit & mapped) == 0) continue;
    if (pdoOf(drive, index)[0] == kEntries) ++index;
    uint32_t* const pdo = pdoOf(drive, index);
    pdo[++pdo[0]] = fieldbus::mappingEntry({row.index, row.subindex, row.bits});
    if (pdo[0] == 1) assigned[++assigned[0]] = index;
  }
}

bool isMode(int mode) { return mode == 0 || mode == 1 || mode == 3 || mode == 6 || (mode >= 8 && mode <= 10); }

int64_t extended(uint32_t value, size_t bytes) {
  return bytes == 1   ? static_cast<int8_t>(value)
         : bytes == 2 ? static_cast<int16_t>(value)
                      : static_cast<int32_t>(value);
}

bool isInRange(const Object& object, uint32_t value) {
  const int64_t number = extended(value, object.bytes);
  switch (object.index) {
    case 0x605A: return number >= 0 && number <= 8;
    case 0x605B:
    case 0x605C: return number == 0 || number == 1;
    case 0x605D: return number >= 1 && number <= 4;
    case 0x605E: return number >= 0 && number <= 4;
    case 0x6060: return isMode(static_cast<int>(number));
    case 0x6098: return number == 0 || homingPlan(static_cast<int>(number), 0).is_known;
    default: return true;
  }
}

uint32_t put(uint32_t value, size_t count, uint8_t* bytes, size_t capacity, size_t* size) {
  if (capacity < count) return fieldbus::kSdoMemory;
  for (size_t i = 0; i < count; ++i) bytes[i] = static_cast<uint8_t>(value >> 8 * i);
  *size = count;
  return fieldbus::kSdoOk;
}

uint32_t take(const uint8_t* bytes, size_t size) {
  uint32_t value = 0;
  for (size_t i = 0; i < size; ++i) value |= uint32_t{bytes[i]} << 8 * i;
  return value;
}

uint32_t fieldOf(const SimulatedDrive& drive, const Object& object) {
  uint8_t bytes[4] = {};
  memcpy(bytes, reinterpret_cast<const uint8_t*>(&drive) + object.offset, object.bytes);
  return take(bytes, 4);
}

// Values that are computed.
bool readComputed(const SimulatedDrive& drive, uint16_t index, uint32_t* value, size_t* bytes) {
  *bytes = 4;
  switch (index) {
    case 0x1001: *value = drive.error_ != 0 ? 1 : 0, *bytes = 1; return true;
    case 0x6062: *value = static_cast<uint32_t>(countedPosition(drive, drive.demand_)); return true;
    case 0x6064: *value = static_cast<uint32_t>(countedPosition(drive, drive.machine_position_)); return true;
    case 0x606C: *value = static_cast<uint32_t>(countedVelocity(drive.machine_velocity_)); return true;
    case 0x60F4: *value = static_cast<uint32_t>(countedVelocity(drive.demand_ - drive.machine_position_)); return true;
    case 0x6077: *value = static_cast<uint32_t>(countedVelocity(drive.torque_)) & 0xFFFF, *bytes = 2; return true;
    default: return false;
  }
}

uint32_t readObject(void* owner, uint16_t index, uint8_t subindex, uint8_t* bytes, size_t capacity, size_t* size) {
  SimulatedDrive& drive = *static_cast<SimulatedDrive*>(owner);
  bool has_index = false;
  for (const Object& object : kObjects) {
    has_index = has_index || object.index == index;
    if (object.index == index && object.subindex == subindex)
      return put(fieldOf(drive, object), object.bytes, bytes, capacity, size);
  }
  for (const Constant& row : kConstants) {
    has_index = has_index || row.index == index;
    if (row.index == index && row.subindex == subindex) return put(row.value, row.bytes, bytes, capacity, size);
  }
  for (const Text& row : kTexts) {
    if (row.index != index) continue;
    if (subindex != 0) return fieldbus::kSdoNoSubindex;
    *size = strlen(row.text);
    if (*size > capacity) return fieldbus::kSdoMemory;
    memcpy(bytes, row.text, *size);
    return fieldbus::kSdoOk;
  }
  uint32_t value = 0;
  size_t count = 0;
  if (readComputed(drive, index, &value, &count))
    return subindex == 0 ? put(value, count, bytes, capacity, size) : uint32_t{fieldbus::kSdoNoSubindex};
  if (const uint32_t* const pdo = pdoOf(drive, index)) {
    if (subindex > kEntries) return fieldbus::kSdoNoSubindex;
    return put(pdo[subindex], subindex == 0 ? 1 : 4, bytes, capacity, size);
  }
  if (const uint16_t* const assigned = assignmentsOf(drive, index)) {
    if (subindex > kPdos) return fieldbus::kSdoNoSubindex;
    return put(assigned[subindex], subindex == 0 ? 1 : 2, bytes, capacity, size);
  }
  return has_index ? fieldbus::kSdoNoSubindex : fieldbus::kSdoNoObject;
}

// A list is written from its start: number 0, entries, then the number. All of it in PreOp.
uint32_t writeMapping(SimulatedDrive& drive, uint16_t index, uint8_t subindex, uint32_t value, size_t size) {
  uint32_t* const pdo = pdoOf(drive, index);
  if (drive.bus_state_ != static_cast<uint8_t>(EcatState::PreOp)) return fieldbus::kSdoState;
  if (subindex > kEntries) return fieldbus::kSdoNoSubindex;
  if (size != (subindex == 0 ? 1u : 4u)) return fieldbus::kSdoLength;
  if (subindex == 0) {
    if (value > kEntries) return fieldbus::kSdoMappingLength;
  } else {
    if (pdo[0] != 0) return fieldbus::kSdoState;
    const MappedObject object = fieldbus::mappedObject(value);
    const Mappable* const row = findMappable(object, index < 0x1A00);
    if (row == nullptr) return fieldbus::kSdoNotMappable;
    if (row->bits != object.bits) return fieldbus::kSdoMappingLength;
  }
  pdo[subindex] = value;
  return fieldbus::kSdoOk;
}

uint32_t writeAssignment(SimulatedDrive& drive, uint16_t index, uint8_t subindex, uint32_t value, size_t size) {
  uint16_t* const assigned = assignmentsOf(drive, index);
  if (drive.bus_state_ != static_cast<uint8_t>(EcatState::PreOp)) return fieldbus::kSdoState;
  if (subindex > kPdos) return fieldbus::kSdoNoSubindex;
  if (size != (subindex == 0 ? 1u : 2u)) return fieldbus::kSdoLength;
  if (subindex == 0 && value > kPdos) return fieldbus::kSdoRange;
  if (subindex != 0) {
    if (assigned[0] != 0) return fieldbus::kSdoState;
    const uint32_t first = index == fieldbus::assignmentOf(2) ? 0x1600 : 0x1A00;
    if (value < first || value >= first + kPdos) return fieldbus::kSdoRange;
  }
  assigned[subindex] = static_cast<uint16_t>(value);
  return fieldbus::kSdoOk;
}

uint32_t writeObject(void* owner, uint16_t index, uint8_t subindex, const uint8_t* bytes, size_t size) {
  SimulatedDrive& drive = *static_cast<SimulatedDrive*>(owner);
  const uint32_t value = size <= 4 ? take(bytes, size) : 0;
  if (pdoOf(drive, index) != nullptr) return writeMapping(drive, index, subindex, value, size);
  if (assignmentsOf(drive, index) != nullptr) return writeAssignment(drive, index, subindex, value, size);
  for (const Object& object : kObjects) {
    if (object.index != index || object.subindex != subindex) continue;
    if (object.access == kReadOnly) return fieldbus::kSdoReadOnly;
    if (size != object.bytes) return fieldbus::kSdoLength;
    if (!isInRange(object, value)) return fieldbus::kSdoRange;
    memcpy(reinterpret_cast<uint8_t*>(&drive) + object.offset, bytes, size);
    return fieldbus::kSdoOk;
  }
  uint8_t kept[fieldbus::kSdoBytes];
  size_t count = 0;
  const uint32_t failed = readObject(owner, index, subindex, kept, sizeof kept, &count);
  return failed == fieldbus::kSdoOk ? uint32_t{fieldbus::kSdoReadOnly} : failed;
}

// The bits of the assigned PDOs but RUNG_DRIVE_PROBE_POSITIONS; `positions`: which of those objects there are.
uint32_t objectsOf(const SimulatedDrive& drive, const uint16_t* assigned, bool to_drive, uint32_t* positions) {
  uint32_t mapped = 0;
  for (unsigned i = 1; i <= assigned[0] && i <= kPdos; ++i) {
    const int at = pdoAt(assigned[i]);
    if (at < 0) continue;
    const uint32_t* const pdo = drive.pdo_ + at;
    for (unsigned j = 1; j <= pdo[0] && j <= kEntries; ++j) {
      const Mappable* const row = findMappable(fieldbus::mappedObject(pdo[j]), to_drive);
      if (row == nullptr) continue;
      if (row->bit == RUNG_DRIVE_PROBE_POSITIONS)
        *positions |= 1u << (row->index - 0x60BA);
      else
        mapped |= row->bit;
    }
  }
  return mapped;
}

}  // namespace

fieldbus::Dictionary dictionaryOf(SimulatedDrive& drive) { return {&drive, readObject, writeObject}; }

void mapDefault(SimulatedDrive& drive, uint32_t mapped) {
  memset(drive.pdo_, 0, sizeof drive.pdo_);
  memset(drive.rx_assignment_, 0, sizeof drive.rx_assignment_);
  memset(drive.tx_assignment_, 0, sizeof drive.tx_assignment_);
  map(drive, mapped, true);
  map(drive, mapped, false);
}

const Mappable& mappable(unsigned row) { return kMappable[row]; }

void listMapped(const SimulatedDrive& drive, bool to_drive, uint8_t (&rows)[kMostMapped + 1]) {
  static_assert(kMostMapped == kPdos * kEntries, "room for each entry of each PDO");
  const uint16_t* const assigned = to_drive ? drive.rx_assignment_ : drive.tx_assignment_;
  rows[0] = 0;
  for (unsigned i = 1; i <= assigned[0] && i <= kPdos; ++i) {
    const int at = pdoAt(assigned[i]);
    if (at < 0) continue;
    const uint32_t* const pdo = drive.pdo_ + at;
    for (unsigned j = 1; j <= pdo[0] && j <= kEntries; ++j)
      if (const Mappable* const row = findMappable(fieldbus::mappedObject(pdo[j]), to_drive))
        rows[++rows[0]] = static_cast<uint8_t>(row - kMappable);
  }
}

uint32_t mappedObjects(const SimulatedDrive& drive) {
  uint32_t positions = 0;
  const uint32_t mapped = objectsOf(drive, drive.rx_assignment_, true, &positions) |
                          objectsOf(drive, drive.tx_assignment_, false, &positions);
  // The four positions of the probes have one bit.
  return positions == 15 ? mapped | RUNG_DRIVE_PROBE_POSITIONS : mapped;
}

}  // namespace rung::motion

// SPDX-License-Identifier: Apache-2.0
// Process data in logical datagrams; see process_data.h.
#include "drive/process_data.h"

#include <string.h>

#include "drive/machine.h"
#include "drive/objects.h"
#include "drive/rounding.h"
#include "fieldbus/ethercat.h"

namespace rung::motion {
namespace {

using fieldbus::Datagram;
using fieldbus::EcatCommand;
using fieldbus::EcatSlave;

constexpr uint32_t kLogical = 0x10000;                    // where the process data is in the logical address space
constexpr uint16_t kOutputs = 0, kInputs = 128;           // and in the memory of the slave
constexpr size_t kMostBytes = fieldbus::kSlaveBytes / 2;  // 4 PDOs of 8 objects of 4 bytes

// The bytes of a list of objects, as they lie in their PDOs one after the other.
struct Image {
  uint8_t bytes[kMostBytes];
  size_t size;
};

// The place where the master has an object of the drive. Of those that RUNG_DRIVE lacks it sends back what they are.
uint32_t toDrive(const SimulatedDrive& drive, const rung_drive& data, uint16_t index) {
  switch (index) {
    case 0x6040: return data.controlword;
    case 0x6060: return static_cast<uint8_t>(data.mode);
    case 0x607A: return static_cast<uint32_t>(data.target_position);
    case 0x60FF: return static_cast<uint32_t>(data.target_velocity);
    case 0x6071: return static_cast<uint16_t>(data.target_torque);
    case 0x60B8: return data.probe_function;
    case 0x60FE: return data.digital_outputs;
    case 0x6087: return drive.torque_slope_;
    case 0x6073: return drive.max_current_;
    case 0x6075: return drive.rated_current_;
    default: return 0;
  }
}

void take(SimulatedDrive& drive, uint16_t index, uint32_t value) {
  switch (index) {
    case 0x6040: drive.controlword_ = static_cast<uint16_t>(value); return;
    case 0x6060: drive.mode_ = static_cast<int8_t>(value); return;
    case 0x607A: drive.target_position_ = static_cast<int32_t>(value); return;
    case 0x60FF: drive.target_velocity_ = static_cast<int32_t>(value); return;
    case 0x6071: drive.target_torque_ = static_cast<int16_t>(value); return;
    case 0x60B8: drive.probe_function_ = static_cast<uint16_t>(value); return;
    case 0x60FE: drive.digital_outputs_ = value; return;
    default: return;
  }
}

uint32_t fromDrive(const SimulatedDrive& drive, uint16_t index) {
  switch (index) {
    case 0x6041: return drive.statusword_;
    case 0x6061: return static_cast<uint8_t>(drive.mode_display_);
    case 0x6064: return static_cast<uint32_t>(countedPosition(drive, drive.machine_position_));
    case 0x606C: return static_cast<uint32_t>(countedVelocity(drive.machine_velocity_));
    case 0x6077: return static_cast<uint16_t>(static_cast<int16_t>(rounded(drive.torque_)));
    case 0x603F: return drive.error_;
    case 0x60B9: return drive.probe_status_;
    case 0x60BA:
    case 0x60BB:
    case 0x60BC:
    case 0x60BD: return static_cast<uint32_t>(drive.probe_positions_[index - 0x60BA]);
    case 0x60FD: return drive.inputs_;
    default: return 0;
  }
}

void show(rung_drive& data, uint16_t index, uint32_t value) {
  switch (index) {
    case 0x6041: data.statusword = static_cast<uint16_t>(value); return;
    case 0x6061: data.mode_display = static_cast<int8_t>(value); return;
    case 0x6064: data.position = static_cast<int32_t>(value); return;
    case 0x606C: data.velocity = static_cast<int32_t>(value); return;
    case 0x6077: data.torque = static_cast<int16_t>(value); return;
    case 0x603F: data.error_code = static_cast<uint16_t>(value); return;
    case 0x60B9: data.probe_status = static_cast<uint16_t>(value); return;
    case 0x60BA: data.probe_1_rising = static_cast<int32_t>(value); return;
    case 0x60BB: data.probe_1_falling = static_cast<int32_t>(value); return;
    case 0x60BC: data.probe_2_rising = static_cast<int32_t>(value); return;
    case 0x60BD: data.probe_2_falling = static_cast<int32_t>(value); return;
    case 0x60FD: data.digital_inputs = value; return;
    default: return;
  }
}

void append(Image& image, uint32_t value, size_t bytes) {
  for (size_t i = 0; i < bytes; ++i) image.bytes[image.size++] = static_cast<uint8_t>(value >> 8 * i);
}

uint32_t next(const uint8_t* bytes, size_t count, size_t& at) {
  uint32_t value = 0;
  for (size_t i = 0; i < count; ++i) value |= uint32_t{bytes[at++]} << 8 * i;
  return value;
}

// Sends a logical datagram of one command through the segment, which is this slave.
bool pass(SimulatedDrive& drive, EcatSlave& slave, EcatCommand command, Image& image, uint16_t physical) {
  const bool writes = command == EcatCommand::LWR;
  slave.fmmu_count = 1;
  slave.fmmus[0] = {kLogical + physical, static_cast<uint16_t>(image.size), physical, !writes, writes};
  slave.read_fails = drive.inputs_refused_ != 0;
  slave.write_fails = drive.outputs_refused_ != 0;
  Datagram datagram = {command, kLogical + physical, image.bytes, static_cast<uint16_t>(image.size), 0};
  fieldbus::pass(datagram, &slave, 1);
  drive.working_counter_ = static_cast<uint16_t>(drive.working_counter_ + datagram.working_counter);
  return datagram.working_counter == fieldbus::expectedCounter(command, writes ? 0 : 1, writes ? 1 : 0);
}

}  // namespace

void layOut(SimulatedDrive& drive) {
  listMapped(drive, true, drive.output_list_);
  listMapped(drive, false, drive.input_list_);
}

bool exchangeOutputs(SimulatedDrive& drive, const rung_drive& data) {
  if (drive.output_list_[0] == 0) return true;
  Image image;
  image.size = 0;
  for (unsigned i = 1; i <= drive.output_list_[0]; ++i) {
    const Mappable& row = mappable(drive.output_list_[i]);
    append(image, toDrive(drive, data, row.index), row.bits / 8);
  }
  EcatSlave slave;
  if (!pass(drive, slave, EcatCommand::LWR, image, kOutputs)) return false;
  size_t at = kOutputs;
  for (unsigned i = 1; i <= drive.output_list_[0]; ++i) {
    const Mappable& row = mappable(drive.output_list_[i]);
    take(drive, row.index, next(slave.memory, row.bits / 8, at));
  }
  return true;
}

bool exchangeInputs(SimulatedDrive& drive, rung_drive& data) {
  if (drive.input_list_[0] == 0) return true;
  Image image;
  image.size = 0;
  for (unsigned i = 1; i <= drive.input_list_[0]; ++i) {
    const Mappable& row = mappable(drive.input_list_[i]);
    append(image, fromDrive(drive, row.index), row.bits / 8);
  }
  EcatSlave slave;
  memcpy(slave.memory + kInputs, image.bytes, image.size);
  memset(image.bytes, 0, image.size);
  if (!pass(drive, slave, EcatCommand::LRD, image, kInputs)) return false;
  size_t at = 0;
  for (unsigned i = 1; i <= drive.input_list_[0]; ++i) {
    const Mappable& row = mappable(drive.input_list_[i]);
    show(data, row.index, next(image.bytes, row.bits / 8, at));
  }
  return true;
}

}  // namespace rung::motion

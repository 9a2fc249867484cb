// SPDX-License-Identifier: Apache-2.0
// The object dictionary of the simulated drive, and the mapping of its process data. The objects are fields of the
// instance; the service channel reaches them by CANopen over EtherCAT. Called by simulated_drive.cpp.
// IEC 61800-7-201 and -301; TM/TP manual 2.4.1.
#pragma once

#include "drive/drive.h"
#include "fieldbus/coe.h"

namespace rung::motion {

// The dictionary, for a SDO server.
fieldbus::Dictionary dictionaryOf(SimulatedDrive& drive);

// The PDOs that have the objects of `mapped` (bits of rung_drive_object), as after a start.
void mapDefault(SimulatedDrive& drive, uint32_t mapped);

// The bits of rung_drive_object that the assigned PDOs have.
uint32_t mappedObjects(const SimulatedDrive& drive);

// An object that the process data can have, and its bit of rung_drive_object, or 0.
struct Mappable {
  uint32_t bit;
  uint16_t index;
  uint8_t subindex, bits;
  bool to_drive;
};
constexpr unsigned kMostMapped = 32;  // in each direction
const Mappable& mappable(unsigned row);
// The objects of the assigned PDOs in their order: the number of objects, and their rows of `mappable`.
void listMapped(const SimulatedDrive& drive, bool to_drive, uint8_t (&rows)[kMostMapped + 1]);

}  // namespace rung::motion

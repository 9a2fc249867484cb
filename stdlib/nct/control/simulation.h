// SPDX-License-Identifier: Apache-2.0
// NCT_SIMULATE sets this up or asks for it; stdlib/nct/simulation.st says what each means. Used by
// control.h.
#pragma once

#include <cstdint>

namespace rung::nct {

// The values of NCT_SIMULATED. Not a type of its own: each function of simulation.cpp knows those of its subject.
struct Simulated {
  enum : int32_t {
    Parameter = 1,
    ParameterRead = 2,
    Checksum = 3,
    PartProgram = 4,
    Assigned = 5,
    Display = 7,
    Window = 8,
    Latency = 9,
    Block = 10,
    Cancel = 11,
    Clear = 12,
    Screen = 13,
    AxisPosition = 14,
    AxisAlarm = 15,
    SpindleAlarm = 16,
    DriveError = 17,
    MachineOff = 18,
    Handwheel = 19,
    Macro = 20,
    MacroRead = 21,
    Tables = 22,
    Cartridge = 23,
    Pattern = 24,
    Pot = 25,
    PotRead = 26,
    Pallets = 27,
    Device = 28,
    DeviceError = 29,
    Object = 30,
    ToolRead = 31,
    CountTarget = 32,
    ResetLife = 33,
    Tool = 34,
    Inputs = 35
  };
};

enum class Simulation : uint8_t { Done, Refused, Elsewhere };

// The values in brackets of NCT_SIMULATED; those that a call leaves out are 0.
class Settings {
 public:
  explicit Settings(const double* values) : values_(values) {}
  double real(int k) const { return values_[k]; }
  bool flag(int k) const { return values_[k] != 0; }
  int32_t whole(int k) const { return static_cast<int32_t>(values_[k]); }
  uint32_t word(int k) const { return static_cast<uint32_t>(whole(k)); }
  uint32_t bits(int k) const { return static_cast<uint32_t>(static_cast<int64_t>(values_[k])); }
  // An index of one of `count` units, which the program counts from `first`. False: there is none.
  bool unit(int k, uint32_t first, uint32_t count, uint32_t& index) const {
    index = word(k) - first;
    return index < count;
  }

 private:
  const double* values_;
};

}  // namespace rung::nct

// SPDX-License-Identifier: Apache-2.0
// A simulated I/O module: what its channels show of the signals at its terminals, and what its outputs drive. In: a row
// of types.h and where its channels begin. Out: reads and writes of a driver (rung/module.h), and terminals that a run
// sets and watches. What the AX manual (4.2 to 4.7) leaves open is decided in docs/io_modules.md. Called by
// drivers.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "../state_archive.h"
#include "rung/diagnosis.h"
#include "types.h"

namespace rung::host {

class Hsio;

// A wire: volts, milliamperes or degrees Celsius, or a state.
struct Terminal {
  std::string name;
  bool is_bool;
  double value = 0;
  bool state = false;
};

class SimulatedModule {
 public:
  SimulatedModule(const ModuleType& type, uint32_t input_offset, uint32_t output_offset);
  virtual ~SimulatedModule() = default;
  SimulatedModule(const SimulatedModule&) = delete;
  SimulatedModule& operator=(const SimulatedModule&) = delete;

  const ModuleType& type() const { return type_; }
  std::vector<Terminal>& terminals() { return terminals_; }
  // Its part of the input and the output area, in bytes.
  uint32_t inputOffset() const { return input_offset_; }
  uint32_t inputSize() const { return static_cast<uint32_t>(inputs_.size()); }
  uint32_t outputOffset() const { return output_offset_; }
  uint32_t outputSize() const { return static_cast<uint32_t>(outputs_.size()); }

  void read(uint8_t* inputs, int64_t now_ns);
  void write(const uint8_t* outputs, int64_t now_ns);
  // Its faults (AX 5.2) become current faults of the controller; `number` says which module has them.
  void reportTo(rung_diagnosis& diagnosis, uint32_t number) {
    diagnosis_ = &diagnosis;
    number_ = number;
  }
  // The program has stopped: the next outputs are the safe ones.
  void stopped() { has_stopped_ = true; }
  void transfer(StateArchive& archive);

 protected:
  // Channels of one row of the type, one after the other.
  struct Channels {
    uint32_t byte = 0;  // of the module's part
    uint32_t size = 0;  // bytes of one; 0: the type has none
  };
  Channels channels(const char* name) const;
  // The first terminal of a row; the others follow.
  Terminal* terminal(const char* name);
  uint32_t output(Channels channels, uint32_t index) const;
  int16_t signedOutput(Channels channels, uint32_t index) const;
  const uint8_t* outputBytes() const { return outputs_.data(); }
  static uint32_t valueOf(const uint8_t* outputs, Channels channels, uint32_t index);
  void input(Channels channels, uint32_t index, uint32_t value);
  // A channel has this fault now instead of `last`; 0: none.
  void reportFault(uint32_t& last, uint32_t code, int64_t now_ns);

 private:
  // Sets inputs from the terminals and the outputs as last written.
  virtual void readSignals(int64_t now_ns) = 0;
  // Drives terminals; the outputs are new.
  virtual void driveSignals(int64_t now_ns) = 0;
  // The same with safe outputs. The settings of the channels are among the outputs and stay as the program left them.
  virtual void driveSafeSignals(const uint8_t* safe_outputs, int64_t now_ns) = 0;
  // Saves or restores what the module remembers beside its channels and terminals.
  virtual void transferMemory(StateArchive& archive) = 0;

  const ModuleType& type_;
  uint32_t input_offset_, output_offset_;
  std::vector<uint8_t> inputs_, outputs_;
  std::vector<Terminal> terminals_;
  bool has_stopped_ = false;
  rung_diagnosis* diagnosis_ = nullptr;
  uint32_t number_ = 0;
};

// nullptr: a coupler, which has no channels. `hsio`: the counter unit of HIGH_PULSE_IO.
std::unique_ptr<SimulatedModule> simulate(const ModuleType& type, uint32_t input_offset, uint32_t output_offset,
                                          Hsio& hsio);

// Of the families, each in its own file.
std::unique_ptr<SimulatedModule> simulateDigital(const ModuleType& type, uint32_t inputs, uint32_t outputs);
std::unique_ptr<SimulatedModule> simulateAnalogInput(const ModuleType& type, uint32_t inputs, uint32_t outputs);
std::unique_ptr<SimulatedModule> simulateAnalogOutput(const ModuleType& type, uint32_t inputs, uint32_t outputs);
std::unique_ptr<SimulatedModule> simulateTemperature(const ModuleType& type, uint32_t inputs, uint32_t outputs);
std::unique_ptr<SimulatedModule> simulateHighSpeed(const ModuleType& type, uint32_t inputs, uint32_t outputs,
                                                   Hsio& hsio);

// Tells whether a digital input of that many volts is on: above 15 it is, below 5 it is not, in between it stays what
// it was (table 6-1).
constexpr bool levelOf(double volts, bool before) { return before ? volts >= 5 : volts > 15; }

// Versions of the simulated modules, 1.1.0, to be read as an octal number: 8#110.
constexpr uint32_t kModuleVersion = 0110;

}  // namespace rung::host

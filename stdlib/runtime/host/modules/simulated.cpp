// SPDX-License-Identifier: Apache-2.0
// The common part of simulated modules: see simulated.h.
#include "simulated.h"

#include <algorithm>
#include <cstring>

namespace rung::host {

SimulatedModule::SimulatedModule(const ModuleType& type, uint32_t input_offset, uint32_t output_offset)
    : type_(type), input_offset_(input_offset), output_offset_(output_offset) {
  uint32_t input_end = input_offset, output_end = output_offset;
  channelsOf(type, input_end, output_end);
  inputs_.resize(input_end - input_offset);
  outputs_.resize(output_end - output_offset);
  for (uint32_t row = 0; row < type.terminal_count; ++row)
    for (std::string& name : namesOf(type.terminals[row].name))
      terminals_.push_back({std::move(name), type.terminals[row].is_bool});
  if (const Channels version = channels("Version_FPGA"); version.size > 0) input(version, 0, kModuleVersion);
  if (const Channels version = channels("Version_MCU"); version.size > 0) input(version, 0, kModuleVersion);
}

void SimulatedModule::read(uint8_t* inputs, int64_t now_ns) {
  readSignals(now_ns);
  std::copy(inputs_.begin(), inputs_.end(), inputs);  // a module may have none
}

void SimulatedModule::write(const uint8_t* outputs, int64_t now_ns) {
  if (has_stopped_) {
    has_stopped_ = false;
    return driveSafeSignals(outputs, now_ns);
  }
  std::copy_n(outputs, outputs_.size(), outputs_.begin());
  driveSignals(now_ns);
}

void SimulatedModule::transfer(StateArchive& archive) {
  archive.bytes(inputs_.data(), inputs_.size());
  archive.bytes(outputs_.data(), outputs_.size());
  for (Terminal& wire : terminals_) archive.values(wire.value, wire.state);
  archive.value(has_stopped_);
  transferMemory(archive);
}

SimulatedModule::Channels SimulatedModule::channels(const char* name) const {
  uint32_t input_end = input_offset_, output_end = output_offset_;
  const std::vector<Channel> all = channelsOf(type_, input_end, output_end);
  size_t first = 0;
  for (uint32_t row = 0; row < type_.channel_count; ++row) {
    const ChannelRow& is = type_.channels[row];
    if (strcmp(is.name.name, name) == 0)
      return {all[first].byte - (is.is_output ? output_offset_ : input_offset_), bytesOf(is.type)};
    first += namesOf(is.name).size();
  }
  return {};
}

Terminal* SimulatedModule::terminal(const char* name) {
  size_t first = 0;
  for (uint32_t row = 0; row < type_.terminal_count; ++row) {
    if (strcmp(type_.terminals[row].name.name, name) == 0) return &terminals_[first];
    first += namesOf(type_.terminals[row].name).size();
  }
  return nullptr;
}

uint32_t SimulatedModule::valueOf(const uint8_t* outputs, Channels channels, uint32_t index) {
  uint32_t value = 0;
  memcpy(&value, outputs + channels.byte + index * channels.size, channels.size);  // both are little-endian
  return value;
}

uint32_t SimulatedModule::output(Channels channels, uint32_t index) const {
  return valueOf(outputs_.data(), channels, index);
}

int16_t SimulatedModule::signedOutput(Channels channels, uint32_t index) const {
  return static_cast<int16_t>(output(channels, index));
}

void SimulatedModule::input(Channels channels, uint32_t index, uint32_t value) {
  memcpy(&inputs_[channels.byte + index * channels.size], &value, channels.size);
}

void SimulatedModule::reportFault(uint32_t& last, uint32_t code, int64_t now_ns) {
  if (code == last) return;
  if (last != 0) rung_clear_fault(diagnosis_, last, number_);
  if (code != 0) rung_report_fault(diagnosis_, code, number_, now_ns);
  last = code;
}

std::unique_ptr<SimulatedModule> simulate(const ModuleType& type, uint32_t input_offset, uint32_t output_offset,
                                          Hsio& hsio) {
  switch (type.simulation) {
    case Simulation::Coupler: break;
    case Simulation::DigitalInput:
    case Simulation::DigitalOutput:
    case Simulation::DigitalBoth: return simulateDigital(type, input_offset, output_offset);
    case Simulation::HighSpeed: return simulateHighSpeed(type, input_offset, output_offset, hsio);
    case Simulation::AnalogInput: return simulateAnalogInput(type, input_offset, output_offset);
    case Simulation::AnalogOutput: return simulateAnalogOutput(type, input_offset, output_offset);
    case Simulation::Temperature: return simulateTemperature(type, input_offset, output_offset);
  }
  return nullptr;
}

}  // namespace rung::host

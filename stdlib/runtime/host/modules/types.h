// SPDX-License-Identifier: Apache-2.0
// The I/O modules that a project may have (`[module NAME]` of rung.project), their channels in the process image and
// their terminals, where the wires are. In: the name of a type. Out: rows, and the place of each channel. Read by the
// compiler, which declares the channels as variables, and by the simulated modules. AX manual chapter 4.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung::host {

enum class ChannelType : uint8_t { Bool, Byte, USInt, Word, UInt, Int, DWord, Real };
const char* spelling(ChannelType type);
uint32_t bytesOf(ChannelType type);

// A simulated module acts on its channels and terminals.
enum class Simulation : uint8_t {
  Coupler,  // has none
  DigitalInput,
  DigitalOutput,
  DigitalBoth,
  HighSpeed,
  AnalogInput,
  AnalogOutput,
  Temperature
};

// Several of a kind: `#` in the name stands for their numbers from 0.
struct Numbered {
  const char* name;
  uint8_t count = 0;  // 0: one, without a number
  uint8_t base = 10;  // of the numbers: X10 follows X7 in 8
};
struct ChannelRow {
  Numbered name;
  bool is_output;
  ChannelType type;
  int8_t inside_from = -1;  // bits of the channel above that is not one itself, from this one; < 0: a place of its own
};
// A terminal: a voltage, current or temperature, or (`is_bool`) a state.
struct TerminalRow {
  Numbered name;
  bool is_bool;
  bool is_output;  // driven by the module
};
struct ModuleType {
  const char* name;
  bool has_station;  // its form in the rack of a coupler (AX 4.6), which has other channels
  bool in_rack;      // takes a place in a rack, of which there are kRackPlaces
  Simulation simulation;
  const ChannelRow* channels;
  uint32_t channel_count;
  const TerminalRow* terminals;
  uint32_t terminal_count;
};
constexpr uint32_t kRackPlaces = 16;  // AX 1.1.1

// nullptr: there is no such type, or not in that form.
const ModuleType* findModuleType(std::string_view name, bool has_station);
// All names, each once.
std::vector<std::string_view> moduleTypeNames();

struct Channel {
  std::string name;
  bool is_output;
  ChannelType type;
  uint32_t byte;
  uint8_t bit;  // of a BOOL
};
// The channels from these bytes on, each at a multiple of its size. `inputs` and `outputs` become the ends.
std::vector<Channel> channelsOf(const ModuleType& type, uint32_t& inputs, uint32_t& outputs);
// `X#`, 2 of them: X0, X1.
std::vector<std::string> namesOf(const Numbered& numbered);

}  // namespace rung::host

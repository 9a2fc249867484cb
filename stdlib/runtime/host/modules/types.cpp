// SPDX-License-Identifier: Apache-2.0
// Module types and their channels: see types.h.
#include "types.h"

#include <strings.h>
#include <cstring>

namespace rung::host {
namespace {

constexpr bool kIn = false, kOut = true;

// AX 4.3.2, figure 4-5. The terminals of inputs take volts.
constexpr ChannelRow kInput16[] = {
    {{"IB1"}, kIn, ChannelType::Byte}, {{"IB2"}, kIn, ChannelType::Byte}, {{"Version_FPGA"}, kIn, ChannelType::Byte}};
constexpr ChannelRow kInput16Remote[] = {{{"InByte#", 2}, kIn, ChannelType::Byte}};
constexpr TerminalRow kInput16Terminals[] = {{{"X#", 16}, false, kIn}};

// Figure 4-6. The terminal of an output is TRUE while it conducts: to 24 V (DP) or to 0 V (DN).
constexpr ChannelRow kOutput16[] = {{{"QB1"}, kOut, ChannelType::Byte}, {{"QB2"}, kOut, ChannelType::Byte}};
constexpr ChannelRow kOutput16Remote[] = {{{"OutByte#", 2}, kOut, ChannelType::Byte}};
constexpr TerminalRow kOutput16Terminals[] = {{{"Y#", 16}, true, kOut}};

// 4.4.2. Version numbers read as octal numbers.
constexpr ChannelRow kAnalogInput[] = {
    {{"CH#", 4}, kOut, ChannelType::UInt},     {{"FP"}, kOut, ChannelType::UInt},
    {{"FP#", 4}, kOut, ChannelType::USInt},    {{"IN#", 4}, kIn, ChannelType::Int},
    {{"Version_FPGA"}, kIn, ChannelType::Int}, {{"Version_MCU"}, kIn, ChannelType::Int}};
constexpr ChannelRow kAnalogInputRemote[] = {{{"FP"}, kOut, ChannelType::Word},
                                             {{"CH#", 4}, kOut, ChannelType::UInt},
                                             {{"IN#", 4}, kIn, ChannelType::Int},
                                             {{"IN#_Fault_Code", 4}, kIn, ChannelType::Word}};
// Volts and milliamperes: the mode of a channel tells which it measures.
constexpr TerminalRow kAnalogInputTerminals[] = {
    {{"V#", 4}, false, kIn}, {{"A#", 4}, false, kIn}, {{"Open#", 4}, true, kIn}};

constexpr ChannelRow kAnalogOutput[] = {{{"Configuration_CH#", 4}, kOut, ChannelType::Int},
                                        {{"Data_CH#", 4}, kOut, ChannelType::Int},
                                        {{"Data_Default#", 4}, kOut, ChannelType::Int},
                                        {{"Version_FPGA"}, kIn, ChannelType::Byte},
                                        {{"Version_MCU"}, kIn, ChannelType::Byte}};
constexpr ChannelRow kAnalogOutputRemote[] = {{{"Configuration_CH#", 4}, kOut, ChannelType::Int},
                                              {{"Data_CH#", 4}, kOut, ChannelType::Int},
                                              {{"Data_Default#", 4}, kOut, ChannelType::Int},
                                              {{"INT#_Fault_Code", 4}, kIn, ChannelType::Word}};
constexpr TerminalRow kAnalogOutputTerminals[] = {{{"V#", 4}, false, kOut},
                                                  {{"A#", 4}, false, kOut},
                                                  {{"Open#", 4}, true, kIn},
                                                  {{"Short#", 4}, true, kIn},
                                                  {{"NoPower"}, true, kIn}};

// 4.5.2
constexpr ChannelRow kTemperature[] = {
    {{"Basic_Set_#", 4}, kOut, ChannelType::Byte},   {{"Sampling_period_#", 4}, kOut, ChannelType::Byte},
    {{"Sensor_type_#", 4}, kOut, ChannelType::Byte}, {{"Filtering_time_#", 4}, kOut, ChannelType::Byte},
    {{"Upper_value_#", 4}, kOut, ChannelType::Int},  {{"Lower_value_#", 4}, kOut, ChannelType::Int},
    {{"Temperature#", 4}, kIn, ChannelType::Real},   {{"Breakup#", 4}, kIn, ChannelType::Byte},
    {{"Overrun#", 4}, kIn, ChannelType::Byte},       {{"In_CJC"}, kIn, ChannelType::Real},
    {{"Out_CJC"}, kIn, ChannelType::Real},           {{"Version_FPGA"}, kIn, ChannelType::Byte},
    {{"Version_MCU"}, kIn, ChannelType::Byte}};
// Table 4-10. Temperatures in tenths of a degree.
constexpr ChannelRow kTemperatureRemote[] = {{{"Config_Word#", 7}, kOut, ChannelType::Word},
                                             {{"Temperature#", 4}, kIn, ChannelType::Int},
                                             {{"Breakup"}, kIn, ChannelType::Word}};
// Degrees Celsius at the sensors and at the cold junctions.
constexpr TerminalRow kTemperatureTerminals[] = {
    {{"T#", 4}, false, kIn}, {{"CJC_In"}, false, kIn}, {{"CJC_Out"}, false, kIn}};

// 4.2.4
constexpr ChannelRow kHighSpeed[] = {{{"Gpi_Value"}, kIn, ChannelType::Word},
                                     {{"Version_FPGA"}, kIn, ChannelType::Byte},
                                     {{"In#_Configure", 16, 16}, kOut, ChannelType::Byte},
                                     {{"XMode_SetA"}, kOut, ChannelType::Byte},
                                     {{"XMode_SetB"}, kOut, ChannelType::Byte},
                                     {{"XMode_SetC"}, kOut, ChannelType::Byte},
                                     {{"XMode_SetD"}, kOut, ChannelType::Byte},
                                     {{"Filt_Set"}, kOut, ChannelType::Byte},
                                     {{"Out#_Configure", 8}, kOut, ChannelType::Byte},
                                     {{"GPO_Set"}, kOut, ChannelType::Byte},
                                     {{"Run_Enable"}, kOut, ChannelType::Byte},
                                     {{"YMode_Set"}, kOut, ChannelType::Byte},
                                     {{"Interrupt"}, kOut, ChannelType::Bool},
                                     {{"Interrupt_Enable"}, kOut, ChannelType::DWord},
                                     {{"Gpi#", 8}, kOut, ChannelType::Bool, 0},
                                     {{"Comp#", 8}, kOut, ChannelType::Bool, 8},
                                     {{"Trig#", 4}, kOut, ChannelType::Bool, 16},
                                     {{"Interrupt_Mode"}, kOut, ChannelType::DWord}};
constexpr TerminalRow kHighSpeedTerminals[] = {{{"X#", 16, 16}, false, kIn}, {{"Y#", 8}, true, kOut}};

// 4.7.1: octal numbers
constexpr ChannelRow kDistributed[] = {{{"Y#", 32, 8}, kOut, ChannelType::Bool},
                                       {{"X#", 32, 8}, kIn, ChannelType::Bool}};
constexpr TerminalRow kDistributedTerminals[] = {{{"TX#", 32, 8}, false, kIn}, {{"TY#", 32, 8}, true, kOut}};

template <size_t C, size_t T>
constexpr ModuleType moduleType(const char* name, bool has_station, bool in_rack, Simulation simulation,
                                const ChannelRow (&channels)[C], const TerminalRow (&terminals)[T]) {
  return {name, has_station, in_rack, simulation, channels, C, terminals, T};
}

constexpr bool kLocal = false, kRemote = true, kRack = true, kAlone = false;
const ModuleType kTypes[] = {
    moduleType("HIGH_PULSE_IO", kLocal, kAlone, Simulation::HighSpeed, kHighSpeed, kHighSpeedTerminals),
    moduleType("AX_EM_1600D", kLocal, kRack, Simulation::DigitalInput, kInput16, kInput16Terminals),
    moduleType("AX_EM_1600D", kRemote, kRack, Simulation::DigitalInput, kInput16Remote, kInput16Terminals),
    moduleType("AX_EM_0016DP", kLocal, kRack, Simulation::DigitalOutput, kOutput16, kOutput16Terminals),
    moduleType("AX_EM_0016DP", kRemote, kRack, Simulation::DigitalOutput, kOutput16Remote, kOutput16Terminals),
    moduleType("AX_EM_0016DN", kLocal, kRack, Simulation::DigitalOutput, kOutput16, kOutput16Terminals),
    moduleType("AX_EM_0016DN", kRemote, kRack, Simulation::DigitalOutput, kOutput16Remote, kOutput16Terminals),
    moduleType("AX_EM_4AD", kLocal, kRack, Simulation::AnalogInput, kAnalogInput, kAnalogInputTerminals),
    moduleType("AX_EM_4AD", kRemote, kRack, Simulation::AnalogInput, kAnalogInputRemote, kAnalogInputTerminals),
    moduleType("AX_EM_4DA", kLocal, kRack, Simulation::AnalogOutput, kAnalogOutput, kAnalogOutputTerminals),
    moduleType("AX_EM_4DA", kRemote, kRack, Simulation::AnalogOutput, kAnalogOutputRemote, kAnalogOutputTerminals),
    moduleType("AX_EM_4PTC", kLocal, kRack, Simulation::Temperature, kTemperature, kTemperatureTerminals),
    moduleType("AX_EM_4PTC", kRemote, kRack, Simulation::Temperature, kTemperatureRemote, kTemperatureTerminals),
    moduleType("AE1420_AE2420", kLocal, kAlone, Simulation::DigitalBoth, kDistributed, kDistributedTerminals),
    {"AX_EM_RCM_ET", kLocal, kAlone, Simulation::Coupler, nullptr, 0, nullptr, 0}};

uint32_t aligned(uint32_t offset, uint32_t size) { return (offset + size - 1) / size * size; }

std::string digits(uint32_t number, uint32_t base) {
  std::string text(1, "0123456789ABCDEF"[number % base]);
  for (number /= base; number > 0; number /= base) text.insert(text.begin(), "0123456789ABCDEF"[number % base]);
  return text;
}

bool isCalled(const ModuleType& type, std::string_view name) {
  return name.size() == strlen(type.name) && strncasecmp(name.data(), type.name, name.size()) == 0;
}

// Where the next channel of an area goes: bits of one byte follow each other.
struct Place {
  uint32_t byte;
  uint32_t bit = 0;

  void take(ChannelType type, Channel& channel) {
    if (type == ChannelType::Bool) {
      channel.byte = byte;
      channel.bit = static_cast<uint8_t>(bit);
      if (++bit == 8) *this = {byte + 1};
      return;
    }
    const uint32_t size = bytesOf(type);
    channel.byte = aligned(end(), size);
    *this = {channel.byte + size};
  }
  uint32_t end() const { return byte + (bit > 0 ? 1 : 0); }
};

}  // namespace

const char* spelling(ChannelType type) {
  switch (type) {
    case ChannelType::Bool: return "BOOL";
    case ChannelType::Byte: return "BYTE";
    case ChannelType::USInt: return "USINT";
    case ChannelType::Word: return "WORD";
    case ChannelType::UInt: return "UINT";
    case ChannelType::Int: return "INT";
    case ChannelType::DWord: return "DWORD";
    case ChannelType::Real: break;
  }
  return "REAL";
}

uint32_t bytesOf(ChannelType type) {
  switch (type) {
    case ChannelType::Bool:
    case ChannelType::Byte:
    case ChannelType::USInt: return 1;
    case ChannelType::Word:
    case ChannelType::UInt:
    case ChannelType::Int: return 2;
    case ChannelType::DWord:
    case ChannelType::Real: break;
  }
  return 4;
}

const ModuleType* findModuleType(std::string_view name, bool has_station) {
  for (const ModuleType& type : kTypes)
    if (type.has_station == has_station && isCalled(type, name)) return &type;
  return nullptr;
}

std::vector<std::string_view> moduleTypeNames() {
  std::vector<std::string_view> names;
  for (const ModuleType& type : kTypes)
    if (!type.has_station) names.push_back(type.name);
  return names;
}

std::vector<std::string> namesOf(const Numbered& numbered) {
  const std::string name = numbered.name;
  const size_t at = name.find('#');
  if (at == std::string::npos) return {name};
  std::vector<std::string> names;
  for (uint32_t i = 0; i < numbered.count; ++i)
    names.push_back(name.substr(0, at) + digits(i, numbered.base) + name.substr(at + 1));
  return names;
}

std::vector<Channel> channelsOf(const ModuleType& type, uint32_t& inputs, uint32_t& outputs) {
  std::vector<Channel> channels;
  Place in{inputs}, out{outputs};
  uint32_t outer = 0;  // the byte of the last channel that has a place of its own
  for (uint32_t row = 0; row < type.channel_count; ++row) {
    const ChannelRow& is = type.channels[row];
    uint32_t bit = is.inside_from < 0 ? 0 : static_cast<uint32_t>(is.inside_from);
    for (std::string& name : namesOf(is.name)) {
      Channel channel{std::move(name), is.is_output, is.type, 0, 0};
      if (is.inside_from >= 0) {
        channel.byte = outer + bit / 8;
        channel.bit = static_cast<uint8_t>(bit++ % 8);
      } else {
        (is.is_output ? out : in).take(is.type, channel);
        outer = channel.byte;
      }
      channels.push_back(std::move(channel));
    }
  }
  inputs = in.end();
  outputs = out.end();
  return channels;
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// Simulated I/O modules: the channels that the AX manual lists (ax_modules.tsv: its chapter 4, a row per channel), and
// scaling and filters at both ends of each range. Expected values are those of tables 4-4 to 4-11 and 6-1.
#include "stdlib/runtime/host/modules/simulated.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "stdlib/runtime/host/hsio.h"

using namespace rung::host;

namespace {

constexpr int64_t kMs = 1'000'000;

struct CatalogueRow {
  std::string unit, channel, direction, type, note;
};

std::vector<CatalogueRow> catalogue() {
  std::ifstream file(TEST_FOLDER "/ax_modules.tsv");
  std::vector<CatalogueRow> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, '\t');) cells.push_back(cell);
    if (cells.size() >= 7) rows.push_back({cells[1], cells[2], cells[3], cells[4], cells[6]});
  }
  return rows;
}

std::vector<Channel> channelsAt0(const ModuleType& type) {
  uint32_t in = 0, out = 0;
  return channelsOf(type, in, out);
}

// `%QB29`, `%QX36.0` or `%QD9` as byte and bit.
bool readAddress(const std::string& note, uint32_t& byte, uint32_t& bit) {
  const size_t at = note.find('%');
  if (at == std::string::npos) return false;
  const char letter = note[at + 2];
  std::sscanf(note.c_str() + at + 3, "%u.%u", &byte, &bit);
  byte *= letter == 'W' ? 2 : letter == 'D' ? 4 : 1;
  return true;
}

TEST(Modules, HaveEveryChannelOfTheManual) {
  const std::vector<CatalogueRow> rows = catalogue();
  ASSERT_GT(rows.size(), 200u);
  std::set<std::string> listed;
  for (const CatalogueRow& row : rows) {
    const std::string name = row.unit.substr(0, row.unit.find(' '));
    const bool is_remote = row.unit != name || row.note.find("remote only") != std::string::npos;
    const ModuleType* const type = findModuleType(name, is_remote);
    ASSERT_NE(type, nullptr) << row.unit;
    listed.insert(name + '.' + row.channel);
    bool found = false;
    for (const Channel& channel : channelsAt0(*type)) {
      if (channel.name != row.channel) continue;
      found = true;
      EXPECT_EQ(channel.is_output, row.direction == "OUT") << row.unit << ' ' << row.channel;
      if (!row.type.empty()) {
        EXPECT_EQ(spelling(channel.type), row.type) << row.unit << ' ' << row.channel;
      }
      uint32_t byte = 0, bit = 0;
      if (name == "HIGH_PULSE_IO" && readAddress(row.note, byte, bit)) {
        EXPECT_EQ(channel.byte, byte) << row.channel;
        EXPECT_EQ(channel.bit, bit) << row.channel;
      }
    }
    EXPECT_TRUE(found) << row.unit << ' ' << row.channel;
  }
  for (const std::string_view name : moduleTypeNames())
    for (const bool is_remote : {false, true}) {
      const ModuleType* const type = findModuleType(name, is_remote);
      if (type == nullptr) continue;
      for (const Channel& channel : channelsAt0(*type))
        EXPECT_EQ(listed.count(std::string(name) + '.' + channel.name), 1u) << name << ' ' << channel.name;
    }
}

TEST(Modules, AreFoundByNameAndForm) {
  EXPECT_NE(findModuleType("ax_em_4ad", false), nullptr);
  EXPECT_EQ(findModuleType("AX_EM_5AD", false), nullptr);
  EXPECT_EQ(findModuleType("AE1420_AE2420", true), nullptr);  // not in the rack of a coupler
  Hsio hsio;
  EXPECT_EQ(simulate(*findModuleType("AX_EM_RCM_ET", false), 0, 0, hsio), nullptr);
}

// A module with its part of the image.
struct Bench {
  Bench(const char* name, bool is_remote) : type(*findModuleType(name, is_remote)), module(simulate(type, 0, 0, hsio)) {
    inputs.resize(module->inputSize());
    outputs.resize(module->outputSize());
  }

  Channel channel(const std::string& name) const {
    for (const Channel& one : channelsAt0(type))
      if (one.name == name) return one;
    ADD_FAILURE() << name;
    return {};
  }
  Terminal& wire(const std::string& name) {
    for (Terminal& one : module->terminals())
      if (one.name == name) return one;
    ADD_FAILURE() << name;
    return module->terminals()[0];
  }
  void set(const std::string& name, int value) {
    const Channel at = channel(name);
    memcpy(&outputs[at.byte], &value, bytesOf(at.type));
  }
  int get(const std::string& name) const {
    const Channel at = channel(name);
    int value = 0;
    memcpy(&value, &inputs[at.byte], bytesOf(at.type));
    return at.type == ChannelType::Int ? static_cast<int16_t>(value) : value;
  }
  float real(const std::string& name) const {
    float value = 0;
    memcpy(&value, &inputs[channel(name).byte], sizeof value);
    return value;
  }
  void write(int64_t now) { module->write(outputs.data(), now); }
  void read(int64_t now) { module->read(inputs.data(), now); }

  Hsio hsio;
  const ModuleType& type;
  std::unique_ptr<SimulatedModule> module;
  std::vector<uint8_t> inputs, outputs;
};

// ---- digital modules

TEST(Modules, FilterDigitalInputs) {
  for (const bool is_remote : {false, true}) {
    Bench di("AX_EM_1600D", is_remote);
    const char* const low = is_remote ? "InByte0" : "IB1";
    const char* const high = is_remote ? "InByte1" : "IB2";
    di.wire("X0").value = 15;  // not above 15 V
    di.wire("X7").value = 15.1;
    di.wire("X15").value = 24;
    di.read(0);
    di.read(9 * kMs);
    EXPECT_EQ(di.get(low), 0);
    di.read(10 * kMs);
    EXPECT_EQ(di.get(low), 0x80);
    EXPECT_EQ(di.get(high), 0x80);
    di.wire("X7").value = 5;  // not below 5 V: it stays
    di.wire("X15").value = 4.9;
    di.read(11 * kMs);
    di.read(30 * kMs);
    EXPECT_EQ(di.get(low), 0x80);
    EXPECT_EQ(di.get(high), 0);
    // A pulse shorter than the filter does not pass.
    di.wire("X0").value = 24;
    di.read(40 * kMs);
    di.wire("X0").value = 0;
    di.read(49 * kMs);
    di.read(70 * kMs);
    EXPECT_EQ(di.get(low), 0x80);
  }
}

TEST(Modules, DriveDigitalOutputs) {
  for (const char* const name : {"AX_EM_0016DP", "AX_EM_0016DN"})
    for (const bool is_remote : {false, true}) {
      Bench out(name, is_remote);
      out.set(is_remote ? "OutByte0" : "QB1", 0x01);
      out.set(is_remote ? "OutByte1" : "QB2", 0x80);
      out.write(0);
      for (int i = 0; i < 16; ++i) EXPECT_EQ(out.wire("Y" + std::to_string(i)).state, i == 0 || i == 15);
    }
}

TEST(Modules, CountDistributedPointsInOctal) {
  Bench io("AE1420_AE2420", false);
  EXPECT_EQ(io.inputs.size(), 4u);
  EXPECT_EQ(io.outputs.size(), 4u);
  io.wire("TX0").value = io.wire("TX37").value = 24;
  io.outputs[1] = 1;  // Y10
  io.write(0);
  io.read(0);
  EXPECT_EQ(io.inputs, (std::vector<uint8_t>{1, 0, 0, 0x80}));
  EXPECT_TRUE(io.wire("TY10").state);
  EXPECT_FALSE(io.wire("TY7").state);
}

// 4.2.4.5: quarters of a microsecond, up to 64 us.
TEST(Modules, FilterHighSpeedInputs) {
  for (const int setting : {0, 8, 255}) {
    Bench io("HIGH_PULSE_IO", false);
    io.set("Filt_Set", setting);
    io.write(0);
    io.wire("X0").value = io.wire("XF").value = 24;
    io.read(1000);
    const int64_t passes = 1000 + setting * 250;
    if (setting > 0) {
      io.read(passes - 1);
      EXPECT_EQ(io.get("Gpi_Value"), 0);
    }
    io.read(passes);
    EXPECT_EQ(io.get("Gpi_Value"), 0x8001);
  }
}

// 4.2.3: a port that gives pulses or compares does not follow GPO_Set.
TEST(Modules, DriveCommonHighSpeedOutputs) {
  Bench io("HIGH_PULSE_IO", false);
  io.set("GPO_Set", 0x83);
  io.set("Out1_Configure", 1);
  io.write(0);
  EXPECT_TRUE(io.wire("Y0").state);
  EXPECT_FALSE(io.wire("Y1").state);
  EXPECT_TRUE(io.wire("Y7").state);
}

TEST(Modules, ShowVersionsAsOctalNumbers) {
  Bench ad("AX_EM_4AD", false);
  ad.read(0);
  EXPECT_EQ(ad.get("Version_FPGA"), 0110);
  EXPECT_EQ(ad.get("Version_MCU"), 0110);
}

// ---- analog modules

struct AnalogMode {
  int code;
  double low, high;
  bool is_current;
};
constexpr AnalogMode kInputModes[] = {{0, 0, 5, false},   {1, 0, 10, false}, {2, -5, 5, false}, {3, -10, 10, false},
                                      {4, -20, 20, true}, {5, 0, 20, true},  {6, 4, 20, true}};
constexpr AnalogMode kOutputModes[] = {{0, 0, 5, false},    {1, 0, 10, false}, {2, -5, 5, false},
                                       {3, -10, 10, false}, {4, 4, 20, true},  {5, 0, 20, true}};

TEST(Modules, ScaleAnalogInputs) {
  for (const bool is_remote : {false, true})
    for (const AnalogMode& mode : kInputModes)
      for (int i = 0; i < 4; ++i) {
        Bench ad("AX_EM_4AD", is_remote);
        const std::string number = std::to_string(i), code = "IN" + number;
        Terminal& wire = ad.wire((mode.is_current ? "A" : "V") + number);
        const double middle = (mode.low + mode.high) / 2;
        ad.set("CH" + number, 1 | mode.code << 2);
        ad.write(0);
        int64_t now = 0;
        const auto shows = [&](double signal, double expected) {
          wire.value = signal;
          ad.read(now += 10 * kMs);
          ad.read(now += 10 * kMs);
          EXPECT_EQ(ad.get(code), std::lround(expected * 1000)) << mode.code << ' ' << signal;
        };
        shows(mode.low, mode.low);
        shows(mode.high, mode.high);
        shows(middle, middle);
        shows(mode.low - 1, mode.low);  // the code stays in the range
        shows(mode.high + 1, mode.high);
        ad.set("CH" + number, mode.code << 2);  // not enabled
        ad.write(now);
        shows(mode.high, 0);
      }
}

// Table 4-6.
TEST(Modules, TellFaultsOfRemoteAnalogInputs) {
  for (int i = 0; i < 4; ++i) {
    Bench ad("AX_EM_4AD", true);
    const std::string number = std::to_string(i), fault = "IN" + number + "_Fault_Code";
    int64_t now = 0;
    const auto tells = [&](int word, double volts, bool is_open, int expected) {
      ad.set("CH" + number, word);
      ad.wire("V" + number).value = volts;
      ad.wire("Open" + number).state = is_open;
      ad.write(now += kMs);
      ad.read(now += kMs);
      EXPECT_EQ(ad.get(fault), expected) << word << ' ' << volts;
    };
    const int bipolar = 3 << 2, all = 1 | 2 | 1 << 5 | 1 << 6 | bipolar;
    tells(all, 5, false, 0);
    tells(all, 5, true, 0xA0 + 4 * i);
    tells(all, 25.1, false, 0xA1 + 4 * i);
    tells(all, 25, false, 0xA2 + 4 * i);
    tells(all, 10, false, 0);
    tells(all, -10.1, false, 0xA3 + 4 * i);
    tells(1 | bipolar, 30, false, 0);  // not detected
    tells(1 | bipolar, 5, true, 0);
    tells(all & ~1, 30, true, 0);
  }
}

// FP0: a conversion takes 10 ms, and its result is the mean of the signal meanwhile.
TEST(Modules, FilterAnalogInputs) {
  for (const AnalogMode& mode : kInputModes) {
    Bench ad("AX_EM_4AD", false);
    Terminal& wire = ad.wire(mode.is_current ? "A0" : "V0");
    const double low = mode.low, high = mode.high;
    ad.set("FP0", 10);
    ad.set("CH0", 1 | mode.code << 2);
    wire.value = low;
    ad.write(0);
    const auto code = [&](double now_ms) {
      ad.read(static_cast<int64_t>(now_ms * kMs));
      return ad.get("IN0");
    };
    EXPECT_EQ(code(9), 0);
    EXPECT_EQ(code(10), std::lround(low * 1000));
    code(14);
    wire.value = high;  // from 14 ms on
    EXPECT_EQ(code(14), std::lround(low * 1000));
    EXPECT_EQ(code(19), std::lround(low * 1000));
    EXPECT_EQ(code(20), std::lround((0.4 * low + 0.6 * high) * 1000));
    EXPECT_EQ(code(30), std::lround(high * 1000));
    wire.value = low;
    EXPECT_EQ(code(30), std::lround(high * 1000));
    EXPECT_EQ(code(100), std::lround(low * 1000));
  }
}

// sinc3 ends in three conversions: the step response is 1/6, 5/6, 1.
TEST(Modules, SettleInThreeConversionsWithSinc3) {
  Bench ad("AX_EM_4AD", false);
  ad.set("FP", 2);
  ad.set("FP3", 20);
  ad.set("CH3", 1 | 1 << 2);
  ad.write(0);
  ad.read(60 * kMs);
  ad.wire("V3").value = 6;
  const int expected[] = {0, 1000, 5000, 6000};
  for (int i = 0; i < 4; ++i) {
    ad.read((60 + 20 * i) * kMs);
    EXPECT_EQ(ad.get("IN3"), expected[i]);
  }
}

// With the rejection of mains frequencies a conversion takes whole periods of both: a hum of 50 Hz vanishes.
TEST(Modules, RejectMainsFrequencies) {
  for (const double frequency : {50.0, 60.0}) {
    Bench ad("AX_EM_4AD", false);
    ad.set("FP", 1);
    ad.set("CH0", 1 | 3 << 2);
    ad.write(0);
    int code = 0;
    for (int i = 0; i <= 20000; ++i) {  // 10 us
      ad.wire("V0").value = 2 + std::sin(2 * M_PI * frequency * i * 1e-5);
      ad.read(i * int64_t{10'000});
      code = ad.get("IN0");
    }
    EXPECT_NEAR(code, 2000, 1);
  }
}

TEST(Modules, ScaleAnalogOutputs) {
  for (const bool is_remote : {false, true})
    for (const AnalogMode& mode : kOutputModes)
      for (int i = 0; i < 4; ++i) {
        Bench da("AX_EM_4DA", is_remote);
        const std::string number = std::to_string(i);
        const auto drives = [&](int code, double expected) {
          da.set("Data_CH" + number, code);
          da.write(0);
          EXPECT_DOUBLE_EQ(da.wire((mode.is_current ? "A" : "V") + number).value, expected) << mode.code;
          EXPECT_EQ(da.wire((mode.is_current ? "V" : "A") + number).value, 0);
        };
        const int low = static_cast<int>(mode.low * 1000), high = static_cast<int>(mode.high * 1000);
        drives(high, 0);  // not enabled
        da.set("Configuration_CH" + number, 1 | mode.code << 2);
        drives(low, mode.low);
        drives(high, mode.high);
        drives(low - 1, mode.low);
        drives(high + 1, mode.high);
      }
}

// Bits 5 and 6 of the channel word: clear, keep, preset.
TEST(Modules, LeaveAnalogOutputsAsSetWhenTheProgramStops) {
  Bench da("AX_EM_4DA", false);
  for (int i = 0; i < 3; ++i) {
    da.set("Configuration_CH" + std::to_string(i), 1 | 1 << 2 | i << 5);
    da.set("Data_CH" + std::to_string(i), 5000);
    da.set("Data_Default" + std::to_string(i), 2500);
  }
  da.write(0);
  const std::vector<uint8_t> safe(da.outputs.size());
  da.module->stopped();
  da.module->write(safe.data(), kMs);
  EXPECT_EQ(da.wire("V0").value, 0);
  EXPECT_EQ(da.wire("V1").value, 5);
  EXPECT_EQ(da.wire("V2").value, 2.5);
  da.write(2 * kMs);
  EXPECT_EQ(da.wire("V0").value, 5);
}

// Table 4-9.
TEST(Modules, TellFaultsOfRemoteAnalogOutputs) {
  for (int i = 0; i < 4; ++i) {
    Bench da("AX_EM_4DA", true);
    const std::string number = std::to_string(i), fault = "INT" + number + "_Fault_Code";
    const auto tells = [&](int mode, int expected) {
      da.set("Configuration_CH" + number, 1 | mode << 2);
      da.write(0);
      da.read(0);
      EXPECT_EQ(da.get(fault), expected);
    };
    tells(5, 0);
    da.wire("Open" + number).state = da.wire("Short" + number).state = true;
    tells(5, 0xB0 + 2 * i);
    tells(1, 0xB1 + 2 * i);
    da.wire("NoPower").state = true;
    tells(1, 0xB8);
    EXPECT_EQ(da.wire("V" + number).value, 0);
  }
}

// ---- temperature modules

// Table 4-11, by code: degrees Celsius, and Fahrenheit as the table prints them.
struct SensorRange {
  double low, high, low_f, high_f;
};
constexpr SensorRange kSensors[] = {{200, 1800, 392, 3272},   {-270, 1000, -454, 1832}, {-210, 1200, -346, 2192},
                                    {-270, 1370, -454, 2498}, {-200, 1300, -328, 2372}, {-50, 1765, -58, 3209},
                                    {-50, 1765, -58, 3209},   {-270, 400, -454, 752},   {-200, 850, -328, 1562},
                                    {-200, 850, -328, 1562},  {-200, 850, -328, 1562},  {-50, 150, -58, 302}};

TEST(Modules, ShowTemperaturesAtBothEndsOfEachRange) {
  for (int sensor = 0; sensor < 12; ++sensor)
    for (int i = 0; i < 4; ++i)
      for (const bool is_remote : {false, true})
        for (const bool fahrenheit : {false, true}) {
          Bench ptc("AX_EM_4PTC", is_remote);
          const std::string number = std::to_string(i);
          const int flags = 1 | (fahrenheit ? 2 : 0);
          if (is_remote) {
            // Channels 0 and 2 begin in the low byte of their first word, 1 and 3 in the high byte of their second.
            const int first = i / 2 * 3;
            if (i % 2 == 0) {
              ptc.set("Config_Word" + std::to_string(first), flags | sensor << 8);
            } else {
              ptc.set("Config_Word" + std::to_string(first + 1), flags << 8);
              ptc.set("Config_Word" + std::to_string(first + 2), sensor);
            }
            ptc.set("Config_Word6", 1 << 2 * i);
          } else {
            ptc.set("Basic_Set_" + number, flags);
            ptc.set("Sensor_type_" + number, sensor);
            ptc.set("Sampling_period_" + number, 1);
          }
          ptc.write(0);
          const SensorRange& range = kSensors[sensor];
          int64_t now = 0;
          const auto shows = [&](double celsius, double expected) {
            ptc.wire("T" + number).value = celsius;
            ptc.read(now += 250 * kMs);
            if (is_remote)
              EXPECT_EQ(ptc.get("Temperature" + number), std::lround(expected * 10)) << sensor;
            else
              EXPECT_FLOAT_EQ(ptc.real("Temperature" + number), static_cast<float>(expected)) << sensor;
          };
          ptc.read(now);
          shows(range.low, fahrenheit ? range.low_f : range.low);
          shows(range.high, fahrenheit ? range.high_f : range.high);
          shows(range.low - 10, fahrenheit ? range.low_f : range.low);
          shows(range.high + 10, fahrenheit ? range.high_f : range.high);
        }
}

TEST(Modules, SampleTemperaturesAtTheirPeriod) {
  const int64_t periods_ms[] = {250, 250, 500, 1000};
  for (int code = 1; code < 4; ++code) {
    Bench ptc("AX_EM_4PTC", false);
    ptc.set("Basic_Set_0", 1);
    ptc.set("Sensor_type_0", 8);
    ptc.set("Sampling_period_0", code);
    ptc.write(0);
    ptc.wire("T0").value = 20;
    ptc.read(0);
    EXPECT_EQ(ptc.real("Temperature0"), 20);
    ptc.wire("T0").value = 30;
    ptc.read(periods_ms[code] * kMs - 1);
    EXPECT_EQ(ptc.real("Temperature0"), 20);
    ptc.read(periods_ms[code] * kMs);
    EXPECT_EQ(ptc.real("Temperature0"), 30);
  }
}

// A lag of 2 s, sampled each second: after n samples the rest is exp(-n / 2).
TEST(Modules, SmoothTemperatures) {
  for (const bool is_remote : {false, true}) {
    Bench ptc("AX_EM_4PTC", is_remote);
    if (is_remote) {
      ptc.set("Config_Word0", 1 | 8 << 8);
      ptc.set("Config_Word1", 2);
      ptc.set("Config_Word6", 3);
    } else {
      ptc.set("Basic_Set_0", 1);
      ptc.set("Sensor_type_0", 8);
      ptc.set("Sampling_period_0", 3);
      ptc.set("Filtering_time_0", 2);
    }
    ptc.write(0);
    ptc.read(0);
    ptc.wire("T0").value = 100;
    for (int n = 1; n <= 4; ++n) {
      ptc.read(n * 1000 * kMs);
      const double expected = 100 * (1 - std::exp(-n / 2.0));
      if (is_remote)
        EXPECT_EQ(ptc.get("Temperature0"), std::lround(expected * 10));
      else
        EXPECT_NEAR(ptc.real("Temperature0"), expected, 1e-4);
    }
  }
}

TEST(Modules, FlagTemperaturesBeyondTheLimits) {
  Bench ptc("AX_EM_4PTC", false);
  ptc.set("Basic_Set_1", 1 | 1 << 4);
  ptc.set("Sensor_type_1", 3);
  ptc.set("Upper_value_1", 100);
  ptc.set("Lower_value_1", -20);
  ptc.write(0);
  int64_t now = 0;
  const auto flags = [&](double celsius, int expected) {
    ptc.wire("T1").value = celsius;
    ptc.read(now += 250 * kMs);
    EXPECT_EQ(ptc.get("Overrun1"), expected) << celsius;
  };
  flags(100, 0);
  flags(100.5, 1);
  flags(-20, 0);
  flags(-20.5, 2);
  ptc.set("Basic_Set_1", 1);
  ptc.write(now);
  flags(200, 0);
}

TEST(Modules, ShowColdJunctions) {
  Bench ptc("AX_EM_4PTC", false);
  ptc.wire("CJC_In").value = 31.5;
  ptc.wire("CJC_Out").value = 19.25;
  ptc.read(0);
  EXPECT_EQ(ptc.real("In_CJC"), 31.5f);
  EXPECT_EQ(ptc.real("Out_CJC"), 19.25f);
}

}  // namespace

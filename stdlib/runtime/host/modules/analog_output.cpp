// SPDX-License-Identifier: Apache-2.0
// Simulated analog outputs: AX_EM_4DA (AX 4.4, 4.6.4).
#include <algorithm>

#include "simulated.h"

namespace rung::host {
namespace {

constexpr uint32_t kOutputCount = 4;
constexpr double kOutputCodes = 1000;  // table 4-8

// Table 4-7, channel word.
constexpr uint32_t kOutputOn = 1 << 0, kOutputModeShift = 2, kOutputModeMask = 7, kAfterStopShift = 5,
                   kAfterStopMask = 3;
enum AfterStop : uint32_t { kClear, kKeep, kPreset };
struct OutputMode {
  int low, high;  // codes
  bool is_current;
};
constexpr OutputMode kNoOutput = {0, 0, false};
constexpr OutputMode kOutputModes[] = {{0, 5000, false},
                                       {0, 10000, false},
                                       {-5000, 5000, false},
                                       {-10000, 10000, false},
                                       {4000, 20000, true},
                                       {0, 20000, true},
                                       kNoOutput,
                                       kNoOutput};

class AnalogOutput final : public SimulatedModule {
 public:
  using SimulatedModule::SimulatedModule;

 private:
  uint32_t word(uint32_t channel) const { return output(words_, channel); }
  const OutputMode& mode(uint32_t channel) const {
    return kOutputModes[word(channel) >> kOutputModeShift & kOutputModeMask];
  }
  bool isOn(uint32_t channel) const { return (word(channel) & kOutputOn) != 0; }

  void clear(uint32_t channel) { volts_[channel].value = amperes_[channel].value = 0; }

  // A code beyond the range gives the end of the range.
  void drive(uint32_t channel, int code) {
    clear(channel);
    if (!isOn(channel)) return;
    const OutputMode& is = mode(channel);
    const double value = std::clamp(code, is.low, is.high) / kOutputCodes;
    if (is.is_current ? !open_[channel].state : !short_[channel].state)
      (is.is_current ? amperes_ : volts_)[channel].value = value;
  }

  void driveSignals(int64_t) override {
    for (uint32_t i = 0; i < kOutputCount; ++i) {
      if (no_power_->state)
        clear(i);
      else
        drive(i, signedOutput(codes_, i));
    }
  }

  // Bits 5 and 6 of each channel say what it gives; cleared, it has the safe value, which is 0 where the project has
  // none.
  void driveSafeSignals(const uint8_t* safe_outputs, int64_t) override {
    for (uint32_t i = 0; i < kOutputCount; ++i) {
      switch (word(i) >> kAfterStopShift & kAfterStopMask) {
        case kKeep: break;
        case kPreset: drive(i, signedOutput(presets_, i)); break;
        case kClear:
        default: drive(i, static_cast<int16_t>(valueOf(safe_outputs, codes_, i))); break;
      }
    }
  }

  // Table 4-9.
  uint32_t fault(uint32_t channel) {
    if (no_power_->state) return 0xB8;
    if (!isOn(channel)) return 0;
    if (mode(channel).is_current) return open_[channel].state ? 0xB0 + 2 * channel : 0;
    return short_[channel].state ? 0xB1 + 2 * channel : 0;
  }

  void readSignals(int64_t now_ns) override {
    // The power of all channels has one code.
    reportFault(no_power_fault_, no_power_->state ? 0xB8 : 0, now_ns);
    for (uint32_t i = 0; i < kOutputCount; ++i) {
      const uint32_t code = fault(i);
      reportFault(current_[i], no_power_->state ? 0 : code, now_ns);
      if (faults_.size > 0) input(faults_, i, code);
    }
  }
  void transferMemory(StateArchive& archive) override { archive.values(current_, no_power_fault_); }

  const Channels words_ = channels("Configuration_CH#"), codes_ = channels("Data_CH#");
  const Channels presets_ = channels("Data_Default#"), faults_ = channels("INT#_Fault_Code");
  Terminal *const volts_ = terminal("V#"), *const amperes_ = terminal("A#");
  Terminal *const open_ = terminal("Open#"), *const short_ = terminal("Short#"), *const no_power_ = terminal("NoPower");
  uint32_t current_[kOutputCount] = {}, no_power_fault_ = 0;  // faults
};

}  // namespace

std::unique_ptr<SimulatedModule> simulateAnalogOutput(const ModuleType& type, uint32_t inputs, uint32_t outputs) {
  return std::make_unique<AnalogOutput>(type, inputs, outputs);
}

}  // namespace rung::host

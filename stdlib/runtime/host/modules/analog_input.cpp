// SPDX-License-Identifier: Apache-2.0
// Simulated analog inputs: AX_EM_4AD (AX 4.4, 4.6.3).
#include <algorithm>
#include <cmath>

#include "simulated.h"

namespace rung::host {
namespace {

constexpr uint32_t kInputCount = 4;
constexpr double kInputCodes = 1000;  // table 4-5: of a volt or a milliampere
constexpr double kLimit = 25;         // table 4-6: beyond it a signal exceeds the limits

// Table 4-4, channel word.
constexpr uint32_t kInputOn = 1 << 0, kDetectsOpen = 1 << 1, kInputModeShift = 2, kInputModeMask = 7,
                   kFlagsLimit = 1 << 5, kDetectsRange = 1 << 6;
struct InputMode {
  double low, high;  // volts or milliamperes
  bool is_current;
};
constexpr InputMode kInputModes[] = {{0, 5, false},   {0, 10, false}, {-5, 5, false}, {-10, 10, false},
                                     {-20, 20, true}, {0, 20, true},  {4, 20, true},  {0, 0, false}};

// Table 4-4, filter of the chip.
enum FilterCode : uint32_t { kSinc5Sinc1, kMains, kSinc3 };
constexpr int64_t kConversionUnitNs = 1'000'000;
constexpr int64_t kMainsNs = 100 * kConversionUnitNs;  // whole periods of 50 Hz and of 60 Hz

// Results are means of the signal over a conversion; sinc3 weighs the last three.
struct Converter {
  double held = 0, sum = 0, results[3] = {};
  int64_t begun_ns = 0, at_ns = 0;
  bool has_result = false;

  void restart(double signal, int64_t now_ns) {
    *this = {};
    held = signal;
    begun_ns = at_ns = now_ns;
  }

  // The signal was `held` since the last call.
  double convert(double signal, FilterCode filter, int64_t conversion_ns, int64_t now_ns) {
    for (int steps = 0; now_ns - begun_ns >= conversion_ns && steps < 4; ++steps) {
      const int64_t end = begun_ns + conversion_ns;
      complete((sum + held * static_cast<double>(end - at_ns)) / static_cast<double>(conversion_ns));
      begun_ns = at_ns = end;
      // Further ones have the same result: the signal was constant.
      if (steps == 3) begun_ns = at_ns = now_ns - (now_ns - end) % conversion_ns;
    }
    sum += held * static_cast<double>(now_ns - at_ns);
    at_ns = now_ns;
    held = signal;
    return filter == kSinc3 ? (results[0] + 4 * results[1] + results[2]) / 6 : results[0];
  }

 private:
  void complete(double result) {
    results[2] = results[1];
    results[1] = results[0];
    results[0] = result;
    has_result = true;
    sum = 0;
  }
};

class AnalogInput final : public SimulatedModule {
 public:
  using SimulatedModule::SimulatedModule;

 private:
  uint32_t word(uint32_t channel) const { return output(words_, channel); }
  static const InputMode& modeOf(uint32_t word) { return kInputModes[word >> kInputModeShift & kInputModeMask]; }

  double signal(uint32_t channel, const InputMode& mode) {
    if (open_[channel].state) return 0;
    const double value = (mode.is_current ? amperes_ : volts_)[channel].value;
    return std::isfinite(value) ? value : 0;
  }

  FilterCode filter() const {
    const uint32_t code = output(filter_, 0) & 3;
    return code > kSinc3 ? kSinc5Sinc1 : static_cast<FilterCode>(code);
  }

  // FP0 to FP3 tell how long a conversion takes, in ms; 0 is 1.
  int64_t conversionNs(uint32_t channel) const {
    const int64_t own = times_.size == 0 ? 0 : output(times_, channel) * kConversionUnitNs;
    const int64_t time = std::max(own, kConversionUnitNs);
    return filter() == kMains ? (time + kMainsNs - 1) / kMainsNs * kMainsNs : time;
  }

  // Table 4-6, in the order in which one hides the others.
  uint32_t fault(uint32_t channel, uint32_t word, double signal) {
    const InputMode& mode = modeOf(word);
    const uint32_t first = 0xA0 + 4 * channel;
    if ((word & kInputOn) == 0) return 0;
    if ((word & kDetectsOpen) != 0 && open_[channel].state) return first;
    if ((word & kFlagsLimit) != 0 && std::fabs(signal) > kLimit) return first + 1;
    if ((word & kDetectsRange) != 0 && signal > mode.high) return first + 2;
    if ((word & kDetectsRange) != 0 && signal < mode.low) return first + 3;
    return 0;
  }

  void readSignals(int64_t now_ns) override {
    for (uint32_t i = 0; i < kInputCount; ++i) {
      const uint32_t setting = word(i);
      const InputMode& mode = modeOf(setting);
      const double at_wire = signal(i, mode);
      const double mean = converters_[i].convert(at_wire, filter(), conversionNs(i), now_ns);
      const bool is_valid = (setting & kInputOn) != 0 && converters_[i].has_result;
      const double shown = is_valid ? std::clamp(mean, mode.low, mode.high) : 0;
      input(codes_, i, static_cast<uint32_t>(std::lround(shown * kInputCodes)));
      reportFault(current_[i], fault(i, setting, at_wire), now_ns);
      if (faults_.size > 0) input(faults_, i, current_[i]);
    }
  }

  // A channel that gets another setting starts its conversions again.
  void driveSignals(int64_t now_ns) override {
    for (uint32_t i = 0; i < kInputCount; ++i) {
      const uint32_t setting = word(i) | output(filter_, 0) << 16;
      if (setting == settings_[i]) continue;
      settings_[i] = setting;
      converters_[i].restart(signal(i, modeOf(word(i))), now_ns);
    }
  }
  void driveSafeSignals(const uint8_t*, int64_t) override {}
  void transferMemory(StateArchive& archive) override { archive.values(converters_, settings_, current_); }

  const Channels words_ = channels("CH#"), filter_ = channels("FP"), times_ = channels("FP#");
  const Channels codes_ = channels("IN#"), faults_ = channels("IN#_Fault_Code");
  Terminal *const volts_ = terminal("V#"), *const amperes_ = terminal("A#"), *const open_ = terminal("Open#");
  Converter converters_[kInputCount];
  uint32_t settings_[kInputCount] = {}, current_[kInputCount] = {};  // faults
};

}  // namespace

std::unique_ptr<SimulatedModule> simulateAnalogInput(const ModuleType& type, uint32_t inputs, uint32_t outputs) {
  return std::make_unique<AnalogInput>(type, inputs, outputs);
}

}  // namespace rung::host

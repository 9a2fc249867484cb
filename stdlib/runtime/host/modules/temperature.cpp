// SPDX-License-Identifier: Apache-2.0
// Simulated temperature inputs: AX_EM_4PTC (AX 4.5, 4.6.5).
#include <algorithm>
#include <cmath>
#include <cstring>

#include "simulated.h"

namespace rung::host {
namespace {

constexpr uint32_t kSensorCount = 4;
constexpr int64_t kPeriodUnitNs = 1'000'000, kSecondNs = 1'000'000'000;
constexpr double kRemoteCodes = 10;  // of a degree: 16 bits hold -454.0 to 3272.0

// Table 4-11, by the codes of table 4-10, in degrees Celsius.
struct Range {
  double low, high;
};
constexpr Range kSensors[] = {{200, 1800}, {-270, 1000}, {-210, 1200}, {-270, 1370}, {-200, 1300}, {-50, 1765},
                              {-50, 1765}, {-270, 400},  {-200, 850},  {-200, 850},  {-200, 850},  {-50, 150}};
constexpr int64_t kPeriodsMs[] = {250, 250, 500, 1000};  // 0 is not a code: the shortest

constexpr uint32_t kSensorOn = 1 << 0, kFahrenheit = 1 << 1, kLimits = 1 << 4;
constexpr uint32_t kOverrunAbove = 1, kOverrunBelow = 2;  // Overrun

struct Setting {
  uint32_t flags, sensor, period, lag;

  bool operator==(const Setting& other) const {
    return flags == other.flags && sensor == other.sensor && period == other.period && lag == other.lag;
  }
};

// Sampled at a period and smoothed by a lag of the first order.
struct Sampler {
  bool is_first = true;
  double value = 0;
  int64_t next_ns = 0;

  double sample(double signal, int64_t period_ns, int64_t lag_ns, int64_t now_ns) {
    if (is_first) {
      value = signal;
      next_ns = now_ns + period_ns;
      is_first = false;
    }
    if (now_ns < next_ns) return value;
    const int64_t periods = (now_ns - next_ns) / period_ns + 1;
    next_ns += periods * period_ns;
    const double time = static_cast<double>(periods * period_ns);
    value += (signal - value) * (lag_ns == 0 ? 1 : 1 - std::exp(-time / static_cast<double>(lag_ns)));
    return value;
  }
};

class Temperature final : public SimulatedModule {
 public:
  using SimulatedModule::SimulatedModule;

 private:
  bool isRemote() const { return type().has_station; }

  // Table 4-10: two channels share three words, Config_Word0 to 2 and 3 to 5.
  Setting packedSetting(uint32_t channel) const {
    const uint32_t first = channel / 2 * 3;
    const uint32_t a = output(words_, first), b = output(words_, first + 1), c = output(words_, first + 2);
    const uint32_t period = output(words_, 6) >> 2 * channel & 3;
    if (channel % 2 == 0) return {a & 31, a >> 8 & 15, period, b & 127};
    return {b >> 8 & 31, c & 15, period, c >> 8 & 127};
  }

  Setting setting(uint32_t i) const {
    if (isRemote()) return packedSetting(i);
    return {output(flags_, i), output(types_, i), output(periods_, i) & 3, output(lags_, i)};
  }

  static double shown(double celsius, const Setting& is) {
    const Range& range = kSensors[std::min<size_t>(is.sensor, std::size(kSensors) - 1)];
    const double value = std::isfinite(celsius) ? std::clamp(celsius, range.low, range.high) : range.low;
    return (is.flags & kFahrenheit) != 0 ? value * 1.8 + 32 : value;
  }

  void real(Channels of, uint32_t index, double value) {
    const auto single = static_cast<float>(value);
    uint32_t bits = 0;
    memcpy(&bits, &single, sizeof bits);
    input(of, index, bits);
  }

  uint32_t overrun(uint32_t channel, const Setting& is, double value) const {
    if ((is.flags & kSensorOn) == 0 || (is.flags & kLimits) == 0) return 0;
    if (value > signedOutput(upper_, channel)) return kOverrunAbove;
    return value < signedOutput(lower_, channel) ? kOverrunBelow : 0;
  }

  void readSignals(int64_t now_ns) override {
    for (uint32_t i = 0; i < kSensorCount; ++i) {
      const Setting is = setting(i);
      const bool is_on = (is.flags & kSensorOn) != 0;
      double value = 0;
      if (is_on) {
        const int64_t lag_ns = std::min(is.lag, 100u) * kSecondNs;
        value =
            samplers_[i].sample(shown(sensors_[i].value, is), kPeriodsMs[is.period] * kPeriodUnitNs, lag_ns, now_ns);
      }
      if (isRemote()) {
        input(values_, i, static_cast<uint32_t>(std::lround(value * kRemoteCodes)));
      } else {
        real(values_, i, value);
        input(overruns_, i, overrun(i, is, value));
      }
    }
    if (isRemote()) return;
    real(inner_, 0, inner_wire_->value);
    real(outer_, 0, outer_wire_->value);
  }

  // A channel that gets another setting begins with the next sample.
  void driveSignals(int64_t) override {
    for (uint32_t i = 0; i < kSensorCount; ++i) {
      const Setting is = setting(i);
      if (is == settings_[i]) continue;
      settings_[i] = is;
      samplers_[i] = {};
    }
  }
  void driveSafeSignals(const uint8_t*, int64_t) override {}
  void transferMemory(StateArchive& archive) override { archive.values(samplers_, settings_); }

  const Channels words_ = channels("Config_Word#");  // of the remote form; the next ones of the local form
  const Channels flags_ = channels("Basic_Set_#"), types_ = channels("Sensor_type_#");
  const Channels periods_ = channels("Sampling_period_#"), lags_ = channels("Filtering_time_#");
  const Channels upper_ = channels("Upper_value_#"), lower_ = channels("Lower_value_#");
  const Channels overruns_ = channels("Overrun#"), inner_ = channels("In_CJC"), outer_ = channels("Out_CJC");
  const Channels values_ = channels("Temperature#");
  const Terminal *const sensors_ = terminal("T#"), *const inner_wire_ = terminal("CJC_In"),
                        *const outer_wire_ = terminal("CJC_Out");
  Sampler samplers_[kSensorCount];
  Setting settings_[kSensorCount] = {};
};

}  // namespace

std::unique_ptr<SimulatedModule> simulateTemperature(const ModuleType& type, uint32_t inputs, uint32_t outputs) {
  return std::make_unique<Temperature>(type, inputs, outputs);
}

}  // namespace rung::host

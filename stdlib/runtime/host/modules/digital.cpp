// Simulated digital inputs and outputs: AX_EM_1600D, AX_EM_0016DP and DN (AX 4.3, 4.6), AE1420_AE2420 (4.7) and the
// common inputs and outputs of HIGH_PULSE_IO (4.2).
#include "simulated.h"

namespace rung::host {
namespace {

constexpr double kOnVolts = 15, kOffVolts = 5;   // table 6-1; in between the level stays
constexpr int64_t kModuleFilterNs = 10'000'000;  // table 6-1: port filter time
constexpr int64_t kHighSpeedFilterUnitNs = 250;  // 4.2.4.5: Filt_Set counts quarters of a microsecond
constexpr uint32_t kCommon = 0;                  // function of a port (4.2.2)

// A level that counts when the input has had it for the time of the filter.
struct Filter {
  bool raw = false, level = false;
  int64_t since_ns = 0;

  bool pass(double volts, int64_t time_ns, int64_t now_ns) {
    const bool is_on = raw ? volts >= kOffVolts : volts > kOnVolts;
    if (is_on != raw) {
      raw = is_on;
      since_ns = now_ns;
    }
    if (raw != level && now_ns - since_ns >= time_ns) level = raw;
    return level;
  }
};

class Digital final : public SimulatedModule {
 public:
  Digital(const ModuleType& type, uint32_t inputs, uint32_t outputs) : SimulatedModule(type, inputs, outputs) {
    for (uint32_t row = 0; row < type.terminal_count; ++row) {
      const TerminalRow& wires = type.terminals[row];
      (wires.is_output ? driven_ : sensed_) = terminal(wires.name.name);
      if (wires.is_output)
        driven_count_ = wires.name.count;
      else
        filters_.resize(wires.name.count);
    }
  }

 private:
  bool isHighSpeed() const { return type().simulation == Simulation::HighSpeed; }

  int64_t filterNs() const {
    if (isHighSpeed()) return output(filter_, 0) * kHighSpeedFilterUnitNs;
    return type().simulation == Simulation::DigitalInput ? kModuleFilterNs : 0;
  }

  void readSignals(int64_t now_ns) override {
    const int64_t filter_ns = filterNs();
    for (uint32_t i = 0; i < filters_.size(); i += 8) {
      uint32_t byte = 0;
      for (uint32_t bit = 0; bit < 8; ++bit)
        byte |= static_cast<uint32_t>(filters_[i + bit].pass(sensed_[i + bit].value, filter_ns, now_ns)) << bit;
      input(levels_, i / 8, byte);
    }
  }

  // A port of HIGH_PULSE_IO that has another function does not follow GPO_Set.
  bool isCommon(uint32_t port) const { return !isHighSpeed() || output(functions_, port) == kCommon; }

  void driveSignals(int64_t) override {
    for (uint32_t i = 0; i < driven_count_; ++i) drive(i, output(states_, i / 8));
  }
  void driveSafeSignals(const uint8_t* safe_outputs) override {
    for (uint32_t i = 0; i < driven_count_; ++i) drive(i, valueOf(safe_outputs, states_, i / 8));
  }
  void drive(uint32_t port, uint32_t byte) {
    if (isCommon(port)) driven_[port].state = (byte >> port % 8 & 1) != 0;
  }

  // The bytes of the levels are the first inputs, and those of the states the first outputs, but of HIGH_PULSE_IO.
  const Channels levels_ = {0, 1};
  const Channels states_ = {channels("GPO_Set").byte, 1};
  const Channels filter_ = channels("Filt_Set"), functions_ = channels("Out#_Configure");
  Terminal *sensed_ = nullptr, *driven_ = nullptr;
  std::vector<Filter> filters_;
  uint32_t driven_count_ = 0;
};

}  // namespace

std::unique_ptr<SimulatedModule> simulateDigital(const ModuleType& type, uint32_t inputs, uint32_t outputs) {
  return std::make_unique<Digital>(type, inputs, outputs);
}

}  // namespace rung::host

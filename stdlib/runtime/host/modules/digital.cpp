// SPDX-License-Identifier: Apache-2.0
// Simulated digital inputs and outputs: AX_EM_1600D, AX_EM_0016DP and DN (AX 4.3, 4.6), AE1420_AE2420 (4.7).
#include "simulated.h"

namespace rung::host {
namespace {

constexpr int64_t kModuleFilterNs = 10'000'000;  // table 6-1: port filter time

// A level that counts when the input has had it for the time of the filter.
struct Filter {
  bool raw = false, level = false;
  int64_t since_ns = 0;

  bool pass(double volts, int64_t time_ns, int64_t now_ns) {
    const bool is_on = levelOf(volts, raw);
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
  void readSignals(int64_t now_ns) override {
    const int64_t filter_ns = type().simulation == Simulation::DigitalInput ? kModuleFilterNs : 0;
    for (uint32_t i = 0; i < filters_.size(); i += 8) {
      uint32_t byte = 0;
      for (uint32_t bit = 0; bit < 8; ++bit)
        byte |= static_cast<uint32_t>(filters_[i + bit].pass(sensed_[i + bit].value, filter_ns, now_ns)) << bit;
      input(levels_, i / 8, byte);
    }
  }

  void driveSignals(int64_t) override {
    for (uint32_t i = 0; i < driven_count_; ++i) drive(i, output(states_, i / 8));
  }
  void driveSafeSignals(const uint8_t* safe_outputs, int64_t) override {
    for (uint32_t i = 0; i < driven_count_; ++i) drive(i, valueOf(safe_outputs, states_, i / 8));
  }
  void transferMemory(StateArchive& archive) override { archive.list(filters_); }
  void drive(uint32_t port, uint32_t byte) { driven_[port].state = (byte >> port % 8 & 1) != 0; }

  const Channels levels_ = {0, 1}, states_ = {0, 1};  // bytes: the first channels
  Terminal *sensed_ = nullptr, *driven_ = nullptr;
  std::vector<Filter> filters_;
  uint32_t driven_count_ = 0;
};

}  // namespace

std::unique_ptr<SimulatedModule> simulateDigital(const ModuleType& type, uint32_t inputs, uint32_t outputs) {
  return std::make_unique<Digital>(type, inputs, outputs);
}

}  // namespace rung::host

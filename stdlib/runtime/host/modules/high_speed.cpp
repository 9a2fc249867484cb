// SPDX-License-Identifier: Apache-2.0
// HIGH_PULSE_IO (AX 4.2): the view of the simulated counter unit (hsio.h) in the image. Its terminals are the common
// inputs and the outputs.
#include "../hsio.h"
#include "simulated.h"

namespace rung::host {
namespace {

class HighSpeed final : public SimulatedModule {
 public:
  HighSpeed(const ModuleType& type, uint32_t inputs, uint32_t outputs, Hsio& hsio)
      : SimulatedModule(type, inputs, outputs), hsio_(hsio) {}

 private:
  void readSignals(int64_t now_ns) override {
    for (uint32_t i = 0; i < RUNG_HSIO_INPUTS; ++i) {
      const bool level = levelOf(inputs_[i].value, levels_[i]);
      if (level == levels_[i]) continue;
      levels_[i] = level;
      hsio_.write(RUNG_HSIO_LEVEL, i, level ? 1 : 0, now_ns);
    }
    uint8_t image[RUNG_HSIO_IMAGE_INPUTS];
    hsio_.readImage(image, now_ns);
    for (uint32_t i = 0; i < RUNG_HSIO_IMAGE_INPUTS; ++i) input({0, 1}, i, image[i]);
    showOutputs(now_ns);
  }

  void driveSignals(int64_t now_ns) override {
    hsio_.writeImage(outputBytes(), now_ns);
    showOutputs(now_ns);
  }

  // Its settings stay; the common outputs take the safe values.
  void driveSafeSignals(const uint8_t* safe_outputs, int64_t now_ns) override {
    const uint32_t safe = valueOf(safe_outputs, common_, 0);
    for (uint32_t i = 0; i < RUNG_HSIO_OUTPUTS; ++i)
      if (output(functions_, i) == 0) hsio_.write(RUNG_HSIO_OUTPUT_LEVEL, i, safe >> i & 1, now_ns);
    showOutputs(now_ns);
  }
  void transferMemory(StateArchive& archive) override { archive.value(levels_); }

  void showOutputs(int64_t now_ns) {
    for (uint32_t i = 0; i < RUNG_HSIO_OUTPUTS; ++i)
      outputs_[i].state = hsio_.read(RUNG_HSIO_OUTPUT_LEVEL, i, now_ns) != 0;
  }

  Hsio& hsio_;
  const Channels common_ = channels("GPO_Set"), functions_ = channels("Out#_Configure");
  Terminal *const inputs_ = terminal("X#"), *const outputs_ = terminal("Y#");
  bool levels_[RUNG_HSIO_INPUTS] = {};
};

}  // namespace

std::unique_ptr<SimulatedModule> simulateHighSpeed(const ModuleType& type, uint32_t inputs, uint32_t outputs,
                                                   Hsio& hsio) {
  return std::make_unique<HighSpeed>(type, inputs, outputs, hsio);
}

}  // namespace rung::host

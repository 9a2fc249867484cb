// SPDX-License-Identifier: Apache-2.0
// Simulated high-speed inputs and outputs (rung/hsio.h): the model that rung_host.hsio reaches, with signals that
// programs and tests describe. In: registers, and the program's time. Out: registers, and interrupts at the times at
// which they occur. Calls may come from several tasks. Called by session.cpp and schedule.cpp.
#pragma once

#include <mutex>

#include "rung/hsio.h"
#include "state_archive.h"

namespace rung::host {

class Hsio {
 public:
  Hsio() { reset(); }
  // As it is when it is switched on.
  void reset();
  void transfer(StateArchive& archive);

  void serve(rung_host& host);

  // Lets time pass to `until_ns`, or to the first interrupt. Returns where it stopped; `interrupts` are those that
  // occurred since the last call.
  int64_t advance(int64_t until_ns, uint32_t& interrupts);

  // Registers of rung/hsio.h.
  int64_t read(uint32_t item, uint32_t index, int64_t now_ns);
  bool write(uint32_t item, uint32_t index, int64_t value, int64_t now_ns);

  // The device HIGH_PULSE_IO: its inputs and outputs in the image.
  void readImage(uint8_t* inputs, int64_t now_ns);
  void writeImage(const uint8_t* outputs, int64_t now_ns);

 private:
  static int64_t onRead(void* data, uint32_t item, uint32_t index, int64_t now_ns);
  static bool onWrite(void* data, uint32_t item, uint32_t index, int64_t value, int64_t now_ns);
  void catchUp(int64_t now_ns);

  std::mutex mutex_;  // guards all
  rung_hsio_model model_;
  bool is_used_ = false;  // something was written: time matters
  uint32_t pending_ = 0;  // interrupts that were not asked for yet
};

}  // namespace rung::host

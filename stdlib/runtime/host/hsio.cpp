// SPDX-License-Identifier: Apache-2.0
// Simulated high-speed inputs and outputs: see hsio.h.
#include "hsio.h"

namespace rung::host {

void Hsio::serve(rung_host& host) {
  static constexpr rung_hsio kRegisters = {onRead, onWrite};
  host.hsio = &kRegisters;
  host.hsio_data = this;
}

void Hsio::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  rung_hsio_reset(&model_, true);
  is_used_ = false;
  pending_ = 0;
}

void Hsio::transfer(StateArchive& archive) {
  const std::lock_guard<std::mutex> lock(mutex_);
  archive.values(model_, is_used_, pending_);
}

void Hsio::catchUp(int64_t now_ns) {
  do {
    rung_hsio_advance(&model_, now_ns);
    pending_ |= rung_hsio_take_interrupts(&model_);
  } while (model_.now < now_ns);
}

int64_t Hsio::advance(int64_t until_ns, uint32_t& interrupts) {
  const std::lock_guard<std::mutex> lock(mutex_);
  interrupts = 0;
  if (!is_used_) return until_ns;
  if (pending_ == 0) {
    rung_hsio_advance(&model_, until_ns);
    pending_ = rung_hsio_take_interrupts(&model_);
  }
  interrupts = pending_;
  pending_ = 0;
  return model_.now;
}

int64_t Hsio::read(uint32_t item, uint32_t index, int64_t now_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  catchUp(now_ns);
  return rung_hsio_read(&model_, item, index);
}

bool Hsio::write(uint32_t item, uint32_t index, int64_t value, int64_t now_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  catchUp(now_ns);
  is_used_ = true;
  const bool done = rung_hsio_write(&model_, item, index, value);
  pending_ |= rung_hsio_take_interrupts(&model_);
  return done;
}

int64_t Hsio::onRead(void* data, uint32_t item, uint32_t index, int64_t now_ns) {
  return static_cast<Hsio*>(data)->read(item, index, now_ns);
}

bool Hsio::onWrite(void* data, uint32_t item, uint32_t index, int64_t value, int64_t now_ns) {
  return static_cast<Hsio*>(data)->write(item, index, value, now_ns);
}

void Hsio::readImage(uint8_t* inputs, int64_t now_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  catchUp(now_ns);
  rung_hsio_image_read(&model_, inputs);
}

void Hsio::writeImage(const uint8_t* outputs, int64_t now_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  catchUp(now_ns);
  is_used_ = true;
  rung_hsio_image_write(&model_, outputs);
  pending_ |= rung_hsio_take_interrupts(&model_);
}

}  // namespace rung::host

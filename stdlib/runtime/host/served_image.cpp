// SPDX-License-Identifier: Apache-2.0
// The copy of the image for Modbus masters: see served_image.h.
#include "served_image.h"

#include <algorithm>
#include <cstring>
#include <mutex>

namespace rung::host {
namespace {

constexpr uint32_t kFunction = 7;  // in a frame over TCP

// Tells whether a request with this function code may write.
bool mayWrite(uint8_t function) { return function >= 5; }

}  // namespace

ServedImage::ServedImage(const LoadedModule& module)
    : module_(&module),
      inputs_{0, std::vector<uint8_t>(RUNG_MODBUS_INPUT_BYTES), {}},
      outputs_{1, std::vector<uint8_t>(RUNG_MODBUS_OUTPUT_BYTES), std::vector<uint8_t>(RUNG_MODBUS_OUTPUT_BYTES)},
      memory_{2, std::vector<uint8_t>(RUNG_MODBUS_MEMORY_BYTES), std::vector<uint8_t>(RUNG_MODBUS_MEMORY_BYTES)} {}

void ServedImage::reset() {
  is_used_.store(false);
  is_ready_.store(false);
  has_written_ = false;
  for (Part* const part : {&inputs_, &outputs_, &memory_}) {
    std::fill(part->bytes.begin(), part->bytes.end(), uint8_t{0});
    std::fill(part->written.begin(), part->written.end(), uint8_t{0});
  }
}

void ServedImage::transfer(StateArchive& archive) {
  bool is_used = is_used_.load(), is_ready = is_ready_.load();
  archive.values(is_used, is_ready);
  if (archive.isRestoring()) reset();
  is_used_.store(is_used);
  is_ready_.store(is_ready);
  if (!is_used) return;
  const std::lock_guard<PriorityMutex> lock(mutex_);
  archive.value(has_written_);
  for (Part* const part : {&inputs_, &outputs_, &memory_}) {
    archive.list(part->bytes);
    archive.list(part->written);
  }
}

void ServedImage::applyWritten(Part& part, uint8_t* common, uint32_t size) const {
  for (uint32_t i = 0; i < size; ++i) {
    const uint8_t mask = part.written[i];
    if (mask != 0) common[i] = static_cast<uint8_t>((common[i] & ~mask) | (part.bytes[i] & mask));
  }
  std::fill(part.written.begin(), part.written.end(), uint8_t{0});
}

void ServedImage::exchange(uint8_t* const* areas, void (*force)(void* data), void* data) {
  if (!is_used_.load(std::memory_order_relaxed)) return;
  const std::lock_guard<PriorityMutex> lock(mutex_);
  const auto sizeOf = [&](const Part& part) {
    return std::min(static_cast<uint32_t>(part.bytes.size()), module_.load()->areas[part.area].size);
  };
  if (has_written_)
    for (Part* const part : {&outputs_, &memory_}) applyWritten(*part, areas[part->area], sizeOf(*part));
  if (force != nullptr) force(data);
  for (Part* const part : {&inputs_, &outputs_, &memory_})
    std::copy_n(areas[part->area], sizeOf(*part), part->bytes.begin());
  has_written_ = false;
  is_ready_.store(true);
}

void ServedImage::setRegisters(Server& server, const void* values, uint32_t bytes) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  memcpy(server.registers, values, bytes);
  server.register_count = bytes / 2;
}

rung_modbus_image ServedImage::imageOf(const Server& server) {
  return {{inputs_.bytes.data(), nullptr},
          {outputs_.bytes.data(), outputs_.written.data()},
          {memory_.bytes.data(), memory_.written.data()},
          server.registers,
          server.register_count};
}

uint32_t ServedImage::answerTcp(const Server& server, const uint8_t* frame, uint8_t* reply) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  const rung_modbus_image image = imageOf(server);
  has_written_ = has_written_ || mayWrite(frame[kFunction]);
  return rung_modbus_answer_tcp(&image, server.unit, frame, reply);
}

uint32_t ServedImage::answerRtu(const Server& server, const uint8_t* frame, uint32_t size, uint8_t* reply) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  const rung_modbus_image image = imageOf(server);
  has_written_ = has_written_ || mayWrite(frame[1]);
  return rung_modbus_answer_rtu(&image, server.unit, frame, size, reply);
}

}  // namespace rung::host

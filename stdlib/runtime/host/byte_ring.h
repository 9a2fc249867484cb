// SPDX-License-Identifier: Apache-2.0
// A queue of bytes of fixed capacity: what a channel has received, and what it has yet to send. Datagrams are in it
// with a header each. One lock of its owner guards it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>

namespace rung::host {

class ByteRing {
 public:
  void allocate(uint32_t capacity) {
    if (capacity_ != capacity) bytes_ = std::make_unique<uint8_t[]>(capacity);
    capacity_ = capacity;
    clear();
  }
  void clear() { begin_ = size_ = 0; }
  uint32_t size() const { return size_; }
  uint32_t room() const { return capacity_ - size_; }

  // The caller has looked at room().
  void append(const void* from, uint32_t count) {
    const auto* source = static_cast<const uint8_t*>(from);
    const uint32_t end = (begin_ + size_) % std::max(1u, capacity_), first = std::min(count, capacity_ - end);
    memcpy(bytes_.get() + end, source, first);
    memcpy(bytes_.get(), source + first, count - first);
    size_ += count;
  }
  // Copies without removing; the caller has looked at size().
  void peek(uint32_t at, void* to, uint32_t count) const {
    const uint32_t from = (begin_ + at) % std::max(1u, capacity_), first = std::min(count, capacity_ - from);
    memcpy(to, bytes_.get() + from, first);
    memcpy(static_cast<uint8_t*>(to) + first, bytes_.get(), count - first);
  }
  void remove(uint32_t count) {
    begin_ = (begin_ + count) % std::max(1u, capacity_);
    size_ -= count;
  }

 private:
  std::unique_ptr<uint8_t[]> bytes_;
  uint32_t capacity_ = 0, begin_ = 0, size_ = 0;
};

inline constexpr uint32_t kStreamBytes = 16 * 1024;  // of a channel, in each direction
inline constexpr uint32_t kMaxDatagram = 65507;

// In front of each datagram.
struct DatagramHeader {
  uint32_t address;
  uint16_t port, size;
};

}  // namespace rung::host

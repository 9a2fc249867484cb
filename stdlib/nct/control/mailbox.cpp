// SPDX-License-Identifier: Apache-2.0
// EtherCAT mailboxes of simulated devices: see mailbox.h.
#include "mailbox.h"

#include <algorithm>

#include "rung/nc.h"

namespace rung::nct {
namespace {

constexpr Code kNoDevice = 200, kNoProtocol = 201, kMailLength = 202, kReadTimeout = 203, kWriteTimeout = 204,
               kDeviceError = 205;
constexpr uint32_t kCoe = 3, kSoe = 5, kVoe = 15, kElements = 8;
constexpr uint64_t kTimeoutCycles = 10;
// Abort codes of CoE, error codes of SoE.
constexpr uint32_t kNoAccess = 0x06010000, kNoObject = 0x06020000, kNoSubIndex = 0x06090011, kWrongSize = 0x06070010,
                   kNoIdn = 0x1001, kTooShort = 0x7002, kTooLong = 0x7003;

uint32_t sizeOf(const std::vector<std::vector<uint8_t>*>& selected) {
  size_t size = 0;
  for (const auto* bytes : selected) size += bytes->size();
  return static_cast<uint32_t>(size);
}

// The device's error, in its word where the block has one.
Code fail(Block& block, uint32_t error) {
  if (block.amount() >= 6) block.put(7, error);
  return error == 0 ? kDone : kDeviceError;
}

}  // namespace

uint64_t Mailbox::keyOf(uint32_t protocol, uint32_t object, uint32_t element) {
  // Index first, so that the objects of an index follow each other.
  const uint64_t index = object & 0xFFFF, part = object >> 16 & 0xFF;
  return uint64_t{protocol} << 32 | index << 16 | part << 8 | element;
}

// The amount tells the form: VoE 4; CoE 5, 6 with an error, 7 with CompleteAccess; SoE 7.
Code Mailbox::check(const Block& block, uint32_t first_address) const {
  const uint32_t amount = block.amount();
  if (amount < 4 || amount > 7) return kWrongAmount;
  const uint32_t protocol = block.word(2);
  const bool fits =
      (protocol == kVoe && amount == 4) || (protocol == kCoe && amount >= 5) || (protocol == kSoe && amount == 7);
  if (!fits) return kWrongAmount;
  const auto device = devices_.find(block.word(3));
  if (device == devices_.end()) return kNoDevice;
  if (device->second.protocols.count(protocol) == 0) return kNoProtocol;
  const uint32_t length = block.word(4), address = block.word(5);
  if (length < 1 || length > 4 * RUNG_NC_WORDS) return kMailLength;
  return address < first_address || address > RUNG_NC_WORDS - (length + 3) / 4 ? kMailLength : kDone;
}

// The objects of a device that the block names, in the order of their bytes; returns the device's error.
uint32_t Mailbox::select(const Block& block, Device& device, std::vector<Bytes*>& selected) {
  const uint32_t protocol = block.word(2), object = protocol == kVoe ? 0 : block.word(6);
  const auto take = [&](uint32_t of, uint32_t element) {
    const auto at = device.objects.find(keyOf(protocol, of, element));
    if (at != device.objects.end()) selected.push_back(&at->second);
    return at != device.objects.end();
  };
  if (protocol == kVoe) {
    selected.push_back(&device.objects[keyOf(kVoe, 0, 0)]);
    return 0;
  }
  if (protocol == kSoe) {
    for (uint32_t element = 0; element < kElements; ++element)
      if ((block.word(8) >> element & 1) != 0 && !take(object, element)) return kNoIdn;
    return selected.empty() ? kNoIdn : 0;
  }
  const uint32_t index = object & 0xFFFF, sub_index = object >> 16 & 0xFF;
  const auto first = device.objects.lower_bound(keyOf(kCoe, index, 0));
  const auto end = device.objects.upper_bound(keyOf(kCoe, index | 0xFF0000, 0));
  if (first == end) return kNoObject;
  const bool is_complete = block.amount() == 7 && block.word(8) != 0;
  if (!is_complete) return take(object, 0) ? 0 : kNoSubIndex;
  if (sub_index > 1) return kNoAccess;
  for (auto at = device.objects.lower_bound(keyOf(kCoe, object, 0)); at != end; ++at) selected.push_back(&at->second);
  return selected.empty() ? kNoSubIndex : 0;
}

// Bytes that the device does not give are 0, up to the end of the last word.
Code Mailbox::read(Block& block, uint32_t* memory, uint64_t waited) const {
  if (const Code code = check(block, kFirstKept); code != kDone) return code;
  Device& device = devices_[block.word(3)];
  if (device.times_out) return waited < kTimeoutCycles ? kBusy : kReadTimeout;
  std::vector<Bytes*> selected;
  const uint32_t error = device.error != 0 ? device.error : select(block, device, selected);
  if (error != 0) return fail(block, error);
  const uint32_t length = block.word(4);
  if (sizeOf(selected) > length) return kMailLength;
  std::fill_n(memory + block.word(5), (length + 3) / 4, 0u);
  uint32_t at = 0;
  for (const Bytes* bytes : selected)
    for (const uint8_t byte : *bytes) {
      memory[block.word(5) + at / 4] |= uint32_t{byte} << (at % 4 * 8);
      ++at;
    }
  return fail(block, 0);
}

Code Mailbox::write(Block& block, const uint32_t* memory, uint64_t waited) {
  if (const Code code = check(block, kFirstSent); code != kDone) return code;
  Device& device = devices_[block.word(3)];
  if (device.times_out) return waited < kTimeoutCycles ? kBusy : kWriteTimeout;
  std::vector<Bytes*> selected;
  const uint32_t protocol = block.word(2), length = block.word(4);
  uint32_t error = device.error != 0 ? device.error : select(block, device, selected);
  if (error == 0 && protocol == kVoe) selected[0]->resize(length);
  if (error == 0 && sizeOf(selected) != length)
    error = protocol == kCoe ? kWrongSize : length < sizeOf(selected) ? kTooShort : kTooLong;
  if (error != 0) return fail(block, error);
  uint32_t at = 0;
  for (Bytes* bytes : selected)
    for (uint8_t& byte : *bytes) {
      byte = static_cast<uint8_t>(memory[block.word(5) + at / 4] >> (at % 4 * 8));
      ++at;
    }
  return fail(block, 0);
}

// ---- what a test sets up

bool Mailbox::setDevice(uint32_t index, uint32_t protocol, bool exists) {
  if (!exists) return devices_.erase(index) != 0;
  if (protocol != kVoe && protocol != kCoe && protocol != kSoe) return false;
  devices_[index].protocols.insert(protocol);
  return true;
}

bool Mailbox::setError(uint32_t index, uint32_t error, bool times_out) {
  const auto at = devices_.find(index);
  if (at == devices_.end()) return false;
  at->second.error = error;
  at->second.times_out = times_out;
  return true;
}

bool Mailbox::setObject(uint32_t index, uint32_t protocol, uint32_t object, uint64_t value, uint32_t bytes,
                        uint32_t element) {
  const auto at = devices_.find(index);
  if (at == devices_.end() || at->second.protocols.count(protocol) == 0 || bytes > 8 || element >= kElements)
    return false;
  Bytes& data = at->second.objects[keyOf(protocol, protocol == kVoe ? 0 : object, protocol == kSoe ? element : 0)];
  data.clear();
  for (uint32_t k = 0; k < bytes; ++k) data.push_back(static_cast<uint8_t>(value >> (8 * k)));
  return true;
}

}  // namespace rung::nct

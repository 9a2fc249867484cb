// SPDX-License-Identifier: Apache-2.0
// Slots of retained data: see rung/retain.h.
#include "rung/retain.h"

#include <string.h>

namespace {

constexpr char kMagic[8] = {'R', 'U', 'N', 'G', 's', 'l', 'o', '2'};

// CRC-32 of IEEE 802.3, four bits at a time: 64 bytes of table.
constexpr uint32_t kCrc[16] = {0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4,
                               0x4DB26158, 0x5005713C, 0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C,
                               0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};

const rung_range& rangeOf(const rung_table& ranges, uint32_t index) {
  return *static_cast<const rung_range*>(rung_row(&ranges, index));
}

uint32_t sizeOf(const rung_table& ranges) {
  uint32_t total = 0;
  for (uint32_t i = 0; i < ranges.count; ++i) total += rangeOf(ranges, i).size;
  return total;
}

bool isBit(const rung_range& range) { return (range.block & RUNG_RANGE_BIT) != 0; }

// Where a range begins; of a bit: its byte.
uint8_t* beginOf(const rung_context* context, const rung_range& range) {
  const uint32_t index = range.block & ~(RUNG_RANGE_AREA | RUNG_RANGE_BIT);
  uint8_t* const memory =
      (range.block & RUNG_RANGE_AREA) != 0 ? context->areas[index] : static_cast<uint8_t*>(context->blocks[index]);
  return memory + (isBit(range) ? range.offset / 8 : range.offset);
}

uint8_t* pack(const rung_context* context, const rung_table& ranges, uint8_t* to) {
  for (uint32_t i = 0; i < ranges.count; ++i) {
    const rung_range& range = rangeOf(ranges, i);
    const uint8_t* const from = beginOf(context, range);
    if (isBit(range))
      *to = *from >> range.offset % 8 & 1;
    else
      memcpy(to, from, range.size);
    to += range.size;
  }
  return to;
}

void unpack(rung_context* context, const rung_table& ranges, const uint8_t* from) {
  for (uint32_t i = 0; i < ranges.count; ++i) {
    const rung_range& range = rangeOf(ranges, i);
    uint8_t* const to = beginOf(context, range);
    const auto mask = static_cast<uint8_t>(1u << range.offset % 8);
    if (isBit(range))
      *to = static_cast<uint8_t>(*from != 0 ? *to | mask : *to & ~mask);
    else
      memcpy(to, from, range.size);
    from += range.size;
  }
}

uint32_t sumOf(const rung_slot& header, const void* slot) {
  rung_slot copy = header;
  copy.crc = 0;
  return rung_crc32(static_cast<const uint8_t*>(slot) + sizeof copy, copy.length, rung_crc32(&copy, sizeof copy, 0));
}

}  // namespace

extern "C" {

uint32_t rung_crc32(const void* data, size_t size, uint32_t crc) {
  crc = ~crc;
  const uint8_t* at = static_cast<const uint8_t*>(data);
  for (size_t i = 0; i < size; ++i) {
    crc = kCrc[(crc ^ at[i]) & 15] ^ crc >> 4;
    crc = kCrc[(crc ^ at[i] >> 4) & 15] ^ crc >> 4;
  }
  return ~crc;
}

uint32_t rung_retain_bytes(const rung_module* module) {
  return static_cast<uint32_t>(sizeof(rung_slot)) + sizeOf(module->retain) + sizeOf(module->persistent);
}

void rung_retain_pack(const rung_context* context, void* slot) {
  const rung_module& module = *context->module;
  rung_slot header;
  memset(&header, 0, sizeof header);
  memcpy(header.magic, kMagic, sizeof kMagic);
  header.layout_hash = module.layout_hash;
  header.time_ns = context->now_ns;
  header.retain_bytes = sizeOf(module.retain);
  header.value_bytes = header.length = rung_retain_bytes(&module) - static_cast<uint32_t>(sizeof header);
  memcpy(slot, &header, sizeof header);
  uint8_t* to = static_cast<uint8_t*>(slot) + sizeof header;
  to = pack(context, module.retain, to);
  pack(context, module.persistent, to);
}

void rung_retain_seal(void* slot, uint64_t sequence) {
  rung_slot header;
  memcpy(&header, slot, sizeof header);
  header.sequence = sequence;
  header.crc = sumOf(header, slot);
  memcpy(slot, &header, sizeof header);
}

bool rung_retain_is_slot(const rung_slot* header) {
  return memcmp(header->magic, kMagic, sizeof kMagic) == 0 && header->value_bytes <= header->length &&
         header->retain_bytes <= header->value_bytes;
}

bool rung_retain_is_complete(const void* slot, size_t bytes) {
  rung_slot header;
  if (bytes < sizeof header) return false;
  memcpy(&header, slot, sizeof header);
  return rung_retain_is_slot(&header) && header.length <= bytes - sizeof header && header.crc == sumOf(header, slot);
}

const void* rung_retain_newest(const void* one, const void* other, size_t bytes) {
  if (!rung_retain_is_complete(one, bytes)) return rung_retain_is_complete(other, bytes) ? other : nullptr;
  if (!rung_retain_is_complete(other, bytes)) return one;
  rung_slot a, b;
  memcpy(&a, one, sizeof a);
  memcpy(&b, other, sizeof b);
  return a.sequence > b.sequence ? one : other;
}

bool rung_retain_unpack(rung_context* context, const void* slot, rung_start start) {
  const rung_module& module = *context->module;
  rung_slot header;
  memcpy(&header, slot, sizeof header);
  if (header.layout_hash != module.layout_hash ||
      header.value_bytes != rung_retain_bytes(&module) - static_cast<uint32_t>(sizeof header))
    return false;
  if (start == RUNG_ORIGIN) return true;
  const uint8_t* const values = static_cast<const uint8_t*>(slot) + sizeof header;
  if (start == RUNG_WARM) unpack(context, module.retain, values);
  unpack(context, module.persistent, values + header.retain_bytes);
  if (start == RUNG_WARM || module.persistent.count > 0) context->now_ns = header.time_ns;
  return true;
}

}  // extern "C"

// SPDX-License-Identifier: Apache-2.0
// The table of current faults: see rung/diagnosis.h. A code is published last and taken back first, so a reader that
// sees the same code before and after it copied an entry has a whole one.
#include "rung/diagnosis.h"

namespace {

using Entry = rung_fault_slot;
constexpr uint32_t kFree = 0;

uint32_t codeOf(const Entry& entry) { return __atomic_load_n(&entry.code, __ATOMIC_ACQUIRE); }
uint32_t part(const uint32_t& value) { return __atomic_load_n(&value, __ATOMIC_RELAXED); }
void set(uint32_t& part, uint32_t value) { __atomic_store_n(&part, value, __ATOMIC_RELAXED); }

bool take(Entry& entry, uint32_t expected, uint32_t code) {
  return __atomic_compare_exchange_n(&entry.code, &expected, code, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE);
}

bool read(const Entry& entry, rung_current_fault& copy) {
  copy.code = codeOf(entry);
  if (copy.code == kFree || copy.code == RUNG_NONE) return false;
  copy.source = part(entry.source);
  copy.since_ns = static_cast<int64_t>(uint64_t{part(entry.since_high)} << 32 | part(entry.since_low));
  return codeOf(entry) == copy.code;
}

// AX 5.2: a code of two digits; Modbus faults are 16#20 to 16#6A.
bool isTwoDigits(uint32_t code) { return code <= 0xff; }
bool isOfBus(uint32_t code) {
  if (isTwoDigits(code)) return code >= 0x20 && code <= 0x6a;
  const uint32_t major = code >> 16;  // TM/TP manual 10.2
  return (major >= 0x30 && major <= 0x33) || (major >= 0x40 && major <= 0x43) || (major >= 0xa0 && major <= 0xa3);
}

}  // namespace

extern "C" {

bool rung_report_fault(rung_diagnosis* diagnosis, uint32_t code, uint32_t source, int64_t now_ns) {
  if (diagnosis == nullptr || code == kFree || code == RUNG_NONE) return false;
  for (const Entry& entry : diagnosis->entries)
    if (codeOf(entry) == code && part(entry.source) == source) return true;
  for (Entry& entry : diagnosis->entries) {
    if (!take(entry, kFree, RUNG_NONE)) continue;
    set(entry.source, source);
    set(entry.since_low, static_cast<uint32_t>(now_ns));
    set(entry.since_high, static_cast<uint32_t>(now_ns >> 32));
    __atomic_store_n(&entry.code, code, __ATOMIC_RELEASE);
    return true;
  }
  return false;
}

bool rung_clear_fault(rung_diagnosis* diagnosis, uint32_t code, uint32_t source) {
  if (diagnosis == nullptr || code == kFree || code == RUNG_NONE) return false;
  bool cleared = false;
  for (Entry& entry : diagnosis->entries)
    if (codeOf(entry) == code && part(entry.source) == source) cleared = take(entry, code, kFree) || cleared;
  return cleared;
}

uint32_t rung_current_faults(const rung_diagnosis* diagnosis, rung_current_fault* faults, uint32_t capacity) {
  if (diagnosis == nullptr) return 0;
  uint32_t count = 0;
  for (const Entry& entry : diagnosis->entries) {
    rung_current_fault copy;
    if (!read(entry, copy)) continue;
    uint32_t at = count < capacity ? count++ : capacity;  // of a full list the newest goes
    for (; at > 0 && faults[at - 1].since_ns > copy.since_ns; --at)
      if (at < capacity) faults[at] = faults[at - 1];
    if (at < capacity) faults[at] = copy;
  }
  return count;
}

uint8_t rung_indicators(const rung_diagnosis* diagnosis) {
  if (diagnosis == nullptr) return 0;
  uint8_t lit = diagnosis->stopped ? RUNG_INDICATOR_SF : 0;
  rung_current_fault copy;
  for (const Entry& entry : diagnosis->entries)
    if (read(entry, copy) && isOfBus(copy.code)) lit |= RUNG_INDICATOR_BF;
  return lit;
}

uint8_t rung_display_code(const rung_diagnosis* diagnosis) {
  if (diagnosis == nullptr) return 0;
  rung_current_fault copy, oldest = {};
  for (const Entry& entry : diagnosis->entries)
    if (read(entry, copy) && isTwoDigits(copy.code) && (oldest.code == kFree || copy.since_ns < oldest.since_ns))
      oldest = copy;
  return static_cast<uint8_t>(oldest.code);
}

}  // extern "C"

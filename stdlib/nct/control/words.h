// SPDX-License-Identifier: Apache-2.0
// The TimeSlice memory as the simulated control sees it during an exchange. In: what the program tells the control, and
// inputs that a test or an operator has set. Out: what the control tells, as far as it has changed: so a value that
// somebody else set stays until the control has another one to tell.
#pragma once

#include <cstring>

#include "rung/nc.h"
#include "symbols.h"

namespace rung::nct {

class Words {
 public:
  void beginExchange(uint32_t* words) { words_ = words; }

  bool isSet(const Symbol& bit, uint32_t unit = 0) const { return (words_[bit.word + unit] >> bit.bit & 1) != 0; }
  uint32_t word(const Symbol& symbol, uint32_t unit = 0) const { return words_[symbol.word + unit]; }
  int32_t integer(const Symbol& symbol, uint32_t unit = 0) const { return static_cast<int32_t>(word(symbol, unit)); }
  double real(const Symbol& symbol, uint32_t unit = 0) const {
    double value;
    std::memcpy(&value, words_ + symbol.word + 2 * unit, sizeof value);
    return value;
  }

  void set(const Symbol& bit, uint32_t unit, bool value) {
    const uint32_t mask = uint32_t{1} << bit.bit;
    const uint32_t at = bit.word + unit;
    tell(at, value ? told_[at] | mask : told_[at] & ~mask);
  }
  void put(const Symbol& symbol, uint32_t unit, uint32_t value) { tell(symbol.word + unit, value); }
  void putReal(const Symbol& symbol, uint32_t unit, double value) {
    uint32_t both[2];
    std::memcpy(both, &value, sizeof both);
    tell(symbol.word + 2 * unit, both[0]);
    tell(symbol.word + 2 * unit + 1, both[1]);
  }

  // Saves or restores what the control has told; each part of it has such a function (host/state_archive.h).
  template <class Archive>
  void transfer(Archive& archive) {
    archive.value(told_);
  }

 private:
  void tell(uint32_t at, uint32_t value) {
    const uint32_t changed = told_[at] ^ value;
    words_[at] = (words_[at] & ~changed) | (value & changed);
    told_[at] = value;
  }

  uint32_t* words_ = nullptr;
  uint32_t told_[RUNG_NC_SLICE_WORDS] = {};
};

// A request of the program and the control's answer to it: the answer follows when the request has been there for
// `kAnswerCycles`, and when the control may answer now.
constexpr uint8_t kAnswerCycles = 2;
class Answer {
 public:
  bool is() const { return is_; }
  // True: the answer has just changed.
  bool follow(bool request, bool may) {
    if (request == is_ || !may) {
      waited_ = 0;
      return false;
    }
    if (++waited_ < kAnswerCycles) return false;
    is_ = request;
    waited_ = 0;
    return true;
  }

 private:
  bool is_ = false;
  uint8_t waited_ = 0;
};

}  // namespace rung::nct

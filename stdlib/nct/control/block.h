// SPDX-License-Identifier: Apache-2.0
// The parameter block of an MR or MW service, as the simulated control works on it. In: a copy of the block in PLC
// memory. Out: the words that the service wrote. Used by the services (tools.h, pallets.h, …) and by control.cpp, which
// copies written words back. NCT manual 6.18.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace rung::nct {

// The code of execution of a finished service; 0: done.
using Code = int32_t;
constexpr Code kBusy = -1;  // the service has not finished
constexpr Code kDone = 0, kUnknownFunction = 1, kWrongAmount = 2, kProtected = 3, kWrongChecksum = 4;
constexpr uint32_t kFirstKept = 4000, kFirstSent = 2;  // the first word that a service may fill, and that it may send

class Block {
 public:
  // Word 0 is the code of execution, word 1 the amount of data, and the data of the service begins in word 2.
  explicit Block(std::vector<uint32_t> words) : words_(std::move(words)), written_(words_.size()) {}

  // Of data, in words.
  uint32_t amount() const { return words_.size() < 2 ? 0 : words_[1]; }
  uint32_t size() const { return static_cast<uint32_t>(words_.size()); }
  uint32_t word(uint32_t at) const { return words_[at]; }
  int32_t integer(uint32_t at) const { return static_cast<int32_t>(words_[at]); }
  // The low word is first.
  double real(uint32_t at) const {
    const uint64_t bits = words_[at] | static_cast<uint64_t>(words_[at + 1]) << 32;
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  void put(uint32_t at, uint32_t value) {
    words_[at] = value;
    written_[at] = true;
  }
  void putReal(uint32_t at, double value) {
    uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    put(at, static_cast<uint32_t>(bits));
    put(at + 1, static_cast<uint32_t>(bits >> 32));
  }

  // An item of a table: a real of two words or an unsigned word.
  double item(uint32_t at, bool is_real) const { return is_real ? real(at) : static_cast<double>(word(at)); }
  void putItem(uint32_t at, bool is_real, double value) {
    if (is_real)
      putReal(at, value);
    else
      put(at, static_cast<uint32_t>(value));
  }
  bool isWritten(uint32_t at) const { return written_[at]; }

  template <class Archive>
  void transfer(Archive& archive) {
    archive.list(words_);
    archive.sequence(written_, false, [&](std::vector<bool>::reference is) {
      bool value = is;
      archive.value(value);
      is = value;
    });
  }

 private:
  std::vector<uint32_t> words_;
  std::vector<bool> written_;
};

}  // namespace rung::nct

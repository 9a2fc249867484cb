// SPDX-License-Identifier: Apache-2.0
// The parameters of the simulated control and their services. In: number and index, or the block of a service. Out:
// values, codes of execution. NCT manual 6.20.
#pragma once

#include <cstdint>
#include <vector>

#include "block.h"

namespace rung::nct {

class Parameters {
 public:
  Parameters();

  // Of a parameter that exists; `index` counts from 0, also that of a global one.
  double real(uint32_t number, uint32_t index = 0) const;
  uint32_t word(uint32_t number, uint32_t index = 0) const { return static_cast<uint32_t>(real(number, index)); }
  bool bit(uint32_t number, uint32_t bit, uint32_t index = 0) const { return (word(number, index) >> bit & 1) != 0; }
  // False: there is no such parameter, or index.
  bool read(uint32_t number, uint32_t index, double& value) const;
  bool write(uint32_t number, uint32_t index, double value);
  void setChecksumWrong(bool wrong) { checksum_wrong_ = wrong; }

  Code readWords(Block& block) const;   // MR31
  Code readReals(Block& block) const;   // MR32
  Code writeWords(const Block& block);  // MW34
  Code writeReals(const Block& block);  // MW35

  template <class Archive>
  void transfer(Archive& archive) {
    for (Parameter& parameter : all_) archive.list(parameter.values);
    archive.value(checksum_wrong_);
  }

 private:
  enum class Format : uint8_t { Bits, Word, Real };
  enum class Basis : uint8_t { Global, Channel, Axis, Spindle };
  struct Parameter {
    Format format = Format::Bits;
    Basis basis = Basis::Global;
    std::vector<double> values;  // a word without a sign; empty: there is no such parameter
  };
  struct Range {
    Parameter* parameter = nullptr;
    uint32_t first = 0, count = 0;
  };
  Code find(const Block& block, bool reals, Range& range) const;

  // Null: there is no such parameter.
  Parameter* at(uint32_t number) const {
    return number < all_.size() && !all_[number].values.empty() ? &all_[number] : nullptr;
  }

  mutable std::vector<Parameter> all_;  // by number: read some hundred times in each TimeSlice
  bool checksum_wrong_ = false;
};

}  // namespace rung::nct

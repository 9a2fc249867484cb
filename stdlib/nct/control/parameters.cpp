// SPDX-License-Identifier: Apache-2.0
// Parameters of the control: see parameters.h.
#include "parameters.h"

#include "symbols.h"

namespace rung::nct {
namespace {

constexpr Code kMissing = 30, kIndexMissing = 31, kIndexGiven = 32, kWrongFormat = 33;

}  // namespace

Parameters::Parameters() {
  const auto unitsOf = [](Basis basis) -> size_t {
    switch (basis) {
      case Basis::Global: return 1;
      case Basis::Channel: return kChannels;
      case Basis::Axis: return kAxes;
      case Basis::Spindle: return kSpindles;
    }
    return 1;
  };
  const auto add = [&](uint32_t first, uint32_t count, Format format, Basis basis) {
    if (all_.size() < first + count) all_.resize(first + count);
    for (uint32_t number = first; number < first + count; ++number)
      all_[number] = {format, basis, std::vector<double>(unitsOf(basis))};
  };
#define NC_PARAMETER(first, count, format, basis) add(first, count, Format::format, Basis::basis);
#include "parameters.def"
#undef NC_PARAMETER
  // A machine with three axes and a spindle in channel 1.
  for (uint32_t axis = 0; axis < 3; ++axis) write(2, axis, 1);
  for (uint32_t axis = 0; axis < kAxes; ++axis) write(516, axis, 0.01);
  write(607, 0, 1);
  write(604, 0, 1);
  for (uint32_t spindle = 0; spindle < kSpindles; ++spindle) {
    write(627, spindle, 10);
    write(629, spindle, 5);
    write(650, spindle, 6000);
    for (uint32_t range = 0; range < 8; ++range) {
      write(666 + range, spindle, 10000);
      write(674 + range, spindle, 10000);
      write(801 + range, spindle, 100);
    }
  }
}

double Parameters::real(uint32_t number, uint32_t index) const {
  double value = 0;
  read(number, index, value);
  return value;
}

bool Parameters::read(uint32_t number, uint32_t index, double& value) const {
  const Parameter* const parameter = at(number);
  if (parameter == nullptr || index >= parameter->values.size()) return false;
  value = parameter->values[index];
  return true;
}

bool Parameters::write(uint32_t number, uint32_t index, double value) {
  Parameter* const parameter = at(number);
  if (parameter == nullptr || index >= parameter->values.size()) return false;
  if (parameter->format != Format::Real) {
    if (!(value >= -2147483648.0 && value <= 4294967295.0)) return false;
    value = static_cast<uint32_t>(static_cast<int64_t>(value));
  }
  parameter->values[index] = value;
  return true;
}

// Words 2 and 3 of a block: the number and the first index, which is 0 of a global parameter and counts from 1 else.
Code Parameters::find(const Block& block, bool reals, Range& range) const {
  const uint32_t amount = block.amount(), words = reals ? 2 : 1;
  if (amount < 2 + words || (amount - 2) % words != 0) return kWrongAmount;
  Parameter* const parameter = at(block.word(2));
  if (parameter == nullptr) return kMissing;
  if ((parameter->format == Format::Real) != reals) return kWrongFormat;
  const bool is_global = parameter->basis == Basis::Global;
  const uint32_t index = block.word(3);
  if (is_global && index != 0) return kIndexGiven;
  if (!is_global && index == 0) return kIndexMissing;
  range = {parameter, is_global ? 0 : index - 1, (amount - 2) / words};
  const size_t units = parameter->values.size();
  return range.first >= units || range.count > units - range.first ? kWrongAmount : kDone;
}

Code Parameters::readWords(Block& block) const {
  Range range;
  if (const Code code = find(block, false, range); code != kDone) return code;
  if (checksum_wrong_) return kWrongChecksum;
  for (uint32_t k = 0; k < range.count; ++k)
    block.put(4 + k, static_cast<uint32_t>(range.parameter->values[range.first + k]));
  return kDone;
}

Code Parameters::readReals(Block& block) const {
  Range range;
  if (const Code code = find(block, true, range); code != kDone) return code;
  if (checksum_wrong_) return kWrongChecksum;
  for (uint32_t k = 0; k < range.count; ++k) block.putReal(4 + 2 * k, range.parameter->values[range.first + k]);
  return kDone;
}

Code Parameters::writeWords(const Block& block) {
  Range range;
  if (const Code code = find(block, false, range); code != kDone) return code;
  for (uint32_t k = 0; k < range.count; ++k) range.parameter->values[range.first + k] = block.word(4 + k);
  return kDone;
}

Code Parameters::writeReals(const Block& block) {
  Range range;
  if (const Code code = find(block, true, range); code != kDone) return code;
  if (checksum_wrong_) return kWrongChecksum;
  for (uint32_t k = 0; k < range.count; ++k) range.parameter->values[range.first + k] = block.real(4 + 2 * k);
  return kDone;
}

}  // namespace rung::nct

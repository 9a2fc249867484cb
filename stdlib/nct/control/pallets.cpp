// SPDX-License-Identifier: Apache-2.0
// Pallet management of the simulated control: see pallets.h.
#include "pallets.h"

#include <algorithm>
#include <cmath>

namespace rung::nct {
namespace {

constexpr Code kNoPalletItem = 12, kNoPalletFile = 45, kNoPalletProgram = 47, kNoMagazine = 300, kNoPlace = 301,
               kNoOtherMagazine = 302, kPalletIdentifier = 305, kStatus = 306, kPriority = 307, kExecuted = 308,
               kAssigned = 309, kEmptyPlace = 339, kNotFound = 341, kEmptySpace = 342;
constexpr uint32_t kVirtual = 0, kMagazine = 1, kWorkingSpace = 10, kLoadingPoint = 11;
constexpr uint32_t kReady = 4;  // for exchange

bool isRealPalletItem(uint32_t item) { return item >= static_cast<uint32_t>(PalletItem::FirstCustom); }

}  // namespace

// ---- the table

Pallets::Rows Pallets::rowsOf(uint32_t magazine) const {
  if (!parameters_.bit(3300, 0)) return {};
  const bool has_loading_point = parameters_.bit(3300, 1);
  const uint32_t places = std::min(parameters_.word(3301), kRows - 2), first_virtual = 2 + places;
  switch (magazine) {
    case kVirtual: return {first_virtual, (has_loading_point ? kRows : kRows + 1) - first_virtual};
    case kMagazine: return {2, places};
    case kWorkingSpace: return {0, 1};
    case kLoadingPoint: return {1, has_loading_point ? 1u : 0u};
    default: return {};
  }
}

// Custom columns exist as far as a parameter says, and programs that are chosen by hand are not the program's.
bool Pallets::hasItem(uint32_t item) const {
  if (item < 1 || item > kLastItem) return false;
  const auto first_custom = static_cast<uint32_t>(PalletItem::CustomBits);
  return item < first_custom || item - first_custom < parameters_.word(3302);
}

// The last item of a block with all columns, whose amount has two words for the place; 0: a column is not whole. The
// programs are not among the columns.
uint32_t Pallets::columnsOf(uint32_t amount) const {
  uint32_t words = 2, item = 0;
  while (words < amount && item < kLastItem) {
    if (++item == static_cast<uint32_t>(PalletItem::Programs)) continue;
    words += isRealPalletItem(item) ? 2 : 1;
  }
  return words == amount && hasItem(item) ? item : 0;
}

Code Pallets::findRow(const Block& block, uint32_t& row) const {
  const Rows rows = rowsOf(block.word(2));
  if (rows.count == 0) return kNoMagazine;
  if (block.word(3) - 1 >= rows.count) return kNoPlace;
  row = rows.first + block.word(3) - 1;
  return kDone;
}

Code Pallets::check(const Pallet& pallet, uint32_t item) {
  const double value = pallet.items[item - 1];
  switch (static_cast<PalletItem>(item)) {
    case PalletItem::Identifier: return value >= 1 && value <= 99999999 ? kDone : kPalletIdentifier;
    case PalletItem::Status: return value <= 9 ? kDone : kStatus;
    case PalletItem::Priority: return value <= 128 ? kDone : kPriority;
    case PalletItem::Executed: return value <= of(pallet, PalletItem::Assigned) ? kDone : kExecuted;
    case PalletItem::Assigned:
      if (value > kPrograms) return kAssigned;
      return value >= of(pallet, PalletItem::Executed) ? kDone : kExecuted;
    case PalletItem::Programs:
    case PalletItem::CustomBits:
    case PalletItem::FirstCustom:
    case PalletItem::LastCustom: break;
  }
  return kDone;
}

// A pallet of this name whose data are in the virtual magazine comes here, and what was here goes there.
void Pallets::recall(uint32_t row, double identifier) {
  if (of(pallets_[row], PalletItem::Identifier) == identifier) return;
  const Rows rows = rowsOf(kVirtual);
  for (uint32_t k = rows.first; k < rows.first + rows.count; ++k)
    if (k != row && of(pallets_[k], PalletItem::Identifier) == identifier) {
      std::swap(pallets_[row], pallets_[k]);
      return;
    }
}

// ---- services

// The place of the second magazine is implied: in the virtual one the first free row.
Code Pallets::exchangePlaces(const Block& block) {
  if (block.amount() != 3) return kWrongAmount;
  if (is_edited_) return kProtected;
  const uint32_t magazine = block.word(2), other = block.word(4);
  if (magazine == kVirtual) return kNoMagazine;
  uint32_t row = 0;
  if (const Code code = findRow(block, row); code != kDone) return code;
  const bool is_pair = magazine == kMagazine ? other == kVirtual || other == kWorkingSpace || other == kLoadingPoint
                                             : magazine == kLoadingPoint && other == kVirtual;
  const Rows rows = rowsOf(other);
  if (!is_pair || (rows.count == 0 && other != kVirtual)) return kNoOtherMagazine;
  uint32_t to = rows.first;
  if (other == kVirtual) {
    while (to < rows.first + rows.count && !isEmpty(pallets_[to])) ++to;
    if (to == rows.first + rows.count) return kNoPlace;
  }
  std::swap(pallets_[row], pallets_[to]);
  return kDone;
}

Code Pallets::writePallet(const Block& block) {
  const uint32_t last = columnsOf(block.amount());
  if (last == 0) return kWrongAmount;
  if (is_edited_) return kProtected;
  uint32_t row = 0;
  if (const Code code = findRow(block, row); code != kDone) return code;
  const std::array<Pallet, kRows + 1> before = pallets_;
  recall(row, block.word(4));
  Pallet& pallet = pallets_[row];
  for (uint32_t item = 1, at = 4; item <= last; ++item) {
    if (item == static_cast<uint32_t>(PalletItem::Programs)) continue;
    pallet.items[item - 1] = block.item(at, isRealPalletItem(item));
    at += isRealPalletItem(item) ? 2 : 1;
  }
  for (uint32_t item = 1; item <= last; ++item)
    if (const Code code = check(pallet, item); code != kDone) {
      pallets_ = before;
      return code;
    }
  return kDone;
}

Code Pallets::readPallet(Block& block) const {
  const uint32_t last = columnsOf(block.amount());
  if (last == 0) return kWrongAmount;
  if (is_edited_) return kProtected;
  uint32_t row = 0;
  if (const Code code = findRow(block, row); code != kDone) return code;
  if (isEmpty(pallets_[row])) return kEmptyPlace;
  for (uint32_t item = 1, at = 4; item <= last; ++item) {
    if (item == static_cast<uint32_t>(PalletItem::Programs)) continue;
    block.putItem(at, isRealPalletItem(item), pallets_[row].items[item - 1]);
    at += isRealPalletItem(item) ? 2 : 1;
  }
  return kDone;
}

// MW306 and MR307: 4 words with a word, 5 with a double, one for each program.
static Code checkItemAmount(const Block& block, bool has_item) {
  const uint32_t amount = block.amount();
  if (amount < 4) return kWrongAmount;
  const uint32_t item = block.word(4);
  if (item == static_cast<uint32_t>(PalletItem::Programs)) return amount <= 3 + 64 ? kDone : kWrongAmount;
  if (!has_item) return amount <= 5 ? kNoPalletItem : kWrongAmount;
  return amount == (isRealPalletItem(item) ? 5u : 4u) ? kDone : kWrongAmount;
}

Code Pallets::writeItem(const Block& block) {
  const uint32_t item = block.amount() < 4 ? 0 : block.word(4);
  if (const Code code = checkItemAmount(block, hasItem(item)); code != kDone) return code;
  const bool are_programs = item == static_cast<uint32_t>(PalletItem::Programs);
  if (is_edited_ || (are_programs && parameters_.bit(3300, 3))) return kProtected;
  uint32_t row = 0;
  if (const Code code = findRow(block, row); code != kDone) return code;
  // A place that has no pallet has a status, and can get a pallet.
  if (item > static_cast<uint32_t>(PalletItem::Status) && isEmpty(pallets_[row])) return kEmptyPlace;
  if (are_programs) {
    const uint32_t count = block.amount() - 3;
    if (count > of(pallets_[row], PalletItem::Assigned)) return kWrongAmount;
    pallets_[row].programs = {};
    for (uint32_t k = 0; k < count; ++k) pallets_[row].programs[k] = block.word(5 + k);
    return kDone;
  }
  Pallet changed = pallets_[row];
  changed.items[item - 1] = block.item(5, isRealPalletItem(item));
  if (const Code code = check(changed, item); code != kDone) return code;
  if (item == static_cast<uint32_t>(PalletItem::Identifier)) recall(row, changed.items[0]);
  pallets_[row].items[item - 1] = changed.items[item - 1];
  return kDone;
}

Code Pallets::readItem(Block& block) const {
  const uint32_t item = block.amount() < 4 ? 0 : block.word(4);
  if (const Code code = checkItemAmount(block, hasItem(item)); code != kDone) return code;
  const bool are_programs = item == static_cast<uint32_t>(PalletItem::Programs);
  if (is_edited_ || (are_programs && parameters_.bit(3300, 3))) return kProtected;
  uint32_t row = 0;
  if (const Code code = findRow(block, row); code != kDone) return code;
  if (item != static_cast<uint32_t>(PalletItem::Status) && isEmpty(pallets_[row])) return kEmptyPlace;
  if (!are_programs) {
    block.putItem(5, isRealPalletItem(item), pallets_[row].items[item - 1]);
    return kDone;
  }
  const uint32_t count = block.amount() - 3;
  if (count > of(pallets_[row], PalletItem::Assigned)) return kWrongAmount;
  for (uint32_t k = 0; k < count; ++k) block.put(5 + k, pallets_[row].programs[k]);
  return kDone;
}

// A place without a pallet has a status, and no name.
bool Pallets::matches(const Pallet& pallet, uint32_t item, uint32_t value) const {
  if (isEmpty(pallet) && item > static_cast<uint32_t>(PalletItem::Status)) return false;
  if (item != static_cast<uint32_t>(PalletItem::Programs)) return pallet.items[item - 1] == value;
  const auto end = pallet.programs.begin() + static_cast<int>(of(pallet, PalletItem::Assigned));
  return std::find(pallet.programs.begin(), end, value) != end;
}

// The nearest place in the direction; of those that are ready for exchange the one with the lowest priority number.
Code Pallets::findPallet(Block& block) const {
  if (block.amount() != 6) return kWrongAmount;
  const uint32_t item = block.word(2), wanted = block.word(3), start = block.word(4) - 1, direction = block.word(5);
  if (!hasItem(item) || (item == static_cast<uint32_t>(PalletItem::Programs) && parameters_.bit(3300, 3)))
    return kNoPalletItem;
  const Rows rows = rowsOf(kMagazine);
  if (start >= rows.count) return kNoPlace;
  const bool by_priority = item == static_cast<uint32_t>(PalletItem::Status) && wanted == kReady;
  block.put(6, 0);
  block.put(7, 0);
  double best = 0;
  for (uint32_t distance = 0; distance < rows.count; ++distance) {
    for (uint32_t rotation = 1; rotation <= 2; ++rotation) {
      if (direction == 3 - rotation) continue;
      const uint32_t place = (start + (rotation == 1 ? distance : rows.count - distance)) % rows.count;
      const Pallet& pallet = pallets_[rows.first + place];
      if (!matches(pallet, item, wanted)) continue;
      const double priority = by_priority ? of(pallet, PalletItem::Priority) : 0;
      if (block.word(6) != 0 && priority >= best) continue;
      best = priority;
      block.put(6, place + 1);
      block.put(7, rotation);
    }
  }
  return block.word(6) != 0 ? kDone : kNotFound;
}

// After the last place of the magazine its first one comes.
Code Pallets::readColumn(Block& block) const {
  if (block.amount() < 4) return kWrongAmount;
  const uint32_t item = block.word(2), place = block.word(4) - 1, words = isRealPalletItem(item) ? 2 : 1;
  if (!hasItem(item) || (item == static_cast<uint32_t>(PalletItem::Programs) && parameters_.bit(3300, 3)))
    return kNoPalletItem;
  if ((block.amount() - 3) % words != 0) return kWrongAmount;
  const Rows rows = rowsOf(block.word(3));
  if (rows.count == 0) return kNoMagazine;
  if (place >= rows.count) return kNoPlace;
  for (uint32_t k = 0; k < (block.amount() - 3) / words; ++k) {
    const Pallet& pallet = pallets_[rows.first + (place + k) % rows.count];
    const bool is_program = item == static_cast<uint32_t>(PalletItem::Programs);
    block.putItem(5 + k * words, isRealPalletItem(item), is_program ? pallet.programs[0] : pallet.items[item - 1]);
  }
  return kDone;
}

Code Pallets::nextProgram(uint32_t identifier, uint32_t& program) const {
  const Rows rows = rowsOf(kWorkingSpace);
  const Pallet& pallet = pallets_[0];
  if (rows.count == 0 || isEmpty(pallet)) return kEmptySpace;
  const double executed = of(pallet, PalletItem::Executed);
  if (of(pallet, PalletItem::Identifier) != identifier || executed >= of(pallet, PalletItem::Assigned))
    return kNoPalletProgram;
  program = pallet.programs[static_cast<uint32_t>(executed)];
  return program == 0 || parameters_.bit(3300, 3) ? kNoPalletFile : kDone;
}

}  // namespace rung::nct

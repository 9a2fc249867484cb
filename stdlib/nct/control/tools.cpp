// SPDX-License-Identifier: Apache-2.0
// Tool management of the simulated control: see tools.h.
#include "tools.h"

#include <algorithm>
#include <cmath>

namespace rung::nct {
namespace {

constexpr Code kNoCartridge = 100, kNoPot = 101, kNoOtherCartridge = 102, kNoOtherPot = 103, kNoEmptyPot = 104,
               kFirstItemCode = 104,  // code of an item: this and its data number
    kTableFull = 138, kNoTool = 139, kNoItem = 140, kNoMatch = 141;
constexpr uint32_t kWords = 12, kCompensations = 400, kFigures = 20;
constexpr double kGreatestFigure = 99999999;  // 8 digits
constexpr double kMillimetre = 0.001, kInch = 0.0001;
enum Status : uint32_t { kUnmanaged, kUnused, kUsed, kExpired, kBroken };
constexpr uint32_t kTimed = 1, kLarge = 2, kDisabled = 3, kSearchable = 4;  // bits of the tool info
constexpr int32_t kToolChange = 6;

bool isRealToolItem(uint32_t item) {
  return item == static_cast<uint32_t>(ToolItem::Feed) || item >= static_cast<uint32_t>(ToolItem::FirstUser);
}

bool bit(double word, uint32_t number) { return (static_cast<uint32_t>(word) >> number & 1) != 0; }

// Items of a block with all columns, whose amount has two words for the pot; 0: a column is not whole.
uint32_t columnsOf(uint32_t amount) {
  uint32_t words = 2, items = 0;
  while (words < amount && items < static_cast<uint32_t>(ToolItem::LastUser)) words += isRealToolItem(++items) ? 2 : 1;
  return words == amount ? items : 0;
}

}  // namespace

Tools::Tools(Words& words, const Parameters& parameters, Channels& channels, const Spindles& spindles)
    : words_(words), parameters_(parameters), channels_(channels), spindles_(spindles) {
  setCartridge(1, 24, 1, 0);  // as in NCT manual 6.26.2
  setCartridge(2, 16, 1, 0);
}

// ---- tables

bool Tools::mustWait() const {
  return parameters_.bit(1274, 0) && (use_.edited || use_.saved || use_.searched || is_modified_);
}

bool Tools::isSearchable(const Tool& tool) {
  if (!isValid(tool)) return false;
  const auto status = static_cast<uint32_t>(of(tool, ToolItem::Status));
  if (status == kUnmanaged) return bit(of(tool, ToolItem::Info), kSearchable);
  return status == kUnused || status == kUsed;
}

// The code of the first rule that a value breaks.
Code Tools::checkItem(uint32_t item, double value) {
  const Code wrong = kFirstItemCode + static_cast<Code>(item);
  const auto within = [&](double least, double greatest) {
    return value >= least && value <= greatest ? kDone : wrong;
  };
  if (isRealToolItem(item)) {
    const bool is_feed = item == static_cast<uint32_t>(ToolItem::Feed);
    return std::isfinite(value) && (!is_feed || value >= 0) ? kDone : wrong;
  }
  switch (static_cast<ToolItem>(item)) {
    case ToolItem::Type: return within(1, kGreatestFigure);
    case ToolItem::Info: return within(0, 31);
    case ToolItem::Figure: return within(0, kFigures);
    case ToolItem::Status: return within(0, kBroken);
    case ToolItem::H:
    case ToolItem::D:
    case ToolItem::G:
    case ToolItem::W: return within(0, kCompensations);
    case ToolItem::UserBits: return within(0, 255);
    case ToolItem::Counter:
    case ToolItem::Life:
    case ToolItem::Notice:
    case ToolItem::Speed:
    case ToolItem::Feed:
    case ToolItem::FirstUser:
    case ToolItem::LastUser: break;
  }
  return within(0, kGreatestFigure);
}

bool Tools::hasCartridge(uint32_t cartridge) const {
  if (cartridge >= 1 && cartridge <= kMagazines) return !magazines_[cartridge - 1].pots.empty();
  const uint32_t spindle = cartridge / 10 - 1;
  return cartridge >= 10 && spindle < kSpindles && cartridge % 10 <= 1 && parameters_.bit(607, 0, spindle);
}

const uint32_t* Tools::potAt(uint32_t cartridge, uint32_t pot) const {
  if (!hasCartridge(cartridge)) return nullptr;
  if (cartridge >= 10) return pot == 1 ? &spindle_pots_[cartridge / 10 - 1][cartridge % 10] : nullptr;
  const Magazine& magazine = magazines_[cartridge - 1];
  const uint32_t at = pot - magazine.first;
  return at < magazine.pots.size() ? &magazine.pots[at] : nullptr;
}

uint32_t* Tools::potAt(uint32_t cartridge, uint32_t pot) {
  return const_cast<uint32_t*>(static_cast<const Tools*>(this)->potAt(cartridge, pot));
}

// The cartridge in word `at` and the pot in the next one.
Code Tools::checkPot(const Block& block, uint32_t at, Code no_cartridge, Code no_pot) const {
  if (!hasCartridge(block.word(at))) return no_cartridge;
  return potAt(block.word(at), block.word(at + 1)) == nullptr ? no_pot : kDone;
}

// The row of the tool in the pot of words 2 and 3, from 0.
Code Tools::findRow(const Block& block, Access access, uint32_t& row) const {
  if (access == Access::Write && isLocked()) return kProtected;
  if (const Code code = checkPot(block, 2, kNoCartridge, kNoPot); code != kDone) return code;
  const uint32_t data_number = *potAt(block.word(2), block.word(3));
  if (data_number == 0) return kNoTool;
  row = data_number - 1;
  return access == Access::Write && bit(of(tools_[row], ToolItem::Info), kDisabled) ? kProtected : kDone;
}

bool Tools::findPlace(uint32_t data_number, Place& place) const {
  for (uint32_t k = 0; k < kMagazines; ++k) {
    const std::vector<uint32_t>& pots = magazines_[k].pots;
    const auto at = std::find(pots.begin(), pots.end(), data_number);
    if (at == pots.end()) continue;
    place = {k + 1, magazines_[k].first + static_cast<uint32_t>(at - pots.begin())};
    return true;
  }
  for (uint32_t k = 0; k < kSpindles; ++k)
    for (uint32_t waits = 0; waits < 2; ++waits)
      if (spindle_pots_[k][waits] == data_number && hasCartridge(10 * (k + 1) + waits)) {
        place = {10 * (k + 1) + waits, 1};
        return true;
      }
  return false;
}

// The tool for a T code: that with the greatest life counter, of these the first one; it must be in a pot. NCT manual
// 6.26.1.
FoundTool Tools::find(uint32_t type) const {
  FoundTool found;
  if (!parameters_.bit(2900, 0)) return found;
  double counter = -1;
  bool has_any = false, has_usable = false;
  for (uint32_t row = 0; row < kRows; ++row) {
    const Tool& tool = tools_[row];
    Place place{};
    if (!isValid(tool) || of(tool, ToolItem::Type) != type || !findPlace(row + 1, place)) continue;
    const double status = of(tool, ToolItem::Status);
    has_any = true;
    has_usable = has_usable || status < kExpired;
    if (!isSearchable(tool) || of(tool, ToolItem::Counter) <= counter) continue;
    counter = of(tool, ToolItem::Counter);
    found.magazine = place.cartridge;
    found.pot = place.pot;
  }
  found.expired = has_any && !has_usable;
  return found;
}

// ---- services of pots

Code Tools::exchangePots(const Block& block) {
  if (block.amount() != 4) return kWrongAmount;
  if (isLocked()) return kProtected;
  if (const Code code = checkPot(block, 2, kNoCartridge, kNoPot); code != kDone) return code;
  if (const Code code = checkPot(block, 4, kNoOtherCartridge, kNoOtherPot); code != kDone) return code;
  std::swap(*potAt(block.word(2), block.word(3)), *potAt(block.word(4), block.word(5)));
  is_modified_ = true;
  return kDone;
}

Tools::Pattern Tools::patternOf(uint32_t data_number) const {
  if (data_number == 0) return {};
  const Tool& tool = tools_[data_number - 1];
  const auto figure = static_cast<uint32_t>(of(tool, ToolItem::Figure));
  const bool is_large = bit(of(tool, ToolItem::Info), kLarge);
  return is_large && figure >= 1 && figure <= kPatterns ? patterns_[figure - 1] : Pattern{};
}

// The quarters of pots, two rows of two, that a tool covers whose own pot is the one at `pot`. Beyond the edge of a
// matrix there is nothing to cover. False: it is longer than the chain.
bool Tools::cover(const Magazine& magazine, uint32_t pot, const Pattern& pattern, std::vector<uint32_t>& cells) const {
  const auto count = static_cast<int32_t>(magazine.pots.size());
  const bool is_chain = magazine.columns == 0;
  const int32_t columns = is_chain ? count : static_cast<int32_t>(magazine.columns);
  const int32_t column = static_cast<int32_t>(pot) % columns, row = static_cast<int32_t>(pot) / columns;
  const auto left = static_cast<int32_t>(pattern.left), right = static_cast<int32_t>(pattern.right);
  const int32_t up = is_chain ? 0 : static_cast<int32_t>(pattern.up);
  const int32_t down = is_chain ? 0 : static_cast<int32_t>(pattern.down);
  if (is_chain && left + 2 + right > 2 * columns) return false;
  const int32_t first_column = column - (left + 1) / 2, last_column = column + (right + 1) / 2;
  const int32_t first_row = row - (up + 1) / 2, last_row = row + (down + 1) / 2;
  cells.clear();
  for (int32_t y = 2 * row - up; y <= 2 * row + 1 + down; ++y) {
    for (int32_t x = 2 * column - left; x <= 2 * column + 1 + right; ++x) {
      const int32_t at_column = (x + 2 * columns) / 2 - columns, at_row = (y + 2 * count) / 2 - count;
      // A circle leaves the pots in the corners free.
      if (pattern.is_circle && !is_chain && at_column != column && at_row != row &&
          (at_column == first_column || at_column == last_column) && (at_row == first_row || at_row == last_row))
        continue;
      if (!is_chain && (x < 0 || x >= 2 * columns || y < 0 || at_row * columns + at_column >= count)) continue;
      const int32_t around = (x + 2 * columns) % (2 * columns);
      cells.push_back(static_cast<uint32_t>(y * 2 * columns + around));
    }
  }
  return true;
}

// MR101. A pot is free when no other tool covers a part of what the tool would cover.
Code Tools::findEmptyPot(Block& block) const {
  if ((block.amount() != 7 && block.amount() != 0) || block.size() < 9) return kWrongAmount;
  if (mustWait()) return kBusy;
  if (isLocked()) return kProtected;
  const uint32_t target = block.word(2);
  if (target > kMagazines) return kNoCartridge;  // spindles and standby places are not searched
  if (const Code code = checkPot(block, 2, kNoCartridge, kNoPot); code != kDone) return code;
  if (const Code code = checkPot(block, 5, kNoOtherCartridge, kNoOtherPot); code != kDone) return code;
  const Magazine& magazine = magazines_[target - 1];
  const auto count = static_cast<uint32_t>(magazine.pots.size());
  const uint32_t start = block.word(3) - magazine.first, direction = block.word(4);
  const uint32_t* const source = potAt(block.word(5), block.word(6));

  std::vector<uint32_t> cells;
  std::vector<bool> covered(4 * static_cast<size_t>(count) + 4 * magazine.columns);
  for (uint32_t k = 0; k < count; ++k) {
    if (magazine.pots[k] == 0 || &magazine.pots[k] == source) continue;
    if (!cover(magazine, k, patternOf(magazine.pots[k]), cells)) cover(magazine, k, {}, cells);
    for (const uint32_t cell : cells) covered[cell] = true;
  }
  const Pattern pattern = patternOf(*source);
  const auto isFree = [&](uint32_t pot) {
    return cover(magazine, pot, pattern, cells) &&
           std::none_of(cells.begin(), cells.end(), [&](uint32_t cell) { return covered[cell]; });
  };
  block.put(1, 7);
  const bool is_chain = magazine.columns == 0;
  for (uint32_t distance = 0; distance < count; ++distance) {
    const bool has_after = is_chain || start + distance < count, has_before = is_chain || distance <= start;
    const uint32_t after = (start + distance) % count, before = (start + count - distance) % count;
    const bool forward = direction != 2 && has_after && isFree(after);
    if (!forward && !(direction != 1 && has_before && isFree(before))) continue;
    block.put(7, magazine.first + (forward ? after : before));
    block.put(8, forward ? 1 : 2);
    return kDone;
  }
  block.put(7, 0);
  block.put(8, 0);
  return kNoEmptyPot;
}

// ---- services of tools

// A free row is invalid, and no pot has it. Items that are not given are 0.
Code Tools::registerTool(const Block& block) {
  const uint32_t items = columnsOf(block.amount());
  if (items == 0) return kWrongAmount;
  if (isLocked()) return kProtected;
  if (const Code code = checkPot(block, 2, kNoCartridge, kNoPot); code != kDone) return code;
  Tool tool{};
  for (uint32_t item = 1, at = 4; item <= items; at += isRealToolItem(item) ? 2 : 1, ++item) {
    tool[item - 1] = block.item(at, isRealToolItem(item));
    if (const Code code = checkItem(item, tool[item - 1]); code != kDone) return code;
  }
  Place place{};
  uint32_t row = 0;
  while (row < kRows && (isValid(tools_[row]) || findPlace(row + 1, place))) ++row;
  if (row == kRows) return kTableFull;
  tools_[row] = tool;
  *potAt(block.word(2), block.word(3)) = row + 1;
  is_modified_ = true;
  return kDone;
}

Code Tools::writeTool(const Block& block) {
  const uint32_t items = columnsOf(block.amount());
  if (items == 0) return kWrongAmount;
  uint32_t row = 0;
  if (const Code code = findRow(block, Access::Write, row); code != kDone) return code;
  Tool tool = tools_[row];
  for (uint32_t item = 1, at = 4; item <= items; at += isRealToolItem(item) ? 2 : 1, ++item) {
    tool[item - 1] = block.item(at, isRealToolItem(item));
    if (const Code code = checkItem(item, tool[item - 1]); code != kDone) return code;
  }
  tools_[row] = tool;
  is_modified_ = true;
  return kDone;
}

Code Tools::readTool(Block& block) const {
  const uint32_t items = columnsOf(block.amount());
  if (items == 0) return kWrongAmount;
  if (mustWait()) return kBusy;
  uint32_t row = 0;
  if (const Code code = findRow(block, Access::Read, row); code != kDone) return code;
  for (uint32_t item = 1, at = 4; item <= items; at += isRealToolItem(item) ? 2 : 1, ++item)
    block.putItem(at, isRealToolItem(item), tools_[row][item - 1]);
  return kDone;
}

Code Tools::deleteTool(const Block& block) {
  if (block.amount() != 2) return kWrongAmount;
  uint32_t row = 0;
  if (const Code code = findRow(block, Access::Write, row); code != kDone) return code;
  tools_[row] = {};
  *potAt(block.word(2), block.word(3)) = 0;
  is_modified_ = true;
  return kDone;
}

// MW106, MR107 and MR108: 4 words with a word, 5 with a double.
static Code checkToolAmount(const Block& block, uint32_t first) {
  if (block.amount() != 4 && block.amount() != 5) return kWrongAmount;
  const uint32_t item = block.word(4);
  if (item < first || item > static_cast<uint32_t>(ToolItem::LastUser)) return kNoItem;
  return block.amount() == (isRealToolItem(item) ? 5u : 4u) ? kDone : kWrongAmount;
}

Code Tools::writeItem(const Block& block) {
  const Code amount = checkToolAmount(block, 1);
  if (amount == kWrongAmount) return amount;
  uint32_t row = 0;
  if (const Code code = findRow(block, Access::Write, row); code != kDone) return code;
  if (amount != kDone) return amount;
  const uint32_t item = block.word(4);
  const double wanted = block.item(5, isRealToolItem(item));
  if (const Code code = checkItem(item, wanted); code != kDone) return code;
  tools_[row][item - 1] = wanted;
  is_modified_ = true;
  return kDone;
}

Code Tools::readItem(Block& block) const {
  const Code amount = checkToolAmount(block, 1);
  if (amount == kWrongAmount) return amount;
  if (mustWait()) return kBusy;
  uint32_t row = 0;
  if (const Code code = findRow(block, Access::Read, row); code != kDone) return code;
  if (amount != kDone) return amount;
  block.putItem(5, isRealToolItem(block.word(4)), tools_[row][block.word(4) - 1]);
  return kDone;
}

// Doubles are equal that differ by less than an increment.
Code Tools::findByUserData(Block& block) const {
  if (const Code code = checkToolAmount(block, static_cast<uint32_t>(ToolItem::UserBits)); code != kDone) return code;
  const uint32_t item = block.word(4);
  const double wanted = block.item(5, isRealToolItem(item)), increment = parameters_.bit(104, 0) ? kInch : kMillimetre;
  for (uint32_t row = 0; row < kRows; ++row) {
    if (!isValid(tools_[row])) continue;
    const double has = tools_[row][item - 1];
    Place place{};
    const bool matches = isRealToolItem(item) ? std::fabs(has - wanted) < increment : has == wanted;
    if (!matches || !findPlace(row + 1, place)) continue;
    block.put(2, place.cartridge);
    block.put(3, place.pot);
    return kDone;
  }
  return kNoMatch;
}

// ---- life

void Tools::beginCycle(double seconds) {
  words_.set(nc::N_TLEDT, 0, use_.edited);
  words_.set(nc::N_TLSV, 0, use_.saved);
  words_.set(nc::N_TLSRCH, 0, use_.searched);
  words_.set(nc::N_TLMD, 0, is_modified_);
  is_modified_ = false;
  for (SpindleLife& life : lives_) life.notice = false;
  if (parameters_.bit(2900, 0)) {
    // A block of the simulated control stands for its feed motion.
    bool is_fed[kSpindles] = {};
    for (uint32_t channel = 0; channel < kChannels; ++channel) {
      const uint32_t spindle = spindles_.ofChannel(channel);
      if (channels_.hasFinished(channel, kToolChange)) count(spindle, 1, false);
      is_fed[spindle] = is_fed[spindle] || (channels_.runs(channel) && words_.real(nc::CP_FOVER, channel) != 0 &&
                                            spindles_.speed(spindle) != 0);
    }
    for (uint32_t spindle = 0; spindle < kSpindles; ++spindle) {
      if (is_fed[spindle]) lives_[spindle].rest += seconds;
      const auto whole = static_cast<uint32_t>(lives_[spindle].rest + 1e-9);
      if (whole == 0) continue;
      lives_[spindle].rest -= whole;
      count(spindle, whole, true);
    }
  }
  for (uint32_t spindle = 0; spindle < kSpindles; ++spindle) {
    if (parameters_.bit(2900, 0)) breakTool(spindle);
    tell(spindle);
  }
}

// Uses, or seconds of machining, of the tool in the spindle.
void Tools::count(uint32_t k, uint32_t units, bool are_seconds) {
  if (spindle_pots_[k][0] == 0 || words_.isSet(nc::SP_TLCD, k)) return;
  Tool& tool = tools_[spindle_pots_[k][0] - 1];
  const double status = of(tool, ToolItem::Status);
  if (!isValid(tool) || (status != kUnused && status != kUsed)) return;
  if (bit(of(tool, ToolItem::Info), kTimed) != are_seconds) return;
  const double life = of(tool, ToolItem::Life), notice = of(tool, ToolItem::Notice);
  const double before = of(tool, ToolItem::Counter), after = std::min(before + units, kGreatestFigure);
  set(tool, ToolItem::Counter, after);
  set(tool, ToolItem::Status, after >= life ? kExpired : kUsed);
  lives_[k].notice = lives_[k].notice || (life - before > notice && life - after <= notice);
  if (after >= life) requestChange(k, tool);
}

// First the tool is broken and the answer is given, a cycle later a change is asked for. NCT manual 7.14.
void Tools::breakTool(uint32_t k) {
  SpindleLife& life = lives_[k];
  const uint32_t data_number = spindle_pots_[k][0];
  if (life.waits_for_change) requestChange(k, tools_[life.waits_for_change - 1]);
  life.waits_for_change = 0;
  if (!words_.isSet(nc::SP_TLSKP, k)) {
    life.is_skipped = false;
  } else if (!life.is_skipped && data_number != 0) {
    life.is_skipped = true;
    set(tools_[data_number - 1], ToolItem::Status, kBroken);
    life.waits_for_change = data_number;
    is_modified_ = true;
  }
}

// Of this tool, and of its group when no other tool of it can work. The requests stay until they are acknowledged.
void Tools::requestChange(uint32_t k, const Tool& tool) {
  lives_[k].change = true;
  const double type = of(tool, ToolItem::Type);
  lives_[k].change_group =
      lives_[k].change_group || std::all_of(tools_.begin(), tools_.end(), [&](const Tool& other) {
        return !isValid(other) || of(other, ToolItem::Type) != type || of(other, ToolItem::Status) >= kExpired;
      });
}

void Tools::tell(uint32_t k) {
  SpindleLife& life = lives_[k];
  if (words_.isSet(nc::SP_TLCHIA, k)) life.change = false;
  if (words_.isSet(nc::SP_TLCHA, k)) life.change_group = false;
  words_.set(nc::SN_TLCHI, k, life.change);
  words_.set(nc::SN_TLCH, k, life.change_group);
  words_.set(nc::SN_TLSKPA, k, life.is_skipped);
  words_.set(nc::SN_TLNL, k, life.notice);
}

// ---- what a test sets up

bool Tools::setCartridge(uint32_t number, uint32_t pots, uint32_t first, uint32_t columns) {
  if (number < 1 || number > kMagazines || pots > 1000 || first > 100000 || columns > pots) return false;
  Magazine& magazine = magazines_[number - 1];
  magazine.first = first;
  magazine.columns = columns;
  magazine.pots.assign(pots, 0);
  return true;
}

bool Tools::setPattern(uint32_t figure, const uint32_t (&halves)[4], bool is_circle) {
  if (figure < 1 || figure > kPatterns || *std::max_element(std::begin(halves), std::end(halves)) > 100) return false;
  patterns_[figure - 1] = {halves[0], halves[1], halves[2], halves[3], is_circle};
  return true;
}

bool Tools::setPot(uint32_t cartridge, uint32_t pot, uint32_t data_number) {
  uint32_t* const at = potAt(cartridge, pot);
  if (at == nullptr || data_number > kRows) return false;
  *at = data_number;
  return true;
}

bool Tools::pot(uint32_t cartridge, uint32_t pot, uint32_t& data_number) const {
  const uint32_t* const at = potAt(cartridge, pot);
  if (at != nullptr) data_number = *at;
  return at != nullptr;
}

bool Tools::setItem(uint32_t data_number, uint32_t item, double value) {
  if (data_number < 1 || data_number > kRows || item < 1 || item > kItems) return false;
  if (!isRealToolItem(item)) value = std::floor(value);
  if (checkItem(item, value) != kDone) return false;
  tools_[data_number - 1][item - 1] = value;
  return true;
}

bool Tools::item(uint32_t data_number, uint32_t item, double& value) const {
  if (data_number < 1 || data_number > kRows || item < 1 || item > kItems) return false;
  value = tools_[data_number - 1][item - 1];
  return true;
}

bool Tools::resetLife(uint32_t data_number) {
  if (data_number < 1 || data_number > kRows) return false;
  Tool& tool = tools_[data_number - 1];
  set(tool, ToolItem::Counter, 0);
  if (of(tool, ToolItem::Status) != kUnmanaged) set(tool, ToolItem::Status, kUnused);
  return true;
}

}  // namespace rung::nct

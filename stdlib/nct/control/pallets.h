// SPDX-License-Identifier: Apache-2.0
// Pallet management of the simulated control: the table of pallets and its services. In: blocks of services, parameters
// N3300 to N3302. Out: codes of execution, the program that comes next. Used by control.cpp and services.cpp. NCT
// manual 6.27.
#pragma once

#include <array>

#include "block.h"
#include "parameters.h"

namespace rung::nct {

// Items of a pallet by their data numbers in MW306; the last three are doubles.
enum class PalletItem : uint32_t {
  Identifier = 1,
  Status,
  Priority,
  Executed,
  Assigned,
  Programs,
  CustomBits,
  FirstCustom,
  LastCustom = 10
};

class Pallets {
 public:
  explicit Pallets(const Parameters& parameters) : parameters_(parameters) {}

  Code exchangePlaces(const Block& block);  // MW300
  Code writePallet(const Block& block);     // MW303
  Code readPallet(Block& block) const;      // MR304
  Code writeItem(const Block& block);       // MW306
  Code readItem(Block& block) const;        // MR307
  Code findPallet(Block& block) const;      // MR308
  Code readColumn(Block& block) const;      // MR309
  // MW41: the next program of the pallet in the working space.
  Code nextProgram(uint32_t identifier, uint32_t& program) const;

  void setEdited(bool edited) { is_edited_ = edited; }
  bool isEdited() const { return is_edited_; }

  template <class Archive>
  void transfer(Archive& archive) {
    archive.values(pallets_, is_edited_);
  }

 private:
  static constexpr uint32_t kRows = 128, kPrograms = 64, kLastItem = static_cast<uint32_t>(PalletItem::LastCustom);
  struct Pallet {
    std::array<double, kLastItem> items{};  // that of the programs is not used
    std::array<uint32_t, kPrograms> programs{};
  };
  struct Rows {
    uint32_t first = 0, count = 0;
  };

  Rows rowsOf(uint32_t magazine) const;
  bool hasItem(uint32_t item) const;
  uint32_t columnsOf(uint32_t amount) const;
  static double of(const Pallet& pallet, PalletItem item) { return pallet.items[static_cast<uint32_t>(item) - 1]; }
  static bool isEmpty(const Pallet& pallet) { return of(pallet, PalletItem::Identifier) == 0; }
  static Code check(const Pallet& pallet, uint32_t item);
  // The place of words 2 and 3.
  Code findRow(const Block& block, uint32_t& row) const;
  void recall(uint32_t row, double identifier);
  bool matches(const Pallet& pallet, uint32_t item, uint32_t value) const;

  const Parameters& parameters_;
  // The working space, the loading point, the magazine, the virtual magazine; without a loading point its row is not
  // used.
  std::array<Pallet, kRows + 1> pallets_{};
  bool is_edited_ = false;
};

}  // namespace rung::nct

// SPDX-License-Identifier: Apache-2.0
// Tool management of the simulated control: the tables of tools, cartridges and patterns, their services, the choice of
// a tool for a T code, and tool life. In: blocks of services, what channels and spindles do. Out: codes of execution,
// the signals of tool life. Used by control.cpp and services.cpp. NCT manual 6.26, 7.14.
#pragma once

#include <array>
#include <vector>

#include "block.h"
#include "channels.h"
#include "parameters.h"
#include "spindles.h"
#include "words.h"

namespace rung::nct {

// Items of a tool by their data numbers in MW106; those up to Speed and UserBits are words.
enum class ToolItem : uint32_t {
  Type = 1,
  Info,
  Figure,
  Status,
  Counter,
  Life,
  Notice,
  H,
  D,
  G,
  W,
  Speed,
  Feed,
  UserBits,
  FirstUser,
  LastUser = 33
};

// Who works on the tables: a service that writes is refused (N_TLEDT, N_TLSV), one that reads may have to wait.
struct TableUse {
  bool edited = false, saved = false, searched = false;
};

class Tools {
 public:
  static constexpr uint32_t kRows = 64;

  Tools(Words& words, const Parameters& parameters, Channels& channels, const Spindles& spindles);

  // A cycle of Main, after that of the channels.
  void beginCycle(double seconds);
  FoundTool find(uint32_t type) const;

  Code exchangePots(const Block& block);    // MW100
  Code findEmptyPot(Block& block) const;    // MR101
  Code registerTool(const Block& block);    // MW102
  Code writeTool(const Block& block);       // MW103
  Code readTool(Block& block) const;        // MR104
  Code deleteTool(const Block& block);      // MW105
  Code writeItem(const Block& block);       // MW106
  Code readItem(Block& block) const;        // MR107
  Code findByUserData(Block& block) const;  // MR108

  // A test sets these up; false: there is no such thing.
  void setUse(const TableUse& use) { use_ = use; }
  bool setCartridge(uint32_t number, uint32_t pots, uint32_t first, uint32_t columns);
  bool setPattern(uint32_t figure, const uint32_t (&halves)[4], bool is_circle);
  bool setPot(uint32_t cartridge, uint32_t pot, uint32_t data_number);
  bool pot(uint32_t cartridge, uint32_t pot, uint32_t& data_number) const;
  bool setItem(uint32_t data_number, uint32_t item, double value);
  bool item(uint32_t data_number, uint32_t item, double& value) const;
  bool resetLife(uint32_t data_number);

  template <class Archive>
  void transfer(Archive& archive) {
    archive.values(tools_, spindle_pots_, patterns_, lives_, use_, is_modified_);
    for (Magazine& magazine : magazines_) {
      archive.values(magazine.first, magazine.columns);
      archive.list(magazine.pots);
    }
  }

 private:
  static constexpr uint32_t kMagazines = 4, kPatterns = 20, kItems = static_cast<uint32_t>(ToolItem::LastUser);
  using Tool = std::array<double, kItems>;
  struct Magazine {
    uint32_t first = 1, columns = 0;  // columns of a matrix; 0: a chain
    std::vector<uint32_t> pots;       // data numbers
  };
  struct Pattern {
    uint32_t left = 0, right = 0, up = 0, down = 0;  // half pots
    bool is_circle = false;
  };
  // Signals of the tool in a spindle.
  struct SpindleLife {
    bool change = false, change_group = false, notice = false;
    bool is_skipped = false;        // its tool was told to be broken
    uint32_t waits_for_change = 0;  // data number of a tool just broken
    double rest = 0;                // of a second
  };
  enum class Access : uint8_t { Read, Write };
  struct Place {
    uint32_t cartridge, pot;
  };

  bool isLocked() const { return use_.edited || use_.saved; }
  bool mustWait() const;
  static double of(const Tool& tool, ToolItem item) { return tool[static_cast<uint32_t>(item) - 1]; }
  static void set(Tool& tool, ToolItem item, double value) { tool[static_cast<uint32_t>(item) - 1] = value; }
  static bool isValid(const Tool& tool) { return (static_cast<uint32_t>(of(tool, ToolItem::Info)) & 1) != 0; }
  static bool isSearchable(const Tool& tool);
  static Code checkItem(uint32_t item, double value);

  bool hasCartridge(uint32_t cartridge) const;
  const uint32_t* potAt(uint32_t cartridge, uint32_t pot) const;
  uint32_t* potAt(uint32_t cartridge, uint32_t pot);
  Code checkPot(const Block& block, uint32_t at, Code no_cartridge, Code no_pot) const;
  Code findRow(const Block& block, Access access, uint32_t& row) const;
  bool findPlace(uint32_t data_number, Place& place) const;
  Pattern patternOf(uint32_t data_number) const;
  bool cover(const Magazine& magazine, uint32_t pot, const Pattern& pattern, std::vector<uint32_t>& cells) const;

  void count(uint32_t spindle, uint32_t units, bool are_seconds);
  void breakTool(uint32_t spindle);
  void requestChange(uint32_t spindle, const Tool& tool);
  void tell(uint32_t spindle);

  Words& words_;
  const Parameters& parameters_;
  Channels& channels_;
  const Spindles& spindles_;
  std::array<Tool, kRows> tools_{};
  std::array<Magazine, kMagazines> magazines_;
  std::array<std::array<uint32_t, 2>, kSpindles> spindle_pots_{};  // in the spindle, standing by
  std::array<Pattern, kPatterns> patterns_;
  std::array<SpindleLife, kSpindles> lives_;
  TableUse use_;
  bool is_modified_ = false;  // since the cycle before
};

}  // namespace rung::nct

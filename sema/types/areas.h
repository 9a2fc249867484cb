// SPDX-License-Identifier: Apache-2.0
// The memory areas that addresses name: %IX0.0 is a bit of the area `I`. In: the rows below, which every program has,
// and those of `[area …]` sections in rung.project. Out: Symbols::areas, an AreaId for each located variable, and the
// table that a host reads (rung_area in rung/module.h). Nothing else knows how many areas exist or what they mean.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rung::types {

// An index into the list of areas.
struct AreaId {
  uint8_t index = 0;
  friend bool operator==(AreaId, AreaId) = default;
  friend auto operator<=>(AreaId, AreaId) = default;
};

// Who writes an area between the cycles of a program.
enum class AreaOwner : uint8_t {
  Input,   // the host: before a cycle. The program reads it
  Output,  // the program; the host takes it after a cycle, and sets it to safe values after a fault
  Memory,  // the program alone, or what the product defines
  Shared,  // tasks that write different bits of a word: what a task has changed leaves it. Variables overlap as a rule
};
// As written in rung.project and in the text form of the IR: "input".
constexpr std::string_view spelling(AreaOwner owner) {
  switch (owner) {
    case AreaOwner::Input: return "input";
    case AreaOwner::Output: return "output";
    case AreaOwner::Shared: return "shared";
    case AreaOwner::Memory: break;
  }
  return "memory";
}

inline std::optional<AreaOwner> ownerCalled(std::string_view spelled) {
  for (const AreaOwner owner : {AreaOwner::Input, AreaOwner::Output, AreaOwner::Memory, AreaOwner::Shared})
    if (spelled == spelling(owner)) return owner;
  return std::nullopt;
}

struct MemoryArea {
  char letter;  // its name, after `%` in its addresses; not X, B, W, D or L, which are sizes
  AreaOwner owner;
  uint32_t bytes = 0;  // declared size; 0: up to the last byte that the program uses
};
using MemoryAreas = std::vector<MemoryArea>;

// A device of the machine, `[module NAME]` in rung.project: its channels lie in the input and the output area.
struct IoModule {
  std::string name, type;
  std::string station;  // the coupler that it is connected to; empty: the controller's rack
  uint32_t task = 0;    // the bus cycle task: index into the tasks + 1; 0: the cyclic task with the shortest interval
  uint32_t input_offset = 0, output_offset = 0;  // bytes
};

// The most bytes of one area.
inline constexpr uint64_t kMaxAreaBytes = uint64_t{1} << 24;

// IEC 61131-3 ed. 3 table 16; manuals 4.1.1.
inline MemoryAreas standardAreas() {
  return {{'I', AreaOwner::Input}, {'Q', AreaOwner::Output}, {'M', AreaOwner::Memory}};
}
// The two memories of the NCT ladder, which programs with a `.nct` file have besides: 10 000 words, and those up to
// PLCNVRAM of the TimeSlice; after these is what the exchange of both keeps (stdlib/nct/memory.st), which a task takes
// and gives with them. NCT manual 2, 3.3.
inline MemoryAreas nctAreas() { return {{'N', AreaOwner::Shared, 40000}, {'T', AreaOwner::Shared, 16000 + 2 * 5248}}; }

// Of standardAreas().
inline constexpr AreaId kInputArea{0}, kOutputArea{1}, kMemoryArea{2};

// Whether a letter may name an area; the others are sizes.
constexpr bool isAreaLetter(char letter) {
  return letter >= 'A' && letter <= 'Z' && std::string_view("XBWDL").find(letter) == std::string_view::npos;
}

inline std::optional<AreaId> findArea(const MemoryAreas& areas, char letter) {
  for (size_t i = 0; i < areas.size(); ++i)
    if (areas[i].letter == letter) return AreaId{static_cast<uint8_t>(i)};
  return std::nullopt;
}

}  // namespace rung::types

// SPDX-License-Identifier: Apache-2.0
// The symbols and scopes of the numerical control by their names: the tables of the compiler, nc_symbols.def and
// nc_scopes.def. NCT manual chapter 7.
#pragma once

#include <cstdint>

namespace rung::nct {

enum class SymbolKind : uint8_t { Bit, Word, Double };
enum class SymbolDirection : uint8_t { In, Out };  // as the program sees it

// Unit `u` is at word + u, of a double at word + 2 * u.
struct Symbol {
  SymbolKind kind;
  SymbolDirection direction;
  uint16_t word;
  uint8_t bit;
  uint8_t units;
};

namespace nc {
#define NC_SYMBOL(name, kind, direction, word, bit, units) \
  inline constexpr Symbol name{SymbolKind::kind, SymbolDirection::direction, word, bit, units};
#define NC_SPELLING(name, of)
#include "frontend/import/nct/nc_symbols.def"
#undef NC_SPELLING
#undef NC_SYMBOL
}  // namespace nc

// SCP reads these, in the order of nc_scopes.def; NCT manual 6.17.
namespace scope {
enum : uint32_t {
#define NC_SCOPE(name, last) name,
#include "frontend/import/nct/nc_scopes.def"
#undef NC_SCOPE
};
}  // namespace scope

constexpr uint32_t kAxes = 32, kSpindles = 16, kChannels = 8, kDrives = 48;

}  // namespace rung::nct

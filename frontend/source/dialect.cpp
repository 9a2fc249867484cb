// SPDX-License-Identifier: Apache-2.0
// The columns of dialects.def as values.
#include "frontend/source/dialect.h"

#include <iterator>

namespace rung {

namespace {

constexpr LanguageProfile columnOf(Dialect dialect, std::string_view name, bool is_chosen) {
  constexpr bool yes = true, no = false;
  LanguageProfile profile{};
  profile.dialect = dialect;
  profile.is_chosen = is_chosen;
  profile.name = name;
#define RUNG_CELLS(...) __VA_ARGS__
#define RUNG_FEATURE(cells, name, meaning)                                            \
  {                                                                                   \
    constexpr bool values[] = {RUNG_CELLS cells};                                     \
    static_assert(std::size(values) == kDialects, "a cell for each dialect: " #name); \
    profile.name = values[static_cast<uint8_t>(dialect)];                             \
  }
#include "frontend/source/dialects.def"
#undef RUNG_CELLS
  return profile;
}

}  // namespace

constexpr LanguageProfile kProfiles[kDialects] = {
#define RUNG_DIALECT(id, name, is_chosen, meaning) columnOf(Dialect::id, name, is_chosen),
#include "frontend/source/dialects.def"
};

}  // namespace rung

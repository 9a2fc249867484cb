// SPDX-License-Identifier: Apache-2.0
// The dialects of the language (--std) and what differs between them: dialects.def. A Dialect names a column of that
// table; a LanguageProfile is the column, with a bool for each feature. Phases get a Dialect and ask its profile:
// `profile.nested_comments`, never which dialect it is.
#pragma once

#include <cstdint>
#include <string_view>

namespace rung {

enum class Dialect : uint8_t {
#define RUNG_DIALECT(id, name, is_chosen, meaning) id,
#include "frontend/source/dialects.def"
};

inline constexpr uint8_t kDialects = 0
#define RUNG_DIALECT(id, name, is_chosen, meaning) +1
#include "frontend/source/dialects.def"
    ;

inline constexpr Dialect kDefaultDialect = Dialect::Codesys;

struct LanguageProfile {
  Dialect dialect;
  bool is_chosen;         // by --std; the others are for files that Rung itself brings
  std::string_view name;  // of --std, rung.project and {std '…'}
#define RUNG_FEATURE(cells, name, meaning) bool name;
#include "frontend/source/dialects.def"
};

extern const LanguageProfile kProfiles[kDialects];

inline const LanguageProfile& profileOf(Dialect dialect) { return kProfiles[static_cast<uint8_t>(dialect)]; }

}  // namespace rung

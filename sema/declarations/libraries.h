// SPDX-License-Identifier: Apache-2.0
// The index of a library source: the names that it declares and where, found by a light scan without parsing. In: the
// source of one library file. Out: its declarations with the range of source to parse when one of them is first used.
// Called by check() at its start, for every library file.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "frontend/parse/parse.h"
#include "sema/context.h"

namespace rung::sema {

constexpr uint8_t bitOf(Dialect dialect) { return static_cast<uint8_t>(1u << static_cast<unsigned>(dialect)); }
constexpr uint8_t kAllStandards = bitOf(Dialect{kDialects}) - 1;
static_assert(kDialects < 8);

// A POU, a TYPE block or a VAR_GLOBAL block, from the pragmas before it to its END_… keyword.
struct IndexedBlock {
  uint32_t begin = 0, end = 0;
  std::vector<std::string_view> names;  // the POU; the types and enumeration items; the variables
  std::string_view base;                // that the POU extends, without its library
  // {std 'iec2 iec3'}: the dialects that have it, as bits. {std 'iec2, else qualified'}: the others
  // have it by its full name only.
  uint8_t standards = kAllStandards, qualified = 0;
};
std::vector<IndexedBlock> indexLibrary(std::string_view source);

inline constexpr uint32_t kNoLibrary = ~0u;
// An entity of the library __SYSTEM, the compiler's own, by name.
Entity lookUpSystem(Context& context, std::string_view name);
// The structure __SYSTEM.AnyType.
TypeId anyType(Context& context);
void indexLibraries(Context& context);
// A name of the libraries, read on first use; of one library only when `library` is given.
Entity lookUpLibrary(Context& context, NameId name, uint32_t library = kNoLibrary);
// The name by which the module knows a POU or type of a library: with the library's name if the bare name means one of
// the project or of another library.
NameId uniqueNameInLibrary(Context& context, uint32_t library, NameId name);
// `CAA.PVOID`: how messages name it then.
NameId nameWithLibrary(Context& context, uint32_t library, NameId name);

}  // namespace rung::sema

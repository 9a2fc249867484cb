// SPDX-License-Identifier: Apache-2.0
// Located variables and direct addresses: %IX0.3, %QW4, %ID48 as views of the process image; see addresses.cpp.
#pragma once

#include <optional>

#include "sema/context.h"

namespace rung::sema {

// The view of the image at an address; none after a report. `type`: of the variable, or none for a bare address, whose
// type follows from its size (see addressType). Records the bytes used.
std::optional<ImageView> resolveAddress(Context& context, const DirectAddress& address, Loc loc, TypeId type);
// Hierarchical addresses, %QW0.1.2: each gets a separate location, chosen by allocateHierarchical when all other
// addresses are known.
bool isHierarchical(const Context& context, const DirectAddress& address);
// The hidden variable of such an address; `user`: a variable located there, or none. None after a report.
VarId hierarchicalVar(Context& context, const DirectAddress& address, Loc loc, VarId user);
void allocateHierarchical(Context& context);
// BOOL, BYTE, WORD, DWORD or LWORD, by the size letter.
TypeId addressType(const DirectAddress& address);
// The type that `VAR AT %QW5 : INT; END_VAR` without a name gives to an address of this size; none: it gives none.
TypeId declaredAddressType(Context& context, const DirectAddress& address);
// None: no area has that letter, which was reported.
std::optional<types::AreaId> areaOf(Context& context, const DirectAddress& address, Loc loc);
// Equal for addresses that are written alike.
uint64_t addressKey(const Context& context, const DirectAddress& address);
// How many bytes an area may have.
uint64_t areaLimit(const Context& context, types::AreaId area);

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Structures whose members have AT offsets, AT %B2: the members in the order of their offsets, with hidden fields
// for the gaps, so that the natural layout equals the one written; see relative_addresses.cpp.
#pragma once

#include <span>

#include "sema/context.h"

namespace rung::sema {

void layOutMembers(Context& context, TypeId record, std::span<const VarId> members);

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// The names of items as strings, {attribute 'to_string'}; see item_names.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// The function from a number to the name of the item, of an enumeration with {attribute 'to_string'}; else none.
PouId itemNamesOf(Context& context, TypeId type);

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// The order of initial values that read variables (codesys): each is set after those that it reads; see
// initial_order.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void orderInitialValues(Context& context);

}  // namespace rung::sema

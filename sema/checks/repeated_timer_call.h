// SPDX-License-Identifier: Apache-2.0
// Warns of a timer that is called twice in one cycle; see repeated_timer_call.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkRepeatedTimerCalls(Context& context);

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// VAR_TEMP outside of the body that declares it; see shared_temporaries.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// Hidden fields for VAR_TEMP that actions use, variables for those of a base that the body uses.
void shareTemporaries(Context& context, PouId pou);

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// The rules on the settings of tasks that concern several tasks of a resource. Called by check() once.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void checkTaskSettings(Context& context);

}  // namespace rung::sema

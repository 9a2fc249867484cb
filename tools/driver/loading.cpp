// SPDX-License-Identifier: Apache-2.0
// This rung loads compiled code; see module_library.h.
#include "tools/driver/module_library.h"

namespace rung::driver {

bool loadsCode() { return true; }

}  // namespace rung::driver

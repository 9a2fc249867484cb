// SPDX-License-Identifier: Apache-2.0
// Rules for cams whose table the source declares; see cam_tables.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void checkCamTables(Context& context);

}  // namespace rung::sema

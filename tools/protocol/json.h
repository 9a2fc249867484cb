// SPDX-License-Identifier: Apache-2.0
// The JSON of the runtime's monitor under the name that protocols of tools have.
#pragma once

#include "stdlib/runtime/host/json.h"

namespace rung::protocol {

using host::Json;
using host::JsonLimits;
using host::JsonMember;
using host::JsonResult;
using host::parseJson;

}  // namespace rung::protocol

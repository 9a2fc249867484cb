// SPDX-License-Identifier: Apache-2.0
// The symbol file: where each variable lies, as JSON, for monitors, HMIs and other tools that do not link the module.
// In: the description of a module. Out: one object, a row per line; docs/embedding.md describes it. Called by
// module.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ir/description.h"

namespace rung::codegen {

std::string symbolFile(const ir::Description& description, std::string_view module_name, uint32_t pointer_size);

}  // namespace rung::codegen

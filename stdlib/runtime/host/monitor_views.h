// SPDX-License-Identifier: Apache-2.0
// The bodies of the program for clients of the monitor. In: the rows that the driver or an executable gives, and the
// module. Out: JSON: which bodies there are, and in which instances each runs. Called by monitor_requests.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "loaded_module.h"
#include "rung/pou_view.h"

namespace rung::host {

// [{"name", "block", "language", "instances": [path]}]
std::string listPous(const LoadedModule& module, const std::vector<rung_pou_view>& pous);
// Null: there is no such body.
const rung_pou_view* findPou(const std::vector<rung_pou_view>& pous, std::string_view name);

}  // namespace rung::host

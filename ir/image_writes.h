// SPDX-License-Identifier: Apache-2.0
// Finds the parts of the output and memory areas that each task may write: a host that gives tasks their own copy of
// the image takes that from it when the activation ends. In: the module. Out: the rows of rung_module::writes. Called
// by Description.
#pragma once

#include <vector>

#include "ir/ir.h"
#include "rung/module.h"

namespace rung::ir {

// The parts that the bodies of task `task` (its index) write or take the address of, by area and offset, disjoint.
std::vector<rung_write> imageWrites(const Module& module, uint32_t task);

}  // namespace rung::ir

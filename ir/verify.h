// SPDX-License-Identifier: Apache-2.0
// The verifier: every invariant of the IR, numbered in verify.cpp's head comment, which is the IR's specification.
// In: a module or one body. Out: the violations, one line each; empty: the body is well formed.
#pragma once

#include <string>
#include <vector>

#include "ir/ir.h"

namespace rung::ir {

std::vector<std::string> verify(const Module& module);
std::vector<std::string> verify(const Module& module, const Body& body);

}  // namespace rung::ir

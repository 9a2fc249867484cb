// SPDX-License-Identifier: Apache-2.0
// The form of the standard for what Rung and vendors write in other ways, and every edition has: comments (* *), one
// declaration for each name of VAR_EXTERNAL and of structures, sections of located variables, a qualifier for each
// action, STRING[n], semicolons. In: a program and its source. Out: edits that change no meaning and no line, but of
// lists in IL. Called by neutral.cpp.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "tools/conformance/edits.h"
#include "tools/conformance/program.h"
#include "tools/conformance/source.h"

namespace rung::conformance {

// Bodies in Rung's notation of networks, as byte ranges: they stay as they are.
std::vector<std::pair<size_t, size_t>> networksOf(const Source& source);

// A part of the source between two offsets is in one of the ranges.
bool isInside(const std::vector<std::pair<size_t, size_t>>& ranges, size_t at);

std::vector<Edit> standardForm(const Program& program, const Source& source);

}  // namespace rung::conformance

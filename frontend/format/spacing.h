// SPDX-License-Identifier: Apache-2.0
// The white space between two pieces on one line. In: both pieces. Out: whether a blank separates them. What is not
// said here stays as it was written. Used by format.cpp.
#pragma once

#include <string_view>

#include "frontend/format/pieces.h"

namespace rung::format {

enum class Colons : uint8_t { Free, Declares };  // Declares: the first colon of the line has a blank on both sides

bool isSeparated(std::string_view source, const Piece& before, const Piece& next, Colons colons);

}  // namespace rung::format

// SPDX-License-Identifier: Apache-2.0
// The notation of networks for the formatter. In: the pieces of a source. Out: in the bodies between {network LD} and
// {end_network}, what each piece is, the case of its letters, and the blanks that it needs. Expressions and statements
// inside of elements stay as they are elsewhere. Used by format.cpp.
#pragma once

#include <string_view>
#include <vector>

#include "frontend/format/pieces.h"

namespace rung::format {

void markNetworks(std::string_view source, std::vector<Piece>& pieces);

}  // namespace rung::format

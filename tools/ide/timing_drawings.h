// SPDX-License-Identifier: Apache-2.0
// How the outputs of a library block follow its inputs, drawn in characters, which every editor shows. In: the name of
// a block. Out: the lines of its diagram. They are traces of the programs in samples/library. Used by hover.
#pragma once

#include <string_view>

namespace rung::ide {

// Empty: there is none.
std::string_view timingDrawingOf(std::string_view block);

}  // namespace rung::ide

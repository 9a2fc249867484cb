// Bodies in LD, FBD, CFC and SFC as pictures that an engineer recognises. In: the tree as the parsers leave it, before
// a scheduler takes the networks or the chart. Out: SVG, equal bytes for equal bodies. Elements stand where the file
// has them; where it says nothing they are laid out. Called by `rung graph`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "frontend/syntax/tree.h"

namespace rung::picture {

// `name`: the title of the picture, `Pump.Start`. `page`: the width, in pixels, beyond which networks go on in a band
// below; 0: they never do.
std::string drawNetworks(const Tree& tree, const Names& names, const Diagram& diagram, std::string_view name,
                         int32_t page = 0);
std::string drawChart(const Tree& tree, const Names& names, const PouDecl& pou, std::string_view name);

}  // namespace rung::picture

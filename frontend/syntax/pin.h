// SPDX-License-Identifier: Apache-2.0
// Properties of a pin that declarations and diagrams share.
#pragma once

#include <cstdint>

namespace rung {

enum class EdgeKind : uint8_t { None, Rising, Falling };
enum class PinDirection : uint8_t { Input, Output, InOut };

}  // namespace rung

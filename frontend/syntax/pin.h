// What declarations and diagrams both say of a pin.
#pragma once

#include <cstdint>

namespace rung {

enum class EdgeKind : uint8_t { None, Rising, Falling };
enum class PinDirection : uint8_t { Input, Output, InOut };

}  // namespace rung

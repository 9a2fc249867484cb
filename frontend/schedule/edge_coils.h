// SPDX-License-Identifier: Apache-2.0
// The behaviour of coils that detect an edge, in a cycle without one (--edge-coils): IEC 61131-3 ed. 3,
// table 76, makes it FALSE, the IEC syntax manual, 5.7.1.5, leaves it unchanged.
#pragma once

#include <cstdint>

namespace rung::diagram {

enum class EdgeCoils : uint8_t { Pulse, Latch };

}  // namespace rung::diagram

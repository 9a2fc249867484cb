// SPDX-License-Identifier: Apache-2.0
// The dialects of the language: edition 2 and 3 of IEC 61131-3, and CODESYS (--std).
#pragma once

#include <cstdint>

namespace rung {

enum class Dialect : uint8_t { Iec2, Iec3, Codesys };

}  // namespace rung

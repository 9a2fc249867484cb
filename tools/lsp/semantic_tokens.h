// SPDX-License-Identifier: Apache-2.0
// The names of token types and modifiers that the server announces.
#pragma once

#include "tools/protocol/json.h"

namespace rung::lsp {

protocol::Json semanticTokensLegend();

}  // namespace rung::lsp

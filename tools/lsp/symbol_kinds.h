// SPDX-License-Identifier: Apache-2.0
// The kinds of symbols as the protocol numbers them. Used by the answers about symbols and hierarchies.
#pragma once

#include "tools/ide/symbols.h"

namespace rung::lsp {

// SymbolKind of the protocol.
int symbolNumber(ide::SymbolKind kind);

}  // namespace rung::lsp

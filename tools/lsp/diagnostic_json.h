// SPDX-License-Identifier: Apache-2.0
// A diagnostic as the protocol has it. Used by what publishes diagnostics and by what fixes them, which repeats them.
// (publisher.cpp)
#pragma once

#include "tools/ide/diagnostics.h"
#include "tools/lsp/session.h"

namespace rung::lsp {

Json diagnosticJson(const ide::FileDiagnostic& of, Translator& translator, const ide::EmbeddedFiles& embedded);

}  // namespace rung::lsp

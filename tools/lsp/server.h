// SPDX-License-Identifier: Apache-2.0
// The language server: LSP 3.17 over two descriptors. In: what an editor sends. Out: answers, and the diagnostics of
// the whole project after each change. Requests are answered in their order, each on a view with all changes before it;
// when no message waits, the diagnostics are made, and given up for the next message. Whatever is sent, the server goes
// on: what it does not understand gets an error of JSON-RPC. Called by `rung lsp`.
#pragma once

#include <string>

#include "tools/driver/options.h"
#include "tools/driver/sink.h"

namespace rung::lsp {

// Serves until the client ends it. Returns the exit code: 0 after `shutdown`, else 1; 2: the log cannot be written.
int runServer(const driver::ProjectOptions& options, const std::string& log, int input, int output, driver::Sink& sink);

}  // namespace rung::lsp

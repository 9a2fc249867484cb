// SPDX-License-Identifier: Apache-2.0
// The beginning of a session and what changes the set of buffers, folders and files. In: `initialize` and
// notifications. Out: the capabilities of the server; the buffers and projects of the session.
#pragma once

#include "tools/lsp/session.h"

namespace rung::lsp {

Answer initialize(Session& session, const Json& params);
void initialized(Session& session);

void didOpen(Session& session, const Json& params);
void didChange(Session& session, const Json& params);
void didClose(Session& session, const Json& params);
void didSave(Session& session, const Json& params);
void didChangeFolders(Session& session, const Json& params);
void didChangeFiles(Session& session, const Json& params);

}  // namespace rung::lsp

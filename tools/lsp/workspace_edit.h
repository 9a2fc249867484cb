// SPDX-License-Identifier: Apache-2.0
// Edits of files as the client takes them: with the versions of its buffers where it can. In: edits of a view. Out: a
// WorkspaceEdit.
#pragma once

#include <string>
#include <vector>

#include "tools/ide/text_edits.h"
#include "tools/ide/vendor_names.h"
#include "tools/lsp/session.h"

namespace rung::lsp {

Json workspaceEdit(const Session& session, const ide::View& view, const std::vector<ide::TextEdit>& edits,
                   const std::vector<ide::FileMove>& moves = {});

}  // namespace rung::lsp

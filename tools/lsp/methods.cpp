// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/methods.h"

#include "tools/lsp/lifecycle.h"
#include "tools/lsp/requests.h"

namespace rung::lsp {
namespace {

constexpr RequestMethod kRequests[] = {
    {"textDocument/documentSymbol", documentSymbols},
    {"workspace/symbol", workspaceSymbols},
    {"textDocument/foldingRange", foldingRanges},
    {"textDocument/selectionRange", selectionRanges},
    {"textDocument/semanticTokens/full", semanticTokensFull},
    {"textDocument/semanticTokens/full/delta", semanticTokensDelta},
    {"textDocument/semanticTokens/range", semanticTokensRange},
    {"textDocument/hover", hover},
    {"textDocument/declaration", declaration},
    {"textDocument/definition", definition},
    {"textDocument/typeDefinition", typeDefinition},
    {"textDocument/implementation", implementation},
    {"textDocument/references", references},
    {"textDocument/documentHighlight", documentHighlights},
    {"textDocument/prepareRename", prepareRename},
    {"textDocument/rename", rename},
    {"textDocument/prepareCallHierarchy", prepareCallHierarchy},
    {"callHierarchy/incomingCalls", incomingCalls},
    {"callHierarchy/outgoingCalls", outgoingCalls},
    {"textDocument/prepareTypeHierarchy", prepareTypeHierarchy},
    {"typeHierarchy/supertypes", supertypes},
    {"typeHierarchy/subtypes", subtypes},
    {"textDocument/inlayHint", inlayHints},
    {"textDocument/codeAction", codeActions},
    {"textDocument/codeLens", codeLenses},
    {"codeLens/resolve", resolveCodeLens},
    {"textDocument/documentLink", documentLinks},
    {"textDocument/signatureHelp", signatureHelp},
    {"textDocument/completion", completion},
    {"completionItem/resolve", resolveCompletion},
    {"textDocument/formatting", formatDocument},
    {"textDocument/rangeFormatting", formatRange},
    {"textDocument/onTypeFormatting", formatOnType},
};

constexpr NotificationMethod kNotifications[] = {
    {"textDocument/didOpen", didOpen},
    {"textDocument/didChange", didChange},
    {"textDocument/didClose", didClose},
    {"textDocument/didSave", didSave},
    {"workspace/didChangeWorkspaceFolders", didChangeFolders},
    {"workspace/didChangeWatchedFiles", didChangeFiles},
};

}  // namespace

const RequestMethod* findRequest(std::string_view method) {
  for (const RequestMethod& row : kRequests)
    if (method == row.name) return &row;
  return nullptr;
}

const NotificationMethod* findNotification(std::string_view method) {
  for (const NotificationMethod& row : kNotifications)
    if (method == row.name) return &row;
  return nullptr;
}

}  // namespace rung::lsp

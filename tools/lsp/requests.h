// SPDX-License-Identifier: Apache-2.0
// The answers to the requests about documents. In: parameters as the protocol defines them. Out: the answer of the IDE
// (tools/ide) as JSON; null where there is nothing to say. Listed in methods.cpp.
#pragma once

#include "tools/lsp/session.h"

namespace rung::lsp {

// symbols.cpp
Answer documentSymbols(Session& session, const Json& params);
Answer workspaceSymbols(Session& session, const Json& params);
// structure.cpp
Answer foldingRanges(Session& session, const Json& params);
Answer selectionRanges(Session& session, const Json& params);
// semantic_tokens.cpp
Answer semanticTokensFull(Session& session, const Json& params);
Answer semanticTokensDelta(Session& session, const Json& params);
Answer semanticTokensRange(Session& session, const Json& params);
// formatting.cpp
Answer formatDocument(Session& session, const Json& params);
Answer formatRange(Session& session, const Json& params);
Answer formatOnType(Session& session, const Json& params);
// navigation.cpp
Answer declaration(Session& session, const Json& params);
Answer definition(Session& session, const Json& params);
Answer typeDefinition(Session& session, const Json& params);
Answer implementation(Session& session, const Json& params);
Answer hover(Session& session, const Json& params);
Answer signatureHelp(Session& session, const Json& params);
// references.cpp
Answer references(Session& session, const Json& params);
Answer documentHighlights(Session& session, const Json& params);
// rename.cpp
Answer prepareRename(Session& session, const Json& params);
Answer rename(Session& session, const Json& params);
// hierarchy.cpp
Answer prepareCallHierarchy(Session& session, const Json& params);
Answer incomingCalls(Session& session, const Json& params);
Answer outgoingCalls(Session& session, const Json& params);
Answer prepareTypeHierarchy(Session& session, const Json& params);
Answer supertypes(Session& session, const Json& params);
Answer subtypes(Session& session, const Json& params);
// inlay_hints.cpp
Answer inlayHints(Session& session, const Json& params);
// code_actions.cpp
Answer codeActions(Session& session, const Json& params);
// code_lens.cpp
Answer codeLenses(Session& session, const Json& params);
Answer resolveCodeLens(Session& session, const Json& params);
// document_links.cpp
Answer documentLinks(Session& session, const Json& params);
// completion.cpp
Answer completion(Session& session, const Json& params);
Answer resolveCompletion(Session& session, const Json& params);

// The error for parameters without a document.
inline Answer noDocument() { return {kInvalidParams, "`textDocument.uri` must be a string"}; }

}  // namespace rung::lsp

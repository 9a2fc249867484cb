// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/lifecycle.h"

#include <algorithm>
#include <cstdlib>

#include "tools/driver/installation.h"
#include "tools/lsp/semantic_tokens.h"
#include "tools/lsp/uri.h"

namespace rung::lsp {
namespace {

bool has(const Json& list, std::string_view word) {
  return std::any_of(list.items().begin(), list.items().end(), [&](const Json& item) { return item.text() == word; });
}

void readCapabilities(Session& session, const Json& client) {
  const Json& text = client["textDocument"];
  // UTF-8 where the client has it too: the server counts bytes.
  if (has(client["general"]["positionEncodings"], "utf-8")) session.encoding = Encoding::Utf8;
  session.client.progress = client["window"]["workDoneProgress"].isTrue();
  session.client.watches_files = client["workspace"]["didChangeWatchedFiles"]["dynamicRegistration"].isTrue();
  session.client.snippets = text["completion"]["completionItem"]["snippetSupport"].isTrue();
  session.client.hierarchical_symbols = text["documentSymbol"]["hierarchicalDocumentSymbolSupport"].isTrue();
  session.client.location_links = text["definition"]["linkSupport"].isTrue();
  const Json& edit = client["workspace"]["workspaceEdit"];
  session.client.document_changes = edit["documentChanges"].isTrue();
  session.client.renames_files = session.client.document_changes && has(edit["resourceOperations"], "rename");
  for (const Json& command : client["experimental"]["commands"]["commands"].items())
    session.client.commands.insert(std::string(command.text()));
  session.client.only_line_folding = text["foldingRange"]["lineFoldingOnly"].isTrue();
}

void addFolder(Session& session, const Json& uri) {
  if (const std::string path = pathOfUri(uri.text()); !path.empty()) session.projects.addFolder(path);
}

// The user's home, or a folder around it.
bool holdsHome(const std::string& folder) {
  const char* home = std::getenv("HOME");
  return folder == "/" || (home != nullptr && (std::string(home) + "/").starts_with(folder + "/"));
}

// Kate names the home as the root when no folder is open; that is not a project with all that lies below it.
void addFolders(Session& session, const Json& params) {
  const Json& folders = params["workspaceFolders"];
  for (const Json& folder : folders.items()) addFolder(session, folder["uri"]);
  if (!folders.items().empty()) return;
  std::string root(params["rootPath"].isText() ? params["rootPath"].text() : std::string_view());
  if (params["rootUri"].isText()) root = pathOfUri(params["rootUri"].text());
  while (root.size() > 1 && root.ends_with('/')) root.pop_back();
  if (root.starts_with('/') && !holdsHome(root)) session.projects.addFolder(root);
}

Json serverCapabilities(const Session& session) {
  return {
      {"positionEncoding", session.encoding == Encoding::Utf8 ? "utf-8" : "utf-16"},
      {"textDocumentSync", Json{{"openClose", true}, {"change", 2}, {"save", Json::emptyObject()}}},
      {"documentSymbolProvider", true},
      {"workspaceSymbolProvider", true},
      {"hoverProvider", true},
      {"declarationProvider", true},
      {"definitionProvider", true},
      {"typeDefinitionProvider", true},
      {"implementationProvider", true},
      {"referencesProvider", true},
      {"documentHighlightProvider", true},
      {"inlayHintProvider", true},
      {"documentLinkProvider", Json::emptyObject()},
      {"codeActionProvider", Json{{"codeActionKinds", Json::Array{"quickfix", "refactor.extract", "refactor.inline",
                                                                  "refactor.rewrite", "source.fixAll"}}}},
      {"codeLensProvider", Json{{"resolveProvider", true}}},
      {"callHierarchyProvider", true},
      {"typeHierarchyProvider", true},
      {"renameProvider", Json{{"prepareProvider", true}}},
      {"completionProvider",
       Json{{"triggerCharacters", Json::Array{".", "#", "%", "{", "'"}}, {"resolveProvider", true}}},
      {"signatureHelpProvider", Json{{"triggerCharacters", Json::Array{"(", ","}}}},
      {"foldingRangeProvider", true},
      {"selectionRangeProvider", true},
      {"documentFormattingProvider", true},
      {"documentRangeFormattingProvider", true},
      {"documentOnTypeFormattingProvider",
       Json{{"firstTriggerCharacter", ";"}, {"moreTriggerCharacter", Json::Array{"\n"}}}},
      {"semanticTokensProvider",
       Json{{"legend", semanticTokensLegend()}, {"full", Json{{"delta", true}}}, {"range", true}}},
      {"workspace", Json{{"workspaceFolders", Json{{"supported", true}, {"changeNotifications", true}}}}},
  };
}

}  // namespace

Answer initialize(Session& session, const Json& params) {
  readCapabilities(session, params["capabilities"]);
  addFolders(session, params);
  return Json{{"capabilities", serverCapabilities(session)},
              {"serverInfo", Json{{"name", "rung"}, {"version", driver::version()}}}};
}

void initialized(Session& session) {
  if (!session.client.watches_files) return;
  Json watchers;
  watchers.add(
      {{"globPattern",
        "**/*.{st,ST,St,il,IL,iecst,pou,decl,impl,xml,XML,exp,EXP,nct,NCT,mes,cam,TcPOU,TcDUT,TcGVL,TcIO,TcTTO,"
        "plcproj,project}"}});
  session.request("client/registerCapability",
                  {{"registrations", Json::Array{Json{{"id", "rung-files"},
                                                      {"method", "workspace/didChangeWatchedFiles"},
                                                      {"registerOptions", Json{{"watchers", std::move(watchers)}}}}}}});
}

// ---- buffers

void didOpen(Session& session, const Json& params) {
  const Json& document = params["textDocument"];
  const std::string path = pathOfUri(document["uri"].text());
  if (path.empty() || session.projects.embedded().isEmbedded(path)) return;
  session.documents.open(
      path, {std::string(document["uri"].text()), std::string(document["text"].text()), document["version"].integer()});
  session.projects.edit(path, std::string(document["text"].text()));
}

void didChange(Session& session, const Json& params) {
  const Json& document = params["textDocument"];
  const std::string path = pathOfUri(document["uri"].text());
  if (!session.documents.change(path, document["version"].integer(), params["contentChanges"], session.encoding))
    return;
  session.projects.edit(path, session.documents.find(path)->text);
}

void didClose(Session& session, const Json& params) {
  const std::string path = pathOfUri(params["textDocument"]["uri"].text());
  if (session.documents.find(path) == nullptr) return;
  session.documents.close(path);
  session.sent_tokens.erase(path);
  session.projects.close(path);
}

// Other programs may have changed files since the last check, where the client does not watch them.
void didSave(Session& session, const Json& params) {
  const std::string path = pathOfUri(params["textDocument"]["uri"].text());
  if (!path.empty()) session.projects.changedOnDisk(path);
}

// ---- folders and files

void didChangeFolders(Session& session, const Json& params) {
  for (const Json& folder : params["event"]["removed"].items())
    if (const std::string path = pathOfUri(folder["uri"].text()); !path.empty()) session.projects.removeFolder(path);
  for (const Json& folder : params["event"]["added"].items()) addFolder(session, folder["uri"]);
}

void didChangeFiles(Session& session, const Json& params) {
  for (const Json& change : params["changes"].items())
    if (const std::string path = pathOfUri(change["uri"].text()); !path.empty()) session.projects.changedOnDisk(path);
}

}  // namespace rung::lsp

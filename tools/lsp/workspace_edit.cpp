// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/workspace_edit.h"

#include <map>

#include "tools/lsp/uri.h"

namespace rung::lsp {
namespace {

// The edits of each file, by its path.
std::map<std::string, Json::Array> editsByFile(const ide::View& view, const std::vector<ide::TextEdit>& edits,
                                               Encoding encoding) {
  Translator translator(view, encoding);
  std::map<std::string, Json::Array> files;
  for (const ide::TextEdit& edit : edits)
    files[view.pathOf(edit.range.file)].push_back({{"range", translator.range(edit.range)}, {"newText", edit.text}});
  return files;
}

std::string uriOfDocument(const Session& session, const std::string& path) {
  const Document* const open = session.documents.find(path);
  return open != nullptr ? open->uri : uriOf(path);
}

}  // namespace

Json workspaceEdit(const Session& session, const ide::View& view, const std::vector<ide::TextEdit>& edits,
                   const std::vector<ide::FileMove>& moves) {
  auto files = editsByFile(view, edits, session.encoding);
  if (!session.client.document_changes) {
    Json changes = Json::emptyObject();
    for (auto& [path, list] : files) changes.set(uriOfDocument(session, path), std::move(list));
    return {{"changes", std::move(changes)}};
  }
  Json::Array changes;
  for (auto& [path, list] : files) {
    const Document* const open = session.documents.find(path);
    Json document{{"uri", uriOfDocument(session, path)}, {"version", open != nullptr ? Json(open->version) : Json()}};
    changes.push_back({{"textDocument", std::move(document)}, {"edits", std::move(list)}});
  }
  if (session.client.renames_files)
    for (const ide::FileMove& move : moves)
      changes.push_back(
          {{"kind", "rename"}, {"oldUri", uriOfDocument(session, move.from)}, {"newUri", uriOf(move.to)}});
  return {{"documentChanges", std::move(changes)}};
}

}  // namespace rung::lsp

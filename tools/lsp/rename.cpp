// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/rename.h"

#include "tools/lsp/requests.h"
#include "tools/lsp/uri.h"

namespace rung::lsp {
namespace {

// The edits of each file, by its path.
std::map<std::string, Json::Array> editsByFile(const Place& place, const ide::Renaming& renaming, Encoding encoding) {
  Translator translator(*place.view, encoding);
  std::map<std::string, Json::Array> files;
  for (const ide::TextEdit& edit : renaming.edits)
    files[place.view->pathOf(edit.range.file)].push_back(
        {{"range", translator.range(edit.range)}, {"newText", edit.text}});
  return files;
}

std::string uriOfDocument(const Session& session, const std::string& path) {
  const Document* const open = session.documents.find(path);
  return open != nullptr ? open->uri : uriOf(path);
}

Json workspaceEdit(const Session& session, const Place& place, const ide::Renaming& renaming) {
  auto files = editsByFile(place, renaming, session.encoding);
  if (!session.client.document_changes) {
    Json changes = Json::emptyObject();
    for (auto& [path, edits] : files) changes.set(uriOfDocument(session, path), std::move(edits));
    return {{"changes", std::move(changes)}};
  }
  Json::Array changes;
  for (auto& [path, edits] : files) {
    const Document* const open = session.documents.find(path);
    Json document{{"uri", uriOfDocument(session, path)}, {"version", open != nullptr ? Json(open->version) : Json()}};
    changes.push_back({{"textDocument", std::move(document)}, {"edits", std::move(edits)}});
  }
  if (session.client.renames_files)
    for (const ide::FileMove& move : renaming.moves)
      changes.push_back(
          {{"kind", "rename"}, {"oldUri", uriOfDocument(session, move.from)}, {"newUri", uriOf(move.to)}});
  return {{"documentChanges", std::move(changes)}};
}

}  // namespace

Answer prepareRename(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  const ide::Renamable found = ide::renamableAt(*place->view, place->file, place->byte);
  if (!found.refusal.empty()) return {kRequestFailed, found.refusal};
  Translator translator(*place->view, session.encoding);
  return Json{{"range", translator.range(found.at)}, {"placeholder", found.name}};
}

Answer rename(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (!params["newName"].isText()) return {kInvalidParams, "`newName` must be a string"};
  const ide::Project* const project = session.projects.projectOf(place->path);
  if (place->view == nullptr || project == nullptr) return Json();
  const auto trial = [&](const std::map<std::string, std::string>& texts,
                         FunctionRef<std::string(const ide::View&)> use) {
    return session.projects.trial(*project, texts, use);
  };
  const ide::Renaming renaming =
      ide::renameAt(*place->view, place->file, place->byte, std::string(params["newName"].text()),
                    session.client.renames_files, trial);
  if (!renaming.refusal.empty()) return {kRequestFailed, renaming.refusal};
  return workspaceEdit(session, *place, renaming);
}

}  // namespace rung::lsp

// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/rename.h"

#include "tools/lsp/requests.h"
#include "tools/lsp/workspace_edit.h"

namespace rung::lsp {
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
  const auto trial = [&](const std::map<std::string, std::string>& texts) {
    return session.projects.trial(*project, texts, session.cancelled);
  };
  const ide::Renaming renaming =
      ide::renameAt(*place->view, place->file, place->byte, std::string(params["newName"].text()),
                    session.client.renames_files, trial);
  if (!renaming.refusal.empty()) return {kRequestFailed, renaming.refusal};
  return workspaceEdit(session, *place->view, renaming.edits, renaming.moves);
}

}  // namespace rung::lsp

// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/code_actions.h"

#include "tools/ide/refactorings.h"
#include "tools/lsp/diagnostic_json.h"
#include "tools/lsp/requests.h"
#include "tools/lsp/workspace_edit.h"

namespace rung::lsp {
namespace {

const char* nameOf(ide::ActionKind kind) {
  switch (kind) {
    case ide::ActionKind::QuickFix: return "quickfix";
    case ide::ActionKind::Extract: return "refactor.extract";
    case ide::ActionKind::Inline: return "refactor.inline";
    case ide::ActionKind::Rewrite: return "refactor.rewrite";
    case ide::ActionKind::FixAll: return "source.fixAll";
  }
  return "";
}

// Whether the client asks for a kind: for all, for it, or for one above it, as `refactor` is above `refactor.inline`.
class Wanted {
 public:
  explicit Wanted(const Json& only) : only_(only) {}

  bool has(ide::ActionKind kind) const {
    if (!only_.isArray()) return kind != ide::ActionKind::FixAll;  // which is not shown at each place
    const std::string_view name = nameOf(kind);
    for (const Json& item : only_.items()) {
      const std::string_view wanted = item.text();
      if (item.isText() && name.starts_with(wanted) &&
          (name.size() == wanted.size() || wanted.empty() || name[wanted.size()] == '.'))
        return true;
    }
    return false;
  }

 private:
  const Json& only_;
};

class ActionList {
 public:
  ActionList(Session& session, const Place& place)
      : session_(session), translator_(*place.view, session.encoding), view_(*place.view) {}

  void add(const ide::CodeAction& action) {
    if (action.edits.empty()) return;
    Json json{{"title", action.title}, {"kind", nameOf(action.kind)}};
    if (action.diagnostic != nullptr) {
      const ide::EmbeddedFiles& embedded = session_.projects.embedded();
      json.set("diagnostics", Json::Array{diagnosticJson(*action.diagnostic, translator_, embedded)});
      if (action.is_preferred) json.set("isPreferred", true);
    }
    json.set("edit", workspaceEdit(session_, view_, action.edits));
    actions_.push_back(std::move(json));
  }
  Json take() { return std::move(actions_); }

 private:
  Session& session_;
  Translator translator_;
  const ide::View& view_;
  Json::Array actions_;
};

}  // namespace

Answer codeActions(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  ide::Project* const project = session.projects.projectOf(place->path);
  if (place->view == nullptr || project == nullptr) return Json();
  const ide::View& view = *place->view;
  const Positions positions(view.textOf(place->file), session.encoding);
  const ide::FileRange range{place->file, positions.byteOf(positionOf(params["range"]["start"])),
                             positions.byteOf(positionOf(params["range"]["end"]))};
  if (range.end < range.begin) return {kInvalidParams, "`range` ends before it begins"};
  const Wanted wanted(params["context"]["only"]);
  ActionList actions(session, *place);
  if (wanted.has(ide::ActionKind::QuickFix)) {
    const std::vector<ide::FileDiagnostic> diagnostics = ide::diagnosticsOf(view);
    for (const ide::CodeAction& action : ide::quickFixes(view, diagnostics, range)) actions.add(action);
  }
  for (const ide::CodeAction& action : ide::refactoringsAt(view, range))
    if (wanted.has(action.kind)) actions.add(action);
  if (wanted.has(ide::ActionKind::FixAll))
    actions.add(ide::fixAll(view, place->file, session.projects.fixed(*project, place->path)));
  return actions.take();
}

}  // namespace rung::lsp

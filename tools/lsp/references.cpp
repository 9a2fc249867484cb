// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/references.h"

#include "tools/lsp/requests.h"

namespace rung::lsp {
namespace {

// DocumentHighlightKind of the protocol.
int numberOf(ide::ReferenceKind kind) {
  switch (kind) {
    case ide::ReferenceKind::Name: return 1;
    case ide::ReferenceKind::Read: return 2;
    case ide::ReferenceKind::Write: return 3;
  }
  return 1;
}

}  // namespace

Answer references(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  const bool with_declarations = params["context"]["includeDeclaration"].isTrue();
  Translator translator(*place->view, session.encoding);
  Json::Array list;
  for (const ide::Reference& reference : ide::referencesAt(*place->view, place->file, place->byte))
    if (with_declarations || !reference.is_declaration) list.push_back(translator.location(reference.at));
  return Json(std::move(list));
}

Answer documentHighlights(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  Translator translator(*place->view, session.encoding);
  Json::Array list;
  for (const ide::Reference& reference : ide::highlightsAt(*place->view, place->file, place->byte))
    list.push_back({{"range", translator.range(reference.at)}, {"kind", numberOf(reference.kind)}});
  return Json(std::move(list));
}

}  // namespace rung::lsp

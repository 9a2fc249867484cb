// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/document_links.h"

#include "tools/lsp/requests.h"
#include "tools/lsp/uri.h"

namespace rung::lsp {

Answer documentLinks(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  Translator translator(*place->view, session.encoding);
  Json::Array list;
  for (const ide::DocumentLink& link : ide::linksOf(*place->view, place->file))
    list.push_back({{"range", translator.range(link.at)}, {"target", uriOf(link.path)}});
  return Json(std::move(list));
}

}  // namespace rung::lsp

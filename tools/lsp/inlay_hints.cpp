// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/inlay_hints.h"

#include "tools/lsp/requests.h"

namespace rung::lsp {
namespace {

Json hintJson(const ide::InlayHint& hint, Translator& translator) {
  const bool is_pin = hint.kind == ide::HintKind::Pin;
  Json json{{"position", translator.position(hint.at.file, is_pin ? hint.at.begin : hint.at.end)},
            {"label", hint.label},
            {is_pin ? "paddingRight" : "paddingLeft", true}};
  // Type, parameter; a value has no kind.
  if (hint.kind != ide::HintKind::Value) json.set("kind", is_pin ? 2 : 1);
  return json;
}

}  // namespace

Answer inlayHints(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  Translator translator(*place->view, session.encoding);
  const Positions& positions = translator.positionsOf(place->file);
  const ide::FileRange part{place->file, positions.byteOf(positionOf(params["range"]["start"])),
                            positions.byteOf(positionOf(params["range"]["end"]))};
  Json::Array list;
  for (const ide::InlayHint& hint : ide::hintsIn(*place->view, part)) list.push_back(hintJson(hint, translator));
  return Json(std::move(list));
}

}  // namespace rung::lsp

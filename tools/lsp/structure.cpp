// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/structure.h"

#include <set>
#include <tuple>

#include "tools/lsp/requests.h"

namespace rung::lsp {

Answer foldingRanges(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  const Positions positions(place->view->textOf(place->file), session.encoding);
  Json::Array list;
  std::set<std::tuple<uint32_t, uint32_t, ide::FoldKind>> known;  // statements on one line fold as one
  for (const ide::Fold& fold : ide::foldsOf(*place->view, place->file)) {
    const uint32_t first = positions.positionOf(fold.range.begin).line;
    uint32_t last = positions.positionOf(fold.range.end).line;
    if (fold.keeps_last_line && last > first + 1) --last;
    if (last <= first || !known.insert({first, last, fold.kind}).second) continue;
    Json json{{"startLine", first}, {"endLine", last}};
    if (fold.kind == ide::FoldKind::Comment) json.set("kind", "comment");
    if (fold.kind == ide::FoldKind::Region) json.set("kind", "region");
    list.push_back(std::move(json));
  }
  return Json(std::move(list));
}

Answer selectionRanges(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  Translator translator(*place->view, session.encoding);
  const Positions& positions = translator.positionsOf(place->file);
  Json::Array list;
  for (const Json& position : params["positions"].items()) {
    Json around;
    const std::vector<ide::FileRange> ranges =
        ide::selectionAt(*place->view, place->file, positions.byteOf(positionOf(position)));
    for (auto range = ranges.rbegin(); range != ranges.rend(); ++range) {
      Json json{{"range", translator.range(*range)}};
      if (!around.isNull()) json.set("parent", std::move(around));
      around = std::move(json);
    }
    list.push_back(std::move(around));
  }
  return Json(std::move(list));
}

}  // namespace rung::lsp

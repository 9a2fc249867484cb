// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/formatting.h"

#include "tools/lsp/requests.h"

namespace rung::lsp {
namespace {

Answer format(Session& session, const Json& params, bool is_range) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  format::LineRange lines;
  if (is_range) {
    const Position begin = positionOf(params["range"]["start"]), end = positionOf(params["range"]["end"]);
    lines.first = begin.line + 1;
    // A selection of whole lines ends at the beginning of the next one.
    lines.last = end.character == 0 && end.line > begin.line ? end.line : end.line + 1;
  }
  const auto edits = ide::formattingOf(*place->view, place->file, lines);
  if (!edits) return Json();
  Translator translator(*place->view, session.encoding);
  Json::Array list;
  for (const ide::TextEdit& edit : *edits)
    list.push_back({{"range", translator.range(edit.range)}, {"newText", edit.text}});
  return Json(std::move(list));
}

}  // namespace

Answer formatDocument(Session& session, const Json& params) { return format(session, params, false); }
Answer formatRange(Session& session, const Json& params) { return format(session, params, true); }

}  // namespace rung::lsp

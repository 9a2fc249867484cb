// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/formatting.h"

#include "tools/lsp/requests.h"

namespace rung::lsp {
namespace {

Answer format(Session& session, const Json& params, format::LineRange lines) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  const auto edits = ide::formattingOf(*place->view, place->file, lines);
  if (!edits) return Json();
  Translator translator(*place->view, session.encoding);
  Json::Array list;
  for (const ide::TextEdit& edit : *edits)
    list.push_back({{"range", translator.range(edit.range)}, {"newText", edit.text}});
  return Json(std::move(list));
}

}  // namespace

Answer formatDocument(Session& session, const Json& params) { return format(session, params, {}); }

Answer formatRange(Session& session, const Json& params) {
  const Position begin = positionOf(params["range"]["start"]), end = positionOf(params["range"]["end"]);
  // A selection of whole lines ends at the beginning of the next one.
  const bool is_whole = end.character == 0 && end.line > begin.line;
  return format(session, params, {begin.line + 1, is_whole ? end.line : end.line + 1});
}

// The line that has been finished: with a `;`, or the one above the new one.
Answer formatOnType(Session& session, const Json& params) {
  const uint32_t line = positionOf(params["position"]).line;
  const bool is_new_line = params["ch"].text() == "\n";
  if (is_new_line && line == 0) return Json();
  const uint32_t finished = is_new_line ? line : line + 1;
  return format(session, params, {finished, finished});
}

}  // namespace rung::lsp

// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/hierarchy.h"

#include "tools/lsp/requests.h"
#include "tools/lsp/symbol_kinds.h"

namespace rung::lsp {
namespace {

using Find = std::optional<ide::HierarchyItem> (*)(const ide::View&, FileId, uint32_t);

// A later request about the item finds it by a place with its name in the project: that of its declaration, or of a
// call, because the sources of libraries are not those of a project.
Json itemJson(const ide::HierarchyItem& item, const ide::FileRange& named_at, Translator& translator) {
  Json name = translator.location(item.at.name);
  Json json{{"name", item.name},
            {"kind", symbolNumber(item.kind)},
            {"uri", name["uri"]},
            {"range", translator.range(item.at.range)},
            {"selectionRange", name["range"]},
            {"data", translator.location(named_at)}};
  if (!item.container.empty()) json.set("detail", item.container);
  return json;
}

Answer prepare(Session& session, const Json& params, Find find) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  const auto item = place->view == nullptr ? std::nullopt : find(*place->view, place->file, place->byte);
  if (!item) return Json();
  Translator translator(*place->view, session.encoding);
  return Json(Json::Array{itemJson(*item, {place->file, place->byte, place->byte}, translator)});
}

// The item of a request, found again.
struct Asked {
  Place place;
  ide::HierarchyItem item;
};
std::optional<Asked> askedItem(Session& session, const Json& params, Find find) {
  const Json& named_at = params["item"]["data"];
  const std::optional<Place> place =
      placeOf(session, {{"textDocument", Json{{"uri", named_at["uri"]}}}, {"position", named_at["range"]["start"]}});
  if (!place || place->view == nullptr) return std::nullopt;
  auto found = find(*place->view, place->file, place->byte);
  if (!found) return std::nullopt;
  return Asked{*place, std::move(*found)};
}

Json callsJson(const std::vector<ide::Caller>& callers, bool is_outgoing, Translator& translator) {
  Json::Array list;
  for (const ide::Caller& caller : callers) {
    Json::Array ranges;
    for (const ide::FileRange& at : caller.calls) ranges.push_back(translator.range(at));
    const ide::FileRange& named_at = is_outgoing ? caller.calls.front() : caller.item.at.name;
    list.push_back({{is_outgoing ? "to" : "from", itemJson(caller.item, named_at, translator)},
                    {"fromRanges", std::move(ranges)}});
  }
  return Json(std::move(list));
}

Json itemsJson(const std::vector<ide::HierarchyItem>& items, Translator& translator) {
  Json::Array list;
  for (const ide::HierarchyItem& item : items) list.push_back(itemJson(item, item.at.name, translator));
  return Json(std::move(list));
}

}  // namespace

Answer prepareCallHierarchy(Session& session, const Json& params) { return prepare(session, params, ide::callableAt); }

Answer incomingCalls(Session& session, const Json& params) {
  const auto asked = askedItem(session, params, ide::callableAt);
  if (!asked) return Json();
  Translator translator(*asked->place.view, session.encoding);
  return callsJson(ide::incomingCalls(*asked->place.view, asked->item.entity), false, translator);
}

Answer outgoingCalls(Session& session, const Json& params) {
  const auto asked = askedItem(session, params, ide::callableAt);
  if (!asked) return Json();
  Translator translator(*asked->place.view, session.encoding);
  return callsJson(ide::outgoingCalls(*asked->place.view, asked->item.entity), true, translator);
}

Answer prepareTypeHierarchy(Session& session, const Json& params) { return prepare(session, params, ide::derivableAt); }

Answer supertypes(Session& session, const Json& params) {
  const auto asked = askedItem(session, params, ide::derivableAt);
  if (!asked) return Json();
  Translator translator(*asked->place.view, session.encoding);
  return itemsJson(ide::supertypesOf(*asked->place.view, asked->item.entity), translator);
}

Answer subtypes(Session& session, const Json& params) {
  const auto asked = askedItem(session, params, ide::derivableAt);
  if (!asked) return Json();
  Translator translator(*asked->place.view, session.encoding);
  return itemsJson(ide::subtypesOf(*asked->place.view, asked->item.entity), translator);
}

}  // namespace rung::lsp

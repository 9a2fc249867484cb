// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tools/ide/symbols.h"
#include "tools/lsp/requests.h"
#include "tools/lsp/symbol_kinds.h"
#include "tools/lsp/uri.h"

namespace rung::lsp {
int symbolNumber(ide::SymbolKind kind) {
  using Kind = ide::SymbolKind;
  switch (kind) {
    case Kind::Program:
    case Kind::Configuration:
    case Kind::Resource: return 2;  // module
    case Kind::Namespace: return 3;
    case Kind::FunctionBlock:
    case Kind::Class:
    case Kind::Type: return 5;
    case Kind::Method:
    case Kind::Action: return 6;
    case Kind::Property: return 7;
    case Kind::Field: return 8;
    case Kind::Enumeration: return 10;
    case Kind::Interface: return 11;
    case Kind::Function: return 12;
    case Kind::Variable: return 13;
    case Kind::Constant: return 14;
    case Kind::Item: return 22;
    case Kind::Structure: return 23;
    case Kind::Task:
    case Kind::Step:
    case Kind::Transition: return 24;  // event
  }
  return 13;
}

namespace {

Json nested(const ide::Symbol& symbol, Translator& translator) {
  Json json{{"name", symbol.name},
            {"kind", symbolNumber(symbol.kind)},
            {"range", translator.range(symbol.range)},
            {"selectionRange", translator.range(symbol.name_range)}};
  if (!symbol.detail.empty()) json.set("detail", symbol.detail);
  Json::Array children;
  for (const ide::Symbol& child : symbol.children) children.push_back(nested(child, translator));
  if (!children.empty()) json.set("children", std::move(children));
  return json;
}

Json flat(const ide::Symbol& symbol, const std::string& container, Json location) {
  Json json{{"name", symbol.name}, {"kind", symbolNumber(symbol.kind)}, {"location", std::move(location)}};
  if (!container.empty()) json.set("containerName", container);
  return json;
}

void addFlat(const ide::Symbol& symbol, const std::string& container, Translator& translator, Json::Array& list) {
  list.push_back(flat(symbol, container, translator.location(symbol.range)));
  for (const ide::Symbol& child : symbol.children) addFlat(child, symbol.name, translator, list);
}

}  // namespace

Answer documentSymbols(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  Translator translator(*place->view, session.encoding);
  Json::Array list;
  for (const ide::Symbol& symbol : ide::symbolsOf(*place->view, place->file)) {
    if (session.client.hierarchical_symbols)
      list.push_back(nested(symbol, translator));
    else
      addFlat(symbol, {}, translator, list);
  }
  return Json(std::move(list));
}

Answer workspaceSymbols(Session& session, const Json& params) {
  constexpr size_t kMost = 300;
  struct Found {
    int score;
    Json json;
  };
  std::vector<Found> found;
  for (const auto& project : session.projects.all()) {
    const ide::View* const view = session.projects.update(*project, session.cancelled);
    if (view == nullptr) continue;
    Translator translator(*view, session.encoding);
    for (const ide::FoundSymbol& one : ide::symbolsMatching(*view, params["query"].text(), kMost))
      found.push_back({one.score, flat(one.symbol, one.container, translator.location(one.symbol.name_range))});
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.score > b.score; });
  Json::Array list;
  for (Found& one : found)
    if (list.size() < kMost) list.push_back(std::move(one.json));
  return Json(std::move(list));
}

}  // namespace rung::lsp

// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion.h"

#include <algorithm>
#include <cstdio>

#include "frontend/source/names.h"
#include "tools/lsp/requests.h"
#include "tools/lsp/uri.h"

namespace rung::lsp {
namespace {

// CompletionItemKind of the protocol.
int numberOf(ide::CompletionKind kind) {
  using Kind = ide::CompletionKind;
  switch (kind) {
    case Kind::Method: return 2;
    case Kind::Function: return 3;
    case Kind::Field:
    case Kind::Pin: return 5;
    case Kind::Variable: return 6;
    case Kind::Block: return 7;
    case Kind::Interface: return 8;
    case Kind::List: return 9;
    case Kind::Property:
    case Kind::Key: return 10;
    case Kind::Enumeration: return 13;
    case Kind::Keyword:
    case Kind::Pragma: return 14;
    case Kind::Snippet: return 15;
    case Kind::Item: return 20;
    case Kind::Constant: return 21;
    case Kind::Structure: return 22;
    case Kind::Type: return 25;
  }
  return 1;
}

constexpr std::string_view kCall = "(…)";

// For clients without snippets: the text up to the first place.
std::string withoutPlaces(const ide::CompletionItem& item) {
  const size_t place = item.insert.find('$');
  return place == std::string::npos ? item.insert : item.label;
}

// Clients sort by this text: by rank, and within it by name.
std::string sortText(const ide::CompletionItem& item) {
  return std::to_string(item.rank) + foldedIdentifier(item.label);
}

Json itemJson(const ide::CompletionItem& item, const Json& replaced, const Json& data, bool snippets) {
  Json json{{"label", item.label}, {"kind", numberOf(item.kind)}, {"sortText", sortText(item)}, {"data", data}};
  if (!item.detail.empty()) json.set("detail", item.detail);
  std::string text = item.insert.empty() ? item.label : item.insert;
  if (item.is_snippet && !snippets) text = withoutPlaces(item);
  if (item.is_snippet && snippets) json.set("insertTextFormat", 2);
  json.set("textEdit", {{"range", replaced}, {"newText", std::move(text)}});
  return json;
}

class ProjectTrial final : public ide::CompletionTrial {
 public:
  // `is_on`: there is a trial.
  ProjectTrial(const ide::Projects& projects, const ide::Project& project, bool is_on)
      : projects_(projects), project_(project), is_on_(is_on) {}
  std::optional<std::vector<std::string>> errorsOf(sema::PouId pou, const std::vector<std::string>& statements,
                                                   bool in_copy) override {
    if (!is_on_) return std::nullopt;
    return in_copy ? projects_.errorsInCopy(project_, pou, statements) : projects_.errorsOf(project_, pou, statements);
  }
  std::optional<std::string> goodTypes(const workspace::Analysis::TypeTrial& trial) override {
    return is_on_ ? projects_.goodTypes(project_, trial) : std::nullopt;
  }

 private:
  const ide::Projects& projects_;
  const ide::Project& project_;
  const bool is_on_;
};

// The completions at a place, for a request and for the item that a client asks more about.
struct Found {
  Place place;
  ide::Completion completion;
};
std::optional<Found> completionsOf(Session& session, const Json& params, bool is_tried) {
  std::optional<Place> place = placeOf(session, params);
  if (!place || place->view == nullptr) return std::nullopt;
  const ide::Project* const project = session.projects.projectOf(place->path);
  if (project == nullptr) return std::nullopt;
  ProjectTrial trial(session.projects, *project, is_tried);
  ide::Completion completion =
      ide::completionsAt(*place->view, session.projects.libraries(), place->file, place->byte, trial);
  return Found{std::move(*place), std::move(completion)};
}

}  // namespace

Answer completion(Session& session, const Json& params) {
  if (!params["textDocument"]["uri"].isText()) return noDocument();
  const std::optional<Found> found = completionsOf(session, params, true);
  if (!found) return Json();
  Translator translator(*found->place.view, session.encoding);
  const Json replaced = translator.range(found->completion.replaced);
  const Json data{{"textDocument", Json{{"uri", params["textDocument"]["uri"]}}}, {"position", params["position"]}};
  Json::Array items;
  const std::vector<ide::CompletionItem>& all = found->completion.items;
  for (const ide::CompletionItem& item : all) {
    // Of a call that a client cannot fill in only the name is left.
    const bool is_name_alone = !session.client.snippets && item.label.ends_with(kCall);
    ide::CompletionItem name = is_name_alone ? item : ide::CompletionItem();
    if (is_name_alone) name.label.resize(item.label.size() - kCall.size());
    const auto has_label = [&](const ide::CompletionItem& other) { return other.label == name.label; };
    if (is_name_alone && std::any_of(all.begin(), all.end(), has_label)) continue;
    items.push_back(itemJson(is_name_alone ? name : item, replaced, data, session.client.snippets));
  }
  return Json{{"isIncomplete", found->completion.is_incomplete}, {"items", std::move(items)}};
}

// The documentation, which is read only for the item that is shown.
Answer resolveCompletion(Session& session, const Json& params) {
  Json item = params;
  const std::optional<Found> found = completionsOf(session, params["data"], false);
  if (!found) return item;
  for (const ide::CompletionItem& candidate : found->completion.items) {
    if (candidate.label != params["label"].text() || numberOf(candidate.kind) != params["kind"].integer()) continue;
    const std::string text = ide::documentationOf(*found->place.view, candidate);
    if (!text.empty()) item.set("documentation", {{"kind", "markdown"}, {"value", text}});
    break;
  }
  return item;
}

}  // namespace rung::lsp

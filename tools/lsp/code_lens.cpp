// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/code_lens.h"

#include <algorithm>

#include "tools/ide/references.h"
#include "tools/lsp/requests.h"

namespace rung::lsp {
namespace {

// A command that the client has; else only its title is shown.
Json command(const Session& session, std::string title, const char* name, Json::Array arguments) {
  const bool is_known = session.client.commands.count(name) != 0;
  Json json{{"title", std::move(title)}, {"command", is_known ? name : ""}};
  if (is_known) json.set("arguments", std::move(arguments));
  return json;
}

}  // namespace

Answer codeLenses(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  Translator translator(*place->view, session.encoding);
  Json::Array list;
  const bool has_debugger = session.client.commands.count("rung.debugTest") != 0;
  for (const ide::CodeLens& lens : ide::lensesOf(*place->view, place->file)) {
    Json json{{"range", translator.range(lens.at)}};
    switch (lens.kind) {
      case ide::LensKind::References: json.set("data", {{"textDocument", params["textDocument"]}}); break;
      case ide::LensKind::Test:
        json.set("command", command(session, "run test", "rung.runTest", {params["textDocument"]["uri"], lens.text}));
        break;
      case ide::LensKind::Task: json.set("command", command(session, lens.text, "", {})); break;
    }
    list.push_back(std::move(json));
    if (lens.kind != ide::LensKind::Test || !has_debugger) continue;
    Json debug{{"range", translator.range(lens.at)}};
    debug.set("command", command(session, "debug", "rung.debugTest", {params["textDocument"]["uri"], lens.text}));
    list.push_back(std::move(debug));
  }
  return Json(std::move(list));
}

// Counts the references of the name at the lens.
Answer resolveCodeLens(Session& session, const Json& params) {
  Json lens = params;
  const Json& document = params["data"]["textDocument"];
  const std::optional<Place> place =
      placeOf(session, {{"textDocument", document}, {"position", params["range"]["start"]}});
  if (!place || place->view == nullptr) return lens;
  Translator translator(*place->view, session.encoding);
  Json::Array locations;
  for (const ide::Reference& reference : ide::referencesAt(*place->view, place->file, place->byte))
    if (!reference.is_declaration) locations.push_back(translator.location(reference.at));
  const size_t count = locations.size();
  lens.set("command",
           command(session, std::to_string(count) + (count == 1 ? " reference" : " references"), "rung.showReferences",
                   {document["uri"], params["range"]["start"], std::move(locations)}));
  return lens;
}

}  // namespace rung::lsp

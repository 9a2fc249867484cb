// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/diagram.h"

#include "tools/ide/meanings.h"
#include "tools/lsp/requests.h"
#include "tools/lsp/uri.h"

namespace rung::lsp {

// `rung/diagram`: the text is that of the buffer, whether or not the project has been checked with it.
Answer diagram(Session& session, const Json& params) {
  const Json& uri = params["textDocument"]["uri"];
  if (!uri.isText()) return noDocument();
  const std::string path = pathOfUri(uri.text());
  ide::Project* const project = path.empty() ? nullptr : session.projects.projectOf(path);
  if (project == nullptr) return Json();
  const ide::View* const view =
      project->view() != nullptr ? project->view() : session.projects.update(*project, session.cancelled);
  if (view == nullptr) return Json();
  const Document* const open = session.documents.find(path);
  const FileId file = view->fileAt(path);
  if (open == nullptr && !file) return Json();
  const std::string text = open != nullptr ? open->text : std::string(view->textOf(file));
  const Positions positions(text, session.encoding);
  std::optional<uint32_t> byte;
  if (params["position"].isObject()) byte = positions.byteOf(positionOf(params["position"]));

  driver::ProjectOptions options = session.projects.options();
  const sema::Project* const known = view->snapshot().project();
  if (known != nullptr) options.dialect = known->options.dialect;
  const auto drawn = ide::drawBodyAt(options, path, text, byte, known != nullptr ? &view->meanings().scope() : nullptr);
  if (!drawn) return Json();
  Json::Array elements;
  for (const ide::DrawnElement& element : drawn->elements) {
    Json range{{"start", json(positions.positionOf(element.begin))}, {"end", json(positions.positionOf(element.end))}};
    elements.push_back({{"id", element.id}, {"range", std::move(range)}});
  }
  Json answer{{"title", drawn->title}, {"svg", drawn->svg}, {"pou", drawn->pou}, {"elements", std::move(elements)}};
  if (!drawn->cursor.empty()) answer.set("cursor", drawn->cursor);
  return answer;
}

}  // namespace rung::lsp

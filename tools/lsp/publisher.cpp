// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/publisher.h"

#include <algorithm>

#include "tools/ide/diagnostics.h"
#include "tools/lsp/diagnostic_json.h"
#include "tools/lsp/uri.h"

namespace rung::lsp {
namespace {

constexpr int64_t kNoVersion = INT64_MIN;  // of a file that is not open

int severityOf(Severity severity) {
  switch (severity) {
    case Severity::Error: return 1;
    case Severity::Warning: return 2;
    case Severity::Info: return 3;
    case Severity::Note: return 4;
  }
  return 1;
}

}  // namespace

Json diagnosticJson(const ide::FileDiagnostic& of, Translator& translator, const ide::EmbeddedFiles& embedded) {
  Json range = of.at ? translator.range(of.at) : Json{{"start", json(Position{})}, {"end", json(Position{})}};
  Json result{{"range", std::move(range)},
              {"severity", severityOf(of.severity)},
              {"code", of.code},
              {"source", "rung"},
              {"message", of.message}};
  if (const std::string page = embedded.pathOfPage(of.code); !page.empty())
    result.set("codeDescription", {{"href", uriOf(page)}});
  Json::Array tags;
  if (of.is_unnecessary) tags.push_back(1);
  if (of.is_deprecated) tags.push_back(2);
  if (!tags.empty()) result.set("tags", std::move(tags));
  Json::Array related;
  for (const ide::RelatedPlace& place : of.related)
    if (Json location = translator.location(place.at); !location.isNull())
      related.push_back({{"location", std::move(location)}, {"message", place.message}});
  if (!related.empty()) result.set("relatedInformation", std::move(related));
  return result;
}

// Adds what the list has not from other projects.
static void addNew(Json::Array& list, const Json::Array& diagnostics) {
  const size_t others = list.size();
  for (const Json& one : diagnostics) {
    const auto end = list.begin() + static_cast<ptrdiff_t>(others);
    if (std::find(list.begin(), end, one) == end) list.push_back(one);
  }
}

Publisher::ByFile Publisher::diagnosticsOf(const ide::View& view) {
  ByFile by_file;
  Translator translator(view, session_.encoding);
  for (const ide::FileDiagnostic& one : ide::diagnosticsOf(view))
    by_file[one.path].push_back(diagnosticJson(one, translator, session_.projects.embedded()));
  return by_file;
}

void Publisher::update(const ide::Project& project) {
  OfProject& known = of_projects_[project.input()];
  if (project.view() == nullptr || (known.view == project.view() && known.version == project.version())) return;
  known = {project.view(), project.version(), diagnosticsOf(*project.view())};
}

void Publisher::publish() {
  const auto& projects = session_.projects.all();
  std::erase_if(of_projects_, [&](const auto& entry) {
    return std::none_of(projects.begin(), projects.end(),
                        [&](const auto& project) { return project->input() == entry.first; });
  });
  ByFile all;  // a file that two projects read has the diagnostics of both
  for (const auto& [input, known] : of_projects_)
    for (const auto& [path, diagnostics] : known.by_file) addNew(all[path], diagnostics);
  for (const auto& [path, published] : published_) all[path];
  for (const std::string& path : session_.documents.paths()) all[path];
  for (auto& [path, diagnostics] : all) publish(path, std::move(diagnostics));
}

void Publisher::publish(const std::string& path, Json::Array diagnostics) {
  const bool is_empty = diagnostics.empty();
  const Document* const open = session_.documents.find(path);
  Json params{{"uri", open != nullptr ? open->uri : uriOf(path)}, {"diagnostics", std::move(diagnostics)}};
  Published now{params["diagnostics"].toText(), open != nullptr ? open->version : kNoVersion};
  const auto before = published_.find(path);
  if (before != published_.end() && before->second == now) return;
  if (open != nullptr) params.set("version", open->version);
  session_.notify("textDocument/publishDiagnostics", std::move(params));
  if (is_empty && open == nullptr)
    published_.erase(path);
  else
    published_[path] = std::move(now);
}

}  // namespace rung::lsp

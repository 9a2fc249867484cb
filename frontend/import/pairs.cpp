#include "frontend/import/pairs.h"

#include <algorithm>
#include <utility>

#include "frontend/import/formats.h"
#include "frontend/import/source_mapped_text.h"
#include "frontend/source/scanner.h"

namespace rung::importer {
namespace {

FileId joined(Sources& sources, FileId declaration, FileId body) {
  xml::SourceMappedText program(sources);
  const auto whole = [&](FileId file) {
    const Loc begin = sources.begin(file);
    program.add(begin, {begin.offset + static_cast<uint32_t>(sources.sourceText(file).size())});
    program.word("\n");
  };
  whole(declaration);
  const std::string_view end = endWordOf(firstWord(sources.sourceText(declaration)));
  whole(body);
  program.word(end);
  return program.finish(sources, declaration);
}

}  // namespace

std::string pairName(std::string_view path) {
  const size_t slash = path.rfind('/');
  const size_t dot = path.rfind('.');
  if (dot != std::string_view::npos && (slash == std::string_view::npos || dot > slash)) path = path.substr(0, dot);
  std::string name = upper(path);
  for (const std::string_view part : {"DECLARATION", "DECL", "IMPLEMENTATION", "IMPL", "BODY"}) {
    if (!name.ends_with(part)) continue;
    const size_t rest = name.size() - part.size();
    if (rest != 0 && std::string_view("._-/").find(name[rest - 1]) == std::string_view::npos) continue;
    name.resize(rest == 0 ? 0 : rest - 1);
    break;
  }
  return name;
}

void joinPairs(Sources& sources, std::vector<PairCandidate>& files) {
  std::vector<std::pair<std::string, size_t>> bodies, declarations;
  for (size_t i = 0; i < files.size(); i++) {
    const std::string_view text = sources.sourceText(files[i].file);
    const std::string word = firstWord(text);
    if (word == "PROGRAM" || word == "FUNCTION" || word == "FUNCTION_BLOCK")
      declarations.emplace_back(pairName(files[i].path), i);
    else if (!startsDeclaration(text))
      bodies.emplace_back(pairName(files[i].path), i);
  }
  std::sort(bodies.begin(), bodies.end());
  std::sort(declarations.begin(), declarations.end());
  for (size_t i = 0; i < bodies.size(); i++) {
    const std::string& name = bodies[i].first;
    if ((i > 0 && bodies[i - 1].first == name) || (i + 1 < bodies.size() && bodies[i + 1].first == name)) continue;
    const auto from = std::lower_bound(declarations.begin(), declarations.end(), std::pair{name, size_t{0}});
    if (from == declarations.end() || from->first != name) continue;
    if (from + 1 != declarations.end() && (from + 1)->first == name) continue;
    PairCandidate& declaration = files[from->second];
    PairCandidate& body = files[bodies[i].second];
    declaration.file = joined(sources, declaration.file, body.file);
    body.file = {};
  }
}

}  // namespace rung::importer

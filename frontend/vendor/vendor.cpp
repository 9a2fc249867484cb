// Telling the formats apart; see vendor.h.
#include "frontend/vendor/vendor.h"

#include "frontend/vendor/readers.h"
#include "frontend/vendor/words.h"
#include "frontend/xml/assembly.h"

namespace rung::vendor {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// The name of the first element of an XML text.
std::string_view rootName(std::string_view text) {
  for (size_t p = text.find('<'); p != std::string_view::npos; p = text.find('<', p)) {
    const bool comment = text.substr(p, 4) == "<!--";
    if (!comment && text.substr(p, 2) != "<?" && text.substr(p, 2) != "<!") {
      size_t end = p + 1;
      while (end < text.size() && !isBlank(text[end]) && text[end] != '>' && text[end] != '/') ++end;
      return text.substr(p + 1, end - p - 1);
    }
    p = text.find(comment ? "-->" : ">", p);
  }
  return {};
}

// The `@WORD` with which a comment of a tool begins: `(* @PATH := …`, `(*@KEY@: …`.
std::string_view markOf(std::string_view text, size_t comment) {
  size_t p = comment + 2;
  while (p < text.size() && (text[p] == ' ' || text[p] == '\t')) ++p;
  if (p == text.size() || text[p] != '@') return {};
  const size_t begin = p++;
  while (p < text.size() && ((text[p] >= 'A' && text[p] <= 'Z') || text[p] == '_')) ++p;
  return text.substr(begin, p - begin);
}

}  // namespace

Format formatOf(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  size_t p = 0;
  while (p < text.size() && isBlank(text[p])) ++p;
  if (text.substr(p).starts_with("<")) {
    const std::string_view root = rootName(text);
    if (root == "TcPlcObject") return Format::TwinCat;
    const bool build =
        root == "Project" && text.find("schemas.microsoft.com/developer/msbuild") != std::string_view::npos;
    return build ? Format::TwinCatProject : Format::None;
  }
  while (text.substr(p).starts_with("(*")) {
    const std::string_view mark = markOf(text, p);
    if (mark == "@PROPERTIES_EX" || mark == "@KEY") return Format::Multiprog;
    if (mark == "@NESTEDCOMMENTS" || mark == "@PATH" || mark == "@OBJECTFLAGS" || mark == "@GLOBAL_VARIABLE_LIST")
      return Format::Codesys2;
    p = endOfComment(text, p);
    while (p < text.size() && isBlank(text[p])) ++p;
  }
  return Format::None;
}

FileId readProgram(Sources& sources, FileId file, Format format, Diagnostics& diagnostics) {
  switch (format) {
    case Format::TwinCat: return readTwinCat(sources, file, diagnostics);
    case Format::Codesys2: return readCodesys2(sources, file, diagnostics);
    case Format::Multiprog: return readMultiprog(sources, file, diagnostics);
    case Format::None:
    case Format::TwinCatProject: break;
  }
  return file;
}

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

FileId joinPair(Sources& sources, FileId declaration, FileId body) {
  xml::Assembly program(sources);
  const auto whole = [&](FileId file) {
    const Loc begin = sources.begin(file);
    program.add(begin, {begin.offset + static_cast<uint32_t>(sources.text(file).size())});
    program.word("\n");
  };
  whole(declaration);
  const std::string_view end = endWordOf(firstWord(sources.text(declaration)));
  whole(body);
  program.word(end);
  return program.finish(sources, declaration);
}

std::string firstWord(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  Words words(text);
  return words.next() && !words.passedOther() ? upper(words.word()) : std::string();
}

}  // namespace rung::vendor

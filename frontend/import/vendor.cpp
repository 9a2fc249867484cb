// Distinguishes the formats; see vendor.h.
#include "frontend/import/vendor.h"

#include "frontend/import/readers.h"
#include "frontend/import/scanner.h"
#include "frontend/import/source_mapped_text.h"

namespace rung::vendor {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// The name of the root element of an XML source.
std::string_view rootName(std::string_view source) {
  for (size_t p = source.find('<'); p != std::string_view::npos; p = source.find('<', p)) {
    const bool comment = source.substr(p, 4) == "<!--";
    if (!comment && source.substr(p, 2) != "<?" && source.substr(p, 2) != "<!") {
      size_t end = p + 1;
      while (end < source.size() && !isSpace(source[end]) && source[end] != '>' && source[end] != '/') ++end;
      return source.substr(p + 1, end - p - 1);
    }
    p = source.find(comment ? "-->" : ">", p);
  }
  return {};
}

// The `@WORD` at the start of a tool's comment: `(* @PATH := …`, `(*@KEY@: …`.
std::string_view tagOf(std::string_view source, size_t comment) {
  size_t p = comment + 2;
  while (p < source.size() && (source[p] == ' ' || source[p] == '\t')) ++p;
  if (p == source.size() || source[p] != '@') return {};
  const size_t begin = p++;
  while (p < source.size() && ((source[p] >= 'A' && source[p] <= 'Z') || source[p] == '_')) ++p;
  return source.substr(begin, p - begin);
}

}  // namespace

Format formatOf(std::string_view source) {
  if (source.starts_with("\xef\xbb\xbf")) source.remove_prefix(3);
  size_t p = 0;
  while (p < source.size() && isSpace(source[p])) ++p;
  if (source.substr(p).starts_with("<")) {
    const std::string_view root = rootName(source);
    if (root == "TcPlcObject") return Format::TwinCat;
    const bool build =
        root == "Project" && source.find("schemas.microsoft.com/developer/msbuild") != std::string_view::npos;
    return build ? Format::TwinCatProject : Format::None;
  }
  while (source.substr(p).starts_with("(*")) {
    const std::string_view tag = tagOf(source, p);
    if (tag == "@PROPERTIES_EX" || tag == "@KEY") return Format::Multiprog;
    if (tag == "@NESTEDCOMMENTS" || tag == "@PATH" || tag == "@OBJECTFLAGS" || tag == "@GLOBAL_VARIABLE_LIST")
      return Format::Codesys2;
    p = endOfComment(source, p);
    while (p < source.size() && isSpace(source[p])) ++p;
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

std::string firstWord(std::string_view source) {
  if (source.starts_with("\xef\xbb\xbf")) source.remove_prefix(3);
  Scanner scanner(source);
  return scanner.next() && !scanner.skippedOther() ? upper(scanner.word()) : std::string();
}

}  // namespace rung::vendor

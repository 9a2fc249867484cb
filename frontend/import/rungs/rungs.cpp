// The reader of the toy format: see rungs.h.
#include "frontend/import/rungs/rungs.h"

#include "frontend/import/network_writer.h"
#include "frontend/import/source_mapped_text.h"
#include "frontend/source/scanner.h"

namespace rung::importer::rungs {

constexpr std::string_view kLine = "\n---\n";

bool isRungs(std::string_view text) {
  return text.starts_with("PROGRAM") && text.find(kLine) != std::string_view::npos;
}

FileId readProgram(ReadContext& context, FileId file) {
  Sources& sources = context.sources;
  const std::string_view source = sources.sourceText(file);
  const uint32_t base = sources.begin(file).offset;
  const auto loc = [&](size_t at) { return Loc{base + static_cast<uint32_t>(at)}; };
  xml::SourceMappedText program(sources);
  NetworkWriter writer(program);
  size_t at = source.find(kLine) + kLine.size();
  program.add(loc(0), loc(at - kLine.size() + 1));
  writer.beginBody(loc(at), NetworkLanguage::Ladder);
  uint64_t elements = 0, networks = 0;
  for (size_t end = at; at < source.size(); at = end + 1) {
    end = std::min(source.find('\n', at), source.size());
    if (source.substr(at, end - at).find('=') == std::string_view::npos) continue;
    writer.beginNetwork(loc(at), ++networks);
    const auto number = [&](uint64_t id) { return xml::Excerpt(loc(at), std::to_string(id)); };
    writer.write({ElementKind::Rail, loc(at), number(++elements)});
    ElementKind kind = ElementKind::Contact;
    while (at < end) {
      const char c = source[at];
      if (c == '=') kind = ElementKind::Coil;
      const bool negated = c == '/';
      if (negated) ++at;
      size_t word = at;
      while (word < end && isNameCharacter(source[word])) ++word;
      if (word == at) {
        ++at;
        continue;
      }
      NetworkElement element(kind, loc(at), number(elements + 1));
      element.operand = {loc(at), std::string(source.substr(at, word - at))};
      element.modifiers.negated = negated;
      element.input.push_back({number(elements), {}});
      ++elements;
      writer.write(element);
      at = word;
    }
  }
  writer.endBody(loc(source.size()));
  program.word("END_PROGRAM\n");
  return program.finish(sources, file);
}

}  // namespace rung::importer::rungs

// SPDX-License-Identifier: Apache-2.0
// MULTIPROG and PC Worx: one POU, type sheet or global sheet per file. The tool's data is in comments that begin with
// `(*@`; descriptions between them are plain text, and each worksheet names its language.
#include "frontend/import/multiprog/multiprog.h"

#include <algorithm>
#include <string>
#include <vector>

#include "frontend/import/diagnostics.h"
#include "frontend/import/source_mapped_text.h"
#include "frontend/import/tool_comments.h"
#include "frontend/source/scanner.h"

namespace rung::importer::multiprog {
namespace {

// The value of `KEY: value` on a separate line in a comment, as a view into `source`.
std::string_view valueOf(std::string_view source, size_t comment, size_t end, std::string_view key) {
  const std::string_view inside = source.substr(comment, end - comment);
  const size_t found = inside.find(key);
  if (found == std::string_view::npos) return {};
  std::string_view value = inside.substr(found + key.size());
  while (!value.empty() && (value[0] == ' ' || value[0] == '\t')) value.remove_prefix(1);
  return value.substr(0, value.find_first_of("\r\n*"));
}

}  // namespace

bool isMultiprog(std::string_view text) { return hasToolComment(text, {"@PROPERTIES_EX", "@KEY"}); }

std::vector<TextPart> programParts(Sources& sources, FileId file, Diagnostics& diagnostics) {
  const std::string_view source = sources.sourceText(file);
  std::vector<TextPart> parts;
  size_t kept = 0;  // everything before is in a part or excluded
  const auto keep = [&](size_t end) { parts.push_back({static_cast<uint32_t>(kept), static_cast<uint32_t>(end)}); };
  // Excludes the source up to the comment that contains `closing`.
  const auto exclude = [&](size_t begin, std::string_view closing) {
    const size_t word = std::min(source.find(closing, begin), source.size());
    const size_t comment = source.substr(begin, word - begin).rfind("(*");
    keep(begin);
    kept = comment == std::string_view::npos ? word : begin + comment;
    return kept;
  };
  for (size_t p = source.find("(*"); p != std::string_view::npos; p = source.find("(*", p)) {
    const std::string_view rest = source.substr(p);
    const size_t end = endOfComment(source, p);
    if (rest.starts_with("(*@KEY@:DESCRIPTION") || rest.starts_with("(*@KEY@: DESCRIPTION")) {
      p = exclude(end, "END_DESCRIPTION");
      continue;
    }
    if (rest.starts_with("(*@KEY@: WORKSHEET") || rest.starts_with("(*@KEY@:WORKSHEET")) {
      const std::string_view language = valueOf(source, p, end, "IEC_LANGUAGE:");
      if (!language.empty() && language != "ST" && language != "IL") {
        const std::string_view name = valueOf(source, p, end, "NAME:");
        const std::string how = "drawn in " + std::string(language);
        const Loc loc{sources.begin(file).offset + static_cast<uint32_t>(language.data() - source.data())};
        diagnostics.report(diag::NetworkBody, loc, {name, how}).length(static_cast<uint32_t>(language.size()));
        p = exclude(end, "END_WORKSHEET");
        continue;
      }
    }
    p = end;
  }
  keep(source.size());
  return parts;
}

FileId readProgram(ReadContext& context, FileId file) {
  Sources& sources = context.sources;
  const std::vector<TextPart> parts = programParts(sources, file, context.diagnostics);
  if (parts.size() == 1) return file;
  xml::SourceMappedText program(sources);
  const uint32_t base = sources.begin(file).offset;
  for (const TextPart& part : parts) program.add({base + part.begin}, {base + part.end});
  return program.finish(sources, file);
}

}  // namespace rung::importer::multiprog

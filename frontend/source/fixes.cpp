// SPDX-License-Identifier: Apache-2.0
#include "frontend/source/fixes.h"

#include <algorithm>
#include <optional>

#include "frontend/source/quoting.h"
#include "frontend/source/scanner.h"

namespace rung {
namespace {

// ---- how a file writes a text

bool isXml(std::string_view file) {
  const size_t first = file.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && file[first] == '<';
}

bool isInCdata(std::string_view file, size_t at) {
  const size_t begin = file.substr(0, at).rfind("<![CDATA[");
  if (begin == std::string_view::npos) return false;
  const size_t end = file.substr(begin, at - begin).find("]]>");
  return end == std::string_view::npos;
}

bool isInTag(std::string_view file, size_t at) {
  const size_t open = file.substr(0, at).rfind('<'), close = file.substr(0, at).rfind('>');
  return open != std::string_view::npos && (close == std::string_view::npos || close < open);
}

std::string withEntities(std::string_view text, bool in_tag) {
  std::string out;
  for (const char c : text) appendToXml(out, c, in_tag);
  return out;
}

bool hasCrlf(std::string_view file) {
  const size_t first = file.find('\n');
  return first != std::string_view::npos && first > 0 && file[first - 1] == '\r';
}

std::string withCrlf(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

// None: it cannot be written there.
std::optional<std::string> written(std::string_view text, std::string_view file, size_t at, bool is_copied) {
  std::string result(text);
  if (is_copied && text.find_first_of("&<>\"\n\t") != std::string_view::npos && isXml(file)) {
    if (!isInCdata(file, at)) {
      result = withEntities(text, isInTag(file, at));
    } else if (text.find("]]>") != std::string_view::npos) {
      return std::nullopt;
    }
  }
  return result.find('\n') != std::string::npos && hasCrlf(file) ? withCrlf(result) : result;
}

// ---- where it is

struct Stretch {  // of what was parsed or of a file; none: no file has it
  Loc begin, end;
};

// The first of the names in a message, which is what it is about.
std::string_view firstName(std::string_view message) {
  const size_t begin = message.find('`');
  if (begin == std::string_view::npos) return {};
  return message.substr(begin + 1, message.find('`', begin + 1) - begin - 1);
}

// A whole word of a text; npos: it has none.
size_t findWord(std::string_view text, std::string_view word) {
  const auto isPart = [&](size_t at) { return at < text.size() && isNameCharacter(text[at]); };
  for (size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1))
    if ((at == 0 || !isPart(at - 1)) && !isPart(at + word.size())) return at;
  return std::string_view::npos;
}

// What the diagnostic marks; of `Color#Green` the part before the sign. It marks all of a pragma: then the name in it.
Stretch markedBy(const Sources& sources, const Diagnostic& diagnostic) {
  const FileId file = sources.fileOf(diagnostic.loc);
  if (!file) return {};
  const size_t at = diagnostic.loc.offset - sources.begin(file).offset;
  std::string_view text = sources.original(file).substr(at);
  text = text.substr(0, text.find('\n'));
  const std::string_view token = sources.tokenAt(diagnostic.loc);
  const size_t length = diagnostic.length != 0 ? diagnostic.length : token.substr(0, token.find('#')).size();
  const std::string_view marked = text.substr(0, length);
  if (diagnostic.message.find("`" + std::string(marked) + "`") != std::string::npos)
    return {diagnostic.loc, {diagnostic.loc.offset + static_cast<uint32_t>(length)}};
  const std::string_view name = firstName(diagnostic.message);
  const size_t found = name.empty() ? std::string_view::npos : findWord(text, name);
  if (found == std::string_view::npos) return {};
  const auto begin = static_cast<uint32_t>(diagnostic.loc.offset + found);
  return {{begin}, {begin + static_cast<uint32_t>(name.size())}};
}

// The length of an entity of XML at the begin of a text that is this character; 0: it is not one.
uint32_t entityFor(std::string_view text, char c) {
  constexpr struct {
    std::string_view name;
    char c;
  } kEntities[] = {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  for (const auto& entity : kEntities)
    if (entity.c == c && text.starts_with(entity.name)) return static_cast<uint32_t>(entity.name.size());
  return 0;
}

// The bytes of a file that one byte of what was parsed was made of. None: Rung made it.
Stretch madeOf(const Sources& sources, Loc at) {
  if (const Loc copied = sources.copiedFrom(at)) return {copied, {copied.offset + 1}};
  const FileId text = sources.fileOf(at);
  const Loc from = sources.originalLocation(at);
  const FileId file = sources.fileOf(from);
  const size_t byte = text ? at.offset - sources.begin(text).offset : 0;
  if (!file || byte >= sources.original(text).size()) return {};
  const std::string_view source = sources.original(file).substr(from.offset - sources.begin(file).offset);
  const uint32_t length = entityFor(source, sources.original(text)[byte]);
  return length == 0 ? Stretch{} : Stretch{from, {from.offset + length}};
}

// After the byte before it, or before the byte at it; both lie together, unless one of them is not in the file.
Loc insertionPlace(const Sources& sources, Loc at) {
  const FileId text = sources.fileOf(at);
  if (!text || sources.segments(text).empty()) return at;
  if (sources.begin(text) < at)
    if (const Stretch before = madeOf(sources, {at.offset - 1}); before.begin) return before.end;
  return madeOf(sources, at).begin;
}

// Empty: not all of it is in one piece of a file.
Stretch inOnePiece(const Sources& sources, Stretch parsed) {
  Stretch range = madeOf(sources, parsed.begin);
  for (uint32_t at = parsed.begin.offset + 1; range.begin && at < parsed.end.offset; ++at) {
    const Stretch next = madeOf(sources, {at});
    if (next.begin != range.end) return {};
    range.end = next.end;
  }
  return range;
}

std::optional<FileEdit> fileEdit(const Sources& sources, const Diagnostic& diagnostic, const Fix::Edit& edit) {
  Stretch parsed{edit.begin, edit.end};
  if (!edit.begin) parsed = markedBy(sources, diagnostic);
  if (!parsed.begin || parsed.end < parsed.begin) return std::nullopt;
  Stretch range = parsed;
  if (parsed.begin == parsed.end) {
    range.begin = range.end = insertionPlace(sources, parsed.begin);
  } else {
    range = inOnePiece(sources, parsed);
  }
  const FileId file = sources.fileOf(range.begin);
  if (!file) return std::nullopt;
  const uint32_t base = sources.begin(file).offset;
  const std::string_view text = sources.original(file);
  const uint32_t begin = range.begin.offset - base, end = range.end.offset - base;
  if (end > text.size()) return std::nullopt;
  std::optional<std::string> shown = written(edit.text, text, begin, sources.fileOf(parsed.begin) != file);
  if (!shown) return std::nullopt;
  return FileEdit{file, begin, end, std::move(*shown)};
}

}  // namespace

std::vector<FileEdit> fileEdits(const Sources& sources, const Diagnostic& diagnostic, const Fix& fix) {
  std::vector<FileEdit> edits;
  for (const Fix::Edit& edit : fix.edits) {
    std::optional<FileEdit> one = fileEdit(sources, diagnostic, edit);
    if (!one) return {};
    edits.push_back(std::move(*one));
  }
  std::stable_sort(edits.begin(), edits.end(), [](const FileEdit& a, const FileEdit& b) {
    return a.file.index != b.file.index ? a.file.index < b.file.index : a.begin < b.begin;
  });
  for (size_t i = 1; i < edits.size(); ++i)
    if (edits[i].file == edits[i - 1].file && edits[i].begin < edits[i - 1].end) return {};
  return edits;
}

}  // namespace rung

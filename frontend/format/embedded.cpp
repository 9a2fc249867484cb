// Parts of a file are formatted on their own, and the rest is copied: in XML of TwinCAT, PLCopen and IEC 61131-10 what
// is between the tags of declarations, of ST and of IL; in text of other tools what the reader of the format says.
#include <algorithm>
#include <array>
#include <utility>

#include "frontend/format/format.h"

namespace rung::format {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

// The content of the next element, and where it ends; npos: there is none.
struct Content {
  size_t begin, end;
  bool is_cdata;
};

constexpr std::string_view kCdata = "<![CDATA[", kCdataEnd = "]]>";

bool opens(std::string_view text, size_t at, std::string_view tag) {
  if (text.substr(at + 1, tag.size()) != tag) return false;
  const char after = at + 1 + tag.size() < text.size() ? text[at + 1 + tag.size()] : '\0';
  return after == '>' || after == ' ' || after == '\n' || after == '\r' || after == '\t';
}

// From `<ST>` or `<Declaration>`, over elements inside such as <xhtml>, to the characters.
Content contentAt(std::string_view text, size_t tag) {
  size_t at = tag;
  while (at < text.size() && text[at] == '<' && text.substr(at, kCdata.size()) != kCdata) {
    const size_t close = text.find('>', at);
    if (close == std::string_view::npos || text[close - 1] == '/' || text[at + 1] == '/')
      return {std::string_view::npos, 0, false};
    at = text.find_first_not_of(kBlanks, close + 1);
    if (at == std::string_view::npos) return {at, 0, false};
    if (text[at] != '<') {
      at = close + 1;
      break;
    }
  }
  const bool is_cdata = text.substr(at, kCdata.size()) == kCdata;
  const size_t begin = is_cdata ? at + kCdata.size() : at;
  const size_t end = is_cdata ? text.find(kCdataEnd, begin) : text.find('<', begin);
  return end == std::string_view::npos ? Content{end, 0, false} : Content{begin, end, is_cdata};
}

struct Entity {
  std::string_view written;
  char character;
};
constexpr std::array<Entity, 5> kEntities = {
    {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};

// False: an entity that cannot be put back as it was.
bool decode(std::string_view text, std::string& out) {
  for (size_t at = 0; at < text.size();) {
    if (text[at] != '&') {
      out += text[at++];
      continue;
    }
    const auto entity = std::find_if(kEntities.begin(), kEntities.end(),
                                     [&](const Entity& e) { return text.substr(at, e.written.size()) == e.written; });
    if (entity == kEntities.end()) return false;
    out += entity->character;
    at += entity->written.size();
  }
  return true;
}
// As the file did it: `<` and `&` always, the others where it has such entities.
std::string encode(std::string_view text, std::string_view as) {
  std::string out;
  for (const char c : text) {
    const auto entity =
        std::find_if(kEntities.begin(), kEntities.end(), [&](const Entity& e) { return e.character == c; });
    const bool is_written =
        entity != kEntities.end() && (c == '<' || c == '&' || as.find(entity->written) != std::string_view::npos);
    if (is_written)
      out += entity->written;
    else
      out += c;
  }
  return out;
}

// White space at both ends belongs to the file, but for the blanks before the first instruction of a list.
std::string fragment(std::string_view source, Bodies bodies, const Style& style, Dialect dialect) {
  size_t begin = source.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return std::string(source);
  const size_t end = source.find_last_not_of(kBlanks) + 1;
  if (!bodies.il.empty() && bodies.il.front().begin <= begin) {
    const size_t newline = source.rfind('\n', begin);
    begin = newline == std::string_view::npos || newline > begin ? 0 : newline + 1;
  }
  for (Span& il : bodies.il) {
    il.begin -= std::min(il.begin, static_cast<uint32_t>(begin));
    il.end -= std::min(il.end, static_cast<uint32_t>(begin));
  }
  std::string text = formatted(source.substr(begin, end - begin), bodies, style, dialect);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return std::string(source.substr(0, begin)) + text + std::string(source.substr(end));
}

// Whether the list is one text with a line for each instruction: some tools write a paragraph for each, or one line.
bool hasLines(std::string_view source, const Content& content) {
  const size_t next = source.find('<', content.end + (content.is_cdata ? kCdataEnd.size() : 0));
  if (next == std::string_view::npos || source.find('\n', content.begin) >= content.end) return false;
  const size_t close = source.find("IL>", next);
  const std::string_view rest = source.substr(next, close == std::string_view::npos ? 0 : close - next);
  for (size_t at = rest.find('<'); at != std::string_view::npos; at = rest.find('<', at + 1))
    if (rest.substr(at + 1, 1) != "/") return false;
  return close != std::string_view::npos;
}

}  // namespace

std::string formattedParts(std::string_view source, const std::vector<Span>& parts, const Bodies& bodies,
                           const Style& style, Dialect dialect) {
  std::string out;
  size_t copied = 0;
  auto il = bodies.il.begin();
  for (const Span& part : parts) {
    Bodies inside;
    while (il != bodies.il.end() && il->begin < part.begin) ++il;
    for (; il != bodies.il.end() && il->begin < part.end; ++il)
      inside.il.push_back({il->begin - part.begin, std::min(il->end, part.end) - part.begin});
    out += source.substr(copied, part.begin - copied);
    out += fragment(source.substr(part.begin, part.end - part.begin), std::move(inside), style, dialect);
    copied = part.end;
  }
  out += source.substr(copied);
  return out;
}

std::string formattedXml(std::string_view source, const Style& style, Dialect dialect) {
  std::string out;
  size_t copied = 0;
  for (size_t at = source.find('<'); at != std::string_view::npos; at = source.find('<', at + 1)) {
    if (source.substr(at, 4) == "<!--") {
      at = std::min(source.find("-->", at), source.size() - 1);
      continue;
    }
    const bool is_il = opens(source, at, "IL");
    if (!is_il && !opens(source, at, "ST") && !opens(source, at, "Declaration")) continue;
    const Content content = contentAt(source, at);
    if (content.begin == std::string_view::npos || (is_il && !hasLines(source, content))) continue;
    const std::string_view raw = source.substr(content.begin, content.end - content.begin);
    std::string text;
    if (!content.is_cdata && !decode(raw, text)) continue;
    const std::string_view fragment_source = content.is_cdata ? raw : std::string_view(text);
    Bodies bodies;
    if (is_il) bodies.il.push_back({0, static_cast<uint32_t>(fragment_source.size())});
    const std::string result = fragment(fragment_source, std::move(bodies), style, dialect);
    out += source.substr(copied, content.begin - copied);
    out += content.is_cdata ? result : encode(result, raw);
    copied = content.end;
    at = content.end;
    if (at >= source.size()) break;
    --at;
  }
  out += source.substr(copied);
  return out;
}

}  // namespace rung::format

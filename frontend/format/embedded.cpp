// SPDX-License-Identifier: Apache-2.0
// Parts of a file are formatted on their own, and the rest is copied: in XML of TwinCAT, PLCopen and IEC 61131-10 what
// is between the tags of declarations, of ST and of IL; in text of other tools what the reader of the format says.
#include <algorithm>
#include <array>
#include <utility>

#include "frontend/format/format.h"

namespace rung::format {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

// Characters between two tags.
struct Content {
  size_t begin, end;
  bool is_cdata;
};

constexpr std::string_view kCdata = "<![CDATA[", kCdataEnd = "]]>";

// The name in the tag at `at`, without its prefix: ST of `<ppx:ST>` and of `</ST>`.
std::string_view nameOfTag(std::string_view text, size_t at) {
  const size_t begin = at + (text.substr(at, 2) == "</" ? 2 : 1);
  const std::string_view name =
      text.substr(begin, std::min(text.find_first_of(" \t\r\n/>", begin), text.size()) - begin);
  const size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

// The `>` of the tag, comment or processing instruction at `at`; values of attributes may contain one.
size_t endOfTag(std::string_view text, size_t at) {
  if (text.substr(at, 4) == "<!--") {
    const size_t end = text.find("-->", at);
    return end == std::string_view::npos ? end : end + 2;
  }
  for (size_t k = at; k < text.size(); ++k) {
    if (text[k] == '>') return k;
    if (text[k] != '"' && text[k] != '\'') continue;
    k = text.find(text[k], k + 1);
    if (k == std::string_view::npos) return k;
  }
  return std::string_view::npos;
}

// The texts in an element, inside other elements such as <xhtml> or not.
struct Texts {
  std::vector<Content> contents;
  bool are_lines = true;  // each is in a paragraph
};

bool isParagraph(std::string_view name) { return name == "p" || name == "br" || name == "div" || name == "li"; }

// Of the element whose tag is at `tag`.
Texts textsAt(std::string_view text, size_t tag) {
  const std::string_view name = nameOfTag(text, tag);
  Texts texts;
  bool begins_line = true;
  size_t at = tag;
  do {
    const bool is_cdata = text.substr(at, kCdata.size()) == kCdata;
    const size_t close = is_cdata ? at + kCdata.size() : endOfTag(text, at);
    if (close == std::string_view::npos || (at == tag && text[close - 1] == '/')) return {};
    const size_t begin = is_cdata ? close : close + 1;
    const size_t end = is_cdata ? text.find(kCdataEnd, begin) : text.find('<', begin);
    if (end == std::string_view::npos) return {};
    begins_line = begins_line || (!is_cdata && isParagraph(nameOfTag(text, at)));
    if (text.substr(begin, end - begin).find_first_not_of(kBlanks) != std::string_view::npos) {
      texts.are_lines = texts.are_lines && begins_line;
      texts.contents.push_back({begin, end, is_cdata});
      begins_line = false;
    }
    at = is_cdata ? text.find('<', end) : end;
    if (at == std::string_view::npos) return {};
  } while (text.substr(at, 2) != "</" || nameOfTag(text, at) != name);
  return texts;
}

struct Entity {
  std::string_view written;
  char character;
};
constexpr std::array<Entity, 8> kEntities = {{{"&lt;", '<'},
                                              {"&gt;", '>'},
                                              {"&quot;", '"'},
                                              {"&apos;", '\''},
                                              {"&amp;", '&'},
                                              {"&#13;", '\r'},
                                              {"&#xD;", '\r'},
                                              {"&#xd;", '\r'}}};

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
  std::array<std::string_view, 256> spellings{};
  for (const Entity& entity : kEntities) {
    const bool is_needed = entity.character == '<' || entity.character == '&';
    if (is_needed || as.find(entity.written) != std::string_view::npos)
      spellings[static_cast<unsigned char>(entity.character)] = entity.written;
  }
  std::string out;
  for (const char c : text) {
    const std::string_view spelling = spellings[static_cast<unsigned char>(c)];
    if (spelling.empty())
      out += c;
    else
      out += spelling;
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

std::string_view trimmed(std::string_view text) {
  const size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

// The text for each: several are the lines of one text. None: they stay as they are.
std::vector<std::string> formattedTexts(std::string_view source, const Texts& texts, bool is_il, const Style& style,
                                        Dialect dialect) {
  const auto rawOf = [&](const Content& content) { return source.substr(content.begin, content.end - content.begin); };
  const bool is_one = texts.contents.size() == 1;
  if (!is_one && !texts.are_lines) return {};
  std::string joined;
  for (const Content& content : texts.contents) {
    const std::string_view raw = is_one ? rawOf(content) : trimmed(rawOf(content));
    const bool has_lines = raw.find('\n') != std::string_view::npos;
    // Instructions on one line cannot be told apart here.
    if (is_one ? is_il && !has_lines : has_lines) return {};
    if (content.is_cdata)
      joined += raw;
    else if (!decode(raw, joined))
      return {};
    if (!is_one) joined += '\n';
  }
  Bodies bodies;
  if (is_il) bodies.il.push_back({0, static_cast<uint32_t>(joined.size())});
  const std::string result = fragment(joined, std::move(bodies), style, dialect);
  std::vector<std::string> out;
  size_t begin = 0;
  for (const Content& content : texts.contents) {
    const size_t end = is_one ? result.size() : result.find('\n', begin);
    if (end == std::string::npos) return {};
    const std::string line = result.substr(begin, end - begin);
    out.push_back(content.is_cdata ? line : encode(line, rawOf(content)));
    begin = end + 1;
  }
  if (!is_one && begin != result.size()) out.clear();  // a line was broken
  return out;
}

// Declarations as text, and bodies.
bool holdsSource(std::string_view name) {
  static constexpr std::string_view kNames[] = {
      "ST", "IL", "Declaration", "InterfaceAsPlainText", "TextDeclaration", "textDeclaration"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
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
    const bool is_comment = source.substr(at, 4) == "<!--";
    if (is_comment || source.substr(at, kCdata.size()) == kCdata) {
      at = std::min(source.find(is_comment ? "-->" : kCdataEnd, at), source.size() - 1);
      continue;
    }
    const std::string_view name = nameOfTag(source, at);
    if (source.substr(at, 2) == "</" || !holdsSource(name)) continue;
    const Texts texts = textsAt(source, at);
    const std::vector<std::string> results = formattedTexts(source, texts, name == "IL", style, dialect);
    for (size_t k = 0; k < results.size(); ++k) {
      const Content& content = texts.contents[k];
      out += source.substr(copied, content.begin - copied);
      out += results[k];
      copied = at = content.end;
    }
    if (!results.empty()) --at;
  }
  out += source.substr(copied);
  return out;
}

}  // namespace rung::format

// SPDX-License-Identifier: Apache-2.0
// The reader of XML files; see xml.h. One loop over the source and no recursion, so depth costs no stack.
#include "frontend/import/xml.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "frontend/import/diagnostics.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::xml {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool beginsName(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool inName(char c) { return beginsName(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

std::string_view withoutPrefix(std::string_view name) {
  const size_t colon = name.rfind(':');
  return colon == std::string_view::npos || colon + 1 == name.size() ? name : name.substr(colon + 1);
}

// The character of `&name;` or `&#number;`, given without `&` and `;`; 0: unknown.
char32_t characterOf(std::string_view entity) {
  struct Row {
    std::string_view name;
    char32_t character;
  };
  static constexpr Row kRows[] = {{"lt", U'<'}, {"gt", U'>'}, {"amp", U'&'}, {"quot", U'"'}, {"apos", U'\''}};
  for (const Row& row : kRows)
    if (entity == row.name) return row.character;
  if (entity.size() < 2 || entity[0] != '#') return 0;
  const bool hex = entity[1] == 'x';
  entity.remove_prefix(hex ? 2 : 1);
  if (entity.empty() || entity.size() > 8) return 0;
  uint32_t value = 0;
  for (const char c : entity) {
    const uint32_t digit = c >= '0' && c <= '9'          ? static_cast<uint32_t>(c - '0')
                           : hex && c >= 'a' && c <= 'f' ? static_cast<uint32_t>(c - 'a') + 10
                           : hex && c >= 'A' && c <= 'F' ? static_cast<uint32_t>(c - 'A') + 10
                                                         : 99;
    if (digit == 99) return 0;
    value = value * (hex ? 16 : 10) + digit;
    if (value > 0x10ffff) return 0;
  }
  const bool forbidden =
      (value >= 0xd800 && value < 0xe000) || (value < 0x20 && value != 9 && value != 10 && value != 13);
  return forbidden ? 0 : static_cast<char32_t>(value);
}

class Reader {
 public:
  Reader(const Sources& sources, FileId file, Diagnostics& diagnostics, Document& out)
      : sources_(sources),
        diagnostics_(diagnostics),
        out_(out),
        source_(sources.sourceText(file)),
        base_(sources.begin(file).offset) {}

  bool run();

 private:
  Loc loc(size_t at) const { return {base_ + static_cast<uint32_t>(at)}; }
  bool at(std::string_view word) const { return source_.substr(p_, word.size()) == word; }
  bool broken(size_t at, std::string_view what) {
    diagnostics_.report(diag::XmlSyntax, loc(at), {what}).length(1);
    return false;
  }
  void skipBlanks() {
    while (p_ < source_.size() && isBlank(source_[p_])) ++p_;
  }
  std::string_view name() {
    const size_t begin = p_;
    if (p_ < source_.size() && beginsName(source_[p_]))
      while (p_ < source_.size() && inName(source_[p_])) ++p_;
    return source_.substr(begin, p_ - begin);
  }
  // Skips the construct that begins at p_ and ends with `end`.
  bool skipTo(std::string_view end, std::string_view what) {
    const size_t found = source_.find(end, p_);
    if (found == std::string_view::npos) return broken(p_, what);
    p_ = found + end.size();
    return true;
  }

  bool readMarkup();
  bool skipComment();
  bool readInstruction();
  bool checkEncoding(std::string_view declaration);
  bool checkTwice();
  bool checkCharacters(size_t begin, size_t end);
  bool readStart();
  bool readAttributes();
  bool readEnd();
  bool readText();
  bool readEntity(size_t end, char32_t& character, uint32_t& length);
  bool checkEntities(size_t begin, size_t end);
  void close(size_t end);
  void addRun(size_t begin, size_t end) {
    if (end > begin) out_.runs.push_back({loc(begin), static_cast<uint32_t>(end - begin), 0});
  }

  const Sources& sources_;
  Diagnostics& diagnostics_;
  Document& out_;
  std::string_view source_;
  uint32_t base_;
  size_t p_ = 0;
  uint32_t open_ = kNone;  // the innermost open element
  uint32_t depth_ = 0;
  std::vector<uint32_t> last_child_;               // by depth
  std::vector<std::string_view> attribute_names_;  // of the current tag, with prefixes
};

bool Reader::run() {
  while (p_ < source_.size()) {
    const bool ok = source_[p_] == '<' ? readMarkup() : readText();
    if (!ok) return false;
  }
  if (open_ != kNone) {
    const Element& element = out_.elements[open_];
    diagnostics_.report(diag::XmlNotClosed, element.loc, {element.name})
        .length(static_cast<uint32_t>(element.name.size()));
    return false;
  }
  if (out_.elements.empty()) return broken(0, "the file contains no element");
  return true;
}

bool Reader::readMarkup() {
  if (at("<!--")) return skipComment();
  if (at("<?")) return readInstruction();
  if (at("<![CDATA[")) {
    if (open_ == kNone) return broken(p_, "text outside the root element");
    const size_t begin = p_ + 9;
    if (!skipTo("]]>", "expected `]]>` to close this CDATA section")) return false;
    addRun(begin, p_ - 3);
    return true;
  }
  if (at("<!DOCTYPE")) return broken(p_, "Rung does not read document types; remove this one");
  if (at("</")) return readEnd();
  return readStart();
}

// <!-- … -->, without `--` inside.
bool Reader::skipComment() {
  const size_t begin = p_;
  const size_t dashes = source_.find("--", begin + 4);
  if (source_.find("-->", begin + 4) == std::string_view::npos)
    return broken(begin, "expected `-->` to close this comment");
  if (source_[dashes + 2] != '>') return broken(dashes, "`--` is not allowed in a comment");
  p_ = dashes + 3;
  return true;
}

// <?target … ?>; of `<?xml version="1.0" encoding="utf-8"?>` only the encoding matters.
bool Reader::readInstruction() {
  const size_t begin = p_;
  p_ += 2;
  const std::string_view target = name();
  if (target.empty()) return broken(begin, "expected a name after `<?`");
  if (!skipTo("?>", "expected `?>` to close this instruction")) return false;
  if (target.size() != 3 || !sameIdentifier(target, "xml")) return true;
  if (begin != 0) return broken(begin, "the XML declaration must be at the very beginning");
  return checkEncoding(source_.substr(0, p_));
}

// UTF-16 was decoded when the file was read. Latin-1 can only occur in comments and strings, which the lexer checks.
bool Reader::checkEncoding(std::string_view declaration) {
  const size_t word = declaration.find("encoding");
  if (word == std::string_view::npos) return true;
  const size_t open = declaration.find_first_of("\"'", word);
  const size_t close = open == std::string_view::npos ? open : declaration.find(declaration[open], open + 1);
  if (close == std::string_view::npos) return broken(word, "`encoding` needs a value in quotes");
  const std::string_view encoding = declaration.substr(open + 1, close - open - 1);
  for (const std::string_view known : {"utf-8", "utf8", "utf-16", "utf-16le", "utf-16be", "us-ascii", "ascii",
                                       "iso-8859-1", "iso-8859-15", "windows-1250", "windows-1252"})
    if (sameIdentifier(encoding, known)) return true;
  for (const char c : source_)
    if (static_cast<unsigned char>(c) >= 0x80) return broken(open + 1, "unsupported encoding; save the file as UTF-8");
  return true;
}

bool Reader::readStart() {
  const size_t begin = p_++;
  const size_t name_at = p_;
  const std::string_view full = name();
  if (full.empty()) return broken(begin, "expected a name after `<`; write `&lt;` for the character itself");
  if (open_ == kNone && !out_.elements.empty()) return broken(begin, "second root element");
  if (depth_ == kMaxDepth || out_.elements.size() == kMaxElements) {
    const std::string limit = std::to_string(depth_ == kMaxDepth ? kMaxDepth : kMaxElements);
    diagnostics_.report(diag::XmlTooLarge, loc(name_at), {limit, depth_ == kMaxDepth ? "nested elements" : "elements"});
    return false;
  }
  const auto index = static_cast<uint32_t>(out_.elements.size());
  out_.elements.push_back({withoutPrefix(full),
                           loc(name_at),
                           open_,
                           kNone,
                           kNone,
                           static_cast<uint32_t>(out_.attributes.size()),
                           0,
                           static_cast<uint32_t>(out_.runs.size()),
                           static_cast<uint32_t>(out_.runs.size()),
                           {}});
  if (open_ != kNone) {
    uint32_t& link = out_.elements[open_].first_child == kNone ? out_.elements[open_].first_child
                                                               : out_.elements[last_child_[depth_]].next;
    link = index;
  }
  if (last_child_.size() < depth_ + 2) last_child_.resize(depth_ + 2);
  last_child_[depth_] = index;
  open_ = index;
  ++depth_;
  if (!readAttributes() || !checkTwice()) return false;
  if (source_[p_] == '/') {
    close(p_);
    p_ += 2;
  } else {
    ++p_;
  }
  return true;
}

// Forbids a duplicate attribute in a tag.
bool Reader::checkTwice() {
  if (attribute_names_.size() < 2) return true;
  std::sort(attribute_names_.begin(), attribute_names_.end());
  for (size_t i = 1; i < attribute_names_.size(); ++i)
    if (attribute_names_[i] == attribute_names_[i - 1])
      return broken(static_cast<size_t>(attribute_names_[i].data() - source_.data()),
                    "duplicate attribute in this tag");
  return true;
}

// Forbids control characters, and `]]>` outside of CDATA.
bool Reader::checkCharacters(size_t begin, size_t end) {
  for (size_t i = begin; i < end; ++i) {
    const auto c = static_cast<unsigned char>(source_[i]);
    if (c < 0x20 && !isBlank(source_[i])) return broken(i, "control characters are not allowed in XML");
    if (c == ']' && source_.substr(i, 3) == "]]>")
      return broken(i, "`]]>` does not close a CDATA section; write `]]&gt;`");
  }
  return true;
}

// Leaves p_ at the `>` or `/>`.
bool Reader::readAttributes() {
  attribute_names_.clear();
  for (;;) {
    const size_t before = p_;
    skipBlanks();
    if (p_ == source_.size()) return broken(p_, "the file ends inside a tag");
    if (source_[p_] == '>' || at("/>")) return true;
    const size_t name_at = p_;
    const std::string_view full = name();
    if (full.empty()) return broken(p_, "expected an attribute, `>` or `/>`");
    if (before == name_at) return broken(name_at, "expected a space before this attribute");
    skipBlanks();
    if (!at("=")) return broken(p_, "expected `=` and a value after the attribute's name");
    ++p_;
    skipBlanks();
    if (!at("\"") && !at("'")) return broken(p_, "the value of an attribute needs quotes");
    const size_t begin = p_ + 1;
    const size_t end = source_.find(source_[p_], begin);
    if (end == std::string_view::npos) return broken(p_, "this quote is not closed");
    if (const size_t open = source_.substr(begin, end - begin).find('<'); open != std::string_view::npos)
      return broken(begin + open, "`<` is not allowed in a value; write `&lt;`, or close the quote before it");
    if (!checkEntities(begin, end)) return false;
    attribute_names_.push_back(full);
    out_.attributes.push_back({withoutPrefix(full), source_.substr(begin, end - begin), loc(begin)});
    ++out_.elements[open_].attribute_count;
    p_ = end + 1;
  }
}

void Reader::close(size_t end) {
  Element& element = out_.elements[open_];
  element.end_run = static_cast<uint32_t>(out_.runs.size());
  element.end = loc(end);
  open_ = element.parent;
  --depth_;
}

bool Reader::readEnd() {
  const size_t begin = p_;
  p_ += 2;
  const std::string_view full = name();
  skipBlanks();
  if (!at(">")) return broken(p_, "expected `>` to close the end tag");
  ++p_;
  if (open_ == kNone || withoutPrefix(full) != out_.elements[open_].name) {
    if (open_ == kNone) return broken(begin, "unmatched end tag");
    const Element& element = out_.elements[open_];
    const std::string line = std::to_string(sources_.location(element.loc).line);
    diagnostics_.report(diag::XmlWrongEnd, loc(begin + 2), {full, element.name, line});
    return false;
  }
  close(begin);
  return true;
}

// The entity at p_, which ends before `end`.
bool Reader::readEntity(size_t end, char32_t& character, uint32_t& length) {
  const size_t stop = source_.substr(0, std::min(end, p_ + 12)).find(';', p_);
  const std::string_view entity =
      stop == std::string_view::npos ? std::string_view{} : source_.substr(p_ + 1, stop - p_ - 1);
  character = characterOf(entity);
  length = static_cast<uint32_t>(entity.size() + 2);
  if (character != 0) return true;
  const std::string shown = stop == std::string_view::npos ? "&" : "&" + std::string(entity) + ";";
  diagnostics_.report(diag::XmlEntity, loc(p_), {shown}).length(static_cast<uint32_t>(shown.size()));
  return false;
}

bool Reader::checkEntities(size_t begin, size_t end) {
  char32_t character;
  uint32_t length;
  while ((begin = source_.substr(0, end).find('&', begin)) != std::string_view::npos) {
    p_ = begin;
    if (!readEntity(end, character, length)) return false;
    begin += length;
  }
  return true;
}

bool Reader::readText() {
  const size_t begin = p_;
  size_t end = source_.find('<', p_);
  if (end == std::string_view::npos) end = source_.size();
  if (open_ == kNone) {
    skipBlanks();
    return p_ >= end ||
           broken(p_, out_.elements.empty() ? "text before the root element" : "text after the root element");
  }
  if (!checkCharacters(begin, end)) return false;
  size_t plain = begin;
  for (size_t i = begin; i < end;) {
    const void* ampersand = memchr(source_.data() + i, '&', end - i);
    if (ampersand == nullptr) break;
    i = static_cast<size_t>(static_cast<const char*>(ampersand) - source_.data());
    addRun(plain, i);
    p_ = i;
    Run run{loc(i), 0, 0};
    if (!readEntity(end, run.character, run.length)) return false;
    out_.runs.push_back(run);
    i += run.length;
    plain = i;
  }
  addRun(plain, end);
  p_ = end;
  return true;
}

}  // namespace

const Attribute* Document::attribute(const Element& element, std::string_view name) const {
  for (uint32_t i = 0; i < element.attribute_count; ++i)
    if (attributes[element.first_attribute + i].name == name) return &attributes[element.first_attribute + i];
  return nullptr;
}

std::string Document::decoded(const Attribute& attribute) const {
  const std::string_view raw = attribute.raw;
  std::string out;
  for (size_t i = 0; i < raw.size();) {
    if (raw[i] != '&') {
      out += raw[i++];
      continue;
    }
    const size_t end = raw.find(';', i);  // read() has verified that it exists
    appendUtf8(out, characterOf(raw.substr(i + 1, end - i - 1)));
    i = end + 1;
  }
  return out;
}

std::string Document::value(const Element& element, std::string_view name) const {
  const Attribute* found = attribute(element, name);
  return found == nullptr ? std::string() : decoded(*found);
}

Loc Document::locOf(const Element& element, std::string_view name) const {
  const Attribute* found = attribute(element, name);
  return found == nullptr ? element.loc : found->loc;
}

const Element* Document::child(const Element& element, std::string_view name) const {
  for (const Element* e = firstChild(element); e != nullptr; e = next(*e))
    if (e->name == name) return e;
  return nullptr;
}

std::string Document::text(const Element& element, const Sources& sources) const {
  std::string out;
  if (elements.empty()) return out;
  const FileId file = sources.fileOf(elements[0].loc);
  const uint32_t base = sources.begin(file).offset;
  for (uint32_t i = element.first_run; i < element.end_run; ++i) {
    if (runs[i].character != 0)
      appendUtf8(out, runs[i].character);
    else
      out += sources.sourceText(file).substr(runs[i].loc.offset - base, runs[i].length);
  }
  return out;
}

bool read(const Sources& sources, FileId file, Diagnostics& diagnostics, Document& out) {
  return Reader(sources, file, diagnostics, out).run();
}

std::string_view rootTag(std::string_view text) {
  text = withoutMark(text);
  if (!text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size())).starts_with("<")) return {};
  for (size_t p = text.find('<'); p != std::string_view::npos; p = text.find('<', p)) {
    if (text.substr(p, 4) == "<!--") {
      p = text.find("-->", p);
    } else if (text.substr(p, 2) == "<?" || text.substr(p, 2) == "<!") {
      p = text.find('>', p);
    } else {
      return text.substr(p, std::min(text.find('>', p), text.size()) - p);
    }
    if (p == std::string_view::npos) break;
  }
  return {};
}

std::string_view rootName(std::string_view tag) {
  if (tag.empty()) return {};
  const std::string_view name = tag.substr(1, tag.find_first_of(" \t\r\n>/") - 1);
  return name.substr(name.find(':') + 1);
}

}  // namespace rung::xml

// SPDX-License-Identifier: Apache-2.0
// ST put together from parts of one or more files, with a segment for each part that leads its bytes back to the file.
// In: source ranges, content of XML elements, keywords that the files leave out. Out: a source-mapped file of Sources.
// Used by all readers of vendor files.
// Thus the parser knows no vendor, and every message, fault and `#line` has its location in the file on disk. Copying
// costs less than the complexity of a second lexer for ranges.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frontend/import/xml.h"
#include "frontend/source/files.h"

namespace rung::xml {

// A piece of the text as a reader passes it to a writer: the content of an element or the value of an attribute,
// followed by characters that are not in the file.
struct Excerpt {
  Excerpt() = default;
  Excerpt(const Document& from, const Element& content) : document(&from), element(&content) {}
  Excerpt(const Document& from, const Attribute& value) : document(&from), attribute(&value) {}
  Excerpt(Loc at, std::string made) : loc(at), text(std::move(made)) {}
  explicit Excerpt(std::string made) : text(std::move(made)) {}

  bool empty() const { return document == nullptr && text.empty(); }
  Loc begin() const { return attribute != nullptr ? attribute->loc : element != nullptr ? element->loc : loc; }

  const Document* document = nullptr;  // of one of these
  const Element* element = nullptr;
  const Attribute* attribute = nullptr;
  bool quoted = false;  // the element's content has quotes, which are left out
  Loc loc;              // of `text`; none: the end of what is before it
  std::string text;
};

class SourceMappedText {
 public:
  explicit SourceMappedText(const Sources& sources) : sources_(sources) {}

  // Bytes [begin, end) of a file, unchanged.
  void add(Loc begin, Loc end);
  // The content of an XML element, decoded.
  void add(const Document& document, const Element& element);
  // Runs [first, end) of the document, decoded.
  void addRuns(const Document& document, uint32_t first, uint32_t end);
  // The value of an attribute, decoded.
  void add(const Document& document, const Attribute& attribute);
  void add(const Excerpt& excerpt);
  // A keyword that the file leaves out. Errors in it are reported at the end of the part before it.
  void word(std::string_view text);
  // Replaces bytes [begin, end) of a file by `text`.
  void replace(Loc begin, Loc end, std::string_view text);
  // A keyword that the file leaves out; errors in it are reported at `loc`.
  void put(Loc loc, std::string_view text) { replace(loc, loc, text); }

  bool empty() const { return text_.empty(); }
  const std::string& text() const { return text_; }
  // The characters of an excerpt.
  std::string spellingOf(const Excerpt& excerpt) const;
  // Registers it as the program of `file`.
  FileId finish(Sources& sources, FileId file);

 private:
  void segment(Loc from, bool verbatim);
  void addUnquoted(const Document& document, const Element& element);

  const Sources& sources_;
  std::string text_;
  std::vector<Segment> segments_;
  Loc end_;  // of the last part, in its file
};

}  // namespace rung::xml

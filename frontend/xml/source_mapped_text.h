// A text in the making from parts of files, which remembers where each part stands. In: places of files, texts of XML
// elements, words that the files leave out. Out: an assembled text of Sources. Used by frontend/vendor and
// frontend/plcopen.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/xml/xml.h"

namespace rung::xml {

class SourceMappedText {
 public:
  explicit SourceMappedText(const Sources& sources) : sources_(sources) {}

  // Bytes [begin, end) of a file, as they stand.
  void add(Loc begin, Loc end);
  // The text of an XML element, decoded.
  void add(const Document& document, const Element& element);
  // Runs [first, end) of the document's text, decoded.
  void addRuns(const Document& document, uint32_t first, uint32_t end);
  // The value of an attribute, decoded.
  void add(const Document& document, const Attribute& attribute);
  // A word that the file leaves out. Where it is to blame, the place is the end of the part before.
  void word(std::string_view text);
  // What stands for bytes [begin, end) of a file.
  void replace(Loc begin, Loc end, std::string_view text);
  // A word that the file leaves out, for which what stands at `loc` is to blame.
  void put(Loc loc, std::string_view text) { replace(loc, loc, text); }

  bool empty() const { return text_.empty(); }
  const std::string& text() const { return text_; }
  // Registers it as the program of `file`.
  FileId finish(Sources& sources, FileId file);

 private:
  void segment(Loc from, bool verbatim);

  const Sources& sources_;
  std::string text_;
  std::vector<Segment> segments_;
  Loc end_;  // of the last part, in its file
};

}  // namespace rung::xml

// A text in the making from parts of files, which remembers where each part stands. Used by the readers of this folder.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/xml/xml.h"

namespace rung::vendor {

class Assembly {
 public:
  explicit Assembly(const Sources& sources) : sources_(sources) {}

  // Bytes [begin, end) of a file, as they stand.
  void add(Loc begin, Loc end);
  // The text of an XML element, decoded.
  void add(const xml::Document& document, const xml::Element& element);
  // A word that the file leaves out. Where it is to blame, the place is the end of the part before.
  void word(std::string_view text);
  // What stands for bytes [begin, end) of a file.
  void replace(Loc begin, Loc end, std::string_view text);

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

}  // namespace rung::vendor

// SPDX-License-Identifier: Apache-2.0
// Writes XML. In: elements, attributes and content, in the order of the file. Out: UTF-8, indented by two spaces per
// level; equal calls give equal bytes. Called by the export to PLCopen XML.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rung::xml {

class Writer {
 public:
  Writer() : out_("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n") {}

  // Attributes must be written before any content of the element. `name` must outlive the element.
  Writer& open(std::string_view name);
  Writer& attribute(std::string_view name, std::string_view value);
  void close();
  Writer& leaf(std::string_view name) {
    open(name);
    close();
    return *this;
  }
  // Content between the tags, without whitespace around it.
  void text(std::string_view text);
  // <name>text</name>
  void element(std::string_view name, std::string_view content);
  // <name><xhtml:p>text</xhtml:p></name>, with line breaks and spaces unchanged.
  void formatted(std::string_view name, std::string_view content);

  const std::string& out() const { return out_; }

 private:
  void endTag();
  void escaped(std::string_view text, bool in_attribute);

  std::string out_;
  std::vector<std::string_view> open_;
  bool in_tag_ = false;  // `>` has not been written yet
  bool inline_ = false;  // content was written, so the end tag follows on the same line
};

}  // namespace rung::xml

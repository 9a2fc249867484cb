// XML in the making. In: elements, attributes and texts, in the order of the file. Out: UTF-8 text, indented by two
// blanks for each element; equal calls give equal bytes. Called by the export to PLCopen XML.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rung::xml {

class Writer {
 public:
  Writer() : out_("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n") {}

  // Attributes follow their element at once. `name` outlives the element.
  Writer& open(std::string_view name);
  Writer& attribute(std::string_view name, std::string_view value);
  void close();
  Writer& leaf(std::string_view name) {
    open(name);
    close();
    return *this;
  }
  // Stands between the tags without blanks around it.
  void text(std::string_view text);
  // <name>text</name>
  void element(std::string_view name, std::string_view content);
  // <name><xhtml:p>text</xhtml:p></name>, line breaks and blanks as they are.
  void formatted(std::string_view name, std::string_view content);

  const std::string& out() const { return out_; }

 private:
  void endTag();
  void escaped(std::string_view text, bool in_attribute);

  std::string out_;
  std::vector<std::string_view> open_;
  bool in_tag_ = false;  // `>` is still to come
  bool inline_ = false;  // text was written, so the end tag follows at once
};

}  // namespace rung::xml

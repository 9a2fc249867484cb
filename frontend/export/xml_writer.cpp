// SPDX-License-Identifier: Apache-2.0
#include "frontend/export/xml_writer.h"

#include <algorithm>

#include "frontend/source/files.h"
#include "frontend/source/quoting.h"

namespace rung::xml {

void Writer::endTag() {
  if (in_tag_) out_ += ">\n";
  in_tag_ = false;
}

Writer& Writer::open(std::string_view name) {
  endTag();
  out_.append(2 * open_.size(), ' ').append("<").append(name);
  open_.push_back(name);
  in_tag_ = true;
  return *this;
}

namespace {

// The text with bytes that are not UTF-8 read as Latin-1. `storage` holds it where it differs.
std::string_view asUtf8(std::string_view text, std::string& storage) {
  for (size_t bad = findInvalidUtf8(text); bad != std::string_view::npos; bad = findInvalidUtf8(text)) {
    storage += text.substr(0, bad);
    appendUtf8(storage, static_cast<unsigned char>(text[bad]));
    text.remove_prefix(bad + 1);
  }
  if (storage.empty()) return text;
  storage += text;
  return storage;
}

}  // namespace

void Writer::escaped(std::string_view text, bool in_attribute) {
  std::string storage;
  for (const char c : asUtf8(text, storage)) appendToXml(out_, c, in_attribute);
}

Writer& Writer::attribute(std::string_view name, std::string_view value) {
  out_.append(" ").append(name).append("=\"");
  escaped(value, true);
  out_ += '"';
  return *this;
}

void Writer::close() {
  const std::string_view name = open_.back();
  open_.pop_back();
  if (in_tag_) {
    out_ += "/>\n";
  } else {
    if (!inline_) out_.append(2 * open_.size(), ' ');
    out_.append("</").append(name).append(">\n");
  }
  in_tag_ = inline_ = false;
}

void Writer::text(std::string_view text) {
  if (in_tag_) out_ += '>';
  in_tag_ = false;
  inline_ = true;
  escaped(text, false);
}

void Writer::element(std::string_view name, std::string_view content) {
  open(name);
  text(content);
  close();
}

// CDATA; it may contain anything but its own terminator.
void Writer::formatted(std::string_view name, std::string_view content) {
  open(name);
  text({});
  out_ += "<xhtml:p><![CDATA[";
  std::string storage;
  content = asUtf8(content, storage);
  for (size_t p = 0; p < content.size();) {
    const size_t end = std::min(content.find("]]>", p), content.size());
    for (const char c : content.substr(p, end - p))
      if (c != '\r') out_ += c;
    if (end < content.size()) out_ += "]]]]><![CDATA[>";
    p = end == content.size() ? end : end + 3;
  }
  out_ += "]]></xhtml:p>";
  close();
}

}  // namespace rung::xml

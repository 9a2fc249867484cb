// SPDX-License-Identifier: Apache-2.0
// The reader of XML files. In: one source (UTF-8). Out: its elements, attributes and runs of characters with their
// locations, in flat lists; or one error where the source is not well-formed XML. Namespace prefixes are dropped,
// comments and processing instructions skipped. A document type is rejected and only the five entities of XML and
// numeric references are known, so nothing expands and no other file is opened. Cost: one pass, and memory for the
// content of the file. Called by the readers of vendor files and of PLCopen XML.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/diagnostics.h"

namespace rung::xml {

constexpr uint32_t kNone = UINT32_MAX;
constexpr uint32_t kMaxDepth = 1000;         // elements inside each other
constexpr uint32_t kMaxElements = 1u << 24;  // in one file

struct Attribute {
  std::string_view name;
  std::string_view raw;  // with its entities; value() decodes
  Loc loc;               // of the value
};

// Characters of the file, unchanged, or one entity.
struct Run {
  Loc loc;
  uint32_t length;     // bytes in the file
  char32_t character;  // of an entity; 0: the run is a copy of the file
};

struct Element {
  std::string_view name;               // without a prefix
  Loc loc;                             // of the name
  uint32_t parent, first_child, next;  // indices of elements, or kNone
  uint32_t first_attribute, attribute_count;
  uint32_t first_run, end_run;  // the runs in it and in all elements below it
  Loc end;                      // of its end tag, or of the `/>`
};

// The children of one element, for range-based loops.
class Children {
 public:
  class Iterator {
   public:
    Iterator(const std::vector<Element>& elements, uint32_t at) : elements_(elements), at_(at) {}
    const Element& operator*() const { return elements_[at_]; }
    Iterator& operator++() {
      at_ = elements_[at_].next;
      return *this;
    }
    friend bool operator!=(const Iterator& a, const Iterator& b) { return a.at_ != b.at_; }

   private:
    const std::vector<Element>& elements_;
    uint32_t at_;
  };
  Children(const std::vector<Element>& elements, const Element* parent)
      : elements_(elements), first_(parent == nullptr ? kNone : parent->first_child) {}
  Iterator begin() const { return {elements_, first_}; }
  Iterator end() const { return {elements_, kNone}; }

 private:
  const std::vector<Element>& elements_;
  uint32_t first_;
};

struct Document {
  std::vector<Element> elements;  // in the order of the file; the root is the first
  std::vector<Attribute> attributes;
  std::vector<Run> runs;

  const Attribute* attribute(const Element& element, std::string_view name) const;
  std::string decoded(const Attribute& attribute) const;
  // The value of an attribute of this name, decoded; empty where there is none.
  std::string value(const Element& element, std::string_view name) const;
  // The location of the value of an attribute, or of the element where there is none.
  Loc locOf(const Element& element, std::string_view attribute) const;
  // The first child of this name, or null.
  const Element* child(const Element& element, std::string_view name) const;
  const Element* next(const Element& element) const { return at(element.next); }
  Children children(const Element& parent) const { return {elements, &parent}; }
  Children children(const Element* parent) const { return {elements, parent}; }  // null: none
  const Element* firstChild(const Element& element) const { return at(element.first_child); }
  std::string text(const Element& element, const Sources& sources) const;  // decoded

 private:
  const Element* at(uint32_t index) const { return index == kNone ? nullptr : &elements[index]; }
};

// The tag of the root element of a source that may be XML, from its `<` and without its `>`; empty: it has none.
std::string_view rootTag(std::string_view text);
// Its name in such a tag, without a prefix.
std::string_view rootName(std::string_view tag);

// False: an error has been reported, and the document holds the elements before it.
[[nodiscard]] bool read(const Sources& sources, FileId file, Diagnostics& diagnostics, Document& out);

}  // namespace rung::xml

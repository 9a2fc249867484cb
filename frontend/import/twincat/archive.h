// The archives in which TwinCAT 3 stores drawn bodies: <XmlArchive><Data> with <o n t> objects, <l2 n cet> lists, <v n>
// values and <n> for null, each named by its attribute `n`. They are read in place, so every value keeps its location.
// Used by nwl.cpp, cfc.cpp and sfc.cpp, whose output twincat.cpp inserts in place of statements.
#pragma once

#include <string>
#include <string_view>

#include "frontend/import/source_mapped_text.h"
#include "frontend/source/diagnostics.h"

namespace rung::vendor {

class Archive {
 public:
  Archive(const Sources& sources, const xml::Document& document) : sources_(sources), document_(document) {}

  const xml::Document& document() const { return document_; }
  // The object of this type in the archive below `body`. Null: not found.
  const xml::Element* root(const xml::Element& body, std::string_view type) const;
  // The member of `owner` with this name. Null: not found.
  const xml::Element* member(const xml::Element& owner, std::string_view name) const;
  // The first object or value of a list; null: the list is null or empty.
  const xml::Element* first(const xml::Element* list) const {
    return list == nullptr ? nullptr : document_.firstChild(*list);
  }
  const xml::Element* next(const xml::Element& element) const { return document_.next(element); }
  // The type of an object, given by itself or by its list for all elements; empty if by neither.
  std::string typeOf(const xml::Element& object) const;
  static bool isNothing(const xml::Element& element) { return element.name == "n"; }

  // The value without its quotes.
  std::string text(const xml::Element& value) const;
  std::string text(const xml::Element& owner, std::string_view name) const;
  bool isTrue(const xml::Element& owner, std::string_view name) const;
  uint64_t number(const xml::Element& owner, std::string_view name) const;  // 82 for 82L; 0 if missing
  // The location of the first character after the quote.
  Loc locOf(const xml::Element& value) const;
  // Writes the value without its quotes, with its locations in the file.
  void write(const xml::Element& value, xml::SourceMappedText& out) const;
  // Writes the value as a string of the notation of networks: ` 'text'`; nothing if it is empty.
  void writeString(const xml::Element& owner, std::string_view name, xml::SourceMappedText& out) const;

 private:
  const Sources& sources_;
  const xml::Document& document_;
};

// A name, or names separated by dots.
bool isPath(std::string_view text);

// Write the body below `body`, an <NWL>, <CFC> or <SFC>; messages use `name` for it. If it has an error, that is
// reported and nothing is written, to avoid follow-up errors.
void writeNwl(const Archive& archive, const xml::Element& body, const std::string& name, Diagnostics& diagnostics,
              xml::SourceMappedText& out);
void writeCfc(const Archive& archive, const xml::Element& body, const std::string& name, Diagnostics& diagnostics,
              xml::SourceMappedText& out);
void writeSfc(const Archive& archive, const xml::Element& body, const std::string& name, Diagnostics& diagnostics,
              xml::SourceMappedText& out);

// Whether the chart below `body` has a step of this name.
bool hasStep(const Archive& archive, const xml::Element& body, std::string_view name);
// The variables that the settings of a chart declare, in the <ObjectProperties> of `pou`.
void writeSfcFlags(const Archive& archive, const xml::Element& pou, xml::SourceMappedText& out);

// Appended to an action with the name of a step: in ST, members of a block share one name space.
constexpr std::string_view kActionSuffix = "_action";

}  // namespace rung::vendor

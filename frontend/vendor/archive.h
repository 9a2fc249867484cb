// The archives in which TwinCAT 3 keeps drawn bodies: <XmlArchive><Data> with <o n t> objects, <l2 n cet> lists, <v n>
// values and <n> for nothing, each called by its attribute `n`. Read as they stand, so that every value keeps its
// place. Used by nwl.cpp, cfc.cpp and sfc.cpp, which write what twincat.cpp puts where statements stand.
#pragma once

#include <string>
#include <string_view>

#include "frontend/source/diagnostics.h"
#include "frontend/xml/source_mapped_text.h"

namespace rung::vendor {

class Archive {
 public:
  Archive(const Sources& sources, const xml::Document& document) : sources_(sources), document_(document) {}

  const xml::Document& document() const { return document_; }
  // The object of this type in the archive below `body`. Null: there is none.
  const xml::Element* root(const xml::Element& body, std::string_view type) const;
  // What `owner` calls so. Null: nothing.
  const xml::Element* member(const xml::Element& owner, std::string_view name) const;
  // The first object or value of a list; null: the list is empty, or there is none.
  const xml::Element* first(const xml::Element* list) const {
    return list == nullptr ? nullptr : document_.firstChild(*list);
  }
  const xml::Element* next(const xml::Element& element) const { return document_.next(element); }
  // Of an object: what itself says, or what its list says of all; empty where neither does.
  std::string typeOf(const xml::Element& object) const;
  static bool isNothing(const xml::Element& element) { return element.name == "n"; }

  // Texts stand in quotes, which are not part of them.
  std::string text(const xml::Element& value) const;
  std::string text(const xml::Element& owner, std::string_view name) const;
  bool isTrue(const xml::Element& owner, std::string_view name) const;
  uint64_t number(const xml::Element& owner, std::string_view name) const;  // 82 for 82L; 0 where there is none
  // Where the text begins.
  Loc locOf(const xml::Element& value) const;
  // Writes the text as it stands in the file.
  void write(const xml::Element& value, xml::SourceMappedText& out) const;
  // Writes it as a string of the notation of networks: ` 'text'`; nothing where it is empty.
  void writeString(const xml::Element& owner, std::string_view name, xml::SourceMappedText& out) const;

 private:
  const Sources& sources_;
  const xml::Document& document_;
};

// A name, or names with dots between them.
bool isPath(std::string_view text);

// The body below `body`, an <NWL>, <CFC> or <SFC>; `name` is what messages call it. What cannot be read is reported,
// and nothing is written.
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

// Of an action with the name of a step: in the text, members of a block have one name space.
constexpr std::string_view kActionSuffix = "_action";

}  // namespace rung::vendor

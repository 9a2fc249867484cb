// SPDX-License-Identifier: Apache-2.0
// The archives in which TwinCAT 3 stores drawn bodies: <XmlArchive><Data> with <o n t> objects, <l2 n cet> lists, <v n>
// values and <n> for null, each named by its attribute `n`. They are read in place, so every value keeps its location.
// Used by nwl.cpp, cfc.cpp and sfc.cpp, whose output twincat.cpp inserts in place of statements.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/import/source_mapped_text.h"
#include "frontend/source/diagnostics.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/pin.h"

namespace rung::importer::twincat {

using xml::Element;

class Archive {
 public:
  Archive(const Sources& sources, const xml::Document& document) : sources_(sources), document_(document) {}

  const xml::Document& document() const { return document_; }
  const Sources& sources() const { return sources_; }
  // The object of this type in the archive below `body`. Null: not found.
  const xml::Element* root(const xml::Element& body, std::string_view type) const;
  // The member of `owner` with this name. Null: not found.
  const xml::Element* member(const xml::Element& owner, std::string_view name) const;
  // The first object or value of a list; null: the list is null or empty.
  const xml::Element* first(const xml::Element* list) const {
    return list == nullptr ? nullptr : document_.firstChild(*list);
  }
  xml::Children items(const xml::Element* list) const { return document_.children(list); }
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
  // The value without its quotes, with its locations in the file.
  xml::Excerpt excerptOf(const xml::Element& value) const;
  // The text of a comment or title, without trailing blanks.
  std::string commentOf(const xml::Element& owner, std::string_view name) const;
  // Reports an object that no body in `language` can have.
  void reportObject(Diagnostics& diagnostics, const xml::Element& object, std::string_view language,
                    std::string_view owner) const;

 private:
  const Sources& sources_;
  const xml::Document& document_;
};

// The name of a pin that has none, counted from 0: IN1, IN2; OUT, OUT1.
std::string pinName(PinDirection direction, size_t index);

// A drawn body that is to be written.
struct ArchivedBody {
  const Archive& archive;
  const xml::Element& object;  // of the body, in the archive
  const std::string& name;     // for messages
  Diagnostics& diagnostics;
  xml::SourceMappedText& out;
};
// If the body has an error, that is reported and nothing is written, to avoid follow-up errors.
void writeNwl(const ArchivedBody& body);
void writeCfc(const ArchivedBody& body);
void writeSfc(const ArchivedBody& body);

// Tells whether the chart below `body` has a step of this name.
bool hasStep(const Archive& archive, const xml::Element& body, std::string_view name);
// A flag that a POU has: SFCINIT.
struct DeclaredFlag {
  std::string name;  // in upper case
  bool by_user;      // in the declaration, not by the settings of a chart
};
// The variables that the settings of a chart declare, in the <ObjectProperties> of `owner`, a POU or action; those that
// are declared already are left out, the others added to `declared`.
void writeSfcFlags(const Archive& archive, const xml::Element& owner, std::vector<DeclaredFlag>& declared,
                   Diagnostics& diagnostics, xml::SourceMappedText& out);

}  // namespace rung::importer::twincat

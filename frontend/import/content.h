// SPDX-License-Identifier: Apache-2.0
// Reads names, values and content of XML elements and writes them as parts of ST. In: elements of one document. Out:
// source-mapped text, with the locations of the file. Shared by the readers of PLCopen XML and of IEC 61131-10.
#pragma once

#include <string>
#include <string_view>

#include "frontend/import/source_mapped_text.h"
#include "frontend/source/diagnostics.h"
#include "frontend/source/function_ref.h"
#include "frontend/source/scanner.h"

namespace rung::importer {

using xml::Element;

// Nesting depth of elements: types in types, actions in charts, wires in a row.
constexpr uint32_t kMaxNesting = 200;

constexpr uint64_t kLowestPriority = 31;  // of Rung's tasks; other tools allow larger numbers

// One file that is being read.
struct Reading {
  const Sources& sources;
  const xml::Document& document;
  Diagnostics& diagnostics;
  xml::SourceMappedText& out;
};

// The <text> of Rung's addData, which replaces all other content of `owner`; null: missing.
const xml::Element* ownTextOf(const Reading& reading, const xml::Element& owner);

// The content of the first addData of `owner` whose name ends with this kind: "method" of
// http://www.3s-software.com/plcopenxml/method. Null: missing.
const xml::Element* dataOf(const Reading& reading, const xml::Element& owner, std::string_view kind);
// The last part of a `data@name`.
std::string_view kindOfData(const Reading& reading, const xml::Element& data);
// Visits the `data` elements of this kind in the addData of `owner`.
template <class Visit>
void forEachData(const Reading& reading, const xml::Element& owner, std::string_view kind, Visit visit) {
  for (const xml::Element& all : reading.document.children(owner)) {
    if (all.name != "addData") continue;
    for (const xml::Element& data : reading.document.children(all))
      if (data.name == "data" && kindOfData(reading, data) == kind) visit(data);
  }
}

bool isTrue(const Reading& reading, const xml::Element& element, std::string_view attribute);
std::string textOf(const Reading& reading, const xml::Element& element);  // without leading and trailing blanks
bool isBlank(std::string_view text);
std::string trimmed(std::string_view text);  // without leading and trailing blanks

// The content of the element in ST or IL, regardless of wrapper elements: a line for each paragraph.
void writeText(Reading& reading, const xml::Element& element);
// Forbids an element without this attribute, or with an empty one.
//   fails   <pou pouType="program">          E1050
bool checkName(Reading& reading, const xml::Element& element, std::string_view attribute = "name");
// Writes the attribute, if it exists; an invalid name is reported.
bool writeName(Reading& reading, const xml::Element& element, std::string_view attribute = "name");
bool hasName(const Reading& reading, const xml::Element& element, std::string_view attribute = "name");
// Writes its documentation, as comments before a declaration.
void writeDocumentation(Reading& reading, const xml::Element& element);
// {attribute 'qualified_only'} for each Attribute in its addData.
void writeAttributes(Reading& reading, const xml::Element& element);
// Converts a name to an identifier: other characters become `_`.
std::string identifierOf(std::string_view name);
// The content as source of its own, on lines of its own.
void writeLines(Reading& reading, const xml::Element& element);

// Writes `, ` before all items of a list but the first.
class Separator {
 public:
  explicit Separator(xml::SourceMappedText& out, std::string_view first = {}) : out_(out), before_(first) {}
  void next() {
    out_.word(before_);
    before_ = ", ";
  }

 private:
  xml::SourceMappedText& out_;
  std::string_view before_;
};

// Writes the children of this name, separated by commas.
template <class Write>
void writeList(Reading& reading, const Element* parent, std::string_view name, Write write) {
  Separator separator(reading.out);
  for (const Element& e : reading.document.children(parent)) {
    if (e.name != name) continue;
    separator.next();
    write(e);
  }
}
// red, or red := 4
void writeEnumerator(Reading& reading, const Element& enumerator);
// [1, 3(0)] or (x := 1, y := 2); `write` writes a value inside.
void writeAggregate(Reading& reading, const Element& list, FunctionRef<void(const Element& value)> write);
// `TASK name`. False: it has no name, which was reported.
bool writeNamed(Reading& reading, const Element& element, std::string_view word);

// FUNCTION_BLOCK for `functionBlock` or `FunctionBlock`; empty: not a kind of POU.
std::string_view pouWordOf(std::string_view name);
// VAR_INPUT for `inputVars` or `InputVars`; empty: not a list of variables.
std::string_view sectionWordOf(std::string_view list);
// VAR_INPUT CONSTANT RETAIN and a line break, by the attributes of the list.
void writeSectionBegin(Reading& reading, const xml::Element& list, std::string_view word);
// The simple, array or structure value in `holder`; null: none.
const xml::Element* valueIn(const Reading& reading, const xml::Element& holder);
// 0..9
void writeRange(Reading& reading, const xml::Element& range);

}  // namespace rung::importer

// What the parts of the import share, and how they write into the text. Private to frontend/plcopen: plcopen.cpp (the
// project), types.cpp, declarations.cpp, pous.cpp, configuration.cpp, sfc.cpp, networks.h. Names and texts of the XML
// (content.cpp) serve frontend/iec10 as well.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/xml/source_mapped_text.h"

namespace rung::plcopen {

// Elements inside each other that have a meaning: types in types, actions in charts, wires behind wires.
constexpr uint32_t kMaxNesting = 200;

// An action whose body stands in a step, or a variable that a step names by more than a name.
struct OwnAction {
  std::string name;
  const xml::Element* body;  // null: `variable`
  const xml::Attribute* variable;
};

// Of an action with the name of a step: in the text, members of a block have one name space.
constexpr std::string_view kActionSuffix = "_action";

std::string upper(std::string_view name);

struct Import {
  const Sources& sources;
  const xml::Document& document;
  Diagnostics& diagnostics;
  xml::SourceMappedText& out;
  bool unquoted_strings = false;  // TC6 1.01 and 2.01, in which Beremiz keeps texts without quotes
  // Names of the library Beremiz that this file uses and does not declare; none in files of other tools.
  std::vector<std::string_view> beremiz_names = {};
  // FB_Init of the blocks that declare it, by the block's name in upper case, sorted.
  std::vector<std::pair<std::string, const xml::Element*>> initialisers = {};
  std::unordered_set<const xml::Element*> left_out = {};  // resources that repeat the names of an earlier one

  // Of the POU at hand: the steps of its charts and the actions with the name of one, in upper case, and what its
  // charts cannot say in a step.
  std::unordered_set<std::string> step_names = {}, renamed_actions = {};
  std::vector<OwnAction> own_actions = {};
  uint32_t own_action_count = 0;

  bool isStepName(std::string_view name) const { return step_names.count(upper(name)) != 0; }
  bool isRenamed(std::string_view action) const {
    return !renamed_actions.empty() && renamed_actions.count(upper(action)) != 0;
  }
  // "Beremiz." where a type's name means its library.
  const char* libraryOf(std::string_view type) const;
  bool isLeftOut(const xml::Element& resource) const { return left_out.count(&resource) != 0; }
};

// ---- content.cpp: reading and writing names, values and texts

// The <text> of Rung's own addData, which says all of `owner`; null: there is none.
const xml::Element* ownTextOf(const Import& import, const xml::Element& owner);

// The content of the first addData of `owner` whose name ends with this kind: "method" of
// http://www.3s-software.com/plcopenxml/method. Null: there is none.
const xml::Element* dataOf(const Import& import, const xml::Element& owner, std::string_view kind);
// The last part of a `data@name`.
std::string_view kindOfData(const Import& import, const xml::Element& data);
// Visits the `data` elements of this kind in the addData of `owner`.
template <class Visit>
void forEachData(const Import& import, const xml::Element& owner, std::string_view kind, Visit visit) {
  for (const xml::Element* all = import.document.firstChild(owner); all != nullptr; all = import.document.next(*all)) {
    if (all->name != "addData") continue;
    for (const xml::Element* data = import.document.firstChild(*all); data != nullptr;
         data = import.document.next(*data))
      if (data->name == "data" && kindOfData(import, *data) == kind) visit(*data);
  }
}

bool isTrue(const Import& import, const xml::Element& element, std::string_view attribute);
std::string textOf(const Import& import, const xml::Element& element);  // without blanks at its ends
bool isBlank(std::string_view text);

// The element and its text in ST or IL, whatever it is wrapped in: a line for each paragraph.
void writeText(Import& import, const xml::Element& element);
// Forbids an element without this attribute, or with an empty one.
//   fails   <pou pouType="program">          E1050
bool checkName(Import& import, const xml::Element& element, std::string_view attribute = "name");
// The attribute, if it is there; what is wrong is reported.
bool writeName(Import& import, const xml::Element& element, std::string_view attribute = "name");
bool hasName(const Import& import, const xml::Element& element, std::string_view attribute = "name");
// Its documentation, as comments before a declaration.
void writeDocumentation(Import& import, const xml::Element& element);
// {attribute 'qualified_only'} for each Attribute in its addData.
void writeAttributes(Import& import, const xml::Element& element);
// A name made fit for ST: what cannot stand in one becomes `_`.
std::string identifierOf(std::string_view name);
// Whether it is an identifier already.
bool isIdentifier(std::string_view text);

// ---- types.cpp

// The type in `holder`, an element such as <type> or <baseType>.
void writeType(Import& import, const xml::Element& holder, uint32_t depth = 0);
// ` := value`, of an element that may hold <initialValue>; `type` is what holds its type.
void writeInitialValue(Import& import, const xml::Element& declared, const xml::Element* type);
void writeDataType(Import& import, const xml::Element& data_type);

// ---- declarations.cpp

// The declaration as the editor has kept it: InterfaceAsPlainText, textDeclaration. Null: only its structure is there.
const xml::Element* plainText(const Import& import, const xml::Element& owner);
// The variables of <inputVars>, <struct> …, one line each.
void writeVariables(Import& import, const xml::Element& list, uint32_t depth = 0);
// VAR_INPUT … END_VAR for a list of variables; `word` is VAR_INPUT.
void writeSection(Import& import, const xml::Element& list, std::string_view word);
// The sections of an <interface>.
void writeSections(Import& import, const xml::Element& interface);
// {list 'name'} VAR_GLOBAL … of a list with a name.
void writeGlobals(Import& import, const xml::Element& globals);
// Whether the interface of `owner` declares the variable.
bool declares(const Import& import, const xml::Element& owner, std::string_view variable);

// ---- pous.cpp

void writePou(Import& import, const xml::Element& pou);
void writeInterface(Import& import, const xml::Element& interface);
// The statements, instructions, chart or networks of `owner`, an element with bodies; `name` is what messages call it.
// `pou` holds the named transitions of charts.
void writeBodies(Import& import, const xml::Element& owner, const xml::Element& pou, const std::string& name);
// That of one <body> or <inline>. False: it could not be read, which was reported.
bool writeBody(Import& import, const xml::Element& body, const xml::Element& pou, const std::string& name);

// ---- action_blocks.cpp

// The variables of the action blocks in the LD and FBD bodies of a POU.
void writeControls(Import& import, const xml::Element& pou);

// ---- configuration.cpp

void writeConfiguration(Import& import, const xml::Element& configuration);

// ---- sfc.cpp

void writeChart(Import& import, const xml::Element& chart, const xml::Element& pou, const std::string& name);
void writeOwnActions(Import& import, const xml::Element& pou, const std::string& name);
// The variables for the flags that the settings of `owner` switch on and its interface does not declare.
void writeFlags(Import& import, const xml::Element& owner);

}  // namespace rung::plcopen

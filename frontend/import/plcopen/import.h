// SPDX-License-Identifier: Apache-2.0
// Shared by the parts of the import. Private to frontend/import/plcopen: plcopen.cpp (the project), types.cpp,
// declarations.cpp, pous.cpp, configuration.cpp, sfc.cpp, networks.h.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "frontend/import/content.h"

namespace rung::importer::plcopen {

// An action whose body is in a step, or a variable that a step refers to by more than a name.
struct OwnAction {
  std::string name;
  const xml::Element* body;  // null: `variable`
  const xml::Attribute* variable;
};

struct Import : Reading {
  bool unquoted_strings = false;  // TC6 1.01 and 2.01, in which Beremiz writes strings without quotes
  bool is_rung = false;           // exported by Rung, with the comments and strings of the source
  // Names of the library Beremiz that this file uses but does not declare; empty for files of other tools.
  std::vector<std::string_view> beremiz_names = {};
  // FB_Init of the blocks that declare it, by the block's name in upper case, sorted.
  std::vector<std::pair<std::string, const xml::Element*>> initialisers = {};
  std::unordered_map<std::string, const xml::Element*> data_types = {};  // by name in upper case: the first of each
  std::unordered_set<const xml::Element*> left_out = {};  // resources that repeat the names of an earlier one

  // For the current POU: its actions, the steps of its charts and the actions with the name of one, in upper case, and
  // the actions that its charts cannot write in a step.
  std::unordered_set<std::string> action_names = {}, step_names = {}, renamed_actions = {};
  std::vector<OwnAction> own_actions = {};
  uint32_t own_action_count = 0;

  bool isStepName(std::string_view name) const { return step_names.count(upper(name)) != 0; }
  bool isRenamed(std::string_view action) const {
    return !renamed_actions.empty() && renamed_actions.count(upper(action)) != 0;
  }
  // "Beremiz." if the name denotes a type of that library.
  const char* libraryOf(std::string_view type) const;
  bool isLeftOut(const xml::Element& resource) const { return left_out.count(&resource) != 0; }
};

// ---- types.cpp

// The type in `holder`, an element such as <type> or <baseType>.
void writeType(Import& import, const xml::Element& holder, uint32_t depth = 0);
// ` := value`, of an element that may contain <initialValue>; `type` contains its type.
void writeInitialValue(Import& import, const xml::Element& declared, const xml::Element* type);
void writeDataType(Import& import, const xml::Element& data_type);

// ---- declarations.cpp

// The declaration as text: InterfaceAsPlainText, textDeclaration. Null: only its structure is given.
const xml::Element* plainText(const Import& import, const xml::Element& owner);
// The variables of <inputVars>, <struct> …, one line each.
void writeVariables(Import& import, const xml::Element& list, uint32_t depth = 0);
// VAR_INPUT … END_VAR for a list of variables; `word` is VAR_INPUT.
void writeSection(Import& import, const xml::Element& list, std::string_view word);
// The sections of an <interface>.
void writeSections(Import& import, const xml::Element& interface);
// {list 'name'} VAR_GLOBAL … of a list with a name.
void writeGlobals(Import& import, const xml::Element& globals);
// Tells whether the interface of `owner` declares the variable.
bool declares(const Import& import, const xml::Element& owner, std::string_view variable);

// ---- pous.cpp

void writePou(Import& import, const xml::Element& pou);
void writeInterface(Import& import, const xml::Element& interface);
// The statements, instructions, chart or networks of `owner`, an element with bodies; messages use `name` for it. `pou`
// has the named transitions of charts.
void writeBodies(Import& import, const xml::Element& owner, const xml::Element& pou, const std::string& name);
// The same for one <body> or <inline>. False: it could not be read, which was reported.
bool writeBody(Import& import, const xml::Element& body, const xml::Element& pou, const std::string& name);

// ---- action_blocks.cpp

// The variables of the action blocks in the LD and FBD bodies of a POU.
void writeControls(Import& import, const xml::Element& pou);

// ---- configuration.cpp

void writeConfiguration(Import& import, const xml::Element& configuration);
// Resources outside of configurations: an application that CODESYS exported without its device.
void writeApplications(Import& import, std::span<const xml::Element* const> resources);

// ---- sfc.cpp

void writeChart(Import& import, const xml::Element& chart, const xml::Element& pou, const std::string& name);
void writeOwnActions(Import& import, const xml::Element& pou, const std::string& name);
// The variables for the flags that the settings of `owner` enable but its interface does not declare.
void writeFlags(Import& import, const xml::Element& owner);

}  // namespace rung::importer::plcopen

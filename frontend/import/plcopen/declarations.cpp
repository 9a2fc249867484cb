// SPDX-License-Identifier: Apache-2.0
// Interfaces, sections of variables and lists of globals as ST; see import.h.
#include <algorithm>
#include <utility>

#include "frontend/import/plcopen/import.h"
#include "frontend/source/names.h"

namespace rung::importer::plcopen {
namespace {

// The inputs of FB_Init are arguments of the declaration.
const xml::Element* initialiserOf(const Import& import, std::string_view block) {
  const std::string name = upper(block);
  const auto found = std::lower_bound(import.initialisers.begin(), import.initialisers.end(), name,
                                      [](const auto& entry, const std::string& key) { return entry.first < key; });
  return found == import.initialisers.end() || found->first != name ? nullptr : found->second;
}

// `(5, port := 1)`: arguments of FB_Init by position or name. `(speed := 2)`: values of variables, which other exports
// write as an initial value. False: no assignments of the requested kind.
bool writeAssignments(Import& import, const xml::Element& type, const xml::Element& assignments, bool arguments) {
  const xml::Element* derived = import.document.child(type, "derived");
  const xml::Element* initialiser =
      derived == nullptr ? nullptr : initialiserOf(import, import.document.value(*derived, "name"));
  bool any = false;
  for (const xml::Element& e : import.document.children(assignments)) {
    const xml::Element* name = import.document.child(e, "Name");
    const xml::Element* value = import.document.child(e, "Value");
    if (value == nullptr) continue;
    if (name != nullptr && isBlank(import.document.text(*name, import.sources))) name = nullptr;
    const bool is_argument =
        name == nullptr || (initialiser != nullptr && declares(import, *initialiser, textOf(import, *name)));
    if (is_argument != arguments) continue;
    import.out.word(any ? ", " : arguments ? "(" : " := (");
    any = true;
    if (name != nullptr) {
      import.out.add(import.document, *name);
      import.out.word(" := ");
    }
    import.out.add(import.document, *value);
  }
  if (any) import.out.word(")");
  return any;
}

// The value of an attribute of CODESYS in the addData of `owner`; null: missing.
const xml::Attribute* attributeOf(const Import& import, const xml::Element& owner, std::string_view name) {
  const xml::Element* attributes = dataOf(import, owner, "attributes");
  for (const xml::Element& e : import.document.children(attributes))
    if (import.document.value(e, "Name") == name) return import.document.attribute(e, "Value");
  return nullptr;
}

// CODESYS exports ARRAY[*] as the input that it compiles it to, a pointer. The attributes have the type that the user
// wrote and, from version 3.5.18, the section: "Input" or "Inout", the only ones in which it allows ARRAY[*].
const xml::Attribute* arrayOfAnyLength(const Import& import, const xml::Element& variable) {
  return attributeOf(import, variable, "variable_length_array");
}

std::string_view sectionOfVariable(const Import& import, const xml::Element& variable, std::string_view section) {
  if (arrayOfAnyLength(import, variable) == nullptr) return section;
  const xml::Attribute* scope = attributeOf(import, variable, "variable_length_array_original_scope");
  return scope != nullptr && sameIdentifier(scope->raw, "input") ? "VAR_INPUT" : "VAR_IN_OUT";
}

void writeVariable(Import& import, const xml::Element& variable, uint32_t depth) {
  if (!checkName(import, variable)) return;
  writeDocumentation(import, variable);
  if (const xml::Attribute* array = arrayOfAnyLength(import, variable)) {
    writeName(import, variable);
    import.out.word(" : ");
    import.out.add(import.document, *array);
    return import.out.word(";\n");
  }
  writeAttributes(import, variable);
  writeName(import, variable);
  if (hasName(import, variable, "address")) {
    import.out.word(" AT ");
    writeName(import, variable, "address");
  }
  import.out.word(" : ");
  writeType(import, variable, depth);
  const xml::Element* type = import.document.child(variable, "type");
  const xml::Element* assignments = dataOf(import, variable, "inputassignments");
  if (assignments != nullptr && type != nullptr) writeAssignments(import, *type, *assignments, true);
  if (assignments == nullptr || type == nullptr || !writeAssignments(import, *type, *assignments, false))
    writeInitialValue(import, variable, type);
  import.out.word(";\n");
}

}  // namespace

const xml::Element* plainText(const Import& import, const xml::Element& owner) {
  const xml::Element* interface = import.document.child(owner, "interface");
  for (const xml::Element* holder : {&owner, interface}) {
    if (holder == nullptr) continue;
    if (const xml::Element* plain = dataOf(import, *holder, "interfaceasplaintext"))
      if (!isBlank(import.document.text(*plain, import.sources))) return plain;
    if (const xml::Element* declaration = dataOf(import, *holder, "plcopenxml")) {  // www.bachmann.at/plc/plcopenxml
      const xml::Element* content =
          declaration->name == "textDeclaration" ? import.document.child(*declaration, "content") : nullptr;
      if (content != nullptr && !isBlank(import.document.text(*content, import.sources))) return content;
    }
  }
  return import.document.child(owner, "InterfaceAsPlainText");  // of methods, in older exports
}

void writeVariables(Import& import, const xml::Element& list, uint32_t depth) {
  for (const xml::Element& e : import.document.children(list))
    if (e.name == "variable") writeVariable(import, e, depth);
}

void writeSection(Import& import, const xml::Element& list, std::string_view word) {
  writeAttributes(import, list);
  writeSectionBegin(import, list, word);
  std::string_view current = word;
  for (const xml::Element& e : import.document.children(list)) {
    if (e.name != "variable") continue;
    // The order of the parameters stays, for calls by position.
    if (const std::string_view own = sectionOfVariable(import, e, word); own != current) {
      import.out.word("END_VAR\n");
      writeSectionBegin(import, list, own);
      current = own;
    }
    writeVariable(import, e, 0);
  }
  import.out.word("END_VAR\n");
}

void writeSections(Import& import, const xml::Element& interface) {
  for (const xml::Element& e : import.document.children(interface))
    if (const std::string_view word = sectionWordOf(e.name); !word.empty()) writeSection(import, e, word);
}

// A list may consist of several sections, constants and others: MixedAttrsVarList.
void writeGlobals(Import& import, const xml::Element& globals) {
  const std::string name = import.document.value(globals, "name");
  import.out.put(globals.loc, "{list '" + (isBlank(name) ? name : identifierOf(name)) + "'}\n");
  if (const xml::Element* plain = plainText(import, globals)) {
    writeText(import, *plain);
    import.out.word("\n");
    return;
  }
  const xml::Element* mixed = dataOf(import, globals, "mixedattrsvarlist");
  if (mixed == nullptr) return writeSection(import, globals, "VAR_GLOBAL");
  for (const xml::Element& e : import.document.children(*mixed)) {
    if (e.name != "globalVars") continue;
    writeAttributes(import, globals);
    writeSection(import, e, "VAR_GLOBAL");
  }
}

bool declares(const Import& import, const xml::Element& owner, std::string_view variable) {
  if (const xml::Element* plain = plainText(import, owner)) {
    const std::string text = import.document.text(*plain, import.sources);
    Scanner scanner(text);
    for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next())
      if (unit.kind == UnitKind::Name && sameIdentifier(scanner.textOf(unit), variable)) return true;
    return false;
  }
  const xml::Element* interface = import.document.child(owner, "interface");
  for (const xml::Element& list : import.document.children(interface)) {
    if (sectionWordOf(list.name).empty()) continue;
    for (const xml::Element& e : import.document.children(list))
      if (e.name == "variable" && sameIdentifier(import.document.value(e, "name"), variable)) return true;
  }
  return false;
}

}  // namespace rung::importer::plcopen

// SPDX-License-Identifier: Apache-2.0
// POUs, interfaces and their members as ST; see import.h. The parts of a POU are written in this order:
//
//   declaration {ACTION | METHOD | PROPERTY} body END_…
#include <algorithm>
#include <utility>

#include "frontend/import/chart_writer.h"
#include "frontend/import/diagnostics.h"
#include "frontend/import/plcopen/import.h"
#include "frontend/import/plcopen/networks.h"
#include "frontend/source/names.h"
#include "frontend/source/nested_comments.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/diagram.h"

namespace rung::importer::plcopen {
namespace {

// Forbids an unknown kind of POU. TC6, pouType.
//   fails   <pou name="P" pouType="programm">          E1052
std::string_view pouWord(Import& import, const xml::Element& pou) {
  const xml::Attribute* type = import.document.attribute(pou, "pouType");
  if (const xml::Element* own = dataOf(import, pou, "extension"))  // exported by Rung: class
    if (const xml::Attribute* named = import.document.attribute(*own, "pouType")) type = named;
  const std::string_view word = type == nullptr || sameIdentifier(type->raw, "method") ? "" : pouWordOf(type->raw);
  if (type == nullptr)
    import.diagnostics.report(diag::XmlNoName, pou.loc, {pou.name, "pouType"});
  else if (word.empty())
    import.diagnostics.report(diag::XmlPouType, type->loc, {type->raw}).length(static_cast<uint32_t>(type->raw.size()));
  return word;
}

// `data` of the element or of its interface: editors differ in where they write it.
const xml::Element* dataOfEither(const Import& import, const xml::Element& owner, std::string_view kind) {
  const xml::Element* found = dataOf(import, owner, kind);
  const xml::Element* interface = import.document.child(owner, "interface");
  return found != nullptr || interface == nullptr ? found : dataOf(import, *interface, kind);
}

// PRIVATE FINAL
void writeModifiers(Import& import, const xml::Element& owner) {
  const xml::Element* modifiers = dataOfEither(import, owner, "accessmodifiers");
  if (modifiers == nullptr) return;
  for (const std::string_view word : {"Public", "Private", "Protected", "Internal", "Final", "Abstract", "Override"})
    if (isTrue(import, *modifiers, word)) import.out.put(modifiers->loc, upper(word) + " ");
}

// EXTENDS a IMPLEMENTS b, c
void writeInheritance(Import& import, const xml::Element& owner, std::string_view kind) {
  const xml::Element* inheritance = dataOfEither(import, owner, kind);
  if (inheritance == nullptr) inheritance = import.document.child(owner, "Inheritance");  // of an interface
  if (inheritance == nullptr) return;
  for (const auto& [name, word] : {std::pair{"Extends", " EXTENDS "}, std::pair{"Implements", " IMPLEMENTS "}}) {
    Separator separator(import.out, word);
    for (const xml::Element& e : import.document.children(*inheritance)) {
      if (e.name != name || isBlank(import.document.text(e, import.sources))) continue;
      separator.next();
      writeText(import, e);
    }
  }
}

void writeResult(Import& import, const xml::Element& owner) {
  const xml::Element* interface = import.document.child(owner, "interface");
  const xml::Element* result = interface == nullptr ? nullptr : import.document.child(*interface, "returnType");
  if (result == nullptr || import.document.firstChild(*result) == nullptr) return;
  import.out.word(" : ");
  writeType(import, *result);
}

// The declaration of a POU, method or interface: the text kept by the editor, or else made from its structure. False:
// it has no name, which was reported.
bool writeHeader(Import& import, const xml::Element& owner, std::string_view word, std::string_view inheritance) {
  if (const xml::Element* plain = plainText(import, owner)) {
    writeLines(import, *plain);
    return true;
  }
  if (!checkName(import, owner)) return false;
  const xml::Element* interface = import.document.child(owner, "interface");
  writeDocumentation(
      import, interface != nullptr && import.document.child(owner, "documentation") == nullptr ? *interface : owner);
  writeAttributes(import, owner);
  if (interface != nullptr) writeAttributes(import, *interface);
  import.out.put(owner.loc, word);
  writeModifiers(import, owner);
  writeName(import, owner);
  if (!inheritance.empty()) writeInheritance(import, owner, inheritance);
  writeResult(import, owner);
  import.out.word("\n");
  if (interface != nullptr) writeSections(import, *interface);
  return true;
}

std::string nameOf(const Import& import, const xml::Element& element) { return import.document.value(element, "name"); }

// A member that was exported as text by Rung.
bool writeOwnText(Import& import, const xml::Element& owner) {
  const xml::Element* text = ownTextOf(import, owner);
  if (text == nullptr) return false;
  writeLines(import, *text);
  return true;
}

void writeMethod(Import& import, const xml::Element& method, const xml::Element& pou) {
  if (writeOwnText(import, method)) return;
  if (!writeHeader(import, method, "METHOD ", {})) return;
  writeBodies(import, method, pou, nameOf(import, pou) + "." + nameOf(import, method));
  import.out.put(method.end, "END_METHOD\n");
}

// Without the white space in front: the text may begin with a modifier, which belongs to the keyword before it.
void writeTrimmed(Import& import, const xml::Element& text) {
  uint32_t first = text.first_run;
  for (; first < text.end_run; ++first) {
    const xml::Run& run = import.document.runs[first];
    const Loc end{run.loc.offset + run.length};
    if (run.character != 0) break;
    const FileId file = import.sources.fileOf(run.loc);
    const std::string_view all =
        import.sources.sourceText(file).substr(run.loc.offset - import.sources.begin(file).offset, run.length);
    const auto begin = std::find_if_not(all.begin(), all.end(), isBlankCharacter);
    if (begin == all.end()) continue;
    import.out.add({run.loc.offset + static_cast<uint32_t>(begin - all.begin())}, end);
    ++first;
    break;
  }
  import.out.addRuns(import.document, first, text.end_run);
}

void writeProperty(Import& import, const xml::Element& property, const xml::Element& pou) {
  if (!writeHeader(import, property, "PROPERTY ", {})) return;
  for (const auto& [element, word] : {std::pair{"GetAccessor", "GET"}, std::pair{"SetAccessor", "SET"}}) {
    const xml::Element* accessor = import.document.child(property, element);
    if (accessor == nullptr) continue;
    const std::string begin = std::string(word) + " ", end = std::string("END_") + word + "\n";
    import.out.put(accessor->loc, begin);
    writeModifiers(import, *accessor);
    if (const xml::Element* plain = plainText(import, *accessor)) {
      writeTrimmed(import, *plain);
      import.out.word("\n");
    } else {
      import.out.word("\n");
      if (const xml::Element* interface = import.document.child(*accessor, "interface"))
        writeSections(import, *interface);
    }
    writeBodies(import, *accessor, pou, nameOf(import, pou) + "." + nameOf(import, property));
    import.out.put(accessor->end, end);
  }
  import.out.put(property.end, "END_PROPERTY\n");
}

void writeMembers(Import& import, const xml::Element& owner) {
  forEachData(import, owner, "method", [&](const xml::Element& data) {
    if (const xml::Element* method = import.document.firstChild(data)) writeMethod(import, *method, owner);
  });
  forEachData(import, owner, "property", [&](const xml::Element& data) {
    if (const xml::Element* property = import.document.firstChild(data)) writeProperty(import, *property, owner);
  });
}

void writeActions(Import& import, const xml::Element& pou) {
  const xml::Element* actions = import.document.child(pou, "actions");
  for (const xml::Element& e : import.document.children(actions)) {
    if (e.name != "action" || writeOwnText(import, e) || !checkName(import, e)) continue;
    import.out.put(e.loc, "ACTION ");
    writeName(import, e);
    if (import.isRenamed(nameOf(import, e))) import.out.word(kActionSuffix);
    import.out.word(" :\n");
    writeBodies(import, e, pou, nameOf(import, pou) + "." + nameOf(import, e));
    import.out.put(e.end, "END_ACTION\n");
    writeOwnActions(import, pou, nameOf(import, pou));
  }
}

// The <CFC> in the addData beside an empty <ST>.
const xml::Element* cfcOf(const Import& import, const xml::Element& body) {
  const xml::Element* cfc = dataOf(import, body, "cfc");
  return cfc != nullptr && cfc->name == "CFC" ? cfc : nullptr;
}

// The steps of all charts of a POU.
void findSteps(Import& import, const xml::Element& pou) {
  import.action_names.clear();
  import.step_names.clear();
  import.renamed_actions.clear();
  const auto find = [&](auto& self, const xml::Element& owner) -> void {
    const xml::Element* body = import.document.child(owner, "body");
    const xml::Element* chart = body == nullptr ? nullptr : import.document.child(*body, "SFC");
    for (const xml::Element& e : import.document.children(chart)) {
      if (e.name == "step") import.step_names.insert(upper(nameOf(import, e)));
      if (e.name == "macroStep") self(self, e);
    }
  };
  find(find, pou);
  const xml::Element* actions = import.document.child(pou, "actions");
  for (const xml::Element& e : import.document.children(actions)) find(find, e);
  for (const xml::Element& e : import.document.children(actions)) {
    const std::string name = upper(nameOf(import, e));
    import.action_names.insert(name);
    if (import.step_names.count(name) != 0) import.renamed_actions.insert(name);
  }
}

// Tells whether a comment, which ends at the first `*)`, contains the beginning of another one.
bool hasCommentInComment(std::string_view code) {
  const std::string marked = kCommentsDoNotNest + std::string(code);
  Scanner scanner(marked);
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next()) {
    const std::string_view text = scanner.textOf(unit);
    if (unit.kind == UnitKind::Comment && text[1] == '*' && text.find(text.substr(0, 2), 2) != std::string_view::npos)
      return true;
  }
  return false;
}

// Comments of Beremiz and OpenPLC end at the first `*)`.
void writeCode(Import& import, const xml::Element& code) {
  const bool is_flat = import.unquoted_strings && !import.is_rung && hasCommentInComment(textOf(import, code));
  if (is_flat) import.out.word(kCommentsDoNotNest);
  writeLines(import, code);
  if (is_flat) import.out.word(kCommentsNest);
}

}  // namespace

bool writeBody(Import& import, const xml::Element& body, const xml::Element& pou, const std::string& name) {
  const auto networks = [&](const xml::Element& diagram, NetworkLanguage language) {
    writeNetworks(import, {diagram, language});
  };
  if (const xml::Element* cfc = cfcOf(import, body)) {
    networks(*cfc, NetworkLanguage::Continuous);
    return true;
  }
  if (writeOwnText(import, body)) return true;
  bool ok = true;
  for (const xml::Element& e : import.document.children(body)) {
    if (e.name == "ST" || e.name == "IL") {
      writeCode(import, e);
    } else if (e.name == "LD") {
      networks(e, NetworkLanguage::Ladder);
    } else if (e.name == "FBD") {
      networks(e, NetworkLanguage::Blocks);
    } else if (e.name == "CFC") {
      networks(e, NetworkLanguage::Continuous);
    } else if (e.name == "SFC") {
      writeChart(import, e, pou, name);
    } else if (e.name != "addData" && e.name != "documentation") {
      import.diagnostics.report(diag::XmlBodyLanguage, e.loc, {name, e.name});
      ok = false;
    }
  }
  return ok;
}

void writeBodies(Import& import, const xml::Element& owner, const xml::Element& pou, const std::string& name) {
  for (const xml::Element& e : import.document.children(owner))
    if (e.name == "body") writeBody(import, e, pou, name);
}

void writePou(Import& import, const xml::Element& pou) {
  const std::string word(pouWord(import, pou));
  if (word.empty() || !writeHeader(import, pou, word + " ", "pouinheritance")) return;
  writeFlags(import, pou);
  writeControls(import, pou);
  findSteps(import, pou);
  import.own_action_count = 0;
  writeActions(import, pou);
  writeMembers(import, pou);
  writeBodies(import, pou, pou, nameOf(import, pou));
  writeOwnActions(import, pou, nameOf(import, pou));
  import.out.put(pou.end, "END_" + word + "\n");
}

// The 3S extension: <Interface name> with Methods and Properties.
void writeInterface(Import& import, const xml::Element& interface) {
  if (!writeHeader(import, interface, "INTERFACE ", "pouinheritance")) return;
  for (const xml::Element& list : import.document.children(interface)) {
    if (list.name != "Methods" && list.name != "Properties") continue;
    for (const xml::Element& e : import.document.children(list)) {
      if (e.name == "Method") writeMethod(import, e, interface);
      if (e.name == "Property") writeProperty(import, e, interface);
    }
  }
  writeMembers(import, interface);
  import.out.put(interface.end, "END_INTERFACE\n");
}

}  // namespace rung::importer::plcopen

// SPDX-License-Identifier: Apache-2.0
// Action blocks in LD and FBD: the wire into one drives its actions, by their qualifiers, as a step does in a chart.
// Each action has a control block of the library, which all action blocks with its name share. An action block stores
// its wire in a variable; after all elements of the body, the control blocks and the active actions are called. IEC
// 61131-3 ed. 3, 6.7.4.5 and table 58, 5l and 5f.
#include "frontend/import/diagnostics.h"
#include "frontend/import/plcopen/import.h"
#include "frontend/import/plcopen/networks.h"
#include "frontend/source/names.h"

namespace rung::importer::plcopen {
namespace {

// The name of the variable or action; null: missing, or not an identifier.
const xml::Attribute* nameOf(const xml::Document& document, const xml::Element& action) {
  const xml::Element* reference = document.child(action, "reference");
  const xml::Attribute* name = reference == nullptr ? nullptr : document.attribute(*reference, "name");
  return name != nullptr && isIdentifier(name->raw) ? name : nullptr;
}

template <class Visit>
void forEachAction(const xml::Document& document, const xml::Element& body, Visit visit) {
  for (const xml::Element& block : document.children(body)) {
    if (block.name != "actionBlock") continue;
    for (const xml::Element& e : document.children(block))
      if (e.name == "action") visit(block, e);
  }
}

bool isAction(const xml::Document& document, const xml::Element& body, std::string_view name) {
  const xml::Element* pou = &body;
  while (pou->name != "pou" && pou->parent != xml::kNone) pou = &document.elements[pou->parent];
  const xml::Element* actions = document.child(*pou, "actions");
  for (const xml::Element& e : document.children(actions))
    if (sameIdentifier(document.value(e, "name"), name)) return true;
  return false;
}

// The LD and FBD bodies of a POU and of its actions.
template <class Visit>
void forEachDiagram(const xml::Document& document, const xml::Element& pou, Visit visit) {
  const auto inside = [&](const xml::Element& owner) {
    for (const xml::Element& body : document.children(owner))
      if (body.name == "body")
        for (const char* language : {"LD", "FBD"})
          if (const xml::Element* diagram = document.child(body, language)) visit(*diagram);
  };
  inside(pou);
  const xml::Element* actions = document.child(pou, "actions");
  for (const xml::Element& e : document.children(actions)) inside(e);
}

}  // namespace

std::string wireOf(const xml::Document& document, const xml::Element& block) {
  return "sfc_wire_" + identifierOf("n" + document.value(block, "localId"));
}

// Forbids an action block in a network without the name of a variable or action: other blocks could not share its body.
//   fails   <action><inline>…</inline></action> in an <LD>          E1050
void writeControls(Import& import, const xml::Element& pou) {
  const xml::Document& document = import.document;
  std::unordered_set<std::string> declared;
  const auto declare = [&](Loc loc, const std::string& name, std::string_view type) {
    if (declared.insert(upper(name)).second)
      import.out.put(loc, "VAR " + name + " : " + std::string(type) + "; END_VAR\n");
  };
  forEachDiagram(document, pou, [&](const xml::Element& diagram) {
    forEachAction(document, diagram, [&](const xml::Element& block, const xml::Element& action) {
      declare(block.loc, wireOf(document, block), "BOOL");
      if (const xml::Attribute* name = nameOf(document, action))
        declare(action.loc, "sfc_control_" + std::string(name->raw), "SFCActionControl");
      else
        import.diagnostics.report(diag::XmlNoName, action.loc, {"reference", "name"});
    });
  });
}

void writeActionCalls(const xml::Document& document, const xml::Element& body, xml::SourceMappedText& out) {
  std::vector<const xml::Attribute*> called;
  forEachAction(document, body, [&](const xml::Element& block, const xml::Element& action) {
    const xml::Attribute* name = nameOf(document, action);
    if (name == nullptr) return;
    const std::string control = "sfc_control_" + std::string(name->raw), wire = wireOf(document, block);
    const xml::Attribute* qualifier = document.attribute(action, "qualifier");
    const bool given = qualifier != nullptr && !isBlank(qualifier->raw);
    const std::string pin = control + "." + (given ? std::string(qualifier->raw) : "N");
    out.put(given ? qualifier->loc : action.loc, pin);
    out.word(" := " + pin + " OR " + wire + ";\n");
    if (const xml::Attribute* time = document.attribute(action, "duration"); time != nullptr && !isBlank(time->raw)) {
      out.put(time->loc, "IF " + wire + " THEN " + control + ".T := ");
      out.add(document, *time);
      out.word("; END_IF\n");
    }
    bool known = false;
    for (const xml::Attribute* other : called) known = known || sameIdentifier(other->raw, name->raw);
    if (!known) called.push_back(name);
  });
  for (const xml::Attribute* name : called) {
    const std::string control = "sfc_control_" + std::string(name->raw);
    out.put(name->loc, control + "(now := TASK_TIME());\n");
    if (isAction(document, body, name->raw)) {
      out.put(name->loc, "IF " + control + ".x THEN ");
      out.add(document, *name);
      out.word("(); END_IF\n");
    } else {
      out.add(document, *name);
      out.word(" := " + control + "._x;\n");
    }
  }
}

}  // namespace rung::importer::plcopen

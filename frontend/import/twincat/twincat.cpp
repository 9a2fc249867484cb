// SPDX-License-Identifier: Apache-2.0
// TwinCAT 3: .TcPOU, .TcDUT, .TcTLEO, .TcGVL, .TcIO and .TcTTO. An object of the project is an element with a
// <Declaration> in ST; POUs also have an <Implementation> and members. Drawn bodies are object archives (archive.h). A
// body of an unsupported kind is an error, but the declarations of its POU are read all the same.
#include <string>

#include "frontend/import/chart_writer.h"
#include "frontend/import/content.h"
#include "frontend/import/diagnostics.h"
#include "frontend/import/twincat/archive.h"
#include "frontend/import/twincat/twincat.h"
#include "frontend/source/scanner.h"

namespace rung::importer::twincat {
namespace {

// How messages describe the elements of unsupported bodies.
const char* languageOf(std::string_view element) {
  if (element == "FBD" || element == "LD" || element == "LADDER") return "drawn in networks (FBD or LD)";
  if (element == "StateChart" || element == "UML") return "a state chart";
  if (element == "IL") return "written in IL";
  return nullptr;
}

class TwinCatReader {
 public:
  TwinCatReader(const Sources& sources, const xml::Document& document, Diagnostics& diagnostics)
      : document_(document),
        sources_(sources),
        archive_(sources, document),
        diagnostics_(diagnostics),
        program_(sources) {}

  xml::SourceMappedText& run() {
    for (const xml::Element& e : document_.children(document_.elements[0])) {
      if (e.name == "POU" || e.name == "Itf") {
        readPou(e);
      } else if (e.name == "DUT" || e.name == "GVL" || e.name == "EnumerationTextList") {
        part(e, "Declaration");
      } else if (e.name == "Task") {
        readTask(e);
      }  // others are pictures and lists of strings
    }
    return program_;
  }

 private:
  void part(const xml::Element& element, std::string_view name) {
    const xml::Element* text = document_.child(element, name);
    if (text == nullptr) return;
    program_.add(document_, *text);
    program_.word("\n");
  }

  static std::vector<DeclaredFlag> declaredFlags(std::string_view declaration) {
    std::vector<DeclaredFlag> flags;
    Scanner scanner(declaration);
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode())
      if (std::string name = upper(scanner.textOf(unit)); unit.kind == UnitKind::Name && name.starts_with("SFC"))
        flags.push_back({std::move(name), true});
    return flags;
  }

  // POU = declaration {member} body END_…
  void readPou(const xml::Element& pou) {
    const xml::Element* declaration = document_.child(pou, "Declaration");
    if (declaration == nullptr) return;
    const std::string name = document_.value(pou, "Name");
    const xml::Element* body = document_.child(pou, "Implementation");
    chart_ = body == nullptr ? nullptr : document_.child(*body, "SFC");
    part(pou, "Declaration");
    std::vector<DeclaredFlag> flags = declaredFlags(document_.text(*declaration, sources_));
    if (chart_ != nullptr) writeSfcFlags(archive_, pou, flags, diagnostics_, program_);
    for (const xml::Element& e : document_.children(pou))  // the flags of a chart that is an action belong to the block
      if (e.name == "Action" && chart_ == nullptr) writeSfcFlags(archive_, e, flags, diagnostics_, program_);
    for (const xml::Element& e : document_.children(pou)) {
      if (e.name == "Method") readMethod(e, name);
      if (e.name == "Property") readProperty(e, name);
      if (e.name == "Action") readNamed(e, name, "ACTION");
      if (e.name == "Transition") readNamed(e, name, "TRANSITION");
    }
    readBody(pou, name);
    closeWith(endWordOf(firstWord(document_.text(*declaration, sources_))));
  }

  void readMethod(const xml::Element& method, const std::string& owner) {
    part(method, "Declaration");
    readBody(method, owner + "." + document_.value(method, "Name"));
    closeWith("END_METHOD");
  }

  void readProperty(const xml::Element& property, const std::string& owner) {
    part(property, "Declaration");
    for (const xml::Element& e : document_.children(property)) {
      const bool get = e.name == "Get";
      if (!get && e.name != "Set") continue;
      program_.word(get ? "GET " : "SET ");  // modifiers, as in `GET PROTECTED`, follow in the declaration
      part(e, "Declaration");
      program_.word("\n");
      readBody(e, owner + "." + document_.value(property, "Name"));
      closeWith(get ? "END_GET" : "END_SET");
    }
    closeWith("END_PROPERTY");
  }

  // ACTION name : body END_ACTION, TRANSITION name : body END_TRANSITION; that of a transition assigns to the name.
  void readNamed(const Element& member, const std::string& owner, const std::string& word) {
    const xml::Attribute* name = document_.attribute(member, "Name");
    if (name == nullptr) return;
    program_.word(word + " ");
    program_.add(name->loc, {name->loc.offset + static_cast<uint32_t>(name->raw.size())});
    const bool action = word == "ACTION";
    if (action && chart_ != nullptr && hasStep(archive_, *chart_, document_.decoded(*name)))
      program_.word(kActionSuffix);
    program_.word(" :\n");
    readBody(member, owner + "." + document_.value(member, "Name"));
    closeWith("END_" + word);
  }

  void readDrawn(const Element& body, std::string_view object, const std::string& name,
                 void (*write)(const ArchivedBody&)) {
    if (const Element* found = archive_.root(body, object))
      write({archive_, *found, name, diagnostics_, program_});
    else
      diagnostics_.report(diag::ArchiveEmpty, body.loc, {name, object});
  }

  void readBody(const xml::Element& owner, const std::string& name) {
    const xml::Element* body = document_.child(owner, "Implementation");
    if (body == nullptr) return;
    for (const xml::Element& e : document_.children(*body)) {
      if (e.name == "ST") {
        program_.add(document_, e);
        program_.word("\n");
      } else if (e.name == "NWL") {
        readDrawn(e, "NWLImplementationObject", name, writeNwl);
      } else if (e.name == "CFC") {
        readDrawn(e, "CFCImplementationObject", name, writeCfc);
      } else if (e.name == "SFC") {
        readDrawn(e, "SFCImplementationObject", name, writeSfc);
      } else if (const char* language = languageOf(e.name)) {
        diagnostics_.report(diag::NetworkBody, e.loc, {name, language});
      }
    }
  }

  void closeWith(std::string_view word) {
    program_.word(word);
    program_.word("\n");
  }

  // A cyclic task and the programs that it calls. <CycleTime> is in microseconds.
  void readTask(const xml::Element& task) {
    const xml::Attribute* name = document_.attribute(task, "Name");
    const xml::Element* cycle = document_.child(task, "CycleTime");
    if (name == nullptr || cycle == nullptr) return;
    const auto addName = [&] { program_.add(name->loc, {name->loc.offset + static_cast<uint32_t>(name->raw.size())}); };
    program_.word("CONFIGURATION ");
    addName();
    program_.word("_configuration\nRESOURCE ");
    addName();
    program_.word("_resource ON PLC\nTASK ");
    addName();
    program_.word("(INTERVAL := T#" + document_.text(*cycle, sources_) +
                  "us, PRIORITY := " + std::to_string(priorityOf(task)) + ");\n");
    for (const xml::Element& call : document_.children(task)) {
      const xml::Element* called = call.name == "PouCall" ? document_.child(call, "Name") : nullptr;
      if (called == nullptr) continue;
      if (const std::string path = document_.text(*called, sources_); path.find('.') != std::string::npos) {
        diagnostics_.report(diag::TaskCallsLibrary, called->loc, {path});
        continue;
      }
      program_.word("PROGRAM ");
      program_.add(document_, *called);
      program_.word(" WITH ");
      addName();
      program_.word(" : ");
      program_.add(document_, *called);
      program_.word(";\n");
    }
    program_.word("END_RESOURCE\nEND_CONFIGURATION\n");
  }

  uint64_t priorityOf(const xml::Element& task) const {
    const xml::Element* priority = document_.child(task, "Priority");
    if (priority == nullptr) return kLowestPriority;
    uint64_t value = 0;
    for (const char c : document_.text(*priority, sources_))
      if (c >= '0' && c <= '9' && value < kLowestPriority) value = value * 10 + static_cast<uint64_t>(c - '0');
    return value < kLowestPriority ? value : kLowestPriority;
  }

  const xml::Document& document_;
  const Sources& sources_;
  Archive archive_;
  Diagnostics& diagnostics_;
  xml::SourceMappedText program_;
  const xml::Element* chart_ = nullptr;  // the <SFC> of the current POU
};

}  // namespace

bool isTwinCat(std::string_view text) { return xml::rootName(xml::rootTag(text)) == "TcPlcObject"; }

FileId readProgram(ReadContext& context, FileId file) {
  xml::Document document;
  if (!xml::read(context.sources, file, context.diagnostics, document)) return {};
  return TwinCatReader(context.sources, document, context.diagnostics).run().finish(context.sources, file);
}

}  // namespace rung::importer::twincat

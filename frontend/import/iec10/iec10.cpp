// SPDX-License-Identifier: Apache-2.0
// Distinguishes files of IEC 61131-10 from other XML, and reads the project, its POUs and its configurations; see
// iec10.h.
#include "frontend/import/iec10/iec10.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "frontend/import/iec10/parts.h"
#include "frontend/source/names.h"
#include "frontend/source/text.h"

namespace rung::importer::iec10 {
namespace {

class Iec10Reader {
 public:
  explicit Iec10Reader(Reading& import) : import_(import), document_(import.document) {}

  void run();

 private:
  void writeNamespace(const Element& space);
  void writePou(const Element& pou, const std::string& owner);
  bool writeHeader(const Element& pou, std::string_view word);
  void writeConfiguration(const Element& configuration);
  void writeResource(const Element& resource);
  void writeTask(const Element& task);
  void writeInterval(const Element& task);
  const Element* plainText(const Element& pou) const;
  template <class Visit>
  void forEach(const Element& owner, std::string_view name, Visit visit) {
    for (const xml::Element& e : document_.children(owner))
      if (e.name == name) visit(e);
  }

  Reading& import_;
  const xml::Document& document_;
};

// The declaration as text: <TextDeclaration>, or <textDeclaration><content>.
const xml::Element* Iec10Reader::plainText(const Element& pou) const {
  const Element* data = document_.child(pou, "AddData");
  for (const xml::Element& one : document_.children(data))
    for (const xml::Element& e : document_.children(one)) {
      if (e.name != "TextDeclaration" && e.name != "textDeclaration") continue;
      const Element* content = document_.child(e, "content");
      return content == nullptr ? &e : content;
    }
  return nullptr;
}

// FUNCTION_BLOCK FINAL name EXTENDS a IMPLEMENTS b, c : INT and the sections. False: it has no name.
bool Iec10Reader::writeHeader(const Element& pou, std::string_view word) {
  if (const Element* plain = plainText(pou)) {
    writeLines(import_, *plain);
    return true;
  }
  if (!checkName(import_, pou)) return false;
  import_.out.put(pou.loc, std::string(word) + " ");
  if (word == "METHOD" && hasName(import_, pou, "accessSpecifier"))
    import_.out.word(upper(document_.value(pou, "accessSpecifier")) + " ");
  for (const std::string_view modifier : {"abstract", "final", "override"})
    if (isTrue(import_, pou, modifier)) import_.out.word(upper(modifier) + " ");
  writeName(import_, pou);
  for (const auto& list : {std::pair{"Extends", " EXTENDS "}, std::pair{"Implements", " IMPLEMENTS "}}) {
    Separator separator(import_.out, list.second);
    forEach(pou, list.first, [&](const Element& base) {
      separator.next();
      writeTypeRef(import_, base);
    });
  }
  if (const Element* result = document_.child(pou, "ResultType")) {
    import_.out.word(" : ");
    writeTypeRef(import_, *result);
  }
  import_.out.word("\n");
  writeVarLists(import_, pou);
  return true;
}

// declaration {METHOD … END_METHOD} body END_…
void Iec10Reader::writePou(const Element& pou, const std::string& owner) {
  const std::string word(pouWordOf(pou.name));
  if (!writeHeader(pou, word)) return;
  const std::string name = owner + document_.value(pou, "name");
  forEach(pou, "Method", [&](const Element& method) { writePou(method, name + "."); });
  for (const std::string_view body : {"MainBody", "Body"})
    if (const Element* found = document_.child(pou, body)) writeMainBody(import_, *found, name);
  import_.out.put(pou.end, "END_" + word + "\n");
}

// Programs are not allowed in a NAMESPACE: a namespace that contains one is treated as a folder.
void Iec10Reader::writeNamespace(const Element& space) {
  const bool named =
      space.name == "NamespaceDecl" && document_.child(space, "Program") == nullptr && hasName(import_, space);
  if (named) {
    writeNamed(import_, space, "NAMESPACE");
    import_.out.word("\n");
  }
  for (const xml::Element& e : document_.children(space)) {
    if (e.name == "GlobalNamespace" || e.name == "NamespaceDecl")
      writeNamespace(e);
    else if (e.name == "DataTypeDecl")
      writeTypeDecl(import_, e);
    else if (!pouWordOf(e.name).empty() && e.name != "Method")
      writePou(e, {});
  }
  if (named) import_.out.put(space.end, "END_NAMESPACE\n");
}

// T#10ms, or PT0.01S of ISO 8601.
void Iec10Reader::writeInterval(const Element& task) {
  const xml::Attribute* interval = document_.attribute(task, "interval");
  if (interval == nullptr || interval->raw.empty()) return;
  import_.out.word("INTERVAL := ");
  if (!interval->raw.starts_with("P")) {
    import_.out.add(document_, *interval);
    import_.out.word(", ");
    return;
  }
  std::string time = "T#";
  for (const char c : interval->raw.substr(1))
    if (c != 'T') time += foldedCharacter(c);
  import_.out.put(interval->loc, time + ", ");
}

void Iec10Reader::writeTask(const Element& task) {
  if (!writeNamed(import_, task, "TASK")) return;
  import_.out.word("(");
  writeInterval(task);
  if (hasName(import_, task, "single")) {
    import_.out.word("SINGLE := ");
    writeName(import_, task, "single");
    import_.out.word(", ");
  }
  import_.out.word("PRIORITY := ");
  if (hasName(import_, task, "priority"))
    writeName(import_, task, "priority");
  else
    import_.out.word("0");
  import_.out.word(");\n");
}

void Iec10Reader::writeResource(const Element& resource) {
  if (!writeNamed(import_, resource, "RESOURCE")) return;
  import_.out.word(" ON PLC\n");
  writeVarLists(import_, resource);
  forEach(resource, "Task", [&](const Element& task) { writeTask(task); });
  const auto writeInstance = [&](const Element& instance, const Element* task) {
    if (!checkName(import_, instance) || !checkName(import_, instance, "typeName")) return;
    writeNamed(import_, instance, "PROGRAM");
    if (task != nullptr || hasName(import_, instance, "associatedTaskName")) {
      import_.out.word(" WITH ");
      writeName(import_, task != nullptr ? *task : instance, task != nullptr ? "name" : "associatedTaskName");
    }
    import_.out.word(" : ");
    writeName(import_, instance, "typeName");
    import_.out.word(";\n");
  };
  forEach(resource, "Task", [&](const Element& task) {
    forEach(task, "ProgramInstance", [&](const Element& instance) { writeInstance(instance, &task); });
  });
  forEach(resource, "ProgramInstance", [&](const Element& instance) { writeInstance(instance, nullptr); });
  import_.out.put(resource.end, "END_RESOURCE\n");
}

// A configuration without program instances is read as a list of globals.
void Iec10Reader::writeConfiguration(const Element& configuration) {
  bool runs = false;
  forEach(configuration, "Resource", [&](const Element& resource) {
    runs = runs || document_.child(resource, "ProgramInstance") != nullptr;
    forEach(resource, "Task",
            [&](const Element& task) { runs = runs || document_.child(task, "ProgramInstance") != nullptr; });
  });
  if (!runs) {
    writeVarLists(import_, configuration);
    forEach(configuration, "Resource", [&](const Element& resource) { writeVarLists(import_, resource); });
    return;
  }
  if (!writeNamed(import_, configuration, "CONFIGURATION")) return;
  import_.out.word("\n");
  writeVarLists(import_, configuration);
  forEach(configuration, "Resource", [&](const Element& resource) { writeResource(resource); });
  import_.out.put(configuration.end, "END_CONFIGURATION\n");
}

void Iec10Reader::run() {
  const Element& root = document_.elements[0];
  if (!pouWordOf(root.name).empty()) return writePou(root, {});
  forEach(root, "Types", [&](const Element& types) { writeNamespace(types); });
  forEach(root, "Instances", [&](const Element& instances) {
    forEach(instances, "Configuration", [&](const Element& configuration) { writeConfiguration(configuration); });
  });
}

}  // namespace

bool isIec10(std::string_view text) {
  return xml::rootTag(text).find("www.iec.ch/public/TC65SC65BWG7TF10") != std::string_view::npos;
}

FileId readProgram(ReadContext& context, FileId file) {
  xml::Document document;
  if (!xml::read(context.sources, file, context.diagnostics, document)) return {};
  xml::SourceMappedText program(context.sources);
  Reading reading{context.sources, document, context.diagnostics, program};
  Iec10Reader(reading).run();
  return program.finish(context.sources, file);
}

}  // namespace rung::importer::iec10

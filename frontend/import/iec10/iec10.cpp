// Distinguishes files of IEC 61131-10 from other XML, and reads the project, its POUs and its configurations; see
// iec10.h.
#include "frontend/import/iec10/iec10.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "frontend/import/iec10/parts.h"
#include "frontend/source/names.h"

namespace rung::iec10 {
namespace {

struct PouKeywords {
  std::string_view element, begin, end;
};
constexpr PouKeywords kPous[] = {
    {"Program", "PROGRAM ", "END_PROGRAM"},       {"FunctionBlock", "FUNCTION_BLOCK ", "END_FUNCTION_BLOCK"},
    {"Function", "FUNCTION ", "END_FUNCTION"},    {"Class", "CLASS ", "END_CLASS"},
    {"Interface", "INTERFACE ", "END_INTERFACE"}, {"Method", "METHOD ", "END_METHOD"}};

const PouKeywords* keywordsOf(std::string_view element) {
  const auto* found = std::find_if(std::begin(kPous), std::end(kPous),
                                   [&](const PouKeywords& keywords) { return keywords.element == element; });
  return found == std::end(kPous) ? nullptr : found;
}

class ProjectReader {
 public:
  explicit ProjectReader(Import& import) : import_(import), document_(import.document) {}

  void run();

 private:
  using Element = xml::Element;

  void writeNamespace(const Element& space);
  void writePou(const Element& pou, const std::string& owner);
  bool writeHeader(const Element& pou, const PouKeywords& keywords);
  void writeConfiguration(const Element& configuration);
  void writeResource(const Element& resource);
  void writeTask(const Element& task);
  void writeInterval(const Element& task);
  const Element* plainText(const Element& pou) const;
  template <class Visit>
  void forEach(const Element& owner, std::string_view name, Visit visit) {
    for (const Element* e = document_.firstChild(owner); e != nullptr; e = document_.next(*e))
      if (e->name == name) visit(*e);
  }

  Import& import_;
  const xml::Document& document_;
};

// The declaration as text: <TextDeclaration>, or <textDeclaration><content>.
const xml::Element* ProjectReader::plainText(const Element& pou) const {
  const Element* data = document_.child(pou, "AddData");
  for (const Element* one = data == nullptr ? nullptr : document_.firstChild(*data); one != nullptr;
       one = document_.next(*one))
    for (const Element* e = document_.firstChild(*one); e != nullptr; e = document_.next(*e)) {
      if (e->name != "TextDeclaration" && e->name != "textDeclaration") continue;
      const Element* content = document_.child(*e, "content");
      return content == nullptr ? e : content;
    }
  return nullptr;
}

// FUNCTION_BLOCK FINAL name EXTENDS a IMPLEMENTS b, c : INT and the sections. False: it has no name.
bool ProjectReader::writeHeader(const Element& pou, const PouKeywords& keywords) {
  if (const Element* plain = plainText(pou)) {
    import_.out.put(plain->loc, "");
    plcopen::writeText(import_, *plain);
    import_.out.word("\n");
    return true;
  }
  if (!plcopen::checkName(import_, pou)) return false;
  import_.out.put(pou.loc, keywords.begin);
  if (keywords.element == "Method" && plcopen::hasName(import_, pou, "accessSpecifier"))
    import_.out.word(plcopen::upper(document_.value(pou, "accessSpecifier")) + " ");
  for (const std::string_view modifier : {"abstract", "final", "override"})
    if (plcopen::isTrue(import_, pou, modifier)) import_.out.word(plcopen::upper(modifier) + " ");
  plcopen::writeName(import_, pou);
  for (const auto& list : {std::pair{"Extends", " EXTENDS "}, std::pair{"Implements", " IMPLEMENTS "}}) {
    bool first = true;
    forEach(pou, list.first, [&](const Element& base) {
      import_.out.word(first ? list.second : ", ");
      first = false;
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
void ProjectReader::writePou(const Element& pou, const std::string& owner) {
  const PouKeywords& keywords = *keywordsOf(pou.name);
  if (!writeHeader(pou, keywords)) return;
  const std::string name = owner + document_.value(pou, "name");
  forEach(pou, "Method", [&](const Element& method) { writePou(method, name + "."); });
  for (const std::string_view body : {"MainBody", "Body"})
    if (const Element* found = document_.child(pou, body)) writeMainBody(import_, *found, name);
  import_.out.put(pou.end, keywords.end);
  import_.out.word("\n");
}

// Programs are not allowed in a NAMESPACE: a namespace that contains one is treated as a folder.
void ProjectReader::writeNamespace(const Element& space) {
  const bool named =
      space.name == "NamespaceDecl" && document_.child(space, "Program") == nullptr && plcopen::hasName(import_, space);
  if (named) {
    import_.out.put(space.loc, "NAMESPACE ");
    plcopen::writeName(import_, space);
    import_.out.word("\n");
  }
  for (const Element* e = document_.firstChild(space); e != nullptr; e = document_.next(*e)) {
    if (e->name == "GlobalNamespace" || e->name == "NamespaceDecl")
      writeNamespace(*e);
    else if (e->name == "DataTypeDecl")
      writeTypeDecl(import_, *e);
    else if (keywordsOf(e->name) != nullptr && e->name != "Method")
      writePou(*e, {});
  }
  if (named) import_.out.put(space.end, "END_NAMESPACE\n");
}

// T#10ms, or PT0.01S of ISO 8601.
void ProjectReader::writeInterval(const Element& task) {
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
    if (c != 'T') time += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  import_.out.put(interval->loc, time + ", ");
}

void ProjectReader::writeTask(const Element& task) {
  if (!plcopen::checkName(import_, task)) return;
  import_.out.put(task.loc, "TASK ");
  plcopen::writeName(import_, task);
  import_.out.word("(");
  writeInterval(task);
  if (plcopen::hasName(import_, task, "single")) {
    import_.out.word("SINGLE := ");
    plcopen::writeName(import_, task, "single");
    import_.out.word(", ");
  }
  import_.out.word("PRIORITY := ");
  if (plcopen::hasName(import_, task, "priority"))
    plcopen::writeName(import_, task, "priority");
  else
    import_.out.word("0");
  import_.out.word(");\n");
}

void ProjectReader::writeResource(const Element& resource) {
  if (!plcopen::checkName(import_, resource)) return;
  import_.out.put(resource.loc, "RESOURCE ");
  plcopen::writeName(import_, resource);
  import_.out.word(" ON PLC\n");
  writeVarLists(import_, resource);
  forEach(resource, "Task", [&](const Element& task) { writeTask(task); });
  const auto writeInstance = [&](const Element& instance, const Element* task) {
    if (!plcopen::checkName(import_, instance) || !plcopen::checkName(import_, instance, "typeName")) return;
    import_.out.put(instance.loc, "PROGRAM ");
    plcopen::writeName(import_, instance);
    if (task != nullptr || plcopen::hasName(import_, instance, "associatedTaskName")) {
      import_.out.word(" WITH ");
      plcopen::writeName(import_, task != nullptr ? *task : instance, task != nullptr ? "name" : "associatedTaskName");
    }
    import_.out.word(" : ");
    plcopen::writeName(import_, instance, "typeName");
    import_.out.word(";\n");
  };
  forEach(resource, "Task", [&](const Element& task) {
    forEach(task, "ProgramInstance", [&](const Element& instance) { writeInstance(instance, &task); });
  });
  forEach(resource, "ProgramInstance", [&](const Element& instance) { writeInstance(instance, nullptr); });
  import_.out.put(resource.end, "END_RESOURCE\n");
}

// A configuration without program instances is read as a list of globals.
void ProjectReader::writeConfiguration(const Element& configuration) {
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
  if (!plcopen::checkName(import_, configuration)) return;
  import_.out.put(configuration.loc, "CONFIGURATION ");
  plcopen::writeName(import_, configuration);
  import_.out.word("\n");
  writeVarLists(import_, configuration);
  forEach(configuration, "Resource", [&](const Element& resource) { writeResource(resource); });
  import_.out.put(configuration.end, "END_CONFIGURATION\n");
}

void ProjectReader::run() {
  const Element& root = document_.elements[0];
  if (keywordsOf(root.name) != nullptr) return writePou(root, {});
  forEach(root, "Types", [&](const Element& types) { writeNamespace(types); });
  forEach(root, "Instances", [&](const Element& instances) {
    forEach(instances, "Configuration", [&](const Element& configuration) { writeConfiguration(configuration); });
  });
}

}  // namespace

bool isIec10(std::string_view text) {
  return xml::rootTag(text).find("www.iec.ch/public/TC65SC65BWG7TF10") != std::string_view::npos;
}

FileId readProject(Sources& sources, FileId file, Diagnostics& diagnostics) {
  xml::Document document;
  if (!xml::read(sources, file, diagnostics, document)) return {};
  xml::SourceMappedText program(sources);
  Import import{sources, document, diagnostics, program};
  ProjectReader(import).run();
  return program.finish(sources, file);
}

}  // namespace rung::iec10

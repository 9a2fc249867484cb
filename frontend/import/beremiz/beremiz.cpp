#include "frontend/import/beremiz/beremiz.h"

#include "frontend/import/source_mapped_text.h"
#include "frontend/import/xml.h"

namespace rung::importer::beremiz {

bool isExtension(std::string_view text) {
  const std::string_view root = xml::rootName(xml::rootTag(text));
  return root == "PyFile" || root == "CFile";
}

// <variable name="speed" type="INT" initial="3"/> is `speed : INT := 3;`.
FileId readProgram(ReadContext& context, FileId file) {
  xml::Document document;
  if (!xml::read(context.sources, file, context.diagnostics, document)) return {};
  xml::SourceMappedText program(context.sources);
  if (document.elements.empty()) return program.finish(context.sources, file);
  program.put(document.elements[0].loc, "VAR_GLOBAL\n");
  for (const xml::Element& variable : document.children(document.child(document.elements[0], "variables"))) {
    const xml::Attribute* name = document.attribute(variable, "name");
    const xml::Attribute* type = document.attribute(variable, "type");
    if (variable.name != "variable" || name == nullptr || type == nullptr) continue;
    program.add(document, *name);
    program.word(" : ");
    program.add(document, *type);
    if (const xml::Attribute* initial = document.attribute(variable, "initial"); initial && !initial->raw.empty()) {
      program.word(" := ");
      program.add(document, *initial);
    }
    program.word(";\n");
  }
  program.word("END_VAR\n");
  return program.finish(context.sources, file);
}

}  // namespace rung::importer::beremiz

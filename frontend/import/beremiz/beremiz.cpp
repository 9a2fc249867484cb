// SPDX-License-Identifier: Apache-2.0
#include "frontend/import/beremiz/beremiz.h"

#include "frontend/import/source_mapped_text.h"
#include "frontend/import/xml.h"

namespace rung::importer::beremiz {
namespace {

// <variable name="speed" type="INT" initial="3"/> is `speed : INT := 3;`.
void addVariable(const xml::Document& document, const xml::Element& variable, xml::SourceMappedText& program) {
  const xml::Attribute* name = document.attribute(variable, "name");
  const xml::Attribute* type = document.attribute(variable, "type");
  if (variable.name != "variable" || name == nullptr || type == nullptr) return;
  program.add(document, *name);
  program.word(" : ");
  program.add(document, *type);
  if (const xml::Attribute* initial = document.attribute(variable, "initial"); initial && !initial->raw.empty()) {
    program.word(" := ");
    program.add(document, *initial);
  }
  program.word(";\n");
}

// A variable that Beremiz adds for each extension of this type; its name ends with the IEC_Channel.
struct Added {
  std::string_view type, name, of_type;
};
constexpr Added kAdded[] = {
    {"mqtt", "MQTT_STATUS_", "INT"},
    {"svghmi", "CURRENT_PAGE_", "HMI_STRING"},
};

// The type of an extension is the end of its folder's name: `hmi@svghmi/baseconfnode.xml`.
void addOwnVariables(const xml::Document& document, std::string_view path, xml::SourceMappedText& program) {
  const xml::Attribute* channel = document.attribute(document.elements[0], "IEC_Channel");
  const size_t slash = path.rfind('/'), at = path.rfind('@', slash);
  if (channel == nullptr || slash == std::string_view::npos || at == std::string_view::npos) return;
  for (const Added& row : kAdded) {
    if (path.substr(at + 1, slash - at - 1) != row.type) continue;
    program.word(row.name);
    program.add(document, *channel);
    program.word(" : ");
    program.word(row.of_type);
    program.word(";\n");
  }
}

}  // namespace

bool isProject(std::string_view text) { return xml::rootName(xml::rootTag(text)) == "BeremizRoot"; }

bool isExtension(std::string_view text) {
  const std::string_view root = xml::rootName(xml::rootTag(text));
  return root == "PyFile" || root == "CFile" || root == "BaseParams";
}

FileId readProgram(ReadContext& context, FileId file) {
  xml::Document document;
  if (!xml::read(context.sources, file, context.diagnostics, document)) return {};
  xml::SourceMappedText program(context.sources);
  if (document.elements.empty()) return program.finish(context.sources, file);
  const xml::Element& root = document.elements[0];
  program.put(root.loc, "VAR_GLOBAL\n");
  if (root.name == "BaseParams")
    addOwnVariables(document, context.sources.path(file), program);
  else
    for (const xml::Element& variable : document.children(document.child(root, "variables")))
      addVariable(document, variable, program);
  program.word("END_VAR\n");
  return program.finish(context.sources, file);
}

}  // namespace rung::importer::beremiz

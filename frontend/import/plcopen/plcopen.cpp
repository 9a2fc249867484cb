// SPDX-License-Identifier: Apache-2.0
// Distinguishes TC6 files from other XML, and reads the project as a whole; see plcopen.h.
#include "frontend/import/plcopen/plcopen.h"

#include <algorithm>
#include <unordered_map>

#include "frontend/import/diagnostics.h"
#include "frontend/import/plcopen/import.h"
#include "frontend/source/names.h"

namespace rung::importer::plcopen {
namespace {

// The parts of a project besides configurations.
enum class Content : uint8_t { None, DataType, Pou, Interface, Globals };

class PlcopenReader {
 public:
  PlcopenReader(Import& import, std::vector<Library>& libraries) : import_(import), libraries_(libraries) {}

  void run();

 private:
  Content contentOf(const xml::Element& element) const;
  const xml::Element* parentOf(const xml::Element& element) const {
    return element.parent == xml::kNone ? nullptr : &import_.document.elements[element.parent];
  }
  const xml::Element* resourceOf(const xml::Element& element) const;
  void findBeremizNames();
  void findDataTypes();
  void findInitialisers();
  void excludeApplications();
  void addLibraries(const xml::Element& libraries);
  void noteExtensions();
  bool isApplication(const xml::Element& resource) const;
  bool holdsProgram(const xml::Element& configuration) const;

  Import& import_;
  std::vector<Library>& libraries_;
};

Content PlcopenReader::contentOf(const xml::Element& element) const {
  const xml::Element* parent = parentOf(element);
  if (element.name == "pou") {
    const bool is_pou = import_.document.attribute(element, "pouType") != nullptr ||
                        import_.document.child(element, "interface") != nullptr ||
                        import_.document.child(element, "body") != nullptr;
    return is_pou ? Content::Pou : Content::None;
  }
  if (element.name == "dataType")
    return import_.document.child(element, "baseType") != nullptr || plainText(import_, element) != nullptr
               ? Content::DataType
               : Content::None;
  if (element.name == "Interface")
    return parent != nullptr && parent->name == "data" ? Content::Interface : Content::None;
  if (element.name != "globalVars" || parent == nullptr) return Content::None;
  if (parent->name == "interface" || parent->name == "MixedAttrsVarList") return Content::None;
  const bool in_configuration = parent->name == "resource" || parent->name == "configuration";
  return in_configuration && !hasName(import_, element) ? Content::None : Content::Globals;
}

const xml::Element* PlcopenReader::resourceOf(const xml::Element& element) const {
  const xml::Element* e = parentOf(element);
  while (e != nullptr && e->name != "resource") e = parentOf(*e);
  return e;
}

// Beremiz and OpenPLC write TC6 1.01 and 2.01, CODESYS and TwinCAT 2.0.
void PlcopenReader::findBeremizNames() {
  static constexpr std::string_view kNames[] = {"DERIVATIVE", "HYSTERESIS", "INTEGRAL", "LOGGER",
                                                "LOGLEVEL",   "PID",        "RAMP"};
  if (!import_.unquoted_strings) return;
  std::vector<std::string_view>& names = import_.beremiz_names;
  names.assign(std::begin(kNames), std::end(kNames));
  for (const xml::Element& e : import_.document.elements) {
    import_.is_rung = e.name == "fileHeader" && import_.document.value(e, "productName") == "Rung";
    if (import_.is_rung) return names.clear();
    if (e.name == "pou" || e.name == "dataType") std::erase(names, upper(import_.document.value(e, "name")));
  }
}

void PlcopenReader::findDataTypes() {
  for (const xml::Element& e : import_.document.elements)
    if (e.name == "dataType") import_.data_types.emplace(upper(import_.document.value(e, "name")), &e);
}

void PlcopenReader::findInitialisers() {
  for (const xml::Element& pou : import_.document.elements) {
    if (pou.name != "pou") continue;
    forEachData(import_, pou, "method", [&](const xml::Element& data) {
      const xml::Element* method = import_.document.firstChild(data);
      if (method != nullptr && sameIdentifier(import_.document.value(*method, "name"), "FB_Init"))
        import_.initialisers.emplace_back(upper(import_.document.value(pou, "name")), method);
    });
  }
  std::sort(import_.initialisers.begin(), import_.initialisers.end());
}

// A project of CODESYS may contain applications for several devices, each with its PLC_PRG: the first one is read, and
// later ones that repeat one of its names are excluded.
void PlcopenReader::excludeApplications() {
  std::unordered_map<std::string, const xml::Element*> resource_of_name;
  for (const xml::Element& element : import_.document.elements) {
    const Content content = contentOf(element);
    if (content == Content::None) continue;
    const xml::Element* resource = resourceOf(element);
    if (resource == nullptr || import_.isLeftOut(*resource)) continue;
    const std::string name = upper(import_.document.value(element, "name"));
    const auto [known, fresh] = resource_of_name.emplace(name, resource);
    if (fresh || known->second == resource) continue;
    import_.left_out.insert(resource);
    const xml::Attribute* called = import_.document.attribute(*resource, "name");
    import_.diagnostics
        .report(diag::XmlSecondApplication, called == nullptr ? resource->loc : called->loc,
                {import_.document.value(*resource, "name"), import_.document.value(*known->second, "name"),
                 import_.document.value(element, "name")})
        .length(called == nullptr ? 0 : static_cast<uint32_t>(called->raw.size()));
  }
}

// <data name="http://www.3s-software.com/plcopenxml/application"><resource>
bool PlcopenReader::isApplication(const xml::Element& resource) const {
  const xml::Element* const parent = parentOf(resource);
  return parent != nullptr && parent->name == "data" && kindOfData(import_, *parent) == "application";
}

bool PlcopenReader::holdsProgram(const xml::Element& configuration) const {
  for (const xml::Element& e : import_.document.children(configuration))
    if ((e.name == "resource" && !import_.isLeftOut(e)) || e.name == "globalVars" || e.name == "accessVars" ||
        e.name == "configVars")
      return true;
  return false;
}

// <Library Name="#Standard" …/>, <Library Name="Util, 3.5.17.0 (System)" …/>. Libraries that a system library depends
// on are ignored.
void PlcopenReader::addLibraries(const xml::Element& libraries) {
  for (const xml::Element& e : import_.document.children(libraries)) {
    const xml::Attribute* name = e.name == "Library" ? import_.document.attribute(e, "Name") : nullptr;
    if (name == nullptr || isTrue(import_, e, "SystemLibrary")) continue;
    std::string title = import_.document.decoded(*name);
    title = title.substr(0, title.find(','));
    Loc loc = name->loc;
    if (title.starts_with("#")) {
      title.erase(0, 1);
      ++loc.offset;
    }
    while (!title.empty() && title.back() == ' ') title.pop_back();
    const bool seen = std::any_of(libraries_.begin(), libraries_.end(),
                                  [&](const Library& library) { return sameIdentifier(library.name, title); });
    if (!title.empty() && !seen) {
      const xml::Attribute* space = import_.document.attribute(e, "Namespace");
      libraries_.push_back({std::move(title), space == nullptr ? "" : import_.document.decoded(*space), loc});
    }
  }
}

// Reports each kind of extension that is not read, once; except those that the file allows to discard.
void PlcopenReader::noteExtensions() {
  static constexpr std::string_view kKnown[] = {"method",
                                                "property",
                                                "interfaceasplaintext",
                                                "plcopenxml",
                                                "attributes",
                                                "inputassignments",
                                                "pouinheritance",
                                                "datatypeinheritance",
                                                "accessmodifiers",
                                                "interface",
                                                "globalvars",
                                                "mixedattrsvarlist",
                                                "pou",
                                                "datatype",
                                                "tasksettings",
                                                "libraries",
                                                "cfc",
                                                "sfcsettings",
                                                "element",
                                                "objectid",
                                                "projectstructure",
                                                "projectinformation",
                                                "buildproperties",
                                                "application",
                                                "Device",
                                                "enumvaluedocumentation",
                                                "cfccalltype",
                                                "fbdcalltype",
                                                "cfcelementtype",
                                                "fbdelementtype",
                                                "stcode",
                                                "ldbranchid",
                                                "inputparamtypes",
                                                "outputparamtypes",
                                                "implementationattributes",
                                                "configurations",
                                                "ExplicitConnector",
                                                "negated"};
  std::vector<std::string_view> noted;
  for (const xml::Element& element : import_.document.elements) {
    const xml::Element* parent = element.name == "data" ? parentOf(element) : nullptr;
    const xml::Attribute* name =
        parent == nullptr || parent->name != "addData" ? nullptr : import_.document.attribute(element, "name");
    if (name == nullptr || import_.document.value(element, "handleUnknown") == "discard") continue;
    const std::string_view kind = kindOfData(import_, element);
    if (std::find(std::begin(kKnown), std::end(kKnown), kind) != std::end(kKnown)) continue;
    if (std::find(noted.begin(), noted.end(), name->raw) != noted.end() || noted.size() == 100) continue;
    noted.push_back(name->raw);
    import_.diagnostics.report(diag::XmlExtension, name->loc, {import_.document.decoded(*name)})
        .length(static_cast<uint32_t>(name->raw.size()));
  }
}

void PlcopenReader::run() {
  const xml::Attribute* space = import_.document.attribute(import_.document.elements[0], "xmlns");
  import_.unquoted_strings = space == nullptr || !space->raw.ends_with("0200");
  findBeremizNames();
  findDataTypes();
  findInitialisers();
  excludeApplications();
  forEachData(import_, import_.document.elements[0], "extension", [&](const xml::Element& data) {
    const xml::Element* text = import_.document.child(data, "text");  // namespaces, exported by Rung
    if (text == nullptr) return;
    writeLines(import_, *text);
  });
  for (const xml::Element& element : import_.document.elements) {
    const Content content = contentOf(element);
    if (element.name == "Libraries") addLibraries(element);
    if (content == Content::None) continue;
    if (!import_.left_out.empty()) {
      const xml::Element* resource = resourceOf(element);
      if (resource != nullptr && import_.isLeftOut(*resource)) continue;
    }
    switch (content) {
      case Content::None: break;
      case Content::DataType: writeDataType(import_, element); break;
      case Content::Pou: writePou(import_, element); break;
      case Content::Interface: writeInterface(import_, element); break;
      case Content::Globals: writeGlobals(import_, element); break;
    }
  }
  for (const xml::Element& element : import_.document.elements)
    if (element.name == "configuration" && holdsProgram(element)) writeConfiguration(import_, element);
  std::vector<const xml::Element*> applications;
  for (const xml::Element& element : import_.document.elements)
    if (element.name == "resource" && !import_.isLeftOut(element) && isApplication(element))
      applications.push_back(&element);
  if (!applications.empty()) writeApplications(import_, applications);
  noteExtensions();
}

}  // namespace

const char* Import::libraryOf(std::string_view type) const {
  for (const std::string_view block : beremiz_names)
    if (sameIdentifier(block, type)) return "Beremiz.";
  return "";
}

bool isPlcopen(std::string_view text) {
  const std::string_view tag = xml::rootTag(text), root = xml::rootName(tag);
  return (root == "project" || root == "pou") && tag.find("www.plcopen.org/xml/tc6") != std::string_view::npos;
}

FileId readProgram(ReadContext& context, FileId file) {
  xml::Document document;
  if (!xml::read(context.sources, file, context.diagnostics, document)) return {};
  xml::SourceMappedText program(context.sources);
  Import import{{context.sources, document, context.diagnostics, program}};
  PlcopenReader(import, context.libraries).run();
  return program.finish(context.sources, file);
}

}  // namespace rung::importer::plcopen

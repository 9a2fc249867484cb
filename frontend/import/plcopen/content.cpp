// Names, values and content of the XML as parts of ST; see import.h.
#include <algorithm>

#include "frontend/import/diagnostics.h"
#include "frontend/import/plcopen/import.h"
#include "frontend/source/names.h"

namespace rung::plcopen {

std::string_view kindOfData(const Import& import, const xml::Element& data) {
  const xml::Attribute* name = import.document.attribute(data, "name");
  if (name == nullptr) return {};
  const size_t slash = name->raw.rfind('/');
  return slash == std::string_view::npos ? name->raw : name->raw.substr(slash + 1);
}

const xml::Element* dataOf(const Import& import, const xml::Element& owner, std::string_view kind) {
  const xml::Element* found = nullptr;
  forEachData(import, owner, kind, [&](const xml::Element& data) {
    if (found == nullptr) found = import.document.firstChild(data);
  });
  return found;
}

const xml::Element* ownTextOf(const Import& import, const xml::Element& owner) {
  const xml::Element* own = dataOf(import, owner, "extension");
  return own != nullptr && own->name == "text" ? own : nullptr;
}

bool isTrue(const Import& import, const xml::Element& element, std::string_view attribute) {
  const xml::Attribute* found = import.document.attribute(element, attribute);
  return found != nullptr && (sameIdentifier(found->raw, "true") || found->raw == "1");
}

namespace {

bool isBlankChar(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

bool isBlank(std::string_view text) {
  for (const char c : text)
    if (!isBlankChar(c)) return false;
  return true;
}

std::string textOf(const Import& import, const xml::Element& element) {
  std::string text = import.document.text(element, import.sources);
  while (!text.empty() && isBlankChar(text.back())) text.pop_back();
  size_t begin = 0;
  while (begin < text.size() && isBlankChar(text[begin])) ++begin;
  return text.substr(begin);
}

void writeText(Import& import, const xml::Element& element) {
  uint32_t run = element.first_run;
  for (const xml::Element* e = import.document.firstChild(element); e != nullptr; e = import.document.next(*e)) {
    import.out.addRuns(import.document, run, e->first_run);
    if (e->first_child == xml::kNone)
      import.out.addRuns(import.document, e->first_run, e->end_run);
    else
      writeText(import, *e);
    const bool is_paragraph = e->name == "p" || e->name == "br" || e->name == "div" || e->name == "li";
    if (is_paragraph) import.out.word("\n");
    run = e->end_run;
  }
  import.out.addRuns(import.document, run, element.end_run);
}

bool hasName(const Import& import, const xml::Element& element, std::string_view attribute) {
  const xml::Attribute* found = import.document.attribute(element, attribute);
  return found != nullptr && !isBlank(found->raw);
}

bool checkName(Import& import, const xml::Element& element, std::string_view attribute) {
  if (hasName(import, element, attribute)) return true;
  import.diagnostics.report(diag::XmlNoName, element.loc, {element.name, attribute});
  return false;
}

bool writeName(Import& import, const xml::Element& element, std::string_view attribute) {
  if (!checkName(import, element, attribute)) return false;
  import.out.add(import.document, *import.document.attribute(element, attribute));
  return true;
}

void writeDocumentation(Import& import, const xml::Element& element) {
  const xml::Element* documentation = import.document.child(element, "documentation");
  if (documentation == nullptr) return;
  const std::string text = textOf(import, *documentation);
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    for (char& c : line)
      if (c == '\r' || c == '\t') c = ' ';
    import.out.put(documentation->loc, "/// " + line + "\n");
    begin = end + 1;
  }
}

void writeAttributes(Import& import, const xml::Element& element) {
  const xml::Element* attributes = dataOf(import, element, "attributes");
  if (attributes == nullptr) return;
  for (const xml::Element* e = import.document.firstChild(*attributes); e != nullptr; e = import.document.next(*e)) {
    std::string pragma = "{attribute '" + import.document.value(*e, "Name") + "'";
    if (const std::string value = import.document.value(*e, "Value"); !value.empty()) pragma += " := '" + value + "'";
    pragma += "}\n";
    // Drops attributes with characters that would end the pragma too early or hide it.
    if (pragma.find('\n') + 1 == pragma.size() && pragma.find('}') + 2 == pragma.size()) import.out.put(e->loc, pragma);
  }
}

std::string upper(std::string_view name) {
  std::string out(name);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

const char* Import::libraryOf(std::string_view type) const {
  for (const std::string_view block : beremiz_names)
    if (sameIdentifier(block, type)) return "Beremiz.";
  return "";
}

std::string identifierOf(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool ok = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (ok)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty() || (out[0] >= '0' && out[0] <= '9')) out = "n" + out;
  return out;
}

bool isIdentifier(std::string_view text) { return !isBlank(text) && identifierOf(text) == text; }

}  // namespace rung::plcopen

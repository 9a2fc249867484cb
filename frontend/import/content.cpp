// SPDX-License-Identifier: Apache-2.0
#include "frontend/import/content.h"

#include <algorithm>
#include <span>

#include "frontend/import/diagnostics.h"
#include "frontend/source/names.h"

namespace rung::importer {

std::string_view kindOfData(const Reading& reading, const xml::Element& data) {
  const xml::Attribute* name = reading.document.attribute(data, "name");
  if (name == nullptr) return {};
  const size_t slash = name->raw.rfind('/');
  return slash == std::string_view::npos ? name->raw : name->raw.substr(slash + 1);
}

const xml::Element* dataOf(const Reading& reading, const xml::Element& owner, std::string_view kind) {
  const xml::Element* found = nullptr;
  forEachData(reading, owner, kind, [&](const xml::Element& data) {
    if (found == nullptr) found = reading.document.firstChild(data);
  });
  return found;
}

const xml::Element* ownTextOf(const Reading& reading, const xml::Element& owner) {
  const xml::Element* own = dataOf(reading, owner, "extension");
  return own != nullptr && own->name == "text" ? own : nullptr;
}

bool isTrue(const Reading& reading, const xml::Element& element, std::string_view attribute) {
  const xml::Attribute* found = reading.document.attribute(element, attribute);
  return found != nullptr && (sameIdentifier(found->raw, "true") || found->raw == "1");
}

bool isBlank(std::string_view text) {
  for (const char c : text)
    if (!isBlankCharacter(c)) return false;
  return true;
}

std::string trimmed(std::string_view text) {
  while (!text.empty() && isBlankCharacter(text.back())) text.remove_suffix(1);
  while (!text.empty() && isBlankCharacter(text.front())) text.remove_prefix(1);
  return std::string(text);
}

std::string textOf(const Reading& reading, const xml::Element& element) {
  return trimmed(reading.document.text(element, reading.sources));
}

void writeText(Reading& reading, const xml::Element& element) {
  uint32_t run = element.first_run;
  for (const xml::Element& e : reading.document.children(element)) {
    reading.out.addRuns(reading.document, run, e.first_run);
    if (e.first_child == xml::kNone)
      reading.out.addRuns(reading.document, e.first_run, e.end_run);
    else
      writeText(reading, e);
    const bool is_paragraph = e.name == "p" || e.name == "br" || e.name == "div" || e.name == "li";
    if (is_paragraph) reading.out.word("\n");
    run = e.end_run;
  }
  reading.out.addRuns(reading.document, run, element.end_run);
}

void writeLines(Reading& reading, const xml::Element& element) {
  reading.out.put(element.loc, "");
  writeText(reading, element);
  reading.out.word("\n");
}

bool hasName(const Reading& reading, const xml::Element& element, std::string_view attribute) {
  const xml::Attribute* found = reading.document.attribute(element, attribute);
  return found != nullptr && !isBlank(found->raw);
}

bool checkName(Reading& reading, const xml::Element& element, std::string_view attribute) {
  if (hasName(reading, element, attribute)) return true;
  reading.diagnostics.report(diag::XmlNoName, element.loc, {element.name, attribute});
  return false;
}

bool writeName(Reading& reading, const xml::Element& element, std::string_view attribute) {
  if (!checkName(reading, element, attribute)) return false;
  reading.out.add(reading.document, *reading.document.attribute(element, attribute));
  return true;
}

void writeDocumentation(Reading& reading, const xml::Element& element) {
  const xml::Element* documentation = reading.document.child(element, "documentation");
  if (documentation == nullptr) return;
  const std::string text = textOf(reading, *documentation);
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    for (char& c : line)
      if (c == '\r' || c == '\t') c = ' ';
    reading.out.put(documentation->loc, "/// " + line + "\n");
    begin = end + 1;
  }
}

void writeAttributes(Reading& reading, const xml::Element& element) {
  const xml::Element* attributes = dataOf(reading, element, "attributes");
  if (attributes == nullptr) return;
  for (const xml::Element& e : reading.document.children(*attributes)) {
    const std::string name = reading.document.value(e, "Name");
    if (name == "case") {  // exported by Rung: a case of a test is not an attribute with a string
      reading.out.put(e.loc, "{case " + reading.document.value(e, "Value") + "}\n");
      continue;
    }
    std::string pragma = "{attribute '" + name + "'";
    if (const std::string value = reading.document.value(e, "Value"); !value.empty()) pragma += " := '" + value + "'";
    pragma += "}\n";
    // Drops attributes with characters that would end the pragma too early or hide it.
    if (pragma.find('\n') + 1 == pragma.size() && pragma.find('}') + 2 == pragma.size()) reading.out.put(e.loc, pragma);
  }
}

std::string identifierOf(std::string_view name) {
  std::string out;
  for (const char c : name) {
    if (isNameCharacter(c))
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty() || (out[0] >= '0' && out[0] <= '9')) out = "n" + out;
  return out;
}

namespace {

struct Words {
  std::string_view name, word;
};

std::string_view wordIn(std::span<const Words> rows, std::string_view name) {
  for (const Words& row : rows)
    if (sameIdentifier(name, row.name)) return row.word;
  return {};
}

}  // namespace

std::string_view pouWordOf(std::string_view name) {
  static constexpr Words kPous[] = {{"function", "FUNCTION"}, {"functionBlock", "FUNCTION_BLOCK"},
                                    {"program", "PROGRAM"},   {"class", "CLASS"},
                                    {"method", "METHOD"},     {"interface", "INTERFACE"}};
  return wordIn(kPous, name);
}

std::string_view sectionWordOf(std::string_view list) {
  static constexpr Words kSections[] = {{"inputVars", "VAR_INPUT"},
                                        {"outputVars", "VAR_OUTPUT"},
                                        {"inOutVars", "VAR_IN_OUT"},
                                        {"localVars", "VAR"},
                                        {"vars", "VAR"},
                                        {"tempVars", "VAR_TEMP"},
                                        {"externalVars", "VAR_EXTERNAL"},
                                        {"globalVars", "VAR_GLOBAL"},
                                        {"staticVars", "VAR_STAT"},
                                        {"instanceVars", "VAR_INST"}};
  return wordIn(kSections, list);
}

void writeSectionBegin(Reading& reading, const xml::Element& list, std::string_view word) {
  reading.out.put(list.loc, word);
  for (const auto& [attribute, text] :
       {Words{"constant", " CONSTANT"}, Words{"retain", " RETAIN"}, Words{"nonretain", " NON_RETAIN"},
        Words{"nonRetain", " NON_RETAIN"}, Words{"persistent", " PERSISTENT"}})
    if (isTrue(reading, list, attribute)) reading.out.word(text);
  reading.out.word("\n");
}

const xml::Element* valueIn(const Reading& reading, const xml::Element& holder) {
  for (const xml::Element& e : reading.document.children(holder))
    for (const std::string_view name : {"simpleValue", "arrayValue", "structValue"})
      if (sameIdentifier(e.name, name)) return &e;
  return nullptr;
}

void writeRange(Reading& reading, const xml::Element& range) {
  writeName(reading, range, "lower");
  reading.out.word("..");
  writeName(reading, range, "upper");
}

void writeEnumerator(Reading& reading, const Element& enumerator) {
  writeName(reading, enumerator);
  if (!hasName(reading, enumerator, "value")) return;
  reading.out.word(" := ");
  writeName(reading, enumerator, "value");
}

void writeAggregate(Reading& reading, const Element& list, FunctionRef<void(const Element& value)> write) {
  const bool is_array = sameIdentifier(list.name, "arrayValue");
  reading.out.put(list.loc, is_array ? "[" : "(");
  Separator separator(reading.out);
  for (const Element& e : reading.document.children(list)) {
    const Element* value = sameIdentifier(e.name, "value") ? valueIn(reading, e) : nullptr;
    if (value == nullptr) continue;
    separator.next();
    const bool repeated =
        is_array && hasName(reading, e, "repetitionValue") && reading.document.value(e, "repetitionValue") != "1";
    if (repeated || !is_array) {
      writeName(reading, e, is_array ? "repetitionValue" : "member");
      reading.out.word(is_array ? "(" : " := ");
    }
    write(*value);
    if (repeated) reading.out.word(")");
  }
  reading.out.word(is_array ? "]" : ")");
}

bool writeNamed(Reading& reading, const Element& element, std::string_view word) {
  if (!checkName(reading, element)) return false;
  reading.out.put(element.loc, std::string(word) + " ");
  return writeName(reading, element);
}

}  // namespace rung::importer

// SPDX-License-Identifier: Apache-2.0
// Types, data types and initial values of the XML as ST; see import.h.
#include <algorithm>

#include "frontend/import/diagnostics.h"
#include "frontend/import/plcopen/import.h"
#include "frontend/source/names.h"

namespace rung::importer::plcopen {
namespace {

// ARRAY [1..2, 0..9] OF …
void writeArray(Import& import, const xml::Element& array, uint32_t depth) {
  import.out.put(array.loc, "ARRAY [");
  writeList(import, &array, "dimension", [&](const Element& e) { writeRange(import, e); });
  import.out.word("] OF ");
  writeType(import, array, depth);
}

// (red, green := 4) BYTE
void writeEnum(Import& import, const xml::Element& type, uint32_t depth) {
  import.out.put(type.loc, "(");
  writeList(import, import.document.child(type, "values"), "value",
            [&](const Element& e) { writeEnumerator(import, e); });
  import.out.word(")");
  if (import.document.child(type, "baseType") == nullptr) return;
  import.out.word(" ");
  writeType(import, type, depth);
}

// INT (0..9)
void writeSubrange(Import& import, const xml::Element& type, uint32_t depth) {
  writeType(import, type, depth);
  const xml::Element* range = import.document.child(type, "range");
  if (range == nullptr) return;
  import.out.word(" (");
  writeRange(import, *range);
  import.out.word(")");
}

void writeString(Import& import, const xml::Element& type) {
  import.out.put(type.loc, sameIdentifier(type.name, "string") ? "STRING" : "WSTRING");
  if (!hasName(import, type, "length")) return;
  import.out.word("[");
  writeName(import, type, "length");
  import.out.word("]");
}

const xml::Element* typeIn(const Import& import, const xml::Element& holder) {
  const bool is_type = holder.name == "type" || holder.name == "baseType" || holder.name == "returnType";
  const xml::Element* inner = is_type ? &holder : import.document.child(holder, "baseType");
  if (inner == nullptr) inner = import.document.child(holder, "type");
  for (const xml::Element& e : import.document.children(inner))
    if (e.name != "addData" && e.name != "documentation") return &e;
  return nullptr;
}

// "STRING" or "WSTRING" for the elements of these types, for a type of the file that is another name of one, and for
// the HMI_STRING that Beremiz knows; otherwise empty.
std::string_view stringKind(const Import& import, const xml::Element* type) {
  for (uint32_t depth = 0; type != nullptr && depth < kMaxNesting; ++depth) {
    if (sameIdentifier(type->name, "string")) return "STRING";
    if (sameIdentifier(type->name, "wstring")) return "WSTRING";
    if (type->name != "derived") return {};
    const std::string name = import.document.value(*type, "name");
    if (sameIdentifier(name, "HMI_STRING")) return "STRING";
    const auto found = import.data_types.find(upper(name));
    const xml::Element* base =
        found == import.data_types.end() ? nullptr : import.document.child(*found->second, "baseType");
    type = base == nullptr ? nullptr : typeIn(import, *base);
  }
  return {};
}

void writeValue(Import& import, const xml::Element& value, const xml::Element* type, uint32_t depth) {
  if (depth == kMaxNesting) {
    import.diagnostics.report(diag::XmlTooLarge, value.loc, {std::to_string(kMaxNesting), "nested values"});
    return;
  }
  if (value.name != "simpleValue")
    return writeAggregate(import, value, [&](const Element& inner) { writeValue(import, inner, nullptr, depth + 1); });
  const xml::Attribute* text = import.document.attribute(value, "value");
  const std::string_view kind = import.unquoted_strings ? stringKind(import, type) : std::string_view();
  const std::string_view quote = kind == "WSTRING" ? "\"" : "'";
  const bool bare =
      !kind.empty() && (text == nullptr || import.document.decoded(*text).find(quote) == std::string::npos);
  if (bare) import.out.put(value.loc, quote);
  if (text != nullptr) import.out.add(import.document, *text);
  if (bare) import.out.word(quote);
}

}  // namespace

void writeType(Import& import, const xml::Element& holder, uint32_t depth) {
  const xml::Element* type = typeIn(import, holder);
  if (type == nullptr) {
    import.diagnostics.report(diag::XmlNoType, holder.loc, {holder.name});
    import.out.word("INT");
    return;
  }
  if (depth == kMaxNesting) {
    import.diagnostics.report(diag::XmlTooLarge, type->loc, {std::to_string(kMaxNesting), "nested types"});
    import.out.word("INT");
    return;
  }
  ++depth;
  if (type->name == "array") return writeArray(import, *type, depth);
  if (type->name == "enum") return writeEnum(import, *type, depth);
  if (type->name == "subrangeSigned" || type->name == "subrangeUnsigned") return writeSubrange(import, *type, depth);
  if (sameIdentifier(type->name, "string") || sameIdentifier(type->name, "wstring")) return writeString(import, *type);
  if (type->name == "derived") {
    import.out.word(import.libraryOf(import.document.value(*type, "name")));
    if (!writeName(import, *type)) import.out.word("INT");
  } else if (type->name == "struct" || type->name == "union") {
    import.out.put(type->loc, type->name == "struct" ? "STRUCT\n" : "UNION\n");
    writeVariables(import, *type, depth);
    import.out.word(type->name == "struct" ? "END_STRUCT" : "END_UNION");
  } else if (type->name == "pointer" || type->name == "reference") {
    import.out.put(type->loc, type->name == "pointer" ? "POINTER TO " : "REFERENCE TO ");
    writeType(import, *type, depth);
  } else {
    import.out.replace(type->loc, {type->loc.offset + static_cast<uint32_t>(type->name.size())}, type->name);
  }
}

void writeInitialValue(Import& import, const xml::Element& declared, const xml::Element* type) {
  const xml::Element* holder = import.document.child(declared, "initialValue");
  const xml::Element* value = holder == nullptr ? nullptr : valueIn(import, *holder);
  if (value == nullptr) return;
  const xml::Element* of = type == nullptr ? nullptr : typeIn(import, *type);
  const bool may_be_empty = import.unquoted_strings && !stringKind(import, of).empty();
  if (value->name == "simpleValue" && !may_be_empty && !hasName(import, *value, "value")) return;
  import.out.word(" := ");
  writeValue(import, *value, of, 0);
}

// TYPE name [EXTENDS base] : type [:= value]; END_TYPE
void writeDataType(Import& import, const xml::Element& data_type) {
  import.out.put(data_type.loc, "");
  if (const xml::Element* plain = plainText(import, data_type)) {
    writeText(import, *plain);
    import.out.word("\n");
    return;
  }
  if (!checkName(import, data_type)) return;
  writeDocumentation(import, data_type);
  writeAttributes(import, data_type);
  import.out.put(data_type.loc, "TYPE ");
  writeName(import, data_type);
  if (const xml::Element* inheritance = dataOf(import, data_type, "datatypeinheritance")) {
    if (const xml::Element* base = import.document.child(*inheritance, "Extends")) {
      import.out.word(" EXTENDS ");
      writeText(import, *base);
    }
  }
  import.out.word(" : ");
  writeType(import, data_type);
  writeInitialValue(import, data_type, import.document.child(data_type, "baseType"));
  import.out.word(";\nEND_TYPE\n");
}

}  // namespace rung::importer::plcopen

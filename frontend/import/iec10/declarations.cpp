// SPDX-License-Identifier: Apache-2.0
// Types, variables and their values as ST; see parts.h.
#include <utility>

#include "frontend/import/diagnostics.h"
#include "frontend/import/iec10/parts.h"
#include "frontend/source/names.h"

namespace rung::importer::iec10 {
namespace {

bool isTooDeep(Reading& import, const xml::Element& element, uint32_t depth) {
  if (depth < kMaxNesting) return false;
  import.diagnostics.report(diag::XmlTooLarge, element.loc, {std::to_string(kMaxNesting), "nested types and values"});
  return true;
}

// Some tools separate the namespaces of a type name by `\`.
void writeTypeName(Reading& import, const xml::Element& element) {
  std::string name = textOf(import, element);
  if (name.find('\\') == std::string::npos) return writeText(import, element);
  for (char& c : name)
    if (c == '\\') c = '.';
  import.out.put(element.loc, name);
}

// 3, [1, 3(0)] or (x := 1, y := 2)
void writeValue(Reading& import, const xml::Element& value, uint32_t depth) {
  if (isTooDeep(import, value, depth)) return;
  if (value.name == "SimpleValue") {
    if (hasName(import, value, "value"))
      writeName(import, value, "value");
    else
      writeText(import, value);
    return;
  }
  writeAggregate(import, value, [&](const Element& inner) { writeValue(import, inner, depth + 1); });
}

void writeInitial(Reading& import, const xml::Element& declared) {
  const xml::Element* initial = import.document.child(declared, "InitialValue");
  const xml::Element* value = initial == nullptr ? nullptr : valueIn(import, *initial);
  if (value == nullptr) return;
  import.out.word(" := ");
  writeValue(import, *value, 0);
}

void writeRemark(Reading& import, const xml::Element& element) {
  const xml::Element* documentation = import.document.child(element, "Documentation");
  if (documentation == nullptr) return;
  std::string text = textOf(import, *documentation);
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  if (!text.empty()) import.out.put(documentation->loc, "/// " + text + "\n");
}

// `name AT %IX0.0 : INT := 3;` Device-specific addresses such as X0 are ignored.
void writeVariable(Reading& import, const xml::Element& variable) {
  if (!checkName(import, variable)) return;
  writeRemark(import, variable);
  writeName(import, variable);
  const xml::Element* address = import.document.child(variable, "Address");
  const xml::Attribute* located_at = address == nullptr ? nullptr : import.document.attribute(*address, "address");
  if (located_at != nullptr && located_at->raw.starts_with("%")) {
    import.out.word(" AT ");
    import.out.add(import.document, *located_at);
  }
  import.out.word(" : ");
  const xml::Element* type = import.document.child(variable, "Type");
  writeTypeRef(import, type == nullptr ? variable : *type);
  writeInitial(import, variable);
  import.out.word(";\n");
}

// ARRAY[1..3, 0..1] OF INT
void writeArraySpec(Reading& import, const xml::Element& spec, uint32_t depth) {
  import.out.put(spec.loc, "ARRAY[");
  writeList(import, &spec, "DimensionSpec", [&](const Element& e) {
    const Element* range = import.document.child(e, "IndexRange");
    if (range == nullptr)
      import.out.put(e.loc, "*");
    else
      writeRange(import, *range);
  });
  import.out.word("] OF ");
  const xml::Element* base = import.document.child(spec, "BaseType");
  writeTypeRef(import, base == nullptr ? spec : *base, depth + 1);
}

void writeEnumerators(Reading& import, const xml::Element& spec) {
  import.out.put(spec.loc, "(");
  writeList(import, &spec, "Enumerator", [&](const Element& e) { writeEnumerator(import, e); });
  import.out.word(")");
  const xml::Element* base = import.document.child(spec, "BaseType");
  if (base == nullptr || isBlank(import.document.text(*base, import.sources))) return;
  import.out.word(" ");
  writeTypeName(import, *base);
}

// The type in a <UserDefinedTypeSpec> or <InstantlyDefinedType>.
void writeTypeSpec(Reading& import, const xml::Element& spec, uint32_t depth) {
  const std::string kind = typeOf(import, spec);
  if (kind == "StructTypeSpec") {
    import.out.put(spec.loc, "STRUCT\n");
    for (const xml::Element& e : import.document.children(spec))
      if (e.name == "Member") writeVariable(import, e);
    import.out.put(spec.end, "END_STRUCT");
  } else if (kind == "ArrayTypeSpec") {
    writeArraySpec(import, spec, depth);
  } else if (kind == "EnumTypeSpec" || kind == "EnumTypeWithNamedValueSpec") {
    writeEnumerators(import, spec);
  } else if (kind == "ReferenceTypeSpec") {
    import.out.put(spec.loc, "REF_TO ");
    const xml::Element* base = import.document.child(spec, "BaseType");
    writeTypeRef(import, base == nullptr ? spec : *base, depth + 1);
  } else {  // a type derived from another one, possibly a subrange
    const xml::Element* base = import.document.child(spec, "BaseType");
    writeTypeRef(import, base == nullptr ? spec : *base, depth + 1);
    const xml::Element* range = import.document.child(spec, "Range");
    if (range == nullptr) range = import.document.child(spec, "IndexRange");
    if (range == nullptr) return;
    import.out.word("(");
    writeRange(import, *range);
    import.out.word(")");
  }
}

}  // namespace

std::string typeOf(const Reading& import, const xml::Element& element) {
  const std::string type = import.document.value(element, "type");
  return type.substr(type.rfind(':') + 1);
}

// Forbids a declaration without a type. IEC 61131-10, TypeRef.
//   fails   <Variable name="a"><Type/></Variable>          E1051
void writeTypeRef(Reading& import, const xml::Element& holder, uint32_t depth) {
  if (isTooDeep(import, holder, depth)) return;
  if (const xml::Element* name = import.document.child(holder, "TypeName")) return writeTypeName(import, *name);
  if (const xml::Element* spec = import.document.child(holder, "InstantlyDefinedType"))
    return writeTypeSpec(import, *spec, depth);
  import.diagnostics.report(diag::XmlNoType, holder.loc, {holder.name});
  import.out.put(holder.loc, "INT");
}

void writeTypeDecl(Reading& import, const xml::Element& declaration) {
  const xml::Element* spec = import.document.child(declaration, "UserDefinedTypeSpec");
  if (!checkName(import, declaration)) return;
  if (spec == nullptr) {
    import.diagnostics.report(diag::XmlNoType, declaration.loc, {declaration.name});
    return;
  }
  writeRemark(import, declaration);
  import.out.put(declaration.loc, "TYPE ");
  writeName(import, declaration);
  import.out.word(" : ");
  writeTypeSpec(import, *spec, 0);
  writeInitial(import, *spec);
  import.out.put(declaration.end, "; END_TYPE\n");
}

void writeVarList(Reading& import, const xml::Element& list, std::string_view word) {
  writeSectionBegin(import, list, word);
  for (const xml::Element& e : import.document.children(list))
    if (e.name == "Variable") writeVariable(import, e);
  import.out.word("END_VAR\n");
}

void writeVarLists(Reading& import, const xml::Element& owner) {
  for (const xml::Element& list : import.document.children(owner)) {
    if (list.name == "Parameters") {
      writeVarLists(import, list);
      continue;
    }
    if (const std::string_view word = sectionWordOf(list.name); !word.empty()) writeVarList(import, list, word);
  }
}

}  // namespace rung::importer::iec10

// Types, variables and their values as ST; see parts.h.
#include <utility>

#include "frontend/import/diagnostics.h"
#include "frontend/import/iec10/parts.h"
#include "frontend/source/names.h"

namespace rung::iec10 {
namespace {

using plcopen::hasName;
using plcopen::isTrue;

constexpr std::pair<std::string_view, std::string_view> kSections[] = {{"InputVars", "VAR_INPUT"},
                                                                       {"OutputVars", "VAR_OUTPUT"},
                                                                       {"InoutVars", "VAR_IN_OUT"},
                                                                       {"InOutVars", "VAR_IN_OUT"},
                                                                       {"Vars", "VAR"},
                                                                       {"TempVars", "VAR_TEMP"},
                                                                       {"ExternalVars", "VAR_EXTERNAL"},
                                                                       {"GlobalVars", "VAR_GLOBAL"}};

bool isTooDeep(Import& import, const xml::Element& element, uint32_t depth) {
  if (depth < plcopen::kMaxNesting) return false;
  import.diagnostics.report(diag::XmlTooLarge, element.loc,
                            {std::to_string(plcopen::kMaxNesting), "nested types and values"});
  return true;
}

// Some tools separate the namespaces of a type name by `\`.
void writeTypeName(Import& import, const xml::Element& element) {
  std::string name = plcopen::textOf(import, element);
  if (name.find('\\') == std::string::npos) return plcopen::writeText(import, element);
  for (char& c : name)
    if (c == '\\') c = '.';
  import.out.put(element.loc, name);
}

const xml::Element* valueIn(const Import& import, const xml::Element& holder) {
  for (const xml::Element* e = import.document.firstChild(holder); e != nullptr; e = import.document.next(*e))
    if (e->name == "SimpleValue" || e->name == "ArrayValue" || e->name == "StructValue") return e;
  return nullptr;
}

// 3, [1, 3(0)] or (x := 1, y := 2)
void writeValue(Import& import, const xml::Element& value, uint32_t depth) {
  if (isTooDeep(import, value, depth)) return;
  if (value.name == "SimpleValue") {
    if (hasName(import, value, "value"))
      plcopen::writeName(import, value, "value");
    else
      plcopen::writeText(import, value);
    return;
  }
  const bool array = value.name == "ArrayValue";
  import.out.put(value.loc, array ? "[" : "(");
  bool first = true;
  for (const xml::Element* e = import.document.firstChild(value); e != nullptr; e = import.document.next(*e)) {
    const xml::Element* inner = e->name == "Value" ? valueIn(import, *e) : nullptr;
    if (inner == nullptr) continue;
    if (!first) import.out.word(", ");
    first = false;
    const bool repeated = array && hasName(import, *e, "repetitionValue");
    if (repeated || !array) plcopen::writeName(import, *e, array ? "repetitionValue" : "member");
    import.out.word(repeated ? "(" : array ? "" : " := ");
    writeValue(import, *inner, depth + 1);
    if (repeated) import.out.word(")");
  }
  import.out.word(array ? "]" : ")");
}

void writeInitial(Import& import, const xml::Element& declared) {
  const xml::Element* initial = import.document.child(declared, "InitialValue");
  const xml::Element* value = initial == nullptr ? nullptr : valueIn(import, *initial);
  if (value == nullptr) return;
  import.out.word(" := ");
  writeValue(import, *value, 0);
}

void writeRemark(Import& import, const xml::Element& element) {
  const xml::Element* documentation = import.document.child(element, "Documentation");
  if (documentation == nullptr) return;
  std::string text = plcopen::textOf(import, *documentation);
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  if (!text.empty()) import.out.put(documentation->loc, "/// " + text + "\n");
}

// `name AT %IX0.0 : INT := 3;` Device-specific addresses such as X0 are ignored.
void writeVariable(Import& import, const xml::Element& variable) {
  if (!plcopen::checkName(import, variable)) return;
  writeRemark(import, variable);
  plcopen::writeName(import, variable);
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
void writeArray(Import& import, const xml::Element& spec, uint32_t depth) {
  import.out.put(spec.loc, "ARRAY[");
  bool first = true;
  for (const xml::Element* e = import.document.firstChild(spec); e != nullptr; e = import.document.next(*e)) {
    if (e->name != "DimensionSpec") continue;
    if (!first) import.out.word(", ");
    first = false;
    const xml::Element* range = import.document.child(*e, "IndexRange");
    if (range == nullptr) {
      import.out.put(e->loc, "*");
      continue;
    }
    plcopen::writeName(import, *range, "lower");
    import.out.word("..");
    plcopen::writeName(import, *range, "upper");
  }
  import.out.word("] OF ");
  const xml::Element* base = import.document.child(spec, "BaseType");
  writeTypeRef(import, base == nullptr ? spec : *base, depth + 1);
}

void writeEnumerators(Import& import, const xml::Element& spec) {
  import.out.put(spec.loc, "(");
  bool first = true;
  for (const xml::Element* e = import.document.firstChild(spec); e != nullptr; e = import.document.next(*e)) {
    if (e->name != "Enumerator" || !plcopen::checkName(import, *e)) continue;
    if (!first) import.out.word(", ");
    first = false;
    plcopen::writeName(import, *e);
    if (!hasName(import, *e, "value")) continue;
    import.out.word(" := ");
    plcopen::writeName(import, *e, "value");
  }
  import.out.word(")");
  const xml::Element* base = import.document.child(spec, "BaseType");
  if (base == nullptr || plcopen::isBlank(import.document.text(*base, import.sources))) return;
  import.out.word(" ");
  writeTypeName(import, *base);
}

// The type in a <UserDefinedTypeSpec> or <InstantlyDefinedType>.
void writeSpec(Import& import, const xml::Element& spec, uint32_t depth) {
  const std::string kind = typeOf(import, spec);
  if (kind == "StructTypeSpec") {
    import.out.put(spec.loc, "STRUCT\n");
    for (const xml::Element* e = import.document.firstChild(spec); e != nullptr; e = import.document.next(*e))
      if (e->name == "Member") writeVariable(import, *e);
    import.out.put(spec.end, "END_STRUCT");
  } else if (kind == "ArrayTypeSpec") {
    writeArray(import, spec, depth);
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
    plcopen::writeName(import, *range, "lower");
    import.out.word("..");
    plcopen::writeName(import, *range, "upper");
    import.out.word(")");
  }
}

}  // namespace

std::string typeOf(const Import& import, const xml::Element& element) {
  const std::string type = import.document.value(element, "type");
  return type.substr(type.rfind(':') + 1);
}

// Forbids a declaration without a type. IEC 61131-10, TypeRef.
//   fails   <Variable name="a"><Type/></Variable>          E1051
void writeTypeRef(Import& import, const xml::Element& holder, uint32_t depth) {
  if (isTooDeep(import, holder, depth)) return;
  if (const xml::Element* name = import.document.child(holder, "TypeName")) return writeTypeName(import, *name);
  if (const xml::Element* spec = import.document.child(holder, "InstantlyDefinedType"))
    return writeSpec(import, *spec, depth);
  import.diagnostics.report(diag::XmlNoType, holder.loc, {holder.name});
  import.out.put(holder.loc, "INT");
}

void writeTypeDecl(Import& import, const xml::Element& declaration) {
  const xml::Element* spec = import.document.child(declaration, "UserDefinedTypeSpec");
  if (!plcopen::checkName(import, declaration)) return;
  if (spec == nullptr) {
    import.diagnostics.report(diag::XmlNoType, declaration.loc, {declaration.name});
    return;
  }
  writeRemark(import, declaration);
  import.out.put(declaration.loc, "TYPE ");
  plcopen::writeName(import, declaration);
  import.out.word(" : ");
  writeSpec(import, *spec, 0);
  writeInitial(import, *spec);
  import.out.put(declaration.end, "; END_TYPE\n");
}

void writeVarList(Import& import, const xml::Element& list, std::string_view word) {
  import.out.put(list.loc, word);
  static constexpr std::pair<std::string_view, std::string_view> kKeywords[] = {
      {"constant", " CONSTANT"}, {"retain", " RETAIN"}, {"nonRetain", " NON_RETAIN"}};
  for (const auto& [attribute, text] : kKeywords)
    if (isTrue(import, list, attribute)) import.out.word(text);
  import.out.word("\n");
  for (const xml::Element* e = import.document.firstChild(list); e != nullptr; e = import.document.next(*e))
    if (e->name == "Variable") writeVariable(import, *e);
  import.out.word("END_VAR\n");
}

void writeVarLists(Import& import, const xml::Element& owner) {
  for (const xml::Element* list = import.document.firstChild(owner); list != nullptr;
       list = import.document.next(*list)) {
    if (list->name == "Parameters") {
      writeVarLists(import, *list);
      continue;
    }
    for (const auto& [name, word] : kSections)
      if (list->name == name) writeVarList(import, *list, word);
  }
}

}  // namespace rung::iec10

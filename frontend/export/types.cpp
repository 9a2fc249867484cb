// SPDX-License-Identifier: Apache-2.0
// Types, values and variables as TC6 elements; see exporter.h.
#include <algorithm>

#include "frontend/export/exporter.h"
#include "frontend/source/text.h"
#include "frontend/syntax/st_printer.h"

namespace rung::exporter {
namespace {

constexpr std::string_view kElementary[] = {"BOOL",  "BYTE", "WORD",  "DWORD", "LWORD", "SINT",  "INT",
                                            "DINT",  "LINT", "USINT", "UINT",  "UDINT", "ULINT", "REAL",
                                            "LREAL", "TIME", "DATE",  "DT",    "TOD"};

std::string pathOf(const Export& to, Slice<Ident> path) {
  std::string text;
  for (const Ident& part : to.tree.list(path)) text += (text.empty() ? "" : ".") + std::string(to.string(part.name));
  return text;
}

// <INT/> or <derived name="Motor"/>
void exportNamed(Export& to, std::string name) {
  if (sameIdentifier(name, "DATE_AND_TIME")) name = "DT";
  if (sameIdentifier(name, "TIME_OF_DAY")) name = "TOD";
  for (const std::string_view type : kElementary)
    if (sameIdentifier(type, name)) return void(to.xml.leaf(type));
  to.xml.open("derived").attribute("name", name).close();
}

void exportHeld(Export& to, std::string_view holder, TypeExprId type) {
  to.xml.open(holder);
  exportType(to, type);
  to.xml.close();
}

void exportEnum(Export& to, const EnumTypeExpr& type) {
  to.xml.open("enum").open("values");
  for (const EnumItem& item : to.tree.list(type.items)) {
    to.xml.open("value").attribute("name", to.string(item.item.name));
    if (item.value) to.xml.attribute("value", to.printed(item.value));
    to.xml.close();
  }
  to.xml.close();
  if (type.base) exportHeld(to, "baseType", type.base);
  to.xml.close();
}

void exportRange(Export& to, std::string_view element, ExprId low, ExprId high) {
  to.xml.open(element)
      .attribute("lower", low ? to.printed(low) : "*")
      .attribute("upper", high ? to.printed(high) : "*")
      .close();
}

void exportSubrange(Export& to, const SubrangeTypeExpr& type) {
  std::string base;
  if (to.tree.kind(type.base) == TypeExprKind::Named) base = pathOf(to, to.tree.as<NamedTypeExpr>(type.base).path);
  const bool is_unsigned = base.size() > 4 && foldedCharacter(base[0]) == 'u';
  to.xml.open(is_unsigned ? "subrangeUnsigned" : "subrangeSigned");
  exportRange(to, "range", type.low, type.high);
  exportHeld(to, "baseType", type.base);
  to.xml.close();
}

// Tells whether the value has separate elements: <arrayValue>, <structValue>.
bool isListed(const Export& to, ExprId value) {
  const auto single = [&](ExprId element) {
    return to.tree.kind(element) != ExprKind::Repeat || to.tree.as<RepeatExpr>(element).elements.count == 1;
  };
  if (to.tree.kind(value) == ExprKind::ArrayInit) {
    const auto elements = to.tree.list(to.tree.as<ArrayInitExpr>(value).elements);
    return !elements.empty() && std::all_of(elements.begin(), elements.end(), single);
  }
  return to.tree.kind(value) == ExprKind::StructInit && !to.tree.as<StructInitExpr>(value).fields.empty();
}

// <simpleValue>, <arrayValue> or <structValue>; values that the latter two cannot express become a simple value in ST.
void exportValue(Export& to, ExprId value) {
  if (!isListed(to, value)) {
    to.xml.open("simpleValue").attribute("value", to.printed(value)).close();
    return;
  }
  if (to.tree.kind(value) == ExprKind::StructInit) {
    to.xml.open("structValue");
    for (const FieldInit& field : to.tree.list(to.tree.as<StructInitExpr>(value).fields)) {
      to.xml.open("value").attribute("member", to.string(field.field.name));
      exportValue(to, field.value);
      to.xml.close();
    }
    to.xml.close();
    return;
  }
  to.xml.open("arrayValue");
  for (const ExprId element : to.tree.list(to.tree.as<ArrayInitExpr>(value).elements)) {
    to.xml.open("value");
    if (to.tree.kind(element) == ExprKind::Repeat) {
      const auto& repeat = to.tree.as<RepeatExpr>(element);
      to.xml.attribute("repetitionValue", to.printed(repeat.count));
      exportValue(to, to.tree.list(repeat.elements)[0]);
    } else {
      exportValue(to, element);
    }
    to.xml.close();
  }
  to.xml.close();
}

// The comments of a variable: those above it, in it, and after it on its line.
std::string commentsOf(const Export& to, size_t begin, size_t name) {
  const size_t end = to.source->endOfDeclaration(name);
  return to.source->comments(to.source->commentsBefore(begin), to.source->commentsAfter(end));
}

void exportVariable(Export& to, const VarDecl& var, const Ident& name, bool first) {
  to.xml.open("variable").attribute("name", to.string(name.name));
  if (var.located) {
    const size_t begin = to.source->at(var.address_loc);
    size_t end = begin;
    const std::string_view rest = to.source->cut(begin, begin + 64);
    while (end < begin + rest.size() &&
           std::string_view(" \t\r\n:;(").find(rest[end - begin]) == std::string_view::npos)
      ++end;
    to.xml.attribute("address", to.source->cut(begin, end));
  }
  exportHeld(to, "type", var.type);
  if (var.init) exportInitialValue(to, var.init, var.type);
  if (var.edge != EdgeKind::None) to.is_lossless = false;
  {
    AddData data(to);
    exportAttributes(to, var.h.pragmas, data);
  }
  if (first) {
    Loc begin = var.h.loc;
    for (const Pragma& pragma : to.tree.list(var.h.pragmas)) begin = std::min(begin, pragma.loc);
    to.documentation(commentsOf(to, to.source->at(begin), to.source->at(var.h.loc)));
  }
  to.xml.close();
}

}  // namespace

std::string Export::printExpr(ExprId expr) const { return printSt(tree, names, expr); }

void exportType(Export& to, TypeExprId id) {
  switch (to.tree.kind(id)) {
    case TypeExprKind::Error: to.xml.leaf("INT"); return;
    case TypeExprKind::Named: {
      const auto& type = to.tree.as<NamedTypeExpr>(id);
      if (type.has_arguments || !type.elements.empty() || !type.generics.empty()) to.is_lossless = false;
      return exportNamed(to, pathOf(to, type.path));
    }
    case TypeExprKind::String: {
      const auto& type = to.tree.as<StringTypeExpr>(id);
      if (type.code == StringEncoding::Utf8) {  // TC6 has no USTRING, so its length is only in the text
        to.is_lossless = false;
        return exportNamed(to, spelling(type.code));
      }
      to.xml.open(type.code == StringEncoding::Wide ? "wstring" : "string");
      if (type.length) to.xml.attribute("length", to.printed(type.length));
      to.xml.close();
      return;
    }
    case TypeExprKind::Subrange: return exportSubrange(to, to.tree.as<SubrangeTypeExpr>(id));
    case TypeExprKind::Enum: return exportEnum(to, to.tree.as<EnumTypeExpr>(id));
    case TypeExprKind::Array: {
      const auto& type = to.tree.as<ArrayTypeExpr>(id);
      to.xml.open("array");
      for (const ArrayBound& bound : to.tree.list(type.bounds)) {
        if (!bound.low) to.is_lossless = false;
        exportRange(to, "dimension", bound.low, bound.high);
      }
      exportHeld(to, "baseType", type.element);
      to.xml.close();
      return;
    }
    case TypeExprKind::Struct: {
      const auto& type = to.tree.as<StructTypeExpr>(id);
      if (type.is_union || type.overlaps) to.is_lossless = false;
      to.xml.open("struct");
      exportVariables(to, type.fields);
      to.xml.close();
      return;
    }
    case TypeExprKind::Pointer: {
      const auto& type = to.tree.as<PointerTypeExpr>(id);
      if (type.form != PointerForm::Pointer) to.is_lossless = false;
      to.xml.open("pointer");
      exportHeld(to, "baseType", type.target);
      to.xml.close();
      return;
    }
  }
}

// Beremiz writes strings without quotes, so a string value in this version is always read as a literal, never as the
// name of a constant.
void exportInitialValue(Export& to, ExprId value, TypeExprId type) {
  if (type && to.tree.kind(type) == TypeExprKind::String) {
    const char quote = to.tree.as<StringTypeExpr>(type).code == StringEncoding::Wide ? '"' : '\'';
    if (to.printed(value).find(quote) == std::string::npos) to.is_lossless = false;
  }
  to.xml.open("initialValue");
  exportValue(to, value);
  to.xml.close();
}

void exportVariables(Export& to, Slice<DeclId> vars) {
  for (const DeclId id : to.tree.list(vars)) {
    const auto& var = to.tree.as<VarDecl>(id);
    if (var.names.empty()) to.is_lossless = false;  // AT %QX0.0 : BOOL;
    bool first = true;
    for (const Ident& name : to.tree.list(var.names)) {
      exportVariable(to, var, name, first);
      first = false;
    }
  }
}

void exportSection(Export& to, DeclId id, std::string_view element, std::string_view name) {
  const auto& section = to.tree.as<SectionDecl>(id);
  if (section.access != AccessLevel::None) to.is_lossless = false;
  to.xml.open(element);
  if (!name.empty()) to.xml.attribute("name", name);
  if (section.qualifiers.constant) to.xml.attribute("constant", "true");
  if (section.qualifiers.retain) to.xml.attribute("retain", "true");
  if (section.qualifiers.non_retain) to.xml.attribute("nonretain", "true");
  if (section.qualifiers.persistent) to.xml.attribute("persistent", "true");
  if (section.qualifiers.generic) to.is_lossless = false;
  exportVariables(to, section.vars);
}

std::string_view sectionElement(SectionKind kind) {
  switch (kind) {
    case SectionKind::Input: return "inputVars";
    case SectionKind::Output: return "outputVars";
    case SectionKind::InOut: return "inOutVars";
    case SectionKind::Temp: return "tempVars";
    case SectionKind::External: return "externalVars";
    case SectionKind::Global: return "globalVars";
    case SectionKind::Local:
    case SectionKind::Stat:
    case SectionKind::Inst:
    case SectionKind::Access:
    case SectionKind::Config: break;
  }
  return "localVars";
}

void exportAttributes(Export& to, Slice<Pragma> pragmas, AddData& data) {
  bool any = false;
  for (const Pragma& pragma : to.tree.list(pragmas)) {
    const std::string_view name = to.string(pragma.name), value = to.tree.string(pragma.value);
    if (name == "list") continue;
    // Values that an attribute in quotes cannot contain.
    if (name.empty() || value.find_first_of("'{}\n") != std::string_view::npos) {
      to.is_lossless = false;
      continue;
    }
    if (!any) {
      data.open("attributes");
      to.xml.open("Attributes");
    }
    any = true;
    to.xml.open("Attribute").attribute("Name", name).attribute("Value", value).close();
  }
  if (!any) return;
  to.xml.close();
  data.close();
}

void exportPlainText(Export& to, std::string_view text, AddData& data) {
  data.open("interfaceasplaintext");
  to.xml.formatted("InterfaceAsPlainText", text);
  data.close();
}

void exportDataType(Export& to, DeclId id) {
  const auto& decl = to.tree.as<TypeDecl>(id);
  const SourceText& source = *to.source;
  to.is_lossless = !decl.is_internal;
  for (const std::string_view word : {"PUBLIC", "INTERNAL", "ABSTRACT", "FINAL"})  // modifiers where they follow TYPE
    if (sameIdentifier(to.string(decl.name), word)) to.is_lossless = false;
  to.xml.open("dataType").attribute("name", to.string(decl.name));
  exportHeld(to, "baseType", decl.type);
  if (decl.init) exportInitialValue(to, decl.init, decl.type);
  const size_t name = source.at(decl.h.loc), end = source.endOfDeclaration(name);
  const TypeExprId base =
      to.tree.kind(decl.type) == TypeExprKind::Struct ? to.tree.as<StructTypeExpr>(decl.type).base : TypeExprId{};
  {
    AddData data(to);
    exportAttributes(to, decl.h.pragmas, data);
    if (base) {
      data.open("datatypeinheritance");
      to.xml.open("Inheritance");
      to.xml.element("Extends", pathOf(to, to.tree.as<NamedTypeExpr>(base).path));
      to.xml.close();
      data.close();
    }
    if (!to.is_lossless) {
      std::string text = "TYPE\n";
      for (const Pragma& pragma : to.tree.list(decl.h.pragmas)) {
        const size_t begin = source.at(pragma.loc);
        text.append(source.cut(begin, source.endOfPragma(begin))).append("\n");
      }
      if (decl.is_internal) text += "INTERNAL ";
      exportPlainText(to, text.append(source.cut(name, end)).append("\nEND_TYPE"), data);
    }
  }
  size_t begin = name;
  for (const Pragma& pragma : to.tree.list(decl.h.pragmas)) begin = std::min(begin, source.at(pragma.loc));
  const bool is_first = source.wordBefore(begin, "TYPE") < begin && source.commentsBefore(begin, true) == begin &&
                        source.cut(source.wordBefore(begin, "TYPE"), begin).find(';') == std::string_view::npos;
  if (is_first) begin = source.wordBefore(begin, "TYPE");
  std::string content = source.comments(source.commentsBefore(begin), begin);
  if (to.tree.kind(decl.type) != TypeExprKind::Struct) {  // the members of a structure have the other comments
    const std::string own = source.comments(name, source.commentsAfter(end));
    content += (content.empty() || own.empty() ? "" : "\n") + own;
  }
  to.documentation(content);
  to.xml.close();
}

}  // namespace rung::exporter

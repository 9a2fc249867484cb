// SPDX-License-Identifier: Apache-2.0
// Shared by the parts of the export. Private to frontend/export: plcopen.cpp (the project and its POUs),
// body.cpp, types.cpp, configuration.cpp, chart.cpp, networks.cpp.
#pragma once

#include <string>
#include <string_view>

#include "frontend/export/diagnostics.h"
#include "frontend/export/source_text.h"
#include "frontend/export/xml_writer.h"
#include "frontend/source/diagnostics.h"
#include "frontend/syntax/tree.h"

namespace rung::exporter {

struct Export {
  const Tree& tree;
  const Names& names;
  const Sources& sources;
  Diagnostics& diagnostics;
  xml::Writer xml = {};
  const SourceText* source = nullptr;  // of the current file
  bool is_lossless = true;             // false: the current declaration must be added as text

  std::string_view string(NameId name) const { return names.string(name); }
  std::string printed(ExprId expr) const { return printExpr(expr); }
  std::string printExpr(ExprId expr) const;
  void reportInexpressible(Loc loc, std::string_view what) { diagnostics.report(diag::XmlNotExpressible, loc, {what}); }
  // Warns about a construct that is written to Rung's addData: other tools ignore it.
  void onlyRung(Loc loc, std::string_view what) { diagnostics.report(diag::XmlOnlyRung, loc, {what}); }
  // <data name="…" handleUnknown="…">, closed by its caller.
  void openData(std::string_view name, std::string_view unknown = "implementation");
  void openVendorData(std::string_view kind);  // of the 3S family
  void documentation(const std::string& content) {
    if (!content.empty()) xml.formatted("documentation", content);
  }
};

// An <addData> that is opened only when it gets content.
class AddData {
 public:
  explicit AddData(Export& to) : to_(to) {}
  ~AddData() {
    if (open_) to_.xml.close();
  }
  void open(std::string_view kind) {
    begin();
    to_.openVendorData(kind);
  }
  void openOwn();  // for Rung only
  void close() { to_.xml.close(); }

 private:
  void begin() {
    if (!open_) to_.xml.open("addData");
    open_ = true;
  }
  Export& to_;
  bool open_ = false;
};

// ---- exporter.cpp

// <text>, in Rung's own addData.
void exportOwnText(Export& to, std::string_view text, AddData& data);

// ---- types.cpp

// The content of <type>, <baseType> …
void exportType(Export& to, TypeExprId type);
// <initialValue>; `type` as declared.
void exportInitialValue(Export& to, ExprId value, TypeExprId type);
// The <variable> elements of a list, and of a structure.
void exportVariables(Export& to, Slice<DeclId> vars);
// <localVars constant="true"> … with its variables; `name`: of a list of globals.
void exportSection(Export& to, DeclId section, std::string_view element, std::string_view name = {});
void exportDataType(Export& to, DeclId type);
// {attribute 'name' := 'value'}
void exportAttributes(Export& to, Slice<Pragma> pragmas, AddData& data);
// The declaration as text.
void exportPlainText(Export& to, std::string_view text, AddData& data);
// <localVars> …; if TC6 has no list for the kind, the nearest one.
std::string_view sectionElement(SectionKind kind);

// ---- body.cpp

// <body>, or <inline name="">: its statements, instructions, chart or networks.
void exportBody(Export& to, const PouDecl& pou, std::string_view element = "body");

// ---- configuration.cpp, chart.cpp, networks.cpp

void exportConfiguration(Export& to, DeclId configuration);
// Writes the bodies of actions and transitions of a chart.
using BodyExport = void (*)(Export& to, const PouDecl& pou, std::string_view element);
void exportChart(Export& to, const PouDecl& pou, BodyExport body);
// The <transitions> of a chart that have bodies.
void exportTransitions(Export& to, const PouDecl& pou, BodyExport body);
void exportNetworks(Export& to, const Diagram& diagram);  // <LD>, <FBD>, or <ST> and <addData> with a <CFC>

}  // namespace rung::exporter

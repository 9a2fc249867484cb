// SPDX-License-Identifier: Apache-2.0
// Declarations: TYPE entries, sections and variables, types, initial values, modifiers. Private to frontend/parse; see
// cursor.h. declarations.cpp, variables.cpp, types.cpp, initial_values.cpp, modifiers.cpp.
#pragma once

#include "frontend/parse/expressions.h"

namespace rung::text {

class DeclarationParser : public ExpressionParser {
 public:
  using ExpressionParser::ExpressionParser;

 protected:
  bool parseName(Ident& out);
  bool parseNewName(Ident& out);  // of what is declared here
  void parseNamePath(Slice<Ident>& out);
  void parseTypes(std::vector<DeclId>& out);
  DeclId parseSection();
  bool atSection() const { return kind() >= Tok::Var && kind() <= Tok::VarConfig; }
  TypeExprId parseType() override;
  // ---- initial_values.cpp
  std::vector<FieldInit> parseFieldInits(Tok close);
  ExprId parseInit();
  // ---- modifiers.cpp
  bool acceptAccess(AccessLevel& access);
  void parseModifiers(AccessLevel& access, uint8_t& modifiers, bool before_name);
  Slice<TypeExprId> parseTypeNames();
  bool endsWithComma();

  bool lost_ = false;  // declarations of the current POU or TYPE entry could not be read
  std::vector<DeclId> decls_;
  std::vector<Ident> idents_;

 private:
  // ---- declarations.cpp
  void skipStray(bool fits_after, Diag diag);
  void syncDeclaration(Tok end);
  DeclId parseTypeEntry(Slice<Pragma> pragmas, Loc doc, AccessLevel access);
  // ---- variables.cpp
  void parseVars(SectionKind section, Tok end, std::vector<DeclId>& out);
  DeclId parseVar(SectionKind section);
  void parseVarNames(SectionKind section);
  bool nameFollows(bool dotted);
  void reportNoName(bool after_comma);
  void parseLocation(VarDecl& d);
  bool readLocation(VarDecl& d);
  void reportNoColon();
  void parseAccessTarget(VarDecl& d);
  void parseVarType(VarDecl& d, SectionKind section);
  void parseVarInit(VarDecl& d);
  void endVar(VarDecl& d);
  void parseAccessPath(VarDecl& d);
  void readRelativeAddress(VarDecl& d);
  // ---- types.cpp
  bool beginsType(const Token* t) const;
  TypeExprId parseStruct();
  TypeExprId parseEnum(TypeExprId base);
  TypeExprId parseArray();
  TypeExprId parseNamedType() { return ended(namedType()); }
  TypeExprId namedType();
  TypeExprId stringType(StringEncoding code);
  Tok misspelledType(const Token* name) const;
  Slice<ExprId> parseElementArguments();
  Slice<Argument> parseGenerics();
  bool rangeFollows() const;
  // ---- initial_values.cpp
  ExprId parseDeclaredInit(TypeExprId type);
  void parseElements(Tok close);
  void parseElement();
  ExprId parseFieldValue(Tok close);
  ExprId parseArrayInit();
  ExprId parseStructInit();

  bool in_structure_ = false;      // in a STRUCT or UNION
  bool address_reported_ = false;  // reported once per structure
  uint32_t type_depth_ = 0;
};

constexpr uint32_t kMaxTypeDepth = 200;

// Keywords after which the current block has no further variable or type (declarations.cpp).
bool endsDeclarations(Tok kind);
// `name :`, `name,` or `name AT`
bool beginsDeclaration(const Token* t);

}  // namespace rung::text

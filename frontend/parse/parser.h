// SPDX-License-Identifier: Apache-2.0
// The parser of the text languages: recursive descent for declarations and statements, precedence climbing for
// expressions, over the token array of lexer.h whose blocks recover.h has balanced. This part: files, POUs and
// configurations (parser.cpp, configurations.cpp), objects (objects.cpp). Private to frontend/parse; see cursor.h.
#pragma once

#include "frontend/parse/chart.h"

namespace rung::text {

class Parser final : public ChartParser {
 public:
  using ChartParser::ChartParser;

  void readAll() { read(0, static_cast<uint32_t>(source_.size())); }
  void readBetween(Loc begin, Loc end) { read(begin.offset - base_, end.offset - base_); }
  Slice<DeclId> parseDecls();
  ExprId parseLoneExpression();
  Slice<FieldInit> parseLoneFieldInits();

 private:
  // ---- files and POUs
  void parseTopLevel(std::vector<DeclId>& out);
  void parseStrayExternal();
  void parseUnknownTopLevel();
  void skipToTopLevel();
  bool enterDecl(Tok end);
  DeclId parsePou();
  void parsePouName(PouDecl& d);
  void parseBases(PouDecl& d);
  void parsePouResult(PouDecl& d, Tok word);
  void parsePouParts(PouDecl& d);
  void closePou(PouDecl& d, const Token* open, Tok word, Tok end);
  bool acceptCppFile(PouDecl& d);
  void checkCppFile(const PouDecl& d);
  void reportCppFile(Diag diag, Loc at);
  void parseBody(PouDecl& d) override;
  bool skipForeign() override { return chartInSt() || instructionInSt(); }

  // ---- configurations.cpp
  DeclId parseConfiguration();
  DeclId parseResource();
  DeclId parseTask();
  DeclId parseProgramInstance();
  Slice<DeclId> membersUntil(Tok end, const Token* open);
  void parseMembers(Tok end, std::vector<DeclId>& out);
  void skipLine();

  // ---- objects.cpp
  void parseMember(std::vector<DeclId>& out) override;
  DeclId parseProperty();
  void parseHalfProperty(std::vector<DeclId>& out);
  Ident parsePropertyHeader(PropertyDecl& d);
  DeclId parseAccessor(const Ident& property, const PropertyDecl& of);
  DeclId parseAccessorBody(PouDecl& d, const Ident& property, const PropertyDecl& of, bool is_set, Tok end);
  DeclId parseNamespace();
  void parseUsing(std::vector<DeclId>& out);

  uint32_t decl_depth_ = 0;  // namespaces, resources and members around the current token
};

constexpr uint32_t kMaxDeclDepth = 200;

}  // namespace rung::text

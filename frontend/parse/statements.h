// SPDX-License-Identifier: Apache-2.0
// Statements, and resynchronization after errors in them. Private to frontend/parse; see cursor.h. statements.cpp,
// blocks.cpp.
#pragma once

#include "frontend/parse/declarations.h"

namespace rung::text {

class StatementParser : public DeclarationParser {
 public:
  using DeclarationParser::DeclarationParser;

 protected:
  enum Stops : uint8_t {
    kStopElse = 1,
    kStopElsif = 2,
    kStopUntil = 4,
    kStopLabel = 8,
    kStopTry = 16
  };  // keywords that end a list, besides END_…
  Slice<StmtId> parseStatements(uint8_t stops);
  bool startsStatement(const Token* t) const override;
  void endStatement();
  void syncStatement();
  void skipStatement();
  void endOne(StmtId id);

  // ---- where a body ends
  bool atBlockEnd();
  bool atTopLevelWord() const;
  bool atMember() const { return at(Tok::Method) || at(Tok::Property) || at(Tok::Action); }
  bool atAccessor() const;
  bool pouCloses();
  void skipBody();

  // ---- later subjects: skips a chart or instructions among the statements
  virtual bool skipForeign() = 0;

  bool declared_in_body_ = false;                                              // reported once per POU
  uint32_t in_property_ = 0;                                                   // in its accessors
  Tok pou_end_ = Tok::End;                                                     // the END_… of the current POU
  enum class Known : uint8_t { NotYet, Yes, No } pou_closes_ = Known::NotYet;  // whether the current POU has that END_…
  uint32_t stmt_depth_ = 0;
  std::vector<StmtId> stmts_;

 private:
  // ---- statements.cpp
  bool atListEnd(uint8_t stops);
  void parseStatement();
  bool parseKeywordStatement(Loc start);
  void parseReturn(Loc start);
  void parseStray(Loc start);
  void parseExprStatement();
  bool parseLabelOrDeclaration();
  bool acceptAssign(AssignOp& op);
  void finishAssign(Token* first, ExprId target, AssignOp assign, const Token* op);
  void reportNoEffect(const Token* first);
  bool atRowOperator() const;
  void parseRow(ExprId target, AssignOp assign, ExprId value, Token* value_start, const Token* op);
  bool atListOfValues() const;
  void parseChain(ExprId target, ExprId value, Token* value_start, const Token* op);
  bool misspelledStart(const Token* first);
  // ---- blocks.cpp
  void parseIf();
  void parseCase();
  void parseFor();
  void parseWhile();
  void parseRepeat();
  void parseTry();
  bool atCaseLabel() const;
  void parseCaseLabels(std::vector<ExprId>& out);
  ExprId parseHeader(Tok connective);
  void finishHeader(Tok connective);
  void skipHeader(Tok connective);
  bool enterBlock();
  void closeBlock(const Token* open, Tok end);
  template <class Stmt>
  void closeBlock(const Token* open, Tok end, const Stmt& s) {
    closeBlock(open, end);
    stmts_.push_back(tree_.add<StmtId>(s));
  }

  const Token* statement_start_ = nullptr;
  std::vector<IfBranch> if_branches_;
  std::vector<CaseBranch> case_branches_;
};

constexpr uint32_t kMaxStmtDepth = 2000;

// Token kinds that statements and their recovery ask for.
bool isEndWord(Tok kind);
bool isPouWord(Tok kind);
bool isStatementWord(Tok kind);
bool isAssign(Tok kind);

}  // namespace rung::text

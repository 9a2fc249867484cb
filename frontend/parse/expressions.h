// SPDX-License-Identifier: Apache-2.0
// Expressions: precedence climbing over a table of operators, postfix chains, literals and arguments. Private to
// frontend/parse; see cursor.h.
#pragma once

#include "frontend/parse/cursor.h"

namespace rung::text {

class ExpressionParser : public Cursor {
 public:
  ExpressionParser(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                   Diagnostics& diagnostics);

 protected:
  ExprId parseExpr(uint32_t least = 1);
  ExprId parseUnary();
  ExprId parsePrimary();
  ExprId parsePostfix(ExprId base, bool calls = true);
  Slice<Argument> parseArguments(Loc& end);
  ExprId parseNumber(NameId prefix, bool negative, Loc loc);
  // `:=` after a condition or in parentheses most likely means `=`, and is parsed as `=`.
  ExprId parseCompared(ExprId left, bool in_condition = true);
  void closeParen(Tok close, bool is_arguments);
  bool failsToClose(Tok close, bool is_arguments);
  bool endsExpression(Tok k) const;
  bool skipToPartner(Tok close);
  void skipToEndOfParen(Tok close);
  bool enterExpr(const char* what);
  bool isBareXor(ExprId id) const;
  bool acceptAssign();
  void missingComma();

  // ---- later subjects
  virtual TypeExprId parseType() = 0;
  virtual bool startsStatement(const Token* t) const = 0;
  virtual bool atNestedIl() const = 0;
  virtual void parseNestedIl(uint32_t operand) = 0;
  virtual void closeIlParen(Tok close) = 0;

  uint32_t expr_depth_ = 0;
  uint32_t height_ = 0;               // of the tree of the expression read last
  bool in_variable_ = false;          // in the type of a variable, which may have arguments
  bool in_program_instance_ = false;  // in PROGRAM p : Main (…) of a resource
  std::vector<Ident> block_tasks_;    // its blocks with separate tasks, each followed by the task
  bool eno_used_ = false;             // ENO is an operand in the current POU
  // Scratch stacks of lists that are being built.
  std::vector<ExprId> exprs_;
  std::vector<Argument> arguments_;
  std::vector<uint32_t> numbers_;

 private:
  ExprId parseOperandName();
  ExprId parseInParens();
  ExprId missingOperand();
  ExprId parseDot(ExprId base);
  void noteEnoOf(ExprId base);
  ExprId parsePartAccess(ExprId base, Loc at_member);
  ExprId parseIndex(ExprId base, uint32_t& height);
  ExprId parseCall(ExprId base, uint32_t& height);
  bool isNew(ExprId callee) const;
  ExprId parseNew(ExprId callee);
  bool isSizeOfType(ExprId callee) const;
  ExprId parseSizeOfType(ExprId callee);
  ExprId parseTyped();
  ExprId parseStringLiteral(NameId prefix, Loc loc);
  ExprId parseTime();
  ExprId parseAddress();
  Argument parseArgument(size_t first);
  void parseWithTask(const Argument& argument);
  bool continuesArguments();

  NameId eno_;
  NameId this_struct_;
  std::string buffer_;
};

constexpr uint32_t kMaxExprDepth = 1000;
constexpr uint32_t kMaxChain = 2000;  // operators in a row: a left-deep tree
constexpr uint32_t kMaxExprHeight = kMaxChain + 1;

}  // namespace rung::text

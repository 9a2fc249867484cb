// SPDX-License-Identifier: Apache-2.0
// Instruction List. Private to frontend/parse; see cursor.h. il.cpp.
#pragma once

#include "frontend/parse/statements.h"
#include "frontend/syntax/il.h"

namespace rung::text {

class IlParser : public StatementParser {
 public:
  IlParser(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect, Diagnostics& diagnostics);

 protected:
  bool atIl() const;
  Slice<IlInstruction> parseIl(bool nested);
  bool instructionInSt();
  bool atNestedIl() const override;
  void parseNestedIl(uint32_t operand) override;
  void closeIlParen(Tok close) override;

 private:
  bool isInstruction(const Token* t) const;
  bool isPlainInstruction(const Token* t) const;
  // In place of an operand with an error.
  Slice<Argument> unknownOperand(Loc loc) {
    const Argument unknown{{}, build_.error(loc), false, false, loc};
    return tree_.addList<Argument>({&unknown, 1});
  }
  void parseInstruction();
  void resynchronize(IlInstruction& i);
  void endInstruction();
  void parseOperands(IlInstruction& i, const Token* op);
  void parseIlList(IlInstruction& i, const Token* op);
  ExprId parseIlCallee();
  void parseIlPins(IlInstruction& i);
  void parseIlParens(IlInstruction& i, const Token* op);
  bool listFollows(const Token* first) const;
  bool statementInIl();

  bool il_file_ = false;           // the file name ends in .il
  bool il_line_reported_ = false;  // reported once per file
  std::vector<IlInstruction> il_;
  std::vector<IlNested> il_nested_;
  std::vector<const Token*> il_open_;  // operators whose `(` is open
  size_t il_outside_ = 0;              // how many of them enclose the current list
};

}  // namespace rung::text

// SPDX-License-Identifier: Apache-2.0
// The token cursor that all parts of the parser share: the current token, errors, and the ends of nodes. Private to
// frontend/parse. The parser is a chain of classes, one subject each, which all see the same tokens:
//   Cursor > ExpressionParser > DeclarationParser > StatementParser > IlParser > NetworkParser > ChartParser > Parser
// Where the grammar goes back to a later subject, as from an expression to a type, a virtual function leads there.
//
// Errors. fail() reports and sets panic_: no further errors are reported until the current construct has found its
// synchronization point (`;`, a keyword, a line that begins a statement). slip() reports an error whose intended
// meaning is clear and continues as if it had been written correctly. One line gets at most one syntax error.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "frontend/parse/lexer.h"
#include "frontend/parse/literals.h"
#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/tree_builder.h"

namespace rung::text {

class Cursor {
 public:
  Cursor(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect, Diagnostics& diagnostics);

  // Lexes [begin, end) of the file and balances its blocks.
  void read(uint32_t begin, uint32_t end, std::vector<Comment>* comments = nullptr);
  // What recovery skipped and no error node holds.
  std::span<const Range> skipped() const { return skipped_; }

 protected:
  // ---- tokens
  Tok kind() const { return t_->kind; }
  bool at(Tok kind) const { return t_->kind == kind; }
  Tok peek(uint32_t n = 1) const { return t_[n].kind; }
  bool atLineStart() const { return (t_->flags & kLineStart) != 0; }
  void advance() {
    if (t_->kind != Tok::End) ++t_;
  }
  bool accept(Tok kind) {
    if (t_->kind != kind) return false;
    ++t_;
    return true;
  }
  uint32_t index() const { return static_cast<uint32_t>(t_ - tokens_.data()); }
  Loc loc(const Token* t) const { return {base_ + t->offset}; }
  Loc here() const { return loc(t_); }
  NameId nameOf(const Token* t) const {
    return t->kind == Tok::Null ? names_.intern(textOf(t)) : NameId{t->value};  // its value is its length
  }
  Ident ident(const Token* t) const { return {nameOf(t), loc(t)}; }
  uint32_t lengthOf(const Token* t) const {
    if (t->name_length != 0) return t->name_length;
    return isName(t->kind) || isTypeWord(t->kind) ? lengthOfRareName(t) : t->value;
  }
  std::string_view textOf(const Token* t) const { return source_.substr(t->offset, lengthOf(t)); }
  Loc endOf(const Token* t) const { return {base_ + t->offset + lengthOf(t)}; }
  bool is(const Token* t, std::string_view word) const { return sameIdentifier(textOf(t), word); }
  std::string describe(const Token* t) const;  // "`x`", "the end of the file"

  bool isOperand(Tok kind) const;
  // CODESYS knows NULL as a value only: items and members may have this name.
  bool isNullName(const Token* t) const { return t->kind == Tok::Null && profile_.null_as_name; }

  // ---- errors
  Report fail(Diag diag, const Token* t, std::initializer_list<std::string_view> args = {});
  Report slip(Diag diag, const Token* t, std::initializer_list<std::string_view> args = {});
  Report missing(Diag diag, std::initializer_list<std::string_view> args);  // at the end of the previous token
  bool mayReport(const Token* t);
  // Adds a fix that takes the token away, or writes `text` in place of what is from one token to another.
  Report removal(Report report, const Token* t, Sureness sureness) const;
  Report replaced(Report report, const Token* first, const Token* last, std::string_view text, Sureness sureness) const;
  bool nameReserved(const Token* t) const { return isReserved(t->kind) || isTypeWord(t->kind); }
  // Consumes `wanted`. If it is missing: slip(), or fail() when the next token makes no sense. True when it was there.
  bool expect(Tok wanted);
  // The keyword of `candidates` that is nearest to the name at t, or End.
  Tok nearKeyword(const Token* t, std::span<const Tok> candidates) const;
  bool correctSpelling(Tok wanted);  // t_ is a misspelled `wanted`: reports and corrects it
  void tooDeep(const char* what, uint32_t limit);

  // ---- unfinished lines (unfinished.cpp)
  enum class Begins : uint8_t { Nothing, Element, New };
  Begins begins(const Token* t) const;
  // Tells whether the line above needs something that the first token of this one cannot be.
  bool lineEnds();
  // After `:=` in codesys: the line below begins with the second target of a chain, which draws a warning.
  void acceptChainOverLines();
  bool isVariable(const Token* t) const;
  // t_ begins something new after an error at the end of the line above: recovery ends here.
  bool atUnfinished() const { return t_ == unfinished_; }

  // END_… of what begins at `open` is missing.
  void skipStructOfC();
  void missingEnd(std::string_view end, const Token* open, std::string_view word);

  // ---- what recovery skips
  // Notes the tokens that are read while it lives.
  class Skipping {
   public:
    explicit Skipping(Cursor& cursor) : cursor_(cursor), first_(cursor.t_) {}
    ~Skipping() { cursor_.noteSkipped(first_); }
    Skipping(const Skipping&) = delete;
    Skipping& operator=(const Skipping&) = delete;

   private:
    Cursor& cursor_;
    const Token* first_;
  };
  void skip() {
    const Skipping skipping(*this);
    advance();
  }
  // What was skipped from `begin` on is in an error node. Those are statements, …
  void holdSkipped(Loc begin) {
    while (!skipped_.empty() && skipped_.back().begin >= begin) skipped_.pop_back();
  }
  // … errors at the end of an expression, which recovery from `first` on follows, …
  void holdSkipped(ExprId expr, const Token* first);
  // … and types in place of what begins at `begin`.
  void holdSkipped(TypeExprId error, Loc begin);

  // ---- nodes
  // The end of the last token that was read.
  Loc endOfPrevious() const {
    const Token* t = t_ - 1;
    return t_ != tokens_.data() && (t->flags & kSynthetic) == 0 ? endOf(t) : endOfRead();
  }
  // Notes that a node ends with the last token that was read.
  ExprId ended(ExprId expr) {
    tree_.expr(expr).end = endOfPrevious();
    return expr;
  }
  TypeExprId ended(TypeExprId type) {
    if (type) tree_.typeExpr(type).end = endOfPrevious();
    return type;
  }
  template <class Node>
  DeclId finish(Node& node) {
    node.h.end = endOfPrevious();
    return tree_.add<DeclId>(node);
  }
  DeclHeader declHeader(DeclKind kind) { return header(kind, here(), takeDoc(), takePragmas()); }

  template <class T>
  Slice<T> listFrom(std::vector<T>& scratch, size_t first) {
    const Slice<T> slice = tree_.addList<T>(std::span<const T>(scratch).subspan(first));
    scratch.resize(first);
    return slice;
  }

  // ---- pragmas and doc comments (pragmas.cpp)
  Slice<Pragma> takePragmas();
  Pragma readPragma(const PragmaRange& pragma);
  void splitList(const PragmaRange& pragma, std::vector<Pragma>& list);
  Loc takeDoc();
  Loc docAfter(const Token* t) const;
  bool pragmaNamed(Slice<Pragma> pragmas, std::string_view name) const;

  Tree& tree_;
  TreeBuilder build_{tree_};
  Names& names_;
  const Sources& sources_;
  FileId file_;
  const LanguageProfile& profile_;
  Diagnostics& diagnostics_;
  uint32_t base_;
  std::string_view source_;
  TokenStream stream_;
  std::vector<Token> tokens_;
  Token* t_ = nullptr;
  bool panic_ = false;
  bool declares_ = false;                // in a section, a structure or TYPE
  bool in_il_ = false;                   // in a list of instructions
  std::vector<NameId> variables_;        // of the current POU
  const Token* unfinished_ = nullptr;    // the first token after the last unfinished line
  const Token* chain_target_ = nullptr;  // the second target of a chain, first on its line
  const Token* last_error_ = nullptr;

 private:
  void noteSkipped(const Token* first);
  Loc endWithoutSemicolon(Loc begin) const;
  bool inBrackets(const Token* t, bool otherwise) const;
  const Token* lineOf(const Token* t) const;
  uint32_t columnOf(const Token* t) const;
  Report reportMissing(Diag diag, const Token* t, std::initializer_list<std::string_view> args, Sureness sureness,
                       bool& unfinished);
  // Adds the fix that the message names.
  Report withFix(Report report, Diag diag, const Token* t, std::initializer_list<std::string_view> args,
                 Sureness sureness) const;
  Report insertion(Report report, const Token* before, std::string_view word, Sureness sureness) const;
  const Token* readBefore(const Token* t) const;
  uint32_t lengthOfRareName(const Token* t) const;  // one that recovery made, or a very long one
  Loc endOfRead() const;                            // where tokens that recovery inserted are in between

  std::vector<Range> skipped_;
};

}  // namespace rung::text

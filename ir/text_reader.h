// SPDX-License-Identifier: Apache-2.0
// The reader of IR text, a class in two files: items and types in text_parser.cpp, the code of bodies in
// text_code_parser.cpp. Internal to them.
#pragma once

#include <unordered_map>

#include "ir/builder.h"
#include "ir/text.h"
#include "ir/text_keywords.h"
#include "ir/text_lexer.h"

namespace rung::ir::text_form {

using types::TypeTable;

constexpr uint32_t kMaxDepth = 1000;

// A word and what it stands for.
template <class T>
struct Meaning {
  std::string_view text;
  T value;
};

// Takes tokens one after the other. After a mistake `failed_` is set, and nothing is accepted any more.
class TokenReader {
 protected:
  TokenReader(const Sources& sources, FileId file, Names& names, Diagnostics& diagnostics)
      : names_(names), diagnostics_(diagnostics) {
    tokens_ = tokenize(sources.sourceText(file), sources.begin(file));
  }
  const Token& token(size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
  bool isPunct(std::string_view text, size_t ahead = 0) const {
    return token(ahead).kind == TokenKind::Punct && token(ahead).text == text;
  }
  bool isWord(std::string_view word, size_t ahead = 0) const {
    return token(ahead).kind == TokenKind::Name && !token(ahead).quoted && token(ahead).text == word;
  }
  bool accept(std::string_view text) {
    if (failed_ || !(isPunct(text) || isWord(text))) return false;
    ++at_;
    return true;
  }
  void expect(std::string_view text) {
    if (!accept(text)) expected(text);
  }
  // Takes one of the words and sets the value that it stands for.
  template <class T, size_t N>
  bool acceptOneOf(const Meaning<T> (&words)[N], T& value) {
    for (const Meaning<T>& word : words) {
      if (!accept(word.text)) continue;
      value = word.value;
      return true;
    }
    return false;
  }
  void expected(std::string_view what);
  void fail(Diag diag, Loc loc, std::initializer_list<std::string_view> args);
  NameId name();                      // of anything; not a keyword without backticks
  std::string sigilName();            // after `@`: `Color`, `Color.2`
  NameId numberedName(NameId& base);  // of a task or program instance: `t`, `t.2`
  std::string quotedText(TokenKind kind);
  int64_t integer();  // with sign; up to 2^64-1 as bits

  Names& names_;
  Diagnostics& diagnostics_;
  std::vector<Token> tokens_;
  size_t at_ = 0;
  bool failed_ = false;
};

class Reader : TokenReader {
 public:
  Reader(const Sources& sources, FileId file, Module& module, Diagnostics& diagnostics)
      : TokenReader(sources, file, module.names, diagnostics), module_(module), types_(module.types), file_(file) {}
  bool read();

 private:
  using Map = std::unordered_map<uint32_t, uint32_t>;

  // ---- items
  void findItems();
  void declareType();
  void declareItem();
  void enumItems();
  void list();
  void recordFields(TypeId type);
  void record();
  void dataItem();
  void classes();
  void dispatch();
  void task();
  void taskCalls();
  void ioModule();
  void instance();
  void linkInits();
  void entryOrTest();
  void readCodes();
  void test(BodyId body);
  void area();
  struct AddressInArea {
    types::AreaId area;
    uint32_t byte;
  };
  std::optional<AddressInArea> addressInArea();
  types::SymbolAccess symbolAccess();
  void located();
  void function();
  void blockBody(BodyKind kind);
  void attributes(Body& body);
  BodyId bodyNamed(std::string_view what);
  Origin origin();
  void code();

  // ---- types
  TypeId type();
  bool atType() const;
  TypeId typeNamed(const std::string& name, Loc loc);

  // ---- code
  StmtId block();
  template <class T>
  void append(Loc loc, const T& node) {
    if (!failed_) builder_->append(loc, node);
  }
  void stmt();
  StmtId optionalBlock(std::string_view word) { return accept(word) ? block() : StmtId{}; }
  void localDeclaration(LocalKind kind);
  void assignment();
  void forStmt();
  void returnStmt();
  uint32_t label();
  void tryStmt();
  void faultStmt();
  void assertion(Assertion kind);
  void callStmt(ExprId result);
  void switchStmt();
  ExprId expr(TypeId wanted);
  ExprId primary(TypeId wanted);
  ExprId afterWord();
  ExprId afterSigil();
  ExprId conversion(types::Rounding rounding);
  ExprId operation(Op op);
  uint32_t numberOf(const Map& by_name, std::string_view what, bool numbered = false);
  ExprId postfix(ExprId base);
  ExprId part(ExprId base);
  ExprId field(ExprId base);
  ExprId element(ExprId base);
  ExprId target(ExprId base);
  bool requireBase(ExprId base, bool holds, std::string_view access, std::string_view what);
  ExprId literal(TypeId type);
  ExprId classNumber();
  ExprId enumItem(TypeId type);
  ExprId specialReal(TypeId type, bool negative);
  ExprId number(TypeId type, bool negative);
  ExprId misfit(std::string_view seen, TypeId type);
  ExprId variable();
  ExprId afterType(TypeId type);
  std::vector<ExprId> operands(const Body& callee);
  uint8_t checks(uint8_t natural);
  TypeId typeOf(ExprId id) const { return builder_->body.expr(id).type; }
  uint32_t fieldOf(TypeId record, NameId field);

  Module& module_;
  TypeTable& types_;
  FileId file_;
  uint32_t depth_ = 0;

  std::vector<size_t> items_;
  std::unordered_map<std::string, TypeId> type_by_name_;
  Map list_by_name_, program_by_name_, task_by_name_, body_by_name_, init_by_name_, record_by_type_;
  Map broken_names_;                                      // of functions whose declaration has been reported
  std::unordered_map<uint64_t, uint32_t> field_by_name_;  // record type and name
  std::vector<bool> fields_known_;                        // by TypeId
  struct Code {
    size_t at;  // of the `{`
    BodyId body;
  };
  std::vector<Code> codes_;

  // of the current body
  Builder* builder_ = nullptr;
  Map local_by_name_, temp_by_name_, label_by_name_;
  uint32_t result_ = ~0u;
};

}  // namespace rung::ir::text_form

// SPDX-License-Identifier: Apache-2.0
// The printer of IR text, a class in two files: types and items in text_printer.cpp, the code of bodies in
// text_code_printer.cpp. Internal to them.
#pragma once

#include <charconv>
#include <unordered_set>

#include "ir/builder.h"
#include "ir/text.h"
#include "ir/text_keywords.h"

namespace rung::ir::text_form {

using types::TypeTable;

class Printer {
 public:
  explicit Printer(const Module& module) : module_(module), types_(module.types) {}
  std::string out;

  void printModule();
  void printBody(const Body& body);
  void nameTypesOf(const Body& body);
  void nameRecords();

 private:
  // ---- characters
  void put(std::string_view text) { out += text; }
  void number(uint64_t value) {
    char digits[24];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  void signedNumber(int64_t value) {
    char digits[24];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  void name(std::string_view text);
  void name(NameId id) { name(module_.names.string(id)); }
  // The name of a task or program instance; `t.2` is the second one of that name, in another resource.
  template <class T>
  void numbered(const T& all, uint32_t index) {
    name(all[index].name);
    uint32_t count = 1;
    for (uint32_t i = 0; i < index; ++i) count += all[i].name == all[index].name ? 1 : 0;
    if (count == 1) return;
    put(".");
    number(count);
  }
  void programName(uint32_t index);
  void quoted(std::string_view text, char quote);
  void newLine() {
    out += '\n';
    out.append(indent_ * 2, ' ');
  }

  // ---- types
  void collect(TypeId type);
  void giveName(TypeId type, NameId wanted);
  void type(TypeId type);
  void typeDeclarations();
  void record(TypeId type, const Record* listed);

  // ---- module items
  void origin(const Origin& origin, Loc loc);
  void items();
  void clause(const char* word, uint64_t value);
  void clause(const char* word, NameId value);
  void clause(const char* word, BodyId value);
  void dataItem(size_t index);
  void task(uint32_t index);
  void taskCalls(uint32_t index);
  void ioModule(const types::IoModule& module);
  void instance(uint32_t index);
  void located(const Located& located);
  void classes();
  void header(const Body& body);

  // ---- code
  void block(StmtId first);
  bool givesResult(const Stmt& stmt) const;
  void optionalBlock(const char* words, StmtId first);
  void stmt(const Stmt& stmt);
  void callStmt(const CallStmt& call);
  void switchStmt(const SwitchStmt& node);
  void forStmt(const ForStmt& node);
  void tryStmt(const TryStmt& node);
  void assertStmt(const AssertStmt& node);
  void expr(ExprId id, TypeId expected);
  void place(const Expr& expr);
  void localName(const Local& local);
  void operand(ExprId id, TypeId expected);
  void prefixed(const char* word, const Expr& expr, TypeId of);
  void constant(const Expr& expr, TypeId expected);
  void scalar(const types::Value& value);
  void real(const types::Value& value, types::TypeKind kind);
  void checks(const Expr& expr);
  void calleeOperands(const Body& callee, Slice<ExprId> operands);
  TypeId typeOf(ExprId id) const { return body_->expr(id).type; }

  const Module& module_;
  const TypeTable& types_;
  const Body* body_ = nullptr;
  size_t indent_ = 0;
  std::vector<std::string> type_names_;  // by TypeId: `@Color`
  std::vector<bool> collected_;
  std::vector<TypeId> declared_;  // enumerations, subranges and records outside Module::records, in order of use
  std::unordered_set<std::string> used_names_;
  std::unordered_set<uint32_t> local_names_;
};

}  // namespace rung::ir::text_form

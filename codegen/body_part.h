// SPDX-License-Identifier: Apache-2.0
// All writers of a body share this: the state of the body being written, names, and questions to its analyses. In: a
// body and its analyses. Out: its statements as C++ that is a value (cxx/nodes.h), in BodyState. BodyPart is the base
// of the writers (body_parts.h), which call each other through it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/analysis.h"
#include "codegen/cxx/nodes.h"
#include "codegen/group.h"
#include "codegen/names.h"
#include "codegen/types.h"

namespace rung::codegen {

struct BodyParts;
class ExpressionWriter;
class PlaceWriter;
class StringWriter;
class CallWriter;
class CheckWriter;
class StatementWriter;

// Where bodies are written to.
struct BodyContext {
  const ir::Module& module;
  const EmitOptions& options;
  const Facts& facts;
  Group& group;
  Marks& marks;
  uint32_t group_number;
};

// The body in work.
struct BodyState {
  BodyState(const BodyContext& context, const ir::Body& of, const BodyAnalysis& found, cxx::Tree& cpp)
      : in(context), body(of), analysis(found), tree(cpp) {}
  const BodyContext& in;
  const ir::Body& body;
  const BodyAnalysis& analysis;
  cxx::Tree& tree;
  // A statement begins: what is added next begins the line of that place in the source.
  void begin(cxx::Position at);
  void add(cxx::Stmt* stmt);
  void add(const cxx::Statements& list);

  BodyParts* parts = nullptr;
  cxx::Statements* to = nullptr;                           // where statements go
  cxx::Statements declarations;                            // the variables at the top
  std::vector<std::pair<uint32_t, cxx::Ex>> materialized;  // expression, variable that holds its string
  struct Mangled {
    uint32_t name = ~0u;
    std::string_view text;
  };
  std::array<Mangled, 64> mangled;  // names of late, each where its number says
  FileId last_file;                 // and its number in the tree
  uint32_t last_file_number = 0;
  bool begins = false;  // at `at`, and nothing was added since
  cxx::Position at;
  bool uses_fault = false, uses_leave = false;  // the exits that something jumps to
  uint32_t names_created = 0;
};

class BodyPart {
 public:
  explicit BodyPart(BodyState& state)
      : state_(state),
        module_(state.in.module),
        types_(module_.types),
        options_(state.in.options),
        facts_(state.in.facts),
        group_(state.in.group),
        body_(&state.body),
        analysis_(&state.analysis),
        tree_(state.tree) {}

 protected:
  using Body = ir::Body;
  using Expr = ir::Expr;
  using ExprId = ir::ExprId;
  using ExprKind = ir::ExprKind;
  using Stmt = ir::Stmt;
  using StmtId = ir::StmtId;
  using StmtKind = ir::StmtKind;
  using Op = types::Op;
  using TypeKind = types::TypeKind;
  using Ex = cxx::Ex;
  using Operator = cxx::Op;

  ExpressionWriter& values() const;
  PlaceWriter& places() const;
  StringWriter& strings() const;
  CallWriter& calls() const;
  CheckWriter& checks() const;
  StatementWriter& statements() const;

  // ---- names
  void includeRecord(TypeId type);
  void call(ir::BodyId id);  // adds it to the declarations of the group
  std::string newName(const char* prefix);
  // Declares a variable at the top of the function; `type` and `name` are copied.
  cxx::Variable* declare(std::string_view type, std::string_view name, Ex value = nullptr);
  cxx::Variable* declare(const cxx::Type& type, std::string_view name, Ex value = nullptr);
  Ex newVariable(TypeId type, const char* prefix);
  void variable(std::string& out, const ir::Local& local) const;
  Ex variable(const ir::Local& local);
  std::string mangled(NameId name) const;
  std::string_view keptMangled(NameId name);  // in the tree
  Ex mangledName(NameId name) { return tree_.fixed(keptMangled(name)); }

  // ---- what the analyses found
  uint8_t wideOf(ExprId place) const;  // the bits of the C++ local, where it is wider than the type
  bool isCached(ExprId place) const;   // a field that lives in a C++ local
  bool isWrittenBack(uint32_t number) const;
  Ex writeBack(uint32_t number);  // of a cached field: its assignment
  bool hasExit() const;           // something to be done before it returns
  bool isSlice(ExprId place) const;
  bool isMeasured(ExprId place) const { return lengths().isMeasured(place); }
  bool isKnown(ExprId place) const { return analysis_->lengths.at(place); }
  bool returnsLength(uint32_t variable) const;                         // an in-out: at the exits
  bool isPassedOnce(const ir::CallStmt* call, uint32_t string) const;  // so that its new length is known after the call
  StringsOfBody lengths() const { return {module_, *body_, analysis_->uses.variables, analysis_->measured}; }

  // ---- nodes and types
  const Expr& expr(ExprId id) const { return body_->expr(id); }
  const types::Field& fieldOf(const ir::FieldExpr& place) const {
    return types_.info(types_.resolve(expr(place.base).type)).fields[place.field];
  }
  TypeKind kindOf(ExprId id) const { return types_.plainKind(expr(id).type); }
  uint32_t widthOf(TypeKind kind) const { return types::TypeTable::bitWidth(kind); }
  bool isString(TypeId type) const { return types::TypeTable::isString(types_.kind(type)); }
  bool isWide(TypeId type) const { return types_.kind(type) == TypeKind::WString; }
  bool isUtf8(TypeId type) const { return types_.kind(type) == TypeKind::UString; }
  bool isAggregate(TypeId type) const {
    const TypeKind kind = types_.kind(type);
    return kind == TypeKind::Array || kind == TypeKind::Record;
  }
  uint32_t capacityOf(TypeId type) const { return types_.info(types_.resolve(type)).length; }
  std::string_view string(NameId name) const { return module_.names.string(name); }

  // ---- C++
  void add(cxx::Stmt* stmt) { state_.add(stmt); }
  void add(const cxx::Statements& list) { state_.add(list); }
  void perform(Ex expression) { add(tree_.stmt(cxx::StmtKind::Expression, expression)); }
  void assign(Ex to, Ex value) { perform(tree_.infix(Operator::Assign, to, value)); }
  void clear(Ex variable) { perform(tree_.call("memset", {addressOf(variable), tree_.number(0), sizeOf(variable)})); }
  Ex constantOf(TypeId type, uint64_t bits);
  Ex quoted(std::string_view text, bool wide = false);
  Ex sizeOf(Ex variable) { return tree_.prefix("sizeof ", variable); }
  Ex addressOf(Ex place) { return tree_.prefix("&", place); }
  Ex target(Ex pointer) { return tree_.group(tree_.prefix("*", pointer)); }
  Ex raiseNoted();  // the fault that a check noted in `at` and `value`
  // `type` of C++.
  std::string pointerTo(TypeId type, bool constant = false);
  // The statements that f adds.
  template <class F>
  cxx::Statements nested(F&& f) {
    cxx::Statements list;
    cxx::Statements* const outer = state_.to;
    const bool outer_begins = state_.begins;
    state_.to = &list;
    state_.begins = false;
    f();
    if (state_.begins) add(tree_.stmt(cxx::StmtKind::Nothing));
    state_.to = outer;
    state_.begins = outer_begins;
    return list;
  }

  BodyState& state_;
  const ir::Module& module_;
  const types::TypeTable& types_;
  const EmitOptions& options_;
  const Facts& facts_;
  Group& group_;
  const Body* body_;
  const BodyAnalysis* analysis_;
  cxx::Tree& tree_;
};

}  // namespace rung::codegen

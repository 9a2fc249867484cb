// SPDX-License-Identifier: Apache-2.0
// All writers of a body share this: the state of the body being written, names, and questions to its analyses. In: a
// body and its analyses. Out: code in BodyState. BodyPart is the base of the writers (body_parts.h), which call each
// other through it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "codegen/analysis.h"
#include "codegen/group.h"
#include "codegen/names.h"
#include "codegen/types.h"

namespace rung::codegen {

// Precedence of C++ expressions, low to high: an operand of lower precedence than its context gets parentheses.
enum class Prec : uint8_t { Comma, Ternary, Or, And, Bit, Equality, Relation, Shift, Sum, Product, Unary, Postfix };

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
  BodyState(const BodyContext& context, const ir::Body& of, const BodyAnalysis& found)
      : in(context), body(of), analysis(found) {}
  const BodyContext& in;
  const ir::Body& body;
  const BodyAnalysis& analysis;
  BodyParts* parts = nullptr;
  std::string out;                                             // the statements
  std::string declarations;                                    // the variables at the top
  std::vector<std::pair<uint32_t, std::string>> materialized;  // expression, variable that holds its string
  bool uses_fault = false, uses_leave = false;                 // the exits that something jumps to
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
        out_(state.out),
        declarations_(state.declarations) {}

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
  std::string newVariable(TypeId type, const char* prefix);
  void variable(std::string& out, const ir::Local& local) const;

  // ---- what the analyses found
  uint8_t wideOf(ExprId place) const;  // the bits of the C++ local, where it is wider than the type
  bool isCached(ExprId place) const;   // a field that lives in a C++ local
  bool isWrittenBack(uint32_t number) const;
  void writeBack(std::string& out, uint32_t number) const;  // of a cached field: a statement
  bool hasExit() const;                                     // something to be done before it returns
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
  void parenthesis(Prec own, Prec context) {
    if (own < context) out_ += '(';
  }
  void closeParenthesis(Prec own, Prec context) {
    if (own < context) out_ += ')';
  }
  // Returns what f writes.
  template <class F>
  std::string captured(F&& f) {
    std::string outer;
    outer.swap(out_);
    f();
    outer.swap(out_);
    return outer;
  }

  BodyState& state_;
  const ir::Module& module_;
  const types::TypeTable& types_;
  const EmitOptions& options_;
  const Facts& facts_;
  Group& group_;
  const Body* body_;
  const BodyAnalysis* analysis_;
  std::string& out_;
  std::string& declarations_;
};

}  // namespace rung::codegen

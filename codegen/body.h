// Writes one IR body as a C++ function. In: a verified body and the facts of the module. Out: code in the group, and
// what the group must include and declare for it. Called by emit.cpp for each body of a group.
//
// Layout: all variables are declared at the top (a `goto` never crosses an initialisation), then the statements, each
// after its checks, then the exits:
//   void Ramp_body(Ramp_type& self, rung_context* ctx) {
//     float y_ = self.y_;  uint32_t at;  int64_t value;      scalars of the instance that live in locals (locals.h)
//     RUNG_CHECK(bad, site << 3 | kind, value)               jumps to fault:
//   leave: self.y_ = y_; return;
//   fault: self.y_ = y_; rung_raise(ctx, …);
//   }
// The methods are defined in the files named at their groups.
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

class BodyWriter {
 public:
  BodyWriter(const ir::Module& module, const EmitOptions& options, const Facts& facts, Group& group, Marks& marks,
             uint32_t group_number)
      : module_(module),
        types_(module.types),
        options_(options),
        facts_(facts),
        group_(group),
        marks_(marks),
        group_number_(group_number) {}

  // Appends to group.code.
  void write(ir::BodyId id);

  // `float Scale_fn(rung_context* ctx, int16_t raw_)`, without `;`. Native: as the library defines it.
  static void appendSignature(std::string& out, const ir::Module& module, const ir::Body& body) {
    appendSignature(out, module, body, {});
  }
  // Under another name; a native body with another type of its instance than void.
  static void appendSignature(std::string& out, const ir::Module& module, const ir::Body& body, std::string_view name,
                              std::string_view self = {});

 private:
  using Body = ir::Body;
  using Expr = ir::Expr;
  using ExprId = ir::ExprId;
  using ExprKind = ir::ExprKind;
  using Stmt = ir::Stmt;
  using StmtId = ir::StmtId;
  using StmtKind = ir::StmtKind;
  using Op = types::Op;
  using TypeKind = types::TypeKind;

  // ---- body.cpp: the function around the statements
  void declareVariables();
  void declareLocal(uint32_t number);
  void declareCached(uint32_t number);
  bool isWrittenBack(uint32_t number) const;
  bool writesFieldsBack() const;
  void writeBack(std::string& out);
  void writeExits();
  void includeRecord(TypeId type);
  void call(ir::BodyId id);  // adds it to the declarations of the group
  std::string newName(const char* prefix);
  std::string newVariable(TypeId type, const char* prefix);

  // ---- measured.cpp: strings with their lengths in C++ locals
  void declareLengths();
  void countLengths(StmtId id);
  void lengthName(ExprId place);
  void stringLength(ExprId string);
  // `form`: `sized` or `slice`.
  void sizedCall(const Body& callee, Slice<ExprId> operands, const char* form = "sized");
  void sliceName(ExprId place);
  void assignSlice(ExprId to, ExprId from);

  // ---- what the analyses found
  uint8_t wideOf(ExprId place) const;  // the bits of the C++ local, where it is wider than the type
  bool isCached(ExprId place) const;   // a field that lives in a C++ local
  bool isSlice(ExprId place) const;
  bool isMeasured(ExprId place) const { return strings().isMeasured(place); }
  bool isKnown(ExprId place) const { return analysis_->lengths.at(place); }
  StringsOfBody strings() const { return {module_, *body_, analysis_->uses.variables, analysis_->measured}; }

  // ---- statements.cpp
  void block(StmtId first);
  void statement(StmtId id, const Stmt& stmt);
  void begin(Loc loc);  // starts a statement from that location: line breaks and #line
  void open();          // ` {` and one more level of indentation
  void close();         // `}`, written where the next statement begins
  void flushCloses(uint32_t lines);
  void bindStatement(const ir::BindStmt& stmt);
  void ifStatement(const ir::IfStmt& stmt);
  void deepIf(const ir::IfStmt& stmt);
  void switchStatement(const ir::SwitchStmt& stmt);
  void tryStatement(const ir::TryStmt& stmt);
  void assertStatement(const Stmt& stmt);
  void guarded(const std::string& frame, const std::string& fault, StmtId first);
  void faultStatement(const ir::FaultStmt& stmt, Loc loc);
  void leave();
  bool endsInJump(StmtId first) const;

  // ---- calls.cpp
  struct CallPlan {
    enum class Form : uint8_t { Direct, Virtual, Sized, Slice };  // the last two: lengths.cpp, slices.cpp
    enum class Way : uint8_t { Value, Reference, Copy };          // Copy: through a variable
    enum class Result : uint8_t { None, Value, InPlace, Copied };
    struct Argument {
      const ir::Local* parameter;
      ExprId operand;
      Way way;
    };
    Form form = Form::Direct;
    Result result = Result::None;
    bool is_measured = false;  // the result's length lives in a local: the call returns it, or it is counted
    std::vector<Argument> arguments;
  };
  struct CallText {
    std::string before, after;  // the copies of arguments
    std::string arguments, result;
    std::string copy;    // the variable that takes the result, or empty
    std::string length;  // the local that takes the result's length
  };
  CallPlan planCall(const ir::CallStmt& stmt) const;
  bool writesInPlace(const ir::CallStmt& stmt) const;
  void callStatement(const ir::CallStmt& stmt, Loc loc);
  void sliceCall(const ir::CallStmt& stmt);
  void passArguments(const CallPlan& plan, CallText& text);
  void passCopy(const CallPlan::Argument& argument, CallText& text);
  void passResult(const ir::CallStmt& stmt, const CallPlan& plan, CallText& text);
  void callFunction(const ir::CallStmt& stmt, const CallPlan& plan, const CallText& text);
  void copyResult(ExprId to, TypeId from, const CallText& text);
  void callExpr(const Expr& expr);
  void dispatch(const ir::CallStmt& stmt, Loc loc);
  std::string indexOfMethod(const ir::CallStmt& stmt);
  void classCheck(const ir::CallStmt& stmt, Loc loc);

  // ---- loops.cpp
  void loopStatement(const ir::LoopStmt& stmt);
  void forStatement(StmtId id, const ir::ForStmt& stmt);
  void countedFor(const ir::ForStmt& stmt, bool fits);
  void breakLoop();
  void continueLoop();
  ExprId exitTest(StmtId id) const;

  // ---- expressions.cpp
  void value(ExprId id, Prec context);
  void condition(ExprId id, Prec context);
  void constant(const Expr& expr, Prec context);
  void unary(ExprId id, Prec context);
  void binary(ExprId id, Prec context);
  void function(std::string_view name, const ir::BinaryExpr& node);  // name(left, right)
  void realOperation(const ir::BinaryExpr& node, Prec context);
  void bitwise(const ir::BinaryExpr& node, Prec context);
  void extreme(const ir::BinaryExpr& node);  // MIN, MAX
  void differs(const ir::BinaryExpr& node, Prec context);
  void loadBits(const ir::BitsExpr& node, TypeKind kind);
  void logical(const ir::BinaryExpr& node, Prec context);
  void comparison(const ir::BinaryExpr& node, Prec context);
  void leftOfEquality(ExprId id);

  // ---- arithmetic.cpp
  void arithmetic(ExprId id, Prec context);  // + - * and negation of integers
  void modular(ExprId id, bool wide, Prec context);
  void plain(ExprId id, Prec context);  // in int, which holds every intermediate value
  void inPlainOrModular(ExprId id, uint32_t width);
  uint32_t plainBits(ExprId id) const;
  bool isChain(const Expr& expr) const;  // an operand of such an operator that may join its expression
  void divide(const ir::BinaryExpr& node, Prec context);
  void shift(const Expr& expr, Prec context);
  void power(const Expr& expr);

  // ---- conversions.cpp
  void convert(ExprId id, Prec context);
  void convertScalar(TypeId type, ExprId from, Prec context);
  template <class F>
  void cast(std::string_view type, Prec context, F&& f);
  void scalarOfString(TypeId type, ExprId from, Prec context);
  void truthOf(ExprId from, Prec context);
  void roundReal(TypeId type, ExprId from, Prec context);
  void resizeInteger(TypeId type, ExprId from, Prec context);
  void convertTime(ExprId from, TypeKind source, TypeKind target);
  void scalarBits(ExprId id);         // as uint64_t, for the runtime's generic functions
  void materializeString(ExprId id);  // into a variable of its own

  // ---- checks.cpp
  // The checks of an expression and the strings that must be made first, in order of evaluation.
  void prepare(ExprId id);
  void prepareChildren(const Expr& expr);
  bool needsPreparation(ExprId id) const;
  void checks(ExprId id, const Expr& expr);
  void indexChecks(const Expr& expr);
  void nullCheck(const Expr& expr);
  void divisionCheck(const Expr& expr);
  void convertCheck(const Expr& expr);
  void subrangeCheck(const Expr& expr);
  void overflowCheck(ExprId id);
  uint32_t site(Loc loc, types::Fault fault, int64_t low = 0, int64_t high = 0);
  // `RUNG_CHECK(`, the condition, then `, site, `, the value and `); `.
  void beginCheck() { out_ += "RUNG_CHECK("; }
  void endCheck(Loc loc, types::Fault fault, std::string_view value, int64_t low = 0, int64_t high = 0);

  // ---- places.cpp
  void place(ExprId id);  // an lvalue; for a string: a pointer to its units
  void localPlace(const ir::Local& local);
  void blockPlace(TypeId record, uint32_t number, std::string_view suffix);
  void fieldPlace(ExprId id);
  void elementPlace(const ir::IndexExpr& node);
  void targetPlace(ExprId pointer, TypeId type);
  void member(ExprId base);  // `self.`, `x_->`
  void indexValue(ExprId id, const types::Dimension& dimension);
  ExprId peelIndex(ExprId id, const types::Dimension& dimension, int64_t& addend) const;
  bool isImagePlace(ExprId id) const;
  void area(uint32_t index);
  void imageAddress(ExprId id);  // a uint8_t* without const
  void imageLoad(ExprId id, const Expr& expr);
  void imageStore(ExprId place, std::string_view value);
  void storeBits(const ir::BitsExpr& node, TypeKind kind, std::string_view value);
  bool isLvalue(ExprId id) const;
  // `place = value` as an expression without `;` for a scalar; `value` is C++ code of the right type.
  void store(ExprId place, std::string_view value);
  void reference(const ir::Local& parameter, ExprId operand);  // as an argument
  void variable(std::string& out, const ir::Local& local) const;
  bool isVariableTruth(ExprId id) const;  // a BOOL that is 0 or 1 in its memory

  // ---- strings.cpp
  void assign(const ir::AssignStmt& stmt);
  void prepareString(ExprId from);  // except for the parts that copyString handles itself
  struct StringTarget {
    std::string_view name;
    uint32_t capacity;
    bool wide;
    std::string_view length;  // the name of the C++ local that takes the new length, or empty
  };
  void copyString(const StringTarget& target, ExprId from);
  void beginCopy(const StringTarget& target, std::string_view function, uint32_t limit);
  void copyLiteral(const StringTarget& target, std::string_view literal, bool utf8);
  void copyVariable(const StringTarget& target, ExprId from);
  void stringValue(ExprId id);  // a const char* or const char16_t*
  void compareStrings(const ir::BinaryExpr& node, Prec context);
  bool isBuffer(ExprId id, uint32_t& capacity) const;  // a string in memory whose capacity is that of its type
  uint32_t literalLength(const Expr& string) const;
  void dataReference(uint32_t index);

  // ---- small helpers
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

  const ir::Module& module_;
  const types::TypeTable& types_;
  const EmitOptions& options_;
  const Facts& facts_;
  Group& group_;
  Marks& marks_;
  uint32_t group_number_;

  const Body* body_ = nullptr;
  const BodyAnalysis* analysis_ = nullptr;
  std::string out_;           // the statements
  std::string declarations_;  // the variables at the top
  std::vector<uint32_t> blocks_declared_;
  uint32_t areas_declared_ = 0;                                 // a bit for each
  std::vector<std::pair<uint32_t, std::string>> materialized_;  // expression, variable that holds its string
  bool uses_fault_ = false, uses_leave_ = false;
  uint32_t names_created_ = 0;

  // The targets of break and continue.
  struct Loop {
    bool in_switch = false;  // inside a switch of this loop
    bool breaks_by_goto = false, continues_by_goto = false;
    bool has_next = false;
    uint32_t try_depth = 0;
    uint32_t number = 0;
  };
  std::vector<Loop> loops_;
  struct TryFrame {
    std::string exit;  // the variable that records how the frame was left: 1 return, 2 break, 3 continue
    bool returns = false, breaks = false, continues = false;
  };
  std::vector<TryFrame> frames_;

  // The current position in the output.
  uint32_t depth_ = 1;
  uint32_t closes_ = 0;  // braces still to be closed
  FileId line_file_;
  uint32_t line_ = 0;  // 0: unknown to the reader
};

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// The writers of a body, a class for each subject; what they share is in body_part.h. Internal to codegen/: body.cpp
// makes them for each body, and they call each other.
#pragma once

#include "codegen/body_part.h"

namespace rung::codegen {

// Values of expressions: expressions.cpp, arithmetic.cpp, contacts.cpp, conversions.cpp.
class ExpressionWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  void value(ExprId id, Prec context);
  void condition(ExprId id, Prec context);
  void scalarBits(ExprId id);  // as uint64_t, for the runtime's generic functions
  // Contacts: a condition that costs less without jumps.
  bool isContacts(ExprId id) const;
  void bitAt(ExprId contacts, uint32_t position, Prec context);

 private:
  void constant(const Expr& expr, Prec context);
  void unary(ExprId id, Prec context);
  void binary(ExprId id, Prec context);
  void function(std::string_view name, const ir::BinaryExpr& node);  // name(left, right)
  void realOperation(const ir::BinaryExpr& node, Prec context);
  void bitwise(const ir::BinaryExpr& node, Prec context);
  void extreme(const ir::BinaryExpr& node);  // MIN, MAX
  void differs(const ir::BinaryExpr& node, Prec context);
  void loadBits(const ir::BitsExpr& node, TypeKind kind);
  void logical(ExprId id, Prec context);
  bool isPlainRead(ExprId id) const;
  bool readsWithoutJumps(ExprId id, uint32_t& steps, bool& any_bit) const;
  void bits(ExprId id, uint32_t position, Op within);
  bool isSingleBit(ExprId id) const;
  uint32_t positionOf(ExprId contacts) const;
  bool isOnlyBits(ExprId id, uint32_t& highest) const;
  void comparison(const ir::BinaryExpr& node, Prec context);
  void leftOfEquality(ExprId id);
  void arithmetic(ExprId id, Prec context);  // + - * and negation of integers
  void modular(ExprId id, bool wide, Prec context);
  void plain(ExprId id, Prec context);  // in int, which holds every intermediate value
  void inPlainOrModular(ExprId id, uint32_t width);
  uint32_t plainBits(ExprId id) const;
  bool isUncut(ExprId id) const;
  bool isChain(const Expr& expr) const;  // an operand of such an operator that may join its expression
  void divide(const ir::BinaryExpr& node, Prec context);
  void shift(const Expr& expr, Prec context);
  void shiftSigned(const Expr& expr, Prec context);
  void power(const Expr& expr);
  void convert(ExprId id, Prec context);
  void convertScalar(TypeId type, const ir::ConvertExpr& node, Prec context);
  template <class F>
  void cast(std::string_view type, Prec context, F&& f);
  void scalarOfString(TypeId type, ExprId from, Prec context);
  void truthOf(ExprId from, Prec context);
  void roundReal(TypeId type, ExprId from, types::Rounding rounding, Prec context);
  void resizeInteger(TypeId type, ExprId from, Prec context);
  void convertTime(ExprId from, TypeKind source, TypeKind target);
};

// Lvalues, arguments by reference, constant bytes: places.cpp, image.cpp.
class PlaceWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  void place(ExprId id);     // an lvalue; for a string: a pointer to its units
  void member(ExprId base);  // `self.`, `x_->`
  void indexValue(ExprId id, const types::Dimension& dimension);
  bool isImagePlace(ExprId id) const;
  void imageAddress(ExprId id);  // a uint8_t* without const
  void imageLoad(ExprId id, const Expr& expr);
  bool isLvalue(ExprId id) const;
  // `place = value` as an expression without `;` for a scalar; `value` is C++ code of the right type.
  void store(ExprId place, std::string_view value);
  // A coil: the place is a bit of the image, the value one of contacts.
  void storeBit(ExprId place, ExprId value);
  void imageByte(const ir::ImageExpr& image);
  // held_bytes.h: around each statement.
  void holdBytes(StmtId id);
  bool holdsBytesFrom(StmtId id) const;
  bool releasesBytes(StmtId id) const;
  void releaseBytes(StmtId id);
  void reference(const ir::Local& parameter, ExprId operand);  // as an argument
  void plainReference(const ir::Local& parameter, ExprId operand);
  bool isVariableTruth(ExprId id) const;  // a BOOL that is 0 or 1 in its memory
  void dataReference(uint32_t index);

 private:
  void localPlace(const ir::Local& local);
  void blockPlace(TypeId record, uint32_t number, std::string_view suffix);
  void fieldPlace(ExprId id);
  void elementPlace(const ir::IndexExpr& node);
  void targetPlace(ExprId pointer, TypeId type);
  ExprId peelIndex(ExprId id, const types::Dimension& dimension, int64_t& addend) const;
  void area(uint32_t index);
  void memoryByte(uint32_t area, uint32_t byte);
  struct Held {
    const HeldByte* byte;
    std::string name;
    uint8_t cleared;  // bits that are 0 and not yet written
  };
  Held* heldFor(const ir::ImageExpr& image);
  void putBit(const ir::ImageExpr& image, std::string_view value_bits);
  void imageStore(ExprId place, std::string_view value);
  void storeBits(const ir::BitsExpr& node, TypeKind kind, std::string_view value);

  std::vector<uint32_t> blocks_declared_;
  uint32_t areas_declared_ = 0;  // a bit for each
  std::vector<Held> held_;
  size_t held_begun_ = 0;  // of the analysis
};

// Strings, their lengths and slices: strings.cpp, measured.cpp.
class StringWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;
  // Where a string is copied to.
  struct StringTarget {
    std::string_view name;
    uint32_t capacity;
    bool wide;
    std::string_view length;  // the name of the C++ local that takes the new length, or empty
  };

  void declareLengths();
  void countLengths(StmtId id);
  void forgetLengths(StmtId id);
  void returnLengths();
  void lengthName(ExprId place);
  void stringLength(ExprId string);
  // `form`: `sized` or `slice`.
  void sizedCall(const Body& callee, Slice<ExprId> operands, const char* form = "sized");
  void sliceName(ExprId place);
  void assignSlice(ExprId to, ExprId from);
  void materializeString(ExprId id);  // into a variable of its own
  void prepareString(ExprId from);    // except for the parts that copyString handles itself
  void copyString(const StringTarget& target, ExprId from);
  void stringValue(ExprId id);  // a const char* or const char16_t*
  void compareStrings(const ir::BinaryExpr& node, Prec context);

 private:
  void beginCopy(const StringTarget& target, std::string_view function, uint32_t limit);
  void copyLiteral(const StringTarget& target, std::string_view literal, bool utf8);
  void copyVariable(const StringTarget& target, ExprId from);
  void lengthName(uint32_t variable);
  bool isBuffer(ExprId id, uint32_t& capacity) const;  // a string in memory whose capacity is that of its type
  uint32_t literalLength(const Expr& string) const;
};

// Calls: calls.cpp.
class CallWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  void callStatement(StmtId id);
  void callExpr(const Expr& expr);

 private:
  struct CallPlan {
    enum class Form : uint8_t { Direct, Virtual, Sized, Slice };  // the last two: lengths.h, slices.h
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
    std::string lengths;  // after the call: those of the in-outs
    std::string copy;     // the variable that takes the result, or empty
    std::string length;   // the local that takes the result's length
  };
  CallPlan planCall(const ir::CallStmt& stmt) const;
  bool writesInPlace(const ir::CallStmt& stmt) const;
  void noteCall(const ir::CallStmt& stmt, Loc loc);
  void sliceCall(const ir::CallStmt& stmt);
  void appendText(const ir::CallStmt& make, ExprId to);
  void passArguments(const ir::CallStmt& stmt, const CallPlan& plan, CallText& text);
  void passCopy(const CallPlan::Argument& argument, CallText& text);
  void passLength(const ir::CallStmt& stmt, ExprId operand, CallText& text);
  void passResult(const ir::CallStmt& stmt, const CallPlan& plan, CallText& text);
  void callFunction(const ir::CallStmt& stmt, const CallPlan& plan, const CallText& text);
  void copyResult(ExprId to, TypeId from, const CallText& text);
  void dispatch(const ir::CallStmt& stmt, Loc loc);
  std::string indexOfMethod(const ir::CallStmt& stmt);
  void classCheck(const ir::CallStmt& stmt, Loc loc);
};

// Checks and strings that are made in front of a statement: checks.cpp.
class CheckWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  // The checks of an expression and the strings that must be made first, in order of evaluation.
  void prepare(ExprId id);
  void prepareChildren(const Expr& expr);
  bool needsPreparation(ExprId id) const;
  // A row of the site table: its number in the group.
  uint32_t addSite(Loc loc, int64_t low = 0, int64_t high = 0);
  // The number of a check: its row and the kind of fault.
  uint32_t site(Loc loc, types::Fault fault, int64_t low = 0, int64_t high = 0);
  // `RUNG_CHECK(`, the condition, then `, site, `, the value and `); `.
  void beginCheck() { out_ += "RUNG_CHECK("; }
  void endCheck(Loc loc, types::Fault fault, std::string_view value, int64_t low = 0, int64_t high = 0);

 private:
  void checkNode(ExprId id, const Expr& expr);
  void prepareElement(const Expr& expr);
  void indexCheck(Loc loc, ExprId index, const types::Dimension& dimension);
  void nullCheck(const Expr& expr);
  void divisionCheck(const Expr& expr);
  void convertCheck(const Expr& expr);
  void subrangeCheck(const Expr& expr);
  void overflowCheck(ExprId id);
};

// Statements, their lines and loops: statements.cpp, loops.cpp.
class StatementWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  void block(StmtId first);
  void flushCloses(uint32_t lines);
  void stepOfCall();

 private:
  void statement(StmtId id, const Stmt& stmt);
  void write(StmtId id, const Stmt& stmt);
  void begin(Loc loc);  // starts a statement from that location: line breaks and #line
  void open();          // ` {` and one more level of indentation
  void close();         // `}`, written where the next statement begins
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
  void loopStatement(const ir::LoopStmt& stmt, Loc loc);
  void forStatement(StmtId id, const ir::ForStmt& stmt);
  void countedFor(const ir::ForStmt& stmt, bool fits, Loc loc);
  void breakLoop();
  void continueLoop();
  ExprId exitTest(StmtId id) const;
  bool countsSteps() const { return options_.counts_steps && !(body_->library && body_->pure); }
  void step(Loc loc);
  void stepsOf(Loc loc, const std::string& count);
  void assign(const ir::AssignStmt& stmt);

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

// The function around the statements: body.cpp.
class FunctionWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  void write(ir::BodyId id);  // appends to group.code

 private:
  void declareVariables();
  void declareLocal(uint32_t number);
  void declareCached(uint32_t number);
  void writeAllBack(std::string& out);
  void writeExits();
  void writeHead(ir::BodyId id);
};

struct BodyParts {
  explicit BodyParts(BodyState& state)
      : values(state), places(state), strings(state), calls(state), checks(state), statements(state) {
    state.parts = this;
  }
  ExpressionWriter values;
  PlaceWriter places;
  StringWriter strings;
  CallWriter calls;
  CheckWriter checks;
  StatementWriter statements;
};

inline ExpressionWriter& BodyPart::values() const { return state_.parts->values; }
inline PlaceWriter& BodyPart::places() const { return state_.parts->places; }
inline StringWriter& BodyPart::strings() const { return state_.parts->strings; }
inline CallWriter& BodyPart::calls() const { return state_.parts->calls; }
inline CheckWriter& BodyPart::checks() const { return state_.parts->checks; }
inline StatementWriter& BodyPart::statements() const { return state_.parts->statements; }

}  // namespace rung::codegen

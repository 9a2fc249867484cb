// SPDX-License-Identifier: Apache-2.0
// The writers of a body, a class for each subject: each makes C++ that is a value; what they share is in body_part.h.
// Internal to codegen/: body.cpp makes them for each body, and they call each other.
#pragma once

#include "codegen/body_part.h"

namespace rung::codegen {

// Values of expressions: expressions.cpp, arithmetic.cpp, contacts.cpp, conversions.cpp.
class ExpressionWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  Ex value(ExprId id);
  Ex condition(ExprId id);
  Ex scalarBits(ExprId id);  // as uint64_t, for the runtime's generic functions
  // Contacts: a condition that costs less without jumps.
  bool isContacts(ExprId id) const;
  Ex bitAt(ExprId contacts, uint32_t position);

 private:
  Ex constant(const Expr& expr);
  Ex load(ExprId id);
  Ex loadBits(const ir::BitsExpr& node, TypeKind kind);
  Ex unary(ExprId id);
  Ex binary(ExprId id);
  Ex both(Operator op, const ir::BinaryExpr& node);                // left op right
  Ex function(std::string_view name, const ir::BinaryExpr& node);  // name(left, right)
  Ex extreme(const ir::BinaryExpr& node);                          // MIN, MAX
  Ex logical(ExprId id);
  Ex comparison(Operator op, const ir::BinaryExpr& node);
  bool isPlainRead(ExprId id) const;
  bool readsWithoutJumps(ExprId id, uint32_t& steps, bool& any_bit) const;
  Ex bits(ExprId id, uint32_t position);
  Ex shifted(Ex bits, uint32_t from, uint32_t to);
  bool isSingleBit(ExprId id) const;
  uint32_t positionOf(ExprId contacts) const;
  bool isOnlyBits(ExprId id, uint32_t& highest) const;
  Ex arithmetic(ExprId id);  // + - * and negation of integers
  Ex modular(ExprId id, bool wide);
  Ex plain(ExprId id);  // in int, which holds every intermediate value
  Ex plainOrModular(ExprId id, uint32_t width);
  uint32_t plainBits(ExprId id) const;
  bool isUncut(ExprId id) const;
  bool isChain(const Expr& expr) const;  // an operand of such an operator that may join its expression
  Ex divide(const ir::BinaryExpr& node);
  Ex shift(const Expr& expr);
  Ex shiftSigned(const Expr& expr);
  Ex power(const Expr& expr);
  static const char* unsignedType(uint32_t width);
  Ex castTo(TypeId type, Ex operand) { return tree_.cast(scalarType(types_, type), operand); }
  Ex convert(ExprId id);
  Ex convertScalar(TypeId type, const ir::ConvertExpr& node);
  Ex scalarOfString(TypeId type, ExprId from);
  Ex truthOf(ExprId from);
  Ex roundReal(TypeId type, ExprId from, types::Rounding rounding);
  Ex resizeInteger(TypeId type, ExprId from);
  Ex convertTime(ExprId from, TypeKind source, TypeKind target);
};

// Lvalues, arguments by reference, constant bytes: places.cpp, image.cpp.
class PlaceWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  Ex place(ExprId id);                  // an lvalue; for a string: a pointer to its units
  Ex member(ExprId base, NameId name);  // a field of a record
  Ex indexValue(ExprId id, const types::Dimension& dimension);
  bool isImagePlace(ExprId id) const;
  Ex imageAddress(ExprId id);  // a uint8_t* without const
  Ex imageLoad(ExprId id, const Expr& expr);
  bool isLvalue(ExprId id) const;
  // `place = value` for a scalar; the value has the right type.
  Ex store(ExprId place, Ex value);
  // A coil: the place is a bit of the image, the value one of contacts.
  Ex storeBit(ExprId place, ExprId value);
  Ex imageByte(const ir::ImageExpr& image);
  // held_bytes.h: around each statement.
  void holdBytes(StmtId id);
  bool holdsBytesFrom(StmtId id) const;
  bool releasesBytes(StmtId id) const;
  void releaseBytes(StmtId id);
  Ex reference(const ir::Local& parameter, ExprId operand);  // as an argument
  bool isVariableTruth(ExprId id) const;                     // a BOOL that is 0 or 1 in its memory
  Ex dataReference(uint32_t index);
  // The variable in front of the statement that holds a string or a record.
  bool isMaterialized(ExprId id) const { return find(id) != nullptr; }
  Ex materialized(ExprId id) const;

 private:
  Ex find(ExprId materialized) const;
  Ex localPlace(const ir::Local& local);
  Ex blockPlace(TypeId record, uint32_t number, std::string_view suffix);
  Ex fieldPlace(ExprId id);
  Ex elementPlace(const ir::IndexExpr& node);
  Ex targetPlace(ExprId pointer, TypeId type);
  ExprId peelIndex(ExprId id, const types::Dimension& dimension, int64_t& addend) const;
  Ex plainReference(const ir::Local& parameter, ExprId operand);
  Ex area(uint32_t index);
  Ex memoryByte(uint32_t area, uint32_t byte);
  struct Held {
    const HeldByte* byte;
    Ex name;
    uint8_t cleared;  // bits that are 0 and not yet written
  };
  Held* heldFor(const ir::ImageExpr& image);
  Ex putBit(const ir::ImageExpr& image, Ex value_bits);
  Ex imageStore(ExprId place, Ex value);
  Ex storeBits(const ir::BitsExpr& node, TypeKind kind, Ex value);

  std::vector<uint32_t> blocks_declared_;
  uint32_t areas_declared_ = 0;  // a bit for each
  std::vector<Held> held_;
  size_t held_begun_ = 0;  // of the analysis
};

// Calls: calls.cpp.
class CallWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  // A call to which arguments may be added.
  struct Parts {
    std::string function;
    std::vector<Ex> arguments;
  };
  void callStatement(StmtId id);
  Ex callExpr(const Expr& expr);
  Parts parts(const Expr& expr);

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
  struct Made {
    cxx::Statements before, after;  // the copies of arguments
    cxx::Statements lengths;        // after the call: those of the in-outs
    std::vector<Ex> arguments, results;
    Ex copy = nullptr;    // the variable that takes the result, or none
    Ex length = nullptr;  // the local that takes the result's length
  };
  CallPlan planCall(const ir::CallStmt& stmt) const;
  bool writesInPlace(const ir::CallStmt& stmt) const;
  void noteCall(const ir::CallStmt& stmt, Loc loc);
  void sliceCall(const ir::CallStmt& stmt);
  void appendText(const ir::CallStmt& make, ExprId to);
  void passArguments(const ir::CallStmt& stmt, const CallPlan& plan, Made& made);
  void passCopy(const CallPlan::Argument& argument, Made& made);
  void passLength(const ir::CallStmt& stmt, ExprId operand, Made& made);
  void passResult(const ir::CallStmt& stmt, const CallPlan& plan, Made& made);
  Ex callOf(const ir::CallStmt& stmt, const CallPlan& plan, const Made& made);
  Ex functionCall(const ir::CallStmt& stmt, const CallPlan& plan, const Made& made);
  void copyResult(ExprId to, TypeId from, const Made& made);
  void dispatch(const ir::CallStmt& stmt, Loc loc);
  Ex indexOfMethod(const ir::CallStmt& stmt);
  void classCheck(const ir::CallStmt& stmt, Loc loc);
};

// Strings, their lengths and slices: strings.cpp, measured.cpp.
class StringWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;
  // Where a string is copied to.
  struct StringTarget {
    Ex name;
    uint32_t capacity;
    bool wide;
    Ex length;  // the C++ local that takes the new length, or none
  };

  void declareLengths();
  void countLengths(StmtId id);
  void forgetLengths(StmtId id);
  void returnLengths();
  Ex lengthName(ExprId place);
  Ex stringLength(ExprId string);
  CallWriter::Parts sizedCall(const Body& callee, Slice<ExprId> operands, const char* form);  // `sized` or `slice`
  Ex sliceName(ExprId place);
  void assignSlice(ExprId to, ExprId from);
  void materializeString(ExprId id);  // into a variable of its own
  void prepareString(ExprId from);    // except for the parts that copyString handles itself
  void copyString(const StringTarget& target, ExprId from);
  const char* assignFunction(TypeId type) const;
  Ex stringValue(ExprId id);  // a const char* or const char16_t*
  Ex compareStrings(Operator op, const ir::BinaryExpr& node);
  Ex sameBytes(Ex a, Ex b, Ex count);

 private:
  void copyBy(const char* function, const StringTarget& target, uint32_t limit, std::vector<Ex> from);
  void copyLiteral(const StringTarget& target, std::string_view literal, bool utf8);
  void copyVariable(const StringTarget& target, ExprId from);
  Ex compared(bool wide, Ex a, Ex b);
  Ex hasUnit(Ex name, uint32_t i, char unit);
  Ex asEquality(Operator op, Ex test);
  Ex compareLiteral(Operator op, ExprId a, ExprId b);
  Ex lengthName(uint32_t variable);
  std::string nameOf(uint32_t variable) const;
  bool isBuffer(ExprId id, uint32_t& capacity) const;  // a string in memory whose capacity is that of its type
  uint32_t literalLength(const Expr& string) const;
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
  // `RUNG_CHECK(is_wrong, site, value)`
  void check(Ex is_wrong, Loc loc, types::Fault fault, Ex value, int64_t low = 0, int64_t high = 0);

 private:
  void checkNode(ExprId id, const Expr& expr);
  void prepareElement(const Expr& expr);
  void indexCheck(Loc loc, ExprId index, const types::Dimension& dimension);
  void nullCheck(const Expr& expr);
  void divisionCheck(const Expr& expr);
  void convertCheck(const Expr& expr);
  void subrangeCheck(const Expr& expr);
  void overflowCheck(ExprId id);
  void realOverflowCheck(ExprId id, ExprId a, ExprId b);
};

// Statements and loops: statements.cpp, loops.cpp.
class StatementWriter : public BodyPart {
 public:
  using BodyPart::BodyPart;

  void block(StmtId first);
  void stepOfCall();

 private:
  void statement(StmtId id, const Stmt& stmt);
  void write(StmtId id, const Stmt& stmt);
  cxx::Position positionOf(Loc loc);
  void begin(Loc loc);  // starts a statement from that location
  cxx::Statements blockOf(StmtId first);
  void addWithBlock(cxx::Stmt* stmt, StmtId first);
  void addGoto(std::string_view label);
  void addLabel(std::string_view label);
  // The statements that f adds, in a block.
  template <class F>
  cxx::Statements deeper(F&& f) {
    ++depth_;
    const cxx::Statements list = nested(f);
    --depth_;
    return list;
  }
  void assignStatement(const ir::AssignStmt& stmt);
  void assignAggregate(ExprId to, ExprId from);
  void bindStatement(const ir::BindStmt& stmt);
  void ifStatement(const ir::IfStmt& stmt);
  void deepIf(const ir::IfStmt& stmt);
  void switchStatement(const ir::SwitchStmt& stmt);
  void switchCases(const ir::SwitchStmt& stmt, TypeId type);
  void switchCase(const std::vector<cxx::CaseLabel>& labels, StmtId first);
  void tryStatement(const ir::TryStmt& stmt);
  void guarded(const std::string& frame, const std::string& fault, StmtId first);
  void assertStatement(const Stmt& stmt);
  cxx::Stmt* assertionReport(const Stmt& stmt);
  Ex assertionCall(const ir::AssertStmt& node);
  void faultStatement(const ir::FaultStmt& stmt, Loc loc);
  void leave();
  void leaveFrame(uint32_t how);
  bool endsInJump(StmtId first) const;

  // The targets of break and continue.
  struct Loop {
    bool in_switch = false;  // inside a switch of this loop
    bool breaks_by_goto = false, continues_by_goto = false;
    bool has_next = false;
    uint32_t try_depth = 0;
    uint32_t number = 0;
  };
  void loopStatement(const ir::LoopStmt& stmt, Loc loc);
  void forStatement(StmtId id, const ir::ForStmt& stmt);
  void countedFor(const ir::ForStmt& stmt, bool fits, Loc loc);
  Ex controlName(ExprId control);
  Ex limitOf(const ir::ForStmt& stmt, uint8_t wide);
  Ex typeLimit(ExprId control, bool rises);
  void keepInType(ExprId control, Ex name, bool rises);
  // Adds a loop whose block is what `body` adds, then what `after` adds after it.
  template <class Body, class After>
  void addLoop(cxx::Stmt* stmt, const Loop& loop, Body&& body, After&& after) {
    add(stmt);
    loops_.push_back(loop);
    stmt->first = deeper(body).first();
    const Loop done = loops_.back();
    loops_.pop_back();
    after();
    if (done.breaks_by_goto) addLabel("break" + std::to_string(done.number));
  }
  template <class Body>
  void addLoop(cxx::Stmt* stmt, const Loop& loop, Body&& body) {
    addLoop(stmt, loop, body, [] {});
  }
  void breakLoop();
  void continueLoop();
  ExprId exitTest(StmtId id) const;
  bool countsSteps() const { return options_.counts_steps && !(body_->library && body_->pure); }
  void step(Loc loc);
  void paySteps(Loc loc, Ex low, Ex high, int64_t step);

  std::vector<Loop> loops_;
  struct TryFrame {
    std::string exit;  // the variable that records how the frame was left: 1 return, 2 break, 3 continue
    bool returns = false, breaks = false, continues = false;
  };
  std::vector<TryFrame> frames_;
  uint32_t depth_ = 1;  // of braces
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
  void writeAllBack();
  cxx::Statements exits();
  cxx::Stmt* objectOfMethod();
  void addHead(ir::BodyId id, cxx::Function& function, cxx::Declarations& lines);
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

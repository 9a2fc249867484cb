// SPDX-License-Identifier: Apache-2.0
// Shared by the files of bodies/: how an expression is checked, converted and written to. Internal to bodies/ and
// checks/; the rest of sema uses the functions of context.h.
// Every function that may replace an expression takes the id by reference: it is the parent's child field.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sema/context.h"
#include "sema/declarations/call_graph.h"
#include "sema/declarations/declarations.h"

namespace rung::sema {

using types::TypeKind;

// The use of the lvalue that an expression names.
enum class Access : uint8_t {
  Read,
  Write,      // the target of an assignment or an output binding
  ReadWrite,  // a compound assignment
  InOut,      // an in-out argument: read and written, too
  Qualifier,  // the base of a member: may be a list, a library, a type or a program
  Bind,       // the target of REF=: the reference itself
  Address,    // ADR, SIZEOF: neither read nor written here
  Refer,      // bound to a REFERENCE, through which it may be written; otherwise like Address
  Call,       // an instance that is called; otherwise like ReadWrite
};
// Whether the value of the variable may be written.
constexpr bool writesValue(Access access) {
  return access == Access::Write || access == Access::ReadWrite || access == Access::InOut || access == Access::Call;
}
constexpr bool takesAddress(Access access) { return access == Access::Address || access == Access::Refer; }

// What a value is used for. The words are made for a message only: "assigned to `x`".
enum class Use : uint8_t {
  Other,  // Purpose::words
  Assigned,
  Condition,
  IfCondition,
  ElsifCondition,
  WhileCondition,
  UntilCondition,
  AssertCondition,
  ComparedByAssert,
  Set,
  CaseLabel,
  LoopControl,
  LoopLimit,
  LoopStep,
  PassedToInput,
  Passed,
  PassedToEn,
  CopiedFromOutput,
  CopiedFromEno,
  BoundToOutput,
  BoundToEno,
  BoundToInOut,
  Deleted,
  OtherOperand,
};
struct Purpose {
  Use use = Use::Other;
  NameId name = {};  // `x`
  NameId of = {};    // of `TON`
  std::string_view words = {};
  std::string toString(const Context& context) const;
};

// The statements of one body.
struct BodyState {
  struct LoopControl {
    VarId var;
    Loc loc;
  };
  struct LabelUse {
    Ident label;
    uint32_t block;
  };
  std::vector<LoopControl> loop_controls;
  uint32_t stmt_depth = 0, elsif_depth = 0;
  uint32_t block = 0;                   // the current statement list
  std::vector<uint32_t> block_parents;  // of each statement list of the body; filled only with labels in use
  std::vector<LabelUse> labels, jumps;
  struct Temporary {  // temporaries.cpp
    VarId var;
    TypeId type = {};                    // none: not known yet
    Loc first = {};                      // the value that gave it
    std::vector<AssignStmt*> open = {};  // literals that wait for the type
    std::vector<AssignStmt*> assigns = {};
    bool busy = false;
  };
  struct Served {  // checks/served_object.cpp: what an in-out of an instance was bound to first
    VarId instance, pin, object;
  };
  std::vector<Served> served;
  std::vector<Temporary> temporaries;  // all declared before the first statement is checked
  Slice<StmtId> statements;
  bool assigns_known = false;
  uint32_t looking_ahead = 0;
  uint32_t ways_out = 0;  // EXIT, RETURN and JMP seen so far: a loop without one between its ends never ends
};

// ---- expressions.cpp
TypeId check(Context& context, ExprId& expr, TypeId expected, Access access);

// ---- cpp_bodies.cpp
// A body in C++, whose source g++ reads: its variables can be accessed there, and the functions that it names are used.
void checkCppBody(Context& context, const PouDecl& decl);

// ---- names.cpp
TypeId checkName(Context& context, ExprId& expr, TypeId expected, Access access);
TypeId checkTypedName(Context& context, ExprId& expr);
TypeId checkMember(Context& context, ExprId& expr, TypeId expected, Access access);
// True when a member expression names an entity as a whole (`GVL.x`, `Lib.f`, `Color.Red`), not a field of its base.
bool isWhole(const Context& context, const MemberExpr& node);
// The entity of a name in operand position; reports an unknown one and returns Error.
Entity resolveName(Context& context, const NameExpr& written, TypeId expected);
// The entity that an expression names, or none.
Entity entityOf(const Context& context, ExprId expr);
// The hidden variable with ENO of the last call of a named instance; none: nothing reads it.
VarId enoMemoryOf(const Context& context, ExprId instance);
void markAccess(Context& context, VarId var, Access access);

// ---- literals.cpp
inline bool isUntyped(const Context& context, TypeId type) {
  const TypeKind kind = context.types().info(type).kind;
  return kind == TypeKind::IntegerLiteral || kind == TypeKind::RealLiteral;
}
// Types a literal without a prefix, of a character or string, like `wanted`, if its quotes allow that.
void retypeString(Context& context, ExprId& expr, TypeId wanted);
TypeId checkLiteral(Context& context, ExprId& expr, TypeId expected);
// The type of an untyped expression whose context gives it none: INT, DINT, LINT, ULINT; REAL.
TypeId defaultType(Context& context, ExprId expr);
// The value of an untyped integer expression; false when it is too large or not known.
bool untypedValue(const Context& context, ExprId expr, __int128& value);
// Reports a constant outside of a subrange, an error in iec.
bool isInSubrange(Context& context, ExprId expr, __int128 value, TypeId subrange);
// True when the untyped integer fits the type without a message.
bool untypedFits(Context& context, ExprId expr, TypeId to);
// Gives an untyped expression a type; reports a value that does not fit.
bool adapt(Context& context, ExprId& expr, TypeId to, const Purpose& purpose);
// Gives it its default type, or the expected one where that is a number.
TypeId finalizeUntyped(Context& context, ExprId& expr, TypeId expected = {});

// ---- conversions.cpp
enum class Fit : uint8_t {
  Same,       // nothing to do
  Lossless,   // converted silently
  Lossy,      // a warning in codesys, an error in iec
  Pointer,    // a pointer to something else: the same
  Extension,  // codesys alone: bit strings and enumerations as integers
  No,
};
Fit fit(const Context& context, TypeId from, TypeId to);
bool extendsStructure(const Context& context, TypeId derived, TypeId base);
// One is a type with named values, the other its base type. IEC 61131-3 ed. 3, 6.4.4.3.
bool isNamedValueOf(const Context& context, TypeId a, TypeId b);
bool sameType(const Context& context, TypeId a, TypeId b);
// For a checked expression: adapts literals, converts to `to`, or reports.
bool convert(Context& context, ExprId& expr, TypeId to, const Purpose& purpose);
bool checkAs(Context& context, ExprId& expr, TypeId to, const Purpose& purpose);
void wrapConvert(Context& context, ExprId& expr, TypeId to);
// The BOOL of IF, WHILE, UNTIL.
void checkCondition(Context& context, ExprId& expr, Use use);
// The common type of both sides; none when they do not combine.
TypeId commonNumber(const Context& context, TypeId a, TypeId b);
// An error or warning, depending on the fit; false for an error.
bool reportFit(Context& context, Fit fit, ExprId expr, TypeId from, TypeId to, const Purpose& purpose);

// ---- operators.cpp
TypeId checkUnary(Context& context, ExprId& expr, TypeId expected);
TypeId checkBinary(Context& context, ExprId& expr, TypeId expected);
// Both operands are checked: types and converts them and returns the type of the result. `self` is the BinaryExpr,
// which may be replaced (time arithmetic).
TypeId combine(Context& context, ExprId& self, TypeId expected);
// x ** n of checked operands: the base becomes REAL or LREAL, the exponent keeps its type.
TypeId power(Context& context, ExprId& base_expr, ExprId& exponent_expr, TypeId expected, Loc loc);
// The common type of several operands of one operator (ADD, MAX, EQ, MUX …), which are converted to it.
enum class Operands : uint8_t { Number, NumberOrTime, Bits, Comparable, Equatable, Anything };
TypeId unify(Context& context, std::span<ExprId> operands, Operands accepted, TypeId expected, std::string_view what,
             Loc loc);

// ---- time_arithmetic.cpp
// TIME * INT, DT - DT, TOD + TIME …: rewritten as arithmetic on integers. None when the types do not combine this way.
TypeId combineTimes(Context& context, ExprId& self, BinaryOp op, ExprId left, ExprId right);

// ---- calls.cpp
TypeId checkCall(Context& context, ExprId& expr, TypeId expected, bool as_statement);
// Which pin each argument belongs to, EN and ENO apart. Arguments without a pin are reported and checked alone.
// `slots` has the argument's index + 1 by position among the pins; those of an {extensible} pin follow the last pin.
struct Arguments {
  std::vector<uint32_t> slots;
  uint32_t en = 0, eno = 0;  // index + 1
  uint32_t positional = 0;   // how many have no name
  bool ok = true;
  bool checked = false;  // except literals: chooseOverload
};
Arguments matchArguments(Context& context, const CallExpr& node, PouId pou);
// Checks the values of arguments that do not fit the pins, to report their errors too. Out: no type.
TypeId checkRefused(Context& context, CallExpr& node, const Arguments& arguments);
// The POU that a call means: of several of one name the one that fits, with its header resolved. None: reported.
PouId calledOf(Context& context, const CallExpr& node, PouId named, bool& checked);
// The type of a call; reports one that has none where a value is wanted.
TypeId resultOf(Context& context, CallExpr& node, const Pou& callee, bool as_statement);
void bindControlPins(Context& context, const CallExpr& node, const Arguments& arguments, Call& call);
// Checks the arguments of a call that cannot be resolved, to report their errors too.
void checkLooseArguments(Context& context, const CallExpr& node);
CallId addCall(Context& context, Call&& call);
// The bindings of a call whose pins are not generic.
void bindArguments(Context& context, const CallExpr& node, PouId callee, const Arguments& arguments, Call& call);

// ---- overloads.cpp
// The function or method of one name that a call means; none after a report. `checked`: its arguments are checked,
// except literals.
bool isOverloaded(const Context& context, PouId called);
PouId chooseOverload(Context& context, const CallExpr& node, PouId called, bool& checked);

// The type of a BitAccess whose base was checked. (expressions.cpp)
TypeId checkBitOf(Context& context, ExprId expr);

// ---- objects.cpp
// A variable named THIS or SUPER hides the keyword.
TypeId checkThisOrSuper(Context& context, ExprId& expr, TypeId expected, Access access);
// `base.member` where base is an object: a method or action (then without a type) or a property that is read. None when
// the object has no such member, except perhaps a variable. `method`: the member, where it is known.
std::optional<TypeId> checkObjectMember(Context& context, ExprId& expr, PouId object, Access access, PouId method = {});
// The same for a bare name of a member of the current object.
TypeId useMember(Context& context, ExprId& expr, Entity member, ExprId instance, Access access);
TypeId callMethod(Context& context, ExprId& expr, PouId method, ExprId instance, bool as_statement);
// `object.property := value`: true when the target is a property; it becomes the call of its SET.
bool checkPropertyAssign(Context& context, AssignStmt& node);
// A pointer to an interface, THIS and SUPER are used like their target: makes the `^` explicit.
TypeId throughObject(Context& context, ExprId& expr, TypeId type);
// Whether the object in an lvalue has exactly the declared type.
bool isExact(const Context& context, ExprId instance);

// ---- attempts.cpp
// target ?= source
void checkAttempt(Context& context, AssignStmt& node);

// ---- pointers.cpp
// p[i]: the i-th element after the target of p.
TypeId checkPointerIndex(Context& context, ExprId& expr, Access access);
// p + n, p - n, p - q, and pointers as numbers. None when the types do not combine this way.
TypeId combinePointers(Context& context, ExprId& self, TypeId expected);

// ---- literal_storage.cpp: the hidden constant that holds a string, so that it has an address
ExprId storageOfLiteral(Context& context, ExprId literal);

// ---- synthesized_nodes.cpp: nodes that need not be checked again; makeLiteral is in context.h
ExprId makeBinary(Context& context, BinaryOp op, ExprId left, ExprId right, TypeId type, Loc loc);
ExprId makeDeref(Context& context, ExprId pointer, TypeId target, Loc loc);
ExprId makeAddressOf(Context& context, ExprId lvalue, TypeId type, Loc loc);
// An integer of either sign.
ExprId makeInteger(Context& context, TypeId type, __int128 value, Loc loc);

// ---- implicit_checks.cpp: calls of the project's own CheckBounds and its kin around a value, where it has them
void callBoundsCheck(Context& context, ExprId& index, const types::Dimension& dimension);
void callDivisorCheck(Context& context, ExprId& divisor);
void callRangeCheck(Context& context, ExprId& value, TypeId subrange);
void callPointerCheck(Context& context, ExprId& pointer, TypeId target, Access access);

// ---- any_inputs.cpp
// The item of __SYSTEM.TYPE_CLASS for a type.
uint32_t typeClassOf(const Context& context, TypeId type);
// The value of an input of type ANY, ANY_NUM …, of a POU in codesys.
void bindAny(Context& context, const Pou& pou, const Var& pin, ExprId& value);

// ---- dynamic_memory.cpp
TypeId checkNew(Context& context, ExprId& expr);
TypeId checkAssignExpr(Context& context, ExprId expr);
// ---- operator_calls.cpp
TypeId checkOperatorCall(Context& context, ExprId& expr, PouId pou, TypeId expected, TypeId forced);
// ---- conversion_calls.cpp
// `INT_TO_REAL(x)`, `TO_INT(x)`, `REAL_TRUNC_INT(x)`, `MUX_INT(…)`: names that follow a rule. None for another name.
TypeId checkRuleCall(Context& context, ExprId& expr, NameId name, TypeId expected);
// ---- statements.cpp
// Checks a list of statements; true when the end of the list can be reached.
bool checkStatements(Context& context, Slice<StmtId> list);
// The operator of a compound assignment such as +=.
BinaryOp binaryOf(AssignOp op);

// ---- small things
inline NameId nameOf(const Context& context, ExprId expr) {
  if (context.tree().kind(expr) == ExprKind::Name) return context.tree().as<NameExpr>(expr).name;
  if (context.tree().kind(expr) == ExprKind::Member) return context.tree().as<MemberExpr>(expr).member;
  return {};
}
// The value of a constant integer expression; plain literals are not evaluated. None when it is not constant.
std::optional<int64_t> constantInteger(Context& context, ExprId expr);

// Above the limits of the parser, which reports first; they bound the trees of schedulers.
constexpr uint32_t kMaxExprDepth = 2100;
constexpr uint32_t kMaxStmtDepth = 2100;
constexpr uint32_t kMaxOperands = 2000;      // of an extensible call, whose value is nested as `a + b + c` is
constexpr uint32_t kMaxElsifDepth = 20'000;  // each ELSIF is in the ELSE of the branch before it

}  // namespace rung::sema

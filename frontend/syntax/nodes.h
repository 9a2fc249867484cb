// SPDX-License-Identifier: Apache-2.0
// The nodes of the syntax tree: trivial structs, one for each row of nodes.def, and the small structs in their lists.
// A node holds what was written, and nothing of what it means. Stored and read by tree.h.
#pragma once

#include <cstdint>

#include "frontend/source/files.h"
#include "frontend/source/names.h"
#include "frontend/syntax/ids.h"
#include "frontend/syntax/pin.h"

namespace rung {

enum class ExprKind : uint8_t {
#define RUNG_EXPR(kind, word, shape, ...) kind,
#include "frontend/syntax/nodes.def"
};
enum class StmtKind : uint8_t {
#define RUNG_STMT(kind, word, ...) kind,
#include "frontend/syntax/nodes.def"
};
enum class TypeExprKind : uint8_t {
#define RUNG_TYPE_EXPR(kind, word, ...) kind,
#include "frontend/syntax/nodes.def"
};
enum class DeclKind : uint8_t {
#define RUNG_DECL(kind, word, ...) kind,
#include "frontend/syntax/nodes.def"
};

// What an expression is made of.
enum class ExprShape : uint8_t {
  Leaf,         // a name, a literal, an address
  Step,         // one step of a path: `base`, then .member, [index], ^ or .bit
  Operation,    // a value from operands
  Initializer,  // of an array or structure
  Inserted,     // never written: only a check of the program makes it
};
ExprShape shape(ExprKind kind);

// A source range: its first byte, and one past its last. Empty: of what was not written.
struct Range {
  Loc begin, end;
  friend bool operator==(Range, Range) = default;
};

// Strings stored in the tree: string literals (decoded) and values of pragmas. A WSTRING is UTF-8 too.
struct StringId {
  uint32_t first = 0, length = 0;
};

// {name 'value'}, {name := 'value'} and {attribute 'name' := 'value'} are stored alike. The parser keeps upper and
// lower case.
struct Pragma {
  NameId name;
  StringId value;
  Loc loc, end;
};

enum class UnaryOp : uint8_t { Not, Negate, Plus };
enum class BinaryOp : uint8_t {
  Or,
  OrElse,
  Xor,
  And,
  AndThen,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Power,
};
// As written in ST: "OR", "<=".
const char* spelling(BinaryOp op);
const char* spelling(UnaryOp op);

enum class LiteralKind : uint8_t {
  Bool,       // value 0 or 1
  Integer,    // value: magnitude; `negative` for INT#-5
  Real,       // value: bits of a double
  String,     // string
  WString,    // string, UTF-8
  Duration,   // value: nanoseconds (int64 bits); long_form for LT#
  Date,       // value: nanoseconds since 1970-01-01 (int64 bits)
  TimeOfDay,  // value: nanoseconds since midnight
  DateTime,   // value: nanoseconds since 1970-01-01
  Null,       // NULL
};

// ---- expressions ----------------------------------------------------------------------------------------------

struct ExprHeader {
  ExprKind kind;
  uint8_t in_parens : 1;  // written in parentheses (needed by the printer and for `-2**2`)
  uint8_t has_room : 1;   // Tree::add() left room in front of it
  uint8_t op;             // UnaryOp, BinaryOp or LiteralKind
  Loc loc;                // first token; for Binary the operator, for Member the member name, for Call the callee
  Loc end;                // one past the last token, without parentheses around it; none: not written
};
constexpr ExprHeader header(ExprKind kind, Loc loc, uint8_t op = 0) { return {kind, 0, 0, op, loc, {}}; }

struct ErrorExpr {
  ExprHeader h;
};

// How a literal is written.
struct LiteralForm {
  bool is_long : 1 = false;      // LT#, LD#, LTOD#, LDT#
  bool is_negative : 1 = false;  // INT#-5, T#-1s
  bool is_based : 1 = false;     // 16#FF
  bool overflows : 1 = false;    // T#1h90m: a unit that is not the first one
};
struct LiteralExpr {
  ExprHeader h;        // op: LiteralKind
  NameId prefix;       // INT in INT#5; none for untyped and for T#, D#, …
  uint32_t low, high;  // value, or StringId for strings
  LiteralForm form;
  LiteralKind literal() const { return static_cast<LiteralKind>(h.op); }
  uint64_t value() const { return low | (static_cast<uint64_t>(high) << 32); }
  StringId string() const { return {low, high}; }
  void setValue(uint64_t v) {
    low = static_cast<uint32_t>(v);
    high = static_cast<uint32_t>(v >> 32);
  }
};

constexpr uint8_t kGlobalName = 1;  // NameExpr: `.name`, which no local variable hides (codesys)
struct NameExpr {
  ExprHeader h;  // op: 0 or kGlobalName
  NameId name;
};
struct TypedNameExpr {
  ExprHeader h;
  Ident type_name;
  Ident item;
};
struct MemberExpr {  // h.loc is the member's name
  ExprHeader h;
  ExprId base;
  NameId member;
};
struct IndexExpr {  // base[i, j]
  ExprHeader h;
  ExprId base;
  Slice<ExprId> indices;
};
struct ThisExpr {
  ExprHeader h;
};
struct SuperExpr {
  ExprHeader h;
};
struct DerefExpr {
  ExprHeader h;
  ExprId base;
};
// width 1: bit, 8, 16, 32: part of a bit string; position in units of width.
struct BitAccessExpr {
  ExprHeader h;
  ExprId base;
  uint32_t position;
  uint8_t width;
};

struct DirectAddress {   // %IX0.3, %QW*, %M5
  char area;             // 'I', the letter of a memory area
  char size;             // 'X' 'B' 'W' 'D' 'L'
  bool incomplete;       // %I*
  bool size_given;       // %I5 has none
  Slice<uint32_t> path;  // 0, 3
};
struct AddressExpr {
  ExprHeader h;
  DirectAddress address;
};

struct UnaryExpr {
  ExprHeader h;
  ExprId operand;
  UnaryOp op() const { return static_cast<UnaryOp>(h.op); }
};
struct BinaryExpr {  // h.loc is the operator
  ExprHeader h;
  ExprId left, right;
  BinaryOp op() const { return static_cast<BinaryOp>(h.op); }
};

struct AssignExpr {  // target := value in an expression, codesys; h.loc is the `:=`, the value that of the target
  ExprHeader h;
  ExprId target, value;
};

struct Argument {  // a | pin := a | pin => a | NOT pin => a | pin := (left open)
  Ident pin;       // none: positional
  ExprId value;    // none: left open
  bool is_output;  // =>
  bool negated;    // NOT pin =>
  Loc loc;
};
struct CallExpr {
  ExprHeader h;
  ExprId callee;
  Slice<Argument> arguments;
  Loc end;       // the closing parenthesis
  bool is_bare;  // `name;` without parentheses
};
struct RangeExpr {
  ExprHeader h;
  ExprId low, high;
};
struct ArrayInitExpr {
  ExprHeader h;
  Slice<ExprId> elements;
};
struct RepeatExpr {
  ExprHeader h;
  ExprId count;
  Slice<ExprId> elements;
};  // 3(), 3(0), 2(1,2,3)
struct FieldInit {
  Ident field;
  ExprId value;
};
struct StructInitExpr {
  ExprHeader h;
  Slice<FieldInit> fields;
};
struct ConvertExpr {
  ExprHeader h;
  ExprId operand;
};
struct BoundExpr {
  ExprHeader h;
  ExprId array;
  uint32_t index;  // 0, 1: lower and upper bound of the first dimension, 2, 3: of the second, …
};
struct AnyValueExpr {  // its type: __SYSTEM.AnyType, or with `facts` __SYSTEM.VAR_INFO
  ExprHeader h;
  ExprId value;
  ExprId facts;         // a StructInit: all members but the address
  uint32_t type_class;  // __SYSTEM.TYPE_CLASS
};
struct NewExpr {  // __NEW(what), __NEW(what, count)
  ExprHeader h;
  TypeExprId allocated;
  ExprId count;    // none: one
  bool only_type;  // `what` alone, as in SIZEOF(POINTER TO INT)
};
struct AddressOfExpr {  // its type: a pointer or reference to that of the lvalue
  ExprHeader h;
  ExprId lvalue;
};

// ---- statements -----------------------------------------------------------------------------------------------

struct StmtHeader {
  StmtKind kind;
  uint8_t op;
  Loc loc;
  Loc end;  // one past the last token, with its `;`; none: made by a scheduler
};
constexpr StmtHeader header(StmtKind kind, Loc loc, uint8_t op = 0) { return {kind, op, loc, {}}; }
// := S= R= REF= += -= *= /= ?=
enum class AssignOp : uint8_t { Assign, Set, Reset, Reference, Add, Subtract, Multiply, Divide, Attempt };
const char* spelling(AssignOp op);
struct ErrorStmt {
  StmtHeader h;
};
struct EmptyStmt {
  StmtHeader h;
};
struct AssignStmt {
  StmtHeader h;  // op: AssignOp; loc: the operator
  ExprId target, value;
  AssignOp op() const { return static_cast<AssignOp>(h.op); }
  void setOp(AssignOp op) { h.op = static_cast<uint8_t>(op); }
};
struct CallStmt {
  StmtHeader h;
  ExprId call;
};  // a CallExpr; a known value in its slot: nothing happens
struct IfBranch {
  ExprId condition;
  Slice<StmtId> body;
};
constexpr uint8_t kConditionalOp = 1;
struct IfStmt {
  StmtHeader h;  // op: kConditionalOp where the source has no IF: JMPC
  Slice<IfBranch> branches;
  Slice<StmtId> otherwise;
};  // IF, ELSIF …; ELSE
struct CaseBranch {
  Slice<ExprId> labels;
  Slice<StmtId> body;
};  // labels: expressions and ranges
struct CaseStmt {
  StmtHeader h;
  ExprId selector;
  Slice<CaseBranch> branches;
  Slice<StmtId> otherwise;
  bool has_else;
};
struct ForStmt {  // FOR control := from TO to BY step DO body END_FOR
  StmtHeader h;
  ExprId control, from, to;
  ExprId step;  // none: 1
  Slice<StmtId> body;
};
struct WhileStmt {
  StmtHeader h;
  ExprId condition;
  Slice<StmtId> body;
};
struct RepeatStmt {
  StmtHeader h;
  Slice<StmtId> body;
  ExprId until;
};
struct TryStmt {  // __TRY body __CATCH(code) handler __FINALLY finally __ENDTRY
  StmtHeader h;
  Slice<StmtId> body, handler, finally;
  ExprId code;  // none: __CATCH does not store the number of the fault
  bool catches;
};
struct ExitStmt {
  StmtHeader h;
};
struct ContinueStmt {
  StmtHeader h;
};
struct ReturnStmt {
  StmtHeader h;
};
struct JumpStmt {
  StmtHeader h;
  Ident label;
};
struct LabelStmt {
  StmtHeader h;
  Ident label;
};

// ---- types as written -----------------------------------------------------------------------------------------

struct TypeExprHeader {
  TypeExprKind kind;
  Loc loc;
  Loc end;  // one past the last token
};
constexpr TypeExprHeader header(TypeExprKind kind, Loc loc) { return {kind, loc, {}}; }
struct ErrorTypeExpr {
  TypeExprHeader h;
};
struct NamedTypeExpr {
  TypeExprHeader h;
  Slice<Ident> path;
  Slice<Argument> arguments;  // of FB_Init
  bool has_arguments;
  Slice<ExprId> elements;    // of an array's elements, a CallExpr without callee each
  Slice<Argument> generics;  // of VAR_GENERIC CONSTANT
};                           // Lib.Motor   Pump(3, x := 4)   ARRAY[0..1] OF Pump[(3), (4)]   Ring<20>
enum class StringEncoding : uint8_t { Bytes, Wide, Utf8 };  // STRING, WSTRING, USTRING
struct StringTypeExpr {
  TypeExprHeader h;
  ExprId length;  // none: default
  StringEncoding code;
};
inline const char* spelling(StringEncoding code) {
  return code == StringEncoding::Wide ? "WSTRING" : code == StringEncoding::Utf8 ? "USTRING" : "STRING";
}
struct SubrangeTypeExpr {
  TypeExprHeader h;
  TypeExprId base;
  ExprId low, high;
};
struct EnumItem {
  Ident item;
  ExprId value;
};
struct EnumTypeExpr {
  TypeExprHeader h;
  Slice<EnumItem> items;
  TypeExprId base;
};
struct ArrayBound {
  ExprId low, high;
};  // both none: [*]
struct ArrayTypeExpr {
  TypeExprHeader h;
  Slice<ArrayBound> bounds;
  TypeExprId element;
};
struct StructTypeExpr {
  TypeExprHeader h;
  Slice<DeclId> fields;
  TypeExprId base;
  bool is_union;
  bool overlaps;  // STRUCT OVERLAP: members with given offsets may share memory
};                // fields: VarDecl
enum class PointerForm : uint8_t { Pointer, Reference, RefTo };
struct PointerTypeExpr {
  TypeExprHeader h;
  TypeExprId target;
  PointerForm form;
};

// ---- declarations ---------------------------------------------------------------------------------------------

struct DeclHeader {
  DeclKind kind;
  Loc loc;  // of the name where there is one, else the keyword
  Loc doc;  // first `///` line above; none: no doc comment
  Slice<Pragma> pragmas;
  Loc begin, end;  // of the whole declaration; of a POU begin is the first pragma before it
};
constexpr DeclHeader header(DeclKind kind, Loc loc, Loc doc = {}, Slice<Pragma> pragmas = {}) {
  return {kind, loc, doc, pragmas, loc, {}};
}

struct TypeDecl {
  DeclHeader h;
  NameId name;
  TypeExprId type;
  ExprId init;
  bool is_internal;  // INTERNAL
};

enum class PouKind : uint8_t { Function, FunctionBlock, Program, Class, Interface, Method, Action };
enum class AccessLevel : uint8_t { None, Public, Private, Protected, Internal };  // None: the default of the dialect
enum Modifier : uint8_t { kAbstract = 1, kFinal = 2, kOverride = 4 };
// Bodies in languages other than ST: il.h, sfc.h, diagram.h.
struct IlInstruction;
struct IlNested;
struct SfcStep;
struct SfcTransition;
struct SfcAssociation;
struct DiagramWire;
struct DiagramPin;
struct DiagramElement;
struct DiagramNetwork;
enum class NetworkLanguage : uint8_t;
// The networks of one body. The elements' indices in wires count from the first of them.
struct Diagram {
  NetworkLanguage language;
  Slice<DiagramNetwork> networks;  // those separated in the file
  Slice<DiagramElement> elements;
};

enum class BodyKind : uint8_t { None, St, Il, Sfc, Network, Cpp, Native };
struct PouDecl {
  DeclHeader h;
  NameId name;
  PouKind pou_kind;
  BodyKind body_kind;
  bool closed;        // has its END_…
  bool uses_eno;      // ENO is an operand in its body
  bool is_broken;     // syntax errors removed declarations from it: a name that it lacks is not reported again
  TypeExprId result;  // functions; none: no result
  Slice<DeclId> sections;
  Slice<StmtId> body;  // of a body in ST
  Slice<IlInstruction> il;
  Diagram diagram;                   // of a body of networks
  Slice<SfcStep> steps;              // the chart of a body in SFC
  Slice<SfcTransition> transitions;  // in other bodies: conditions used by the charts of their actions
  AccessLevel access;
  uint8_t modifiers;        // Modifier
  Slice<TypeExprId> bases;  // EXTENDS; several of an INTERFACE
  Slice<TypeExprId> implements;
  Slice<DeclId> members;  // METHOD, ACTION: Pou; Property
  Slice<DeclId> usings;
  Loc body_begin, body_end;          // its statements or instructions; Cpp: with {C++} and {END_C++}
  Loc cpp_file_begin, cpp_file_end;  // {C++ file} … {END_C++}, equal: none
};

// PROPERTY name : type. Its accessors are methods of the same name: the getter has its type as result, the setter has
// an input of that name and type.
struct PropertyDecl {
  DeclHeader h;
  NameId name;
  AccessLevel access;
  uint8_t modifiers;
  bool in_halves;  // PROPERTY_GET, PROPERTY_SET: edition 4
  TypeExprId type;
  DeclId get, set;  // Pou; none: not declared
};

struct NamespaceDecl {
  DeclHeader h;
  Slice<Ident> path;
  Slice<DeclId> decls;
  bool is_internal;  // INTERNAL
};
struct UsingDecl {
  DeclHeader h;
  Slice<Ident> path;
};

enum class SectionKind : uint8_t { Local, Input, Output, InOut, Temp, External, Global, Stat, Inst, Access, Config };
struct Qualifiers {
  bool constant = false, retain = false, persistent = false, non_retain = false;
  bool generic = false;  // VAR_GENERIC CONSTANT, whose values each instance gives

  bool isKept() const { return retain || persistent; }
  bool operator==(const Qualifiers&) const = default;
};
// Who made a section that the source does not have.
enum class SectionMaker : uint8_t { None, Networks, Chart };
struct SectionDecl {
  DeclHeader h;
  SectionKind section;
  AccessLevel access;
  Qualifiers qualifiers;
  SectionMaker maker;
  Slice<DeclId> vars;
};

struct VarDecl {
  DeclHeader h;
  Slice<Ident> names;  // empty: unnamed located variable; VAR_CONFIG: the path; VAR_ACCESS: the name (`init`: the path)
  TypeExprId type;     // none: a temporary of the compiler, whose type follows from its assignments
  ExprId init;         // none: the type's default
  EdgeKind edge;
  bool located;
  bool read_only;         // of VAR_ACCESS: without READ_WRITE
  DirectAddress address;  // when located; of a member of a structure: its given offset, with a size
  Loc address_loc;
};

struct ConfigurationDecl {
  DeclHeader h;
  NameId name;
  Slice<DeclId> members;
};  // sections, resources, tasks, programs
struct ResourceDecl {
  DeclHeader h;
  NameId name;
  NameId target;
  Slice<DeclId> members;
};
struct TaskDecl {
  DeclHeader h;
  NameId name;
  Slice<Argument> settings;
};                            // INTERVAL := T#10ms, …
struct ProgramInstanceDecl {  // PROGRAM name WITH task : type(args)
  DeclHeader h;
  NameId name;
  Ident task;  // none: no WITH
  Slice<Ident> type;
  Slice<Argument> arguments;
  Slice<Ident> block_tasks;  // (block WITH task, …): both names, alternating
  Qualifiers qualifiers;     // PROGRAM RETAIN name
};

}  // namespace rung

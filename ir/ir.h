// The intermediate representation: typed, structured, small; everything implicit in the source is explicit here.
// In: bodies made by lowering (lower.h) or read from the text form (text.h). Out: bodies that passes rewrite, the
// interpreter runs and codegen prints. Types are those of types::TypeTable, aliases stripped; no generic and no untyped
// literal types. verify.h lists every invariant. Nothing here depends on C++.
//
// An expression is a tree, has no side effect and may be evaluated in full wherever it appears: lowering made
// statements of the conditional parts of the source (short-circuit operands that call or fault). Its only effect is a
// fault of a node whose `checks` are set. Evaluation is left to right, so codegen may place all checks of a statement's
// expressions before the statement, in order. Places (Local, Self, Global, Program, Image, Field, Index, Deref, Bits)
// are expressions; as operands they are read.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/source/names.h"
#include "frontend/syntax/ids.h"
#include "sema/types/areas.h"
#include "sema/types/arithmetic.h"
#include "sema/types/types.h"

namespace rung::ir {

using types::Op;

struct ExprId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  friend bool operator==(ExprId, ExprId) = default;
};
struct StmtId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  friend bool operator==(StmtId, StmtId) = default;
};
struct BodyId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  friend bool operator==(BodyId, BodyId) = default;
};

enum class ExprKind : uint8_t {
  None,
  Const,   // scalar; bits as types::Value. c: none, or TypeId of the class whose number it is (codegen prints its name)
  String,  // a: NameId of the string; type STRING[n] or WSTRING[n]
  Data,    // a: index into Module::data: the constant bytes of an array or record
  Zero,    // all bytes zero of an array, record or string
  // places
  Local,    // a: index into Body::locals (a by-reference local is the variable that it refers to)
  Self,     // the instance of a block body; type is the record
  Global,   // a: index into Module::lists; type is the list's record
  Program,  // a: index into Module::programs; type is the program's record
  Image,    // a: AreaId, b: byte, c: bit 0..7 for a BOOL, else kNoBit
  Field,    // a: base place, b: field index. A by-reference field is the variable that it refers to (checks: null)
  Index,    // a: base place, (b, c): slice of Body::operands, one index per dimension (checks: index)
  Deref,    // a: pointer value (checks: null)
  Bits,     // a: base place of an integer or bit string, b: position in units of the type's width. %X %B %W %D
  // values
  Unary,    // op a
  Binary,   // a op b (checks: div)
  Convert,  // a to `type`: kernel conversion (checks: subrange, convert); string to string: cut to capacity
  Select,   // a ? b : c, both evaluated
  Call,     // a: BodyId of a pure, fault-free function; (b, c): operands
  Address,  // a: place; type is a pointer
};
inline constexpr uint32_t kNoBit = ~0u;

// The checks of a node; passes clear those that they prove.
enum Check : uint8_t {
  kCheckDiv = 1,
  kCheckIndex = 2,
  kCheckNull = 4,
  kCheckCast = 8,
  kCheckSubrange = 16,
  kCheckConvert = 32,
  kCheckOverflow = 64
};

struct Expr {
  ExprKind kind = ExprKind::None;
  Op op = Op::Add;
  uint8_t checks = 0;
  uint8_t spare = 0;
  TypeId type;
  Loc loc;
  uint32_t a = 0, b = 0, c = 0;  // Const: bits = a | b << 32
  uint64_t bits() const { return a | (static_cast<uint64_t>(b) << 32); }
};

enum class StmtKind : uint8_t {
  None,
  Assign,  // a: place, b: value. Arrays, records and strings are copied whole; strings cut to the place's capacity
  Bind,    // a: Field place whose field is by-reference, b: place: the field refers to that variable from now on; 0: to
           // none. A VAR_IN_OUT of a block is a pointer in the instance, so that traces can follow it
  Call,    // a: BodyId, b: self place or none, (c, d): operands, one per parameter: the value, or the place for a
           // by-reference parameter (none: a discarded output), e: place for the result or none.
           // op: kVirtual: the body that Module::dispatches gives for the class of the object at b; kChecked with it
  If,      // a: condition, b: then block, c: else block (a block is its first statement, linked by `next`)
  Switch,  // a: selector, (b, c): slice of Body::cases, d: else block
  Loop,    // a: body block, b: block run before each further iteration (by `continue` too). Endless but for break
  For,     // a: control place (scalar integer), b: from, c: to, d: step (non-zero Const), e: body block.
           // from and to are evaluated once, in that order. Leaves the first value past `to`, or the type's limit
  Break,   // leaves the innermost Loop or For
  Continue,  // next iteration of the innermost Loop or For
  Return,
  Jump,      // a: label number
  Label,     // a: label number
  Try,       // a: body block, op: 1 catches (0: raises it again), b: catch block, c: finally, d: place of its number
  Fault,     // op: types::Fault, a: value for the message or none
  Assert,    // of a test. op: Assertion, a: condition or expected, b: actual, c: tolerance, d: message (NameId).
             // A condition that compares: b and c are its sides, e their source (NameId, as rung_assertion::shown)
  Evaluate,  // a: expression, evaluated for its checks only
};

// Of a call. kChecked: fault[cast] before the call when the class of the object does not have the method.
inline constexpr uint8_t kVirtual = 1, kChecked = 2;

enum class Assertion : uint8_t { Assert, AssertEq, AssertNear };  // in the order of sema::Assertion

struct Stmt {
  StmtKind kind = StmtKind::None;
  uint8_t op = 0;
  uint16_t spare = 0;
  Loc loc;
  StmtId next = {};
  uint32_t a = 0, b = 0, c = 0, d = 0, e = 0;
};

struct CaseRange {
  int64_t low, high;
};  // in the selector type's bits, low <= high
struct Case {
  uint32_t first_range, range_count;  // slice of Body::ranges
  StmtId block;
};

enum class LocalKind : uint8_t {
  Temp,      // made by the compiler, name `t1`
  Variable,  // VAR of a function, VAR_TEMP
  Input,
  Output,
  InOut,  // parameters of a function
  Result,
};
struct Local {
  NameId name;
  TypeId type;
  LocalKind kind = LocalKind::Temp;
  bool by_reference = false;  // Output, InOut; Input of array, record or string type (read only); Result of such a type
  Loc loc;
};
// A parameter of a function: an operand of its calls, in the order of the locals.
constexpr bool isParameter(const Local& local) {
  return local.kind == LocalKind::Input || local.kind == LocalKind::Output || local.kind == LocalKind::InOut;
}

enum class BodyKind : uint8_t {
  Function,  // parameters are the locals of kind Input, Output, InOut, in order
  Block,     // of an FB or program: self is the instance
  Init,      // sets a record to its initial values: self is the record (struct, FB, program or global list)
};

// The source of a body or record read from IR text: its `loc` points into the IR text, its header names the source.
struct Origin {
  bool from_string = false;
  NameId path;
  uint32_t line = 0;
};

// The code of one function, block or initialiser.
struct Body {
  NameId name;      // unique over the module: `Ramp`, `LIMIT__REAL`; an Init has its record's name
  NameId spelling;  // as the user wrote it: in faults and comments
  BodyKind kind = BodyKind::Function;
  bool native = false;    // no code: a C function of the library's runtime part
  bool abstract = false;  // no code: a method that is only called through its dispatch
  bool pure = false;      // no effect but its result, and no fault
  bool sized = false;     // native: has a form with lengths of strings in C++ (sized form, rung/<library>.h)
  bool slice = false;     // native, sized: and one that only returns which part of the first input the result is
  bool may_fault = false;
  bool library = false;
  bool has_labels = false;  // analyses are conservative
  bool test = false;
  uint32_t cpp = 0;      // no code: a body in C++, its number in Module::cpp_bodies + 1; 0: none
  bool counted = false;  // written for the product, not for its tests: coverage counts it
  NameId library_name;   // native: which library's C function
  TypeId self;           // Block, Init; Function: of a method, the object's record
  TypeId result;         // Function; none: no result
  Loc loc;
  FileId file;
  Origin origin;

  std::vector<Local> locals;
  std::vector<Expr> exprs;  // [0] unused
  std::vector<Stmt> stmts;  // [0] unused
  std::vector<ExprId> operands;
  std::vector<Case> cases;
  std::vector<CaseRange> ranges;
  std::vector<NameId> labels;  // by label number
  StmtId first;

  Expr& expr(ExprId id) { return exprs[id.index]; }
  const Expr& expr(ExprId id) const { return exprs[id.index]; }
  Stmt& stmt(StmtId id) { return stmts[id.index]; }
  const Stmt& stmt(StmtId id) const { return stmts[id.index]; }
};

// Constant bytes in the target's layout (little-endian), of arrays and records without pointers.
struct Data {
  TypeId type;
  std::vector<uint8_t> bytes;
};

// A struct, FB, program or global list that has memory. The layout is in the type table.
struct Record {
  TypeId type;
  NameId name;  // unique over the module
  BodyId init;
  BodyId body;  // FB, program: its Block body
  Loc loc;
  FileId file;
  Origin origin;
  bool library = false;
};
struct List {
  NameId name;
  TypeId record;
  BodyId init;
};
struct ProgramInstance {
  NameId name;
  TypeId record;
  BodyId init, body;
  uint32_t task = 0; /* index + 1; 0: none */
  NameId resource, configuration;
  // Functions without parameters, or none. `run` is what the task calls instead of `body`: it also copies connected
  // variables and open addresses. `setup` is called after all `init`: initial values of VAR_CONFIG.
  BodyId run = {}, setup = {};
  // Of a test, whose instance begins and ends with its run, not with the module; `exit` is as Module::exit, or none.
  bool is_test = false;
  BodyId exit = {};
};

enum class TaskKind : uint8_t { Cyclic, Freewheeling, Event, Status, External };
struct Task {
  NameId name;
  TaskKind kind = TaskKind::Cyclic;
  int64_t interval_ns = 0;
  uint32_t priority = 0;
  // Event, Status: the BOOL variable: a Global/Program/Image place, as a path of the symbol map.
  std::string trigger;
  std::string external_event;
  int64_t watchdog_ns = 0;
  uint32_t sensitivity = 0;
};

// A located variable: name as a symbol, view of the image.
struct Located {
  NameId name;
  TypeId type;
  uint8_t area;  // AreaId
  uint32_t byte;
  uint32_t bit;               /* kNoBit: none */
  uint32_t owner_program = 0; /* index into programs + 1; 0: a global or unnamed */
};

// A name of VAR_ACCESS: a symbol for a part of a list, of a program instance or of the image.
struct AccessPath {
  NameId name, prefix, configuration;  // `prefix`: the program instance that declares it
  TypeId type;
  enum class Root : uint8_t { Image, List, Program } root = Root::Image;
  uint32_t index = 0;  // of the list or program; the image: its area
  uint64_t offset = 0;
  uint32_t bit = kNoBit;
  bool read_only = true;
};
// A block of a program that a separate task runs: a function without parameters.
struct BlockTask {
  uint32_t task = 0;  // index + 1
  BodyId run;
};

// The objects that have a type id, each after the one that it extends: the number of a class is its index + 1.
struct Class {
  TypeId record;
  TypeId base;  // none
};
// The body that a virtual call of `method` runs, by class number - first; none: that class has no such method. One row
// per method that is called virtually, not per class: it has few gaps, since numbers follow the lines of descent, and
// interfaces need no second mechanism.
struct Dispatch {
  BodyId method;
  uint32_t first = 1;
  std::vector<BodyId> bodies;
};

// A body in C++: its source, and the names that it may use besides the POU's own variables (Body::locals, fields).
struct CppBody {
  struct Global {  // VAR_EXTERNAL
    NameId name;
    uint32_t list, field;
    bool constant;
  };
  struct Constant {  // VAR CONSTANT; in `initial` the values that variables of the function begin with
    NameId name;
    TypeId type;
    uint64_t bits;  // of a string its NameId
  };
  BodyId body;
  std::string_view source;  // between {C++} and {END_C++}; the sources hold it
  Loc loc;                  // where it begins
  std::vector<Global> globals;
  std::vector<Constant> constants, initial;
  std::vector<BodyId> functions;  // those it may call
};

struct Module {
  Module(types::TypeTable& types, Names& names, const Sources& sources)
      : types(types), names(names), sources(sources) {}
  types::TypeTable& types;
  Names& names;
  const Sources& sources;

  std::deque<Body> bodies{1};   // [0] unused
  std::vector<Record> records;  // in dependency order: a record after those that it holds
  std::vector<List> lists;      // sorted by name
  std::vector<ProgramInstance> programs;
  std::vector<Task> tasks;
  std::vector<Located> located;
  std::vector<AccessPath> access_paths;
  std::vector<BlockTask> block_tasks;
  std::deque<Data> data;
  std::vector<Class> classes;
  BodyId exit;                       // a function without parameters that ends all objects (FB_Exit), or none
  std::vector<Dispatch> dispatches;  // sorted by method
  std::vector<CppBody> cpp_bodies;
  std::vector<BodyId> tests;  // Block or Function bodies marked {test}; a Block's instance is in `programs`
  types::MemoryAreas areas = types::standardAreas();  // `bytes`: as many as the program has

  Body& body(BodyId id) { return bodies[id.index]; }
  const Body& body(BodyId id) const { return bodies[id.index]; }
};

// The C function of a native body: `rung_standard_MID`.
std::string nativeName(const Module& module, const Body& body);

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// The entities that names mean, resolved and laid out: variables, POUs, enumeration items, lists of globals, and calls.
// In: the syntax trees of all files and the libraries they use. Out: Symbols, the tables that each rule of sema and
// lowering reads. Index 0 of each table is unused.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string_view>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/tree.h"
#include "sema/access.h"
#include "sema/code.h"
#include "sema/ids.h"
#include "sema/types/areas.h"
#include "sema/types/arithmetic.h"
#include "sema/types/types.h"

namespace rung::sema {

// Where a variable lives.
enum class Storage : uint8_t {
  Field,     // of an FB or program instance: Pou::record, field index
  Local,     // of one call: function variables and pins, VAR_TEMP
  Global,    // of a global list: GlobalList::record, field index
  Image,     // located: a view of the process image
  Constant,  // a named value without memory (enumeration items are not variables)
};

struct ImageView {  // 8-bit byte offset in its area, and the bit for %X
  types::AreaId area;
  uint32_t byte = 0;
  uint8_t bit = 0;
  bool is_bit = false;
};

struct Var {
  NameId name;  // none: an unnamed located variable
  Loc loc;
  TypeId type;
  SectionKind section = SectionKind::Local;
  Storage storage = Storage::Local;
  EdgeKind edge = EdgeKind::None;
  bool constant = false;
  struct Keeping {  // as its section says
    bool retain = false, persistent = false;
    bool non_retain = false;  // NON_RETAIN, which also holds inside of a retained instance
  } keeping;
  types::SymbolAccess symbol_access = types::SymbolAccess::ReadWrite;
  bool generic = false;    // VAR_GENERIC CONSTANT; in the block itself its value only serves the check, so any will do
  bool has_value = false;  // constant scalar or string with a known value: see `value`
  bool hierarchical = false;  // AT %QW0.1.2: placed after all others when these are known
  bool open_address = false;  // AT %I*: the number comes from VAR_CONFIG or from the system
  PouId pou;                  // owner, or none
  ListId list;                // owner when global
  uint32_t field = 0;         // Storage::Field and Global: index in the record; Local: position among the POU's vars
  ExprId init;                // none: the type's default; checked and converted to `type`
  DeclId decl;
  ImageView image;
  types::Value value;  // when has_value
  VarId external;      // VAR_EXTERNAL: the global it names
  TypeId record;       // field of a structure or union: its type
  AccessLevel access = AccessLevel::None;
  TypeId any;              // codesys: an input of the generic type ANY_…, whose `type` is __SYSTEM.AnyType
  bool of_chart = false;   // a step, or other state of a chart
  uint32_t temporary = 0;  // created by the compiler, without declared type: its number in the body; 0: none
  struct Sharing {         // of VAR_TEMP that actions use (shared_temporaries.cpp)
    VarId field;           // the hidden field that holds it
    VarId holds;           // of such a field: its VAR_TEMP
    VarId copy_of;         // VAR_TEMP of a base, as the body of a derived block has it: the one that was declared
  } sharing;
  VarId tells_input;  // {attribute 'is_connected' := 'x'}: the input x; TRUE in a call that gives it a value
  struct Memory {     // of the last call, in a hidden BOOL
    VarId edge;       // R_EDGE, F_EDGE: the input's value
    VarId eno;        // instance whose ENO is read: its ENO
  } memory;
  struct Pragmas {                                                              // of the declaration
    bool required = false, optional = false, lazy = false, extensible = false;  // pins of library declarations
    bool long_time = false;           // {long_time}: a TIME that takes an LTIME too (iec3)
    bool instance_path = false;       // {attribute 'instance-path'}: holds the path of its instance
    bool no_exit = false;             // {attribute 'no-exit'}: an instance whose FB_Exit is not called
    bool no_copy = false;             // {attribute 'no_copy'}: an online change that moves it sets its initial value
    bool set_by_change = false;       // {attribute 'init_on_onlchange'}: every online change does
    bool initialize_on_call = false;  // {attribute 'initialize_on_call'}: an input that each call begins with
    std::vector<NameId> aliases;      // {alias 'R'}
  } pragmas;
  struct Start {                        // how it gets its first value, when its initial value is checked
    bool late = false;                  // the initial value reads other variables: Project::late, Pou::late
    CallId constructor;                 // of a block whose FB_Init has parameters: the arguments in the declaration
    uint32_t element_constructors = 0;  // of an array: how many calls from `constructor` on, one for each element
  } start;
  struct Used {  // how often, by declarations and bodies
    uint32_t reads = 0, writes = 0;
  } used;
  struct Bits {    // members of type BIT, when the type is laid out
    VarId holder;  // the hidden byte whose `bit` it is; `field` is that byte's
    uint8_t bit = 0;
    bool is_bit = false, holds_bits = false;  // is such a member; is such a byte
  } bits;
  struct OpenArray {            // ARRAY[*], when the POU is resolved
    VarId bounds;               // the first of the hidden variables with its bounds, two a dimension
    bool hidden_input = false;  // of a function: such a bound, passed after the pins
  } open_array;
};

// A place where the source names an entity: Options::records_mentions.
struct Mention {
  Entity entity;
  Loc loc;
  Access access;
};

struct Property {
  NameId name;
  Loc loc;
  PouId owner;
  PouId get, set;  // none: not declared
};

enum class OperatorKind : uint8_t { None, Op, Select, Mux, Convert, Move };
enum class AccessorKind : uint8_t { None, Get, Set };
// What a project may check by functions of its own (bodies/implicit_checks.cpp).
enum class ImplicitCheck : uint8_t {
  Bounds,
  DivDInt,
  DivLInt,
  DivReal,
  DivLReal,
  RangeSigned,
  RangeUnsigned,
  LRangeSigned,
  LRangeUnsigned,
  Pointer,
  Count_
};

// {case a := 1, b := 2} before a test: runs it once with these inputs.
struct TestCase {
  struct Input {
    VarId var;
    ExprId value;  // checked, in the type of `var`
  };
  NameId name;  // `Math.adds(a := 1, b := 2)`
  Loc loc;
  std::vector<Input> inputs;
};

struct Pou {
  NameId name;
  Loc loc;
  PouKind kind = PouKind::Program;
  DeclId decl;
  TypeId record;            // FB and program: the instance type; function: none
  TypeId result;            // functions; none: no result
  VarId result_var;         // the variable that the function's name means inside its body
  std::vector<VarId> vars;  // all, in order of declaration (result_var is not among them)
  std::vector<VarId> late;  // fields whose initial values read others, in the order in which they are set
  std::vector<VarId> pins;  // the inputs, in-outs and outputs among `vars`; filled by bodies/ at the first call
  struct Body {
    Slice<StmtId> statements;  // as written, or as a scheduler made them
    Slice<StmtId> code;        // that is made of them
    bool scheduled = false;
    bool affects_others = false;  // what is said elsewhere depends on it: declarations/mentions.h
    std::vector<Mention> mentions;
  } body;
  bool library = false;
  bool excluded = false;  // a test, or only for tests, and not part of this program: checked, not lowered
  struct Cpp {
    bool is_body = false;        // the body is in C++
    std::vector<PouId> calls;    // functions that such a body names
    std::vector<VarId> globals;  // variables that it names with their list, `GVL.speed`
  } cpp;
  bool extensible = false;  // has an {extensible} pin
  bool may_fault = false;
  // The pragmas of its declaration (collect.cpp).
  struct Pragmas {
    bool native = false, pure = false, test = false;
    bool test_only = false;  // {test_only}, {replaces …}: only tests use it
    bool sized = false;      // {sized}: has a second native form that takes and returns lengths of strings
    bool slice = false;      // {slice}: and a third that only returns which part of the first input the result is
    bool prefix =
        false;  // {prefix}: the first n characters of the result depend only on the first n of the first input
    bool faults = false;              // {fault}: its result is 0 or a fault that the caller raises, a rung_lock_error
    bool no_copy = false;             // {no_copy}: an instance cannot be copied
    bool bytes = false;               // {bytes}: its generic type is ARRAY OF BYTE
    bool call_after_init = false;     // {attribute 'call_after_init'}
    bool no_virtual_actions = false;  // {attribute 'no_virtual_actions'}: a derived block does not replace its actions
    bool no_check = false;            // {attribute 'no_check'}: without the implicit checks of the project
    bool initialize_on_call = false;  // {attribute 'initialize_on_call'}: marked inputs have their initial values
    bool reflection = false;          // {attribute 'reflection'}: marked variables tell which inputs are connected
    bool after_globals = false;       // {attribute 'call_after_global_init_slot'}, with this slot
    int32_t after_globals_slot = 0;
    int32_t init_slot = 50000;                                           // {attribute 'global_init_slot'}: of a program
    types::SymbolAccess symbol_access = types::SymbolAccess::ReadWrite;  // {attribute 'symbol'}: of its variables
    types::Op op = types::Op::Add;
    OperatorKind operator_kind = OperatorKind::None;  // {operator '…'}
    NameId replaces;                                  // {replaces 'X'}: a mock of X
    bool setup = false, teardown = false;             // {setup}, {teardown}: around each test of the file
    bool safe_values = false;                         // {safe_values}: sets outputs when the program stops
    bool before_task = false, after_task = false;     // of a method: each activation calls it for every instance
    NameId skip;                                      // {skip 'why'} of a test: the reason
    std::vector<NameId> mocks;                        // {mock 'M'} of a test: name keys, sorted
    std::vector<TestCase> cases;                      // of a test; none: it runs once
  } pragmas;
  // How far it has been checked.
  struct Progress {
    enum class Header : uint8_t { New, Busy, Done } header = Header::New;       // base and interfaces are known
    enum class Body : uint8_t { New, Busy, Correct, Broken } body = Body::New;  // library bodies: when used
    bool pins_ready = false;
    bool used = false;
    bool checked() const { return body != Body::New; }
  } progress;
  NameId library_name;  // `Standard`
  // A generic function is never lowered itself: each tuple of types creates an instance, named as in C++ and the IR
  // (`LIMIT__REAL`).
  bool generic = false;
  struct Instance {
    PouId of;            // the generic function or block; none: not an instance
    uint32_t depth = 0;  // of a block with VAR_GENERIC CONSTANT: instances that need this one, in a row
  } instance;
  NameId
      unique_name;  // unique over the project; equals name unless it is an instance of a generic function or a member
  // ---- objects: FUNCTION_BLOCK, CLASS, INTERFACE, and their METHODs and ACTIONs (declarations/objects.cpp)
  PouId owner;                 // of a method or action
  PouId chart;                 // the action or method whose chart contains this action
  PouId base;                  // EXTENDS
  std::vector<PouId> members;  // methods, actions and accessors, in order
  struct Overloads {           // of functions and methods of one name
    PouId first;
    PouId next;  // in order of declaration
  } overloads;
  AccessLevel access = AccessLevel::None;
  struct Object {                   // filled when the header is resolved
    uint32_t base_depth = 0;        // bases of bases
    std::vector<PouId> interfaces;  // IMPLEMENTS; EXTENDS of an interface
    std::vector<uint32_t> properties;
    VarId base_var;         // the hidden field that holds the base
    VarId id_var;           // the hidden type id, where this object is the first of its line to have one
    VarId in_body;          // the hidden BOOL that is TRUE while the body runs, where actions use its VAR_TEMP
    uint8_t modifiers = 0;  // Modifier
    AccessorKind accessor = AccessorKind::None;  // of a property
    bool unresolved = false;                     // extends something that is not known, which was reported
    bool extended = false;                       // another block of the project extends it
    bool dispatched = false;  // begins with a type id: its methods and body may be called through a table
  } object;
  FileId file;
};

struct EnumValue {
  NameId name;
  TypeId type;
  int64_t value;
  Loc loc;
};

// VAR_GLOBAL of one file (or of a configuration or resource): a record in memory.
struct GlobalList {
  NameId name;  // the file's stem, the configuration's or the resource's name
  bool qualified_only = false;
  types::SymbolAccess symbol_access = types::SymbolAccess::ReadWrite;  // of the declarations that are collected now
  NameId configuration, resource;                                      // whose VAR_GLOBAL it is; none: of a file or POU
  int32_t init_slot = 49990;  // {attribute 'global_init_slot'}: lists and programs are initialised in this order
  TypeId record;
  std::vector<VarId> vars;
  Loc loc;
};

// One actual of a call, in the order of the callee's pins, EN and ENO apart.
struct Binding {
  VarId pin;
  ExprId value;            // converted to the pin's type; none: left open (function input: its default; FB input: kept)
  bool is_output = false;  // copied to `value` after the call
  bool negated = false;    // NOT pin =>
};
// Attempt: the first binding is a pointer to an object, the second the lvalue that gets it when the object is a `pou`
// (none: any), and 0 when not; the result is whether it was.
enum class CallKind : uint8_t { Function, Instance, Program, Operator, Assertion, Method, Attempt, Delete };
enum class Assertion : uint8_t { Assert, AssertEq, AssertNear };
struct Call {
  CallKind kind = CallKind::Function;
  PouId pou;                // callee; the instance of a generic function
  ExprId instance;          // Instance: the FB variable; Method: the object, none: the current one; Delete: pointer
  PouId owns;               // Delete: tests whether memory is of the pool; `pou` releases it
  bool is_virtual = false;  // Method, Instance: the object may be of a derived type
  std::vector<Binding> bindings;  // Operator: operands in order, pin none
  ExprId en;                      // EN := …
  ExprId eno;                     // ENO => …
  VarId eno_memory;               // Instance whose ENO is read: the variable that holds it, beside the instance
  bool eno_is_pin = false;        // … and one of `bindings`: the callee has an output of that name
  CallId constructor;             // of __SYSTEM.Allocate for __NEW: the arguments of FB_Init
  Assertion assertion = Assertion::Assert;
};

struct Symbols {
  Sources& sources;
  Names& names;
  Diagnostics& diagnostics;
  const Tree& tree;                // what was written, and code
  Tree& arena;                     // the same, for who adds to it: code.h
  const LanguageProfile& profile;  // of the project's own sources; Context::profile() is that of the current code
  uint32_t native_width;           // 32 or 64: intermediate.h
  types::TypeTable types;

  std::deque<Var> vars = std::deque<Var>(1);
  std::deque<Pou> pous = std::deque<Pou>(1);
  std::vector<EnumValue> enum_values = std::vector<EnumValue>(1);
  std::deque<GlobalList> global_lists = std::deque<GlobalList>(1);
  std::deque<Property> properties = std::deque<Property>(1);
  std::deque<Call> calls = std::deque<Call>(1);

  Var& var(VarId id) { return vars[id.index]; }
  const Var& var(VarId id) const { return vars[id.index]; }
  Pou& pou(PouId id) { return pous[id.index]; }
  const Pou& pou(PouId id) const { return pous[id.index]; }
  Call& call(CallId id) { return calls[id.index]; }
  const Call& call(CallId id) const { return calls[id.index]; }
};

// Functions or methods whose parameters have the same types, one by one; a method of the object that has the name of
// another and, where the name is overloaded, its parameters.
bool sameParameters(const Symbols& symbols, PouId a, PouId b);
PouId methodLike(const Symbols& symbols, PouId object, PouId like);

// The value of a checked literal, in its type; and the operator of the arithmetic kernel for an infix operator.
types::Value valueOf(const Symbols& symbols, const LiteralExpr& literal);
types::Op operatorOf(BinaryOp op);

}  // namespace rung::sema

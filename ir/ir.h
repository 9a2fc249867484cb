// SPDX-License-Identifier: Apache-2.0
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
#include <cstring>
#include <deque>
#include <new>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/source/invariant.h"
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

inline constexpr uint32_t kNoBit = ~0u;
inline constexpr uint32_t kMostProven = 16;  // dimensions that can lose their part of a check: Expr::proven

// 64 bits that need only the alignment of an id.
struct Bits64 {
  uint32_t low = 0, high = 0;
  constexpr Bits64() = default;
  constexpr Bits64(uint64_t bits) : low(static_cast<uint32_t>(bits)), high(static_cast<uint32_t>(bits >> 32)) {}
  constexpr operator uint64_t() const { return low | uint64_t{high} << 32; }
};

enum class Assertion : uint8_t { Assert, AssertEq, AssertNear };  // in the order of sema::Assertion

struct CaseRange {
  int64_t low, high;
};  // in the selector type's bits, low <= high
struct Case {
  Slice<CaseRange> ranges;
  StmtId block;
};

enum class ExprKind : uint8_t {
#define RUNG_EXPR(kind, word, role, checks, fields) kind,
#include "ir/instructions.def"
};
enum class StmtKind : uint8_t {
#define RUNG_STMT(kind, word, effect, flow, fields) kind,
#include "ir/instructions.def"
};

// The columns of instructions.def.
enum class ExprRole : uint8_t { Constant, Variable, Part, Target, Value };
enum class StmtEffect : uint8_t { None, Stores, Acts };
enum class StmtFlow : uint8_t { Falls, Blocks, Leaves };

constexpr ExprRole roleOf(ExprKind kind) {
  constexpr ExprRole kRoles[] = {
#define RUNG_EXPR(kind, word, role, checks, fields) ExprRole::role,
#include "ir/instructions.def"
  };
  return kRoles[static_cast<uint8_t>(kind)];
}
constexpr bool isPlace(ExprKind kind) {
  const ExprRole role = roleOf(kind);
  return role == ExprRole::Variable || role == ExprRole::Part || role == ExprRole::Target;
}
// The kinds in two halves, for switches that have to do with one of them.
enum class PlaceKind : uint8_t {
#define RUNG_PLACE(kind, word, role, checks, fields) kind = static_cast<uint8_t>(ExprKind::kind),
#include "ir/instructions.def"
};
enum class ValueKind : uint8_t {
#define RUNG_EXPR(kind, word, role, checks, fields) kind = static_cast<uint8_t>(ExprKind::kind),
#define RUNG_PLACE(kind, word, role, checks, fields)
#include "ir/instructions.def"
};
constexpr PlaceKind placeKind(ExprKind place) { return static_cast<PlaceKind>(place); }
constexpr ValueKind valueKind(ExprKind value) { return static_cast<ValueKind>(value); }  // of what is not a place
// The checks that an expression of this kind may have.
constexpr uint8_t checksOf(ExprKind kind) {
  constexpr uint8_t kChecks[] = {
#define RUNG_EXPR(kind, word, role, checks, fields) checks,
#include "ir/instructions.def"
  };
  return kChecks[static_cast<uint8_t>(kind)];
}
constexpr StmtEffect effectOf(StmtKind kind) {
  constexpr StmtEffect kEffects[] = {
#define RUNG_STMT(kind, word, effect, flow, fields) StmtEffect::effect,
#include "ir/instructions.def"
  };
  return kEffects[static_cast<uint8_t>(kind)];
}
constexpr StmtFlow flowOf(StmtKind kind) {
  constexpr StmtFlow kFlows[] = {
#define RUNG_STMT(kind, word, effect, flow, fields) StmtFlow::flow,
#include "ir/instructions.def"
  };
  return kFlows[static_cast<uint8_t>(kind)];
}

// The fields of each kind, such as
//   struct FieldExpr { static constexpr ExprKind kKind = ExprKind::Field; ExprId base; uint32_t field; };
#define RUNG_OPERAND(name) ExprId name = {};
#define RUNG_OPERANDS(name) Slice<ExprId> name = {};
#define RUNG_READ(name) ExprId name = {};
#define RUNG_WRITE(name) ExprId name = {};
#define RUNG_REFERENCE(name) ExprId name = {};
#define RUNG_ARGUMENTS(name) Slice<ExprId> name = {};
#define RUNG_BLOCK(name) StmtId name = {};
#define RUNG_CASES(name) Slice<Case> name = {};
#define RUNG_VALUE(type, name) type name = {};
#define RUNG_EXPR(kind, word, role, checks, fields)   \
  struct kind##Expr {                                 \
    static constexpr ExprKind kKind = ExprKind::kind; \
    fields                                            \
  };
#define RUNG_STMT(kind, word, effect, flow, fields)   \
  struct kind##Stmt {                                 \
    static constexpr StmtKind kKind = StmtKind::kind; \
    fields                                            \
  };
#include "ir/instructions.def"
#undef RUNG_OPERAND
#undef RUNG_OPERANDS
#undef RUNG_READ
#undef RUNG_WRITE
#undef RUNG_REFERENCE
#undef RUNG_ARGUMENTS
#undef RUNG_BLOCK
#undef RUNG_CASES
#undef RUNG_VALUE

// Room for the fields of a node of any kind: a body keeps its nodes in one vector, and a pass can give a node another
// kind in place.
//   const FieldExpr& field = expr.as<FieldExpr>();                     the kind is known
//   if (const auto* field = expr.tryAs<FieldExpr>()) …                 null: another kind
//   expr.set(LocalExpr{.local = temp});                                another kind from now on
template <class Kind, size_t size>
class Node {
  alignas(uint32_t) unsigned char fields_[size] = {};

 public:
  Kind kind = Kind::None;

  template <class T>
  T& as() {
    expectKind(T::kKind);
    return *std::launder(reinterpret_cast<T*>(fields_));
  }
  template <class T>
  const T& as() const {
    expectKind(T::kKind);
    return *std::launder(reinterpret_cast<const T*>(fields_));
  }
  template <class T>
  const T* tryAs() const {
    return kind == T::kKind ? &as<T>() : nullptr;
  }
  template <class T>
  void set(const T& fields) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= size && alignof(T) <= alignof(uint32_t));
    kind = T::kKind;
    std::memcpy(fields_, &fields, sizeof fields);
  }

 private:
  void expectKind([[maybe_unused]] Kind wanted) const {
#ifndef NDEBUG
    RUNG_INVARIANT(kind == wanted, "a node is read as what it is");
#endif
  }
};

struct Expr : Node<ExprKind, 12> {
  uint8_t checks = 0;
  // Of an Index with a check: by bit, the dimensions whose index needs none. Of a sum, product, negation or Convert of
  // integers: 1 when the value fits the type, so that nothing is cut.
  uint16_t proven = 0;
  TypeId type;
  Loc loc;

  bool isProven(uint32_t dimension) const { return dimension < kMostProven && (proven >> dimension & 1) != 0; }
  // Of a Unary or Binary.
  Op op() const { return kind == ExprKind::Unary ? as<UnaryExpr>().op : as<BinaryExpr>().op; }
};
static_assert(sizeof(Expr) == 24 && std::is_trivially_copyable_v<Expr>);

struct Stmt : Node<StmtKind, 28> {
  Loc loc;
  StmtId next;
};
static_assert(sizeof(Stmt) == 40 && std::is_trivially_copyable_v<Stmt>);

inline bool isConst(const Expr& e) { return e.kind == ExprKind::Const; }
inline uint64_t bitsOf(const Expr& constant) { return constant.as<ConstExpr>().bits; }
inline bool isNot(const Expr& e) { return e.kind == ExprKind::Unary && e.as<UnaryExpr>().op == Op::Not; }
// A view of one bit of the image.
inline bool isImageBit(const Expr& e) { return e.kind == ExprKind::Image && e.as<ImageExpr>().bit != kNoBit; }
// The local that an expression names, or null.
inline const uint32_t* localOf(const Expr& e) {
  const auto* local = e.tryAs<LocalExpr>();
  return local == nullptr ? nullptr : &local->local;
}

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
  std::span<ExprId> list(Slice<ExprId> slice) { return {operands.data() + slice.first, slice.count}; }
  std::span<const ExprId> list(Slice<ExprId> slice) const { return {operands.data() + slice.first, slice.count}; }
  std::span<Case> list(Slice<Case> slice) { return {cases.data() + slice.first, slice.count}; }
  std::span<const Case> list(Slice<Case> slice) const { return {cases.data() + slice.first, slice.count}; }
  std::span<const CaseRange> list(Slice<CaseRange> slice) const { return {ranges.data() + slice.first, slice.count}; }
};

// The parameters of a function, in the order of its locals: its calls have an operand for each.
//   for (const Local& parameter : parameters(callee)) …
class Parameters {
 public:
  explicit Parameters(const std::vector<Local>& locals) : begin_(locals.data()), end_(begin_ + locals.size()) {}
  class Iterator {
   public:
    Iterator(const Local* at, const Local* end) : at_(at), end_(end) { skip(); }
    const Local& operator*() const { return *at_; }
    Iterator& operator++() {
      ++at_;
      skip();
      return *this;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

   private:
    void skip() {
      while (at_ != end_ && !isParameter(*at_)) ++at_;
    }
    const Local *at_, *end_;
  };
  Iterator begin() const { return {begin_, end_}; }
  Iterator end() const { return {end_, end_}; }
  bool empty() const { return begin() == end(); }
  uint32_t count() const {
    uint32_t found = 0;
    for (auto at = begin(); !(at == end()); ++at) ++found;
    return found;
  }

 private:
  const Local *begin_, *end_;
};
inline Parameters parameters(const Body& body) { return Parameters(body.locals); }

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
// Lists and programs are initialised by ascending slot.
inline constexpr int32_t kListSlot = 49990, kProgramSlot = 50000;
struct List {
  NameId name;
  TypeId record;
  BodyId init;
  int32_t slot = kListSlot;
  NameId configuration = {};  // of the globals of a resource
};
struct ProgramInstance {
  NameId name;
  TypeId record;
  BodyId init, body;
  uint32_t task = 0;   /* index + 1; 0: none */
  bool retain = false; /* PROGRAM RETAIN: all its variables */
  NameId resource, configuration;
  // Functions without parameters, or none. `run` is what the task calls instead of `body`: it also copies connected
  // variables and open addresses. `setup` is called after all `init`: initial values of VAR_CONFIG.
  BodyId run = {}, setup = {};
  int32_t slot = kProgramSlot;
  // Of a test, whose instance begins and ends with its run, not with the module; `after_init` and `exit` are as those
  // of the module, or none.
  bool is_test = false;
  BodyId after_init = {}, exit = {};
};

enum class TaskKind : uint8_t { Cyclic, Freewheeling, Event, Status, External };
// What an online change needs of a list or program: functions on its record, or none.
struct BlockLife {
  bool is_list;
  uint32_t index;  // in Module::lists or programs
  BodyId refresh;  // sets constants, and variables that every change sets
  BodyId reinit;   // calls FB_Reinit of the instances that a change copies
  BodyId exit;     // FB_Exit
};
struct Task {
  NameId name;
  NameId resource;  // tasks of one resource share a processor; none: of the project
  TaskKind kind = TaskKind::Cyclic;
  int64_t interval_ns = 0;
  uint32_t priority = 0;
  // Event, Status: the BOOL variable: a Global/Program/Image place, as a path of the symbol map.
  std::string trigger;
  std::string external_event;
  int64_t watchdog_ns = 0;
  uint32_t sensitivity = 0;
  int64_t duration_ns = 0;  // simulated execution time, in virtual time only
  // Functions without parameters, or none: in front of and after the programs of each activation.
  BodyId before = {}, after = {};
};

// A located variable: name as a symbol, view of the image.
struct Located {
  NameId name;
  TypeId type;
  uint8_t area;  // AreaId
  uint32_t byte;
  uint32_t bit;                /* kNoBit: none */
  uint32_t owner_program = 0;  /* index into programs + 1; 0: a global or unnamed */
  NameId list, configuration;  // of a global: its list; and the configuration where that is a resource's
  types::SymbolAccess symbol_access = types::SymbolAccess::ReadWrite;
  bool retain = false, persistent = false;
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
  uint32_t program = 0;  // index in Module::programs
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
  struct Variable {  // of a list of globals, or located
    NameId list;     // it is named with this list, `GVL.speed`; none: by its name alone
    NameId name;
    TypeId type;
    bool in_image;
    uint32_t index, offset;  // list and field; in the image area and byte
    uint32_t bit;            // in the image; kNoBit: none
    bool constant;
    bool of_object;  // a variable of the method's block, which those of the method may hide
  };
  struct Constant {  // VAR CONSTANT; in `initial` the values that variables of the function begin with
    NameId list;     // as of a Variable
    NameId name;
    TypeId type;
    uint64_t bits;  // of a string its NameId
    bool of_object = false;
  };
  BodyId body;
  std::string_view source;       // between {C++} and {END_C++}; the sources hold it
  Loc loc;                       // where it begins
  std::string_view file_source;  // between {C++ file} and {END_C++}: definitions at file level; empty: none
  Loc file_loc;
  std::vector<Variable> variables;
  std::vector<Constant> constants, initial;
  std::vector<BodyId> functions;  // those it may call
};

// A run of a test: once, or once for each of its cases.
struct Test {
  BodyId body;   // Block or Function without parameters; a Block's instance is in `programs`
  NameId name;   // in reports
  BodyId setup;  // a function without parameters that gives the inputs of the instance their values, or none
  Loc loc;
  BodyId before = {}, after = {};  // as of a task
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
  BodyId after_init;                 // a function without parameters that runs after all initialisers, or none
  BodyId exit;                       // a function without parameters that ends all objects (FB_Exit), or none
  std::vector<BodyId> makers;        // functions on an instance that make it as a declaration without arguments does
  BodyId safe;                       // a function without parameters that sets outputs to safe values, or none
  std::vector<BlockLife> lives;      // of all lists and programs but tests; none: the module is not made for changes
  std::vector<Dispatch> dispatches;  // sorted by method
  std::vector<CppBody> cpp_bodies;
  // Functions without parameters that run before and after each test of their file.
  std::vector<BodyId> setups, teardowns;
  std::vector<Test> tests;                            // in source order
  types::MemoryAreas areas = types::standardAreas();  // `bytes`: as many as the program has
  std::vector<types::IoModule> io_modules;
  bool aligned_globals = false;  // tasks work on copies of the globals, exchanged at the alignment point

  Body& body(BodyId id) { return bodies[id.index]; }
  const Body& body(BodyId id) const { return bodies[id.index]; }
};

// The C function of a native body: `rung_standard_MID`.
std::string nativeName(const Module& module, const Body& body);
// `rung_standard`: how those of one library begin; empty: of the project.
std::string nativePrefix(std::string_view library);

}  // namespace rung::ir

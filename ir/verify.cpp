// SPDX-License-Identifier: Apache-2.0
// The verifier (see verify.h), and with it the specification of the IR. Invariants of a module:
//
//    1  Names are unique: of records, lists, program instances and tasks, each by itself; of functions and blocks
//       together; of initialisers.
//    2  A record's `init` is an Init body with that self, its `body` a Block body with that self; a list and a program
//       instance have a record type; its `run` and `setup` are functions without parameters and result; task numbers,
//       owners of located variables and tests exist.
//    3  A record comes after the records that it holds.
//    4  Data has as many bytes as its type.
//
// Invariants of a body:
//
//    5  Ids are in range. Every expression and every statement is used at most once: both form trees.
//    6  Types are those of the language: no alias, generic or untyped literal type, no Error.
//    7  Of a Function at most one local is its Result, of the body's result type; other bodies have neither parameters
//       nor Result. `by_reference` follows from kind and type (isPassedByReference). Two named locals have two names,
//       two temps too.
//    8  Block and Init bodies have a record as self; `self` is used only in bodies that have one.
//    9  A Const is a scalar or null, its bits extended as its type demands; a String has a string type, a Data its
//       item's type, Zero an array, record or string type.
//   10  Local, Global, Program and Image name what exists and have its type; an image view lies inside its area, and
//       has a bit 0..7 only as a BOOL.
//   11  Field: a field of a record place, of the field's type; null check only if the field is by reference.
//   12  Index: an array place, one index of integer type per dimension, the element type; index check only.
//   13  Deref: of a pointer or reference, of its target type; null and cast check only.
//   14  Bits: of a place of integer or bit string type; BOOL, BYTE, WORD or DWORD, inside the width.
//   15  Unary, Binary: the operator takes that many operands. Operands have one plain type, which is the operator's
//       (comparisons are BOOL; a shift's right operand is any integer, a power's any number). Div check only on
//       integer division, MOD and power; overflow check on numbers; no other. Only sums, products and negations of
//       integers, and Convert between integers, can be marked as uncut.
//   16  Convert: scalar to scalar, string to string, pointer to pointer; subrange, convert and overflow check only.
//       Rounding away from zero: REAL or LREAL to integer.
//   17  Select: a BOOL condition, two operands of its type.
//   18  Call in an expression: a pure function that cannot fault, one value per parameter.
//   19  Address: a pointer or reference to a place that has one (no bit).
//   20  Assign: a place that is not a by-reference Input, a value of its type (strings: of its kind).
//   21  Bind: a by-reference field, a place of the field's type or nothing.
//   22  Call statement: one operand per parameter, a value of its type or, for a by-reference one, a place (none only
//       for an output); a self place of the callee's record where it has one; a result place only of a function with
//       result, of its type.
//   23  If, Assert: conditions are BOOL. Assert: as many operands as its kind takes; with a source for its sides, both.
//   24  Switch: an integer, bit string or enumeration as selector; ranges in the selector's order, low <= high, no
//       value twice.
//   25  For: an integer control place without checks; from, to and step of its plain type; step a Const other than 0.
//   26  Break and continue are inside a loop, continue not in its `next` block.
//   27  A label is placed exactly once, in the block of each jump to it or in one around that; labels have distinct
//       names; a body with labels says so (`has_labels`).
//   28  Fault: one of the faults. Try: its number goes to an integer place.
//   29  A body with a check, a fault or a call of a body that may fault `may_fault`; a pure one may not, and neither
//       assigns outside of its locals nor calls what is not pure.
//   30  A native body and an abstract one have no code.
//   31  Classes have distinct records that are not laid over a base of a later class; a virtual call is of a method
//       that has a dispatch; a dispatch names methods with the parameters of its method, on classes that exist. An
//       abstract method is called virtually only.
#include "ir/verify.h"

#include <algorithm>
#include <type_traits>
#include <unordered_set>

#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::ir {

using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

bool isPointer(TypeKind kind) { return kind == TypeKind::Pointer || kind == TypeKind::Reference; }
bool isIntegral(TypeKind kind) { return TypeTable::isInteger(kind) || TypeTable::isBits(kind); }
class Verifier {
 public:
  explicit Verifier(const Module& module) : module_(module), types_(module.types) {}
  std::vector<std::string> problems;

  void checkModule();
  void checkDispatches();
  bool hasDispatch(BodyId method) const;
  void checkBody(const Body& body);

 private:
  // `what` is a string, or a function that returns one: strings are built only when a rule is broken.
  template <class Text>
  bool require(bool holds, int rule, const Text& what) {
    if (holds) return true;
    if constexpr (std::is_invocable_v<Text>)
      report(rule, what());
    else
      report(rule, what);
    return false;
  }
  void report(int rule, std::string_view what);
  std::string toString(TypeId type) const { return types_.toString(type); }

  void checkMemory();
  void checkTasks();
  void checkTests();
  void checkRecordOrder();
  void requireUnique(NameId name, std::string_view what, NameId resource = {});  // among those since seen_ was empty
  void requireCallable(BodyId id);
  bool isRecord(TypeId type) const;
  bool isBodyOf(BodyId id, BodyKind kind, TypeId record) const;
  bool known(TypeId type);
  void locals();
  void block(StmtId first);
  void stmt(StmtId id);
  void assignStmt(const AssignStmt& s);
  void bindStmt(const BindStmt& s);
  void callStmt(const CallStmt& s);
  void switchStmt(const SwitchStmt& s);
  void loopBlock(StmtId first, bool is_next);
  void forStmt(const ForStmt& s);
  void label(uint32_t label);
  void assertStmt(const AssertStmt& s);
  void callOperands(const Body& callee, Slice<ExprId> operands, int rule, bool pure);
  bool value(ExprId id);  // checks the tree below; false when there is none
  bool place(ExprId id, int rule);
  void node(const Expr& e);
  void placeNode(const Expr& e);
  void constant(const Expr& e);
  void image(const Expr& e);
  bool requireBase(ExprId base, int rule);
  void field(const Expr& e);
  void element(const Expr& e);
  void bits(const Expr& e);
  void conversion(const Expr& e);
  void pureCall(const Expr& e);
  void operatorNode(const Expr& e, Op op, ExprId first, ExprId second);  // second: none for one operand
  bool fits(TypeId place_type, TypeId value_type) const;
  TypeId typeOf(ExprId id) const { return body_->expr(id).type; }
  TypeKind plainOf(ExprId id) const { return types_.plainKind(typeOf(id)); }
  void wantType(const Expr& e, TypeId type, int rule) {
    require(e.type == types_.resolve(type), rule,
            [&] { return "the node is " + toString(e.type) + ", but it refers to " + toString(types_.resolve(type)); });
  }
  void allowChecks(const Expr& e, int rule) { allowChecks(e, checksOf(e.kind), rule); }
  void allowChecks(const Expr& e, unsigned allowed, int rule) {
    require((e.checks & ~allowed) == 0, rule, "a check that this node cannot have");
  }

  const Module& module_;
  const TypeTable& types_;
  const Body* body_ = nullptr;
  std::unordered_set<uint64_t> seen_;  // names of the module
  std::vector<bool> expr_seen_, stmt_seen_;
  std::vector<uint32_t> label_block_;  // by label: the number of the block that contains it, or 0
  std::vector<uint32_t> open_blocks_;
  std::vector<std::pair<uint32_t, std::vector<uint32_t>>> jumps_;  // label, blocks around
  uint32_t block_count_ = 0;
  uint32_t loops_ = 0;
  bool in_next_ = false;
  bool found_fault_ = false, found_effect_ = false;
};

void Verifier::report(int rule, std::string_view what) {
  std::string line = "[" + std::to_string(rule) + "] ";
  if (body_ != nullptr) line += "body `" + std::string(module_.names.string(body_->name)) + "`: ";
  problems.push_back(line + std::string(what));
}

// ---- module

void Verifier::requireUnique(NameId name, std::string_view what, NameId resource) {
  require(seen_.insert(uint64_t{resource.index} << 32 | name.index).second, 1,
          [&] { return "duplicate " + std::string(what) + " `" + std::string(module_.names.string(name)) + "`"; });
}

bool Verifier::isRecord(TypeId type) const {
  return type.index < types_.count() && types_.kind(type) == TypeKind::Record;
}

bool Verifier::isBodyOf(BodyId id, BodyKind kind, TypeId record) const {
  if (!id) return true;
  if (id.index >= module_.bodies.size()) return false;
  const Body& body = module_.body(id);
  return body.kind == kind && types_.resolve(body.self) == types_.resolve(record);
}

void Verifier::requireCallable(BodyId id) {
  const Body* const body = id.index < module_.bodies.size() ? &module_.body(id) : nullptr;
  require(!id || (body != nullptr && body->kind == BodyKind::Function && !body->result && parameters(*body).empty()), 2,
          "what a task or program instance calls is not a function without parameters and result");
}

void Verifier::checkModule() {
  checkMemory();
  checkTasks();
  checkTests();
  seen_.clear();
  for (size_t i = 1; i < module_.bodies.size(); ++i)
    if (module_.bodies[i].kind != BodyKind::Init) requireUnique(module_.bodies[i].name, "body");
  seen_.clear();
  for (size_t i = 1; i < module_.bodies.size(); ++i)
    if (module_.bodies[i].kind == BodyKind::Init) requireUnique(module_.bodies[i].name, "initialiser");
  checkRecordOrder();
  checkDispatches();
  for (const Data& data : module_.data)
    require(known(data.type) && types_.info(types_.resolve(data.type)).size == data.bytes.size(), 4,
            [&] { return "data does not have the size of its type " + toString(data.type); });
}

// Records, lists and program instances, with their bodies.
void Verifier::checkMemory() {
  seen_.clear();
  for (const Record& record : module_.records) {
    requireUnique(record.name, "record");
    require(isRecord(record.type), 2, "a record without a record type");
    require(isBodyOf(record.init, BodyKind::Init, record.type), 2, "the init of a record does not belong to it");
    require(isBodyOf(record.body, BodyKind::Block, record.type), 2, "the body of a record does not belong to it");
  }
  seen_.clear();
  for (const List& list : module_.lists) {
    requireUnique(list.name, "list");
    require(isRecord(list.record), 2, "a list without a record type");
    require(isBodyOf(list.init, BodyKind::Init, list.record), 2, "the init of a list does not belong to its record");
  }
  seen_.clear();
  for (const ProgramInstance& program : module_.programs) {
    requireUnique(program.name, "program instance", program.resource);
    require(isRecord(program.record), 2, "a program instance without a record type");
    require(isBodyOf(program.init, BodyKind::Init, program.record), 2,
            "the init of a program does not belong to its record");
    require(isBodyOf(program.body, BodyKind::Block, program.record), 2,
            "the body of a program does not belong to its record");
    require(program.task <= module_.tasks.size(), 2, "a program in a task that does not exist");
    for (BodyId function : {program.run, program.setup, program.after_init, program.exit}) requireCallable(function);
  }
}

void Verifier::checkTasks() {
  for (BodyId function : {module_.after_init, module_.exit, module_.safe}) requireCallable(function);
  for (const BlockLife& life : module_.lives)
    for (BodyId function : {life.refresh, life.reinit, life.exit}) requireCallable(function);
  for (const Task& task : module_.tasks)
    for (BodyId function : {task.before, task.after}) requireCallable(function);
  for (const BodyId maker : module_.makers)
    require(maker.index < module_.bodies.size() && isRecord(module_.body(maker).self), 2,
            "a maker without an instance");
  seen_.clear();
  for (const Task& task : module_.tasks) requireUnique(task.name, "task", task.resource);
  for (const Located& located : module_.located)
    require(located.owner_program <= module_.programs.size(), 2, "a located variable of a program that does not exist");
}

void Verifier::checkTests() {
  for (const Test& test : module_.tests) {
    require(test.body && test.body.index < module_.bodies.size() && module_.body(test.body).kind != BodyKind::Init, 2,
            "a test is not a function or block");
    require(!test.setup ||
                (test.setup.index < module_.bodies.size() && module_.body(test.setup).kind == BodyKind::Function &&
                 parameters(module_.body(test.setup)).empty()),
            2, "the setup of a test is not a function without parameters");
  }
}

bool Verifier::hasDispatch(BodyId method) const {
  return std::any_of(module_.dispatches.begin(), module_.dispatches.end(),
                     [&](const Dispatch& dispatch) { return dispatch.method == method; });
}

void Verifier::checkDispatches() {
  std::unordered_set<uint32_t> seen;
  for (const Class& one : module_.classes) {
    require(!one.base || seen.count(one.base.index) != 0, 31, "a class before its base");
    require(one.record && types_.kind(one.record) == TypeKind::Record && seen.insert(one.record.index).second, 31,
            "a class does not have its own record");
  }
  for (const Dispatch& dispatch : module_.dispatches) {
    const Body& method = module_.body(dispatch.method);
    require(dispatch.first >= 1 && dispatch.first - 1 + dispatch.bodies.size() <= module_.classes.size(), 31,
            "a dispatch of a class that does not exist");
    for (BodyId id : dispatch.bodies) {
      if (!id) continue;
      const Body& body = module_.body(id);
      std::vector<const Local*> wanted, given;
      for (const Local& parameter : parameters(method)) wanted.push_back(&parameter);
      for (const Local& parameter : parameters(body)) given.push_back(&parameter);
      bool same = body.self && wanted.size() == given.size() &&
                  types_.resolve(method.result) == types_.resolve(body.result) && !body.abstract;
      for (size_t i = 0; same && i < wanted.size(); ++i)
        same = wanted[i]->kind == given[i]->kind && types_.resolve(wanted[i]->type) == types_.resolve(given[i]->type);
      require(same, 31, "a dispatch to a method with other parameters");
    }
  }
}

void Verifier::checkRecordOrder() {
  std::vector<bool> later(types_.count());
  for (const Record& record : module_.records)
    if (record.type.index < types_.count()) later[types_.resolve(record.type).index] = true;
  for (const Record& record : module_.records) {
    if (record.type.index >= types_.count()) continue;
    for (const types::Field& field : types_.info(types_.resolve(record.type)).fields) {
      if (field.by_reference) continue;
      TypeId held = types_.resolve(field.type);
      while (types_.info(held).kind == TypeKind::Array) held = types_.resolve(types_.info(held).base);
      require(!later[held.index], 3, [&] {
        return toString(record.type) + " contains " + toString(held) + ", which is not declared before it";
      });
    }
    later[types_.resolve(record.type).index] = false;
  }
}

bool Verifier::known(TypeId type) {
  if (!require(type && type.index < types_.count(), 6, "a type that does not exist")) return false;
  const TypeKind kind = types_.info(type).kind;
  return require(
      TypeTable::isElementary(kind) || (kind >= TypeKind::Enum && kind != TypeKind::Alias && kind != TypeKind::Count_),
      6, [&] { return toString(type) + " is not a type of the IR"; });
}

// ---- body

void Verifier::checkBody(const Body& body) {
  body_ = &body;
  expr_seen_.assign(body.exprs.size(), false);
  stmt_seen_.assign(body.stmts.size(), false);
  label_block_.assign(body.labels.size(), 0);
  open_blocks_.clear();
  jumps_.clear();
  block_count_ = loops_ = 0;
  in_next_ = found_fault_ = found_effect_ = false;

  locals();
  if (body.kind != BodyKind::Function || body.self)
    require(body.self && body.self.index < types_.count() && types_.info(body.self).kind == TypeKind::Record, 8,
            "the self of a body is not a record");
  if (body.native || body.abstract) require(!body.first, 30, "a native or abstract body has code");
  block(body.first);

  for (const auto& [label, blocks] : jumps_) {
    const uint32_t at = label_block_[label];
    if (!require(at != 0, 27, "a jump to a label that is not placed")) continue;
    require(std::find(blocks.begin(), blocks.end(), at) != blocks.end(), 27, "a jump into a block");
  }
  if (!body.labels.empty()) require(body.has_labels, 27, "a body with labels without has_labels");
  std::unordered_set<uint32_t> names;
  for (NameId label : body.labels) require(names.insert(label.index).second, 27, "duplicate label");
  if (found_fault_) require(body.may_fault, 29, "the body may fault, but is not may_fault");
  if (body.pure) require(!body.may_fault && !found_effect_, 29, "a pure body faults or has an effect");
  body_ = nullptr;
}

void Verifier::locals() {
  std::unordered_set<uint32_t> names, temps;
  uint32_t results = 0;
  for (const Local& local : body_->locals) {
    known(local.type);
    if (local.type.index < types_.count())
      require(local.by_reference == isPassedByReference(types_, local.kind, local.type), 7,
              "by_reference of a local does not match its kind and type");
    if (local.kind == LocalKind::Result) {
      ++results;
      require(body_->result && types_.resolve(body_->result) == local.type, 7,
              "the result local is not of the result type");
    } else {
      require((local.kind == LocalKind::Temp ? temps : names).insert(local.name.index).second, 7,
              [&] { return "duplicate local `" + std::string(module_.names.string(local.name)) + "`"; });
    }
    if (body_->kind != BodyKind::Function)
      require(local.kind == LocalKind::Temp || local.kind == LocalKind::Variable, 7,
              "parameters in a body that has none");
  }
  require(results <= 1, 7, "two result locals");
}

void Verifier::block(StmtId first) {
  if (!first) return;
  open_blocks_.push_back(++block_count_);
  for (StmtId id = first; id; id = body_->stmt(id).next) {
    if (!require(id.index < body_->stmts.size(), 5, "a statement id out of range")) break;
    if (!require(!stmt_seen_[id.index], 5, "a statement is used twice")) break;
    stmt_seen_[id.index] = true;
    stmt(id);
  }
  open_blocks_.pop_back();
}

bool Verifier::fits(TypeId place_type, TypeId value_type) const {
  if (place_type == value_type || place_type == types_.plain(value_type)) return true;
  const TypeKind a = types_.kind(place_type), b = types_.kind(value_type);
  if (TypeTable::isString(a)) return a == b;
  if (isPointer(a) && isPointer(b))
    return types_.resolve(types_.info(place_type).base) == types_.resolve(types_.info(value_type).base);
  return false;
}

void Verifier::assignStmt(const AssignStmt& s) {
  if (!place(s.place, 20) | !value(s.value)) return;
  require(fits(typeOf(s.place), typeOf(s.value)), 20,
          [&] { return toString(typeOf(s.value)) + " is assigned to " + toString(typeOf(s.place)); });
  const auto* root = body_->expr(rootOf(*body_, s.place)).tryAs<LocalExpr>();
  if (root != nullptr && root->local < body_->locals.size()) {
    const Local& local = body_->locals[root->local];
    require(!(local.by_reference && local.kind == LocalKind::Input), 20, "a by-reference input is assigned");
    // A local pointer inside a record local stays local; Deref is another root.
  } else {
    found_effect_ = true;
  }
}

void Verifier::bindStmt(const BindStmt& s) {
  if (!place(s.field, 21) || (s.place && !place(s.place, 21))) return;
  const auto* field = body_->expr(s.field).tryAs<FieldExpr>();
  require(field != nullptr && types_.info(typeOf(field->base)).fields[field->field].by_reference, 21,
          "bind of something other than a by-reference field");
  require(!s.place || typeOf(s.field) == typeOf(s.place), 21, "bind of a place with another type");
  found_effect_ = true;
}

// The blocks of a Loop or For. Its `next` block is not a place to continue from.
void Verifier::loopBlock(StmtId first, bool is_next) {
  ++loops_;
  const bool outer = in_next_;
  in_next_ = is_next;
  block(first);
  in_next_ = outer;
  --loops_;
}

void Verifier::forStmt(const ForStmt& s) {
  if (!place(s.control, 25)) return;
  const TypeKind control = plainOf(s.control);
  require(isIntegral(control), 25, [&] { return "a FOR over " + toString(typeOf(s.control)); });
  forEachExpr(*body_, s.control, [&](ExprId part) {
    require(body_->expr(part).checks == 0, 25, "a check in the control place of a FOR");
  });
  for (const ExprId bound : {s.from, s.to, s.step})
    if (value(bound)) require(plainOf(bound) == control, 25, "a FOR bound does not have the type of its control");
  if (s.step.index < body_->exprs.size()) {
    const auto* step = body_->expr(s.step).tryAs<ConstExpr>();
    require(step != nullptr && step->bits != 0, 25, "a FOR step is not a constant other than 0");
  }
  if (body_->expr(rootOf(*body_, s.control)).kind != ExprKind::Local) found_effect_ = true;
}

void Verifier::label(uint32_t label) {
  if (!require(label < body_->labels.size(), 27, "a label that does not exist")) return;
  require(label_block_[label] == 0, 27, "a label is placed twice");
  label_block_[label] = open_blocks_.back();
}

void Verifier::assertStmt(const AssertStmt& s) {
  const int wanted = s.assertion == Assertion::Assert ? (s.shown ? 3 : 1) : s.assertion == Assertion::AssertEq ? 2 : 3;
  const int given = static_cast<bool>(s.first) + static_cast<bool>(s.second) + static_cast<bool>(s.third);
  require(s.assertion <= Assertion::AssertNear && given == wanted && s.first, 23,
          "an assertion with too many or too few operands");
  if (s.first && value(s.first) && s.assertion == Assertion::Assert)
    require(types_.kind(typeOf(s.first)) == TypeKind::Bool, 23, "the condition of an assertion is not a BOOL");
  if (s.second) value(s.second);
  if (s.third) value(s.third);
  if (s.message && value(s.message))
    require(types::TypeTable::isString(types_.kind(typeOf(s.message))) && !s.text, 23,
            "the message of an assertion is a string");
  found_effect_ = true;
}

void Verifier::stmt(StmtId id) {
  const Stmt& s = body_->stmt(id);
  switch (s.kind) {
    case StmtKind::None: require(false, 5, "a statement without kind"); return;
    case StmtKind::Assign: return assignStmt(s.as<AssignStmt>());
    case StmtKind::Bind: return bindStmt(s.as<BindStmt>());
    case StmtKind::Call: return callStmt(s.as<CallStmt>());
    case StmtKind::If: {
      const IfStmt& node = s.as<IfStmt>();
      if (value(node.condition))
        require(types_.kind(typeOf(node.condition)) == TypeKind::Bool, 23, "the condition is not a BOOL");
      block(node.then_block);
      return block(node.else_block);
    }
    case StmtKind::Switch: return switchStmt(s.as<SwitchStmt>());
    case StmtKind::Loop:
      loopBlock(s.as<LoopStmt>().body_block, false);
      return loopBlock(s.as<LoopStmt>().next_block, true);
    case StmtKind::For: forStmt(s.as<ForStmt>()); return loopBlock(s.as<ForStmt>().body_block, false);
    case StmtKind::Break: require(loops_ > 0, 26, "break outside of a loop"); return;
    case StmtKind::Continue: require(loops_ > 0 && !in_next_, 26, "continue outside of a loop"); return;
    case StmtKind::Return: return;
    case StmtKind::Jump: {
      const uint32_t to = s.as<JumpStmt>().label;
      if (require(to < body_->labels.size(), 27, "a jump to a label that does not exist"))
        jumps_.push_back({to, open_blocks_});
      return;
    }
    case StmtKind::Label: return label(s.as<LabelStmt>().label);
    case StmtKind::Try: {
      const TryStmt& node = s.as<TryStmt>();
      block(node.body_block);
      if (node.number && place(node.number, 28))
        require(isIntegral(plainOf(node.number)), 28,
                "the number of a fault is assigned to something other than an integer");
      block(node.catch_block);
      return block(node.finally_block);
    }
    case StmtKind::Fault: {
      const FaultStmt& node = s.as<FaultStmt>();
      require(node.fault > types::Fault::None && node.fault <= types::Fault::Lock, 28, "a fault that does not exist");
      if (node.value) value(node.value);
      found_fault_ = true;
      return;
    }
    case StmtKind::Assert: return assertStmt(s.as<AssertStmt>());
    case StmtKind::Evaluate: value(s.as<EvaluateStmt>().value); return;
  }
}

void Verifier::callOperands(const Body& callee, Slice<ExprId> operands, int rule, bool pure) {
  const uint32_t wanted_count = parameters(callee).count();
  if (!require(wanted_count == operands.count && operands.first + operands.count <= body_->operands.size(), rule, [&] {
        return "a call to `" + std::string(module_.names.string(callee.name)) + "` with " +
               std::to_string(operands.count) + " operands for " + std::to_string(wanted_count) + " parameters";
      }))
    return;
  uint32_t i = 0;
  for (const Local& parameter : parameters(callee)) {
    const ExprId id = body_->list(operands)[i++];
    if (!id) {
      require(parameter.kind == LocalKind::Output && !pure, rule, "an operand other than an output is missing");
      continue;
    }
    if (!value(id)) continue;
    const bool is_value = parameter.kind == LocalKind::Input;
    if (!is_value) {
      require(isPlace(body_->expr(id).kind), rule, "a by-reference operand is not a place");
      if (body_->expr(rootOf(*body_, id)).kind != ExprKind::Local) found_effect_ = true;
    }
    const TypeId wanted = types_.resolve(parameter.type), given = typeOf(id);
    // A string of any capacity may be passed for an in-out or input string; ARRAY[*] takes every array of its element.
    const bool same_string_kind = TypeTable::isString(types_.kind(wanted)) && types_.kind(wanted) == types_.kind(given);
    const bool open_array = types_.kind(wanted) == TypeKind::Array && types_.info(wanted).dimensions.empty() &&
                            types_.kind(given) == TypeKind::Array;
    const bool same_bits =
        TypeTable::haveSameBits(types_.kind(wanted), types_.kind(given));  // one type in generated code
    require((is_value ? fits(wanted, given) : wanted == given) || same_string_kind || open_array || same_bits, rule,
            [&] { return toString(given) + " is passed to a parameter of " + toString(wanted); });
  }
}

void Verifier::callStmt(const CallStmt& s) {
  if (!require(s.callee && s.callee.index < module_.bodies.size(), 22, "a call to a body that does not exist")) return;
  const Body& callee = module_.body(s.callee);
  if (callee.may_fault) found_fault_ = true;
  if (!callee.pure) found_effect_ = true;
  if (require(static_cast<bool>(s.self) == static_cast<bool>(callee.self), 22,
              "a call has a self and its callee has none, or the reverse") &&
      s.self && place(s.self, 22))
    require(typeOf(s.self) == types_.resolve(callee.self), 22, [&] { return "a call on " + toString(typeOf(s.self)); });
  callOperands(callee, s.operands, 22, false);
  if (s.is_virtual) {
    found_fault_ = true;
    require(callee.kind == BodyKind::Function && callee.self && hasDispatch(s.callee), 31,
            "a virtual call to a body without a dispatch");
  } else {
    require(!callee.abstract, 31, "a non-virtual call to an abstract method");
  }
  if (s.result && place(s.result, 22))
    require(callee.result && fits(typeOf(s.result), types_.resolve(callee.result)), 22,
            "the result does not have the type of its place");
}

void Verifier::switchStmt(const SwitchStmt& s) {
  if (!value(s.selector)) return;
  const TypeKind kind = plainOf(s.selector);
  require(isIntegral(kind), 24, [&] { return "a switch over " + toString(typeOf(s.selector)); });
  const bool is_signed = types_.isSigned(kind);
  auto less = [&](int64_t a, int64_t b) {
    return is_signed ? a < b : static_cast<uint64_t>(a) < static_cast<uint64_t>(b);
  };
  std::vector<CaseRange> all;
  if (!require(s.cases.first + s.cases.count <= body_->cases.size(), 5, "cases out of range")) return;
  for (const Case& one : body_->list(s.cases)) {
    if (!require(one.ranges.first + one.ranges.count <= body_->ranges.size(), 5, "case ranges out of range")) return;
    require(!one.ranges.empty(), 24, "a case without values");
    for (const CaseRange& range : body_->list(one.ranges)) {
      require(!less(range.high, range.low), 24, "a case range is reversed");
      all.push_back(range);
    }
  }
  std::sort(all.begin(), all.end(), [&](const CaseRange& a, const CaseRange& b) { return less(a.low, b.low); });
  for (size_t i = 1; i < all.size(); ++i) require(less(all[i - 1].high, all[i].low), 24, "a value in two cases");
  for (const Case& one : body_->list(s.cases)) block(one.block);
  block(s.else_block);
}

// ---- expressions

bool Verifier::place(ExprId id, int rule) {
  return value(id) && require(isPlace(body_->expr(id).kind), rule, "expected a place, found a value");
}

bool Verifier::value(ExprId id) {
  if (!require(id && id.index < body_->exprs.size(), 5, "an expression id out of range")) return false;
  if (!require(!expr_seen_[id.index], 5, "an expression is used twice")) return false;
  expr_seen_[id.index] = true;
  const Expr& e = body_->expr(id);
  if (!known(e.type)) return false;
  if (e.checks != 0) found_fault_ = true;
  const auto* index = e.tryAs<IndexExpr>();
  const auto* call = e.tryAs<CallExpr>();
  const Slice<ExprId> list = index != nullptr ? index->indices : call != nullptr ? call->operands : Slice<ExprId>{};
  bool ok = require(list.first + list.count <= body_->operands.size(), 5, "operands out of range");
  if (ok && call == nullptr) forEachOperand(*body_, e, [&](ExprId operand) { ok = value(operand) && ok; });
  if (ok) isPlace(e.kind) ? placeNode(e) : node(e);
  return ok;
}

void Verifier::constant(const Expr& e) {
  const uint64_t bits = e.as<ConstExpr>().bits;
  const TypeKind kind = types_.plainKind(e.type);
  if (!require(TypeTable::isScalar(kind) || isPointer(kind), 9, [&] { return "a constant of " + toString(e.type); }))
    return;
  if (TypeTable::isReal(kind)) {
    const double real = types::Value{e.type, bits}.asReal();
    require(kind != TypeKind::Real || real != real || static_cast<double>(static_cast<float>(real)) == real, 9,
            "a REAL constant does not fit in a REAL");
    return;
  }
  const uint32_t width = TypeTable::bitWidth(kind);
  if (width == 0 || width >= 64) return;
  const auto shift = 64 - width;
  const uint64_t extended = types_.isSigned(kind) ? static_cast<uint64_t>(static_cast<int64_t>(bits << shift) >> shift)
                                                  : bits << shift >> shift;
  require(extended == bits, 9, [&] { return "a constant whose bits do not fit " + toString(e.type); });
}

void Verifier::image(const Expr& e) {
  const ImageExpr& image = e.as<ImageExpr>();
  if (!require(image.area < module_.areas.size(), 10, "an image area that does not exist")) return;
  const uint64_t size = image.bit == kNoBit ? types_.info(e.type).size : 1;
  require(image.byte + size <= module_.areas[image.area].bytes, 10, "an image view outside of its area");
  if (image.bit == kNoBit) return;
  require(image.bit < 8 && types_.plainKind(e.type) == TypeKind::Bool, 10,
          "an image bit is out of range or not a BOOL");
}

void Verifier::bits(const Expr& e) {
  const BitsExpr& bits = e.as<BitsExpr>();
  const TypeKind kind = plainOf(bits.base), part = types_.kind(e.type);
  if (!require(isIntegral(kind), 14, [&] { return "a part of " + toString(typeOf(bits.base)); })) return;
  const bool is_part =
      part == TypeKind::Bool || part == TypeKind::Byte || part == TypeKind::Word || part == TypeKind::DWord;
  require(is_part && (uint64_t{bits.position} + 1) * TypeTable::bitWidth(part) <= TypeTable::bitWidth(kind), 14,
          [&] { return "a part outside of " + toString(typeOf(bits.base)); });
}

bool Verifier::requireBase(ExprId base, int rule) {
  return require(isPlace(body_->expr(base).kind), rule, "the base is not a place");
}

void Verifier::field(const Expr& e) {
  const FieldExpr& node = e.as<FieldExpr>();
  const TypeInfo& info = types_.info(typeOf(node.base));
  if (!requireBase(node.base, 11) || !require(info.kind == TypeKind::Record && node.field < info.fields.size(), 11,
                                              "a field of something other than a record"))
    return;
  wantType(e, info.fields[node.field].type, 11);
  allowChecks(e, info.fields[node.field].by_reference ? checksOf(e.kind) : 0u, 11);
}

void Verifier::element(const Expr& e) {
  const IndexExpr& node = e.as<IndexExpr>();
  const TypeInfo& info = types_.info(typeOf(node.base));
  if (!requireBase(node.base, 12) ||
      !require(info.kind == TypeKind::Array, 12, "an index into something other than an array"))
    return;
  require(info.dimensions.empty() || info.dimensions.size() == node.indices.count, 12,
          "the number of indices differs from the number of dimensions");
  for (const ExprId index : body_->list(node.indices))
    require(isIntegral(plainOf(index)), 12, "an index is not an integer");
  wantType(e, info.base, 12);
  const bool has_check = (e.checks & kCheckIndex) != 0;
  require(e.proven == 0 || (has_check && e.proven >> std::min(node.indices.count, kMostProven) == 0), 12,
          "a dimension without check is marked as proven");
  allowChecks(e, 12);
}

void Verifier::placeNode(const Expr& e) {
  auto names = [&](uint32_t index, const auto& list, const char* what) {
    return require(index < list.size(), 10, what);
  };
  switch (placeKind(e.kind)) {
    case PlaceKind::Local: {
      const uint32_t local = e.as<LocalExpr>().local;
      if (names(local, body_->locals, "a local that does not exist")) wantType(e, body_->locals[local].type, 10);
      return allowChecks(e, 10);
    }
    case PlaceKind::Self:
      if (require(static_cast<bool>(body_->self), 8, "self in a body that has none")) wantType(e, body_->self, 8);
      return allowChecks(e, 10);
    case PlaceKind::Global: {
      const uint32_t list = e.as<GlobalExpr>().list;
      if (names(list, module_.lists, "a list that does not exist")) wantType(e, module_.lists[list].record, 10);
      return allowChecks(e, 10);
    }
    case PlaceKind::Program: {
      const uint32_t program = e.as<ProgramExpr>().program;
      if (names(program, module_.programs, "a program that does not exist"))
        wantType(e, module_.programs[program].record, 10);
      return allowChecks(e, 10);
    }
    case PlaceKind::Image: image(e); return allowChecks(e, 10);
    case PlaceKind::Field: return field(e);
    case PlaceKind::Index: return element(e);
    case PlaceKind::Deref: {
      const TypeInfo& info = types_.info(typeOf(e.as<DerefExpr>().pointer));
      if (!require(isPointer(info.kind), 13, "a deref of something other than a pointer")) return;
      wantType(e, info.base, 13);
      return allowChecks(e, 13);
    }
    case PlaceKind::Bits:
      if (requireBase(e.as<BitsExpr>().base, 14)) bits(e);
      return allowChecks(e, 15);
  }
}

void Verifier::conversion(const Expr& e) {
  const ExprId operand = e.as<ConvertExpr>().operand;
  const TypeKind from = plainOf(operand), to = types_.plainKind(e.type);
  require((TypeTable::isScalar(from) && TypeTable::isScalar(to)) ||
              (TypeTable::isString(from) && TypeTable::isString(to)) ||
              ((isPointer(from) || isIntegral(from)) && isPointer(to)) || (isPointer(from) && isIntegral(to)),
          16, [&] { return "a conversion of " + toString(typeOf(operand)) + " to " + toString(e.type); });
  require(e.as<ConvertExpr>().rounding == types::Rounding::ToEven ||
              (TypeTable::isReal(from) && TypeTable::isScalar(to) && !TypeTable::isReal(to) && to != TypeKind::Bool),
          16, [&] { return "a rounding of " + toString(typeOf(operand)) + " to " + toString(e.type); });
  require(e.proven == 0 || (isIntegral(from) && isIntegral(to)), 16, "a conversion of other than integers has `=`");
  allowChecks(e, 16);
}

void Verifier::pureCall(const Expr& e) {
  const CallExpr& call = e.as<CallExpr>();
  if (!require(call.callee && call.callee.index < module_.bodies.size(), 18, "a call to a body that does not exist"))
    return;
  const Body& callee = module_.body(call.callee);
  require(callee.pure && !callee.may_fault && callee.kind == BodyKind::Function && callee.result, 18, [&] {
    return "`" + std::string(module_.names.string(callee.name)) + "` is called in an expression but is not pure";
  });
  if (callee.result) wantType(e, callee.result, 18);
  for (const Local& parameter : parameters(callee))
    require(parameter.kind == LocalKind::Input, 18, "a call in an expression with an output");
  callOperands(callee, call.operands, 18, true);
}

void Verifier::node(const Expr& e) {
  switch (valueKind(e.kind)) {
    case ValueKind::None: require(false, 5, "an expression without kind"); return;
    case ValueKind::Const: constant(e); return allowChecks(e, 9);
    case ValueKind::String:
      require(TypeTable::isString(types_.kind(e.type)), 9, [&] { return "a string constant of " + toString(e.type); });
      return allowChecks(e, 9);
    case ValueKind::Data: {
      const uint32_t index = e.as<DataExpr>().index;
      if (require(index < module_.data.size(), 9, "data that does not exist")) wantType(e, module_.data[index].type, 9);
      return allowChecks(e, 9);
    }
    case ValueKind::Zero:
      require(isAggregate(types_, e.type), 9, [&] { return "zero of " + toString(e.type); });
      return allowChecks(e, 9);
    case ValueKind::Unary: {
      const UnaryExpr& node = e.as<UnaryExpr>();
      return operatorNode(e, node.op, node.operand, {});
    }
    case ValueKind::Binary: {
      const BinaryExpr& node = e.as<BinaryExpr>();
      return operatorNode(e, node.op, node.left, node.right);
    }
    case ValueKind::Convert: return conversion(e);
    case ValueKind::Select: {
      const SelectExpr& node = e.as<SelectExpr>();
      require(types_.kind(typeOf(node.condition)) == TypeKind::Bool, 17, "the condition of a select is not a BOOL");
      require(fits(e.type, typeOf(node.when_true)) && fits(e.type, typeOf(node.when_false)), 17,
              "a select does not have the type of its operands");
      return allowChecks(e, 15);
    }
    case ValueKind::Call: pureCall(e); return allowChecks(e, 15);
    case ValueKind::Address: {
      const Expr& target = body_->expr(e.as<AddressExpr>().place);
      require(isPointer(types_.kind(e.type)), 19, [&] { return "an address of type " + toString(e.type); });
      require(isPlace(target.kind) && target.kind != ExprKind::Bits && !isImageBit(target), 19,
              "the address of something that has none");
      return allowChecks(e, 15);
    }
  }
}

void Verifier::operatorNode(const Expr& e, Op op, ExprId first, ExprId second) {
  require(e.proven == 0 || op == Op::Add || op == Op::Sub || op == Op::Mul || op == Op::Neg, 15,
          "an operator that cuts nothing has `=`");
  const std::string_view word = types::word(op);
  if (!require(types::operandCount(op) == (second ? 2 : 1), 15,
               [&] { return std::string(word) + " has the wrong number of operands"; }))
    return;
  const TypeId left = types_.plain(typeOf(first));
  const TypeKind kind = types_.kind(left);
  if (types::isComparison(op))
    require(types_.kind(e.type) == TypeKind::Bool, 15, [&] { return std::string(word) + " is not a BOOL"; });
  else
    require(types_.plain(e.type) == left || (TypeTable::isString(kind) && types_.kind(e.type) == kind), 15,
            [&] { return std::string(word) + " of " + toString(typeOf(first)) + " gives " + toString(e.type); });
  if (second) {
    const TypeId right = types_.plain(typeOf(second));
    const TypeKind right_kind = types_.kind(right);
    const bool is_shift = types::isShift(op);
    const bool same = left == right || (TypeTable::isString(kind) && kind == right_kind) ||
                      (isPointer(kind) && isPointer(right_kind));
    if (is_shift)
      require(isIntegral(right_kind), 15, [&] { return std::string(word) + " by " + toString(typeOf(second)); });
    else if (op == Op::Power)
      require(isIntegral(right_kind) || TypeTable::isReal(right_kind), 15,
              [&] { return std::string(word) + " to " + toString(typeOf(second)); });
    else
      require(same, 15, [&] {
        return std::string(word) + " of " + toString(typeOf(first)) + " and " + toString(typeOf(second));
      });
  }
  unsigned allowed = 0;
  const bool number = TypeTable::isScalar(kind) && kind != TypeKind::Bool;
  if (number) allowed |= kCheckOverflow;
  if (number && !TypeTable::isReal(kind) && (op == Op::Div || op == Op::Mod || op == Op::Power)) allowed |= kCheckDiv;
  allowChecks(e, allowed, 15);
}

}  // namespace

std::vector<std::string> verify(const Module& module) {
  Verifier verifier(module);
  verifier.checkModule();
  for (size_t i = 1; i < module.bodies.size(); ++i) verifier.checkBody(module.bodies[i]);
  return std::move(verifier.problems);
}

std::vector<std::string> verify(const Module& module, const Body& body) {
  Verifier verifier(module);
  verifier.checkBody(body);
  return std::move(verifier.problems);
}

}  // namespace rung::ir

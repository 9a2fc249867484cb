// The parts of lowering and what they share. Internal to ir/lower/. ModuleLowering (module.cpp) declares the bodies,
// records and instances of a project; BodyLowering walks one checked body and appends IR to it. Each of its subjects is
// a file: places, values, aliases, calls, objects, statements, initial_values, …
#pragma once

#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "frontend/source/function_ref.h"
#include "ir/builder.h"
#include "ir/lower.h"
#include "ir/walk.h"
#include "sema/project.h"

namespace rung::ir {

using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;
using types::Value;

struct ModuleLowering {
  ModuleLowering(const sema::Project& from, const LowerOptions& with, Module& to);

  void run();
  // Lowers the requested bodies and those that they request. Stops at one whose POU is not checked, and returns that.
  sema::PouId lowerBodies();
  void lowerCpp(sema::PouId id);
  // Lists and instances as known while the project is being checked, without their memory and code.
  void addNames();
  // The body of a POU's code; declares its parameters when first asked for.
  BodyId bodyOf(sema::PouId pou);
  // The initialiser of a record, or none when its initial value is all zeros.
  BodyId initOf(TypeId record);
  uint32_t listIndex(sema::ListId list) const { return list_index[list.index]; }
  // The instance that a program's name means; created when the program has none.
  uint32_t instanceOf(sema::PouId program);
  // The function that tests whether a type id is that of an object of this kind.
  BodyId kindTestOf(sema::PouId wanted);
  bool isKindOf(sema::PouId object, sema::PouId base) const;
  BodyId blockCallOf(sema::PouId block);
  // FB_Init or FB_Exit of an object and of the objects that it extends, the outermost base first.
  std::vector<sema::PouId> lifeMethodsOf(sema::PouId object, std::string_view name) const;
  // exits.cpp: whether a type holds an object with FB_Exit; the function that ends those of a record, or none; the
  // same in the form of a function that a dispatch table can hold.
  bool hasExit(TypeId type);
  BodyId exitOf(TypeId record);
  BodyId exitCallOf(sema::PouId object);
  bool checksCasts() const { return (options.checks & kCheckCast) != 0; }
  // The variable whose declaration gives arguments to FB_Init, in a field of a record; or null.
  const sema::Var* constructedVar(TypeId record, uint32_t field) const;
  // The record of the object that a POU's code runs on; none in functions.
  sema::PouId objectOf(sema::PouId pou) const;
  sema::PouId pouOfRecord(TypeId record) const {
    return record.index < pou_of_record_.size() ? pou_of_record_[record.index] : sema::PouId{};
  }
  uint32_t programOfInstance(uint32_t instance) const { return program_of_instance_[instance] - 1; }
  bool isZero(TypeId type);  // initial value of a type: all bytes zero

  const sema::Project& project;
  const LowerOptions& options;
  Module& module;
  const Tree& tree;
  TypeTable& types;
  bool partial = false;  // only one function: see lowerFunction

  void declareRecordsOf(TypeId type);

 private:
  void addRecord(TypeId record);
  void addPrograms();
  void addLists();
  void markFaulting();
  void addClasses();
  void fillKindTests();
  BodyId addHelper(NameId name, sema::PouId object, const char* suffix);
  BodyId endsOf(NameId name, const char* suffix, std::span<const uint32_t> lists, std::span<const uint32_t> programs);
  void addExit();
  void addDispatches();
  sema::PouId implementation(sema::PouId object, sema::PouId method) const;
  void addTasks();
  void addActivations();
  void addActivation(uint32_t program, const sema::ProgramInstance* instance,
                     std::span<const sema::InstancePath> places);
  void addLocated();
  void addAccessPaths();
  void addBlockTasks();
  std::string pathOf(sema::VarId var);

  std::vector<BodyId> body_of_;                                 // by PouId
  std::unordered_map<uint32_t, BodyId> init_of_;                // by record TypeId
  std::unordered_map<uint32_t, BodyId> exit_of_;                // by record TypeId
  std::unordered_map<uint32_t, bool> has_exit_;                 // by record TypeId
  std::unordered_set<uint32_t> record_seen_;                    // by TypeId
  std::unordered_map<uint32_t, bool> zero_;                     // by TypeId
  std::unordered_map<uint64_t, const sema::Var*> constructed_;  // by record and field
  std::vector<sema::PouId> pou_of_record_;                      // by TypeId
  std::vector<sema::ListId> list_of_record_;                    // by TypeId
  std::vector<uint32_t> list_index;                             // by ListId
  std::vector<uint32_t> program_of_instance_;                   // by sema instance: index in Module::programs + 1
  std::unordered_map<uint32_t, uint32_t> instance_of_;          // by PouId: index in Module::programs
  std::vector<sema::PouId> to_lower_;
  std::vector<std::pair<sema::PouId, BodyId>> kind_tests_, block_calls_;
  size_t next_to_lower_ = 0;
};

// The scalar or string value of a checked constant expression; none when it is not that simple.
std::optional<Value> constantOf(const sema::Project& project, rung::ExprId expr);

inline bool isOpenArray(const TypeTable& types, TypeId type) { return type && types.isOpenArray(type); }

class BodyLowering {
 public:
  BodyLowering(ModuleLowering& in, Body& body, sema::PouId pou);

  void lowerPou();
  // For Init bodies: code that gives `place` the initial value of a variable of `type` declared with `init` (or none).
  void storeInitial(ExprId place, TypeId type, rung::ExprId init, bool place_is_zero);
  // activation.cpp: the code of ProgramInstance::run and setup. without connections there is no `call`.
  void lowerActivation(uint32_t program, BodyId code, rung::ExprId call, std::span<const sema::InstancePath> places);
  void lowerSetup(uint32_t program, std::span<const sema::InstancePath> places);

  // A call of the block in a field of a program instance.
  void lowerBlockTask(uint32_t program, sema::VarId block);

  // ---- building
  template <class T>
  ExprId add(Loc loc, TypeId type, const T& fields, uint8_t checks = 0) {
    Expr expr;
    expr.checks = checks;
    expr.type = type;
    expr.loc = loc;
    expr.set(fields);
    return addExpr(expr);
  }
  template <class T>
  StmtId append(Loc loc, const T& fields) {
    Stmt stmt;
    stmt.loc = loc;
    stmt.set(fields);
    return appendStmt(stmt);
  }
  Slice<ExprId> list(std::span<const ExprId> operands);
  ExprId constant(TypeId type, uint64_t bits, Loc loc);
  ExprId constantBool(bool value, Loc loc) { return constant(types::kBool, value ? 1 : 0, loc); }
  ExprId stringConstant(TypeId type, NameId string, Loc loc);
  ExprId ofValue(const Value& value, Loc loc);
  ExprId zero(TypeId type, Loc loc);  // a scalar's 0, else all bytes zero
  ExprId local(uint32_t index, Loc loc);
  ExprId temp(TypeId type, Loc loc);  // a new temporary, as a place
  ExprId field(ExprId base, uint32_t index, TypeId type, Loc loc);
  ExprId element(ExprId array, std::span<const ExprId> indices, Loc loc);  // without check
  void callOn(BodyId callee, ExprId self, Loc loc);
  ExprId self(Loc loc);
  // The place of an object as what it extends.
  ExprId asBase(ExprId place, sema::PouId base, Loc loc);
  ExprId unary(Op op, TypeId type, ExprId operand, Loc loc);
  ExprId binary(Op op, TypeId type, ExprId left, ExprId right, Loc loc);
  ExprId convert(ExprId operand, TypeId to, Loc loc);
  void assign(ExprId place, ExprId value, Loc loc);
  ExprId addExpr(Expr expr);
  StmtId appendStmt(Stmt stmt);
  TypeId typeOf(ExprId expr) const { return body_.expr(expr).type; }
  TypeId strip(TypeId type) const { return types_.resolve(type); }
  bool isAggregate(TypeId type) const;  // array, record or string: in memory, passed by reference

 private:
  friend struct ModuleLowering;

  // Lowers into a separate block; returns its first statement.
  template <class Fill>
  StmtId block(Fill fill) {
    const Block outer = build_.open();
    fill();
    return build_.close(outer);
  }
  void attach(ExprId& expr);
  std::vector<bool> attached_;

  // places.cpp
  ExprId lowerPlace(rung::ExprId expr);
  ExprId characters(ExprId string, TypeId unit, bool writes);
  ExprId varPlace(sema::VarId var, Loc loc);
  ExprId memberPlace(rung::ExprId expr);
  // The type of a variable's field: a member of type BIT has a byte.
  TypeId fieldType(const sema::Var& var) const;
  ExprId pinPlace(ExprId instance, const sema::Var& pin, Loc loc);
  // The same place without operands that a later statement could change: indices and pointers go to temporaries.
  ExprId stable(ExprId place);
  ExprId stableElement(const Expr& expr);
  bool mayFault(ExprId expr) const { return ir::mayFault(body_, expr); }
  bool isStable(ExprId expr) const;  // a constant or a temporary: reading it later gives the same

  // open_arrays.cpp
  ExprId openArrayPointer(rung::ExprId array, Loc loc);
  ExprId openArrayBound(rung::ExprId array, uint32_t index, Loc loc);
  ExprId openArrayElement(const rung::IndexExpr& node);
  ExprId openArrayPart(rung::ExprId array, sema::VarId part, Loc loc);
  // The parts of an ARRAY[*] argument: the address of the first element, and the bounds.
  struct OpenArray {
    ExprId pointer;
    std::vector<ExprId> bounds;
  };
  // `copies`: the callee must not see changes of the variable during the call.
  OpenArray passOpenArray(rung::ExprId argument, TypeId pin_type, bool copies);
  OpenArray noOpenArray(TypeId pin_type, Loc loc);  // of an output that is left open: without elements

  // aliases.cpp
  // Whether an lvalue has no indices and pointers, so that it is the same whenever it is evaluated.
  bool isPlainPlace(rung::ExprId expr) const;
  sema::VarId rootVar(rung::ExprId plain_place) const;
  // Whether evaluating `value` has no effect, cannot fault and does not read `variable`. False where that is not sure.
  bool isApart(rung::ExprId value, sema::VarId variable) const;
  bool areApart(sema::VarId a, sema::VarId b) const;

  // values.cpp
  ExprId lowerValue(rung::ExprId expr);
  ExprId lowerLiteral(rung::ExprId expr);
  ExprId lowerUnary(rung::ExprId expr);
  ExprId lowerBinary(rung::ExprId expr);
  ExprId lowerLogical(rung::ExprId expr, bool is_and, bool short_circuit);
  bool callsFunction(rung::ExprId expr) const;
  ExprId lowerConvert(rung::ExprId expr);
  ExprId lowerAddressOf(rung::ExprId expr);
  ExprId lowerAnyValue(rung::ExprId expr);

  // dynamic_memory.cpp
  ExprId lowerNew(rung::ExprId expr);
  void lowerDelete(const sema::Call& call, Loc loc);
  ExprId callPool(sema::PouId function, std::initializer_list<ExprId> arguments, Loc loc);
  ExprId convertValue(ExprId value, TypeId to, Loc loc);
  // A position in the open block. `effects` shows whether statements since then could change a variable.
  struct InsertionPoint {
    StmtId last;
    uint32_t effects;
  };
  InsertionPoint here() { return {build_.block().last, effects()}; }
  uint32_t effects();  // statements so far that change more than temporaries
  // Lowers `next`. When the statements that it emitted could change what `before` reads, or must not run when `before`
  // faults, `before` moves to a temporary in front of them.
  template <class Lower>
  ExprId lowerAfter(std::initializer_list<ExprId*> before, Lower next) {
    InsertionPoint point = here();
    ExprId value = next();
    spill(point, before);
    return value;
  }
  void spill(InsertionPoint point, std::initializer_list<ExprId*> values);
  void spillPlace(InsertionPoint point, ExprId& place);  // stays a place: its indices and pointers move
  bool mustSpill(InsertionPoint point, ExprId value);
  bool hasEffect(const Stmt& stmt) const;  // of its own, without its blocks
  bool isTemp(ExprId place) const;         // a compiler temporary or a part of one
  // Emits at `point` instead of at the end of the block.
  template <class Fill>
  void insertAt(InsertionPoint point, Fill fill) {
    Block& open = build_.block();
    const Block rest = point.last ? Block{body_.stmt(point.last).next, open.last} : open;
    open = {point.last ? open.first : StmtId{}, point.last};
    if (point.last) body_.stmt(point.last).next = {};
    fill();
    if (open.last)
      body_.stmt(open.last).next = rest.first;
    else
      open.first = rest.first;
    if (rest.first) open.last = rest.last;
  }
  ExprId toTemp(ExprId value, Loc loc);

  // calls.cpp
  // The left side of an assignment whose value is a call: the call may write its result directly there. The place is
  // lowered after the arguments, like that of any assignment; `early`: lowering it before makes no difference.
  struct Target {
    rung::ExprId expr = {};
    ExprId place = {};
    bool early = false;
    bool stored = false;
  };
  ExprId placeOf(Target& target);
  // Lowers a call; the result as a value (none: the callee has no result, or target->stored was set).
  ExprId lowerCall(rung::ExprId expr, Target* target = nullptr);
  ExprId lowerOperator(const sema::Call& call, const rung::CallExpr& node);
  ExprId lowerArithmeticOperator(const sema::Call& call, const rung::CallExpr& node);
  ExprId lowerSelect(const sema::Call& call, const rung::CallExpr& node);
  ExprId lowerMux(const sema::Call& call, const rung::CallExpr& node);
  // `object`: the object of a method; none for a function.
  ExprId lowerFunctionCall(const sema::Call& call, const rung::CallExpr& node, Target* target, ExprId object = {});
  ExprId lowerMethodCall(const sema::Call& call, const rung::CallExpr& node, Target* target);
  ExprId lowerObjectConversion(const rung::ConvertExpr& node);
  // objects.cpp
  ExprId lowerAttempt(const sema::Call& call, Loc loc);
  ExprId checkedDowncast(ExprId pointer, sema::PouId given, sema::PouId wanted, Loc loc);
  ExprId isKindOf(ExprId pointer, sema::PouId given, sema::PouId wanted, Loc loc);
  void lowerBlockCall(const sema::Call& call, const rung::CallExpr& node, ExprId instance);
  void lowerAssertion(const sema::Call& call, const rung::CallExpr& node);
  NameId comparedOperands(const rung::CallExpr& node, const rung::BinaryExpr& condition);
  ExprId argumentPlace(ExprId value, TypeId pin_type, bool may_alias, Loc loc);
  ExprId inOutPlace(rung::ExprId argument, TypeId pin_type);
  bool isPlainCall(rung::ExprId expr) const;
  bool mayChain(const sema::Call& call, const Target& target) const;
  ExprId defaultArgument(sema::VarId pin, Loc loc);
  void storeOutput(rung::ExprId target, ExprId value, bool negated, Loc loc);
  ExprId operandOr0(const sema::Binding& binding, TypeId type, Loc loc);

  // statements.cpp
  void detectEdges();
  void lowerStatements(Slice<rung::StmtId> statements);
  void lowerStatement(rung::StmtId stmt);
  void lowerAssign(const rung::AssignStmt& stmt);
  void lowerIf(const rung::IfStmt& stmt);
  void lowerIfFrom(std::span<const IfBranch> branches, Slice<rung::StmtId> otherwise, Loc loc);
  void lowerCase(const CaseStmt& stmt);
  void lowerFor(const rung::ForStmt& stmt);
  void lowerForOfSubrange(const rung::ForStmt& stmt, ExprId control, ExprId from, ExprId to,
                          const std::optional<Value>& step);
  void lowerForWithVariableStep(const rung::ForStmt& stmt, ExprId control, ExprId from, ExprId to,
                                FunctionRef<void()> iteration);
  void lowerWhile(const WhileStmt& stmt);
  void lowerRepeat(const RepeatStmt& stmt);
  void lowerTry(const rung::TryStmt& stmt);
  uint32_t labelNumber(NameId label);
  std::unordered_map<uint32_t, uint32_t> label_numbers_;  // by the key of the name

  // activation.cpp
  ExprId programPlace(uint32_t program, Loc loc);
  ExprId instancePlace(uint32_t program, const sema::InstancePath& place);
  ExprId imagePlace(const sema::ImageView& view, TypeId type, Loc loc);

  // exits.cpp
  // Ends the object at a place and what it holds: FB_Exit. `exact`: its type is that of the place (__DELETE).
  void callExit(ExprId place, bool exact, Loc loc);
  void lowerExit(ExprId place, TypeId record);
  void exitParts(ExprId place, TypeId record);
  void exitElement(ExprId place, TypeId type);

  // initial_values.cpp
  void storeInitialArray(ExprId place, TypeId type, rung::ExprId init, bool place_is_zero);
  void storeInitialRecord(ExprId place, TypeId type, rung::ExprId init);
  void storeMembers(ExprId place, rung::ExprId init);
  void construct(ExprId place, TypeId type);
  const sema::Var* constructedVar(ExprId place) const;
  ExprId elementAt(ExprId array, uint64_t number, Loc loc);
  void forEachElement(ExprId array, TypeId type, Loc loc, uint32_t dimension, std::vector<ExprId>& indices,
                      FunctionRef<void(ExprId)> store, bool backwards = false);
  bool writeBytes(TypeId type, rung::ExprId init, uint8_t* to);
  bool writeDefault(TypeId type, uint8_t* to);
  bool writeArray(TypeId type, rung::ExprId init, uint8_t* to);

  ModuleLowering& in_;
  const sema::Project& project_;
  const Tree& tree_;
  TypeTable& types_;
  Body& body_;
  sema::PouId pou_;
  Builder build_;
  std::vector<uint32_t> local_of_;                          // by Var::field of a local: local index + 1
  std::vector<std::pair<uint32_t, uint32_t>> edge_locals_;  // R_EDGE, F_EDGE pins: VarId and the local with the edge
  uint32_t result_local_ = kNoBit;
  // Inside the right operand of a codesys AND or OR that calls functions: a temporary that is TRUE when the operand's
  // value matters. Its checks count only then.
  ExprId guard_;
  uint32_t element_ = 0;  // the current element of an array whose elements have arguments of their own for FB_Init
  CallId given_;          // the arguments of FB_Init for an object that __NEW creates
  ExprId logical_;        // the temporary of the last AND or OR that needed one
  uint32_t effects_ = 0, effects_counted_ = 1;  // of the statements up to that one
};

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// The parts of lowering. Internal to ir/lower/. ModuleLowering (module.cpp) declares the bodies of a project, and has
// its records, instances and tasks as parts (records.h, instances.h, tasks.h); BodyLowering walks one checked body and
// appends IR to it, a class for each subject: places, values, calls, objects, statements. What the classes share is in
// body_part.h.
#pragma once

#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "frontend/source/function_ref.h"
#include "ir/lower.h"
#include "ir/lower/body_part.h"
#include "ir/lower/instances.h"
#include "ir/lower/records.h"
#include "ir/lower/tasks.h"

namespace rung::ir {

// A FOR loop whose end value is evaluated before every turn, by an IF at the start of its block: see loop_limits.cpp.
struct VariableLimit {
  BodyId body;
  StmtId loop;
};

// A place that names a global variable of which each resource has its own.
struct ResourcePlace {
  const Body* body;
  ExprId place;
  uint32_t globals;  // index into Project::resource_globals
};

// What an online change does with the parts of a record.
enum class Life : uint8_t { Refresh, Reinit };

struct ModuleLowering {
  ModuleLowering(const sema::Project& from, const LowerOptions& with, Module& to);

  void run();
  // Lowers the requested bodies and those that they request. Stops at one whose POU is not checked, and returns that.
  sema::PouId lowerBodies();
  void lowerCpp(sema::PouId id);
  void addCppVariable(CppBody& cpp, sema::VarId id, NameId list, bool of_object);
  // The body of a POU's code; declares its parameters when first asked for.
  BodyId bodyOf(sema::PouId pou);
  BodyId knownBodyOf(sema::PouId pou) const { return body_of_[pou.index]; }  // none: not asked for
  BodyId addHelper(NameId name, sema::PouId object, const char* suffix);
  // The initialiser of a record, or none when its initial value is all zeros.
  BodyId initOf(TypeId record);
  // The function that tests whether a type id is that of an object of this kind.
  BodyId kindTestOf(sema::PouId wanted);
  bool isKindOf(sema::PouId object, sema::PouId base) const;
  BodyId blockCallOf(sema::PouId block);
  // FB_Init or FB_Exit of an object and of the objects that it extends, the outermost base first.
  std::vector<sema::PouId> lifeMethodsOf(sema::PouId object, std::string_view name) const;
  std::vector<sema::PouId> calledAfterInit(sema::PouId object) const;
  bool isMadeWithoutArguments(sema::PouId block) const;
  // exits.cpp: whether a type holds an object with FB_Exit; the function that ends those of a record, or none; the
  // same in the form of a function that a dispatch table can hold.
  bool hasExit(TypeId type);
  BodyId exitOf(TypeId record);
  BodyId exitCallOf(sema::PouId object);
  // online_change.cpp: whether a type holds an object with FB_Reinit, or a variable that every change sets; the
  // function on a record that calls or sets them, or none; the function that tells whether a change copies an instance.
  bool hasPart(Life life, TypeId type);
  BodyId lifeOf(Life life, TypeId record);
  BodyId copiesTest();
  std::vector<sema::VarId> locatedWithValue(TypeId record) const;
  // after_init.cpp: whether a variable of the type is, or holds, an instance of the block.
  bool holds(TypeId type, sema::PouId block);
  // An object's implementation of a method; none when it has none, or an abstract one.
  sema::PouId implementation(sema::PouId object, sema::PouId method) const;
  bool checksCasts() const { return (options.checks & kCheckCast) != 0; }
  // The record of the object that a POU's code runs on; none in functions.
  sema::PouId objectOf(sema::PouId pou) const;
  void noteGlobal(const Body& body, ExprId place, sema::VarId var);

  const sema::Project& project;
  const LowerOptions& options;
  Module& module;
  const Tree& tree;
  TypeTable& types;
  RecordLowering records;
  InstanceLowering instances;
  TaskLowering tasks;
  bool partial = false;  // only one function: see lowerFunction
  std::vector<VariableLimit> variable_limits;

 private:
  void initVar(BodyLowering& lowering, sema::VarId id, sema::Storage storage);
  void initObject(BodyLowering& lowering, TypeId type, sema::PouId pou, Loc loc);
  void initList(BodyLowering& lowering, sema::ListId list, bool sets_late);
  void initFields(BodyLowering& lowering, TypeId type, Loc loc);
  void addTests();
  BodyId addTestCall(sema::PouId test, std::span<const sema::TestCase::Input> inputs, const std::string& suffix);
  BodyId addTestSetup(sema::PouId test, std::span<const sema::TestCase::Input> inputs, const std::string& suffix);
  void simplifyLimits();
  void markFaulting();
  void addClasses();
  void fillKindTests();
  // The function that f(NameId, const Root&) makes for each test.
  template <class F>
  void addToTests(BodyId ProgramInstance::*function, F&& f) {
    for (uint32_t i = 0; i < module.programs.size(); ++i) {
      if (!module.programs[i].is_test) continue;
      const BodyId made = f(module.programs[i].name, Root{false, i, module.programs[i].record});
      module.programs[i].*function = made;
    }
  }
  BodyId endsOf(NameId name, const char* suffix, std::span<const Root> roots);
  void addExit();
  void addLives();
  void addMakers();
  void addDispatches();
  std::vector<sema::PouId> calledAfterGlobals() const;
  BodyId afterInitOf(NameId name, const char* suffix, std::span<const sema::PouId> called, std::span<const Root> roots,
                     bool is_test);
  void addAfterInit();
  void copyForResources();

  std::vector<ResourcePlace> resource_places_;
  std::vector<BodyId> body_of_;                   // by PouId
  std::unordered_map<uint32_t, BodyId> init_of_;  // by record TypeId
  std::unordered_map<uint32_t, BodyId> exit_of_;  // by record TypeId
  std::unordered_map<uint32_t, bool> has_exit_;   // by record TypeId
  std::unordered_map<uint64_t, bool> holds_;      // by record TypeId and PouId
  std::unordered_map<uint64_t, bool> has_part_;   // by Life and record TypeId
  std::unordered_map<uint64_t, BodyId> life_of_;  // by Life and record TypeId
  BodyId copies_test_;
  std::vector<sema::PouId> to_lower_;
  std::vector<std::pair<sema::PouId, BodyId>> kind_tests_, block_calls_;
  size_t next_to_lower_ = 0;
};

inline bool isOpenArray(const TypeTable& types, TypeId type) { return type && types.isOpenArray(type); }

// The parts of an ARRAY[*] argument: the address of the first element, and the bounds.
struct OpenArray {
  ExprId pointer;
  std::vector<ExprId> bounds;
};

// The left side of an assignment whose value is a call: the call may write its result directly there. The place is
// lowered after the arguments, like that of any assignment; `early`: lowering it before makes no difference.
struct Target {
  rung::ExprId expr = {};
  ExprId place = {};
  bool early = false;
  bool stored = false;
};

// Lvalues: places.cpp, open_arrays.cpp (ARRAY[*]), aliases.cpp, instance paths in activation.cpp.
class PlaceLowering : public BodyPart {
 public:
  using BodyPart::BodyPart;

  ExprId lowerPlace(rung::ExprId expr);
  ExprId varPlace(sema::VarId var, Loc loc);
  ExprId pinPlace(ExprId instance, const sema::Var& pin, Loc loc);
  // An instance that is called, and the variable beside it that keeps its ENO; what owns both is evaluated once.
  struct Instance {
    ExprId place, eno;
  };
  Instance lowerInstance(rung::ExprId instance, sema::VarId eno);
  ExprId seenAs(ExprId place, TypeId type, Loc loc);
  ExprId programPlace(uint32_t program, Loc loc);
  ExprId instancePlace(uint32_t program, const sema::InstancePath& place);
  ExprId imagePlace(const sema::ImageView& view, TypeId type, Loc loc);

  ExprId openArrayPointer(rung::ExprId array, Loc loc);
  ExprId openArrayBound(rung::ExprId array, uint32_t index, Loc loc);
  // `copies`: the callee must not see changes of the variable during the call.
  OpenArray passOpenArray(rung::ExprId argument, TypeId pin_type, bool copies);
  OpenArray noOpenArray(TypeId pin_type, Loc loc);  // of an output that is left open: without elements

  // Tells whether an lvalue has no indices and pointers, so that it is the same whenever it is evaluated.
  bool isPlainPlace(rung::ExprId expr) const;
  sema::VarId rootVar(rung::ExprId plain_place) const;
  // Tells whether evaluating `value` has no effect, cannot fault and does not read `variable`. False where that is not
  // sure.
  bool isApart(rung::ExprId value, sema::VarId variable) const;

 private:
  bool isApartFrom(rung::ExprId place, sema::VarId variable) const;
  bool operandsAreApart(const rung::BinaryExpr& node, sema::VarId variable) const;
  bool argumentsAreApart(rung::ExprId call, sema::VarId variable) const;
  ExprId named(rung::ExprId expr);
  sema::VarId ownTemporary(sema::VarId id) const;
  ExprId indexed(const rung::IndexExpr& node);
  ExprId lowerStep(rung::ExprId expr);
  ExprId dereferenced(rung::ExprId expr);
  ExprId directAddress(rung::ExprId expr);
  ExprId memberPlace(rung::ExprId expr);
  bool isField(const rung::MemberExpr& node, const sema::Var& var) const;
  ExprId fieldOf(ExprId record, const sema::Var& var, Loc loc);
  ExprId characters(ExprId string, TypeId unit, bool writes);
  // The type of a variable's field: a member of type BIT has a byte.
  TypeId fieldType(const sema::Var& var) const;
  ExprId openArrayElement(const rung::IndexExpr& node);
  ExprId openArrayPart(rung::ExprId array, sema::VarId part, Loc loc);
  bool areApart(sema::VarId a, sema::VarId b) const;
};

// Values: values.cpp, __NEW and __DELETE in dynamic_memory.cpp, the kinds of objects in objects.cpp.
class ValueLowering : public BodyPart {
 public:
  using BodyPart::BodyPart;

  ExprId lowerValue(rung::ExprId expr);
  // An operand of an operation in the type `native`, where the value may be wider than its type; none: in its own type.
  ExprId lowerOperand(rung::ExprId expr, TypeId native) { return native ? lowerIn(expr, native) : lowerValue(expr); }
  // The last bits of an intermediate result that fit an integer type; intermediate_results.cpp.
  ExprId lowerIn(rung::ExprId expr, TypeId type);
  ExprId lowerUncut(rung::ExprId expr);
  void lowerDelete(const sema::Call& call, Loc loc);
  ExprId lowerAttempt(const sema::Call& call, Loc loc);

 private:
  ExprId closed(ExprId place);
  ExprId lowerLiteral(rung::ExprId expr);
  ExprId lowerUnary(rung::ExprId expr);
  ExprId lowerBinary(rung::ExprId expr);
  ExprId lowerLogical(rung::ExprId expr, bool is_and, bool short_circuit);
  bool callsFunction(rung::ExprId expr) const;
  ExprId lowerConvert(rung::ExprId expr);
  ExprId convertUncut(const rung::ConvertExpr& node);
  ExprId operate(rung::ExprId expr, TypeId type);
  bool hasUncut(rung::ExprId expr) const;
  ExprId lowerAddressOf(rung::ExprId expr);
  ExprId lowerAnyValue(rung::ExprId expr);
  ExprId lowerNew(rung::ExprId expr);
  ExprId lowerAssignment(const AssignExpr& node);
  ExprId callPool(sema::PouId function, std::initializer_list<ExprId> arguments, Loc loc);
  ExprId lowerObjectConversion(const rung::ConvertExpr& node);
  ExprId lowerPart(const rung::ConvertExpr& node);
  ExprId checkedDowncast(ExprId pointer, sema::PouId given, sema::PouId wanted, Loc loc);
  ExprId isKindOf(ExprId pointer, sema::PouId given, sema::PouId wanted, Loc loc);
};

// Calls: calls.cpp, function_calls.cpp, operators in call form in operator_calls.cpp, assertions.cpp.
class CallLowering : public BodyPart {
 public:
  using BodyPart::BodyPart;

  // Lowers a call; the result as a value (none: the callee has no result, or target->stored was set).
  ExprId lowerCall(rung::ExprId expr, Target* target = nullptr);
  // `object`: the object of a method; none for a function. `copies`: the value of bInCopyCode, an input of methods that
  // the system calls.
  ExprId lowerFunctionCall(const sema::Call& call, const rung::CallExpr& node, Target* target, ExprId object = {},
                           ExprId copies = {});
  // A test that is a function, with these inputs.
  void lowerTestCall(sema::PouId test, std::span<const sema::TestCase::Input> inputs, Loc loc);
  ExprId lowerArithmeticOperator(const sema::Call& call, const rung::CallExpr& node, TypeId native);
  void setMarkedVariables(const sema::Call& call, const rung::CallExpr& node, ExprId instance);
  struct CopyBack {
    rung::ExprId target;
    ExprId value;
  };
  struct InOuts {
    std::vector<CopyBack> copies;     // of variables that cannot be referred to
    std::vector<ExprId> short_lived;  // in-outs of an instance that outlives their variable
  };
  void storeOpenArray(const sema::Var& pin, rung::ExprId value, ExprId instance);
  void bindInOut(const sema::Var& pin, rung::ExprId value, ExprId instance, InOuts& in_outs);
  void callBody(const sema::Call& call, const rung::CallExpr& node, ExprId instance);
  void lowerBlockCall(const sema::Call& call, const rung::CallExpr& node, ExprId instance);
  // The place of a by-reference input: the variable itself when nothing can change it during the call, else a copy.
  ExprId argumentPlace(ExprId value, TypeId pin_type, bool may_alias, Loc loc);
  ExprId placeOf(Target& target);
  bool isPlainCall(rung::ExprId expr) const;  // unconditional: without EN and ENO

 private:
  ExprId lowerPlainCall(const sema::Call& call, const rung::CallExpr& node, Target* target, ExprId instance);
  ExprId lowerConditionalCall(const sema::Call& call, const rung::CallExpr& node, Target* target);
  StmtId clearingOnFault(ExprId eno, StmtId statements, Loc loc);
  void storeEno(const sema::Call& call, ExprId eno, Loc loc);
  void lowerTarget(Target& target);
  ExprId lowerMethodCall(const sema::Call& call, const rung::CallExpr& node, Target* target);
  void storeOutput(rung::ExprId target, ExprId value, bool negated, Loc loc);

  struct FunctionCall;
  FunctionCall planFunctionCall(const sema::Call& call, const rung::CallExpr& node, Target* target);
  void planPins(FunctionCall& plan);
  bool mayChain(const sema::Call& call, const Target& target) const;
  ExprId passArgument(FunctionCall& plan, uint32_t pin);
  ExprId passAggregate(FunctionCall& plan, TypeId type, rung::ExprId given);
  ExprId passVariable(FunctionCall& plan, TypeId type, rung::ExprId given);
  ExprId inOutPlace(rung::ExprId argument, TypeId pin_type);
  ExprId defaultArgument(sema::VarId pin, rung::ExprId init, Loc loc);
  void spillArguments(FunctionCall& plan, InsertionPoint point);
  ExprId emitFunctionCall(FunctionCall& plan, ExprId object, ExprId result);
  void faultUnlessZero(ExprId result, Loc loc);
  // Sorts numbers of pins so that those with a value come in the order in which the values were written.
  void writtenOrder(std::vector<uint32_t>& pins, FunctionRef<rung::ExprId(uint32_t)> value) const;

  ExprId lowerOperator(const sema::Call& call, const rung::CallExpr& node);
  ExprId lowerSelect(const sema::Call& call, const rung::CallExpr& node);
  ExprId lowerMux(const sema::Call& call, const rung::CallExpr& node);
  ExprId operandOr0(const sema::Binding& binding, TypeId type, Loc loc);

  void lowerAssertion(const sema::Call& call, const rung::CallExpr& node);
  NameId comparedOperands(const rung::CallExpr& node, const rung::BinaryExpr& condition);
};

// The life of objects: initial_values.cpp, repeated_values.cpp, after_init.cpp, FB_Exit in exits.cpp, online
// changes in online_change.cpp.
class ObjectLowering : public BodyPart {
 public:
  using BodyPart::BodyPart;

  // Code that gives `place` the initial value of a variable of `type` declared with `init` (or none).
  void storeInitial(ExprId place, TypeId type, rung::ExprId init, bool place_is_zero);
  // Ends the object at a place and what it holds: FB_Exit. `exact`: its type is that of the place (__DELETE).
  void callExit(ExprId place, bool exact, Loc loc);
  void lowerExit(ExprId place, TypeId record);
  void exitElement(ExprId place, TypeId type);
  void lowerLife(Life life, ExprId place, TypeId record);
  void callInstances(ExprId place, sema::PouId method);

 private:
  void callParts(ExprId base, sema::PouId method);
  void exitParts(ExprId place, TypeId record);
  ExprId isCopied(ExprId instance);
  void lifeOfParts(Life life, ExprId place, TypeId record);
  void lifeOfPart(Life life, ExprId place, TypeId type);
  void reinit(ExprId place, TypeId record);
  void storeInitialArray(ExprId place, TypeId type, rung::ExprId init, bool place_is_zero);
  bool storeRepeated(ExprId place, TypeId type, std::span<const uint8_t> bytes, bool place_is_zero);
  void storeRows(ExprId array, TypeId type, std::span<const uint8_t> bytes, std::vector<ExprId>& indices,
                 bool place_is_zero);
  void storeBytes(ExprId place, TypeId declared, std::span<const uint8_t> bytes);
  void storeInitialRecord(ExprId place, TypeId type, rung::ExprId init);
  void storeMembers(ExprId place, rung::ExprId init);
  bool setProperty(ExprId place, const FieldInit& given);
  void construct(ExprId place, TypeId type);
  bool isBasePart(ExprId place) const;
  void callAfterInit(ExprId place, TypeId type);
  const sema::Var* constructedVar(ExprId place) const;
  ExprId elementAt(ExprId array, uint64_t number, Loc loc);
  void forEachElement(ExprId array, TypeId type, Loc loc, uint32_t dimension, std::vector<ExprId>& indices,
                      FunctionRef<void(ExprId)> store, bool backwards = false);
  bool writeBytes(TypeId type, rung::ExprId init, uint8_t* to);
  bool writeDefault(TypeId type, uint8_t* to);
  bool writeArray(TypeId type, rung::ExprId init, uint8_t* to);
};

// Statements and whole bodies: statements.cpp, activation.cpp, temporaries.cpp.
class StatementLowering : public BodyPart {
 public:
  using BodyPart::BodyPart;

  void lowerPou();
  // The code of ProgramInstance::run and setup. Without connections there is no `call`.
  void lowerActivation(uint32_t program, BodyId code, rung::ExprId call, std::span<const sema::InstancePath> places);
  void lowerSetup(uint32_t program, std::span<const sema::InstancePath> places);
  // A call of the block in a field of a program instance.
  void lowerBlockTask(uint32_t program, sema::VarId block);

 private:
  void enterBody();
  void leaveBody(Loc loc);
  void saveField(sema::VarId field, Loc loc);
  bool holdsInstance(TypeId type) const;
  void detectEdges();
  void lowerStatements(Slice<rung::StmtId> statements);
  void lowerStatement(rung::StmtId stmt);
  void lowerAssign(const rung::AssignStmt& stmt);
  void lowerStore(const rung::AssignStmt& stmt);
  void lowerUpdate(const rung::AssignStmt& stmt, Op op);
  rung::ExprId assignedCall(const rung::AssignStmt& stmt) const;
  void lowerIf(const rung::IfStmt& stmt);
  void lowerIfFrom(std::span<const IfBranch> branches, Slice<rung::StmtId> otherwise, Loc loc);
  void lowerCase(const CaseStmt& stmt);
  void lowerFor(const rung::ForStmt& stmt);
  // The end value of a FOR loop, with the statements that calculate it, if they are to run before every turn.
  struct Limit {
    Block statements;
    ExprId value;
    bool is_variable = false;
  };
  void link(Block statements);
  Block lowerBlock(Slice<rung::StmtId> statements);
  void lowerForWithVariableLimit(ExprId control, ExprId from, const Limit& limit, const Value& step, Block body,
                                 Loc loc);
  void lowerForOfSubrange(const rung::ForStmt& stmt, ExprId control, ExprId from, ExprId to,
                          const std::optional<Value>& step, Block statements);
  void lowerForWithVariableStep(const rung::ForStmt& stmt, ExprId control, ExprId from, const Limit& limit,
                                FunctionRef<void()> iteration);
  void lowerWhile(const WhileStmt& stmt);
  void lowerRepeat(const RepeatStmt& stmt);
  void lowerTry(const rung::TryStmt& stmt);
  uint32_t labelNumber(NameId label);
};

// Lowers one body: its parts, by subject, and what they share. `code` makes nodes for those who need no part.
struct BodyLowering {
  BodyLowering(ModuleLowering& in, Body& of, sema::PouId pou) : state(in, of, pou, *this) {}
  void finish() { state.body.first = state.build.block().first; }

  BodyState state;
  BodyPart code{state};
  PlaceLowering places{state};
  ValueLowering values{state};
  CallLowering calls{state};
  ObjectLowering objects{state};
  StatementLowering statements{state};
};

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// Lowering of objects: class numbers, dispatch tables, tests of an object's kind, constructors. In: the objects of a
// checked project. Out: Module::classes and dispatches. The body of a block, its end and the test of its kind are small
// functions (`Pump()`, `Pump~`, `Pump?`; see also exits.cpp), so that tables, `?=` and FB_Exit need nothing new in the
// IR. Numbers follow the lines of descent, so a kind is one run of class numbers or a few.
#include <algorithm>

#include "ir/lower/lowering.h"

namespace rung::ir {

sema::PouId ModuleLowering::objectOf(sema::PouId pou) const {
  const sema::Pou& of = project.pou(pou);
  return of.owner ? of.owner : of.kind == PouKind::Function ? sema::PouId{} : pou;
}

std::vector<sema::PouId> ModuleLowering::lifeMethodsOf(sema::PouId object, std::string_view name) const {
  std::vector<sema::PouId> out;
  for (sema::PouId at = object; at; at = project.pou(at).base)
    for (sema::PouId member : project.pou(at).members)
      if (sameIdentifier(project.names.string(project.pou(member).name), name) &&
          (project.pou(member).object.modifiers & kAbstract) == 0)
        out.insert(out.begin(), member);
  return out;
}

// The methods with {attribute 'call_after_init'}, those of bases first, if the object has it too.
std::vector<sema::PouId> ModuleLowering::calledAfterInit(sema::PouId object) const {
  std::vector<sema::PouId> out;
  if (!project.pou(object).pragmas.call_after_init) return out;
  for (sema::PouId at = object; at; at = project.pou(at).base) {
    size_t first = 0;
    for (const sema::PouId member : project.pou(at).members) {
      if (project.pou(member).kind != PouKind::Method || !project.pou(member).pragmas.call_after_init) continue;
      const sema::PouId found = implementation(object, member);
      if (found && std::find(out.begin(), out.end(), found) == out.end())
        out.insert(out.begin() + static_cast<ptrdiff_t>(first++), found);
    }
  }
  return out;
}

// Numbers the objects that have a type id: each line of descent in one run, in the order of their names.
void ModuleLowering::addClasses() {
  std::vector<std::pair<std::string, sema::PouId>> order;
  for (const Record& record : module.records)
    if (sema::PouId pou = records.pouOf(record.type))
      if (project.pou(pou).object.dispatched && project.pou(pou).kind != PouKind::Interface)
        order.push_back({foldedIdentifier(project.names.string(project.pou(pou).unique_name)), pou});
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<uint32_t> number_of(types.count());
  auto baseOf = [&](sema::PouId pou) {
    sema::PouId base = project.pou(pou).base;
    return base && project.pou(base).object.dispatched ? base : sema::PouId{};
  };
  std::vector<sema::PouId> open;
  auto visit = [&](sema::PouId pou, TypeId base) {
    module.classes.push_back({project.pou(pou).record, base});
    number_of[project.pou(pou).record.index] = static_cast<uint32_t>(module.classes.size());
  };
  auto children = [&](sema::PouId of) {
    for (size_t i = order.size(); i-- > 0;)
      if (baseOf(order[i].second) == of) open.push_back(order[i].second);
  };
  children({});
  while (!open.empty()) {
    const sema::PouId next = open.back();
    open.pop_back();
    const sema::PouId base = baseOf(next);
    visit(next, base ? project.pou(base).record : TypeId{});
    children(next);
  }
  fillKindTests();
  for (uint32_t i = 1; i < module.bodies.size(); ++i)
    for (Expr& expr : module.bodies[i].exprs)
      if (expr.kind == ExprKind::Const && expr.as<ConstExpr>().number_of)
        expr.as<ConstExpr>().bits = number_of[expr.as<ConstExpr>().number_of.index];
}

sema::PouId ModuleLowering::implementation(sema::PouId object, sema::PouId method) const {
  for (sema::PouId at = object; at; at = project.pou(at).base)
    if (const sema::PouId found = methodLike(project, at, method))
      return (project.pou(found).object.modifiers & kAbstract) != 0 ? sema::PouId{} : found;
  return {};
}

void ModuleLowering::addDispatches() {
  std::vector<sema::PouId> method_of(module.bodies.size());
  for (uint32_t i = 1; i < project.pous.size(); ++i)
    if (body_of_[i] && project.pous[i].owner) method_of[body_of_[i].index] = {i};
  std::vector<bool> called(module.bodies.size());
  for (uint32_t i = 1; i < module.bodies.size(); ++i)
    for (const Stmt& stmt : module.bodies[i].stmts)
      if (const auto* call = stmt.tryAs<CallStmt>(); call != nullptr && call->is_virtual)
        called[call->callee.index] = true;
  const std::vector<std::pair<sema::PouId, BodyId>> block_calls = block_calls_;  // more are added below
  for (uint32_t i = 1; i < called.size(); ++i) {
    if (!called[i]) continue;
    Dispatch created;
    created.method = {i};
    sema::PouId block;  // whose body or end is called; else it is a method
    for (const auto& [pou, body] : block_calls)
      if (body.index == i) block = pou;
    sema::PouId ended;
    if (!block && !method_of[i]) ended = records.pouOf(module.bodies[i].self);
    const sema::PouId owner = block ? block : ended ? ended : project.pou(method_of[i]).owner;
    for (uint32_t c = 0; c < module.classes.size(); ++c) {
      const sema::PouId object = records.pouOf(module.classes[c].record);
      if (!isKindOf(object, owner)) continue;
      if (created.bodies.empty()) created.first = c + 1;
      created.bodies.resize(c + 1 - created.first);
      if (block) {
        created.bodies.push_back(blockCallOf(object));
      } else if (ended) {
        created.bodies.push_back(exitCallOf(object));
      } else {
        const sema::PouId found = implementation(object, method_of[i]);
        created.bodies.push_back(found ? bodyOf(found) : BodyId{});
      }
    }
    module.dispatches.push_back(std::move(created));
  }
}

bool ModuleLowering::isKindOf(sema::PouId object, sema::PouId base) const {
  for (; object; object = project.pou(object).base) {
    if (object == base) return true;
    for (sema::PouId interface : project.pou(object).object.interfaces)
      if (isKindOf(interface, base)) return true;
  }
  return false;
}

BodyId ModuleLowering::addHelper(NameId name, sema::PouId object, const char* suffix) {
  const sema::Pou& pou = project.pou(object);
  module.bodies.emplace_back();
  Body& body = module.bodies.back();
  body.name = body.spelling = module.names.intern(std::string(project.names.string(name)) + suffix);
  body.kind = BodyKind::Function;
  body.library = pou.library;
  body.library_name = pou.library_name;
  body.loc = pou.loc;
  body.file = pou.file;
  return BodyId{static_cast<uint32_t>(module.bodies.size() - 1)};
}

// The body of a block as a method, so that tables can hold it.
BodyId ModuleLowering::blockCallOf(sema::PouId block) {
  for (const auto& [pou, body] : block_calls_)
    if (pou == block) return body;
  const BodyId code = bodyOf(block);
  const BodyId created = addHelper(project.pou(block).unique_name, block, "()");
  block_calls_.push_back({block, created});
  Body& body = module.body(created);
  body.self = project.pou(block).record;
  BodyLowering lowering(*this, body, {});
  lowering.code.append(body.loc, CallStmt{.callee = code, .self = lowering.code.self(body.loc)});
  lowering.finish();
  return created;
}

BodyId ModuleLowering::kindTestOf(sema::PouId wanted) {
  for (const auto& [pou, body] : kind_tests_)
    if (pou == wanted) return body;
  const BodyId created = addHelper(project.pou(wanted).unique_name, wanted, "?");
  kind_tests_.push_back({wanted, created});
  Body& body = module.body(created);
  body.pure = true;
  body.result = types::kBool;
  body.locals.push_back({module.names.intern("id"), types::kUDInt, LocalKind::Input, false, body.loc});
  body.locals.push_back({module.names.intern("is"), types::kBool, LocalKind::Result, false, body.loc});
  return created;
}

void ModuleLowering::fillKindTests() {
  for (const auto& test : kind_tests_) {
    const auto wanted = test.first;
    Body& body = module.body(test.second);
    const Loc loc = body.loc;
    BodyLowering lowering(*this, body, {});
    auto holds = [&](size_t c) {
      return c < module.classes.size() && isKindOf(records.pouOf(module.classes[c].record), wanted);
    };
    auto compare = [&](Op op, size_t c) {
      const ExprId number = lowering.code.add(loc, types::kUDInt, ConstExpr{.number_of = module.classes[c].record});
      return lowering.code.binary(op, types::kBool, lowering.code.local(0, loc), number, loc);
    };
    ExprId is;
    for (size_t c = 0; c < module.classes.size(); ++c) {
      if (!holds(c)) continue;
      const size_t first = c;
      while (holds(c + 1)) ++c;
      const ExprId run =
          first == c ? compare(Op::Eq, c)
                     : lowering.code.binary(Op::And, types::kBool, compare(Op::Ge, first), compare(Op::Le, c), loc);
      is = is ? lowering.code.binary(Op::Or, types::kBool, is, run, loc) : run;
    }
    lowering.code.assign(lowering.code.local(1, loc), is ? is : lowering.code.constantBool(false, loc), loc);
    lowering.finish();
  }
}

// ---- in bodies

// Tells whether the object at a pointer that is not null is of a kind.
ExprId ValueLowering::isKindOf(ExprId pointer, sema::PouId given, sema::PouId wanted, Loc loc) {
  if (!project_.pou(given).object.dispatched) return constantBool(in_.isKindOf(given, wanted), loc);
  const TypeId record = strip(types_.info(typeOf(pointer)).base);
  sema::PouId first = given;
  while (!project_.pou(first).object.id_var) first = project_.pou(first).base;
  ExprId object = add(loc, record, DerefExpr{.pointer = pointer});
  object = asBase(object, first, loc);
  const ExprId id = field(object, project_.var(project_.pou(first).object.id_var).field, types::kUDInt, loc);
  return add(loc, types::kBool, CallExpr{.callee = in_.kindTestOf(wanted), .operands = list({&id, 1})});
}

// Converts a pointer to a base to one to an object that extends it; fault[cast] when the object is of another kind.
ExprId ValueLowering::checkedDowncast(ExprId pointer, sema::PouId given, sema::PouId wanted, Loc loc) {
  if ((in_.options.checks & kCheckCast) == 0 || !project_.pou(given).object.dispatched) return pointer;
  pointer = toTemp(pointer, loc);
  const ExprId is_set = binary(Op::Ne, types::kBool, copy(pointer), constant(typeOf(pointer), 0, loc), loc);
  const StmtId test = block([&] {
    const ExprId is_other = unary(Op::Not, types::kBool, isKindOf(copy(pointer), given, wanted, loc), loc);
    const StmtId fault = block([&] { append(loc, FaultStmt{.fault = types::Fault::Cast}); });
    append(loc, IfStmt{.condition = is_other, .then_block = fault});
  });
  append(loc, IfStmt{.condition = is_set, .then_block = test});
  return pointer;
}

ExprId ValueLowering::lowerAttempt(const sema::Call& call, Loc loc) {
  const ExprId source = toTemp(lowerValue(call.bindings[0].value), loc);
  const sema::PouId given = in_.records.pouOf(strip(types_.info(typeOf(source)).base));
  const ExprId is = temp(types::kBool, loc);
  assign(copy(is), binary(Op::Ne, types::kBool, copy(source), constant(typeOf(source), 0, loc), loc), loc);
  if (call.pou) {
    const StmtId test = block([&] { assign(copy(is), isKindOf(copy(source), given, call.pou, loc), loc); });
    append(loc, IfStmt{.condition = copy(is), .then_block = test});
  }
  const ExprId target = stable(places().lowerPlace(call.bindings[1].value));
  const TypeId type = typeOf(target);
  const StmtId taken = block([&] { assign(copy(target), convertValue(source, type, loc), loc); });
  const StmtId refused = block([&] { assign(target, constant(type, 0, loc), loc); });
  append(loc, IfStmt{.condition = copy(is), .then_block = taken, .else_block = refused});
  return is;
}

}  // namespace rung::ir

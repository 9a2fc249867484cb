// SPDX-License-Identifier: Apache-2.0
// See reachable.h.
#include "ir/reachable.h"

#include <algorithm>
#include <unordered_set>

namespace rung::ir {
namespace {

class Walk {
 public:
  explicit Walk(const Module& module) : module_(module), listed_(module.bodies.size()) {}

  std::vector<BodyId> run(const std::vector<BodyId>& roots) {
    for (const BodyId root : roots) note(root);
    for (size_t i = 0; i < bodies_.size(); ++i) scan(module_.body(bodies_[i]));
    return std::move(bodies_);
  }

 private:
  void note(BodyId id) {
    if (!id || listed_[id.index]) return;
    listed_[id.index] = true;
    bodies_.push_back(id);
  }

  void scan(const Body& body) {
    for (size_t e = 1; e < body.exprs.size(); ++e)
      if (const auto* call = body.exprs[e].tryAs<CallExpr>()) note(call->callee);
    for (size_t s = 1; s < body.stmts.size(); ++s)
      if (const auto* call = body.stmts[s].tryAs<CallStmt>()) noteCall(*call);
    if (body.cpp != 0) scanCpp(body);
  }

  // A body in C++ may call the functions that it names, and every object that it reaches.
  void scanCpp(const Body& body) {
    const CppBody& cpp = module_.cpp_bodies[body.cpp - 1];
    for (const BodyId function : cpp.functions) note(function);
    if (body.self)
      for (const types::Field& field : module_.types.info(module_.types.resolve(body.self)).fields)
        noteObjects(field.type);
    for (const Local& local : body.locals) noteObjects(local.type);
    for (const CppBody::Variable& variable : cpp.variables) noteObjects(variable.type);
  }

  void noteObjects(TypeId type) {
    types::TypeTable& types = module_.types;
    type = types.resolve(type);
    while (types.kind(type) == types::TypeKind::Array) type = types.resolve(types.info(type).base);
    if (types.kind(type) != types::TypeKind::Record || !objects_.insert(type.index).second) return;
    for (const Record& record : module_.records)
      if (types.resolve(record.type) == type) note(record.body);
    for (uint32_t i = 1; i < module_.bodies.size(); ++i)
      if (module_.bodies[i].kind == BodyKind::Function && module_.bodies[i].self &&
          types.resolve(module_.bodies[i].self) == type)
        note({i});
    for (const types::Field& field : types.info(type).fields) noteObjects(field.type);
  }

  void noteCall(const CallStmt& call) {
    note(call.callee);
    if (!call.is_virtual) return;
    const auto row =
        std::lower_bound(module_.dispatches.begin(), module_.dispatches.end(), call.callee,
                         [](const Dispatch& dispatch, BodyId method) { return dispatch.method.index < method.index; });
    if (row == module_.dispatches.end() || !(row->method == call.callee)) return;
    for (const BodyId body : row->bodies) note(body);
  }

  const Module& module_;
  std::vector<bool> listed_;
  std::unordered_set<uint32_t> objects_;
  std::vector<BodyId> bodies_;
};

}  // namespace

std::vector<BodyId> rootsOfTask(const Module& module, uint32_t task) {
  std::vector<BodyId> roots = {module.tasks[task].before, module.tasks[task].after};
  for (const ProgramInstance& program : module.programs) {
    if (program.task != task + 1) continue;
    roots.push_back(program.run ? program.run : program.body);
    roots.push_back(program.setup);
  }
  for (const BlockTask& block : module.block_tasks)
    if (block.task == task + 1) roots.push_back(block.run);
  return roots;
}

std::vector<BodyId> reachableBodies(const Module& module, const std::vector<BodyId>& roots) {
  return Walk(module).run(roots);
}

}  // namespace rung::ir

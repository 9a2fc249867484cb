// SPDX-License-Identifier: Apache-2.0
// The variable that starts a task; see task_triggers.h.
#include "sema/declarations/task_triggers.h"

#include <algorithm>

#include "sema/declarations/addresses.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/expressions.h"
#include "sema/declarations/mentions.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

class TriggerPath {
 public:
  explicit TriggerPath(Context& context) : context_(context), project_(context.project) {}

  // False: not a variable that can be found by a path.
  bool append(ExprId expr) {
    const Tree& tree = context_.tree();
    const ExprKind kind = tree.kind(expr);
    if (kind == ExprKind::Member) return appendMember(tree.as<MemberExpr>(expr));
    if (kind == ExprKind::Index) return appendElement(tree.as<IndexExpr>(expr));
    if (kind == ExprKind::Address) return appendAddress(expr);
    if (kind != ExprKind::Name) return false;
    const Entity entity = meaning(tree, expr).entity;
    noteName(context_, entity, tree.loc(expr));
    if (entity.entityKind() == EntityKind::Program) return appendInstance(entity.index);
    if (entity.entityKind() == EntityKind::Pou) return appendProgram(PouId{entity.index});
    return entity.entityKind() == EntityKind::Var && appendGlobal(VarId{entity.index});
  }
  std::string path;

 private:
  std::string_view string(NameId name) const { return context_.names().string(name); }

  // Its name alone, unless another resource has an instance of that name.
  bool appendInstance(uint32_t index) {
    const ProgramInstance& instance = project_.instances[index];
    const auto named = [&](const ProgramInstance& other) { return context_.names().same(other.name, instance.name); };
    if (std::count_if(project_.instances.begin(), project_.instances.end(), named) > 1) {
      for (const NameId part : {instance.configuration, instance.resource})
        if (part) path.append(string(part)).append(".");
    }
    path += string(instance.name);
    return true;
  }

  // A program means its instance in the task's resource, else its first one.
  bool appendProgram(PouId program) {
    const auto& instances = project_.instances;
    for (const bool anywhere : {false, true}) {
      for (uint32_t i = 0; i < instances.size(); ++i) {
        if (!(instances[i].program == program)) continue;
        const NameId resource = instances[i].resource ? keyOf(context_, instances[i].resource) : NameId{};
        if (anywhere || resource == context_.resource) return appendInstance(i);
      }
    }
    return false;
  }

  bool appendGlobal(VarId id) {
    const Var& var = project_.var(id);
    if (var.storage == Storage::Image && var.image.is_bit) return appendBit(var.image);
    if (!var.list) return false;
    const NameId key = keyOf(context_, var.name);
    const bool is_bare = context_.scopes.globals.find(key).index == id.index;
    if (!is_bare || context_.scopes.resource_globals.find(key))
      path.append(string(project_.global_lists[var.list.index].name)).append(".");
    path += string(var.name);
    return true;
  }

  bool appendMember(const MemberExpr& node) {
    if (meaning(node.h).entity.entityKind() != EntityKind::Var) return false;
    noteName(context_, meaning(node.h).entity, node.h.loc);
    const Var& var = project_.var(VarId{meaning(node.h).entity.index});
    if (var.list || var.storage == Storage::Image) return appendGlobal(VarId{meaning(node.h).entity.index});
    if (var.storage != Storage::Field || !append(node.base)) return false;
    path.append(".").append(string(var.name));
    return true;
  }

  bool appendElement(const IndexExpr& node) {
    if (!append(node.base)) return false;
    path += '[';
    for (uint32_t i = 0; i < node.indices.count; ++i) {
      const auto index = evaluate(context_, context_.tree().list(node.indices)[i]);
      if (!index) return false;
      path += (i > 0 ? "," : "") + std::to_string(index->asSigned());
    }
    path += ']';
    return true;
  }

  bool appendAddress(ExprId expr) {
    const AddressExpr& node = context_.tree().as<AddressExpr>(expr);
    if (isHierarchical(context_, node.address)) return false;
    const auto view = resolveAddress(context_, node.address, node.h.loc, types::kBool);
    return view && view->is_bit && appendBit(*view);
  }

  bool appendBit(const ImageView& view) {
    path.append("%") += project_.options.areas[view.area.index].letter;
    path += "X" + std::to_string(view.byte) + "." + std::to_string(view.bit);
    return true;
  }

  Context& context_;
  Project& project_;
};

}  // namespace

std::string triggerPath(Context& context, ExprId trigger, std::string_view task) {
  const TypeId type = context.expressions->check(context, trigger, types::kBool);
  if (type == types::kError) return {};
  TriggerPath found(context);
  if (context.types().kind(type) == types::TypeKind::Bool && found.append(trigger)) return found.path;
  context.report(diag::TaskTriggerType, context.tree().begin(trigger), {task});
  return {};
}

}  // namespace rung::sema

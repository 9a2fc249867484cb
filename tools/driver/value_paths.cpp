// SPDX-License-Identifier: Apache-2.0
// Where the values of expressions are: see value_paths.h.
#include "tools/driver/value_paths.h"

#include <algorithm>

#include "frontend/syntax/children.h"
#include "frontend/syntax/st_printer.h"

namespace rung::driver {

ValuePaths::ValuePaths(const sema::Project& project) : project_(project), tree_(project.tree) {
  for (const sema::GlobalList& list : project.global_lists)
    for (const sema::VarId var : list.vars) ++globals_[project.names.key(project.var(var).name).index];
  for (const sema::Pou& pou : project.pous) {
    if (!pou.decl || pou.library || pou.instance.of) continue;
    for (const StmtId stmt : tree_.list(pou.body.code)) visit(stmt);
    for (const sema::VarId var : pou.vars) addDeclaration(var);
  }
  for (const sema::GlobalList& list : project.global_lists)
    for (const sema::VarId var : list.vars) addDeclaration(var);
  std::stable_sort(mentions_.begin(), mentions_.end(),
                   [](const Mention& a, const Mention& b) { return a.loc < b.loc; });
}

std::string ValuePaths::of(ExprId written) const {
  if (tree_.kind(written) == ExprKind::Address) return printSt(tree_, project_.names, written);
  const auto found = by_place_.find(keyOf(tree_.loc(written), tree_.kind(written)));
  return found == by_place_.end() ? std::string() : found->second.path;
}

std::vector<ValuePaths::Mention> ValuePaths::in(Range range) const {
  const auto isBefore = [](const Mention& mention, Loc loc) { return mention.loc < loc; };
  const auto first = std::lower_bound(mentions_.begin(), mentions_.end(), range.begin, isBefore);
  return {first, std::lower_bound(first, mentions_.end(), range.end, isBefore)};
}

// What is in a path is not looked at, but in its indices.
template <class Id>
void ValuePaths::visit(Id id) {
  if constexpr (std::is_same_v<Id, ExprId>)
    if (addExpression(id)) return;
  forEachChild(tree_, id, [&](const auto& child) { visit(child); });
}

bool ValuePaths::addExpression(ExprId id) {
  const ExprHeader& header = tree_.expr(id);
  std::string path;
  if (!header.has_room || !header.loc || !pathOf(id, path) || path.empty()) return false;
  const bool is_elementary = isElementary(sema::typeOf(tree_, id));
  if (is_elementary) mentions_.push_back({header.loc, path});
  by_place_.insert({keyOf(header.loc, header.kind), {std::move(path), is_elementary}});
  return true;
}

void ValuePaths::addDeclaration(sema::VarId id) {
  const sema::Var& var = project_.var(id);
  std::string path;
  if (var.loc && !var.external && isElementary(var.type) && rootPath(var, path)) mentions_.push_back({var.loc, path});
}

bool ValuePaths::isElementary(TypeId type) const {
  const types::TypeKind kind = project_.types.info(project_.types.resolve(type)).kind;
  return types::TypeTable::isElementary(kind) || kind == types::TypeKind::Enum || kind == types::TypeKind::Subrange;
}

// The path of a variable itself.
bool ValuePaths::rootPath(const sema::Var& var, std::string& path) const {
  if (var.external) return rootPath(project_.var(var.external), path);
  if (!var.name || var.temporary != 0) return false;
  const std::string name(project_.names.string(var.name));
  switch (var.storage) {
    case sema::Storage::Local:
    case sema::Storage::Constant: return false;
    case sema::Storage::Field: path = "." + name; return true;
    case sema::Storage::Image: path = (var.pou ? "." : "") + name; return true;
    case sema::Storage::Global: {
      const auto found = globals_.find(project_.names.key(var.name).index);
      if (!var.list || found == globals_.end()) return false;  // a VAR_STAT
      const bool is_shared = found->second > 1;
      path = (is_shared ? std::string(project_.names.string(project_.global_lists[var.list.index].name)) + "." : "") +
             name;
      return true;
    }
  }
  return false;
}

bool ValuePaths::indicesOf(const IndexExpr& node, std::string& path) const {
  std::string list;
  for (const ExprId index : tree_.list(node.indices)) {
    if (tree_.kind(index) != ExprKind::Literal) return false;
    const types::Value value = sema::valueOf(project_, tree_.as<LiteralExpr>(index));
    list += (list.empty() ? "[" : ",") + std::to_string(value.asSigned());
  }
  path += list + "]";
  return !list.empty();
}

bool ValuePaths::namedPath(ExprId id, std::string& path) const {
  const sema::Entity entity = sema::meaning(tree_, id).entity;
  if (entity.entityKind() == sema::EntityKind::Program) {
    path = project_.names.string(project_.instances[entity.index].name);
    return true;
  }
  if (entity.entityKind() != sema::EntityKind::Var) return false;
  const sema::Var& var = project_.var(sema::VarId{entity.index});
  if (tree_.kind(id) == ExprKind::Name || var.storage != sema::Storage::Field) return rootPath(var, path);
  if (!pathOf(tree_.as<MemberExpr>(id).base, path)) return false;
  path += "." + std::string(project_.names.string(var.name));
  return true;
}

// THIS^ and SUPER^ are the instance: an empty path.
bool ValuePaths::pathOf(ExprId id, std::string& path) const {
  const ExprKind kind = tree_.kind(id);
  const auto isObject = [&](ExprId of) {
    return tree_.kind(of) == ExprKind::This || tree_.kind(of) == ExprKind::Super;
  };
  if (isObject(id)) return true;
  if (kind == ExprKind::Name || kind == ExprKind::Member) return namedPath(id, path);
  if (kind == ExprKind::Index)
    return pathOf(tree_.as<IndexExpr>(id).base, path) && indicesOf(tree_.as<IndexExpr>(id), path);
  if (kind == ExprKind::Deref) {
    const ExprId base = tree_.as<DerefExpr>(id).base;
    if (!pathOf(base, path)) return false;
    if (!isObject(base)) path += '^';
    return true;
  }
  if (kind == ExprKind::BitAccess) {
    const auto& node = tree_.as<BitAccessExpr>(id);
    path = node.width == 1 && pathOf(node.base, path) ? path + "." + std::to_string(node.position) : "";
    return !path.empty();
  }
  if (kind == ExprKind::Address) path = printSt(tree_, project_.names, id);
  return kind == ExprKind::Address;
}

}  // namespace rung::driver

// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/inlay_hints.h"

#include <algorithm>

#include "frontend/syntax/children.h"
#include "frontend/syntax/node_at.h"
#include "tools/ide/meanings.h"

namespace rung::ide {
namespace {

class Hinter {
 public:
  Hinter(const View& view, const FileRange& part)
      : view_(view), tree_(view.tree()), scope_(view.meanings().scope()), project_(scope_.project()), part_(part) {}

  std::vector<InlayHint> hints() {
    for (const FileUnit* unit : view_.unitsOf(part_.file))
      for (const DeclId decl : tree_.list(unit->decls)) declaration(decl);
    const auto key = [](const InlayHint& hint) { return std::pair(hint.at.begin, hint.label); };
    std::stable_sort(hints_.begin(), hints_.end(),
                     [&](const InlayHint& a, const InlayHint& b) { return key(a) < key(b); });
    const auto is_same = [&](const InlayHint& a, const InlayHint& b) { return key(a) == key(b); };
    hints_.erase(std::unique(hints_.begin(), hints_.end(), is_same), hints_.end());
    return std::move(hints_);
  }

 private:
  void add(const FileRange& at, std::string label, HintKind kind) {
    if (at && at.file == part_.file && part_.begin <= at.begin && at.begin < part_.end)
      hints_.push_back({at, std::move(label), kind});
  }

  std::string text(NameId name) const { return std::string(view_.names().string(name)); }

  // ---- declarations

  void declaration(DeclId id) {
    const DeclKind kind = tree_.kind(id);
    if (kind == DeclKind::Pou)
      if (const PouId pou = scope_.pouOf(id); pou && tree_.as<PouDecl>(id).body_kind == BodyKind::St) body(pou);
    if (kind == DeclKind::Var) address(tree_.as<VarDecl>(id));
    forEachChild(tree_, id, [&](const auto& child) {
      using Id = std::remove_cvref_t<decltype(child)>;
      if constexpr (std::is_same_v<Id, DeclId>) declaration(child);
      if constexpr (std::is_same_v<Id, TypeExprId>) type(child);
    });
  }

  void type(TypeExprId id) {
    if (tree_.kind(id) == TypeExprKind::Enum)
      for (const EnumItem& item : tree_.list(tree_.as<EnumTypeExpr>(id).items)) {
        const Entity entity = item.value ? Entity{} : scope_.declaredAt(item.item.loc);
        if (entity.entityKind() == EntityKind::EnumValue)
          add(view_.nameInFile(item.item.loc), "= " + std::to_string(project_.enum_values[entity.index].value),
              HintKind::Value);
      }
    forEachChild(tree_, id, [&](const auto& child) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, TypeExprId>) type(child);
    });
  }

  // AT %I*: that of the variable, or of each instance that has one.
  void address(const VarDecl& decl) {
    if (!decl.located || !decl.address.incomplete || !decl.address_loc) return;
    constexpr size_t kMost = 3;
    std::vector<std::string> addresses;
    for (const Ident& name : tree_.list(decl.names)) {
      const Entity entity = scope_.declaredAt(name.loc);
      if (entity.entityKind() != EntityKind::Var) continue;
      const VarId id{entity.index};
      if (project_.var(id).storage == sema::Storage::Image) addresses.push_back(addressOf(project_.var(id).image));
      for (const sema::InstancePath& path : project_.instance_paths)
        if (path.located && path.var == id) addresses.push_back(addressOf(path.image));
    }
    std::string label;
    for (size_t i = 0; i < std::min(addresses.size(), kMost); ++i) label += (i > 0 ? ", " : "= ") + addresses[i];
    if (addresses.size() > kMost) label += ", …";
    if (!label.empty()) add(view_.tokenInFile(decl.address_loc), label, HintKind::Value);
  }

  std::string addressOf(const sema::ImageView& view) const { return addressText(project_, view); }

  // ---- code

  void body(PouId pou) {
    const FileRange whole = view_.inFile(extentOf(tree_, project_.pou(pou).decl));
    if (whole.end < part_.begin || part_.end < whole.begin) return;
    for (const StmtId stmt : tree_.list(project_.pou(pou).body.code)) code(stmt);
  }

  template <class Id>
  void code(Id id) {
    if constexpr (std::is_same_v<Id, ExprId>) {
      if (!tree_.expr(id).has_room) return;
      if (tree_.kind(id) == ExprKind::Call) pins(tree_.as<CallExpr>(id));
      if (tree_.kind(id) == ExprKind::Convert) conversion(tree_.as<ConvertExpr>(id));
    }
    forEachChild(tree_, id, [&](const auto& child) { code(child); });
  }

  void pins(const CallExpr& node) {
    const sema::Meaning& meaning = sema::meaning(node.h);
    if (!meaning.call) return;
    const sema::Call& call = project_.call(meaning.call);
    if (!call.pou || call.bindings.size() < 2) return;
    const sema::Pou& callee = project_.pou(call.pou);
    if (callee.extensible || callee.pragmas.operator_kind != sema::OperatorKind::None) return;
    for (const Argument& argument : tree_.list(node.arguments)) {
      if (argument.pin.name || !argument.value) continue;
      const FileRange at = view_.inFile(tree_.range(argument.value));
      for (const sema::Binding& binding : call.bindings)
        if (binding.value && binding.pin && tree_.begin(binding.value) == tree_.begin(argument.value))
          pin(at, text(project_.var(binding.pin).name));
    }
  }

  // Not where the argument says it already.
  void pin(const FileRange& at, const std::string& name) {
    if (!at) return;
    std::string_view written = view_.textOf(at.file).substr(at.begin, at.end - at.begin);
    written = written.substr(written.rfind('.') + 1);
    if (!sameIdentifier(written, name)) add(at, name + " :=", HintKind::Pin);
  }

  void conversion(const ConvertExpr& node) {
    const sema::Meaning& meaning = sema::meaning(node.h);
    // Integers compute in the native width all the time.
    const bool is_usual = meaning.is_intermediate && types::TypeTable::isInteger(project_.types.kind(meaning.type));
    if (is_usual || !meaning.type) return;
    ExprId operand = node.operand;
    while (tree_.kind(operand) == ExprKind::Convert) operand = tree_.as<ConvertExpr>(operand).operand;
    if (tree_.kind(operand) == ExprKind::Literal) return;
    const FileRange at = view_.inFile(tree_.range(operand));
    const std::string from = project_.types.toString(sema::meaning(tree_, operand).type);
    const std::string to = project_.types.toString(meaning.type);
    if (from != to) add(at, "→ " + to, HintKind::Type);
  }

  const View& view_;
  const Tree& tree_;
  const Scope& scope_;
  const sema::Project& project_;
  const FileRange part_;
  std::vector<InlayHint> hints_;
};

}  // namespace

std::vector<InlayHint> hintsIn(const View& view, const FileRange& part) {
  return view.snapshot().project() == nullptr ? std::vector<InlayHint>() : Hinter(view, part).hints();
}

std::string addressText(const sema::Project& project, const sema::ImageView& at) {
  const std::string area = std::string("%") + project.options.areas[at.area.index].letter;
  if (at.is_bit) return area + "X" + std::to_string(at.byte) + "." + std::to_string(at.bit);
  return area + "B" + std::to_string(at.byte);
}

}  // namespace rung::ide

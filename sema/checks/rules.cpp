// SPDX-License-Identifier: Apache-2.0
#include "sema/checks/rules.h"

#undef RUNG_ERROR
#undef RUNG_WARNING
#undef RUNG_INFO
#undef RUNG_NOTE
#define RUNG_ERROR(code, name, text)
#define RUNG_WARNING(code, name, text)
#define RUNG_INFO(code, name, text)
#define RUNG_NOTE(name, text)

namespace rung::sema {
namespace {

enum class Hook : uint8_t {
  Use,
  Assignment,
  Conversion,
  Index,
  Comparison,
  Operation,
  Call,
  Assign,
  If,
  Case,
  For,
  Pou,
  Declarations,
  Project,
};

template <Hook kHook, class... Found>
void run(Context& context, const Found&... found) {
#define RUNG_RULE(hook, file, function) \
  if constexpr (kHook == Hook::hook) function(context, found...);
#include "sema/checks/rules.def"
#undef RUNG_RULE
}

class AllRules final : public Rules {
 public:
  void use(Context& context, const UsedName& used) const override { run<Hook::Use>(context, used); }
  void assignment(Context& context, ExprId target, ExprId value) const override {
    run<Hook::Assignment>(context, target, value);
  }
  void conversion(Context& context, ExprId value, TypeId to) const override {
    run<Hook::Conversion>(context, value, to);
  }
  void expression(Context& context, ExprId expr) const override {
    const Tree& tree = context.tree();
    if (tree.kind(expr) == ExprKind::Index) return run<Hook::Index>(context, tree.as<IndexExpr>(expr));
    const std::optional<Operation> operation = operationOf(context, expr);
    if (!operation) return;
    const bool is_comparison = operation->op >= types::Op::Eq && operation->op <= types::Op::Ge;
    if (is_comparison) return run<Hook::Comparison>(context, *operation);
    run<Hook::Operation>(context, *operation);
  }
  void call(Context& context, const CallExpr& node, const Call& call) const override {
    run<Hook::Call>(context, node, call);
  }
  void statement(Context& context, StmtId id) const override {
    const Tree& tree = context.tree();
    const StmtKind kind = tree.kind(id);
    if (kind == StmtKind::Assign) return run<Hook::Assign>(context, tree.as<AssignStmt>(id));
    if (kind == StmtKind::If) return run<Hook::If>(context, tree.as<IfStmt>(id));
    if (kind == StmtKind::Case) return run<Hook::Case>(context, tree.as<CaseStmt>(id));
    if (kind == StmtKind::For) return run<Hook::For>(context, tree.as<ForStmt>(id));
  }
  void pou(Context& context) const override { run<Hook::Pou>(context); }
  void declarations(Context& context) const override { run<Hook::Declarations>(context); }
  void project(Context& context) const override { run<Hook::Project>(context); }
};

}  // namespace

const Rules& allRules() {
  static const AllRules kRules;
  return kRules;
}

}  // namespace rung::sema

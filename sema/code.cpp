// SPDX-License-Identifier: Apache-2.0
#include "sema/code.h"

#include "frontend/syntax/children.h"

namespace rung::sema {
namespace {

constexpr uint32_t kRoom = sizeof(Meaning) / 4;
static_assert(sizeof(Meaning) % 4 == 0 && alignof(Meaning) == 4);

// Gives a copied node copies of its lists, and copies of the expressions and statements in it. Types stay as written.
class Deep {
 public:
  Deep(Tree& arena, const Code& code) : arena_(arena), code_(code) {}

  template <class T>
  void operator()(T& field) const {
    in(field);
  }

 private:
  template <class Id>
  requires std::is_same_v<Id, ExprId> || std::is_same_v<Id, StmtId>
  void in(Id& id) const {
    if (id) id = code_.copy(id);
  }
  template <class T>
  void in(Slice<T>& list) const {
    list = arena_.addList<T>(arena_.list(list));
    for (T& element : arena_.list(list)) in(element);
  }
  void in(Argument& argument) const { in(argument.value); }
  void in(FieldInit& field) const { in(field.value); }
  void in(IfBranch& branch) const {
    in(branch.condition);
    in(branch.body);
  }
  void in(CaseBranch& branch) const {
    in(branch.labels);
    in(branch.body);
  }
  void in(TypeExprId&) const {}

  Tree& arena_;
  const Code& code_;
};

}  // namespace

TreeBuilder Code::build() const { return TreeBuilder(arena_, kRoom); }

ExprId Code::copyNode(ExprId of) const {
  // clang-format off
  switch (arena_.kind(of)) {
#define RUNG_EXPR(kind, word, shape, ...) \
  case ExprKind::kind: return arena_.add(arena_.as<kind##Expr>(of), kRoom);
#include "frontend/syntax/nodes.def"
  }
  // clang-format on
  return {};
}

ExprId Code::copy(ExprId written) const {
  const ExprId copied = copyNode(written);
  meaning(arena_, copied).written = written;
  forEachField(arena_, copied, Deep(arena_, *this));
  return copied;
}

StmtId Code::copy(StmtId written) const {
  StmtId copied;
  // clang-format off
  switch (arena_.kind(written)) {
#define RUNG_STMT(kind, word, ...) \
  case StmtKind::kind: copied = arena_.add<StmtId>(kind##Stmt(arena_.as<kind##Stmt>(written))); break;
#include "frontend/syntax/nodes.def"
  }
  // clang-format on
  forEachField(arena_, copied, Deep(arena_, *this));
  return copied;
}

Slice<StmtId> Code::copy(Slice<StmtId> written) const {
  const Slice<StmtId> copied = arena_.addList<StmtId>(arena_.list(written));
  for (StmtId& statement : arena_.list(copied)) statement = copy(statement);
  return copied;
}

Slice<Argument> Code::copy(Slice<Argument> written) const {
  const Slice<Argument> copied = arena_.addList<Argument>(arena_.list(written));
  for (Argument& argument : arena_.list(copied))
    if (argument.value) argument.value = copy(argument.value);
  return copied;
}

ExprId Code::duplicate(ExprId of) const {
  const ExprId copied = copyNode(of);
  meaning(arena_, copied) = meaning(arena_, of);
  return copied;
}

void Code::replace(ExprId& slot, ExprId by) const {
  if (meaning(arena_, by).written) by = duplicate(by);
  meaning(arena_, by).written = slot ? meaning(arena_, slot).written : ExprId{};
  slot = by;
}

}  // namespace rung::sema

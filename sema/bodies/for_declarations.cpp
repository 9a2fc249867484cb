// SPDX-License-Identifier: Apache-2.0
#include "sema/bodies/for_declarations.h"
#include "sema/bodies/body.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/objects.h"
#include "sema/bodies/pointers.h"

namespace rung::sema {
namespace {

class BodyExpressions final : public Expressions {
 public:
  TypeId check(Context& context, ExprId& expr, TypeId expected) const override {
    return checkExpr(context, expr, expected);
  }
  bool checkAs(Context& context, ExprId& expr, TypeId to, std::string_view what) const override {
    return checkExprAs(context, expr, to, what);
  }
  bool bindReference(Context& context, ExprId& lvalue, TypeId reference) const override {
    return sema::bindReference(context, lvalue, reference);
  }
  CallId checkConstructor(Context& context, TypeExprId type, uint32_t& elements) const override {
    return sema::checkConstructor(context, type, elements);
  }
  void checkConnections(Context& context, ExprId call, PouId program) const override {
    sema::checkConnections(context, call, program);
  }
  bool ensureBody(Context& context, PouId pou) const override { return sema::ensureBody(context, pou); }
};

}  // namespace

const Expressions& expressionsForDeclarations() {
  static const BodyExpressions kExpressions;
  return kExpressions;
}

}  // namespace rung::sema

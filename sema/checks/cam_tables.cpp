// SPDX-License-Identifier: Apache-2.0
// Forbids cams that MC_CamTableSelect would refuse at run time (errors 750 and 751), where the source tells: the array
// of the cam has an initial value, and no body changes it. Warns of one that jumps where it repeats. TM/TP
// manual 1.8.3, 7.2.3.
//   passes  points : ARRAY[0..1] OF SMC_CAMXYVA := [(), (dX := 360, dY := 10)];
//           cam : MC_CAM_REF := (nElements := 2, xEnd := 360, pce := ADR(points));
//   fails   the same with nElements := 3                                                          E1324
//   fails   … := [(dX := 360), (dX := 0)]                                                          E1321
// Called once, when all bodies are checked. Linear in the expressions and in the rows.
#include "sema/checks/rules.h"

#include <cmath>

#include "cam/design/jumps.h"
#include "cam/design/text_form.h"
#include "frontend/syntax/children.h"
#include "sema/bodies/constant_cams.h"
#include "sema/bodies/names.h"
#include "sema/declarations/constants.h"
#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

using cam::exactText;
using cam::Kind;

std::string rowName(const Context& context, const ConstantCam& cam, size_t row) {
  const size_t per_row = cam.cam.kind == Kind::Pairs ? 2 : 1;
  return std::string(string(context, context.symbols.var(cam.array).name)) + "[" +
         std::to_string(cam.low + static_cast<int64_t>(row * per_row)) + "]";
}

// One mistake of a cam hides those that follow from it.
class Checker {
 public:
  Checker(Context& context, const ConstantCam& cam) : context_(context), cam_(cam), table_(cam.cam) {}

  bool isCorrect() { return fits() && hasRange() && isFinite() && isInOrder() && isCovered() && isContinuous(); }

 private:
  std::string_view name() const { return table_.name; }

  bool fits() {
    if (cam_.number != cam::Number::None && static_cast<uint8_t>(cam_.number) != cam_.var_type) {
      context_.report(diag::CamTableNumber, cam_.type_loc,
                      {name(), context_.types().toString(elementType()), std::to_string(static_cast<int>(cam_.number)),
                       std::to_string(cam_.var_type)});
      return false;
    }
    if (cam_.elements > cam_.room) {
      context_
          .report(diag::CamTableRoom, cam_.elements_loc,
                  {name(), std::to_string(cam_.elements), array().name ? string(context_, array().name) : "",
                   std::to_string(cam_.room)})
          .declaredHere(array().loc);
      return false;
    }
    const auto least = static_cast<int64_t>(table_.leastRows());
    if (cam_.elements >= least) return true;
    context_.report(diag::CamTablePoints, cam_.elements_loc,
                    {name(), std::to_string(cam_.elements), std::to_string(least)});
    return false;
  }

  const Var& array() const { return context_.symbols.var(cam_.array); }
  TypeId elementType() const { return context_.types().info(context_.types().resolve(array().type)).base; }

  bool hasRange() {
    if (table_.start < table_.end) return true;
    context_.report(diag::CamTableEmpty, cam_.end_loc, {name(), exactText(table_.end), exactText(table_.start)});
    return false;
  }

  bool isFinite() {
    for (size_t row = 0; row < table_.rowCount(); ++row) {
      bool is_finite = std::isfinite(table_.masterAt(row));
      if (table_.kind == Kind::QuinticPoints) {
        const cam::Point& p = table_.points[row];
        is_finite = is_finite && std::isfinite(p.y) && std::isfinite(p.slope) && std::isfinite(p.curvature);
      }
      if (table_.kind == Kind::Polynomials)
        for (const double factor : table_.polynomials[row].c) is_finite = is_finite && std::isfinite(factor);
      if (table_.kind == Kind::Equidistant) is_finite = std::isfinite(table_.numbers[row]);
      if (table_.kind == Kind::Pairs) is_finite = is_finite && std::isfinite(table_.numbers[2 * row + 1]);
      if (is_finite) continue;
      context_.report(diag::CamTableNotFinite, cam_.rows[row], {rowName(context_, cam_, row)});
      return false;
    }
    return true;
  }

  bool isInOrder() {
    if (table_.kind == Kind::Equidistant) return true;
    bool is_in_order = true;
    for (size_t row = 1; row < table_.rowCount(); ++row) {
      const double before = table_.masterAt(row - 1), here = table_.masterAt(row);
      if (before < here) continue;
      const Diag diag = before == here ? diag::CamTableDuplicate : diag::CamTableOrder;
      context_.report(diag, cam_.rows[row], {exactText(here), rowName(context_, cam_, row), exactText(before)})
          .note(cam_.rows[row - 1], Note{"the element before"});
      is_in_order = false;
    }
    return is_in_order;
  }

  bool isCovered() {
    const double first = table_.masterAt(0);
    const double last = table_.kind == Kind::Polynomials ? table_.end : table_.masterAt(table_.rowCount() - 1);
    const bool begins = table_.kind == Kind::Polynomials ? table_.polynomials.back().x < table_.end : true;
    if (first <= table_.start && table_.end <= last && begins) return true;
    const double highest = table_.masterAt(table_.rowCount() - 1);
    context_.report(diag::CamTableRange, cam_.end_loc,
                    {name(), exactText(table_.start), exactText(table_.end), exactText(first), exactText(highest)});
    return false;
  }

  // Where two polynomials meet.
  bool isContinuous() {
    const std::vector<cam::Jump> jumps = cam::jumpsOf(curveOf(table_));
    if (jumps.empty()) return true;
    const auto [x, size] = jumps.front();
    size_t row = 0;
    while (row + 1 < table_.rowCount() && table_.masterAt(row) < x) ++row;
    context_.report(diag::CamTableJump, cam_.rows[row], {name(), exactText(size), exactText(x)});
    return false;
  }

  Context& context_;
  const ConstantCam& cam_;
  const cam::Cam& table_;
};

// The calls that select a cam to repeat it on an absolute slave without a period.
class Selections {
 public:
  explicit Selections(Context& context) : context_(context), tree_(context.tree()) {
    for (uint32_t i = 1; i < context.symbols.pous.size(); ++i) {
      const Pou& pou = context.symbols.pous[i];
      if (pou.library || !pou.decl || pou.generic || !pou.progress.checked()) continue;
      for (const StmtId id : tree_.list(pou.body.code)) walk(id);
    }
  }

  // Where a cam is said to repeat; none: nowhere, or its slave may have a period or follow relatively.
  Loc repeats(VarId cam) const {
    if (may_be_relative_ || sets_period_) return {};
    for (const Selection& selection : found_)
      if (selection.cam == cam) return selection.loc;
    return {};
  }

 private:
  struct Selection {
    VarId cam;
    Loc loc;
  };

  void walk(StmtId id) {
    if (tree_.kind(id) == StmtKind::Assign) {
      const ExprId target = tree_.as<AssignStmt>(id).target;
      sets_period_ = sets_period_ || isNamed(target, "fPositionPeriod");
      may_be_relative_ = may_be_relative_ || isNamed(target, "StartMode");
    }
    forEachChild(tree_, id, [&](auto child) { walk(child); });
  }
  void walk(ExprId id) {
    if (tree_.kind(id) == ExprKind::Call && meaning(tree_, id).call) note(tree_.as<CallExpr>(id));
    forEachChild(tree_, id, [&](auto child) { walk(child); });
  }
  void walk(TypeExprId) {}
  void walk(DeclId) {}

  bool isNamed(ExprId id, std::string_view name) const {
    return tree_.kind(id) == ExprKind::Member &&
           sameIdentifier(context_.names().string(tree_.as<MemberExpr>(id).member), name);
  }

  VarId variable(ExprId id) const {
    const Entity entity = id ? entityOf(context_, id) : Entity{};
    if (entity.entityKind() != EntityKind::Var) return {};
    VarId var{entity.index};
    while (const VarId global = context_.symbols.var(var).external) var = global;
    return var;
  }

  bool isTrue(ExprId id) const {
    const auto value = id ? evaluate(context_, id) : std::nullopt;
    return value && value->bits != 0;
  }

  bool hasPeriod(VarId slave) const {
    const ExprId init = slave ? context_.symbols.var(slave).init : ExprId{};
    if (!slave || (init && tree_.kind(init) != ExprKind::StructInit)) return true;
    if (!init) return false;
    for (const FieldInit& field : tree_.list(tree_.as<StructInitExpr>(init).fields))
      if (sameIdentifier(context_.names().string(field.field.name), "fPositionPeriod")) return true;
    return false;
  }

  void note(const CallExpr& node) {
    ExprId cam, periodic, absolute, slave;
    for (const Binding& binding : context_.symbols.call(meaning(node.h).call).bindings) {
      if (!binding.pin || !binding.value) continue;
      const std::string_view pin = string(context_, context_.symbols.var(binding.pin).name);
      if (sameIdentifier(pin, "CamTable")) cam = binding.value;
      if (sameIdentifier(pin, "Periodic")) periodic = binding.value;
      if (sameIdentifier(pin, "SlaveAbsolute")) absolute = binding.value;
      if (sameIdentifier(pin, "Slave")) slave = binding.value;
      if (!sameIdentifier(pin, "StartMode")) continue;
      const auto mode = evaluate(context_, binding.value);
      may_be_relative_ = may_be_relative_ || !mode || mode->bits != 0;
    }
    if (!cam || !isTrue(periodic) || !isTrue(absolute) || hasPeriod(variable(slave))) return;
    if (const VarId selected = variable(cam)) found_.push_back({selected, tree_.begin(cam)});
  }

  Context& context_;
  const Tree& tree_;
  std::vector<Selection> found_;
  bool may_be_relative_ = false, sets_period_ = false;
};

void checkClosure(Context& context, const ConstantCam& cam, const Selections& selections) {
  const Loc loc = selections.repeats(cam.var);
  if (!loc) return;
  const auto jump = cam::jumpOfRepeat(cam.cam, curveOf(cam.cam), cam::Repeat::Closed);
  if (!jump) return;
  context.report(diag::CamTableClosure, loc, {cam.cam.name, exactText(*jump)}).declaredHere(cam.name);
}

}  // namespace

void checkCamTables(Context& context) {
  if (context.symbols.diagnostics.hasErrors()) return;
  const std::vector<ConstantCam> cams = constantCams(context);
  if (cams.empty()) return;
  const Selections selections(context);
  for (const ConstantCam& cam : cams)
    if (Checker(context, cam).isCorrect()) checkClosure(context, cam, selections);
}

}  // namespace rung::sema

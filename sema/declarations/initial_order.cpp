// SPDX-License-Identifier: Apache-2.0
// The order of initial values that read variables (codesys): each is set after those that it reads. In: checked initial
// values, and the variables whose value is not constant (Scopes::reading_inits). Out: Project::late, the global
// variables that are set after all lists, and Pou::late, those of one instance; both in order of dependence. Functions
// that an initial value calls may read globals too: neither CODESYS nor Rung guarantees an order there.
#include "sema/declarations/initial_order.h"

#include <algorithm>
#include <unordered_map>

#include "frontend/syntax/children.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/objects.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

struct InitialOrder {
  Context& context;
  std::unordered_map<uint32_t, std::vector<VarId>> reads;  // by VarId: the variables that its initial value reads
  std::unordered_map<uint32_t, std::vector<VarId>> record_reads;  // by TypeId: globals that its fields' values read

  const Tree& tree() const { return context.tree(); }
  Var& var(VarId id) const { return context.symbols.var(id); }

  void addVar(Entity entity, std::vector<VarId>& into) const {
    if (entity.entityKind() != EntityKind::Var) return;
    VarId id{entity.index};
    if (var(id).external) id = var(id).external;
    if (!var(id).has_value && (var(id).storage == Storage::Global || var(id).storage == Storage::Field))
      into.push_back(id);
  }

  void collectCall(CallId id, std::vector<VarId>& into) const {
    if (id.index == 0) return;
    for (const Binding& binding : context.symbols.call(id).bindings)
      if (binding.value) collect(binding.value, into);
  }

  // What FB_Init takes as a reference or an interface may be the object itself, as in TwinCAT.
  void collectConstructor(CallId id, std::vector<VarId>& into) const {
    for (const Binding& binding : context.symbols.call(id).bindings) {
      const Var& pin = var(binding.pin);
      const bool is_object = pin.section == SectionKind::InOut || interfaceOf(context, pin.type) ||
                             context.types().kind(pin.type) == types::TypeKind::Reference;
      if (!is_object) collect(binding.value, into);
    }
  }

  // Every variable whose value an expression reads. An address is known before all values.
  void collect(ExprId id, std::vector<VarId>& into) const {
    if (!id) return;
    const ExprKind kind = tree().kind(id);
    if (kind == ExprKind::Name) return addVar(meaning(tree(), id).entity, into);
    if (kind == ExprKind::Member) addVar(meaning(tree(), id).entity, into);
    if (kind == ExprKind::Call) return collectCall(meaning(tree(), id).call, into);
    const bool only_takes_addresses = shape(kind) == ExprShape::Inserted && kind != ExprKind::Convert;
    if (only_takes_addresses || kind == ExprKind::New || kind == ExprKind::Range) return;
    forEachOperand(tree(), id, [&](ExprId operand) { collect(operand, into); });
  }

  void readsOf(VarId id) {
    std::vector<VarId> all;
    collect(var(id).init, all);
    const uint32_t first = var(id).start.constructor.index;
    const uint32_t count = first == 0 ? 0 : std::max(var(id).start.element_constructors, 1u);
    for (uint32_t i = 0; i < count; ++i) collectConstructor(CallId{first + i}, all);
    std::sort(all.begin(), all.end(), [](VarId a, VarId b) { return a.index < b.index; });
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::erase_if(all, [&](VarId read) { return !var(read).list && var(read).pou != var(id).pou; });
    if (all.empty()) return;
    if (!var(id).list && var(id).pou) {
      std::vector<VarId>& of_record = record_reads[context.symbols.pou(var(id).pou).record.index];
      for (const VarId read : all)
        if (var(read).list) of_record.push_back(read);
    }
    reads[id.index] = std::move(all);
  }

  TypeId recordIn(TypeId type) const {
    while (context.types().kind(type) == types::TypeKind::Array)
      type = context.types().info(context.types().resolve(type)).base;
    return context.types().kind(type) == types::TypeKind::Record ? context.types().resolve(type) : TypeId{};
  }

  // A global instance reads the variables that the initial values of its block read, and of the blocks within.
  void spreadToHolders() {
    std::erase_if(record_reads, [](const auto& entry) { return entry.second.empty(); });
    if (record_reads.empty()) return;
    std::unordered_map<uint32_t, std::vector<VarId>> holders;  // by TypeId: the variables that hold such a record
    const auto note = [&](VarId id) {
      if (const TypeId record = var(id).section == SectionKind::InOut ? TypeId{} : recordIn(var(id).type))
        holders[record.index].push_back(id);
    };
    for (uint32_t i = 1; i < context.symbols.vars.size(); ++i)
      if (context.symbols.vars[i].type && !context.symbols.vars[i].external) note(VarId{i});
    std::vector<uint32_t> changed;
    for (const auto& [record, list] : record_reads) changed.push_back(record);
    std::sort(changed.begin(), changed.end());
    while (!changed.empty()) {
      const uint32_t record = changed.back();
      changed.pop_back();
      const std::vector<VarId> what = record_reads[record];
      for (const VarId holder : holders[record]) {
        const TypeId around =
            var(holder).pou && !var(holder).list ? context.symbols.pou(var(holder).pou).record : var(holder).record;
        std::vector<VarId>& into = var(holder).list ? reads[holder.index] : record_reads[around.index];
        const size_t before = into.size();
        for (const VarId read : what)
          if (std::find(into.begin(), into.end(), read) == into.end()) into.push_back(read);
        if (!var(holder).list && around && into.size() != before) changed.push_back(around.index);
      }
    }
  }

  // Forbids initial values that depend on each other.
  //   fails   VAR_GLOBAL a : INT := b; b : INT := a + 1; END_VAR       E0365
  void reportCycle(const std::vector<VarId>& path, VarId again) const {
    auto at = std::find(path.begin(), path.end(), again);
    std::string way;
    for (auto step = at; step != path.end(); ++step) way += "`" + toString(context, var(*step).name) + "` reads ";
    way += "`" + toString(context, var(again).name) + "`";
    const Loc loc = var(again).init ? tree().begin(var(again).init) : var(again).loc;
    context.report(diag::InitialValueCycle, loc, {toString(context, var(again).name), way});
  }

  // Depth first with an explicit stack, in order of declaration; `same`: which variables are ordered together.
  template <class Same>
  void order(const std::vector<VarId>& all, std::vector<VarId>& into, Same same) {
    struct Step {
      VarId id;
      size_t next;
    };
    std::vector<Step> stack;
    std::vector<VarId> path;
    std::unordered_map<uint32_t, State> states;
    for (const VarId root : all) {
      if (states[root.index] != State::New) continue;
      stack.push_back({root, 0});
      path.push_back(root);
      states[root.index] = State::Busy;
      while (!stack.empty()) {
        Step& top = stack.back();
        const auto known = reads.find(top.id.index);
        if (known == reads.end() || top.next == known->second.size()) {
          states[top.id.index] = State::Done;
          if (known != reads.end()) into.push_back(top.id);
          stack.pop_back();
          path.pop_back();
          continue;
        }
        const VarId read = known->second[top.next++];
        if (!same(read)) continue;
        State& state = states[read.index];
        if (state == State::Busy) reportCycle(path, read);
        if (state != State::New) continue;
        state = State::Busy;
        stack.push_back({read, 0});
        path.push_back(read);
      }
    }
  }
};

}  // namespace

void orderInitialValues(Context& context) {
  std::vector<VarId>& reading = context.scopes.reading_inits;
  if (reading.empty()) return;
  Project& project = context.project;
  InitialOrder order{context, {}, {}};
  for (const VarId id : reading) order.readsOf(id);
  order.spreadToHolders();
  std::vector<VarId> globals;
  std::unordered_map<uint32_t, std::vector<VarId>> of_pou;
  std::vector<uint32_t> pous;
  std::vector<VarId> all;
  for (const auto& [index, list] : order.reads) all.push_back(VarId{index});
  std::sort(all.begin(), all.end(), [](VarId a, VarId b) { return a.index < b.index; });
  for (const VarId id : all) {
    const Var& var = project.var(id);
    if (var.list) {
      globals.push_back(id);
    } else if (var.storage == Storage::Field && var.pou) {
      if (of_pou[var.pou.index].empty()) pous.push_back(var.pou.index);
      of_pou[var.pou.index].push_back(id);
    }
  }
  order.order(globals, project.late, [&](VarId id) { return static_cast<bool>(project.var(id).list); });
  for (const uint32_t pou : pous)
    order.order(of_pou[pou], project.pous[pou].late,
                [&](VarId id) { return !project.var(id).list && project.var(id).pou.index == pou; });
  for (const VarId id : project.late) project.var(id).start.late = true;
  for (const uint32_t pou : pous)
    for (const VarId id : project.pous[pou].late) project.var(id).start.late = true;
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// The variables of a chart; see sfc_schedule.h. Those of a chart in an action are VAR_INST, so that it keeps its state.
// Flags from other declarations are not known yet: the variables they need are declared where their name occurs
// anywhere in the project.
#include "frontend/schedule/sfc_builder.h"
#include "frontend/schedule/sfc_chart.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {
namespace {

class SfcDeclarer {
 public:
  explicit SfcDeclarer(const Chart& chart)
      : chart_(chart),
        tree_(chart.charts_.tree),
        names_(chart.charts_.names),
        make_(tree_, names_),
        loc_(chart.pou_.body_begin) {}

  Slice<DeclId> run();

 private:
  bool occurs(const char* flag) const { return static_cast<bool>(names_.find(flag)); }
  void declareSteps();
  void declareConditions();
  void declareSets();
  void declareTemporaries();
  void declareSet(const char* name, size_t members, bool starts = false);
  // name, name : type := init;
  void declare(std::span<const Ident> names, TypeExprId type, ExprId init);
  void declare(const Ident& name, const char* type, ExprId init = {}) { declare({&name, 1}, named(type), init); }
  void declare(const char* name, const char* type, ExprId init = {}) { declare(here(name), type, init); }
  void declarePair(const char* first, const char* second, const char* type) {
    const Ident names[] = {here(first), here(second)};
    declare(names, named(type), {});
  }
  Ident here(std::string_view name) { return {names_.intern(name), loc_}; }
  TypeExprId named(const char* type);
  DeclId section(SectionKind kind);

  const Chart& chart_;
  Tree& tree_;
  Names& names_;
  SfcBuilder make_;
  TreeBuilder build_{tree_};
  Loc loc_;
  std::vector<DeclId> vars_;  // of the current section
};

TypeExprId SfcDeclarer::named(const char* type) {
  const Ident name = here(type);
  return build_.namedType({&name, 1}, loc_);
}

void SfcDeclarer::declare(std::span<const Ident> names, TypeExprId type, ExprId init) {
  vars_.push_back(build_.variable(names, type, init));
}

DeclId SfcDeclarer::section(SectionKind kind) {
  const DeclId made = build_.section(kind, vars_, chart_.pou_.body_begin, SectionMaker::Chart);
  vars_.clear();
  return made;
}

// A set of steps or actions; it `starts` with the initial steps.
void SfcDeclarer::declareSet(const char* name, size_t members, bool starts) {
  const uint32_t words = chart_.words(members);
  if (words <= 1) return declare(name, "LWORD", starts ? make_.bits(chart_.initialSteps(0)) : ExprId{});
  std::vector<ExprId> initial;
  for (uint32_t i = 0; starts && i < words; ++i) initial.push_back(make_.bits(chart_.initialSteps(i)));
  const ArrayBound bound{make_.number(0), make_.number(words - 1)};
  const Ident set = here(name);
  declare({&set, 1}, build_.arrayType({&bound, 1}, named("LWORD"), loc_),
          starts ? build_.arrayInit(tree_.addList<ExprId>(initial), loc_) : ExprId{});
}

void SfcDeclarer::declareSteps() {
  for (const SfcStep& step : chart_.steps_) {
    loc_ = step.name.loc;
    declare(step.name, "SFCStepType");
  }
  for (uint32_t i = 0; i < chart_.actions_.size(); ++i) {
    loc_ = chart_.actions_[i].loc;
    make_.at(loc_);
    const FieldInit no_final_scan{here("final_scan"), make_.boolean(false)};
    declare(here(chart_.controlOf(i)), "SFCActionControl",
            chart_.context_.final_scan ? ExprId{} : build_.structInit({&no_final_scan, 1}, loc_));
  }
}

void SfcDeclarer::declareConditions() {
  for (const SfcTransition& t : chart_.transitions_) {
    if (!chart_.keepsCondition(t)) continue;
    loc_ = t.target.loc;
    declare(t.target, "BOOL");
  }
}

void SfcDeclarer::declareSets() {
  loc_ = chart_.pou_.body_begin;
  make_.at(loc_);
  declareSet("sfc_steps", chart_.steps_.size());
  declareSet("sfc_left", chart_.steps_.size());
  declareSet("sfc_entered", chart_.steps_.size(), true);
  if (!chart_.actions_.empty()) declareSet("sfc_actions", chart_.actions_.size());
  declare("sfc_fired", "BOOL", make_.boolean(true));
  if (occurs("SFCTipMode")) declarePair("sfc_tip", "sfc_tip_before", "BOOL");
  if (occurs("SFCPause") || occurs("SFCQuitError")) declarePair("sfc_paused", "sfc_last", "TIME");
}

void SfcDeclarer::declareTemporaries() {
  declare("sfc_now", "TIME");
  declare("sfc_set", "LWORD");
  if (occurs("SFCErrorAnalyzationTable")) declare("sfc_row", "DINT");
  if (chart_.words(chart_.steps_.size()) > 1 || chart_.words(chart_.actions_.size()) > 1) declare("sfc_word", "INT");
}

Slice<DeclId> SfcDeclarer::run() {
  const bool is_chart = chart_.pou_.body_kind == BodyKind::Sfc;
  declareSteps();
  declareConditions();
  if (is_chart) declareSets();
  std::vector<DeclId> sections = {section(chart_.context_.around.empty() ? SectionKind::Local : SectionKind::Inst)};
  if (is_chart) {
    declareTemporaries();
    sections.push_back(section(SectionKind::Temp));
  }
  return tree_.addList<DeclId>(sections);
}

}  // namespace

Slice<DeclId> declareSfc(const Charts& charts, const PouDecl& pou, const ChartContext& context) {
  return SfcDeclarer(Chart(charts, pou, context)).run();
}

}  // namespace rung::text

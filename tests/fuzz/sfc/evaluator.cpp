// SPDX-License-Identifier: Apache-2.0
// The reference evaluator of charts: slow and plain. See chart.h.
#include <algorithm>
#include <memory>

#include "tests/fuzz/sfc/chart.h"

namespace rung::sfc_differential {
namespace {

struct Control {  // of one action; times in ms, -1: not running
  bool stored = false, delayed_stored = false, ran = false;
  bool had_p = false, had_p1 = false, had_p0 = false, had_sl = false;
  int limit_since = -1, delay_since = -1, sd_since = -1, ds_since = -1, sl_since = -1;
};

class Evaluator {
 public:
  Evaluator(const Chart& chart, Evaluator* outer = nullptr) : chart_(chart), outer_(outer), steps_(chart.steps.size()) {
    if (!chart.nested.empty()) nested_ = std::make_unique<Evaluator>(chart.nested[0], this);
    steps_[0].enters = true;
    for (const Step& step : chart.steps)
      for (const Association& a : step.associations)
        if (std::find(order_of_actions_.begin(), order_of_actions_.end(), a.action) == order_of_actions_.end())
          order_of_actions_.push_back(a.action);
    // By name: a10, a11, a6, …
    std::sort(order_of_actions_.begin(), order_of_actions_.end(),
              [](int a, int b) { return std::to_string(a) < std::to_string(b); });
  }

  Seen cycle(uint32_t random, int now);

 private:
  struct State {
    bool active = false, leaves = false, enters = false;
    int since = 0;
  };
  void run(int action) {
    if (action < kVariables) return;
    if (nested_ && action == kActions - 1) {
      nested_->cycle(random_, now_);
      return;
    }
    uint32_t& order = outer_ != nullptr ? outer_->order_ : order_;
    order = order * 31 + static_cast<uint32_t>(action) + (outer_ != nullptr ? 100 : 0);
  }
  // The result: the action is active; it has its final scan.
  std::pair<bool, bool> control(int action, int now);
  bool fires(const Transition& t, uint32_t random, int now) const;
  void judge(uint32_t random, int now);

  const Chart& chart_;
  Evaluator* const outer_;
  std::unique_ptr<Evaluator> nested_;
  uint32_t random_ = 0;
  int now_ = 0;
  std::vector<State> steps_;
  std::vector<int> order_of_actions_;
  Control controls_[kActions];
  bool variables_[kVariables] = {};
  uint32_t order_ = 0;
};

std::pair<bool, bool> Evaluator::control(int action, int now) {
  bool has[kQualifiers] = {};
  for (size_t s = 0; s < steps_.size(); ++s)
    for (const Association& a : chart_.steps[s].associations)
      if (steps_[s].active && a.action == action) has[a.qualifier] = true;
  Control& c = controls_[action];
  const int time = chart_.times_ms[action];
  const auto since = [&](int& begin, bool on) {
    if (!on) begin = -1;
    if (on && begin < 0) begin = now;
  };
  since(c.limit_since, has[kL]);
  since(c.delay_since, has[kD]);
  since(c.ds_since, has[kDS] && !has[kR]);
  if (has[kS]) c.stored = true;
  if (has[kSD] && c.sd_since < 0) c.sd_since = now;
  if (c.ds_since >= 0 && now - c.ds_since >= time) c.delayed_stored = true;
  if (has[kSL] && !c.had_sl) c.sl_since = now;
  if (has[kR]) {
    c.stored = c.delayed_stored = false;
    c.sd_since = c.sl_since = -1;
  }
  bool lasting = has[kN] || c.stored || c.delayed_stored;
  lasting = lasting || (has[kL] && now - c.limit_since < time);
  lasting = lasting || (has[kD] && now - c.delay_since >= time);
  lasting = lasting || (c.sd_since >= 0 && now - c.sd_since >= time);
  lasting = lasting || (c.sl_since >= 0 && now - c.sl_since < time);
  lasting = lasting || (has[kP] && !c.had_p);
  bool pulse = (has[kP1] && !c.had_p1) || (c.had_p0 && !has[kP0]);
  if (has[kR]) lasting = pulse = false;
  c.had_p = has[kP];
  c.had_p1 = has[kP1];
  c.had_p0 = has[kP0];
  c.had_sl = has[kSL];
  const bool active = lasting || pulse;
  const bool last = chart_.final_scan && c.ran && !active;
  c.ran = lasting;
  return {active, last};
}

bool Evaluator::fires(const Transition& t, uint32_t random, int now) const {
  for (const int s : t.from) {
    const State& state = steps_[static_cast<size_t>(s)];
    if (!state.active || state.leaves || now - state.since < chart_.steps[static_cast<size_t>(s)].least_ms)
      return false;
  }
  return random / 65536 % t.modulus == t.value;
}

// Evaluates steps in their order; of a step's transitions the numbered ones first.
void Evaluator::judge(uint32_t random, int now) {
  for (size_t s = 0; s < steps_.size(); ++s) {
    std::vector<const Transition*> paths;
    for (const Transition& t : chart_.transitions)
      if (t.from[0] == static_cast<int>(s)) paths.push_back(&t);
    std::stable_sort(paths.begin(), paths.end(), [](const Transition* a, const Transition* b) {
      return (a->priority > 0 ? a->priority : 1000) < (b->priority > 0 ? b->priority : 1000);
    });
    for (const Transition* t : paths) {
      if (!fires(*t, random, now)) continue;
      for (const int from : t->from) steps_[static_cast<size_t>(from)].leaves = true;
      for (const int to : t->to) steps_[static_cast<size_t>(to)].enters = true;
      break;
    }
  }
}

Seen Evaluator::cycle(uint32_t random, int now) {
  random_ = random;
  now_ = now;
  for (size_t s = 0; s < steps_.size(); ++s) {
    if (!steps_[s].leaves) continue;
    steps_[s].active = false;
    run(chart_.steps[s].exit);
  }
  for (size_t s = 0; s < steps_.size(); ++s) {
    if (!steps_[s].enters) continue;
    steps_[s].active = true;
    steps_[s].since = now;
    run(chart_.steps[s].entry);
  }
  for (State& state : steps_) state.leaves = state.enters = false;
  for (size_t s = 0; s < steps_.size(); ++s)
    if (steps_[s].active) run(chart_.steps[s].active);
  std::vector<int> active;
  for (const int action : order_of_actions_) {
    const auto [is_active, is_last] = control(action, now);
    if (action < kVariables) variables_[action] = is_active;
    if (is_last) run(action);
    if (is_active) active.push_back(action);
  }
  for (const int action : active) run(action);
  judge(random, now);
  Seen seen{};
  for (const State& state : steps_) seen.active.push_back(state.active);
  std::copy(std::begin(variables_), std::end(variables_), std::begin(seen.variables));
  seen.order = order_;
  if (nested_) {
    for (const State& state : nested_->steps_) seen.nested_active.push_back(state.active);
    seen.nested_variables.assign(std::begin(nested_->variables_), std::end(nested_->variables_));
  }
  return seen;
}

}  // namespace

std::vector<Seen> evaluate(const Chart& chart, const std::vector<uint32_t>& randoms, int cycle_ms) {
  Evaluator evaluator(chart);
  std::vector<Seen> seen;
  for (size_t i = 0; i < randoms.size(); ++i)
    seen.push_back(evaluator.cycle(randoms[i], static_cast<int>(i) * cycle_ms));
  return seen;
}

}  // namespace rung::sfc_differential

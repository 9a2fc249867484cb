// SPDX-License-Identifier: Apache-2.0
// Charts by structure: nested sequences of steps, alternatives, loops and parallel branches, so each chart is safe;
// conditions, qualifiers and times by chance.
#include <random>

#include "tests/fuzz/sfc/chart.h"

namespace rung::sfc_differential {
namespace {

class Generator {
 public:
  explicit Generator(uint64_t seed) : random_(seed * 7919 + 17) {}
  Chart run(bool may_nest);

 private:
  int upTo(int n) { return static_cast<int>(random_() % static_cast<uint64_t>(n)); }  // 0 to n - 1
  bool chance(int percent) { return upTo(100) < percent; }
  int addStep();
  void connect(std::vector<int> from, std::vector<int> to);
  // Continues after `last`; returns the step at which the sequence ends. `region`: steps that a loop may jump to.
  int sequence(int last, int depth, std::vector<int>& region);

  std::mt19937_64 random_;
  Chart chart_;
};

int Generator::addStep() {
  Step step;
  for (int i = upTo(4); i > 0; --i) step.associations.push_back({upTo(kActions), upTo(kQualifiers)});
  const auto action = [&] { return chance(15) ? kVariables + upTo(kActions - kVariables) : -1; };
  step.entry = action();
  step.active = action();
  step.exit = action();
  if (chance(15)) step.least_ms = 10 * (1 + upTo(4));
  chart_.steps.push_back(step);
  return static_cast<int>(chart_.steps.size()) - 1;
}

void Generator::connect(std::vector<int> from, std::vector<int> to) {
  const auto modulus = static_cast<uint32_t>(1 + upTo(4));
  chart_.transitions.push_back(
      {std::move(from), std::move(to), modulus, static_cast<uint32_t>(upTo(static_cast<int>(modulus))), 0});
}

int Generator::sequence(int last, int depth, std::vector<int>& region) {
  for (int i = 1 + upTo(3); i > 0; --i) {
    if (chance(25) && region.size() > 1) {
      const int target = region[static_cast<size_t>(upTo(static_cast<int>(region.size())))];
      if (target != last) connect({last}, {target});
    }
    const int kind = depth > 0 ? upTo(4) : 0;
    if (kind == 1) {
      std::vector<int> ends;
      for (int k = 2 + upTo(2); k > 0; --k) {
        const int first = addStep();
        region.push_back(first);
        connect({last}, {first});
        ends.push_back(sequence(first, depth - 1, region));
      }
      last = addStep();
      for (const int end : ends) connect({end}, {last});
    } else if (kind == 2) {
      std::vector<int> firsts, ends;
      const int branches = 2 + upTo(2);
      for (int k = 0; k < branches; ++k) firsts.push_back(addStep());
      connect({last}, firsts);
      for (const int first : firsts) {
        std::vector<int> own{first};
        ends.push_back(sequence(first, depth - 1, own));
      }
      last = addStep();
      connect(ends, {last});
    } else if (kind == 3) {
      const size_t macro = chart_.macros.size();
      chart_.macros.push_back({static_cast<int>(chart_.steps.size()), 0, 0, 0});
      const int first = addStep();
      connect({last}, {first});
      region.push_back(first);
      last = sequence(first, depth - 1, region);
      chart_.macros[macro] = {first, static_cast<int>(chart_.steps.size()), first, last};
    } else {
      const int next = addStep();
      connect({last}, {next});
      last = next;
    }
    region.push_back(last);
  }
  return last;
}

Chart Generator::run(bool may_nest) {
  for (int& time : chart_.times_ms) time = 10 * upTo(7);
  chart_.final_scan = chance(50);
  const int first = addStep();
  std::vector<int> region{first};
  const int last = sequence(first, 3, region);
  connect({last}, {first});
  for (size_t s = 0; s < chart_.steps.size(); ++s) {
    if (!chance(40)) continue;
    int priority = 9;
    for (Transition& t : chart_.transitions)
      if (t.from[0] == static_cast<int>(s) && chance(70)) t.priority = priority--;
  }
  if (may_nest && chance(40)) {
    Generator inner(random_());
    chart_.nested.push_back(inner.run(false));
    chart_.nested[0].final_scan = chart_.final_scan;
  }
  return chart_;
}

// A connection may name the macro instead of its entry or exit; `key` decides.
std::string stepName(const Chart& chart, int step, bool to, size_t key) {
  for (size_t m = 0; m < chart.macros.size(); ++m)
    if ((to ? chart.macros[m].entry : chart.macros[m].exit) == step && (key + m) % 3 != 0)
      return "m" + std::to_string(m);
  return "s" + std::to_string(step);
}

// The nested chart has the same names for its steps and actions, and its own variables.
std::string bodyOf(const Chart& chart, bool nested) {
  static const char* const kKeywords[] = {"N", "R", "S", "L", "D", "P", "P0", "P1", "SD", "DS", "SL"};
  const char* const variable = nested ? "w" : "v";
  const auto action = [&](int i) { return (i < kVariables ? variable : "a") + std::to_string(i); };
  size_t key = 0;
  const auto list = [&](const std::vector<int>& steps, bool to) {
    std::string text;
    for (const int s : steps) text += (text.empty() ? "" : ", ") + stepName(chart, s, to, key++);
    return steps.size() == 1 ? text : "(" + text + ")";
  };
  std::string text;
  for (size_t s = 0; s < chart.steps.size(); ++s) {
    const Step& step = chart.steps[s];
    for (size_t m = 0; m < chart.macros.size(); ++m) {
      const Macro& macro = chart.macros[m];
      if (macro.begin != static_cast<int>(s)) continue;
      text += "MACRO_STEP m" + std::to_string(m);
      if (macro.exit != macro.end - 1) text += " (EXIT := s" + std::to_string(macro.exit) + ")";
      text += ":\n";
    }
    text += (s == 0 ? "INITIAL_STEP s" : "STEP s") + std::to_string(s);
    if (step.least_ms > 0) text += " (TMIN := T#" + std::to_string(step.least_ms) + "ms)";
    text += ":";
    for (const Association& a : step.associations) {
      text += " " + action(a.action) + "(" + kKeywords[a.qualifier];
      if (a.qualifier == kL || a.qualifier == kD || a.qualifier >= kSD)
        text += ", T#" + std::to_string(chart.times_ms[a.action]) + "ms";
      text += ");";
    }
    if (step.entry >= 0) text += " {entry} " + action(step.entry) + ";";
    if (step.active >= 0) text += " {active} " + action(step.active) + ";";
    if (step.exit >= 0) text += " {exit} " + action(step.exit) + ";";
    text += " END_STEP\n";
    for (const Macro& macro : chart.macros)
      if (macro.end == static_cast<int>(s) + 1) text += "END_MACRO_STEP\n";
  }
  for (const Transition& t : chart.transitions) {
    text += "TRANSITION ";
    if (t.priority > 0) text += "(PRIORITY := " + std::to_string(t.priority) + ") ";
    text += "FROM " + list(t.from, false) + " TO " + list(t.to, true) + " := random / 65536 MOD " +
            std::to_string(t.modulus) + " = " + std::to_string(t.value) + "; END_TRANSITION\n";
  }
  for (int i = kVariables; i < kActions; ++i) {
    const bool chart_in_it = i == kActions - 1 && !chart.nested.empty();
    text += "ACTION " + action(i) + ": ";
    text += chart_in_it ? "\n" + bodyOf(chart.nested[0], true)
                        : "order := order * 31 + " + std::to_string(i + (nested ? 100 : 0)) + ";";
    text += " END_ACTION\n";
  }
  return text;
}

}  // namespace

Chart generate(uint64_t seed) { return Generator(seed).run(true); }

std::string nestedStep(const Chart& chart, size_t step) {
  const std::string name = "s" + std::to_string(step);
  return step < chart.steps.size() ? "a" + std::to_string(kActions - 1) + "__" + name : name;
}

std::string textOf(const Chart& chart, const std::string& name) {
  std::string text = chart.final_scan ? "" : "{attribute 'no_final_scan'}\n";
  text += "FUNCTION_BLOCK " + name + "\nVAR_INPUT random : UDINT; END_VAR\nVAR_OUTPUT order : UDINT;";
  for (int i = 0; i < kVariables; ++i) {
    text += " v" + std::to_string(i) + " : BOOL := FALSE;";
    if (!chart.nested.empty()) text += " w" + std::to_string(i) + " : BOOL := FALSE;";
  }
  return text + " END_VAR\n" + bodyOf(chart, false) + "END_FUNCTION_BLOCK\n";
}

}  // namespace rung::sfc_differential

// SPDX-License-Identifier: Apache-2.0
// A chart as PLCopen XML. Where TC6 has several ways to draw something, one is chosen at random: alternatives with and
// without divergences, paths that meet in a step, in a convergence or by a jump, nested double lines, conditions in the
// transition, wired to it or named.
#include <random>

#include "tests/fuzz/sfc/chart.h"

namespace rung::sfc_differential {
namespace {

constexpr const char* kKeywords[] = {"N", "R", "S", "L", "D", "P", "P0", "P1", "SD", "DS", "SL"};

std::string actionName(int i) { return (i < kVariables ? "v" : "a") + std::to_string(i); }

class Printer {
 public:
  Printer(const Chart& chart, uint64_t seed) : chart_(chart), random_(seed * 104729 + 5) {}
  std::string print(const std::string& name);

 private:
  bool chance(int percent) { return random_() % 100 < static_cast<uint64_t>(percent); }
  int id() { return next_id_++; }
  static std::string wire(int from) { return "<connection refLocalId=\"" + std::to_string(from) + "\"/>"; }
  static std::string in(const std::string& wires) { return "<connectionPointIn>" + wires + "</connectionPointIn>"; }
  // Adds an element, returns its localId.
  int add(const std::string& kind, const std::string& content, int own = 0) {
    const int number = own != 0 ? own : id();
    elements_ += "<" + kind + " localId=\"" + std::to_string(number) + "\">" + content + "</" + kind + ">\n";
    return number;
  }
  int unite(std::vector<int> from);
  void split(int from, const std::vector<int>& to);
  std::string condition(const Transition& t);
  void addTransition(const Transition& t);
  void addStep(size_t s);
  std::string stepActions(const Step& step) const;

  const Chart& chart_;
  std::mt19937_64 random_;
  int next_id_ = 100000;
  std::string elements_, named_;
  std::vector<int> divergence_;                    // of each step, the divergence before its transitions; 0: none
  std::vector<std::string> wires_into_;            // for each step
  std::vector<std::vector<int>> converging_into_;  // for each step, by a convergence
};

// Draws one double line above all, or separate ones above some of them.
int Printer::unite(std::vector<int> from) {
  if (from.size() > 2 && chance(40)) {
    const std::vector<int> inner(from.begin(), from.begin() + 2);
    from.erase(from.begin());
    from[0] = unite(inner);
  }
  std::string content;
  for (const int node : from) content += in(wire(node));
  return add("simultaneousConvergence", content);
}

void Printer::split(int from, const std::vector<int>& to) {
  const int line = add("simultaneousDivergence", in(wire(from)));
  if (to.size() > 2 && chance(40)) {
    wires_into_[static_cast<size_t>(to[0])] += wire(line);
    split(line, {to.begin() + 1, to.end()});
    return;
  }
  for (const int step : to) wires_into_[static_cast<size_t>(step)] += wire(line);
}

std::string Printer::condition(const Transition& t) {
  const std::string modulus = std::to_string(t.modulus), value = std::to_string(t.value);
  const std::string is = "random / 65536 MOD " + modulus + " = " + value;
  const std::string is_not = "random / 65536 MOD " + modulus + " &lt;&gt; " + value;
  const bool negated = chance(20);
  const std::string& text = negated ? is_not : is;
  std::string out = negated ? "<condition negated=\"true\">" : "<condition>";
  switch (random_() % 4) {
    case 0: out += "<inline name=\"\"><ST>" + text + (chance(50) ? ";" : "") + "</ST></inline>"; break;
    case 1: out += in(wire(add("inVariable", "<expression>" + text + "</expression>"))); break;
    default: {
      const std::string name = "t" + std::to_string(id());
      const bool is_statement = chance(50);
      named_ += "<transition name=\"" + name + "\"><body><ST>" + (is_statement ? name + " := " + text + ";" : text) +
                "</ST></body></transition>\n";
      out += "<reference name=\"" + name + "\"/>";
    }
  }
  return out + "</condition>";
}

void Printer::addTransition(const Transition& t) {
  std::vector<int> from;
  for (const int step : t.from) from.push_back(step + 1);
  int before = from.size() > 1 ? unite(from) : divergence_[static_cast<size_t>(t.from[0])];
  if (before == 0) before = from[0];
  if (before >= 100000 && from.size() == 1 && chance(20)) before = add("selectionDivergence", in(wire(before)));
  const std::string condition_text = condition(t);
  const int own = add("transition", in(wire(before)) + condition_text);
  if (t.to.size() > 1) return split(own, t.to);
  const auto target = static_cast<size_t>(t.to[0]);
  switch (random_() % 3) {
    case 0: wires_into_[target] += wire(own); break;
    case 1: converging_into_[target].push_back(own); break;
    default:
      elements_ += "<jumpStep localId=\"" + std::to_string(id()) + "\" targetName=\"s" + std::to_string(target) +
                   "\">" + in(wire(own)) + "</jumpStep>\n";
  }
}

std::string Printer::stepActions(const Step& step) const {
  std::string out;
  const std::pair<const char*, int> own[] = {
      {"a6b08bd8-1", step.entry}, {"700a583f-2", step.active}, {"a2621e18-3", step.exit}};
  for (const auto& [guid, action] : own)
    if (action >= 0) out += "<attribute guid=\"" + std::string(guid) + "\">" + actionName(action) + "</attribute>";
  return "<addData><data name=\"http://www.3s-software.com/plcopenxml/sfc/element\"><attributes>" + out +
         "</attributes></data></addData>";
}

void Printer::addStep(size_t s) {
  const Step& step = chart_.steps[s];
  std::string wires = wires_into_[s];
  if (!converging_into_[s].empty()) {
    std::string content;
    for (const int from : converging_into_[s]) content += in(wire(from));
    wires += wire(add("selectionConvergence", content));
  }
  elements_ += "<step localId=\"" + std::to_string(s + 1) + "\" name=\"s" + std::to_string(s) + "\"" +
               (s == 0 ? " initialStep=\"true\"" : "") + ">" + in(wires) + stepActions(step) + "</step>\n";
  std::string block;
  const auto flush = [&] {
    if (!block.empty()) add("actionBlock", in(wire(static_cast<int>(s) + 1)) + block);
    block.clear();
  };
  for (const Association& a : step.associations) {
    block += "<action localId=\"0\" qualifier=\"" + std::string(kKeywords[a.qualifier]) + "\"";
    if (a.qualifier == kL || a.qualifier == kD || a.qualifier >= kSD)
      block += " duration=\"T#" + std::to_string(chart_.times_ms[a.action]) + "ms\"";
    block += "><reference name=\"" + actionName(a.action) + "\"/></action>";
    if (chance(30)) flush();
  }
  flush();
}

std::string Printer::print(const std::string& name) {
  divergence_.resize(chart_.steps.size());
  wires_into_.resize(chart_.steps.size());
  converging_into_.resize(chart_.steps.size());
  for (size_t s = 0; s < chart_.steps.size(); ++s)
    if (chance(50)) divergence_[s] = add("selectionDivergence", in(wire(static_cast<int>(s) + 1)));
  for (const Transition& t : chart_.transitions) addTransition(t);
  for (size_t s = 0; s < chart_.steps.size(); ++s) addStep(s);
  std::string out = "<pou name=\"" + name + "\" pouType=\"functionBlock\">\n<interface>\n<inputVars>" +
                    "<variable name=\"random\"><type><UDINT/></type></variable></inputVars>\n<outputVars>" +
                    "<variable name=\"order\"><type><UDINT/></type></variable>";
  for (int i = 0; i < kVariables; ++i)
    out += "<variable name=\"" + actionName(i) + "\"><type><BOOL/></type></variable>";
  out += "</outputVars>\n</interface>\n<actions>\n";
  for (int i = kVariables; i < kActions; ++i)
    out += "<action name=\"" + actionName(i) + "\"><body><ST>order := order * 31 + " + std::to_string(i) +
           ";</ST></body></action>\n";
  out += "</actions>\n<transitions>\n" + named_ + "</transitions>\n<body><SFC>\n" + elements_ + "</SFC></body>\n";
  if (!chart_.final_scan)
    out +=
        "<addData><data name=\"http://www.3s-software.com/plcopenxml/attributes\"><Attributes><Attribute "
        "Name=\"no_final_scan\" Value=\"\"/></Attributes></data></addData>\n";
  return out + "</pou>\n";
}

}  // namespace

Chart withoutTextForms(Chart chart) {
  for (Step& step : chart.steps) step.least_ms = 0;
  for (Transition& t : chart.transitions) t.priority = 0;
  chart.macros.clear();
  chart.nested.clear();
  return chart;
}

std::string xmlOf(const Chart& chart, const std::string& name, uint64_t seed) {
  return Printer(chart, seed).print(name);
}

}  // namespace rung::sfc_differential

// SPDX-License-Identifier: Apache-2.0
// A chart as a picture: steps with their action blocks, transitions with their conditions, and the lines between.
// IEC 61131-3 ed. 3, tables 54 to 57; TM/TP manual 5.5.
#include <algorithm>

#include "frontend/render/chart_plan.h"
#include "frontend/render/picture.h"
#include "frontend/syntax/inline_actions.h"
#include "frontend/syntax/sfc.h"
#include "frontend/syntax/st_printer.h"

namespace rung::picture {
namespace {

constexpr int32_t kRow = 20, kToActions = 20, kChartMargin = 20, kBar = 12;
constexpr size_t kConditionWidth = 48;

struct Action {
  std::string qualifier, indicator;
  std::vector<std::string> lines;  // its name, or its statements
  std::string name;

  int32_t height() const { return std::max(kRow, 5 + static_cast<int32_t>(lines.size()) * kLine); }
};
struct StepText {
  std::string name, times;
  std::vector<Action> actions;
  int32_t width, height;                                 // of its box
  int32_t qualifier_width, name_width, indicator_width;  // of the columns of its actions; indicators are optional
};

const char* defaultWord(SfcQualifier q) {
  switch (q) {
    case SfcQualifier::Entry: return "entry";
    case SfcQualifier::Active: return "active";
    case SfcQualifier::Exit: return "exit";
    case SfcQualifier::N:
    case SfcQualifier::R:
    case SfcQualifier::S:
    case SfcQualifier::L:
    case SfcQualifier::D:
    case SfcQualifier::P:
    case SfcQualifier::P0:
    case SfcQualifier::P1:
    case SfcQualifier::SD:
    case SfcQualifier::DS:
    case SfcQualifier::SL: return "N";
  }
  return "N";
}

class ChartLabels {
 public:
  ChartLabels(const Tree& tree, const Names& names, const PouDecl& pou, const PathOf* path_of = nullptr)
      : tree_(tree), names_(names), pou_(pou), path_of_(path_of), inline_actions_(tree, names, pou) {}
  StepText step(uint32_t index) const;
  std::vector<std::string> condition(uint32_t index) const;  // with the name, if it has one
  std::string priority(uint32_t index) const;
  std::string_view name(NameId id) const { return names_.string(id); }
  // Groups with what a monitor needs, where it is wanted: a step and its time, an action, a condition.
  void openStep(Svg& svg, uint32_t index) const;
  void openAction(Svg& svg, uint32_t step, uint32_t index, const std::string& name) const;
  void openTransition(Svg& svg, uint32_t index) const;
  void close(Svg& svg) const {
    if (path_of_ != nullptr) svg.close();
  }

 private:
  std::vector<std::string> linesOf(NameId action) const;
  std::string exprText(ExprId e) const { return e ? printSt(tree_, names_, e) : std::string(); }
  ExprId valueOf(const SfcTransition& t) const;

  const Tree& tree_;
  const Names& names_;
  const PouDecl& pou_;
  const PathOf* path_of_;
  InlineActions inline_actions_;
};

// The variables of steps and actions are those that sfc_schedule.h declares.
void ChartLabels::openStep(Svg& svg, uint32_t index) const {
  if (path_of_ == nullptr) return;
  const std::string own(name(tree_.list(pou_.steps)[index].name.name));
  svg.open(std::vector<Svg::Attribute>{{"id", stepId(index)},
                                       {"data-element", own},
                                       {"data-kind", "step"},
                                       {"data-path", "." + own + ".x"},
                                       {"data-time", "." + own + ".t"}});
}

void ChartLabels::openAction(Svg& svg, uint32_t step, uint32_t index, const std::string& own) const {
  if (path_of_ == nullptr) return;
  svg.open(std::vector<Svg::Attribute>{
      {"id", actionId(step, index)}, {"data-element", own}, {"data-kind", "action"}, {"data-path", "._" + own + ".x"}});
}

// A condition with a name is a BOOL of the chart.
void ChartLabels::openTransition(Svg& svg, uint32_t index) const {
  if (path_of_ == nullptr) return;
  const SfcTransition& transition = tree_.list(pou_.transitions)[index];
  const ExprId value = valueOf(transition);
  std::string path = value ? (*path_of_)(value) : std::string();
  if (path.empty() && transition.name.name) path = "." + std::string(name(transition.name.name));
  svg.open(std::vector<Svg::Attribute>{{"id", transitionId(index)},
                                       {"data-element", std::to_string(index + 1)},
                                       {"data-kind", "transition"},
                                       {"data-path", path}});
}

std::vector<std::string> ChartLabels::linesOf(NameId action) const {
  const PouDecl* own = inline_actions_.find(action);
  if (own == nullptr || own->body_kind != BodyKind::St) return {std::string(names_.string(action))};
  return picture::linesOf(printSt(tree_, names_, own->body, 0, {}));
}

StepText ChartLabels::step(uint32_t index) const {
  const SfcStep& s = tree_.list(pou_.steps)[index];
  StepText text{std::string(names_.string(s.name.name)), {}, {}, 0, 0, 0, 0, 0};
  if (s.min.value) text.times += "min " + exprText(s.min.value);
  if (s.max.value) text.times += (text.times.empty() ? "max " : ", max ") + exprText(s.max.value);
  for (const SfcAssociation& a : tree_.list(s.actions)) {
    Action action{std::string(a.word ? names_.string(a.word) : defaultWord(a.qualifier)),
                  {},
                  linesOf(a.action.name),
                  std::string(names_.string(a.action.name))};
    if (a.time.value) action.qualifier += " " + exprText(a.time.value);
    for (const Ident& indicator : tree_.list(a.indicators))
      action.indicator += (action.indicator.empty() ? "" : ", ") + std::string(names_.string(indicator.name));
    if (!action.indicator.empty())
      text.indicator_width = std::max(text.indicator_width, textWidth(action.indicator) + 12);
    text.qualifier_width = std::max(text.qualifier_width, textWidth(action.qualifier) + 12);
    for (const std::string& line : action.lines) text.name_width = std::max(text.name_width, textWidth(line) + 12);
    text.actions.push_back(std::move(action));
  }
  const int32_t width = std::max(textWidth(text.name), textWidth(text.times) * 3 / 4) + 24;
  text.width = std::max(roundUp((width + 1) / 2) * 2, 80);
  text.height = text.times.empty() ? 30 : 40;
  return text;
}

// The condition. It may also be a body with a single assignment.
ExprId ChartLabels::valueOf(const SfcTransition& t) const {
  if (t.condition.value || !t.body) return t.condition.value;
  const PouDecl& body = tree_.as<PouDecl>(t.body);
  if (body.body_kind != BodyKind::St || body.body.count != 1) return {};
  const StmtId only = tree_.list(body.body)[0];
  if (tree_.kind(only) != StmtKind::Assign) return {};
  const auto& assign = tree_.as<AssignStmt>(only);
  const bool own =
      tree_.kind(assign.target) == ExprKind::Name && names_.same(tree_.as<NameExpr>(assign.target).name, t.target.name);
  return own ? assign.value : ExprId{};
}

std::vector<std::string> ChartLabels::condition(uint32_t index) const {
  const SfcTransition& t = tree_.list(pou_.transitions)[index];
  const ExprId value = valueOf(t);
  std::vector<std::string> lines;
  if (t.name.name || !value) lines.emplace_back(names_.string(t.name.name ? t.name.name : t.target.name));
  if (!value) return lines;
  for (std::string& line : wrapped(exprText(value), kConditionWidth)) lines.push_back(std::move(line));
  return lines;
}

std::string ChartLabels::priority(uint32_t index) const {
  const SfcTransition& t = tree_.list(pou_.transitions)[index];
  return t.has_priority ? std::to_string(t.priority) : std::string();
}

void drawStep(Svg& svg, const ChartLabels& texts, const SfcStep& step, const ChartNode& node) {
  const StepText text = texts.step(node.index);
  const Point o = node.origin;
  texts.openStep(svg, node.index);
  const Rect box{o.x - text.width / 2, o.y, text.width, text.height};
  svg.rect(box, "w");
  if (step.initial) svg.rect({box.x + 4, box.y + 4, box.width - 8, box.height - 8});
  svg.text({o.x, o.y + (text.times.empty() ? 19 : 18)}, Anchor::Middle, text.name, "b");
  if (!text.times.empty()) svg.text({o.x, o.y + 31}, Anchor::Middle, text.times, "s");
  texts.close(svg);
  if (text.actions.empty()) return;
  const int32_t x = box.right() + kToActions, middle = x + text.qualifier_width;
  svg.line({box.right(), o.y + 15}, {x, o.y + 15});
  int32_t y = o.y + 5;
  for (uint32_t k = 0; k < text.actions.size(); ++k) {
    const Action& action = text.actions[k];
    const int32_t height = action.height();
    texts.openAction(svg, node.index, k, action.name);
    svg.rect({x, y, text.qualifier_width, height}, "w");
    svg.rect({middle, y, text.name_width, height}, "w");
    svg.text({x + text.qualifier_width / 2, y + 14}, Anchor::Middle, action.qualifier);
    svg.lines({middle + 6, y + 14 - kLine}, action.lines);
    if (text.indicator_width > 0) {
      svg.rect({middle + text.name_width, y, text.indicator_width, height}, "w");
      svg.text({middle + text.name_width + 6, y + 14}, Anchor::Start, action.indicator);
    }
    texts.close(svg);
    y += height;
  }
}

void drawTransition(Svg& svg, const ChartLabels& texts, const SfcTransition& t, const ChartNode& node) {
  const Point o = node.origin;
  texts.openTransition(svg, node.index);
  svg.line(o, {o.x, o.y + node.below});
  svg.line({o.x - kBar, o.y + 10}, {o.x + kBar, o.y + 10}, "t");
  svg.text({o.x - kBar - 4, o.y + 14}, Anchor::End, texts.priority(node.index), "s");
  int32_t y = o.y + 14;
  bool named = static_cast<bool>(t.name.name);
  for (const std::string& line : texts.condition(node.index)) {
    svg.text({o.x + kBar + 6, y}, Anchor::Start, line, named ? "b" : "");
    named = false;
    y += kLine;
  }
  texts.close(svg);
}

void drawJump(Svg& svg, const ChartLabels& texts, const ChartJump& jump) {
  const Point tip{jump.at.x, jump.at.y + 22};
  svg.line(jump.at, tip);
  const auto n = [](int32_t k) { return std::to_string(k); };
  svg.path("M" + n(tip.x - 5) + " " + n(tip.y - 7) + "L" + n(tip.x) + " " + n(tip.y) + "L" + n(tip.x + 5) + " " +
               n(tip.y - 7) + "Z",
           "d");
  svg.text({tip.x, tip.y + 13}, Anchor::Middle, texts.name(jump.step), "b");
}

}  // namespace

std::string stepId(uint32_t step) { return "step" + std::to_string(step + 1); }
std::string actionId(uint32_t step, uint32_t action) {
  return "action" + std::to_string(step + 1) + "." + std::to_string(action + 1);
}
std::string transitionId(uint32_t transition) { return "transition" + std::to_string(transition + 1); }

ChartPlan measureChart(const Tree& tree, const Names& names, const PouDecl& pou) {
  const ChartLabels texts(tree, names, pou);
  ChartPlan plan;
  for (uint32_t k = 0; k < pou.steps.count; ++k) {
    const StepText text = texts.step(k);
    ChartNode node{true, k, {-text.width / 2, 0, text.width, text.height}, text.height, {}};
    if (!text.actions.empty()) {
      node.area.width += kToActions + text.qualifier_width + text.name_width + text.indicator_width;
      int32_t below = 5;
      for (const Action& action : text.actions) below += action.height();
      node.area.height = std::max(text.height, below);
    }
    plan.nodes.push_back(node);
  }
  for (uint32_t k = 0; k < pou.transitions.count; ++k) {
    const SfcTransition& t = tree.list(pou.transitions)[k];
    if (t.from.empty() && t.to.empty()) continue;
    const std::vector<std::string> lines = texts.condition(k);
    int32_t width = 0;
    for (const std::string& line : lines) width = std::max(width, textWidth(line));
    const std::string priority = texts.priority(k);
    const int32_t left = kBar + (priority.empty() ? 0 : textWidth(priority) + 6);
    const int32_t height = std::max(20, 5 + static_cast<int32_t>(lines.size()) * kLine);
    plan.nodes.push_back({false, k, {-left, 0, left + kBar + 6 + width, height}, height, {}});
  }
  return plan;
}

std::string drawChart(const Tree& tree, const Names& names, const PouDecl& pou, std::string_view name,
                      const PathOf* path_of) {
  ChartPlan plan = measureChart(tree, names, pou);
  planChart(tree, names, pou, plan);
  const Point by{kChartMargin - plan.bounds.x, kChartMargin - plan.bounds.y};
  const ChartLabels texts(tree, names, pou, path_of);
  Svg svg;
  for (const ChartLine& line : plan.lines) {
    svg.line(line.from + by, line.to + by);
    if (line.doubled) svg.line(line.from + by + Point{0, kDouble}, line.to + by + Point{0, kDouble});
  }
  for (ChartNode& node : plan.nodes) {
    node.origin = node.origin + by;
    if (node.step)
      drawStep(svg, texts, tree.list(pou.steps)[node.index], node);
    else
      drawTransition(svg, texts, tree.list(pou.transitions)[node.index], node);
  }
  for (ChartJump jump : plan.jumps) {
    jump.at = jump.at + by;
    drawJump(svg, texts, jump);
  }
  return svg.finish(name, plan.bounds.width + 2 * kChartMargin, plan.bounds.height + 2 * kChartMargin);
}

}  // namespace rung::picture

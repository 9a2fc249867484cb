// SPDX-License-Identifier: Apache-2.0
// Pictures of charts: nothing overlaps, and every path of the chart is a line or a jump with the name of its step.
#include "frontend/render/chart_plan.h"
#include "frontend/render/picture.h"
#include "frontend/syntax/sfc.h"
#include "tests/unit/render/drawn.h"

namespace rung::picture {
namespace {

// `placed`: with positions, mostly from top to bottom, as an editor writes them.
std::string randomChart(uint32_t seed, bool placed) {
  Numbers random(seed);
  const auto at = [&](uint32_t row) {
    if (!placed) return std::string();
    return " AT " + std::to_string(random.below(5) * 100) + ", " + std::to_string(row * 40 + random.below(3) * 80) +
           ", 60, 30";
  };
  const uint32_t steps = 1 + random.below(9), transitions = random.below(14);
  std::string out = "PROGRAM p\nVAR go : BOOL; END_VAR\n";
  for (uint32_t k = 0; k < steps; ++k) {
    out += (k == 0 ? "INITIAL_STEP s" : "STEP s") + std::to_string(k) + at(2 * k) + ":";
    for (uint32_t n = random.below(4); n > 0; --n) out += " action_" + std::to_string(n) + "(D, T#2s);";
    out += " END_STEP\n";
  }
  const auto some = [&] {
    std::vector<uint32_t> chosen;
    for (uint32_t n = 1 + (random.below(4) == 0 ? random.below(3) : 0); n > 0; --n) {
      const uint32_t step = random.below(steps);
      if (std::find(chosen.begin(), chosen.end(), step) == chosen.end()) chosen.push_back(step);
    }
    std::string text;
    for (const uint32_t step : chosen) text += (text.empty() ? "s" : ", s") + std::to_string(step);
    return chosen.size() > 1 ? "(" + text + ")" : text;
  };
  for (uint32_t k = 0; k < transitions; ++k)
    out += "TRANSITION t" + std::to_string(k) + at(2 * k % (2 * steps) + 1) +
           (random.below(3) == 0 ? " (PRIORITY := 2)" : "") + " FROM " + some() + " TO " + some() +
           " := go AND NOT go OR go; END_TRANSITION\n";
  return out + "END_PROGRAM\n";
}

TEST(Chart, random_charts_are_readable) {
  for (uint32_t seed = 0; seed < 400; ++seed) {
    const std::string source = randomChart(seed % 200, seed >= 200);
    const Drawn drawn(source);
    const PouDecl& pou = *drawn.pou;
    ChartPlan plan = measureChart(drawn.tree, drawn.names, pou);
    planChart(drawn.tree, drawn.names, pou, plan);
    std::vector<Segment> lines;
    for (const ChartLine& line : plan.lines) {
      lines.push_back({line.from, line.to});
      if (line.doubled) lines.push_back({line.from, {line.from.x, line.from.y + kDouble}});
      if (line.doubled) lines.push_back({{line.from.x, line.from.y + kDouble}, {line.to.x, line.to.y + kDouble}});
    }
    std::vector<Rect> boxes;
    for (const ChartNode& node : plan.nodes) boxes.push_back(node.area.at(node.origin));
    for (const ChartJump& jump : plan.jumps) {
      const int32_t width = textWidth(drawn.names.string(jump.step));
      boxes.push_back({jump.at.x - width / 2, jump.at.y, width, kJumpHeight - 4});
    }
    for (size_t i = 0; i < boxes.size(); ++i) {
      for (size_t k = 0; k < i; ++k) EXPECT_FALSE(boxes[i].overlaps(boxes[k])) << source;
      if (i < plan.nodes.size()) {
        for (const Segment& line : lines) {
          const ChartNode& node = plan.nodes[i];
          const int32_t half = -node.area.x;  // its line leaves beside the actions, which may be higher than the step
          const Rect box{node.origin.x - half, node.origin.y, 2 * half, node.below};
          const Rect rest{box.right(), node.origin.y, node.area.width - 2 * half, node.area.height};
          EXPECT_FALSE(line.cuts(box) || line.cuts(rest)) << "a line through a node\n" << source;
        }
      }
    }
    // The successors of a node are connected to the lines below it.
    Connected all(lines);
    const auto leads = [&](const ChartNode& from, const ChartNode& to, NameId name) {
      const Point below{from.origin.x, from.origin.y + from.below};
      const size_t group = all.groupAt(below);
      if (below == to.origin) return true;
      if (group != all.none() && group == all.groupAt(to.origin)) return true;
      for (const ChartJump& jump : plan.jumps)
        if (drawn.names.same(jump.step, name) &&
            (jump.at == below || (group != all.none() && group == all.groupAt(jump.at))))
          return true;
      return false;
    };
    const auto steps = drawn.tree.list(pou.steps);
    const auto stepNode = [&](const Ident& name) -> const ChartNode& {
      for (size_t k = 0; k < steps.size(); ++k)
        if (drawn.names.same(steps[k].name.name, name.name)) return plan.nodes[k];
      return plan.nodes[0];
    };
    for (size_t k = steps.size(); k < plan.nodes.size(); ++k) {
      const SfcTransition& t = drawn.tree.list(pou.transitions)[plan.nodes[k].index];
      for (const Ident& from : drawn.tree.list(t.from))
        EXPECT_TRUE(leads(stepNode(from), plan.nodes[k], t.target.name)) << drawn.names.string(t.name.name) << "\n"
                                                                         << source;
      for (const Ident& to : drawn.tree.list(t.to))
        EXPECT_TRUE(leads(plan.nodes[k], stepNode(to), to.name)) << drawn.names.string(t.name.name) << "\n" << source;
    }
    const std::string svg = drawChart(drawn.tree, drawn.names, pou, "p");
    for (const SfcStep& step : steps)
      EXPECT_NE(std::string::npos, svg.find(">" + std::string(drawn.names.string(step.name.name)) + "<"));
    if (HasFailure()) return;
  }
}

TEST(Chart, branches_stand_side_by_side_and_meet_below) {
  const Drawn drawn(
      "PROGRAM p\nVAR a : BOOL; END_VAR\nINITIAL_STEP s0: END_STEP STEP s1: END_STEP STEP s2: END_STEP STEP s3: "
      "END_STEP\n"
      "TRANSITION FROM s0 TO (s1, s2) := a; END_TRANSITION\nTRANSITION FROM (s1, s2) TO s3 := a; END_TRANSITION\n"
      "TRANSITION FROM s3 TO s0 := a; END_TRANSITION\nEND_PROGRAM\n");
  ChartPlan plan = measureChart(drawn.tree, drawn.names, *drawn.pou);
  planChart(drawn.tree, drawn.names, *drawn.pou, plan);
  const auto& n = plan.nodes;
  EXPECT_EQ(n[1].origin.y, n[2].origin.y);
  EXPECT_LT(n[1].origin.x, n[2].origin.x);
  EXPECT_EQ(n[0].origin.x, n[4].origin.x);  // the transition below the step
  EXPECT_EQ(n[3].origin.x, n[5].origin.x);
  EXPECT_GT(n[3].origin.y, n[1].origin.y);
  EXPECT_EQ(2, std::count_if(plan.lines.begin(), plan.lines.end(), [](const ChartLine& line) { return line.doubled; }));
  ASSERT_EQ(1u, plan.jumps.size());
  EXPECT_EQ("s0", drawn.names.string(plan.jumps[0].step));
}

TEST(Chart, positions_of_the_file_are_taken) {
  const std::string actions = "a(N); a(N); a(N);";
  const auto source = [&](int32_t x_of_s2) {
    return "PROGRAM p\nVAR a : BOOL; END_VAR\nINITIAL_STEP s0 AT 200, 0, 60, 30: END_STEP\nSTEP s1 AT 100, 100, 60, "
           "30: " +
           actions + " END_STEP STEP s2 AT " + std::to_string(x_of_s2) +
           ", 300, 60, 30: END_STEP\n"
           "TRANSITION AT 120, 70, 20, 2 FROM s0 TO s1 := a; END_TRANSITION\n"
           "TRANSITION AT 320, 70, 20, 2 FROM s0 TO s2 := a; END_TRANSITION\n"
           "TRANSITION AT 120, 160, 20, 2 FROM s1 TO s2 := a; END_TRANSITION\n"
           "TRANSITION AT " +
           std::to_string(x_of_s2 + 20) + ", 350, 20, 2 FROM s2 TO s0 := a; END_TRANSITION\nEND_PROGRAM\n";
  };
  const Drawn drawn(source(300));
  ChartPlan plan = measureChart(drawn.tree, drawn.names, *drawn.pou);
  ASSERT_TRUE(takeChartPositions(drawn.tree, drawn.names, *drawn.pou, plan));
  const auto& n = plan.nodes;
  // Steps and transitions that form a column in the file keep it; s0 is right of s1 and left of s2.
  EXPECT_EQ(n[1].origin.x, n[3].origin.x);
  EXPECT_EQ(n[1].origin.x, n[5].origin.x);
  EXPECT_EQ(n[2].origin.x, n[4].origin.x);
  EXPECT_EQ(n[2].origin.x, n[6].origin.x);
  EXPECT_LT(n[1].origin.x, n[0].origin.x);
  EXPECT_LT(n[0].origin.x, n[2].origin.x);
  EXPECT_GT(n[5].origin.y, n[1].origin.y + n[1].area.height);  // three actions are higher than the file's step
  EXPECT_EQ(1u, plan.jumps.size());
  // s2 below s1's transition: the line from the other branch crosses nothing, and both meet.
  const Drawn moved(source(100));
  ChartPlan other = measureChart(moved.tree, moved.names, *moved.pou);
  ASSERT_TRUE(takeChartPositions(moved.tree, moved.names, *moved.pou, other));
  EXPECT_EQ(other.nodes[1].origin.x, other.nodes[2].origin.x);
}

TEST(Chart, a_chart_without_usable_positions_is_laid_out) {
  for (const char* places : {"", " AT 0, 0"}) {  // no positions; those that CODESYS writes
    const std::string at = places;
    const Drawn drawn("PROGRAM p\nVAR a : BOOL; END_VAR\nINITIAL_STEP s0" + at + ": END_STEP STEP s1" + at +
                      ": END_STEP\nTRANSITION" + at + " FROM s0 TO s1 := a; END_TRANSITION\nEND_PROGRAM\n");
    ChartPlan plan = measureChart(drawn.tree, drawn.names, *drawn.pou);
    EXPECT_FALSE(takeChartPositions(drawn.tree, drawn.names, *drawn.pou, plan));
    planChart(drawn.tree, drawn.names, *drawn.pou, plan);
    EXPECT_LT(plan.nodes[0].origin.y, plan.nodes[2].origin.y);
    EXPECT_LT(plan.nodes[2].origin.y, plan.nodes[1].origin.y);
  }
}

}  // namespace
}  // namespace rung::picture

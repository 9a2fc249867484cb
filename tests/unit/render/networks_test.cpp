// SPDX-License-Identifier: Apache-2.0
// Pictures of networks, for the drawings of many random programs: nothing overlaps, wires connect pin to pin and avoid
// elements, and every name can be read.
#include <map>
#include <set>
#include <tuple>

#include "frontend/render/network_plan.h"
#include "frontend/render/picture.h"
#include "tests/unit/render/drawn.h"

namespace rung::picture {
namespace {

// Elements that are wired to earlier ones, and now and then to a later one: a feedback loop.
std::string randomNetworks(uint32_t seed, const char* language, bool placed) {
  Numbers random(seed);
  std::string out = "PROGRAM p\n{network " + std::string(language) + "}\n";
  const bool ladder = std::string_view(language) == "LD";
  std::vector<uint32_t> bits, values;  // elements with an output
  const uint32_t count = 2 + random.below(24);
  if (ladder) {
    out += placed ? "rail 1 AT 0, 0, 3, 100;\n" : "rail 1;\n";
    bits.push_back(1);
  }
  const auto positionOf = [&](uint32_t k) {
    if (!placed) return std::string();
    return " AT " + std::to_string(20 + k * 37 % 400) + ", " + std::to_string(k * 53 % 300) + ", 21, 15";
  };
  const auto wires = [&](std::vector<uint32_t>& from, uint32_t most) {
    std::string text;
    for (uint32_t n = 1 + random.below(most); n > 0; --n)
      text += (text.empty() ? "" : " OR ") +
              std::to_string(
                  from[from.size() - 1 - random.below(std::min<uint32_t>(6, static_cast<uint32_t>(from.size())))]);
    return text;
  };
  for (uint32_t k = 2; k < count + 2; ++k) {
    const std::string n = std::to_string(k), at = positionOf(k);
    switch (random.below(ladder ? 8 : 5)) {
      case 0:
      case 1:
        out += "input " + n + " (value_" + n + ")" + at + ";\n";
        values.push_back(k);
        break;
      case 2:
      case 3: {
        if (values.empty()) continue;
        const bool enabled = !bits.empty() && random.below(3) == 0;
        out += "box " + n + (random.below(2) == 0 ? " ADD" : " Block (instance_" + n + ")") + at + " [" +
               (enabled ? "EN := " + wires(bits, 2) + ", " : "") + "IN1 NOT := " + wires(values, 1) +
               ", IN2 := " + (random.below(8) == 0 ? n : wires(values, 1)) + ", OUT =>, second_output =>];\n";
        values.push_back(k);
        break;
      }
      case 4:
        if (values.empty()) continue;
        out += "output " + n + " (result_" + n + ")" + at + " := " + wires(values, 1) + ";\n";
        break;
      case 5: out += "coil " + n + " (coil_" + n + ")" + at + " := " + wires(bits, 2) + ";\n"; break;
      default:
        out += "contact " + n + " (contact_" + n + ")" + at + " := " + wires(bits, 3) + ";\n";
        bits.push_back(k);
        break;
    }
  }
  return out + "{end_network}\nEND_PROGRAM\n";
}

void checkPlan(const Plan& plan, const std::string& source) {
  std::vector<Segment> others;
  for (size_t i = 0; i < plan.items.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      EXPECT_FALSE(plan.items[i].bounds().overlaps(plan.items[k].bounds())) << i << " and " << k << "\n" << source;
  for (const Net& net : plan.nets) {
    std::vector<Segment> lines;
    for (const std::vector<Point>& line : net.lines)
      for (size_t k = 1; k < line.size(); ++k) lines.push_back({line[k - 1], line[k]});
    for (const Segment& line : lines) {
      EXPECT_TRUE(line.a.x == line.b.x || line.a.y == line.b.y);
      for (const Item& item : plan.items)
        EXPECT_FALSE(line.cuts(item.bounds())) << "a wire through element " << item.element << "\n" << source;
    }
    std::vector<End> ends = net.sources;
    ends.insert(ends.end(), net.targets.begin(), net.targets.end());
    for (const End& end : ends)  // a rail connects the ends on it
      if (const int32_t length = plan.terminal(end).length; length > 0) {
        const Point p = plan.point(end);
        lines.push_back({p, {p.x, p.y + length}});
      }
    Connected all(lines);
    const size_t group = all.groupAt(plan.point(ends[0]));
    EXPECT_NE(all.none(), group);
    for (const End& end : ends) EXPECT_EQ(group, all.groupAt(plan.point(end))) << "a pin without its wire\n" << source;
  }
}

TEST(Networks, random_networks_are_readable) {
  for (const char* language : {"LD", "FBD", "CFC"}) {
    for (uint32_t seed = 0; seed < 30; ++seed) {
      for (const bool placed : {false, true}) {
        const std::string source = randomNetworks(seed, language, placed);
        const Drawn drawn(source);
        const Diagram& diagram = drawn.pou->diagram;
        for (const Plan& plan : planNetworks({drawn.tree, drawn.names, diagram, drawn.tree.list(diagram.elements)}))
          checkPlan(plan, source);
        const std::string svg = drawNetworks(drawn.tree, drawn.names, diagram, "p");
        for (const char* word : {"value_", "result_", "coil_", "contact_", "instance_"})
          for (size_t at = source.find(word); at != std::string::npos; at = source.find(word, at + 1)) {
            const std::string name = source.substr(at, source.find(')', at) - at);
            EXPECT_NE(std::string::npos, svg.find(">" + name + "<")) << name << "\n" << source;
          }
        EXPECT_EQ(svg, drawNetworks(drawn.tree, drawn.names, diagram, "p"));
        if (HasFailure()) return;
      }
    }
  }
}

// The position of the element with this number in the plan of one network.
Point originOf(const Drawn& drawn, const Plan& plan, uint64_t number) {
  for (const Item& item : plan.items)
    if (item.element != kNone && drawn.tree.list(drawn.pou->diagram.elements)[item.element].number == number)
      return item.origin;
  return {};
}
std::vector<Plan> plansOf(const Drawn& drawn) {
  return planNetworks({drawn.tree, drawn.names, drawn.pou->diagram, drawn.tree.list(drawn.pou->diagram.elements)});
}

TEST(Networks, a_rung_stands_in_one_row_and_its_branch_below) {
  const Drawn drawn(
      "PROGRAM p\n{network LD}\nrail 1; contact 2 (a) := 1; contact 3 (b) := 1; contact 4 (c) := 2 OR 3;\n"
      "coil 5 (d) := 4;\n{end_network}\nEND_PROGRAM\n");
  const Plan plan = plansOf(drawn)[0];
  const Point a = originOf(drawn, plan, 2), b = originOf(drawn, plan, 3), c = originOf(drawn, plan, 4),
              d = originOf(drawn, plan, 5);
  EXPECT_EQ(a.y, c.y);
  EXPECT_EQ(a.y, d.y);
  EXPECT_EQ(a.x, b.x);
  EXPECT_GT(b.y, a.y);
  EXPECT_LT(a.x, c.x);
  EXPECT_LT(c.x, d.x);
  // The OR is one net with one joint: a straight line, and one corner from b.
  for (const Net& net : plan.nets)
    if (net.sources.size() == 2) {
      ASSERT_EQ(2u, net.lines.size());
      EXPECT_EQ(2u, net.lines[0].size());
      EXPECT_EQ(3u, net.lines[1].size());
      EXPECT_EQ(1u, net.dots.size());
    }
}

TEST(Networks, positions_of_the_file_are_kept_and_moved_apart_only_where_names_need_it) {
  const std::string begin = "PROGRAM p\n{network FBD}\n", end = "{end_network}\nEND_PROGRAM\n";
  const Drawn wide(begin + "input 1 (a) AT 10, 40, 40, 20; output 2 (b) AT 300, 40, 40, 20 := 1;\n" + end);
  const Plan plan = plansOf(wide)[0];
  EXPECT_EQ(290, originOf(wide, plan, 2).x - originOf(wide, plan, 1).x);
  EXPECT_EQ(originOf(wide, plan, 2).y, originOf(wide, plan, 1).y);
  const Drawn narrow(
      begin + "input 1 (a_name_that_needs_more_room) AT 10, 40, 40, 20; output 2 (b) AT 60, 40, 40, 20 := 1;\n" + end);
  const Plan moved = plansOf(narrow)[0];
  EXPECT_GT(originOf(narrow, moved, 2).x - originOf(narrow, moved, 1).x, 50);
  // CODESYS writes 0, 0 everywhere.
  const Drawn zero(begin +
                   "input 1 (a) AT 0, 0; input 3 (c) AT 0, 0; box 2 ADD AT 0, 0 [IN1 := 1, IN2 := 3, OUT =>];\n" + end);
  const Plan laid_out = plansOf(zero)[0];
  EXPECT_LT(originOf(zero, laid_out, 1).x, originOf(zero, laid_out, 2).x);
  // Cells of a CFC editor are as high as a pin.
  const Drawn cells(
      "PROGRAM p\n{network CFC}\ninput 1 (a) AT 2, 3; input 2 (b) AT 2, 4;\n"
      "box 3 ADD AT 12, 2 [IN1 := 1, IN2 := 2, OUT =>];\n" +
      end);
  const Plan cell_plan = plansOf(cells)[0];
  EXPECT_EQ(20, originOf(cells, cell_plan, 2).y - originOf(cells, cell_plan, 1).y);
  for (const Net& net : cell_plan.nets) EXPECT_EQ(2u, net.lines[0].size()) << "straight into its pin";
}

TEST(Networks, a_joint_in_a_circle_and_a_wire_of_a_box_to_itself_end) {
  const Drawn drawn(
      "PROGRAM p\n{network CFC}\nconnector 1 := 2; connector 2 := 1;\n"
      "box 3 ADD [IN1 := 1, IN2 := 3(OUT), OUT =>];\n{end_network}\nEND_PROGRAM\n");
  EXPECT_EQ(1u, plansOf(drawn)[0].nets.size());
}

// Which pins are connected to which, by the file's elements, or by continuations with the same number.
using Wired = std::set<std::tuple<uint32_t, uint32_t, uint32_t, uint32_t>>;
Wired wiredIn(const Plan& plan) {
  std::map<uint32_t, std::vector<End>> into, out_of;  // by continuation
  for (const Net& net : plan.nets)
    for (const End& from : net.sources)
      for (const End& to : net.targets) {
        if (const uint32_t continuation = plan.items[to.item].continuation; continuation != 0)
          into[continuation].push_back(from);
        if (const uint32_t continuation = plan.items[from.item].continuation; continuation != 0)
          out_of[continuation].push_back(to);
      }
  Wired all;
  const auto add = [&](const End& from, const End& to) {
    all.insert({plan.items[from.item].element, from.terminal, plan.items[to.item].element, to.terminal});
  };
  for (const Net& net : plan.nets)
    for (const End& from : net.sources)
      for (const End& to : net.targets)
        if (plan.items[from.item].continuation == 0 && plan.items[to.item].continuation == 0) add(from, to);
  for (const auto& [continuation, sources] : into) {
    EXPECT_FALSE(out_of[continuation].empty()) << "nothing goes on at mark " << continuation;
    for (const End& from : sources)
      for (const End& to : out_of[continuation]) add(from, to);
  }
  for (const auto& [continuation, targets] : out_of)
    EXPECT_FALSE(into[continuation].empty()) << "nothing leads to mark " << continuation;
  return all;
}

TEST(Networks, a_narrow_page_keeps_every_element_and_every_wire) {
  for (const char* language : {"LD", "FBD", "CFC"}) {
    for (uint32_t seed = 0; seed < 15; ++seed) {
      for (const bool placed : {false, true}) {
        const std::string source = randomNetworks(seed, language, placed);
        const Drawn drawn(source);
        const Diagram& diagram = drawn.pou->diagram;
        const Body body{drawn.tree, drawn.names, diagram, drawn.tree.list(diagram.elements)};
        const Plan whole = planNetworks(body)[0], narrow = planNetworks(body, 500)[0];
        checkPlan(narrow, source);
        EXPECT_EQ(wiredIn(whole), wiredIn(narrow)) << source;
        size_t elements = 0;
        for (const Item& item : narrow.items) elements += item.element != kNone && item.terminals[0].length == 0;
        for (const Item& item : whole.items) elements -= item.element != kNone && item.terminals[0].length == 0;
        EXPECT_EQ(0u, elements) << source;
        EXPECT_TRUE(narrow.bounds.width <= whole.bounds.width || narrow.bounds.width <= 700) << source;
        if (HasFailure()) return;
      }
    }
  }
}

// `count` elements in a row, each wired to the previous one.
std::string row(uint32_t count, const char* language) {
  const bool ladder = std::string_view(language) == "LD";
  std::string out =
      "PROGRAM p\n{network " + std::string(language) + "}\n" + (ladder ? "rail 1;\n" : "input 1 (first);\n");
  for (uint32_t k = 2; k < count + 2; ++k) {
    const std::string n = std::to_string(k), before = std::to_string(k - 1);
    out += ladder ? "contact " + n + " (input_" + n + ") := " + before + ";\n"
                  : "box " + n + " ADD [IN1 := " + before + ", OUT =>];\n";
  }
  return out + (ladder ? "coil 1000 (last) := " : "output 1000 (last) := ") + std::to_string(count + 1) +
         ";\n{end_network}\nEND_PROGRAM\n";
}

TEST(Networks, a_rung_of_sixty_contacts_and_a_chain_of_forty_boxes_stay_on_the_page) {
  for (const bool ladder : {true, false}) {
    const std::string source = ladder ? row(60, "LD") : row(40, "FBD");
    const Drawn drawn(source);
    const Plan plan = planNetworks(
        {drawn.tree, drawn.names, drawn.pou->diagram, drawn.tree.list(drawn.pou->diagram.elements)}, 1000)[0];
    checkPlan(plan, source);
    EXPECT_LE(plan.bounds.width, 1000);
    // Each band begins below the one before it, and all wires are straight.
    std::set<int32_t> rows;
    for (const Net& net : plan.nets)
      for (const std::vector<Point>& line : net.lines) {
        EXPECT_EQ(2u, line.size());
        rows.insert(line[0].y);
      }
    uint32_t continuations = 0;
    for (const Item& item : plan.items) continuations = std::max(continuations, item.continuation);
    EXPECT_EQ(rows.size(), continuations + 1);
    EXPECT_GT(continuations, 2u);
    EXPECT_LT(continuations, 8u);
  }
}

TEST(Svg, text_is_escaped_and_what_xml_cannot_hold_becomes_a_question_mark) {
  Svg svg;
  svg.text({1, 2}, Anchor::Start, "a<b & c>d \x01 \xff \xc3\xa4");
  EXPECT_NE(std::string::npos, svg.finish("<t>", 10, 10).find(">a&lt;b &amp; c&gt;d ? ? \xc3\xa4</text>"));
  EXPECT_NE(std::string::npos, svg.finish("<t>", 10, 10).find("<title>&lt;t&gt;</title>"));
  EXPECT_EQ(2 * textWidth("ab"), textWidth("\xe6\xbc\xa2\xe5\xad\x97"));  // two characters, each two wide
}

}  // namespace
}  // namespace rung::picture

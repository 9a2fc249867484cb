// SPDX-License-Identifier: Apache-2.0
// What a monitor shows of a project: pictures whose elements and wires have the paths of their values, and lines with
// the paths of the variables in them. Every path of the samples that is a path leads to a variable.
#include "tools/driver/pou_views.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <vector>

#include "rung/monitor.h"
#include "tests/unit/tools/loaded_project.h"
#include "tests/unit/tools/temporary_folder.h"

namespace {

using rung::driver::Engine;
using rung::driver::Loaded;
using rung::driver::PouViews;

struct Views {
  explicit Views(const std::string& project)
      : loaded(project, Engine::Auto), views(PouViews::of(*loaded.compilation)) {}
  std::string of(const std::string& name) const {
    for (const rung_pou_view& view : views.rows())
      if (view.name == name) return view.content;
    ADD_FAILURE() << "no view of " << name;
    return {};
  }
  std::string list() const {
    std::string text;
    for (const rung_pou_view& view : views.rows())
      text += std::string(view.name) + ":" + view.block + ":" + view.language + " ";
    return text;
  }
  Loaded loaded;
  PouViews views;
};

// The tag whose attributes begin so.
std::string tag(const std::string& svg, const std::string& begin) {
  const size_t at = svg.find("<g " + begin);
  return at == std::string::npos ? "none" : svg.substr(at + 3, svg.find('>', at) - at - 3);
}

TEST(PouViews, APictureOfALadderHasThePathsOfItsValues) {
  const Views views("samples/motor_starter");
  EXPECT_EQ(views.list(), "MotorStarter:MotorStarter:LD ");
  const std::string svg = views.of("MotorStarter");
  EXPECT_EQ(tag(svg, "id=\"e2\""), "id=\"e2\" data-element=\"2\" data-kind=\"contact\" data-path=\".start_button\"");
  EXPECT_EQ(tag(svg, "id=\"e4\""),
            "id=\"e4\" data-element=\"4\" data-kind=\"contact\" data-path=\".stop_button\" data-negated=\"true\"");
  EXPECT_EQ(tag(svg, "id=\"e21\""),
            "id=\"e21\" data-element=\"21\" data-kind=\"coil\" data-path=\".fault_lamp\" data-storage=\"set\"");
  EXPECT_EQ(tag(svg, "id=\"e22\""),
            "id=\"e22\" data-element=\"22\" data-kind=\"contact\" data-path=\".reset_button\" data-edge=\"rising\"");
  // The value of a wire: that of a pin, of a coil at its end, or none: it follows from rail and contacts.
  EXPECT_NE(svg.find("data-from=\"11:Q\" data-to=\"13\" data-path=\".run_up.Q\""), std::string::npos);
  EXPECT_NE(svg.find("data-from=\"11:ET\" data-path=\".run_up.ET\""), std::string::npos) << "nothing reads it";
  EXPECT_NE(svg.find("data-from=\"12\" data-to=\"11:PT\" data-x"), std::string::npos) << "a literal";
  EXPECT_NE(svg.find("data-from=\"5\" data-to=\"6\" data-path=\".motor\""), std::string::npos);
  EXPECT_NE(svg.find("data-from=\"rail\" data-to=\"2 3\" data-x"), std::string::npos);
  EXPECT_NE(svg.find("data-from=\"20\" data-to=\"21\" data-x"), std::string::npos) << "a coil that only sets";
}

TEST(PouViews, LinesHaveThePathsOfTheirVariables) {
  const rung::TemporaryFolder folder;
  folder.write("ramp.st",
               "VAR_GLOBAL most : REAL := 4.0; END_VAR\n"
               "TYPE Pump : STRUCT on : BOOL; speeds : ARRAY[1..3] OF INT; END_STRUCT END_TYPE\n"
               "FUNCTION_BLOCK Ramp\n"
               "VAR_INPUT up : BOOL; END_VAR\n"
               "VAR pump : Pump; t : TON; i : INT; y : REAL; END_VAR\n"
               "VAR_TEMP k : INT; END_VAR\n"
               "IF up AND y < most THEN\n"
               "  y := y + 0.5; pump.on := TRUE; // \"half\"\n"
               "END_IF\n"
               "t(IN := up, PT := T#1s); k := 1;\n"
               "pump.speeds[2] := pump.speeds[i] + k;\n"
               "THIS^.i := 1 + LIMIT(1, i, 2);\n"
               "%QX0.1 := t.Q AND i.3;\n"
               "END_FUNCTION_BLOCK\n"
               "FUNCTION Half : REAL VAR_INPUT x : REAL; END_VAR Half := x / most; END_FUNCTION\n"
               "PROGRAM Main VAR r : Ramp; h : REAL; END_VAR r(); h := Half(2.0); END_PROGRAM\n");
  const Views views(folder.path());
  EXPECT_EQ(views.list(), "Half::ST Main:Main:ST Ramp:Ramp:ST ");
  const std::string text = views.of("Ramp");
  const auto paths = [&](int line) {
    const size_t at = text.find("\"line\": " + std::to_string(line) + ",");
    const size_t begin = text.find("\"paths\": [", at) + 10;
    return text.substr(begin, text.find("]}", begin) - begin);
  };
  EXPECT_EQ(paths(4), "\".up\"");
  EXPECT_EQ(paths(5), "\".i\", \".y\"");
  EXPECT_EQ(paths(6), "");
  EXPECT_EQ(paths(7), "\".up\", \".y\", \"most\"");
  EXPECT_EQ(paths(8), "\".y\", \".pump.on\"");
  EXPECT_EQ(paths(10), "\".up\"");
  EXPECT_EQ(paths(11), "\".pump.speeds[2]\", \".i\"");
  EXPECT_EQ(paths(12), "\".i\"");
  EXPECT_EQ(paths(13), "\"%QX0.1\", \".t.Q\", \".i.3\"");
  EXPECT_NE(text.find("\"text\": \"  y := y + 0.5; pump.on := TRUE; // \\\"half\\\"\""), std::string::npos);
  EXPECT_NE(views.of("Half").find("\"paths\": [\"most\"]"), std::string::npos);
}

TEST(PouViews, AChartHasThePathsOfItsSteps) {
  const Views views("samples/filling_station");
  const std::string svg = views.of("FillingStation");
  EXPECT_NE(svg.find("data-kind=\"step\" data-path=\".Fill.x\" data-time=\".Fill.t\""), std::string::npos);
  // A condition is a variable, or has a name.
  EXPECT_NE(svg.find("data-kind=\"transition\" data-path=\".bottle_here\""), std::string::npos);
  EXPECT_NE(svg.find("data-kind=\"transition\" data-path=\".TooLight\""), std::string::npos);
  EXPECT_NE(svg.find("data-kind=\"action\" data-path=\"._valve.x\""), std::string::npos);
}

// Names of NCT without a path: a bit of a word, which its address names, and a constant of the control.
bool isOnlyOfLadder(const std::string& text) { return std::regex_match(text, std::regex("[A-Z]\\w*\\.[0-9]+|N_ON")); }

// All of a view.
std::vector<std::string> pathsIn(const std::string& content) {
  std::vector<std::string> paths;
  const auto addAll = [&](const std::string& text, const std::regex& pattern) {
    for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) paths.push_back((*at)[1]);
  };
  addAll(content, std::regex("data-(?:path|time)=\"([^\"]*)\""));
  const std::string begin = "\"paths\": [";
  for (size_t at = content.find(begin); at != std::string::npos; at = content.find(begin, at + 1)) {
    const size_t first = at + begin.size();
    addAll(content.substr(first, content.find("]}", first) - first), std::regex("\"([^\"]*)\""));
  }
  return paths;
}

// Relative paths in an instance of their block; what a monitor may not find are actions that have no control block.
TEST(PouViews, PathsLeadToVariables) {
  for (const char* const project : {"samples/motor_starter", "samples/filling_station", "samples/cascade",
                                    "samples/conveyor", "samples/traffic_light", "samples/tank", "samples/boiler",
                                    "samples/milling_machine", "samples/packaging_line"}) {
    const Views views(project);
    const rung_module& module = *views.loaded.module;
    std::set<std::string> missing;
    size_t found = 0;
    for (const rung_pou_view& view : views.views.rows()) {
      std::string instance;
      for (uint32_t i = 0; i < module.symbols.count; ++i) {
        const rung_symbol& symbol = *rung_symbol_at(&module, i);
        if (symbol.is_program != 0 &&
            view.block == std::string(module.strings + rung_type_at(&module, symbol.type)->name))
          instance = module.strings + symbol.name;
      }
      if (instance.empty() && view.block[0] != 0) continue;  // an instance in another one
      for (const std::string& text : pathsIn(view.content)) {
        if (text.compare(0, 2, "._") == 0 || isOnlyOfLadder(text)) continue;
        rung_variable variable;
        const std::string whole = text[0] == '.' ? instance + text : text;
        rung_find(&module, whole.c_str(), &variable) ? void(++found) : void(missing.insert(whole));
      }
    }
    EXPECT_GT(found, 2u) << project;
    for (const std::string& path : missing) ADD_FAILURE() << project << ": " << path;
  }
}

}  // namespace

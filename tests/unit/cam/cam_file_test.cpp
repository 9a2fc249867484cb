// SPDX-License-Identifier: Apache-2.0
// Cams as files: what is read is what was written, and the curve of a cam is what the runtime computes from its table.
#include "frontend/import/cam/cam_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cam/design/text_form.h"

namespace rung::cam {
namespace {

struct ReadCam {
  Cam cam;
  std::vector<std::string> codes;
};

ReadCam read(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics{sources};
  ReadCam out;
  const bool is_read = importer::cams::readCam(sources, sources.add("x.cam", text), diagnostics, out.cam);
  for (const Diagnostic& diagnostic : diagnostics.all()) out.codes.push_back(diagInfo(diagnostic.diag).code);
  EXPECT_EQ(is_read, out.codes.empty()) << text;
  return out;
}

using Codes = std::vector<std::string>;

Cam withRows(Kind kind) {
  Cam cam;
  cam.name = "Knife";
  cam.kind = kind;
  cam.end = 3;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> some(-1, 1);
  switch (kind) {
    case Kind::QuinticPoints:
      for (int i = 0; i < 4; ++i) {
        cam.points.push_back({i + 0.1 * some(random) * (i % 3), some(random), some(random), 1e-17 * some(random)});
        cam.segments.push_back(i == 1 ? SegmentKind::Line : SegmentKind::Quintic);
      }
      break;
    case Kind::Polynomials: cam.polynomials = {{0, {0, 0.1, 0, 0, 0, 1e-300}}, {1, {0.1, 1, 2, 3, 4, 5}}}; break;
    case Kind::Equidistant: cam.numbers = {0, 32767, -32768, 17, 4}, cam.number = Number::Int; break;
    case Kind::Pairs:
      cam.numbers = {0, 1.5, 10, static_cast<double>(0.1f), 20, -3, 40, 7};
      cam.number = Number::Real;
      cam.scale = Scale{0, 40, 0, 3};
      break;
  }
  return cam;
}

constexpr Kind kKinds[] = {Kind::Polynomials, Kind::Equidistant, Kind::Pairs, Kind::QuinticPoints};

TEST(CamFile, ReadsWhatItWrote) {
  for (const Kind kind : kKinds) {
    Cam cam = withRows(kind);
    const ReadCam plain = read(textOf(cam));
    EXPECT_TRUE(plain.codes.empty()) << textOf(cam);
    EXPECT_TRUE(plain.cam == cam) << textOf(plain.cam);

    cam.repeat = Repeat::Modulo;
    cam.slave_period = std::fabs(curveOf(cam).at(cam.end, 0) - curveOf(cam).at(cam.start, 0));
    cam.master_unit = "°";
    cam.slave_unit = "µm/2";
    cam.limits = {.low = -1e6, .high = 1e6, .velocity = 0.1, .acceleration = 5e-324, .jerk = 1.7e308, .speed = 1.0 / 3};
    cam.capacity = 4000;
    cam.tappets = {{0.1, 512, TappetDirection::Backward, TappetAction::Pulse, 0, 4294967295},
                   {3, 0, TappetDirection::Both, TappetAction::Invert, 1, 0}};
    const ReadCam full = read(textOf(cam));
    EXPECT_TRUE(full.codes.empty()) << textOf(cam);
    EXPECT_TRUE(full.cam == cam) << textOf(full.cam);
  }
}

TEST(CamFile, LinesMayEndInAnyWayAndHaveCommentsAndTabs) {
  const ReadCam of = read("\xEF\xBB\xBF# first\r\ncam\tLift  # its name\r\n\r\n  point 0 0\r\npoint\t1 2 # last");
  EXPECT_EQ(of.codes, Codes());
  EXPECT_EQ(of.cam.name, "Lift");
  EXPECT_EQ(of.cam.points.size(), 2u);
  EXPECT_EQ(of.cam.end, 1);
}

TEST(CamFile, ReportsAllMistakesInOneRun) {
  EXPECT_EQ(read("cam x\npoint 0 0\npoint 2 0\npoint 1 inf\npoint 1 0\nfoo\ntappet 1 1 on delay 3\n").codes,
            (Codes{"E1296", "E1291", "E1312", "E1305"}));
  EXPECT_EQ(read("cam x\nrepeat closed\npoint 0 0\npoint 1 1e-3\n").codes, Codes{"E1308"});
  EXPECT_EQ(read("cam x\nrepeat modulo 0.5\npoint 0 1\npoint 1 2.5\n").codes, Codes());
  EXPECT_EQ(read("cam x\nrepeat relative\npoint 0 1\npoint 1 2.5\n").codes, Codes{"E1308"});
  EXPECT_EQ(read("").codes, Codes{"E1292"});
  EXPECT_EQ(read("cam").codes, Codes{"E1294"});
}

Table tableOf(const Cam& cam, std::vector<char>& bytes) {
  Table table{};
  table.count = static_cast<int32_t>(cam.rowCount());
  table.kind = cam.kind;
  table.number = cam.number;
  table.cubic = cam.cubic;
  table.start = cam.start;
  table.end = cam.end;
  if (cam.kind == Kind::QuinticPoints) table.points = cam.points.data(), table.segments = cam.segments.data();
  if (cam.kind == Kind::Polynomials) table.points = cam.polynomials.data();
  const auto put = [&](auto number) {
    bytes.insert(bytes.end(), reinterpret_cast<char*>(&number), reinterpret_cast<char*>(&number) + sizeof number);
  };
  for (const double number : cam.numbers) {
    if (cam.number == Number::Int) put(static_cast<int16_t>(number));
    if (cam.number == Number::Real) put(static_cast<float>(number));
  }
  if (!bytes.empty()) table.points = bytes.data();
  if (cam.scale) {
    table.scale = (cam.scale->master_max - cam.scale->master_min) / (cam.scale->table_max - cam.scale->table_min);
    table.shift = cam.scale->master_min - cam.scale->table_min * table.scale;
  }
  return table;
}

TEST(CamFile, CurveIsThatOfTheRuntime) {
  for (const Kind kind : kKinds)
    for (const bool cubic : {false, true}) {
      Cam cam = withRows(kind);
      cam.cubic = cubic;
      cam.start = 0.25;
      cam.end = kind == Kind::Equidistant ? 3 : 2.75;
      std::vector<char> bytes;
      const Table table = tableOf(cam, bytes);
      ASSERT_EQ(check(table), Fault::None);
      const Curve curve = curveOf(cam);
      EXPECT_EQ(curve.begin(), cam.start);
      EXPECT_EQ(curve.end(), cam.end);
      const double size = curve.extremes(0).peak().value, slope = curve.extremes(1).peak().value,
                   bend = curve.extremes(2).peak().value;
      int32_t segment = 0;
      for (int i = 0; i <= 1000; ++i) {
        const double x = cam.start + (cam.end - cam.start) * i / 1000;
        Value value{};
        ASSERT_TRUE(at(table, x, segment, value));
        EXPECT_NEAR(curve.at(x, 0), value.position, 1e-13 * std::fabs(size));
        EXPECT_NEAR(curve.at(x, 1), value.slope, 1e-12 * std::fabs(slope));
        EXPECT_NEAR(curve.at(x, 2), value.curvature, 1e-11 * std::fabs(bend) + 1e-12);
      }
    }
}

}  // namespace
}  // namespace rung::cam

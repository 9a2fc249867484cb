// SPDX-License-Identifier: Apache-2.0
// A cam as its designer sees it: the table that a program will have, and what is known besides: units, limits, whether
// it repeats. In: what a reader of a file or a fit fills in. Out: the same cam as a curve with exact derivatives.
// Called by the readers of frontend/import/cam, by the writers of this folder and by `rung cam`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cam/laws/curve.h"
#include "cam/table/table.h"

namespace rung::cam {

inline constexpr size_t kMostRows = 32767;     // MC_CAM_REF.nElements is an INT
inline constexpr int32_t kMostGroup = 512;     // MAX_NUM_TAPPETS
inline constexpr size_t kMostPulses = 32;      // tappets of a cam that switch by time
inline constexpr size_t kMostName = 80;        // MC_CAM_REF.strCAMName
inline constexpr size_t kLeastCapacity = 256;  // points that the array of a cam has room for, unless it says so

// The slave does this after the end of the cam.
enum class Repeat : uint8_t {
  Never,     // the cam ends
  Closed,    // back to the position of the begin, which is that of the end
  Modulo,    // the same, on a slave with a period
  Relative,  // each period begins where the last one ended
};

// The values of SMC_CAMTAPPETACTION.
enum class TappetAction : uint8_t { On = 0, Off = 1, Invert = 2, Pulse = 3 };
// The values of SMC_CAMTAPPETTYPE.
enum class TappetDirection : uint8_t { Forward = 0, Both = 1, Backward = 2 };

struct Tappet {
  double x = 0;
  int32_t group = 0;
  TappetDirection direction = TappetDirection::Both;
  TappetAction action = TappetAction::On;
  uint32_t delay = 0, duration = 0;  // µs
  bool operator==(const Tappet&) const = default;
};

// Of the slave's axis, in its units and seconds, at the master's `speed`.
struct Limits {
  std::optional<double> low, high;  // position
  std::optional<double> velocity, acceleration, jerk;
  std::optional<double> speed;  // of the master, in its units per second
  bool operator==(const Limits&) const = default;
};

// Numbers of Pairs from table_min to table_max are master positions from master_min to master_max.
struct Scale {
  double table_min = 0, table_max = 1, master_min = 0, master_max = 1;
  bool operator==(const Scale&) const = default;
};

struct Cam {
  std::string name;  // an identifier
  Repeat repeat = Repeat::Never;
  double slave_period = 0;  // of Modulo
  double start = 0, end = 0;
  std::string master_unit, slave_unit;  // or empty
  Limits limits;

  Kind kind = Kind::QuinticPoints;
  std::vector<Point> points;          // of QuinticPoints
  std::vector<SegmentKind> segments;  // of QuinticPoints: one for each point, after it; that of the last does not count
  std::vector<Polynomial> polynomials;
  std::vector<double> numbers;  // of Equidistant, and of Pairs: x, y, x, y, …
  Number number = Number::LReal;
  bool cubic = true;
  std::optional<Scale> scale;  // of Pairs
  size_t capacity = 0;         // rows that the array has room for; 0: not said

  std::vector<Tappet> tappets;

  size_t rowCount() const;
  size_t leastRows() const { return kind == Kind::Polynomials ? 1 : 2; }
  double masterAt(size_t row) const;
  bool hasLines() const;
  // The room of its array.
  size_t room() const;
};
bool operator==(const Cam& a, const Cam& b);

// The table from `start` to `end`. The rows are in order and at least two, or one of Polynomials.
Curve curveOf(const Cam& cam);

}  // namespace rung::cam

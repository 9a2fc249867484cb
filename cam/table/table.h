// SPDX-License-Identifier: Apache-2.0
// Cam tables: the position of a slave as a function of the position of its master. In: the points as a program declares
// them, which it may change at any time; out: position, slope and curvature at a master position. Called by the cam
// blocks (stdlib/motion/blocks/cam.cpp) in each cycle: no allocation, no exceptions, no state but the caller's Segment.
//
// A quintic segment is computed from the nearer of its points, so both points are met exactly and joints have no step.
#pragma once

#include <stdint.h>

namespace rung::cam {

// How a table is represented; the values of SMC_CAM_TYPE.
enum class Kind : uint8_t {
  Polynomials = 0,    // of degree 5, each from its master position to that of the next
  Equidistant = 1,    // slave positions
  Pairs = 2,          // master and slave positions
  QuinticPoints = 3,  // with slope and curvature
};

// Numbers of Equidistant and Pairs; the values of MC_CAM_REF.byVarType.
enum class Number : uint8_t { None = 0, Int = 1, UInt = 2, DInt = 3, UDInt = 4, Real = 5, LReal = 6 };

// The segment after a quintic point; the values of CamSegmentType.
enum class SegmentKind : int16_t { Line = 0, Quintic = 1 };

// SMC_CAMXYVA
struct Point {
  double x, y;
  double slope, curvature;  // dy/dx, d²y/dx²
};

// SMC_CAMElement: y = c[0] + c[1] (master - x) + … + c[5] (master - x)^5
struct Polynomial {
  double x;
  double c[6];
};

struct Table {
  const void* points;           // Polynomial, Point, or numbers
  const SegmentKind* segments;  // of QuinticPoints; null: all are quintic
  int32_t count;                // of points
  Kind kind;
  Number number;
  bool cubic;                   // between the points of Equidistant and Pairs, else linear
  double start, end;            // master
  double scale = 1, shift = 0;  // master = number * scale + shift, in Pairs
};

struct Value {
  double position, slope, curvature;
};

enum class Fault : uint8_t {
  None,
  NotACam,       // no points, or a kind or number that does not exist
  DoesNotCover,  // points out of order, not finite, too few, or start and end are not between the first and the last
};

// Looks at every point.
[[nodiscard]] Fault check(const Table& table);

// The value at a master position from `start` to `end`. `segment` is that of the call before, and is looked at first.
// False when the points around `x` have been changed so that they are out of order or not finite.
[[nodiscard]] bool at(const Table& table, double x, int32_t& segment, Value& value);

// A segment as a polynomial: y = c[0] + c[1] s + … + c[5] s^5, where s is 0 at `from` and 1 at `to`.
struct Segment {
  double from, to;
  double c[6];
};

int32_t segmentCount(const Table& table);
// False when its points are out of order or not finite.
[[nodiscard]] bool segmentOf(const Table& table, int32_t index, Segment& segment);

}  // namespace rung::cam

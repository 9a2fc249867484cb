// SPDX-License-Identifier: Apache-2.0
#include "cam/table/table.h"

#include "cam/table/quintic.h"

namespace rung::cam {

int32_t segmentCount(const Table& table) { return table.kind == Kind::Polynomials ? table.count : table.count - 1; }

namespace {

bool isFinite(double value) { return value - value == 0; }

double numberAt(const Table& table, int32_t index) {
  switch (table.number) {
    case Number::None: return 0;
    case Number::Int: return static_cast<const int16_t*>(table.points)[index];
    case Number::UInt: return static_cast<const uint16_t*>(table.points)[index];
    case Number::DInt: return static_cast<const int32_t*>(table.points)[index];
    case Number::UDInt: return static_cast<const uint32_t*>(table.points)[index];
    case Number::Real: return static_cast<double>(static_cast<const float*>(table.points)[index]);
    case Number::LReal: return static_cast<const double*>(table.points)[index];
  }
  return 0;
}

double masterAt(const Table& table, int32_t index) {
  switch (table.kind) {
    case Kind::Polynomials: return static_cast<const Polynomial*>(table.points)[index].x;
    case Kind::Equidistant:
      if (index == table.count - 1) return table.end;
      return table.start + (table.end - table.start) / (table.count - 1) * index;
    case Kind::Pairs: return numberAt(table, 2 * index) * table.scale + table.shift;
    case Kind::QuinticPoints: return static_cast<const Point*>(table.points)[index].x;
  }
  return 0;
}

double slaveAt(const Table& table, int32_t index) {
  return table.kind == Kind::Equidistant ? numberAt(table, index) : numberAt(table, 2 * index + 1);
}

// Where the segment ends; the last polynomial ends with the table.
double segmentEnd(const Table& table, int32_t segment) {
  return segment + 1 < table.count ? masterAt(table, segment + 1) : table.end;
}

bool holds(const Table& table, int32_t segment, double x) {
  return segment >= 0 && segment < segmentCount(table) && masterAt(table, segment) <= x &&
         x < segmentEnd(table, segment);
}

int32_t search(const Table& table, double x) {
  int32_t low = 0, high = segmentCount(table) - 1;
  while (low < high) {
    const int32_t middle = low + (high - low + 1) / 2;
    if (masterAt(table, middle) <= x)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

int32_t find(const Table& table, double x, int32_t segment) {
  if (holds(table, segment, x)) return segment;
  if (holds(table, segment + 1, x)) return segment + 1;
  if (holds(table, segment - 1, x)) return segment - 1;
  return search(table, x);
}

QuinticEnd endAt(const Point& point) { return {point.y, point.slope, point.curvature}; }

// `d` from `from`, on a segment of the length `h` to `to`.
Value quintic(const Point& from, const Point& to, double h, double d) {
  const double per_length = 1 / h, s = d * per_length;
  const Quintic curve = quinticOf(endAt(from), endAt(to), h);
  return {from.y + curve.way(s), from.slope + curve.slopeChange(s) * per_length,
          from.curvature + curve.curvatureChange(s) * per_length * per_length};
}

Value onQuintic(const Point& from, const Point& to, double x) {
  const double h = to.x - from.x, d = x - from.x, rest = to.x - x;
  if (d <= rest) return quintic(from, to, h, d);
  // Looked at from its end, where the master goes back.
  const Value mirrored = quintic({0, to.y, -to.slope, to.curvature}, {h, from.y, -from.slope, from.curvature}, h, rest);
  return {mirrored.position, -mirrored.slope, mirrored.curvature};
}

Value onLine(double x0, double y0, double x1, double y1, double x) {
  const double slope = (y1 - y0) / (x1 - x0);
  if (x - x0 <= x1 - x) return {y0 + slope * (x - x0), slope, 0};
  return {y1 - slope * (x1 - x), slope, 0};
}

// The slope of the parabola through a point and its neighbours; at the ends through the three points there.
double parabolaSlope(const Table& table, int32_t index) {
  if (table.count == 2) {
    const double way = slaveAt(table, 1) - slaveAt(table, 0);
    return way / (masterAt(table, 1) - masterAt(table, 0));
  }
  const int32_t middle = index == 0 ? 1 : index == table.count - 1 ? index - 1 : index;
  const double x0 = masterAt(table, middle - 1), x1 = masterAt(table, middle), x2 = masterAt(table, middle + 1);
  const double y1 = slaveAt(table, middle);
  const double before = (y1 - slaveAt(table, middle - 1)) / (x1 - x0);
  const double after = (slaveAt(table, middle + 1) - y1) / (x2 - x1);
  const double curvature = (after - before) / (x2 - x0);  // half of it
  const double x = masterAt(table, index);
  return before + curvature * (2 * x - x0 - x1);
}

Value cubic(double y0, double m0, double way, double m1, double h, double d) {
  const double s = d / h, c2 = 3 * way - (2 * m0 + m1) * h, c3 = (m0 + m1) * h - 2 * way;
  return {y0 + s * (m0 * h + s * (c2 + s * c3)), m0 + s * (2 * c2 + 3 * s * c3) / h, (2 * c2 + 6 * s * c3) / (h * h)};
}

Value onNumbers(const Table& table, int32_t segment, double x) {
  const double x0 = masterAt(table, segment), x1 = masterAt(table, segment + 1);
  const double y0 = slaveAt(table, segment), y1 = slaveAt(table, segment + 1);
  if (!table.cubic) return onLine(x0, y0, x1, y1, x);
  const double m0 = parabolaSlope(table, segment), m1 = parabolaSlope(table, segment + 1);
  if (x - x0 <= x1 - x) return cubic(y0, m0, y1 - y0, m1, x1 - x0, x - x0);
  const Value mirrored = cubic(y1, -m1, y0 - y1, -m0, x1 - x0, x1 - x);
  return {mirrored.position, -mirrored.slope, mirrored.curvature};
}

Value onPolynomial(const Polynomial& p, double x) {
  const double d = x - p.x;
  const double* c = p.c;
  return {c[0] + d * (c[1] + d * (c[2] + d * (c[3] + d * (c[4] + d * c[5])))),
          c[1] + d * (2 * c[2] + d * (3 * c[3] + d * (4 * c[4] + d * 5 * c[5]))),
          2 * c[2] + d * (6 * c[3] + d * (12 * c[4] + d * 20 * c[5]))};
}

bool isFinitePoint(const Table& table, int32_t index) {
  switch (table.kind) {
    case Kind::Polynomials: {
      for (const double c : static_cast<const Polynomial*>(table.points)[index].c)
        if (!isFinite(c)) return false;
      break;
    }
    case Kind::Equidistant:
    case Kind::Pairs:
      if (!isFinite(slaveAt(table, index))) return false;
      break;
    case Kind::QuinticPoints: {
      const Point& p = static_cast<const Point*>(table.points)[index];
      if (!isFinite(p.y) || !isFinite(p.slope) || !isFinite(p.curvature)) return false;
      break;
    }
  }
  return isFinite(masterAt(table, index));
}

bool isKind(const Table& table) {
  switch (table.kind) {
    case Kind::Polynomials:
    case Kind::QuinticPoints: return true;
    case Kind::Equidistant:
    case Kind::Pairs: return table.number >= Number::Int && table.number <= Number::LReal;
  }
  return false;
}

bool isLine(const Table& table, int32_t segment) {
  return table.segments != nullptr && table.segments[segment] == SegmentKind::Line;
}

void setSegment(const Table& table, int32_t index, Segment& segment) {
  const double h = segment.to - segment.from;
  switch (table.kind) {
    case Kind::Polynomials: {
      double power = 1;
      for (int i = 0; i < 6; ++i, power *= h)
        segment.c[i] = static_cast<const Polynomial*>(table.points)[index].c[i] * power;
      return;
    }
    case Kind::Equidistant:
    case Kind::Pairs: {
      const double y = slaveAt(table, index), way = slaveAt(table, index + 1) - y;
      segment.c[0] = y;
      segment.c[1] = way;
      if (!table.cubic) return;
      const double m0 = parabolaSlope(table, index) * h, m1 = parabolaSlope(table, index + 1) * h;
      segment.c[1] = m0;
      segment.c[2] = 3 * way - 2 * m0 - m1;
      segment.c[3] = m0 + m1 - 2 * way;
      return;
    }
    case Kind::QuinticPoints: {
      const Point* const points = static_cast<const Point*>(table.points);
      const Point &from = points[index], &to = points[index + 1];
      const Quintic q = quinticOf(endAt(from), endAt(to), h);
      segment = {from.x, to.x, {from.y, q.c1, q.c2, q.c3, q.c4, q.c5}};
      if (isLine(table, index)) segment = {from.x, to.x, {from.y, to.y - from.y}};
      return;
    }
  }
}

}  // namespace

bool segmentOf(const Table& table, int32_t index, Segment& segment) {
  segment = {masterAt(table, index), segmentEnd(table, index), {}};
  if (!(segment.from < segment.to)) return false;
  setSegment(table, index, segment);
  for (const double c : segment.c)
    if (!isFinite(c)) return false;
  return true;
}

Fault check(const Table& table) {
  if (table.points == nullptr || !isKind(table)) return Fault::NotACam;
  const bool is_range = isFinite(table.start) && isFinite(table.end) && table.start < table.end;
  if (segmentCount(table) < 1 || !is_range) return Fault::DoesNotCover;
  for (int32_t i = 0; i < table.count; ++i) {
    if (!isFinitePoint(table, i)) return Fault::DoesNotCover;
    if (i > 0 && !(masterAt(table, i - 1) < masterAt(table, i))) return Fault::DoesNotCover;
  }
  const double last = table.kind == Kind::Polynomials ? table.end : masterAt(table, table.count - 1);
  return masterAt(table, 0) <= table.start && table.end <= last ? Fault::None : Fault::DoesNotCover;
}

bool at(const Table& table, double x, int32_t& segment, Value& value) {
  if (table.kind == Kind::QuinticPoints) {
    const Point* const points = static_cast<const Point*>(table.points);
    const bool is_cached =
        segment >= 0 && segment < table.count - 1 && points[segment].x <= x && x < points[segment + 1].x;
    if (!is_cached) {
      segment = find(table, x, segment);
      // Points that the program has put out of order are seen where the master comes to them.
      if (segment > 0 && !(points[segment - 1].x < points[segment].x)) return false;
      if (segment + 2 < table.count && !(points[segment + 1].x < points[segment + 2].x)) return false;
    }
    const Point &from = points[segment], &to = points[segment + 1];
    if (!(from.x <= x && x <= to.x && from.x < to.x)) return false;
    value = isLine(table, segment) ? onLine(from.x, from.y, to.x, to.y, x) : onQuintic(from, to, x);
  } else {
    segment = find(table, x, segment);
    const double begin = masterAt(table, segment), end = segmentEnd(table, segment);
    if (!(begin <= x && x <= end && begin < end)) return false;
    value = table.kind == Kind::Polynomials ? onPolynomial(static_cast<const Polynomial*>(table.points)[segment], x)
                                            : onNumbers(table, segment, x);
  }
  return isFinite(value.position) && isFinite(value.slope) && isFinite(value.curvature);
}

}  // namespace rung::cam

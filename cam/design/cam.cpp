// SPDX-License-Identifier: Apache-2.0
// Cams and their curves; see cam.h.
#include "cam/design/cam.h"

#include <algorithm>

namespace rung::cam {
namespace {

bool areEqual(const Point& a, const Point& b) {
  return a.x == b.x && a.y == b.y && a.slope == b.slope && a.curvature == b.curvature;
}

bool areEqual(const Polynomial& a, const Polynomial& b) {
  return a.x == b.x && std::equal(std::begin(a.c), std::end(a.c), std::begin(b.c));
}

template <typename Row>
bool areEqual(const std::vector<Row>& a, const std::vector<Row>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Row& x, const Row& y) { return areEqual(x, y); });
}

Piece line(double x0, double y0, double x1, double y1) {
  const double left[] = {y0}, right[] = {y1};
  return hermite(x0, x1, left, right);
}

double slaveAt(const Cam& cam, size_t row) {
  return cam.kind == Kind::Equidistant ? cam.numbers[row] : cam.numbers[2 * row + 1];
}

// As the runtime does (cam/table/table.cpp): the slope of the parabola through a point and its neighbours.
double slopeAt(const Cam& cam, size_t row) {
  const size_t last = cam.rowCount() - 1;
  if (last == 1) return (slaveAt(cam, 1) - slaveAt(cam, 0)) / (cam.masterAt(1) - cam.masterAt(0));
  const size_t middle = std::clamp<size_t>(row, 1, last - 1);
  const double x0 = cam.masterAt(middle - 1), x1 = cam.masterAt(middle), x2 = cam.masterAt(middle + 1);
  const double before = (slaveAt(cam, middle) - slaveAt(cam, middle - 1)) / (x1 - x0);
  const double after = (slaveAt(cam, middle + 1) - slaveAt(cam, middle)) / (x2 - x1);
  return before + (after - before) / (x2 - x0) * (2 * cam.masterAt(row) - x0 - x1);
}

Piece pieceAfter(const Cam& cam, size_t row) {
  if (cam.kind == Kind::Polynomials) {
    const Polynomial& p = cam.polynomials[row];
    Piece piece{.from = p.x, .to = row + 1 < cam.rowCount() ? cam.polynomials[row + 1].x : cam.end, .origin = p.x};
    std::copy(std::begin(p.c), std::end(p.c), piece.coefficients.begin());
    return piece;
  }
  if (cam.kind == Kind::QuinticPoints) {
    const Point &from = cam.points[row], &to = cam.points[row + 1];
    if (cam.segments[row] == SegmentKind::Line) return line(from.x, from.y, to.x, to.y);
    const double left[] = {from.y, from.slope, from.curvature}, right[] = {to.y, to.slope, to.curvature};
    return hermite(from.x, to.x, left, right);
  }
  const double x0 = cam.masterAt(row), x1 = cam.masterAt(row + 1), y0 = slaveAt(cam, row), y1 = slaveAt(cam, row + 1);
  if (!cam.cubic) return line(x0, y0, x1, y1);
  const double left[] = {y0, slopeAt(cam, row)}, right[] = {y1, slopeAt(cam, row + 1)};
  return hermite(x0, x1, left, right);
}

}  // namespace

size_t Cam::rowCount() const {
  switch (kind) {
    case Kind::Polynomials: return polynomials.size();
    case Kind::Equidistant: return numbers.size();
    case Kind::Pairs: return numbers.size() / 2;
    case Kind::QuinticPoints: return points.size();
  }
  return 0;
}

double Cam::masterAt(size_t row) const {
  switch (kind) {
    case Kind::Polynomials: return polynomials[row].x;
    case Kind::Equidistant:
      if (row + 1 == numbers.size()) return end;
      return start + (end - start) / static_cast<double>(numbers.size() - 1) * static_cast<double>(row);
    case Kind::Pairs: {
      const double x = numbers[2 * row];
      if (!scale) return x;
      // The arithmetic of the runtime, bit for bit.
      const double factor = (scale->master_max - scale->master_min) / (scale->table_max - scale->table_min);
      return x * factor + (scale->master_min - scale->table_min * factor);
    }
    case Kind::QuinticPoints: return points[row].x;
  }
  return 0;
}

bool Cam::hasLines() const {
  const size_t count = segments.empty() ? 0 : segments.size() - 1;
  return std::count(segments.begin(), segments.begin() + static_cast<ptrdiff_t>(count), SegmentKind::Line) > 0;
}

size_t Cam::room() const { return capacity != 0 ? capacity : std::max(rowCount(), kLeastCapacity); }

bool operator==(const Cam& a, const Cam& b) {
  return a.name == b.name && a.repeat == b.repeat && a.slave_period == b.slave_period && a.start == b.start &&
         a.end == b.end && a.master_unit == b.master_unit && a.slave_unit == b.slave_unit && a.limits == b.limits &&
         a.kind == b.kind && areEqual(a.points, b.points) && a.segments == b.segments &&
         areEqual(a.polynomials, b.polynomials) && a.numbers == b.numbers && a.number == b.number &&
         a.cubic == b.cubic && a.scale == b.scale && a.capacity == b.capacity && a.tappets == b.tappets;
}

Curve curveOf(const Cam& cam) {
  const size_t count = cam.kind == Kind::Polynomials ? cam.rowCount() : cam.rowCount() - 1;
  Curve curve;
  for (size_t row = 0; row < count; ++row) {
    Piece piece = pieceAfter(cam, row);
    piece.from = std::max(piece.from, cam.start);
    piece.to = std::min(piece.to, cam.end);
    if (piece.from < piece.to) curve.add(piece);
  }
  return curve;
}

}  // namespace rung::cam

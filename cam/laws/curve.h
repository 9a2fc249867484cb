// SPDX-License-Identifier: Apache-2.0
// A curve y(x) in pieces, each a polynomial plus sines, with its exact derivatives and the extremes of each. In: pieces
// in ascending order without gaps. Called by laws.cpp, which builds curves, and by `rung cam`, which prints and draws
// them.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace rung::cam {

inline constexpr int kMostDegree = 11;

struct Sine {  // amplitude * sin(frequency * t + phase)
  double amplitude = 0, frequency = 0, phase = 0;
};

struct Piece {
  double from = 0, to = 1;
  double origin = 0;  // t = x - origin: an end of the curve that a piece is counted from is exact
  std::array<double, kMostDegree + 1> coefficients{};  // of t^0, t^1, ...
  std::array<Sine, 3> sines{};

  // The derivative of this order; 0: the value.
  double at(double x, int order) const;
};

struct Extreme {
  double x = 0, value = 0;
};
struct Extremes {
  Extreme low, high;
  const Extreme& peak() const;  // the larger one by magnitude; `low` or `high`, whichever comes first, if equal
};

class Curve {
 public:
  void add(const Piece& piece) { pieces_.push_back(piece); }

  double begin() const { return pieces_.front().from; }
  double end() const { return pieces_.back().to; }
  std::span<const Piece> pieces() const { return pieces_; }

  // At a joint: of the piece to the right.
  double at(double x, int order) const;
  // Of a derivative, both sides of each joint included.
  Extremes extremes(int order) const;
  // Of velocity times acceleration: the torque of a load without friction and weight.
  Extremes powerExtremes() const;
  // The largest step of a derivative at a joint.
  double largestStep(int order) const;

 private:
  std::vector<Piece> pieces_;
};

// The polynomial of the least degree over [from, to] with these derivatives (value, first, ...) at both ends.
Piece hermite(double from, double to, std::span<const double> left, std::span<const double> right);

}  // namespace rung::cam

// SPDX-License-Identifier: Apache-2.0
// The curve over given knots: see model.h. Limits are added one after the other where the curve exceeds them most, at
// exact extremes of its pieces, until it exceeds none (the exchange method of semi-infinite programming).
#include "cam/fit/model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace rung::cam {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kSmoothing = 1e-10;       // of the points' weight in a segment, on the square of the jerk
constexpr double kLimitTolerance = 2e-10;  // of the limit, or of the stroke for a position
constexpr int kMostExchanges = 300;

struct Polynomial5 {
  std::array<double, 6> c;  // of t from 0 to 1
};

double valueAt(const Polynomial5& p, double t, int order) {
  double value = 0;
  for (int k = 5; k >= order; --k) {
    double factor = p.c[static_cast<size_t>(k)];
    for (int i = 0; i < order; ++i) factor *= k - i;
    value = value * t + factor;
  }
  return value;
}

// All places in [0, 1] where the derivative of this order may be extreme: the ends, and the roots of the next one,
// which lie between those of the one after that.
std::vector<double> candidates(const Polynomial5& p, int order) {
  std::vector<double> roots;  // of order 5, then 4, … order + 1
  for (int of = 5; of > order; --of) {
    std::vector<double> ends = {0};
    ends.insert(ends.end(), roots.begin(), roots.end());
    ends.push_back(1);
    roots.clear();
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
      double low = ends[i], high = ends[i + 1];
      const double at_low = valueAt(p, low, of), at_high = valueAt(p, high, of);
      if (at_low * at_high >= 0) continue;
      for (int step = 0; step < 60 && high - low > 1e-15; ++step) {
        const double middle = (low + high) / 2;
        (valueAt(p, middle, of) * at_low > 0 ? low : high) = middle;
      }
      roots.push_back((low + high) / 2);
    }
  }
  roots.insert(roots.begin(), 0);
  roots.push_back(1);
  return roots;
}

}  // namespace

// A limit of a derivative: value <= most, or value >= most with the sign turned.
struct Model::Bound {
  LimitKind kind;
  int order;
  double sign, most;  // in units of the system
};

struct Model::Constraint {
  LimitKind kind;
  bool is_jerk_joint;  // of C3
  double x;
};

// A limit that the curve exceeds.
struct Model::Violation {
  const Bound* bound;
  size_t segment;
  double t, by;
};

const char* nameOf(LimitKind kind) {
  switch (kind) {
    case LimitKind::Low: return "the lowest position";
    case LimitKind::High: return "the highest position";
    case LimitKind::Velocity: return "the velocity limit";
    case LimitKind::Acceleration: return "the acceleration limit";
    case LimitKind::Jerk: return "the jerk limit";
  }
  return "";
}

std::string shortText(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.6g", value == 0 ? 0.0 : value);
  return text;
}

Model::Model(const FitRequest& request, double stroke) : request_(request), stroke_(stroke) {
  for (const Sample& sample : request.samples) {
    weights_.push_back(sample.weight);
    total_weight_ += sample.weight;
  }
}

double Model::smoothing(const KnotSystem& system) const {
  return kSmoothing * total_weight_ / static_cast<double>(system.segments());
}

MatrixXd Model::matrix(const KnotSystem& system, VectorXd& g) const {
  const int n = system.unknowns();
  MatrixXd G = MatrixXd::Zero(n, n);
  g = VectorXd::Zero(n);
  const auto add = [&](const BasisRow& row, double y, double weight) {
    double constant = -y;
    for (size_t f = 0; f < 6; ++f) constant += row.factors[f] * system.at(row, f).offset;
    for (size_t f = 0; f < 6; ++f) {
      const int i = system.at(row, f).index;
      if (i < 0) continue;
      const double weighted = weight * row.factors[f];
      g[i] += weighted * constant;
      for (size_t k = 0; k < 6; ++k)
        if (const int j = system.at(row, k).index; j >= 0) G(i, j) += weighted * row.factors[k];
    }
  };
  for (size_t i = 0; i < request_.samples.size(); ++i) {
    const Sample& sample = request_.samples[i];
    const size_t segment = system.segmentAt(sample.x);
    add(system.row(segment, system.parameter(segment, sample.x), 0), sample.y / stroke_, weights_[i]);
  }
  // The integral of the square of the jerk, a polynomial of degree 4, by Gauss' rule of three points.
  const double inner = std::sqrt(0.6) / 2;
  for (size_t segment = 0; segment < system.segments(); ++segment) {
    const double weight = smoothing(system) * system.length(segment) / 18;
    add(system.row(segment, 0.5 - inner, 3), 0, 5 * weight);
    add(system.row(segment, 0.5, 3), 0, 8 * weight);
    add(system.row(segment, 0.5 + inner, 3), 0, 5 * weight);
  }
  return G;
}

// Continuous jerk, of a cam that repeats also at its ends.
bool Model::addJoints(const KnotSystem& system, QuadraticProgram& program, std::vector<Constraint>& constraints) const {
  if (request_.smoothness == Smoothness::C2) return true;
  const size_t count = system.segments();
  for (size_t left = 0; left < count; ++left) {
    if (left + 1 == count && request_.repeat == Repeat::Never) continue;
    const size_t right = (left + 1) % count;
    VectorXd normal = VectorXd::Zero(system.unknowns());
    double constant = 0;
    for (const bool is_left : {true, false}) {
      const BasisRow row = is_left ? system.row(left, 1, 3) : system.row(right, 0, 3);
      for (size_t f = 0; f < 6; ++f) {
        const double factor = is_left ? row.factors[f] : -row.factors[f];
        const Unknown& unknown = system.at(row, f);
        constant += factor * unknown.offset;
        if (unknown.index >= 0) normal[unknown.index] += factor;
      }
    }
    if (normal.isZero(1e-12)) continue;
    const double size = normal.norm();
    constraints.push_back({LimitKind::Jerk, true, system.knots()[left + 1]});
    if (!program.addEqual(normal / size, -constant / size, static_cast<int>(constraints.size()) - 1)) return false;
  }
  return true;
}

// The polynomial of a segment.
Polynomial5 pieceOf(const Solution& solution, size_t segment) {
  const auto basis = basisOf(solution.system.length(segment));
  Polynomial5 p{};
  for (size_t f = 0; f < 6; ++f) {
    const Unknown& unknown = solution.system.at(BasisRow{segment, {}}, f);
    const double value = unknown.offset + (unknown.index < 0 ? 0 : solution.z[unknown.index]);
    for (size_t k = 0; k < 6; ++k) p.c[k] += value * basis[f][k];
  }
  return p;
}

double Model::errorOf(const Solution& solution, const Sample& sample) const {
  const size_t segment = solution.system.segmentAt(sample.x);
  const BasisRow row = solution.system.row(segment, solution.system.parameter(segment, sample.x), 0);
  double value = -sample.y / stroke_;
  for (size_t f = 0; f < 6; ++f) {
    const Unknown& unknown = solution.system.at(row, f);
    value += row.factors[f] * (unknown.offset + (unknown.index < 0 ? 0 : solution.z[unknown.index]));
  }
  return value;
}

void Model::measure(Solution& solution) const {
  solution.squares = solution.largest = 0;
  double count = 0, weight = 0;
  for (size_t i = 0; i < request_.samples.size(); ++i) {
    if (!counts(i)) continue;
    const double error = errorOf(solution, request_.samples[i]);
    solution.squares += weights_[i] * error * error;
    solution.largest = std::max(solution.largest, std::fabs(error));
    weight += weights_[i];
    ++count;
  }
  const double joints = request_.smoothness == Smoothness::C3 ? static_cast<double>(solution.system.segments()) - 1 : 0;
  const double mean = solution.squares / weight + kFitRounding * kFitRounding;
  solution.criterion = count * std::log(mean) + std::log(count) * (solution.system.unknowns() - joints);
}

Model::Outcome Model::solve(std::vector<double> knots, Solution& solution, std::string& error) const {
  error = solution.system.build(request_, std::move(knots), stroke_);
  if (!error.empty()) return Outcome::Impossible;
  if (solution.system.unknowns() == 0) {
    solution.z = VectorXd();
    return measure(solution), Outcome::Solved;
  }
  VectorXd g;
  const MatrixXd G = matrix(solution.system, g);
  if (request_.smoothness == Smoothness::C2) {
    solution.z = -G.llt().solve(g);
  } else {
    QuadraticProgram program;
    std::vector<Constraint> constraints;
    if (!program.start(G, g) || !addJoints(solution.system, program, constraints)) {
      error = "no curve of " + std::to_string(solution.system.segments()) +
              " segments with a continuous jerk meets all wishes; allow more segments, or steps of the jerk";
      return Outcome::NeedsSegments;
    }
    solution.z = program.x();
  }
  if (!solution.z.allFinite()) {
    error = "the points do not determine a curve";
    return Outcome::Impossible;
  }
  measure(solution);
  return Outcome::Solved;
}

// Of each segment: the weighted squares of its errors, or the largest.
std::vector<double> Model::errorsOf(const Solution& solution, bool squares) const {
  std::vector<double> errors(solution.system.segments(), 0);
  for (size_t i = 0; i < request_.samples.size(); ++i) {
    if (!counts(i)) continue;
    const Sample& sample = request_.samples[i];
    const double error = errorOf(solution, sample);
    double& of = errors[solution.system.segmentAt(sample.x)];
    of = squares ? of + weights_[i] * error * error : std::max(of, std::fabs(error));
  }
  return errors;
}

std::vector<Model::Bound> Model::bounds(const KnotSystem& system) const {
  const Limits& limits = request_.limits;
  const double speed = limits.speed.value_or(1);
  std::vector<Bound> all;
  if (limits.low) all.push_back({LimitKind::Low, 0, -1, -*limits.low / stroke_});
  if (limits.high) all.push_back({LimitKind::High, 0, 1, *limits.high / stroke_});
  const auto both = [&](const std::optional<double>& limit, LimitKind kind, int order) {
    if (!limit) return;
    const double most = system.scaled(*limit / std::pow(speed, order), order);
    all.push_back({kind, order, 1, most});
    all.push_back({kind, order, -1, most});
  };
  both(limits.velocity, LimitKind::Velocity, 1);
  both(limits.acceleration, LimitKind::Acceleration, 2);
  both(limits.jerk, LimitKind::Jerk, 3);
  return all;
}

bool Model::hasLimits(const KnotSystem& system) const { return !bounds(system).empty(); }

// The worst for each segment and limit, the largest part of its limit first.
std::vector<Model::Violation> Model::violationsOf(const Solution& best, const std::vector<Bound>& all) const {
  const KnotSystem& system = best.system;
  std::vector<Violation> violations;
  for (size_t segment = 0; segment < system.segments(); ++segment) {
    const Polynomial5 piece = pieceOf(best, segment);
    const double h = system.length(segment);
    int order = -1;
    std::vector<double> places;
    for (const Bound& bound : all) {
      if (bound.order != order) places = candidates(piece, order = bound.order);
      const double tolerance = kLimitTolerance * (order == 0 ? 1 : bound.most), unit = std::pow(h, -order);
      Violation worst{&bound, segment, 0, tolerance};
      for (const double t : places) {
        const double by = bound.sign * valueAt(piece, t, order) * unit - bound.most;
        if (by > worst.by) worst = {&bound, segment, t, by};
      }
      if (worst.by > tolerance) violations.push_back(worst);
    }
  }
  std::stable_sort(violations.begin(), violations.end(), [](const Violation& a, const Violation& b) {
    return a.by / std::fabs(a.bound->most + 1e-300) > b.by / std::fabs(b.bound->most + 1e-300);
  });
  return violations;
}

// Adds the limit where it is exceeded. False: it contradicts the constraints before it.
bool Model::addLimit(const KnotSystem& system, const Violation& violation, QuadraticProgram& program,
                     std::vector<Constraint>& constraints) {
  const Bound& bound = *violation.bound;
  const BasisRow row = system.row(violation.segment, violation.t, bound.order);
  VectorXd normal = VectorXd::Zero(system.unknowns());
  double constant = 0;
  for (size_t f = 0; f < 6; ++f) {
    const Unknown& unknown = system.at(row, f);
    constant += row.factors[f] * unknown.offset;
    if (unknown.index >= 0) normal[unknown.index] -= bound.sign * row.factors[f];
  }
  const double x = system.knots()[violation.segment] +
                   violation.t * (system.knots()[violation.segment + 1] - system.knots()[violation.segment]);
  constraints.push_back({bound.kind, false, x});
  const double size = normal.norm(), least = bound.sign * constant - bound.most;
  return size > 1e-14 && program.addAtLeast(normal / size, least / size, static_cast<int>(constraints.size()) - 1);
}

// The limit that was added last, and those that it contradicts.
std::string Model::contradiction(const QuadraticProgram& program, const std::vector<Constraint>& constraints) {
  const Constraint& last = constraints.back();
  std::string others;
  int count = 0;
  for (const int label : program.conflict()) {
    const Constraint& other = constraints[static_cast<size_t>(label)];
    if (other.is_jerk_joint || ++count > 4) continue;
    others += (others.empty() ? "" : ", ") + std::string(nameOf(other.kind)) + " at " + shortText(other.x);
  }
  return std::string(nameOf(last.kind)) + " at " + shortText(last.x) + " contradicts " +
         (others.empty() ? "the exact points, dwells and ends around it" : others);
}

bool Model::constrain(Solution& best, std::string& why, int& iterations) const {
  const KnotSystem& system = best.system;
  const std::vector<Bound> all = bounds(system);
  QuadraticProgram program;
  std::vector<Constraint> constraints;
  if (system.unknowns() > 0) {
    VectorXd g;
    const MatrixXd G = matrix(system, g);
    if (!program.start(G, g) || !addJoints(system, program, constraints))
      return why = "its jerk cannot be continuous", false;
    best.z = program.x();
  }
  for (int exchange = 0; exchange < kMostExchanges; ++exchange) {
    const std::vector<Violation> violations = violationsOf(best, all);
    if (violations.empty()) {
      iterations += program.iterations();
      return true;
    }
    for (const Violation& violation : violations) {
      if (addLimit(system, violation, program, constraints)) continue;
      why = contradiction(program, constraints);
      iterations += program.iterations();
      return false;
    }
    best.z = program.x();
  }
  why = "the limits are not met after " + std::to_string(kMostExchanges) + " exchanges";
  return false;
}

}  // namespace rung::cam

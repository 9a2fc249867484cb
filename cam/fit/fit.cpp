// SPDX-License-Identifier: Apache-2.0
// The fit of cams; see fit.h. Knots are chosen without limits, by the Bayesian information criterion or the tolerance;
// then the limits are added one after the other where the curve exceeds them most, at exact extremes of its pieces,
// until it exceeds none (the exchange method of semi-infinite programming).
#include "cam/fit/fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cam/design/peaks.h"
#include "cam/design/text_form.h"
#include "cam/fit/knots.h"
#include "cam/fit/quadratic_program.h"
#include "cam/fit/robust.h"

namespace rung::cam {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSmoothing = 1e-10;       // of the points' weight in a segment, on the square of the jerk
constexpr double kRounding = 1e-10;        // of the stroke: a smaller error is not noise
constexpr double kLimitTolerance = 2e-10;  // of the limit, or of the stroke for a position
constexpr int kMostExchanges = 300;
constexpr int kMostReweightings = 8;
constexpr double kSettled = 0.05;  // relative change of the estimated noise

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

// A limit of a derivative: value <= most, or value >= most with the sign turned.
struct Bound {
  LimitKind kind;
  int order;
  double sign, most;  // in units of the system
};

struct Constraint {
  LimitKind kind;
  bool is_jerk_joint;  // of C3
  double x;
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

struct Solution {
  KnotSystem system;
  VectorXd z;
  double squares = 0;    // weighted
  double criterion = 0;  // the Bayesian information criterion
  double largest = 0;    // error
};

class Fitter {
 public:
  explicit Fitter(const FitRequest& request) : request_(request) {}

  FitResult run() {
    result_.error = prepare();
    if (!result_.error.empty()) return std::move(result_);
    Solution best;
    if (!chooseKnots(best)) return std::move(result_);
    if (request_.loss != Loss::Squares) reweight(best);
    if (!keepLimits(best)) return std::move(result_);
    finish(best);
    return std::move(result_);
  }

 private:
  // What must hold before anything is computed; the forced knots.
  std::string prepare();
  std::string necessary() const;
  bool solve(std::vector<double> knots, Solution& solution);
  bool solveHalving(std::vector<double> knots, Solution& solution);
  bool isInDwell(double from, double to) const;
  MatrixXd matrix(const KnotSystem& system, VectorXd& g) const;
  bool addJoints(const KnotSystem& system, QuadraticProgram& program, std::vector<Constraint>& constraints) const;
  void measure(Solution& solution) const;
  bool chooseKnots(Solution& best);
  bool refineToTolerance(Solution& best);
  std::vector<double> uniform(size_t count) const;
  std::vector<double> split(const Solution& of, const std::vector<double>& errors, size_t most) const;
  std::vector<double> errorsOf(const Solution& solution, bool squares) const;
  void reweight(Solution& best);
  bool keepLimits(Solution& best);
  bool constrain(Solution& best, std::string& why);
  std::vector<Bound> bounds(const KnotSystem& system) const;
  // Not left out by its weight, and not an outlier: one that says more about the noise than about the curve.
  bool counts(size_t sample) const {
    return weights_[sample] > 0 && weights_[sample] >= request_.samples[sample].weight / 2;
  }
  double errorOf(const Solution& solution, const Sample& sample) const;
  Polynomial5 pieceOf(const Solution& solution, size_t segment) const;
  double smoothing(const KnotSystem& system) const {
    return kSmoothing * total_weight_ / static_cast<double>(system.segments());
  }
  void finish(const Solution& best);

  const FitRequest& request_;
  FitResult result_;
  std::vector<double> forced_;   // knots
  std::vector<double> weights_;  // of the samples, with the robust loss
  bool needs_segments_ = false;  // the last solve failed for want of them
  double stroke_ = 1, total_weight_ = 0, start_ = 0, end_ = 0;
};

std::string Fitter::prepare() {
  const std::vector<Sample>& samples = request_.samples;
  if (samples.size() + request_.exact.size() < 2 || samples.empty()) return "a fit needs at least two points";
  start_ = request_.start.value_or(samples.front().x);
  end_ = request_.end.value_or(samples.back().x);
  if (!(start_ < end_)) return "the master range is empty";
  if (samples.front().x < start_ || samples.back().x > end_)
    return "the points are from " + exactText(samples.front().x) + " to " + exactText(samples.back().x) +
           ", outside of the master range " + exactText(start_) + " to " + exactText(end_);
  double low = samples.front().y, high = low;
  const auto include = [&](double y) { low = std::min(low, y), high = std::max(high, y); };
  for (const Sample& sample : samples) {
    include(sample.y);
    weights_.push_back(sample.weight);
    total_weight_ += sample.weight;
  }
  forced_ = {start_, end_};
  for (const ExactPoint& point : request_.exact) {
    if (point.x < start_ || point.x > end_)
      return "the exact point at " + exactText(point.x) + " is outside of the cam";
    include(point.y);
    forced_.push_back(point.x);
  }
  for (const Dwell& dwell : request_.dwells) {
    if (!(dwell.from < dwell.to) || dwell.from < start_ || dwell.to > end_)
      return "the dwell from " + exactText(dwell.from) + " to " + exactText(dwell.to) + " is not inside of the cam";
    if (dwell.y) include(*dwell.y);
    forced_.push_back(dwell.from);
    forced_.push_back(dwell.to);
  }
  std::sort(forced_.begin(), forced_.end());
  forced_.erase(std::unique(forced_.begin(), forced_.end()), forced_.end());
  if (forced_.size() - 1 > request_.most_segments)
    return "the exact points and dwells need " + std::to_string(forced_.size() - 1) + " segments, more than the " +
           std::to_string(request_.most_segments) + " allowed";
  stroke_ = high > low ? high - low : 1;
  if (total_weight_ <= 0) return "all points have the weight 0";
  return necessary();
}

// Wishes that no curve at all can meet, however many segments it has.
std::string Fitter::necessary() const {
  const Limits& limits = request_.limits;
  const double speed = limits.speed.value_or(1);
  struct Known {
    double x, y;
    bool rests;
  };
  std::vector<Known> known;
  for (const ExactPoint& point : request_.exact) known.push_back({point.x, point.y, false});
  for (const Dwell& dwell : request_.dwells)
    if (dwell.y) known.insert(known.end(), {{dwell.from, *dwell.y, true}, {dwell.to, *dwell.y, true}});
  std::stable_sort(known.begin(), known.end(), [](const Known& a, const Known& b) { return a.x < b.x; });
  for (const Known& at : known)
    if ((limits.low && at.y < *limits.low) || (limits.high && at.y > *limits.high))
      return "the position " + exactText(at.y) + " wished at " + exactText(at.x) + " is outside of the limits " +
             exactText(*limits.low) + " to " + exactText(*limits.high);
  for (size_t i = 0; i + 1 < known.size(); ++i) {
    const Known &a = known[i], &b = known[i + 1];
    if (a.x == b.x) continue;
    const double way = std::fabs(b.y - a.y), time = (b.x - a.x) / speed;
    const std::string between = "from " + exactText(a.y) + " at " + exactText(a.x) + " to " + exactText(b.y) + " at " +
                                exactText(b.x) + " the slave needs ";
    if (limits.velocity && way / time > *limits.velocity * (1 + 1e-9))
      return between + "a mean velocity of " + shortText(way / time) + ", above the limit " +
             exactText(*limits.velocity);
    if (!a.rests || !b.rests) continue;
    // From rest to rest the least acceleration is that of the parabola, the least jerk that of the cubic ramp.
    const double acceleration = 4 * way / (time * time), jerk = 32 * way / (time * time * time);
    if (limits.acceleration && acceleration > *limits.acceleration * (1 + 1e-9))
      return between + "an acceleration of at least " + shortText(acceleration) + ", above the limit " +
             exactText(*limits.acceleration);
    if (limits.jerk && jerk > *limits.jerk * (1 + 1e-9))
      return between + "a jerk of at least " + shortText(jerk) + ", above the limit " + exactText(*limits.jerk);
  }
  return {};
}

MatrixXd Fitter::matrix(const KnotSystem& system, VectorXd& g) const {
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
bool Fitter::addJoints(const KnotSystem& system, QuadraticProgram& program,
                       std::vector<Constraint>& constraints) const {
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

Polynomial5 Fitter::pieceOf(const Solution& solution, size_t segment) const {
  const auto basis = basisOf(solution.system.length(segment));
  Polynomial5 p{};
  for (size_t f = 0; f < 6; ++f) {
    const Unknown& unknown = solution.system.at(BasisRow{segment, {}}, f);
    const double value = unknown.offset + (unknown.index < 0 ? 0 : solution.z[unknown.index]);
    for (size_t k = 0; k < 6; ++k) p.c[k] += value * basis[f][k];
  }
  return p;
}

double Fitter::errorOf(const Solution& solution, const Sample& sample) const {
  const size_t segment = solution.system.segmentAt(sample.x);
  const BasisRow row = solution.system.row(segment, solution.system.parameter(segment, sample.x), 0);
  double value = -sample.y / stroke_;
  for (size_t f = 0; f < 6; ++f) {
    const Unknown& unknown = solution.system.at(row, f);
    value += row.factors[f] * (unknown.offset + (unknown.index < 0 ? 0 : solution.z[unknown.index]));
  }
  return value;
}

void Fitter::measure(Solution& solution) const {
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
  const double mean = solution.squares / weight + kRounding * kRounding;
  solution.criterion = count * std::log(mean) + std::log(count) * (solution.system.unknowns() - joints);
}

bool Fitter::solve(std::vector<double> knots, Solution& solution) {
  needs_segments_ = false;
  result_.error = solution.system.build(request_, std::move(knots), stroke_);
  if (!result_.error.empty()) return false;
  if (solution.system.unknowns() == 0) {
    solution.z = VectorXd();
    return measure(solution), true;
  }
  VectorXd g;
  const MatrixXd G = matrix(solution.system, g);
  if (request_.smoothness == Smoothness::C2) {
    solution.z = -G.llt().solve(g);
  } else {
    QuadraticProgram program;
    std::vector<Constraint> constraints;
    if (!program.start(G, g) || !addJoints(solution.system, program, constraints)) {
      result_.error = "no curve of " + std::to_string(solution.system.segments()) +
                      " segments with a continuous jerk meets all wishes; allow more segments, or steps of the jerk";
      needs_segments_ = true;
      return false;
    }
    solution.z = program.x();
  }
  if (!solution.z.allFinite()) {
    result_.error = "the points do not determine a curve";
    return false;
  }
  measure(solution);
  return true;
}

// With twice the segments where a continuous jerk needs more of them.
bool Fitter::solveHalving(std::vector<double> knots, Solution& solution) {
  while (!solve(knots, solution)) {
    if (!needs_segments_) return false;
    std::vector<double> halved;
    for (size_t i = 0; i + 1 < knots.size(); ++i) {
      halved.push_back(knots[i]);
      if (!isInDwell(knots[i], knots[i + 1])) halved.push_back((knots[i] + knots[i + 1]) / 2);
    }
    halved.push_back(knots.back());
    if (halved.size() == knots.size() || halved.size() - 1 > request_.most_segments) return false;
    knots = std::move(halved);
  }
  return true;
}

bool Fitter::isInDwell(double from, double to) const {
  return std::any_of(request_.dwells.begin(), request_.dwells.end(),
                     [&](const Dwell& dwell) { return dwell.from <= from && to <= dwell.to; });
}

// Knots at equal distances between the forced ones.
std::vector<double> Fitter::uniform(size_t count) const {
  std::vector<double> knots = {forced_.front()};
  for (size_t i = 0; i + 1 < forced_.size(); ++i) {
    const double from = forced_[i], to = forced_[i + 1];
    const double share = static_cast<double>(count) * (to - from) / (end_ - start_);
    const int pieces = isInDwell(from, to) ? 1 : std::max(1, static_cast<int>(std::lround(share)));
    for (int k = 1; k < pieces; ++k) knots.push_back(from + (to - from) * k / pieces);
    knots.push_back(to);
  }
  return knots;
}

// Of each segment: the weighted squares of its errors, or the largest.
std::vector<double> Fitter::errorsOf(const Solution& solution, bool squares) const {
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

// Halves the `most` segments with the largest errors above 0.
std::vector<double> Fitter::split(const Solution& of, const std::vector<double>& errors, size_t most) const {
  std::vector<size_t> order;
  for (size_t i = 0; i < errors.size(); ++i)
    if (errors[i] > 0 && !isInDwell(of.system.knots()[i], of.system.knots()[i + 1])) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return errors[a] > errors[b]; });
  order.resize(std::min(order.size(), most));
  std::vector<double> knots = of.system.knots();
  for (const size_t i : order) {
    const double middle = (of.system.knots()[i] + of.system.knots()[i + 1]) / 2;
    if (of.system.knots()[i] < middle && middle < of.system.knots()[i + 1]) knots.push_back(middle);
  }
  std::sort(knots.begin(), knots.end());
  return knots;
}

bool Fitter::refineToTolerance(Solution& best) {
  const double tolerance = *request_.tolerance / stroke_;
  if (!solveHalving(forced_, best)) return false;
  while (best.largest > tolerance && best.system.segments() < request_.most_segments) {
    std::vector<double> errors = errorsOf(best, false);
    for (double& error : errors)
      if (error <= tolerance) error = 0;
    std::vector<double> knots = split(best, errors, request_.most_segments - best.system.segments());
    if (knots.size() == best.system.knots().size()) break;
    if (!solve(std::move(knots), best)) return false;
  }
  return true;
}

// Uniform knots of growing number, then more where the errors are largest, as long as the criterion falls.
bool Fitter::chooseKnots(Solution& best) {
  if (request_.tolerance) return refineToTolerance(best);
  if (!solveHalving(forced_, best)) return false;
  const double points = static_cast<double>(request_.samples.size());
  const auto tryKnots = [&](std::vector<double> knots) {
    Solution next;
    if (knots.size() - 1 > request_.most_segments || !solve(std::move(knots), next)) return false;
    if (next.system.unknowns() > points || next.criterion >= best.criterion) return false;
    best = std::move(next);
    return true;
  };
  size_t last = best.system.segments();
  int worse = 0;
  for (size_t count = 2; count <= request_.most_segments && worse < 4; count += std::max<size_t>(1, count / 3)) {
    std::vector<double> knots = uniform(count);
    if (knots.size() - 1 <= last) continue;
    last = knots.size() - 1;
    worse = tryKnots(std::move(knots)) ? 0 : worse + 1;
  }
  if (best.system.segments() * 4 / 3 >= request_.most_segments) tryKnots(uniform(request_.most_segments));
  for (int round = 0; round < 8; ++round) {
    const size_t room = request_.most_segments - best.system.segments();
    const size_t share = std::max<size_t>(1, best.system.segments() / 4);
    if (!tryKnots(split(best, errorsOf(best, true), std::min(room, share)))) break;
  }
  result_.error.clear();
  return true;
}

// The weights of the loss at its minimum, then the curve again; knots that outliers have attracted are chosen again.
void Fitter::reweight(Solution& best) {
  std::vector<double> errors;
  double last = 0;
  for (int round = 0; round < kMostReweightings; ++round) {
    errors.clear();
    for (size_t i = 0; i < request_.samples.size(); ++i)
      if (request_.samples[i].weight > 0) errors.push_back(std::fabs(errorOf(best, request_.samples[i])));
    const auto middle = errors.begin() + static_cast<ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    // The median of the errors is 0.6745 of the deviation of noise; at these multiples of it a loss keeps 95 % of the
    // efficiency of squares.
    const double deviation = std::max(*middle / 0.6745, kRounding);
    if (std::fabs(deviation - last) <= kSettled * deviation) break;
    last = deviation;
    const double factor = request_.loss == Loss::Huber ? 1.345 : request_.loss == Loss::Cauchy ? 2.385 : 4.685;
    const double scale = request_.loss_scale ? *request_.loss_scale / stroke_ : factor * deviation;
    const std::vector<double> start(best.z.data(), best.z.data() + best.z.size());
    const RobustWeights robust = robustWeights(best.system, request_, smoothing(best.system), scale, start);
    result_.report.robust_iterations += robust.iterations;
    for (size_t i = 0; i < weights_.size(); ++i) weights_[i] = request_.samples[i].weight * robust.weights[i];
    Solution next;
    if (!chooseKnots(next)) return;
    best = std::move(next);
  }
  result_.report.outliers = 0;
  for (size_t i = 0; i < weights_.size(); ++i)
    if (!counts(i) && request_.samples[i].weight > 0) ++result_.report.outliers;
}

std::vector<Bound> Fitter::bounds(const KnotSystem& system) const {
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

// False: `why` has the reason, which more segments may remove.
bool Fitter::constrain(Solution& best, std::string& why) {
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
  struct Violation {
    const Bound* bound;
    size_t segment;
    double t, by;
  };
  for (int exchange = 0; exchange < kMostExchanges; ++exchange) {
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
    if (violations.empty()) {
      result_.report.iterations += program.iterations();
      return true;
    }
    std::stable_sort(violations.begin(), violations.end(), [](const Violation& a, const Violation& b) {
      return a.by / std::fabs(a.bound->most + 1e-300) > b.by / std::fabs(b.bound->most + 1e-300);
    });
    for (const Violation& violation : violations) {
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
      if (size > 1e-14 && program.addAtLeast(normal / size, least / size, static_cast<int>(constraints.size()) - 1))
        continue;
      why = std::string(nameOf(bound.kind)) + " at " + shortText(x) + " contradicts ";
      std::string others;
      int count = 0;
      for (const int label : program.conflict()) {
        const Constraint& other = constraints[static_cast<size_t>(label)];
        if (other.is_jerk_joint || ++count > 4) continue;
        others += (others.empty() ? "" : ", ") + std::string(nameOf(other.kind)) + " at " + shortText(other.x);
      }
      why += others.empty() ? "the exact points, dwells and ends around it" : others;
      result_.report.iterations += program.iterations();
      return false;
    }
    best.z = program.x();
  }
  why = "the limits are not met after " + std::to_string(kMostExchanges) + " exchanges";
  return false;
}

bool Fitter::keepLimits(Solution& best) {
  if (bounds(best.system).empty()) return true;
  const double tolerance = request_.tolerance ? *request_.tolerance / stroke_ : std::numeric_limits<double>::infinity();
  for (;;) {
    std::string why;
    const bool keeps = constrain(best, why);
    if (keeps) measure(best);
    if (keeps && best.largest <= tolerance) return true;
    const size_t segments = best.system.segments();
    const std::vector<double> all(segments, 1.0);
    std::vector<double> knots = split(best, all, request_.most_segments - std::min(segments, request_.most_segments));
    const bool is_last = knots.size() - 1 == segments;
    if (is_last && keeps) return true;  // finish() reports the tolerance
    if (is_last) {
      result_.error = "no curve of " + std::to_string(segments) + " segments meets all wishes: " + why;
      return false;
    }
    if (!solveHalving(std::move(knots), best)) return false;
  }
}

void Fitter::finish(const Solution& best) {
  Cam& cam = result_.cam;
  const KnotSystem& system = best.system;
  cam.repeat = request_.repeat;
  cam.slave_period = request_.slave_period;
  cam.start = start_;
  cam.end = end_;
  cam.limits = request_.limits;
  for (size_t knot = 0; knot < system.knots().size(); ++knot) {
    double value[3];
    for (size_t d = 0; d < 3; ++d) {
      const Unknown& unknown = system.at(knot, d);
      value[d] = unknown.offset + (unknown.index < 0 ? 0 : best.z[unknown.index]);
    }
    const double h = system.mean();
    cam.points.push_back(
        {system.knots()[knot], value[0] * stroke_, value[1] * stroke_ / h, value[2] * stroke_ / (h * h)});
    cam.segments.push_back(SegmentKind::Quintic);
  }
  // Scaling has rounded them.
  const auto pointAt = [&](double x) -> Point& {
    return *std::lower_bound(cam.points.begin(), cam.points.end(), x,
                             [](const Point& p, double at) { return p.x < at; });
  };
  for (const Dwell& dwell : request_.dwells)
    for (Point& point : cam.points)
      if (point.x >= dwell.from && point.x <= dwell.to) point.y = dwell.y.value_or(pointAt(dwell.from).y);
  for (const ExactPoint& exact : request_.exact) pointAt(exact.x).y = exact.y;

  const Curve curve = curveOf(cam);
  FitReport& report = result_.report;
  report.segments = system.segments();
  double squares = 0, weight = 0;
  for (const Sample& sample : request_.samples) {
    if (sample.weight <= 0) continue;
    const double error = curve.at(sample.x, 0) - sample.y;
    squares += error * error;
    ++weight;
    if (std::fabs(error) > std::fabs(report.max_error.value)) report.max_error = {sample.x, error};
  }
  report.rms_error = std::sqrt(squares / weight);
  if (request_.tolerance && std::fabs(report.max_error.value) > *request_.tolerance && request_.loss == Loss::Squares) {
    result_.error = "the largest error with " + std::to_string(report.segments) + " segments is " +
                    shortText(report.max_error.value) + " at " + shortText(report.max_error.x) +
                    ", above the tolerance " + exactText(*request_.tolerance);
    return;
  }
  for (const Exceeded& exceeded : exceededLimits(cam.limits, peaksOf(cam, curve, cam.limits.speed.value_or(1))))
    result_.error = std::string(nameOf(exceeded.kind)) + " is exceeded at " + shortText(exceeded.peak.x) + ", by " +
                    shortText(std::fabs(exceeded.peak.value) - exceeded.limit);
}

}  // namespace

FitResult fit(const FitRequest& request) { return Fitter(request).run(); }

}  // namespace rung::cam

// SPDX-License-Identifier: Apache-2.0
// The fit of cams as a search for knots; see fit.h. They are chosen without limits, by the Bayesian information
// criterion or the tolerance; then the limits are kept, with more knots where that needs them. The curve over given
// knots is model.h's.
#include "cam/fit/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cam/design/peaks.h"
#include "cam/design/text_form.h"
#include "cam/fit/model.h"
#include "cam/fit/robust.h"

namespace rung::cam {
namespace {

constexpr int kMostReweightings = 8;
constexpr double kSettled = 0.05;  // relative change of the estimated noise

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
  // An error of the request, or an empty string: the forced knots and the model are there.
  std::string prepare();
  std::string necessary() const;
  bool solve(std::vector<double> knots, Solution& solution);
  bool solveHalving(std::vector<double> knots, Solution& solution);
  bool isInDwell(double from, double to) const;
  bool chooseKnots(Solution& best);
  bool refineToTolerance(Solution& best);
  std::vector<double> uniform(size_t count) const;
  std::vector<double> split(const Solution& of, const std::vector<double>& errors, size_t most) const;
  void reweight(Solution& best);
  bool keepLimits(Solution& best);
  void finish(const Solution& best);

  const FitRequest& request_;
  FitResult result_;
  std::optional<Model> model_;
  std::vector<double> forced_;  // knots
  double start_ = 0, end_ = 0;
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
  double weight = 0;
  for (const Sample& sample : samples) {
    include(sample.y);
    weight += sample.weight;
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
  model_.emplace(request_, high > low ? high - low : 1);
  if (weight <= 0) return "all points have the weight 0";
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

bool Fitter::solve(std::vector<double> knots, Solution& solution) {
  return model_->solve(std::move(knots), solution, result_.error) == Model::Outcome::Solved;
}

// With twice the segments where a continuous jerk needs more of them.
bool Fitter::solveHalving(std::vector<double> knots, Solution& solution) {
  for (;;) {
    const Model::Outcome outcome = model_->solve(knots, solution, result_.error);
    if (outcome == Model::Outcome::Solved) return true;
    if (outcome == Model::Outcome::Impossible) return false;
    std::vector<double> halved;
    for (size_t i = 0; i + 1 < knots.size(); ++i) {
      halved.push_back(knots[i]);
      if (!isInDwell(knots[i], knots[i + 1])) halved.push_back((knots[i] + knots[i + 1]) / 2);
    }
    halved.push_back(knots.back());
    if (halved.size() == knots.size() || halved.size() - 1 > request_.most_segments) return false;
    knots = std::move(halved);
  }
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
  const double tolerance = *request_.tolerance / model_->stroke();
  if (!solveHalving(forced_, best)) return false;
  while (best.largest > tolerance && best.system.segments() < request_.most_segments) {
    std::vector<double> errors = model_->errorsOf(best, false);
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
    if (!tryKnots(split(best, model_->errorsOf(best, true), std::min(room, share)))) break;
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
      if (request_.samples[i].weight > 0) errors.push_back(std::fabs(model_->errorOf(best, request_.samples[i])));
    const auto middle = errors.begin() + static_cast<ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    // The median of the errors is 0.6745 of the deviation of noise; at these multiples of it a loss keeps 95 % of the
    // efficiency of squares.
    const double deviation = std::max(*middle / 0.6745, kFitRounding);
    if (std::fabs(deviation - last) <= kSettled * deviation) break;
    last = deviation;
    const double factor = request_.loss == Loss::Huber ? 1.345 : request_.loss == Loss::Cauchy ? 2.385 : 4.685;
    const double scale = request_.loss_scale ? *request_.loss_scale / model_->stroke() : factor * deviation;
    const std::vector<double> start(best.z.data(), best.z.data() + best.z.size());
    const RobustWeights robust = robustWeights(best.system, request_, model_->smoothing(best.system), scale, start);
    result_.report.robust_iterations += robust.iterations;
    for (size_t i = 0; i < robust.weights.size(); ++i) model_->reweight(i, robust.weights[i]);
    Solution next;
    if (!chooseKnots(next)) return;
    best = std::move(next);
  }
  result_.report.outliers = 0;
  for (size_t i = 0; i < request_.samples.size(); ++i)
    if (!model_->counts(i) && request_.samples[i].weight > 0) ++result_.report.outliers;
}

bool Fitter::keepLimits(Solution& best) {
  if (!model_->hasLimits(best.system)) return true;
  const double tolerance =
      request_.tolerance ? *request_.tolerance / model_->stroke() : std::numeric_limits<double>::infinity();
  for (;;) {
    std::string why;
    const bool keeps = model_->constrain(best, why, result_.report.iterations);
    if (keeps) model_->measure(best);
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
    cam.points.push_back({system.knots()[knot], value[0] * model_->stroke(), value[1] * model_->stroke() / h,
                          value[2] * model_->stroke() / (h * h)});
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

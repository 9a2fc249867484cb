// SPDX-License-Identifier: Apache-2.0
// Time-optimal plans with limited jerk from any velocity and acceleration. In: a request that is checked; out: phases.
//
// The plan is found on a family of motions that starts with the fastest ramp from the start to the end velocity and
// gets longer in time from member to member; each member covers more distance than the ramp does ("over"), or,
// mirrored, less:
//   dip     braking is relaxed to an acceleration -m and taken up again; m falls from |a0| to 0
//   peak    rise to a velocity x with acceleration 0, and fall to the end velocity; x grows up to the limit
//   cruise  constant velocity at the limit
// A start that runs over the velocity limit has the dip at the limit, and no peak. Dip and peak are one equation in one
// unknown, distance(m) or distance(x), whose slope is known in closed form.
// The longest plan: back into the limit of the acceleration 1, rise 5, cruise 1, fall 5 phases.
#include <math.h>

#include "phases.h"
#include "rise.h"
#include "root.h"

namespace rung::motion::planning {
namespace {

struct Curve {
  double velocity, jerk;
  Caps rise, fall;  // a fall seen backwards in time: its speed grows below 0
};

struct Motion {
  double velocity, acceleration;
};

// The velocity at which the acceleration is 0 when it goes there at once.
double restVelocity(const Motion& start, double jerk) {
  return start.velocity + start.acceleration * fabs(start.acceleration) / (2 * jerk);
}

// Where the rest velocity and `velocity` are equal but for rounding, one of them is taken for both: a change of
// velocity by e takes a time of the order of the square root of e.
bool isRestVelocity(double velocity, const Motion& start, double jerk) {
  const double part = square(start.acceleration) / (2 * jerk);
  const double rest = restVelocity(start, jerk);
  return start.acceleration != 0 && fabs(velocity - rest) <= 16 * rounding * (fabs(start.velocity) + part);
}

double jerkDistance(const Motion& start, double jerk, double t) {
  return t * (start.velocity + t * (start.acceleration / 2 + t * jerk / 6));
}

Rise fallOf(const Motion& from, double to, double change, const Curve& curve) {
  return riseOf(to, 0, from.velocity, -from.acceleration, change, curve.fall, curve.jerk);
}

void addStretch(Writer& writer, const Stretch& s, double a0, double jerk) {
  writer.add(s.up, a0, jerk);
  writer.add(s.flat, s.peak, 0);
  writer.add(s.down, s.peak, -jerk);
}

void addRise(Writer& writer, const Rise& rise, double jerk) {
  addStretch(writer, rise.stretches[0], rise.a0, jerk);
  if (rise.count == 2) addStretch(writer, rise.stretches[1], rise.a_zero, jerk);
}

// Backwards in time the acceleration changes its sign, and the jerk keeps it.
void addStretchBackwards(Writer& writer, const Stretch& s, double a1, double jerk) {
  writer.add(s.down, -a1, -jerk);
  writer.add(s.flat, -s.peak, 0);
  writer.add(s.up, -s.peak, jerk);
}

void addFall(Writer& writer, const Rise& fall, double jerk) {
  if (fall.count == 2) addStretchBackwards(writer, fall.stretches[1], fall.a1, jerk);
  addStretchBackwards(writer, fall.stretches[0], fall.count == 2 ? fall.a_zero : fall.a1, jerk);
}

// The fastest way up to `to`, which is not below the start's rest velocity: a start that brakes first lets go.
struct Approach {
  Motion start;
  double release;  // duration of letting go
  Rise rise;
};

// `change` is the difference between `to` and the rest velocity.
Approach approach(const Motion& start, double to, double change, const Curve& curve) {
  const double j = curve.jerk;
  if (start.acceleration >= 0) {
    change += square(start.acceleration) / (2 * j);
    return {start, 0, riseOf(start.velocity, start.acceleration, to, 0, change, curve.rise, j)};
  }
  return {start, -start.acceleration / j, riseOf(restVelocity(start, j), 0, to, 0, change, curve.rise, j)};
}

double approachDistance(const Approach& way, const Curve& curve) {
  return jerkDistance(way.start, curve.jerk, way.release) + riseDistance(way.rise, curve.jerk);
}

void addApproach(Writer& writer, const Approach& way, const Curve& curve) {
  writer.add(way.release, way.start.acceleration, curve.jerk);
  addRise(writer, way.rise, curve.jerk);
}

// The fastest ramp, up (sign 1) or, mirrored, down (sign -1).
struct Direct {
  double sign;
  Approach way;
};

Direct directRamp(const Motion& start, double to, const Curve& curve) {
  const double change = to - restVelocity(start, curve.jerk);
  const double sign = change >= 0 ? 1 : -1;
  return {sign, approach({sign * start.velocity, sign * start.acceleration}, sign * to, sign * change, curve)};
}

// A start beyond the limit of the acceleration goes back to it at once. Returns the duration; the start moves along.
// Where the limit is lower above velocity 0 than below, it must be kept already when the velocity gets there.
double dropExcess(Motion& start, const Curve& curve) {
  constexpr double snap = 1 + 1e-12;
  const double sign = start.acceleration < 0 ? -1 : 1;
  const double v = sign * start.velocity;
  const double a = sign * start.acceleration;
  const double at_zero = square(a) / 2 + curve.jerk * v;  // a^2 / 2 where the velocity gets to 0
  const double slack = 16 * rounding * square(a);
  double allowed = curve.rise.above;
  bool stops_at_zero = false;
  if (v < 0 && at_zero <= square(curve.rise.above) / 2 + slack) {
    stops_at_zero = a > curve.rise.below && at_zero > square(curve.rise.below) / 2 + slack;
    allowed = stops_at_zero ? sqrt(2 * at_zero) : curve.rise.below;
  }
  if (a <= allowed) return 0;
  if (a <= allowed * snap) {
    start.acceleration = sign * allowed;
    return 0;
  }
  const double duration = (a - allowed) / curve.jerk;
  start.velocity = stops_at_zero ? 0 : sign * (v + duration * (a + allowed) / 2);
  start.acceleration = sign * allowed;
  return duration;
}

// A motion over the ramp from start to end velocity. All velocities are in the direction of the additional distance.
class Over {
 public:
  Over(Writer& writer, const Motion& start, double to, double distance, double tolerance, const Curve& curve)
      : writer_(writer),
        start_(start),
        to_(to),
        distance_(distance),
        tolerance_(tolerance),
        curve_(curve),
        rest_(restVelocity(start, curve.jerk)) {}

  void plan() {
    if (rest_ > curve_.velocity) {
      planFromOverspeed();
    } else if (!(start_.acceleration < 0 && to_ < rest_ && planDip())) {
      planPeak();
    }
  }

 private:
  // distance(x) of a rise to x and a fall from it, where x is `above` the rest velocity of the start and `over` the end
  // velocity. Its slope is (x + A^2/2j)/A + (x + B^2/2j)/B with the accelerations A where the rise begins to end and B
  // where the fall ends to begin: above velocity 0 it grows, below it is convex.
  Value distanceOverPeak(double x, double above, double over) {
    way_ = approach(start_, x, above, curve_);
    fall_ = fallOf({x, 0}, to_, over, curve_);
    const double a = way_.rise.peak;
    const double b = fall_.peak;
    return {approachDistance(way_, curve_) + riseDistance(fall_, curve_.jerk),
            (x + square(a) / (2 * curve_.jerk)) / a + (x + square(b) / (2 * curve_.jerk)) / b};
  }

  void planPeak() {
    const double full = distanceOverPeak(curve_.velocity, curve_.velocity - rest_, curve_.velocity - to_).value;
    if (distance_ < full) findPeak();
    addApproach(writer_, way_, curve_);
    writer_.addCruise(distance_ > full ? (distance_ - full) / curve_.velocity : 0, curve_.velocity);
    writer_.setSeam();
    addFall(writer_, fall_, curve_.jerk);
  }

  // The unknown is the acceleration w that the ramp with the smaller change of velocity would reach without its limit:
  // the distance is smooth in it, and it gives the smallest change exactly.
  void findPeak() {
    const double j = curve_.jerk;
    const double s = start_.acceleration > 0 ? start_.acceleration : 0;
    const bool rise_is_smaller = rest_ - square(s) / j >= to_;
    const double base = rise_is_smaller ? rest_ : to_;
    const double least = rise_is_smaller ? s : 0;  // w of the smaller ramp alone
    const auto distanceOf = [&](double w) {
      const double change = (w - least) * (w + least) / j;
      Value at = distanceOverPeak(base + change, base - rest_ + change, base - to_ + change);
      return Value{at.value - distance_, at.slope * 2 * w / j};
    };
    const auto unknownAbove = [&](double change) {
      const double e = square(least) + j * change;
      return e > 0 ? sqrt(e) : 0;
    };
    double low = base < rest_ ? unknownAbove(rest_ - base) : base < to_ ? unknownAbove(to_ - base) : least;
    double high = unknownAbove(curve_.velocity - base);
    // From where on each of the ramps has its greatest acceleration.
    const double rise_limited = unknownAbove((square(curve_.rise.above) - square(s)) / j + rest_ - base);
    const double fall_limited = unknownAbove(square(curve_.fall.above) / j + to_ - base);
    const double both_limited = larger(low, larger(rise_limited, fall_limited));
    Value top{0, 0};
    if (both_limited < high) {
      top = distanceOf(both_limited);
      const double change = (both_limited - least) * (both_limited + least) / j;
      if (top.value <= 0 && areLimited(base + change)) {
        const double more = growBy(-top.value, base + change);
        distanceOverPeak(base + change + more, base - rest_ + change + more, base - to_ + change + more);
        return;
      }
      (top.value > 0 ? high : low) = both_limited;
    }
    if (!(top.value > 0)) top = distanceOf(high);
    distanceOf(rootOf(distanceOf, low, high, guess(low, high, -distanceOf(low).value, top)));
  }

  // Tells whether both ramps have the greatest acceleration of velocities above 0 at their peak `velocity`.
  bool areLimited(double velocity) const {
    const bool same = curve_.rise.below == curve_.rise.above;
    const auto isLimit = [](double peak, double limit) { return fabs(peak - limit) <= 1e-15 * limit; };
    return (velocity >= 0 || same) && isLimit(way_.rise.peak, curve_.rise.above) &&
           isLimit(fall_.peak, curve_.fall.above);
  }

  // How much higher the peak velocity gives `more` distance, where both ramps have their greatest acceleration: the
  // slope of the distance is linear in the velocity there.
  double growBy(double more, double velocity) const {
    const double a = curve_.rise.above;
    const double b = curve_.fall.above;
    const double bend = 1 / a + 1 / b;
    const double slope = velocity * bend + (a + b) / (2 * curve_.jerk);
    const double root = sqrt(square(slope) + 2 * more * bend);
    return slope > 0 ? 2 * more / (slope + root) : (root - slope) / bend;
  }

  // Where a power of w between the bounds, with the slope of the upper one, covers what is missing at the lower one.
  static double guess(double low, double high, double missing, const Value& top) {
    const double whole = missing + top.value;
    const double part = missing / whole;
    const double power = top.slope * (high - low) / whole;
    const double root = power > 2.5 ? roughCubeRoot(part) : power > 1.5 ? sqrt(part) : part;
    return low + (high - low) * root;
  }

  // The start brakes, and the end velocity is still lower: where the braking is relaxed to -m, taken up again at
  // rest_ + m^2/2j. slope: -(2/j) (B - m) ((rest_ + m^2/j)/B - m/2j) with B as above.
  Value distanceOverDip(double m) {
    const double j = curve_.jerk;
    const double back = square(m) / (2 * j);
    fall_ = fallOf({rest_ + back, -m}, to_, rest_ - to_ + back, curve_);
    const double b = fall_.peak;
    return {jerkDistance(start_, j, releaseTo(m)) + riseDistance(fall_, j),
            -2 / j * (b - m) * ((rest_ + square(m) / j) / b - m / (2 * j))};
  }

  double releaseTo(double m) const { return (-start_.acceleration - m) / curve_.jerk; }

  bool planDip() {
    const double deepest = -start_.acceleration;
    double low = 0;
    if (to_ < 0) {
      double bends[max_bends];
      const int count = bendsOfDip(bends);
      for (int i = 0; i < count; ++i) {
        const bool better = bends[i] > low && bends[i] < deepest;
        if (better && distanceOverDip(bends[i]).value >= distance_ - tolerance_) low = bends[i];
      }
    }
    if (low == 0 && distanceOverDip(0).value < distance_) return false;
    // As the distance falls with m, the unknown is what is taken off.
    const double m = deepest - rootOf(
                                   [&](double less) {
                                     const Value at = distanceOverDip(deepest - less);
                                     return Value{at.value - distance_, -at.slope};
                                   },
                                   0, deepest - low, (deepest - low) / 2);
    distanceOverDip(m);
    writer_.add(releaseTo(m), start_.acceleration, curve_.jerk);
    writer_.setSeam();
    addFall(writer_, fall_, curve_.jerk);
    return true;
  }

  // A fall that crosses velocity 0 covers less distance when it takes long below 0. Where the slope changes its sign,
  // by what limits B: nothing or the acceleration at velocity 0 (B^2 = m^2 + k), a limit, or the change between the
  // two.
  static constexpr int max_bends = 5;
  int bendsOfDip(double (&bends)[max_bends]) const {
    const double c = curve_.jerk * rest_;
    const double caps[2] = {curve_.fall.above, curve_.fall.below};
    const double lower = caps[0] < caps[1] ? caps[0] : caps[1];
    int count = 0;
    const double ks[2] = {curve_.jerk * (rest_ - to_), square(lower) / 2 + c};
    for (double k : ks) {
      const double root = square(k) - 16 * c * k + 16 * square(c);
      const double m2 = root >= 0 ? (k - 8 * c + sqrt(root)) / 6 : -1;
      if (m2 > 0) bends[count++] = sqrt(m2);
    }
    if (square(lower) / 2 > c) bends[count++] = sqrt(square(lower) / 2 - c);
    for (double cap : caps) {
      if (square(cap) >= 16 * c) bends[count++] = (cap + sqrt(square(cap) - 16 * c)) / 4;
    }
    return count;
  }

  // Over the velocity limit even when the acceleration goes to 0 at once: down to the limit, cruise, and on. When the
  // way is shorter, the braking is relaxed at the limit to an acceleration -m only.
  void planFromOverspeed() {
    const double j = curve_.jerk;
    const double release = start_.acceleration > 0 ? start_.acceleration / j : 0;
    const double released = jerkDistance(start_, -j, release);
    const Motion top{release > 0 ? rest_ : start_.velocity, release > 0 ? 0 : start_.acceleration};
    Rise first;
    const auto distanceOver = [&](double m) {
      const double v = curve_.velocity;
      first = riseOf(v, m, top.velocity, -top.acceleration, top.velocity - v, curve_.fall, j);
      fall_ = fallOf({v, -m}, to_, v - to_, curve_);
      const double a = backwardsPeak(first);
      const double b = fall_.peak;
      const double slope = -((a - m) * ((v - square(m) / (2 * j)) / a + m / (2 * j)) +
                             (b - m) * ((v + square(m) / (2 * j)) / b - m / (2 * j))) /
                           j;
      return Value{released + riseDistance(first, j) + riseDistance(fall_, j), slope};
    };
    const double full = distanceOver(0).value;
    double cruise = 0;
    if (distance_ >= full) {
      cruise = (distance_ - full) / curve_.velocity;
    } else {
      const double high = dipOfDirect(top);
      const double m = high - rootOf(
                                  [&](double less) {
                                    const Value at = distanceOver(high - less);
                                    return Value{at.value - distance_, -at.slope};
                                  },
                                  0, high, high / 2);
      distanceOver(m);
    }
    writer_.add(release, start_.acceleration, -j);
    addFall(writer_, first, j);
    writer_.addCruise(cruise, curve_.velocity);
    writer_.setSeam();
    addFall(writer_, fall_, j);
  }

  static double backwardsPeak(const Rise& rise) { return rise.stretches[0].peak; }

  // The acceleration that the direct ramp has at the velocity limit.
  double dipOfDirect(const Motion& top) const {
    const double j = curve_.jerk;
    const double v = curve_.velocity;
    const double limit = square(curve_.fall.above);
    double e = square(top.acceleration) + 2 * j * (top.velocity - v);
    const double below = to_ < 0 ? 2 * j * v + squareAtZero() : 2 * j * (v - to_);
    if (below < e) e = below;
    return sqrt(e < limit ? e : limit);
  }

  // The square of the acceleration that a ramp through velocity 0 to to_ can have there.
  double squareAtZero() const {
    const double free = -2 * curve_.jerk * to_;
    if (curve_.fall.below == curve_.fall.above) return free;
    const double cap = square(curve_.fall.below < curve_.fall.above ? curve_.fall.below : curve_.fall.above);
    return free < cap ? free : cap;
  }

  Writer& writer_;
  const Motion start_;
  const double to_;
  const double distance_;
  const double tolerance_;
  const Curve& curve_;
  const double rest_;
  // Of the member of the family that was looked at last.
  Approach way_;
  Rise fall_;
};

Curve curveOf(const Limits& limits) {
  return {limits.velocity,
          limits.jerk,
          {limits.deceleration, limits.acceleration},
          {limits.acceleration, limits.deceleration}};
}

}  // namespace

void sCurveToVelocity(Profile& profile, const Request& request, const Limits& limits) {
  const Curve curve = curveOf(limits);
  Motion start{request.velocity, request.acceleration};
  Writer writer(profile, start.acceleration < 0 ? -1 : 1);
  const double excess = dropExcess(start, curve);
  writer.add(excess, fabs(request.acceleration), -curve.jerk);
  const double to =
      isRestVelocity(request.end_velocity, start, curve.jerk) ? restVelocity(start, curve.jerk) : request.end_velocity;
  const Direct direct = directRamp(start, to, curve);
  writer.setSign(direct.sign);
  addApproach(writer, direct.way, curve);
  writer.setSeam();
}

void sCurveToPosition(Profile& profile, const Request& request, const Limits& limits) {
  Curve curve = curveOf(limits);
  Motion start{request.velocity, request.acceleration};
  const double sign = start.acceleration < 0 ? -1 : 1;
  Writer writer(profile, sign);
  const double excess = dropExcess(start, curve);
  writer.add(excess, fabs(request.acceleration), -curve.jerk);
  const double distance =
      request.distance - jerkDistance({request.velocity, request.acceleration}, -sign * curve.jerk, excess);

  const double rest = restVelocity(start, curve.jerk);
  const double to = isRestVelocity(request.end_velocity, start, curve.jerk) ? rest : request.end_velocity;
  if (isRestVelocity(copysign(curve.velocity, rest), start, curve.jerk)) curve.velocity = fabs(rest);
  const Direct direct = directRamp(start, to, curve);
  const double more = distance - direct.sign * approachDistance(direct.way, curve);
  const double side = more > 0 ? 1 : -1;
  double tolerance = request.tolerance;
  if (side * to < 0 && (side * rest <= 0 || side * start.acceleration < 0)) {
    // The other way would be a loop. Without acceleration a small change of velocity has next to no peak.
    const double speed = larger(larger(fabs(start.velocity), fabs(rest)), fabs(to));
    const double least_peak = sqrt(curve.jerk * speed * 1e-11);
    tolerance += rampRounding(speed, direct.way.rise.peak > least_peak ? direct.way.rise.peak : least_peak);
  }
  if (fabs(more) <= tolerance) {
    writer.setSign(direct.sign);
    writer.setSeam();
    addApproach(writer, direct.way, curve);
    return;
  }
  writer.setSign(side);
  Over(writer, {side * start.velocity, side * start.acceleration}, side * to, side * distance, tolerance, curve).plan();
}

}  // namespace rung::motion::planning

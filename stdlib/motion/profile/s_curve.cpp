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

namespace rung::motion {
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

double jerkDistance(const Motion& start, double jerk, double t) {
  return t * (start.velocity + t * (start.acceleration / 2 + t * jerk / 6));
}

Rise fallOf(const Motion& from, double to, const Curve& curve) {
  return riseOf(to, 0, from.velocity, -from.acceleration, curve.fall, curve.jerk);
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

Approach approach(const Motion& start, double to, const Curve& curve) {
  if (start.acceleration >= 0) {
    return {start, 0, riseOf(start.velocity, start.acceleration, to, 0, curve.rise, curve.jerk)};
  }
  return {start, -start.acceleration / curve.jerk,
          riseOf(restVelocity(start, curve.jerk), 0, to, 0, curve.rise, curve.jerk)};
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
  const double sign = to >= restVelocity(start, curve.jerk) ? 1 : -1;
  return {sign, approach({sign * start.velocity, sign * start.acceleration}, sign * to, curve)};
}

// A start beyond the limit of the acceleration goes back to it at once. Returns the duration; the start moves along.
// Where the limit is lower above velocity 0 than below, it must be kept already when the velocity gets there.
double dropExcess(Motion& start, const Curve& curve) {
  constexpr double rounding = 1 + 1e-12;
  const double sign = start.acceleration < 0 ? -1 : 1;
  const double v = sign * start.velocity;
  const double a = sign * start.acceleration;
  const double at_zero = square(a) / 2 + curve.jerk * v;  // a^2 / 2 where the velocity gets to 0
  double allowed = curve.rise.above;
  bool stops_at_zero = false;
  if (v < 0 && at_zero <= square(curve.rise.above) / 2) {
    stops_at_zero = a > curve.rise.below && at_zero > square(curve.rise.below) / 2;
    allowed = stops_at_zero ? sqrt(2 * at_zero) : curve.rise.below;
  }
  if (a <= allowed) return 0;
  if (a <= allowed * rounding) {
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
  Over(Writer& writer, const Motion& start, double to, double distance, const Curve& curve)
      : writer_(writer),
        start_(start),
        to_(to),
        distance_(distance),
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
  // distance(x) of a rise to x and a fall from it. Its slope is (x + A^2/2j)/A + (x + B^2/2j)/B with the accelerations
  // A where the rise begins to end and B where the fall ends to begin: above velocity 0 it grows, below it is convex.
  Value distanceOverPeak(double x, Approach& way, Rise& fall) const {
    way = approach(start_, x, curve_);
    fall = fallOf({x, 0}, to_, curve_);
    const double a = way.rise.peak;
    const double b = fall.peak;
    return {approachDistance(way, curve_) + riseDistance(fall, curve_.jerk),
            (x + square(a) / (2 * curve_.jerk)) / a + (x + square(b) / (2 * curve_.jerk)) / b};
  }

  void planPeak() {
    Approach way;
    Rise fall;
    const double full = distanceOverPeak(curve_.velocity, way, fall).value;
    if (distance_ >= full) {
      addOverPeak(way, (distance_ - full) / curve_.velocity, fall);
      return;
    }
    distanceOverPeak(peakVelocity(), way, fall);
    addOverPeak(way, 0, fall);
  }

  // The unknown is the acceleration w that the ramp with the shorter change of velocity would reach without its limit:
  // the distance is smooth in it, and x is quadratic.
  double peakVelocity() const {
    const double j = curve_.jerk;
    const double s = start_.acceleration > 0 ? start_.acceleration : 0;
    const bool rise_is_shorter = rest_ - square(s) / j >= to_;
    const auto velocityOf = [&](double w) {
      return rise_is_shorter ? rest_ + (w - s) * (w + s) / j : to_ + square(w) / j;
    };
    const auto accelerationOf = [&](double x) {
      const double e = rise_is_shorter ? square(s) + j * (x - rest_) : j * (x - to_);
      return sqrt(e > 0 ? e : 0);
    };
    const double lowest = rest_ > to_ ? rest_ : to_;
    const double low = accelerationOf(lowest);
    const double high = accelerationOf(curve_.velocity);
    Approach way;
    Rise fall;
    const double w = rootOf(
        [&](double acceleration) {
          const Value at = distanceOverPeak(velocityOf(acceleration), way, fall);
          return Value{at.value - distance_, at.slope * 2 * acceleration / j};
        },
        low, high, high);
    const double x = velocityOf(w);
    return x < lowest ? lowest : x > curve_.velocity ? curve_.velocity : x;
  }

  void addOverPeak(const Approach& way, double cruise, const Rise& fall) {
    addApproach(writer_, way, curve_);
    writer_.add(cruise, 0, 0);
    addFall(writer_, fall, curve_.jerk);
  }

  // The start brakes, and the end velocity is still lower: where the braking is relaxed to -m, taken up again at
  // rest_ + m^2/2j. slope: -(2/j) (B - m) ((rest_ + m^2/j)/B - m/2j) with B as above.
  Value distanceOverDip(double m, Rise& fall) const {
    const double j = curve_.jerk;
    fall = fallOf({rest_ + square(m) / (2 * j), -m}, to_, curve_);
    const double b = fall.peak;
    return {jerkDistance(start_, j, releaseTo(m)) + riseDistance(fall, j),
            -2 / j * (b - m) * ((rest_ + square(m) / j) / b - m / (2 * j))};
  }

  double releaseTo(double m) const { return (-start_.acceleration - m) / curve_.jerk; }

  bool planDip() {
    const double deepest = -start_.acceleration;
    Rise fall;
    double low = 0;
    double high = deepest;
    const double through = distanceOverDip(0, fall).value;
    const double bend = to_ < 0 ? bendOfDip(fall) : 0;
    if (bend > 0 && bend < deepest && distanceOverDip(bend, fall).value >= distance_) {
      low = bend;
    } else if (through < distance_) {
      return false;
    } else if (bend > 0 && bend < deepest) {
      high = bend;
    }
    // As the distance falls with m, the unknown is what is taken off.
    const double m = high - rootOf(
                                [&](double less) {
                                  const Value at = distanceOverDip(high - less, fall);
                                  return Value{at.value - distance_, -at.slope};
                                },
                                0, high - low, (high - low) / 2);
    distanceOverDip(m, fall);
    writer_.add(releaseTo(m), start_.acceleration, curve_.jerk);
    addFall(writer_, fall, curve_.jerk);
    return true;
  }

  // A fall that crosses velocity 0 covers less distance when it takes long below 0: the largest m where the slope is 0.
  double bendOfDip(const Rise&) const {
    const double c = curve_.jerk * rest_;
    const double k = curve_.jerk * (rest_ - to_);
    double bend = 0;
    const auto take = [&](double m) {
      if (m > bend && m < -start_.acceleration) bend = m;
    };
    const double without_cap = square(k) - 16 * c * k + 16 * square(c);
    if (without_cap >= 0) {
      const double m2 = (k - 8 * c + sqrt(without_cap)) / 6;
      if (m2 > 0) take(sqrt(m2));
    }
    const double caps[2] = {curve_.fall.above, curve_.fall.below};
    for (double cap : caps) {
      if (square(cap) >= 16 * c) take((cap + sqrt(square(cap) - 16 * c)) / 4);
    }
    return bend;
  }

  // Over the velocity limit even when the acceleration goes to 0 at once: down to the limit, cruise, and on. When the
  // way is shorter, the braking is relaxed at the limit to an acceleration -m only.
  void planFromOverspeed() {
    const double j = curve_.jerk;
    const double release = start_.acceleration > 0 ? start_.acceleration / j : 0;
    const double released = jerkDistance(start_, -j, release);
    const Motion top{release > 0 ? rest_ : start_.velocity, release > 0 ? 0 : start_.acceleration};
    Rise first, second;
    const auto distanceOver = [&](double m) {
      const double v = curve_.velocity;
      first = riseOf(v, m, top.velocity, -top.acceleration, curve_.fall, j);
      second = fallOf({v, -m}, to_, curve_);
      const double a = backwardsPeak(first);
      const double b = second.peak;
      const double slope = -((a - m) * ((v - square(m) / (2 * j)) / a + m / (2 * j)) +
                             (b - m) * ((v + square(m) / (2 * j)) / b - m / (2 * j))) /
                           j;
      return Value{released + riseDistance(first, j) + riseDistance(second, j), slope};
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
    writer_.add(cruise, 0, 0);
    addFall(writer_, second, j);
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
  const Curve& curve_;
  const double rest_;
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
  const Direct direct = directRamp(start, request.end_velocity, curve);
  writer.setSign(direct.sign);
  addApproach(writer, direct.way, curve);
}

void sCurveToPosition(Profile& profile, const Request& request, const Limits& limits) {
  const Curve curve = curveOf(limits);
  Motion start{request.velocity, request.acceleration};
  const double sign = start.acceleration < 0 ? -1 : 1;
  Writer writer(profile, sign);
  const double excess = dropExcess(start, curve);
  writer.add(excess, fabs(request.acceleration), -curve.jerk);
  const double distance =
      request.distance - jerkDistance({request.velocity, request.acceleration}, -sign * curve.jerk, excess);

  const Direct direct = directRamp(start, request.end_velocity, curve);
  const double more = distance - direct.sign * approachDistance(direct.way, curve);
  if (fabs(more) <= request.tolerance) {
    writer.setSign(direct.sign);
    addApproach(writer, direct.way, curve);
    return;
  }
  const double side = more > 0 ? 1 : -1;
  writer.setSign(side);
  Over(writer, {side * start.velocity, side * start.acceleration}, side * request.end_velocity, side * distance, curve)
      .plan();
}

}  // namespace rung::motion

// SPDX-License-Identifier: Apache-2.0
// The motion profiles of stdlib/motion beside Ruckig's: a number of seeded random requests of one axis, position and
// velocity interface, with and without limited jerk, target acceleration 0. In: the number and the seed; out: figures,
// exit code 1 when ours takes longer than 1 + 1e-9 times Ruckig's time, misses its target, breaks a limit that
// Ruckig's keeps, or costs more. Built and run by tests/bench/ruckig.sh.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <ruckig/ruckig.hpp>
#include <string>
#include <vector>

#include "profile.h"

namespace {

using namespace rung::motion;
using Clock = std::chrono::steady_clock;

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * (double(next() >> 11) * 0x1p-53); }
  double sign() { return next() & 1 ? 1 : -1; }
  bool chance(double p) { return uniform(0, 1) < p; }

 private:
  uint64_t next() {  // splitmix64
    uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  uint64_t state_;
};

enum Kind { PositionJerk, PositionOnly, VelocityJerk, VelocityOnly, Kinds };
const char* const names[Kinds] = {"position, limited jerk", "position, trapezoid", "velocity, limited jerk",
                                  "velocity, trapezoid"};

struct Request {
  Kind kind;
  State start;
  double position, end_velocity;
  Limits limits;

  bool isPosition() const { return kind == PositionJerk || kind == PositionOnly; }
  bool isJerkLimited() const { return kind == PositionJerk || kind == VelocityJerk; }
};

Request randomRequest(Random& random) {
  Request r{};
  r.kind = Kind(int(random.uniform(0, Kinds)));
  const auto magnitude = [&] { return std::exp(random.uniform(std::log(0.1), std::log(10))); };
  r.limits.velocity = magnitude();
  r.limits.acceleration = magnitude();
  r.limits.deceleration = random.chance(0.7) ? r.limits.acceleration : magnitude();
  r.limits.jerk = r.isJerkLimited() ? magnitude() * 2 : std::numeric_limits<double>::infinity();
  r.start.position = random.uniform(-5, 5);
  r.position = r.start.position + random.sign() * magnitude() * random.uniform(0, 2);
  const double beyond = random.chance(0.1) ? 1.5 : 1;  // one in ten starts may be beyond a limit
  if (!random.chance(0.2)) r.start.velocity = random.uniform(-beyond, beyond) * r.limits.velocity;
  if (r.isJerkLimited() && !random.chance(0.3))
    r.start.acceleration = random.uniform(-beyond, beyond) * r.limits.acceleration;
  if (!random.chance(0.5)) r.end_velocity = random.uniform(-1, 1) * r.limits.velocity;
  if (r.limits.deceleration != r.limits.acceleration) {  // mostly forward
    r.start.velocity = std::fabs(r.start.velocity);
    r.end_velocity = std::fabs(r.end_velocity);
    r.position = r.start.position + 3 * std::fabs(r.position - r.start.position);
  }
  return r;
}

ruckig::InputParameter<1> inputOf(const Request& r) {
  ruckig::InputParameter<1> input;
  input.control_interface = r.isPosition() ? ruckig::ControlInterface::Position : ruckig::ControlInterface::Velocity;
  input.current_position = {r.start.position};
  input.current_velocity = {r.start.velocity};
  input.current_acceleration = {r.start.acceleration};
  input.target_position = {r.position};
  input.target_velocity = {r.end_velocity};
  input.target_acceleration = {0};
  input.max_velocity = {r.limits.velocity};
  input.max_acceleration = {r.limits.acceleration};
  input.min_acceleration = {-r.limits.deceleration};
  input.max_jerk = {r.limits.jerk};
  return input;
}

Result planOf(Profile& profile, const Request& r) {
  const Ramp ramp = r.isJerkLimited() ? Ramp::Quadratic : Ramp::Trapezoid;
  return r.isPosition() ? planPosition(profile, r.start, r.position, r.end_velocity, r.limits, ramp)
                        : planVelocity(profile, r.start, r.end_velocity, r.limits, ramp);
}

// Extreme magnitudes on the way.
struct Peaks {
  double velocity = 0, acceleration = 0, jerk = 0;
  double least = 0;  // velocity

  void take(double duration, State& s, double j) {
    if (!(duration > 0)) return;
    velocity = std::max(velocity, std::fabs(s.velocity));
    acceleration = std::max(acceleration, std::fabs(s.acceleration));
    jerk = std::max(jerk, std::fabs(j));
    least = std::min(least, s.velocity);
    if (const double turn = -s.acceleration / j; j != 0 && turn > 0 && turn < duration) {
      velocity = std::max(velocity, std::fabs(s.velocity + s.acceleration * turn / 2));
      least = std::min(least, s.velocity + s.acceleration * turn / 2);
    }
    s = {s.position + duration * (s.velocity + duration * (s.acceleration / 2 + duration * j / 6)),
         s.velocity + duration * (s.acceleration + duration * j / 2), s.acceleration + duration * j};
    velocity = std::max(velocity, std::fabs(s.velocity));
    acceleration = std::max(acceleration, std::fabs(s.acceleration));
    least = std::min(least, s.velocity);
  }
};

// The state after the last phase goes to `end`.
Peaks peaksOf(const Profile& profile, State& end) {
  Peaks peaks;
  end = profile.start;
  for (int i = 0; i < profile.phase_count; ++i) {
    const Phase& phase = profile.phases[i];
    end.acceleration = phase.acceleration;
    if (phase.acceleration == 0 && phase.jerk == 0) end.velocity = profile.cruise;
    peaks.take(phase.duration, end, phase.jerk);
  }
  return peaks;
}

Peaks peaksOf(const ruckig::Profile& profile, const State& start) {
  Peaks peaks;
  State state = start;
  for (int i = 0; i < 2; ++i) {
    state.acceleration = i == 0 && profile.brake.j[0] != 0 ? state.acceleration : profile.brake.a[i];
    peaks.take(profile.brake.t[i], state, profile.brake.j[i]);
  }
  for (int i = 0; i < 7; ++i) {
    state = {profile.p[i], profile.v[i], profile.a[i]};
    peaks.take(profile.t[i], state, profile.j[i]);
  }
  return peaks;
}

struct Figures {
  long count = 0, refused = 0, unsolved = 0, different = 0, faster = 0, longer = 0, shorter = 0, missed = 0, broken = 0;
  double worst_ratio = 0, worst_miss = 0, worst_excess = 0;
  double ours_ns = 0, theirs_ns = 0;
};

void print(const char* what, const Request& r, double ours, double theirs) {
  std::printf(
      "%s: %s, start %.17g %.17g %.17g, target %.17g %.17g, limits %.17g %.17g %.17g: ours %.17g, Ruckig %.17g\n", what,
      names[r.kind], r.start.position, r.start.velocity, r.start.acceleration, r.position, r.end_velocity,
      r.limits.velocity, r.limits.acceleration, r.limits.jerk, ours, theirs);
}

double excess(double ours, double theirs, double limit) { return ours / std::max(theirs, limit) - 1; }

// Tells whether the start is beyond a limit, or will be when its acceleration goes to 0 at once.
bool isBeyond(const Request& r) {
  const double a = r.start.acceleration;
  const double rest = r.start.velocity + (r.isJerkLimited() ? a * std::fabs(a) / (2 * r.limits.jerk) : 0);
  return std::max(std::fabs(r.start.velocity), std::fabs(rest)) > r.limits.velocity ||
         std::fabs(a) > std::min(r.limits.acceleration, r.limits.deceleration);
}

void compare(const Request& r, const Profile& profile, const ruckig::Trajectory<1>& theirs, Figures& figures) {
  State end;
  const Peaks peaks = peaksOf(profile, end);
  const Peaks their_peaks = peaksOf(theirs.get_profiles()[0][0], r.start);
  // Ruckig's second limit holds for one direction, ours for falling speed: the same while neither goes back.
  const bool same = r.limits.acceleration == r.limits.deceleration || (peaks.least >= 0 && their_peaks.least >= 0);
  const double their_duration = theirs.get_duration();
  const double ratio = duration(profile) / (their_duration > 0 ? their_duration : 1e-12);
  const double slack = 1e-12;  // seconds: Ruckig's own tolerance of times
  if (!same) {
    ++figures.different;
  } else {
    if (duration(profile) > slack) figures.worst_ratio = std::max(figures.worst_ratio, ratio);
    if (duration(profile) > their_duration * (1 + 1e-9) + slack && figures.longer++ < 10) {
      print("longer", r, duration(profile), their_duration);
    }
    if (duration(profile) < their_duration * (1 - 1e-9) - slack) {
      ++figures.shorter;
      // Ruckig comes back from beyond a limit in a way of its own; otherwise there is nothing to gain.
      if (!isBeyond(r) && figures.faster++ < 10) print("shorter", r, duration(profile), their_duration);
    }
  }
  const double miss =
      std::max(r.isPosition() ? std::fabs(end.position - r.position) : 0, std::fabs(end.velocity - r.end_velocity));
  figures.worst_miss = std::max(figures.worst_miss, miss);
  const State last = at(profile, duration(profile));
  if (miss > 1e-8 || last.velocity != r.end_velocity || (r.isPosition() && last.position != r.position)) {
    if (figures.missed++ < 10) print("missed", r, end.position, end.velocity);
  }
  double over =
      excess(peaks.acceleration, their_peaks.acceleration, std::max(r.limits.acceleration, r.limits.deceleration));
  if (r.isPosition()) over = std::max(over, excess(peaks.velocity, their_peaks.velocity, r.limits.velocity));
  if (r.isJerkLimited()) over = std::max(over, excess(peaks.jerk, their_peaks.jerk, r.limits.jerk));
  figures.worst_excess = std::max(figures.worst_excess, over);
  if (over > 1e-12 && figures.broken++ < 10) print("limit", r, peaks.velocity, their_peaks.velocity);
}

double nanoseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::nano>(to - from).count();
}

}  // namespace

int main(int argc, char** argv) {
  const long count = argc > 1 ? std::atol(argv[1]) : 1000000;
  Random random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  constexpr int batch = 1000;
  Figures figures[Kinds];
  double worst_ns = 0;
  ruckig::Ruckig<1> otg;
  std::vector<Request> requests(batch);
  std::vector<Profile> ours(batch);
  std::vector<ruckig::Trajectory<1>> theirs(batch);
  std::vector<ruckig::InputParameter<1>> inputs(batch);
  std::vector<bool> solved(batch);
  for (long done = 0; done < count; done += batch) {
    for (int i = 0; i < batch; ++i) requests[i] = randomRequest(random);
    std::stable_sort(requests.begin(), requests.end(),
                     [](const Request& a, const Request& b) { return a.kind < b.kind; });
    for (int i = 0; i < batch; ++i) inputs[i] = inputOf(requests[i]);
    for (int begin = 0; begin < batch;) {  // one kind after the other, ours and theirs on the same requests
      int end = begin;
      while (end < batch && requests[end].kind == requests[begin].kind) ++end;
      Figures& f = figures[requests[begin].kind];
      const auto t0 = Clock::now();
      for (int i = begin; i < end; ++i) {
        if (planOf(ours[i], requests[i]) != Result::Ok) ++f.refused;
      }
      const auto t1 = Clock::now();
      for (int i = begin; i < end; ++i) solved[i] = otg.calculate(inputs[i], theirs[i]) >= 0;
      const auto t2 = Clock::now();
      f.ours_ns += nanoseconds(t0, t1);
      f.theirs_ns += nanoseconds(t1, t2);
      for (int i = begin; i < end; ++i) {
        ++f.count;
        if (solved[i]) {
          compare(requests[i], ours[i], theirs[i], f);
        } else {
          ++f.unsolved;  // Ruckig reports an error
        }
      }
      begin = end;
    }
    // Each request once more alone, the better of two: the worst without what else the machine does.
    for (int i = 0; i < batch; ++i) {
      double best = 1e300;
      for (int again = 0; again < 3; ++again) {
        const auto t0 = Clock::now();
        (void)planOf(ours[i], requests[i]);
        best = std::min(best, nanoseconds(t0, Clock::now()));
      }
      worst_ns = std::max(worst_ns, best);
    }
  }
  Figures sum;
  std::printf("%-24s %9s %8s %8s %8s %18s %10s %10s %9s %9s %6s\n", "", "requests", "refused", "longer", "shorter",
              "worst time ratio", "miss", "excess", "ours ns", "Ruckig ns", "ratio");
  for (int kind = 0; kind < Kinds; ++kind) {
    const Figures& f = figures[kind];
    std::printf("%-24s %9ld %8ld %8ld %8ld %18.12f %10.2g %10.2g %9.0f %9.0f %6.2f\n", names[kind], f.count, f.refused,
                f.longer, f.shorter, f.worst_ratio, f.worst_miss, f.worst_excess, f.ours_ns / double(f.count),
                f.theirs_ns / double(f.count), f.ours_ns / f.theirs_ns);
    sum.count += f.count;
    sum.refused += f.refused;
    sum.unsolved += f.unsolved;
    sum.different += f.different;
    sum.faster += f.faster;
    sum.longer += f.longer;
    sum.missed += f.missed;
    sum.broken += f.broken;
    sum.ours_ns += f.ours_ns;
    sum.theirs_ns += f.theirs_ns;
  }
  const double cost = sum.ours_ns / sum.theirs_ns;
  std::printf("all: %ld requests, ours %.0f ns, Ruckig %.0f ns, ratio %.2f, worst profile of ours %.0f ns\n", sum.count,
              sum.ours_ns / double(sum.count), sum.theirs_ns / double(sum.count), cost, worst_ns);
  std::printf(
      "%ld longer, %ld missed, %ld limits broken, %ld refused; %ld not comparable, %ld without a result of Ruckig's\n",
      sum.longer, sum.missed, sum.broken, sum.refused, sum.different, sum.unsolved);
  const bool right = sum.longer + sum.missed + sum.broken + sum.refused + sum.faster == 0;
  return right && cost <= 1.1 && worst_ns <= 10000 ? 0 : 1;
}

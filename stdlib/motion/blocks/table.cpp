// SPDX-License-Identifier: Apache-2.0
// Native body of AXIS_TABLE in profiles.st: positions, velocities or accelerations at given times. Between two points a
// position is a cubic with the slope of its neighbours, a velocity a smooth step, an acceleration a straight line.
#include "blocks/coupling.h"

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

enum Kind : uint8_t { kPositions, kVelocities, kAccelerations };

// Position and time of a point of a position table, from the begin; point 0 is where the axis was.
struct Point {
  double time, position;
};

Point pointOf(const AXIS_TABLE_type& table, int number) {
  Point point = {0, table.is_relative_ != 0 ? 0 : shown(*table.Axis_, table.start_position_)};
  for (int i = 0; i < number; ++i) {
    point.time += table.durations_[i];
    point.position = table.values_[i];
  }
  return point;
}

// The slope at a point: that between its neighbours, 0 at both ends.
double slopeAt(const AXIS_TABLE_type& table, int number) {
  if (number == 0 || number == table.count_) return 0;
  const Point before = pointOf(table, number - 1), after = pointOf(table, number + 1);
  return (after.position - before.position) / (after.time - before.time);
}

// The state `t` seconds after the begin of the segment.
State segmentAt(const AXIS_TABLE_type& table, double t) {
  const double duration = table.durations_[table.segment_], s = t / duration;
  const double value = table.values_[table.segment_];
  const double v0 = table.segment_velocity_, p0 = table.segment_position_;
  if (table.kind_ == kPositions) {
    const Point from = pointOf(table, table.segment_), to = pointOf(table, table.segment_ + 1);
    const double m0 = slopeAt(table, table.segment_) * duration, m1 = slopeAt(table, table.segment_ + 1) * duration;
    const double way = to.position - from.position;
    const double c2 = 3 * way - 2 * m0 - m1, c3 = m0 + m1 - 2 * way;
    return {p0 + s * (m0 + s * (c2 + s * c3)), (m0 + s * (2 * c2 + 3 * s * c3)) / duration,
            (2 * c2 + 6 * s * c3) / (duration * duration)};
  }
  if (table.kind_ == kVelocities) {
    const double change = value + (table.is_relative_ != 0 ? table.start_velocity_ : 0) - v0;
    return {p0 + duration * s * (v0 + change * s * s * (1 - s / 2)), v0 + change * s * s * (3 - 2 * s),
            change * 6 * s * (1 - s) / duration};
  }
  const double a0 = table.segment_acceleration_, change = value - a0;
  return {p0 + t * (v0 + t * (a0 / 2 + change * s / 6)), v0 + t * (a0 + change * s / 2), a0 + change * s};
}

void start(AXIS_TABLE_type& table, Call& call) {
  const Error error = refusal(table.Axis_);
  if (error != SMC_NO_ERROR_) return call.refuse(error);
  if (table.refused_ != 0) return call.refuse(static_cast<Error>(table.refused_));
  for (int i = 0; i < table.count_; ++i)
    if (!isFinite(table.values_[i]) || !isPositive(table.durations_[i]))
      return call.refuse(SMC_AXIS_NOT_READY_FOR_MOTION_);
  if (!isBufferMode(table.BufferMode_)) return call.refuse(SMC_AXIS_NOT_READY_FOR_MOTION_);
  Request request = {};
  request.kind_ = static_cast<uint8_t>(Motion::Follow);
  request.state_ = discrete_motion_;
  if (waitsInBuffer(table, call, request)) return;
  const State from = startState(call.axis());
  call.start(request, SMC_AXIS_NOT_READY_FOR_MOTION_);
  if (!call.isRunning()) return;
  table.segment_ = 0;
  table.tick_ = 0;
  table.over_ = 0;
  table.last_cycle_ = call.axis().cycle_ - 1;
  table.start_position_ = table.segment_position_ = from.position;
  table.start_velocity_ = table.segment_velocity_ = from.velocity;
  table.segment_acceleration_ = 0;
}

void run(AXIS_TABLE_type& table, Call& call) {
  Axis& axis = call.axis();
  if (table.last_cycle_ == axis.cycle_) return;
  table.last_cycle_ = axis.cycle_;
  ++table.tick_;
  double t = table.over_ + table.tick_ * axis.fTaskCycle_;
  while (table.segment_ < table.count_ && t >= table.durations_[table.segment_] - 1e-9 * axis.fTaskCycle_) {
    const double duration = table.durations_[table.segment_];
    const State end = segmentAt(table, duration);
    table.segment_position_ = end.position;
    table.segment_velocity_ = end.velocity;
    table.segment_acceleration_ = table.kind_ == kAccelerations ? end.acceleration : 0;
    t -= duration;
    table.over_ = t > 0 ? t : 0;
    t = table.over_;
    table.tick_ = 0;
    ++table.segment_;
  }
  if (table.segment_ < table.count_) return follow(axis, segmentAt(table, t));
  const double velocity = table.kind_ == kPositions ? 0 : table.segment_velocity_;
  follow(axis, {table.segment_position_ + velocity * t, velocity, 0});
  if (!call.isOwner()) return;
  release(axis);
  call.done();
}

}  // namespace

extern "C" {

void rung_sm3_basic_AXIS_TABLE(rung_context*, AXIS_TABLE_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises()) start(*self, call);
  takeOver(*self, call, start);
  if (call.follows()) {
    call.axis().supervised_ = call.axis().cycle_;
    run(*self, call);
  }
  call.run();
  self->Active_ = call.isOwner() ? 1 : 0;
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

}  // extern "C"

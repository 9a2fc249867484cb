// Slaves and masters: what gears and cams share. In: both axes; out: the master as the slave sees it.
#pragma once

#include "kernel/axis.h"

namespace rung::motion {

// The values of AXIS_REF_SM3.coupled.
enum Coupling : uint8_t { kNone, kGear, kCam };

inline State stateOf(const Axis& a) {
  return {a.position_ + a.extra_position_, a.velocity_ + a.extra_velocity_, a.acceleration_ + a.extra_acceleration_};
}

// The master as the slave sees it: shifted by MC_Phasing.
inline State masterOf(const Axis& master, Axis& slave) {
  const State set = stateOf(master), shift = phaseState(slave);
  return {set.position - shift.position, set.velocity - shift.velocity, set.acceleration - shift.acceleration};
}

inline void couple(Axis& slave, Axis& master, Coupling coupling) {
  slave.coupled_ = coupling;
  slave.coupled_master_ = reinterpret_cast<uintptr_t>(&master);
  slave.phase_owner_ = 0;
  slave.phase_base_position_ = slave.phase_position_ = 0;
  slave.phase_base_velocity_ = slave.phase_velocity_ = 0;
  slave.phase_base_acceleration_ = slave.phase_acceleration_ = 0;
}

inline Request followRequest(double deceleration) {
  Request request = {};
  request.kind_ = static_cast<uint8_t>(Motion::Follow);
  request.state_ = rung_sm3_basic::synchronized_motion_;
  request.deceleration_ = deceleration;  // with which it brakes after an error
  return request;
}

}  // namespace rung::motion

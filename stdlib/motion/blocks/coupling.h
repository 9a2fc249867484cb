// SPDX-License-Identifier: Apache-2.0
// Slaves and masters: what gears and cams share. In: both axes; out: the master as the slave sees it.
#pragma once

#include "kernel/axis.h"

namespace rung::motion {

// The values of AXIS_REF_SM3.coupled.
enum Coupling : uint8_t { kNone, kGear, kCam, kBacklash };

inline State stateOf(const Axis& a) {
  return {a.position_ + a.extra_.position_, a.velocity_ + a.extra_.velocity_, a.acceleration_ + a.extra_.acceleration_};
}

// The master as the slave sees it: shifted by MC_Phasing. A master without power is followed where it really is, so its
// velocity is the real one too.
inline State masterOf(const Axis& master, Axis& slave) {
  State set = stateOf(master);
  const State shift = phaseState(slave);
  if (!isPowered(master)) set.velocity += master.fActVelocity_;
  return {set.position - shift.position, set.velocity - shift.velocity, set.acceleration - shift.acceleration};
}

inline void couple(Axis& slave, Axis& master, Coupling coupling) {
  slave.coupled_ = coupling;
  slave.coupled_master_ = &master;
  slave.phase_ = {};
}

inline Request followRequest(double deceleration) {
  Request request = {};
  request.kind_ = static_cast<uint8_t>(Motion::Follow);
  request.state_ = rung_sm3_basic::synchronized_motion_;
  request.deceleration_ = deceleration;  // with which it brakes after an error
  return request;
}

// BufferMode of a block that follows a master, a table or a drive; PLCopen part 1, 2.4.2. What it does when its turn
// has come depends on where the axis is then, so it is begun as any other: at its edge, or when it takes over.
inline bool isBufferMode(int16_t mode) {
  using namespace rung_sm3_basic;
  return mode == Aborting_ || mode == Buffered_ || mode == BlendingPrevious_;
}

// True when the command waits for the one that moves the axis.
template <class Block>
bool waitsInBuffer(Block& block, Call& call, Request request) {
  block.waits_ = 0;
  if (!call.rises() || block.BufferMode_ == rung_sm3_basic::Aborting_ || call.axis().owner_ == 0) return false;
  request.buffer_mode_ = block.BufferMode_;
  call.start(request, rung_sm3_basic::SMC_AXIS_NOT_READY_FOR_MOTION_);
  block.waits_ = call.isRunning() ? 1 : 0;
  return true;
}

// Begins with `start` a command that has waited. One that is refused now gives the axis back.
template <class Block, class Start>
void takeOver(Block& block, Call& call, Start start) {
  if (block.waits_ == 0 || !call.follows()) return;
  start(block, call);
  if (!call.isRunning()) release(call.axis(), Outcome::Aborted);
}

// MC_GearOut and MC_CamOut: the slave keeps its velocity.
template <class Block>
void decouple(Block& block, Coupling coupling) {
  using namespace rung_sm3_basic;
  Call call(block.Slave_, block.command_, block.Execute_ != 0);
  if (call.rises()) {
    Axis& slave = call.axis();
    if (slave.nAxisState_ != synchronized_motion_ || slave.coupled_ != coupling) {
      call.refuse(SMC_AXIS_NOT_READY_FOR_MOTION_);
    } else {
      release(slave, Outcome::Aborted);
      call.launch();
      call.done();
    }
  }
  block.Done_ = call.is(Outcome::Done) ? 1 : 0;
  call.show(block.Busy_, block.Error_, block.ErrorID_);
}

}  // namespace rung::motion

// SPDX-License-Identifier: Apache-2.0
// Native bodies of cam.st: a slave follows a master by a table (cam/table). The table is read in each cycle, so the
// points may change at any time; everything else of it is what MC_CamTableSelect has taken.
//
// In a table the master has positions from StartMaster to EndMaster: x = table_zero + master_scale * (master -
// master_zero). Where it leaves them, a periodic cam moves table_zero by the width, and slave_zero by what the slave
// has gained.
#include <math.h>

#include "blocks/cam_table.h"
#include "blocks/coupling.h"
#include "blocks/tappets.h"

using namespace rung_sm3_basic;
using namespace rung::motion;
namespace cam = rung::cam;

namespace {

Tappets tappetsOfBlock(MC_CamIn_type& block) { return {block.cam_, block.tappet_state_, block.Tappets_}; }

bool isSame(const CamId& a, const CamId& b) {
  return a.pCT_ == b.pCT_ && a.serial_ == b.serial_ && a.Periodic_ == b.Periodic_ &&
         a.MasterAbsolute_ == b.MasterAbsolute_ && a.SlaveAbsolute_ == b.SlaveAbsolute_ &&
         a.table_.elements_ == b.table_.elements_ && a.table_.count_ == b.table_.count_;
}

// ---- coupling

bool isAbsolute(const MC_CamIn_type& block) { return block.cam_.SlaveAbsolute_ != 0 && block.mode_ != relative_; }

double tableX(const MC_CamIn_type& block, const State& master) {
  return block.table_zero_ + block.master_scale_ * (master.position - block.master_zero_);
}

// The set values for a master in the table, without the ramp.
bool slaveAt(MC_CamIn_type& block, double x, const State& master, State& slave) {
  cam::Value value = {};
  if (!cam::at(tableOf(block.cam_), x, block.segment_, value)) return false;
  const double velocity = block.master_scale_ * master.velocity;
  slave.position = block.slave_zero_ + block.slave_scale_ * value.position + block.slave_shift_;
  slave.velocity = block.slave_scale_ * value.slope * velocity;
  slave.acceleration = block.slave_scale_ * (value.curvature * velocity * velocity +
                                             value.slope * block.master_scale_ * master.acceleration);
  return isFinite(slave.position) && isFinite(slave.velocity) && isFinite(slave.acceleration);
}

Error camInError(const MC_CamIn_type& block) {
  if (block.Master_ == block.Slave_ || !isAxis(block.Master_)) return SMC_AXIS_IS_NO_AXIS_REF_;
  const MC_CAM_REF_type* const cam = static_cast<const MC_CAM_REF_type*>(block.CamTableID_.pCT_);
  if (cam == nullptr) return SMC_CI_NO_CAM_SELECTED_;
  if (!isCam(cam) || block.CamTableID_.table_.elements_ == nullptr) return SMC_NO_CAM_REF_TYPE_;
  if (!isPositive(block.MasterScaling_) || !isPositive(block.SlaveScaling_) || !isFinite(block.MasterOffset_) ||
      !isFinite(block.SlaveOffset_))
    return SMC_CI_SCALING_INCORRECT_;
  if (block.StartMode_ < absolute_ || block.StartMode_ > ramp_in_neg_) return SMC_AXIS_NOT_READY_FOR_MOTION_;
  if (block.StartMode_ >= ramp_in_ && (!isPositive(block.VelocityDiff_) || !isPositive(block.Acceleration_) ||
                                       !isPositive(block.Deceleration_) || block.Jerk_ < 0 || !isFinite(block.Jerk_)))
    return SMC_CI_RAMPIN_NEEDS_VELACC_VALUES_;
  return SMC_NO_ERROR_;
}

// Where in the table the master is. `goes_on`: another table takes over, and the master stays where it is.
Error placeMaster(MC_CamIn_type& block, const State& master, bool goes_on, double present) {
  const double start = block.cam_.StartMaster_, end = block.cam_.EndMaster_;
  double x = start + block.MasterOffset_;
  if (block.cam_.MasterAbsolute_ != 0)
    x = block.MasterScaling_ * shown(*block.Master_, master.position) + block.MasterOffset_;
  else if (goes_on)
    x = present;
  if (block.cam_.Periodic_ != 0)
    x = wrapped(x, start, end);
  else if (!(x >= start && x <= end))
    return SMC_CI_MASTER_OUT_OF_SCALE_;
  block.master_scale_ = block.MasterScaling_;
  block.master_zero_ = master.position;
  block.table_zero_ = x;
  return SMC_NO_ERROR_;
}

// The difference between the slave and what the cam demands, at the begin of the cycle; on a modulo slave less turns.
double turnsBetween(const Axis& slave, double difference, int16_t mode) {
  const double turn = period(slave);
  if (turn == 0) return 0;
  const double turns = -difference / turn;  // the way to go
  if (mode == ramp_in_pos_) return floor(turns + 1e-9) * turn;
  if (mode == ramp_in_neg_) return ceil(turns - 1e-9) * turn;
  return floor(turns + 0.5) * turn;
}

Error placeSlave(MC_CamIn_type& block, Axis& slave, const State& master, double slave_zero) {
  const State from = startState(slave);
  block.slave_scale_ = block.SlaveScaling_;
  block.slave_shift_ = block.SlaveOffset_;
  block.slave_zero_ = isAbsolute(block) ? inner(slave, 0) : slave_zero;
  State demanded = {};
  if (!slaveAt(block, block.table_zero_, master, demanded)) return SMC_CAM_TABLE_DOES_NOT_COVER_MASTER_SCALE_;
  // What is demanded now is for the end of the cycle.
  const double cycle = slave.fTaskCycle_;
  const double position = demanded.position - cycle * (demanded.velocity - cycle * demanded.acceleration / 2);
  const double velocity = demanded.velocity - cycle * demanded.acceleration;
  const bool ramps = block.mode_ >= ramp_in_;
  double difference = from.position - position;
  if (isAbsolute(block) || ramps) {
    const double turns = turnsBetween(slave, difference, block.mode_);
    block.slave_zero_ -= turns;
    difference += turns;
  }
  block.is_ramping_ = ramps ? 1 : 0;
  if (!ramps) return SMC_NO_ERROR_;
  Request request = {};
  request.kind_ = static_cast<uint8_t>(Motion::Position);
  request.velocity_ = block.VelocityDiff_;
  request.acceleration_ = block.Acceleration_;
  request.deceleration_ = block.Deceleration_;
  request.jerk_ = block.Jerk_;
  Profile& ramp = *reinterpret_cast<Profile*>(block.ramp_);
  block.ramp_cycle_ = slave.cycle_;
  const State begin = {difference, from.velocity - velocity, from.acceleration - demanded.acceleration};
  return plan(slave, request, begin, ramp) == Result::Ok ? SMC_NO_ERROR_ : SMC_CI_RAMPIN_NEEDS_VELACC_VALUES_;
}

void startCam(MC_CamIn_type& block, Call& call) {
  Axis& slave = call.axis();
  Error error = refusal(&slave);
  if (error == SMC_NO_ERROR_) error = camInError(block);
  if (error == SMC_NO_ERROR_ && !isBufferMode(block.BufferMode_)) error = SMC_AXIS_NOT_READY_FOR_MOTION_;
  if (error != SMC_NO_ERROR_) return call.refuse(error);
  if (!call.isOwner() && waitsInBuffer(block, call, followRequest(block.Deceleration_))) return;
  block.waits_ = 0;
  const bool is_owner = call.isOwner() && slave.coupled_master_ == block.Master_;
  const bool switches = is_owner && !isSame(block.cam_, block.CamTableID_);
  const State master = is_owner ? masterOf(*block.Master_, slave) : stateOf(*block.Master_);
  MC_CamIn_type next = block;  // a refused start changes nothing
  next.cam_ = block.CamTableID_;
  next.mode_ = block.StartMode_;
  next.segment_ = 0;
  error = placeMaster(next, master, switches, switches ? tableX(block, master) : 0);
  const bool keeps_zero = switches && !isAbsolute(block) && !isAbsolute(next);
  if (error == SMC_NO_ERROR_)
    error = placeSlave(next, slave, master,
                       keeps_zero ? block.slave_zero_ + slave.extra_.base_position_ : startState(slave).position);
  if (error != SMC_NO_ERROR_) return call.refuse(error);
  next.tappet_state_.hysteresis_ = block.TappetHysteresis_ > 0 ? block.TappetHysteresis_ * next.master_scale_ : 0;
  next.was_inside_ = next.is_over_ = 0;
  next.end_cycle_ = slave.cycle_ - 1;
  next.tappet_state_.is_fresh_ = 1;
  block = next;
  tappetsOfBlock(block).reset(slave);
  // A new start takes what is superimposed into the position, as a new command does.
  if (is_owner) return mergeExtra(slave);
  call.start(followRequest(block.Deceleration_), SMC_AXIS_NOT_READY_FOR_MOTION_);
  couple(slave, *block.Master_, kCam);
}

// ---- the end of a table

bool positionAt(const CamId& id, double x, double& position) {
  int32_t segment = id.table_.count_ - 2;
  cam::Value value = {};
  if (!cam::at(tableOf(id), x, segment, value)) return false;
  position = value.position;
  return true;
}

// A periodic cam begins again, or the one at the input takes over. `back`: the master has left the table at its start.
bool beginPeriod(MC_CamIn_type& block, const Axis& slave, bool back) {
  const CamId was = block.cam_;
  const bool was_absolute = isAbsolute(block);
  const bool switches = camInError(block) == SMC_NO_ERROR_ && !isSame(was, block.CamTableID_);
  double from = 0, to = 0;  // the slave where it leaves the table, and where it enters
  if (!positionAt(was, back ? was.StartMaster_ : was.EndMaster_, from)) return false;
  if (switches) block.cam_ = block.CamTableID_;
  if (!positionAt(block.cam_, back ? block.cam_.EndMaster_ : block.cam_.StartMaster_, to)) return false;
  const double shift = back ? block.cam_.EndMaster_ - was.StartMaster_ : block.cam_.StartMaster_ - was.EndMaster_;
  block.table_zero_ += shift;
  tappetsOfBlock(block).shift(shift);
  block.end_cycle_ = slave.cycle_;
  if (switches) tappetsOfBlock(block).refresh();
  if (!isAbsolute(block)) {
    // In the positive direction the whole end position is gained, so a cam that does not begin at 0 jumps.
    block.slave_zero_ += block.slave_scale_ * (back ? -to : from);
    return true;
  }
  const double turn = period(slave), gained = block.slave_scale_ * (from - to);
  if (!was_absolute) block.slave_zero_ = inner(slave, 0);
  if (turn > 0) block.slave_zero_ += turn * floor(gained / turn + 0.5);
  return true;
}

// The slave leaves a cam that does not repeat: it rests, or goes on where the cam has a slope.
void endCam(MC_CamIn_type& block, Call& call, double x, const State& master) {
  Axis& slave = call.axis();
  const double edge = x >= block.cam_.EndMaster_ ? block.cam_.EndMaster_ : block.cam_.StartMaster_;
  State state = {};
  if (!slaveAt(block, edge, master, state)) return fail(slave, SMC_CAM_TABLE_DOES_NOT_COVER_MASTER_SCALE_);
  tappetsOfBlock(block).move(edge);
  const double velocity = block.master_scale_ * master.velocity;
  if (velocity != 0) state.position += state.velocity * (x - edge) / velocity;
  state.acceleration = 0;
  follow(slave, state);
  if (!call.isOwner() || slave.owner_ == 0) return;
  release(slave);
  call.done();
  block.is_over_ = 1;
}

// ---- the cycle

void addRamp(MC_CamIn_type& block, const Axis& slave, State& state) {
  const Profile& ramp = *reinterpret_cast<const Profile*>(block.ramp_);
  const double t = (slave.cycle_ - block.ramp_cycle_ + 1) * slave.fTaskCycle_;
  if (t >= duration(ramp) - 1e-9 * slave.fTaskCycle_) {
    block.is_ramping_ = 0;
    return;
  }
  const State rest = at(ramp, t);
  state.position += rest.position;
  state.velocity += rest.velocity;
  state.acceleration += rest.acceleration;
}

void runCam(MC_CamIn_type& block, Call& call) {
  Axis& slave = call.axis();
  slave.supervised_ = slave.cycle_;
  block.Master_->master_called_ = block.Master_->cycle_;
  State master = masterOf(*block.Master_, slave);
  double x = tableX(block, master);
  if (!(fabs(x - block.cam_.StartMaster_) <= kMostPeriods * (block.cam_.EndMaster_ - block.cam_.StartMaster_)))
    return fail(slave, SMC_CI_MASTER_OUT_OF_SCALE_);
  while (block.cam_.Periodic_ != 0 && (x >= block.cam_.EndMaster_ || x < block.cam_.StartMaster_)) {
    if (!beginPeriod(block, slave, x < block.cam_.StartMaster_))
      return fail(slave, SMC_CAM_TABLE_DOES_NOT_COVER_MASTER_SCALE_);
    x = tableX(block, master);
  }
  if (x >= block.cam_.EndMaster_ || (x < block.cam_.StartMaster_ && block.was_inside_ != 0))
    return endCam(block, call, x, master);
  if (x > block.cam_.StartMaster_) block.was_inside_ = 1;
  if (x < block.cam_.StartMaster_) {  // it waits for the master
    x = block.cam_.StartMaster_;
    master.velocity = master.acceleration = 0;
  }
  State state = {};
  if (!slaveAt(block, x, master, state)) return fail(slave, SMC_CAM_TABLE_DOES_NOT_COVER_MASTER_SCALE_);
  tappetsOfBlock(block).move(x);
  if (block.is_ramping_ != 0) addRamp(block, slave, state);
  follow(slave, state);
}

}  // namespace

extern "C" {

void rung_sm3_basic_MC_CamTableSelect(rung_context*, MC_CamTableSelect_type* self) {
  Call call(self->Slave_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    CamId id = {};
    const bool are_axes = self->Master_ != self->Slave_ && isAxis(self->Master_);
    const Error error = are_axes ? select(self->CamTable_, id) : SMC_AXIS_IS_NO_AXIS_REF_;
    if (error != SMC_NO_ERROR_) {
      call.refuse(error);
    } else {
      id.Periodic_ = self->Periodic_;
      id.MasterAbsolute_ = self->MasterAbsolute_;
      id.SlaveAbsolute_ = self->SlaveAbsolute_;
      id.serial_ = ++self->serials_;
      self->CamTableID_ = id;
      call.launch();
      call.done();
    }
  }
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_MC_CamIn(rung_context*, MC_CamIn_type* self) {
  Call call(self->Slave_, self->command_, self->Execute_ != 0);
  if (call.rises()) startCam(*self, call);
  if (isAxis(self->Slave_)) tappetsOfBlock(*self).run(*self->Slave_);
  takeOver(*self, call, startCam);
  if (call.follows()) runCam(*self, call);
  if (call.follows() && self->end_cycle_ == self->Slave_->cycle_) handOver(*self->Slave_, Outcome::Aborted);
  call.run();
  self->Active_ = call.isOwner() ? 1 : 0;
  const bool ends =
      call.isOwner() ? self->end_cycle_ == self->Slave_->cycle_ : call.is(Outcome::Done) && self->is_over_ != 0;
  self->InSync_ = self->Execute_ != 0 && call.isOwner() && self->is_ramping_ == 0 ? 1 : 0;
  self->EndOfProfile_ = self->Execute_ != 0 && ends ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_MC_CamOut(rung_context*, MC_CamOut_type* self) { decouple(*self, kCam); }

}  // extern "C"

// SPDX-License-Identifier: Apache-2.0
// The cycle of an axis: its drive, its power, its errors. In: process data, requests of MC_Power; out: actual values,
// states, and set values to the drive. TM/TP manual 3.1; IEC 61800-7-201.
#include <math.h>

#include "drive/drive.h"
#include "drive/rounding.h"
#include "kernel/axis.h"

namespace rung::motion {
namespace {

using namespace rung_sm3_basic;

static_assert(sizeof(RUNG_DRIVE_type) == sizeof(rung_drive), "layout of rung/motion.h");

rung_drive& driveOf(Axis& a) { return reinterpret_cast<rung_drive&>(a.drive_); }

enum Status : uint16_t { kFaultBit = 0x08, kStateMask = 0x6F, kEnabled = 0x27 };

bool hasDrive(const Axis& a) { return a.bVirtual_ == 0; }

// The end of the last cycle is the begin of this one.
void commit(Axis& a) {
  if (a.advanced_ == a.cycle_) {
    ++a.tick_;
    ++a.extra_.tick_;
    ++a.phase_.tick_;
  }
  ++a.cycle_;
  a.set_acceleration_ = a.fSetAcceleration_;
  a.base_position_ = a.position_;
  a.base_velocity_ = a.velocity_;
  a.base_acceleration_ = a.acceleration_;
  Added* const added_motions[] = {&a.extra_, &a.phase_};
  for (Added* const added : added_motions) {
    added->base_position_ = added->position_;
    added->base_velocity_ = added->velocity_;
    added->base_acceleration_ = added->acceleration_;
  }
}

// The interval of the task; in tests, and for tasks without one, fTaskCycle as it is or the time that has passed.
void takeTaskCycle(const rung_context* ctx, Axis& a) {
  const int64_t passed = ctx->now_ns - a.now_;
  a.now_ = ctx->now_ns;
  if (ctx->task == 0 || ctx->task > ctx->module->tasks.count) return;
  const rung_task& task = *rung_task_at(ctx->module, ctx->task - 1);
  if (task.interval_ns > 0)
    a.fTaskCycle_ = static_cast<double>(task.interval_ns) / 1e9;
  else if (a.cycle_ > 1 && passed > 0)
    a.fTaskCycle_ = static_cast<double>(passed) / 1e9;
}

void receive(const rung_context* ctx, Axis& a) {
  rung_drive& drive = driveOf(a);
  const rung_drives* const host = ctx->host == nullptr ? nullptr : ctx->host->drives;
  a.host_drive_ = host != nullptr && host->receive(ctx->host->drives_data, &drive, ctx->now_ns) ? 1 : 0;
  if (a.host_drive_ == 0 && a.bBoundDrive_ == 0) stepDrive(a.simulation_, drive, a.fTaskCycle_);
}

double scale(const Axis& a) { return a.fScalefactor_ != 0 ? a.fScalefactor_ : 1; }

void takeActualValues(Axis& a) {
  if (!hasDrive(a)) {
    a.bCommunication_ = 1;
    a.actual_position_ = a.position_ + a.extra_.position_;
    a.fActVelocity_ = a.fSetVelocity_;
    a.fActPosition_ = shown(a, a.actual_position_);
    return;
  }
  const rung_drive& drive = driveOf(a);
  a.bCommunication_ = drive.communication != 0 ? 1 : 0;
  if (a.bCommunication_ == 0) return;
  if (a.drive_known_ == 0) {
    a.drive_total_ = drive.position;
    a.drive_known_ = 1;
  } else {
    a.drive_total_ +=
        static_cast<int32_t>(static_cast<uint32_t>(drive.position) - static_cast<uint32_t>(a.drive_position_));
  }
  a.drive_position_ = drive.position;
  a.actual_position_ = static_cast<double>(a.drive_total_) / scale(a);
  a.fActPosition_ = shown(a, a.actual_position_);
  a.fActVelocity_ = drive.velocity / scale(a);
  a.fActTorque_ = drive.torque * a.fFactorTor_;
}

// Without power the set values are where the axis is.
void followActual(Axis& a) {
  a.request_.kind_ = static_cast<uint8_t>(Motion::None);
  a.base_position_ = a.position_ = a.actual_position_;
  a.base_velocity_ = a.velocity_ = a.base_acceleration_ = a.acceleration_ = 0;
  a.extra_ = {};
  a.fSetPosition_ = a.fActPosition_;
  a.fSetVelocity_ = a.fSetAcceleration_ = a.fSetJerk_ = 0;
}

void takePower(Axis& a) {
  const bool was = a.bRegulatorRealState_ != 0;
  if (hasDrive(a)) {
    const uint16_t status = driveOf(a).statusword;
    const bool enabled = a.bCommunication_ != 0 && (status & kStateMask) == kEnabled && a.eConfiguration_ == complete_;
    a.bRegulatorRealState_ = enabled ? 1 : 0;
    a.bDriveStartRealState_ = enabled && a.bDriveStart_ != 0 ? 1 : 0;
    if (was && a.bCommunication_ == 0 && a.nAxisState_ != errorstop_) fail(a, SMC_DI_GENERAL_COMMUNICATION_ERROR_);
    if (a.bCommunication_ != 0 && (status & kFaultBit) != 0 && a.nAxisState_ != errorstop_) fail(a, SMC_DI_AXIS_ERROR_);
  } else {
    a.bRegulatorRealState_ = a.bRegulatorOn_;
    a.bDriveStartRealState_ = a.bRegulatorOn_ != 0 && a.bDriveStart_ != 0 ? 1 : 0;
  }
  if (a.bRegulatorRealState_ == 0) {
    const bool was_commanded = a.owner_ != 0 || (was && isMoving(a));
    if (a.nAxisState_ != errorstop_ && was_commanded) fail(a, SMC_FB_ACTIVE_AXIS_DISABLED_);
    if (a.nAxisState_ != errorstop_) a.nAxisState_ = power_off_;
    a.lock_ = 0;
    return followActual(a);
  }
  if (a.nAxisState_ != power_off_) return;
  a.nAxisState_ = standstill_;
  followActual(a);
}

void watchDrive(Axis& a) {
  if (!hasDrive(a) || a.nAxisState_ == errorstop_ || a.bRegulatorRealState_ == 0) return;
  const uint32_t inputs = driveOf(a).digital_inputs;
  const double forward = a.fSetVelocity_ * scale(a);
  const bool at_limit = ((inputs & 1) != 0 && forward < 0) || ((inputs & 2) != 0 && forward > 0);
  if (a.bHWLimitEnable_ != 0 && at_limit && a.nAxisState_ != homing_) return fail(a, SMC_DI_HWLIMITS_EXCEEDED_);
  const double lag = a.position_ + a.extra_.position_ - a.actual_position_;
  if (a.bPosLagMonitoring_ != 0 && a.eControllerMode_ == SMC_position_ && a.homing_ == 0 &&
      fabs(lag) > a.fMaxPositionLag_)
    fail(a, SMC_DI_POSITIONLAGERROR_);
}

double brakeDeceleration(const Axis& a, Error error) {
  if (error == SMC_DI_SWLIMITS_EXCEEDED_ && a.fSWLimitDeceleration_ > 0) return a.fSWLimitDeceleration_;
  if (a.fMaxDeceleration_ > 0) return a.fMaxDeceleration_;
  return a.request_.deceleration_;
}

// Brakes without an owner, from the end of this cycle where its set values are known, else from its begin.
void brake(Axis& a, double deceleration) {
  const bool known = a.advanced_ == a.cycle_;
  const State from =
      known ? State{a.position_ + a.extra_.position_, a.velocity_ + a.extra_.velocity_, 0}
            : State{a.base_position_ + a.extra_.base_position_, a.base_velocity_ + a.extra_.base_velocity_, 0};
  a.extra_ = {};
  a.base_position_ = a.position_ = from.position;
  a.base_velocity_ = a.velocity_ = from.velocity;
  a.request_.kind_ = static_cast<uint8_t>(Motion::None);
  if (from.velocity == 0) return;
  if (deceleration > 0) {
    a.request_.kind_ = static_cast<uint8_t>(Motion::Brake);
    a.request_.end_velocity_ = 0;
    a.request_.velocity_ = fabs(from.velocity);
    a.request_.acceleration_ = a.request_.deceleration_ = deceleration;
    a.request_.jerk_ = 0;
    a.begun_ = 0;
    a.tick_ = known ? -1 : 0;
    Profile& profile = *reinterpret_cast<Profile*>(a.profile_);
    if (plan(a, a.request_, from, profile) == Result::Ok) return;
    a.request_.kind_ = static_cast<uint8_t>(Motion::None);
  }
  a.velocity_ = a.acceleration_ = a.base_velocity_ = a.base_acceleration_ = 0;
  a.fSetVelocity_ = a.fSetAcceleration_ = 0;
}

void endCommands(Axis& a, Error error) {
  a.failed_[0] = a.owner_;
  a.failed_[1] = a.extra_.owner_;
  a.failed_[2] = a.phase_.owner_;
  for (size_t i = 0; i < kMostWaiting; ++i) a.failed_[3 + i] = i < a.waiting_count_ ? a.waiting_[i].owner_ : 0;
  a.failed_error_ = error;
  a.owner_ = a.extra_.owner_ = a.phase_.owner_ = 0;
  a.waiting_count_ = 0;
  a.coupled_ = 0;
  a.coupled_master_ = nullptr;
  a.homing_ = 0;
  a.mode_wanted_ = driveMode(a.eControllerMode_);
}

// The quick stop that MC_Power asks for with bDriveStart FALSE.
void stopWithoutRelease(Axis& a) {
  if (a.bDriveStartRealState_ != 0 || a.nAxisState_ < stopping_ || a.nAxisState_ == standstill_ || a.owner_ == 0)
    return;
  endCommands(a, SMC_REGULATOR_OR_START_NOT_SET_);
  a.lock_ = 0;
  a.nAxisState_ = stopping_;
  brake(a, brakeDeceleration(a, SMC_NO_ERROR_));
}

// The command of CiA 402 that is next on the way to the wanted state.
uint16_t controlword(const Axis& a) {
  const uint16_t status = a.drive_.statusword_;
  const bool is_prepared = a.eConfiguration_ == complete_ || a.eConfiguration_ == unknown_;
  const bool wants = a.bRegulatorOn_ != 0 && is_prepared;
  if ((status & kFaultBit) != 0) return a.reset_request_ != 0 ? 0x80 : 0;
  if ((status & 0x4F) == 0x40) return wants ? 0x06 : 0;
  switch (status & kStateMask) {
    case 0x21: return wants ? 0x07 : 0;
    case 0x23: return wants ? 0x0F : 0x06;
    case kEnabled: return wants ? static_cast<uint16_t>(a.homing_ != 0 ? 0x1F : 0x0F) : 0x06;
    case 0x07: return 0;  // quick stop active
    default: return 0;
  }
}

void send(const rung_context* ctx, Axis& a) {
  rung_drive& drive = driveOf(a);
  drive.controlword = controlword(a);
  drive.mode = a.mode_wanted_ != 0 ? a.mode_wanted_ : int8_t{8};
  const double target = (a.position_ + a.extra_.position_) * scale(a);
  drive.target_position = static_cast<int32_t>(static_cast<uint64_t>(rounded(target)));  // it wraps
  drive.target_velocity = static_cast<int32_t>(rounded(a.fSetVelocity_ * scale(a), 2147483647.0));
  const double torque = a.fFactorTor_ != 0 ? a.fSetTorque_ / a.fFactorTor_ : 0;
  drive.target_torque = static_cast<int16_t>(rounded(torque, 32767.0));
  if (a.host_drive_ != 0) ctx->host->drives->send(ctx->host->drives_data, &drive, ctx->now_ns);
}

}  // namespace

int8_t driveMode(int16_t controller_mode) {
  switch (static_cast<SMC_CONTROLLER_MODE_type>(controller_mode)) {
    case SMC_torque_: return 10;
    case SMC_velocity_: return 9;
    case SMC_position_: return 8;
    case SMC_current_: return 0;
  }
  return 0;
}

bool isPowered(const Axis& axis) { return axis.bRegulatorRealState_ != 0; }

bool isMoving(const Axis& axis) { return axis.owner_ != 0 || axis.extra_.owner_ != 0 || axis.fSetVelocity_ != 0; }

void fail(Axis& a, Error error) {
  endCommands(a, error);
  a.lock_ = 0;
  a.nAxisState_ = errorstop_;
  a.bError_ = 1;
  a.dwErrorID_ = static_cast<uint32_t>(error);
  brake(a, brakeDeceleration(a, error));
}

void beforeTask(const rung_context* ctx, Axis& a) {
  commit(a);
  takeTaskCycle(ctx, a);
  if (hasDrive(a)) receive(ctx, a);
  takeActualValues(a);
  configure(ctx, a);
  takePower(a);
  watchDrive(a);
  stopWithoutRelease(a);
  if (isPowered(a) && a.owner_ == 0 && a.extra_.owner_ == 0) advance(a);
}

void afterTask(const rung_context* ctx, Axis& a) {
  if (a.owner_ != 0 && a.supervised_ != a.cycle_) fail(a, SMC_FB_WASNT_CALLED_DURING_MOTION_);
  if (a.bRegulatorRealState_ != 0) advance(a);
  if (hasDrive(a)) send(ctx, a);
}

}  // namespace rung::motion

extern "C" {

void rung_sm3_basic_AXIS_REF_SM3__BeforeTask(rung_context* ctx, rung_sm3_basic::AXIS_REF_SM3_type* self) {
  rung::motion::beforeTask(ctx, *self);
}

void rung_sm3_basic_AXIS_REF_SM3__AfterTask(rung_context* ctx, rung_sm3_basic::AXIS_REF_SM3_type* self) {
  rung::motion::afterTask(ctx, *self);
}

}  // extern "C"

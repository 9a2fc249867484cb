// SPDX-License-Identifier: Apache-2.0
// Native bodies of parameters.st: parameters of the axis by the numbers of PLCopen part 1 and CODESYS, and objects of
// the drive through its service channel, which one block uses at a time.
#include "kernel/axis.h"

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

enum class Access : uint8_t { Read, Write };
enum class Found : uint8_t { Yes, No };

// Reads or writes a parameter of the axis. What only the axis sets cannot be written.
Found parameter(Axis& a, int32_t number, Access access, double& value) {
  const auto variable = [&](double& of) {
    if (access == Access::Read)
      value = of;
    else
      of = value;
    return Found::Yes;
  };
  const auto flag = [&](uint8_t& of) {
    if (access == Access::Read)
      value = of != 0 ? 1 : 0;
    else
      of = value != 0 ? 1 : 0;
    return Found::Yes;
  };
  switch (number) {
    case 2: return variable(a.fSWLimitPositive_);
    case 3: return variable(a.fSWLimitNegative_);
    case 4:
    case 5: return flag(a.bSWLimitEnable_);
    case 6: return flag(a.bPosLagMonitoring_);
    case 7: return variable(a.fMaxPositionLag_);
    case 8:
    case 9: return variable(a.fMaxVelocity_);
    case 12:
    case 13: return variable(a.fMaxAcceleration_);
    case 14:
    case 15: return variable(a.fMaxDeceleration_);
    case 16:
    case 17: return variable(a.fMaxJerk_);
    default: break;
  }
  if (access == Access::Write) return Found::No;
  switch (number) {
    case 1: value = a.fSetPosition_; return Found::Yes;
    case 10: value = a.fActVelocity_; return Found::Yes;
    case 11: value = a.fSetVelocity_; return Found::Yes;
    case 1000: value = a.nAxisState_; return Found::Yes;
    case 1010: value = a.bRegulatorOn_; return Found::Yes;
    case 1011: value = a.bDriveStart_; return Found::Yes;
    case 1012: value = a.bCommunication_; return Found::Yes;
    case 1015: value = a.bRegulatorRealState_; return Found::Yes;
    case 1016: value = a.bDriveStartRealState_; return Found::Yes;
    case 1025: value = a.fTaskCycle_; return Found::Yes;
    case 1030: value = a.bError_; return Found::Yes;
    case 1031: value = a.dwErrorID_; return Found::Yes;
    default: return Found::No;
  }
}

bool isSigned(uint16_t index) {
  switch (index) {
    case 0x605A:
    case 0x605B:
    case 0x605C:
    case 0x605D:
    case 0x605E:
    case 0x6060:
    case 0x6061:
    case 0x6062:
    case 0x6064:
    case 0x606C:
    case 0x6071:
    case 0x6074:
    case 0x6077:
    case 0x607A:
    case 0x607C:
    case 0x607D:
    case 0x6098:
    case 0x60B0:
    case 0x60B1:
    case 0x60B2:
    case 0x60BA:
    case 0x60BB:
    case 0x60BC:
    case 0x60BD:
    case 0x60F4:
    case 0x60FF: return true;
    default: return false;
  }
}

double valueOf(const AXIS_OBJECT_ACCESS_type& access) {
  const unsigned bits = access.length_ * 8u;
  if (!isSigned(access.index_) || bits > 32) return access.value_;
  return static_cast<int32_t>(access.value_ << (32 - bits)) >> (32 - bits);
}

// ParameterNumber < 0. False when it does not name an object.
bool prepare(AXIS_OBJECT_ACCESS_type& access, int32_t number, Access kind, double value) {
  const auto code = static_cast<uint32_t>(-static_cast<int64_t>(number));
  access.length_ = static_cast<uint8_t>(code >> 24);
  access.index_ = static_cast<uint16_t>(code >> 8);
  access.subindex_ = static_cast<uint8_t>(code);
  access.is_write_ = kind == Access::Write ? 1 : 0;
  access.number_ = 0;
  if (access.length_ != 1 && access.length_ != 2 && access.length_ != 4) return false;
  if (kind == Access::Read) return true;
  if (!(value >= -2147483648.0 && value <= 4294967295.0)) return false;
  access.value_ = static_cast<uint32_t>(static_cast<int64_t>(value));
  if (access.length_ < 4) access.value_ &= (1u << (access.length_ * 8u)) - 1;
  return true;
}

template <class Block>
void fail(Block& block, Error error) {
  block.Error_ = 1;
  block.ErrorID_ = error;
  block.Busy_ = block.Valid_ = 0;
}

// Reads once when Enable rises and after each answer again. The value in `value` is new when Valid is TRUE.
template <class Block>
void read(const rung_context* ctx, Block& block, double& value) {
  if (block.Enable_ == 0) {
    block.Valid_ = block.Busy_ = block.Error_ = 0;
    block.ErrorID_ = SMC_NO_ERROR_;
    block.access_.was_ = 0;
    return;
  }
  if (!isAxis(block.Axis_)) return fail(block, SMC_AXIS_IS_NO_AXIS_REF_);
  block.Busy_ = 1;
  if (block.ParameterNumber_ >= 0) {
    if (parameter(*block.Axis_, block.ParameterNumber_, Access::Read, value) != Found::Yes)
      return fail(block, SMC_RP_PARAM_UNKNOWN_);
    block.Valid_ = 1;
    block.Error_ = 0;
    block.ErrorID_ = SMC_NO_ERROR_;
    return;
  }
  if (block.Axis_->bVirtual_ != 0) return fail(block, SMC_RP_PARAM_UNKNOWN_);
  if (block.access_.was_ == 0) {
    if (!prepare(block.access_, block.ParameterNumber_, Access::Read, 0)) return fail(block, SMC_RP_PARAM_UNKNOWN_);
    block.access_.was_ = 1;
  }
  const int64_t result = accessObject(ctx, *block.Axis_, block.access_);
  if (result == RUNG_OBJECT_BUSY) return;
  block.access_.was_ = 0;
  if (result == RUNG_OBJECT_UNKNOWN) return fail(block, SMC_RP_PARAM_UNKNOWN_);
  if (result != RUNG_OBJECT_DONE) return fail(block, SMC_RP_REQUESTING_ERROR_);
  value = valueOf(block.access_);
  block.Valid_ = 1;
  block.Error_ = 0;
  block.ErrorID_ = SMC_NO_ERROR_;
}

template <class Block>
void write(const rung_context* ctx, Block& block, double value) {
  Call call(block.Axis_, block.command_, block.Execute_ != 0);
  if (call.rises()) {
    const bool is_object = block.ParameterNumber_ < 0 && call.axis().bVirtual_ == 0;
    if (!isFinite(value)) {
      call.refuse(SMC_WP_PARAM_INVALID_);
    } else if (block.ParameterNumber_ >= 0) {
      call.launch();
      double written = value;
      if (parameter(call.axis(), block.ParameterNumber_, Access::Write, written) == Found::Yes)
        call.done();
      else
        call.refuse(SMC_WP_PARAM_INVALID_);
    } else if (!is_object || !prepare(block.access_, block.ParameterNumber_, Access::Write, value)) {
      call.refuse(SMC_WP_PARAM_INVALID_);
    } else {
      call.launch();
    }
  }
  if (call.isRunning()) {
    const int64_t result = accessObject(ctx, call.axis(), block.access_);
    if (result == RUNG_OBJECT_DONE)
      call.done();
    else if (result == RUNG_OBJECT_FAILED)
      call.refuse(SMC_WP_SENDING_ERROR_);
    else if (result != RUNG_OBJECT_BUSY)
      call.refuse(SMC_WP_PARAM_INVALID_);
  }
  block.Done_ = call.is(Outcome::Done) ? 1 : 0;
  call.show(block.Busy_, block.Error_, block.ErrorID_);
}

}  // namespace

extern "C" {

void rung_sm3_basic_MC_ReadParameter(rung_context* ctx, MC_ReadParameter_type* self) { read(ctx, *self, self->Value_); }

void rung_sm3_basic_MC_ReadBoolParameter(rung_context* ctx, MC_ReadBoolParameter_type* self) {
  double value = self->Value_;
  read(ctx, *self, value);
  self->Value_ = value != 0 ? 1 : 0;
}

void rung_sm3_basic_MC_WriteParameter(rung_context* ctx, MC_WriteParameter_type* self) {
  write(ctx, *self, self->Value_);
}

void rung_sm3_basic_MC_WriteBoolParameter(rung_context* ctx, MC_WriteBoolParameter_type* self) {
  write(ctx, *self, self->Value_ != 0 ? 1 : 0);
}

}  // extern "C"

// SPDX-License-Identifier: Apache-2.0
// Native bodies of probe.st: touch probes of the drive (60B8h to 60BDh) and of the controller.
#include "kernel/axis.h"

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

// Bits of 60B8h and 60B9h of a trigger: 0 probe 1 rising, 1 probe 1 falling, 2 probe 2 rising, 3 probe 2 falling.
uint16_t probeShift(int trigger) { return trigger >= 2 ? 8 : 0; }
uint16_t enableBits(int trigger) {
  return static_cast<uint16_t>((0x01u | (trigger % 2 == 0 ? 0x10u : 0x20u)) << probeShift(trigger));
}
uint16_t storedBit(int trigger) {
  return static_cast<uint16_t>((trigger % 2 == 0 ? 0x02u : 0x04u) << probeShift(trigger));
}
int32_t latched(const Axis& a, int trigger) {
  switch (trigger) {
    case 0: return a.drive_.probe_1_rising_;
    case 1: return a.drive_.probe_1_falling_;
    case 2: return a.drive_.probe_2_rising_;
    default: return a.drive_.probe_2_falling_;
  }
}

void arm(Axis& a, int trigger) { a.drive_.probe_function_ |= enableBits(trigger); }
void disarm(Axis& a, int trigger) {
  const auto others = static_cast<uint16_t>(trigger % 2 == 0 ? 0x20u : 0x10u);
  uint16_t function =
      a.drive_.probe_function_ & static_cast<uint16_t>(~(enableBits(trigger) & ~(0x01u << probeShift(trigger))));
  if ((function & (others << probeShift(trigger))) == 0)
    function &= static_cast<uint16_t>(~(0x01u << probeShift(trigger)));
  a.drive_.probe_function_ = function;
}

bool isInWindow(const MC_TouchProbe_type& block, double position) {
  if (block.WindowOnly_ == 0) return true;
  const double first = block.FirstPosition_, last = block.LastPosition_;
  if (first <= last || period(*block.Axis_) == 0) return position >= first && position <= last;
  return position >= first || position <= last;  // it passes zero
}

TRIGGER_REF_type& triggerOf(void* pointer) { return *static_cast<TRIGGER_REF_type*>(pointer); }

void end(MC_TouchProbe_type& block, TRIGGER_REF_type& trigger) {
  if (trigger.bFastLatching_ != 0 && trigger.iTriggerNumber_ >= 0 && trigger.iTriggerNumber_ <= 3) {
    disarm(*block.Axis_, trigger.iTriggerNumber_);
    block.Axis_->armed_[trigger.iTriggerNumber_] = nullptr;
  }
  trigger.bActive_ = 0;
  block.armed_ = 0;
}

}  // namespace

extern "C" {

void rung_sm3_basic_MC_TouchProbe(rung_context*, MC_TouchProbe_type* self) {
  TRIGGER_REF_type none = {};
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  TRIGGER_REF_type& trigger = self->TriggerInput_ != nullptr ? triggerOf(self->TriggerInput_) : none;
  const bool fast = trigger.bFastLatching_ != 0;
  const int number = trigger.iTriggerNumber_;
  if (call.rises() && self->armed_ == 0) {
    Axis& axis = call.axis();
    const bool is_number = number >= 0 && number <= 3;
    if (trigger.bActive_ != 0 || (fast && is_number && axis.armed_[number] != nullptr)) {
      call.refuse(SMC_TP_TRIGGEROCCUPIED_);
    } else if (fast && (!is_number || axis.bVirtual_ != 0 || axis.bCommunication_ == 0 ||
                        (axis.drive_.mapped_ & RUNG_DRIVE_PROBE_FUNCTION) == 0)) {
      call.refuse(SMC_TP_COMM_ERROR_);
    } else if (fast && self->WindowOnly_ != 0) {
      call.refuse(SMC_TP_COULDNT_SET_WINDOW_);
    } else {
      call.launch();
      trigger.bActive_ = 1;
      self->armed_ = 1;
      self->last_input_ = trigger.bInput_;
      self->began_ = axis.cycle_;
      if (fast) {
        axis.armed_[number] = self;
        arm(axis, number);
      }
    }
  } else if (self->armed_ != 0 && call.isRunning()) {
    Axis& axis = call.axis();
    if (trigger.bActive_ == 0) {
      end(*self, trigger);
      self->command_.outcome_ = static_cast<uint8_t>(Outcome::Aborted);
      self->command_.shown_ = 0;
    } else if (fast && axis.bCommunication_ == 0) {
      end(*self, trigger);
      call.refuse(SMC_TP_COMM_ERROR_);
    } else {
      const double at =
          fast ? shown(axis, static_cast<double>(axis.drive_total_ + latched(axis, number) - axis.drive_.position_) /
                                 (axis.fScalefactor_ != 0 ? axis.fScalefactor_ : 1))
               : axis.fActPosition_;
      // What the drive stored before it was armed does not count: its status follows two cycles later.
      const bool came = fast ? (axis.drive_.probe_status_ & storedBit(number)) != 0 && axis.cycle_ - self->began_ > 2
                             : trigger.bInput_ != 0 && self->last_input_ == 0;
      self->last_input_ = trigger.bInput_;
      if (came && isInWindow(*self, at)) {
        self->RecordedPosition_ = at;
        end(*self, trigger);
        call.done();
      }
    }
  }
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_MC_AbortTrigger(rung_context*, MC_AbortTrigger_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    TRIGGER_REF_type none = {};
    TRIGGER_REF_type& trigger = self->TriggerInput_ != nullptr ? triggerOf(self->TriggerInput_) : none;
    if (trigger.bActive_ == 0) {
      call.refuse(SMC_AT_TRIGGERNOTOCCUPIED_);
    } else {
      trigger.bActive_ = 0;
      call.launch();
      call.done();
    }
  }
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

}  // extern "C"

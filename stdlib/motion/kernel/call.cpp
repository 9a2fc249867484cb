// SPDX-License-Identifier: Apache-2.0
// Calls of motion blocks: edges of Execute, and what becomes of a command. PLCopen part 1, 2.4.1.
#include "kernel/axis.h"

namespace rung::motion {
namespace {

using namespace rung_sm3_basic;

template <size_t count>
bool holds(const uint32_t (&serials)[count], uint32_t serial) {
  for (const uint32_t one : serials)
    if (one == serial) return true;
  return false;
}

}  // namespace

Call::Call(Axis* axis, Command& command, bool execute)
    : axis_(axis), command_(command), rises_(execute && command.was_ == 0) {
  command.was_ = execute ? 1 : 0;
  update();
  // Done, CommandAborted and Error stay until Execute falls, and for one call at least.
  if (!execute && outcome() != Outcome::Running && command.shown_ != 0) {
    command.outcome_ = static_cast<uint8_t>(Outcome::Idle);
    command.error_ = SMC_NO_ERROR_;
  }
  if (rises_ && !isAxis(axis)) refuse(SMC_AXIS_IS_NO_AXIS_REF_), rises_ = false;
}

bool Call::isOwner() const { return isRunning() && axis_->owner_ == command_.serial_; }

void Call::update() {
  if (outcome() != Outcome::Running) return;
  if (command_.axis_ != axis_) {
    command_.outcome_ = static_cast<uint8_t>(Outcome::Failed);
    command_.error_ = SMC_AXIS_REF_CHANGED_DURING_OPERATION_;
    command_.shown_ = 0;
    return;
  }
  const uint32_t serial = command_.serial_;
  if (serial == 0) return;  // launched
  if (serial == axis_->owner_ || isWaiting(*axis_, serial) || serial == axis_->extra_.owner_ ||
      serial == axis_->phase_.owner_)
    return;
  command_.shown_ = 0;
  if (holds(axis_->failed_, serial)) {
    command_.outcome_ = static_cast<uint8_t>(Outcome::Failed);
    command_.error_ = axis_->failed_error_;
  } else {
    command_.outcome_ = static_cast<uint8_t>(holds(axis_->ended_, serial) ? Outcome::Done : Outcome::Aborted);
  }
}

void Call::refuse(Error error) {
  command_.outcome_ = static_cast<uint8_t>(Outcome::Failed);
  command_.error_ = error;
  command_.shown_ = 0;
  if (isAxis(axis_)) axis_->bFBErrorOccurred_ = 1;
}

void Call::start(const Request& request, Error error) {
  if (!begin(*axis_, command_, request)) refuse(error);
}

void Call::launch() {
  command_.serial_ = 0;
  command_.axis_ = axis_;
  command_.outcome_ = static_cast<uint8_t>(Outcome::Running);
  command_.error_ = SMC_NO_ERROR_;
  command_.shown_ = 0;
}

void Call::done() {
  command_.outcome_ = static_cast<uint8_t>(Outcome::Done);
  command_.shown_ = 0;
}

// A block that refused new parameters still runs the command that it has.
void Call::run() {
  if (command_.serial_ == 0 || command_.axis_ != axis_) return;
  if (axis_->owner_ == command_.serial_) axis_->supervised_ = axis_->cycle_;
  if (axis_->owner_ == command_.serial_ || isRunning()) advance(*axis_);
  update();
}

void Call::show(uint8_t& busy, uint8_t& error, int16_t& error_id) {
  busy = isRunning() ? 1 : 0;
  error = is(Outcome::Failed) ? 1 : 0;
  error_id = error != 0 ? command_.error_ : static_cast<int16_t>(SMC_NO_ERROR_);
  command_.shown_ = 1;
}

}  // namespace rung::motion

// SPDX-License-Identifier: Apache-2.0
// Spindles of the simulated control: see spindles.h.
#include "spindles.h"

#include <algorithm>
#include <cmath>

namespace rung::nct {
namespace {

constexpr uint32_t kExists = 607, kLeastSpeed = 642, kGreatestSpeed = 650, kOther = 658, kRampUp = 666, kRampDown = 674,
                   kOrientation = 801;
constexpr double kSynchronousError = 0.5;  // revolutions a minute

}  // namespace

bool Spindles::exists(uint32_t k) const { return parameters_.bit(kExists, 0, k) && !spindles_[k].detached.is(); }

uint32_t Spindles::ofChannel(uint32_t channel) const {
  const uint32_t number = parameters_.word(604, channel);
  return number >= 1 && number <= kSpindles ? number - 1 : 0;
}

uint32_t Spindles::rangeOf(uint32_t k) const {
  const uint32_t code = words_.word(nc::SP_RNG, k);
  return code >= 11 && code <= 18 ? code - 11 : 0;
}

Spindles::Task Spindles::taskOf(uint32_t k) const {
  if (!words_.isSet(nc::SP_SEN, k)) return Task::Stop;
  if (words_.isSet(nc::SP_SSTRT, k)) return Task::Turn;
  if (words_.isSet(nc::SP_OREQ, k)) return Task::Orient;
  if (words_.isSet(nc::SP_SSYNCR, k)) return Task::Synchronous;
  return words_.isSet(nc::SP_SLCLR, k) ? Task::Close : Task::Stop;
}

double Spindles::programmed(uint32_t k) const {
  const uint32_t range = rangeOf(k);
  const double sign = words_.isSet(nc::SP_NEG, k) ? -1 : 1;
  if (words_.isSet(nc::SP_PAR, k)) return sign * parameters_.real(kOther + range, k);
  const double wanted = words_.word(nc::SP_PRG, k) * words_.real(nc::SP_SOVER, k);
  const double least = parameters_.real(kLeastSpeed + range, k), greatest = parameters_.real(kGreatestSpeed + range, k);
  double speed = std::isfinite(wanted) ? std::max(wanted, least) : least;
  if (greatest > 0) speed = std::min(speed, greatest);
  return sign * speed;
}

void Spindles::answer() {
  for (uint32_t k = 0; k < kSpindles; ++k) {
    Spindle& spindle = spindles_[k];
    if (!parameters_.bit(kExists, 0, k)) continue;
    spindle.detached.follow(words_.isSet(nc::SP_SDETCHR, k), true);
    spindle.phase_shifted.follow(words_.isSet(nc::SP_PHSHFTR, k) && spindle.is_synchronous, true);
    words_.set(nc::SN_SDETCHA, k, spindle.detached.is());
    words_.set(nc::SN_PHSHFTA, k, spindle.phase_shifted.is());
    words_.set(nc::SN_SALM, k, spindle.has_alarm);
  }
}

void Spindles::move(double seconds) {
  for (uint32_t k = 0; k < kSpindles; ++k) {
    if (!parameters_.bit(kExists, 0, k)) continue;
    Spindle& spindle = spindles_[k];
    const Task task = exists(k) ? taskOf(k) : Task::Stop;
    if (task != spindle.task) spindle.is_oriented = spindle.is_closed = spindle.is_synchronous = false;
    spindle.task = task;
    const uint32_t range = rangeOf(k);
    switch (task) {
      case Task::Stop: spindle.command = 0; break;
      case Task::Turn: spindle.command = programmed(k); break;
      case Task::Orient:
        spindle.command = std::copysign(parameters_.real(kOrientation + range, k), spindle.speed);
        if (spindle.speed == 0 && words_.isSet(nc::SP_NEG, k)) spindle.command = -spindle.command;
        if (spindle.is_oriented || spindle.is_closed) spindle.command = 0;
        break;
      case Task::Synchronous: {
        const uint32_t master = words_.word(nc::SP_MAST, k);
        spindle.command = master < kSpindles && master != k ? spindles_[master].speed : 0;
        if (words_.isSet(nc::SP_NEG, k)) spindle.command = -spindle.command;
        break;
      }
      case Task::Close: spindle.command = 0; break;
    }
    const bool faster = std::fabs(spindle.command) > std::fabs(spindle.speed);
    const double ramp = parameters_.real((faster ? kRampUp : kRampDown) + range, k) * seconds;
    const double missing = spindle.command - spindle.speed;
    const bool reaches =
        ramp == 0 ? seconds > 0 && parameters_.real(kRampUp + range, k) == 0 : std::fabs(missing) <= ramp;
    spindle.speed = reaches ? spindle.command : spindle.speed + std::copysign(ramp, missing);
    spindle.position += spindle.speed / 60 * seconds;
    if (task == Task::Orient && seconds > 0) {
      // At the speed of orientation the loop closes; then the spindle is at its position.
      if (spindle.is_closed && spindle.speed == 0) {
        spindle.is_oriented = true;
        spindle.position = std::round(spindle.position) + parameters_.real(684, k) / 360;
      }
      if (reaches && !spindle.is_closed) spindle.is_closed = true;
    }
    if (task == Task::Close && spindle.speed == 0) spindle.is_closed = true;
    if (task == Task::Synchronous) {
      spindle.is_closed = true;
      spindle.is_synchronous = std::fabs(spindle.command - spindle.speed) <= kSynchronousError;
    }
    tell(k);
  }
}

void Spindles::tell(uint32_t k) {
  const Spindle& spindle = spindles_[k];
  const double error = std::fabs(spindle.command - spindle.speed);
  const double window = std::max(std::fabs(spindle.command) * parameters_.real(627, k) / 100, parameters_.real(628, k));
  const auto rounded = [](double speed) { return static_cast<uint32_t>(static_cast<int32_t>(std::lround(speed))); };
  words_.put(nc::SN_NCOM, k, rounded(spindle.speed));
  words_.put(nc::SN_NACT, k, rounded(spindle.speed));
  words_.set(nc::SN_RMPD, k, error == 0);
  words_.set(nc::SN_NS, k, error <= window);
  words_.set(nc::SN_N0, k, std::fabs(spindle.speed) <= parameters_.real(629, k));
  words_.set(nc::SN_LPCLSD, k, spindle.is_closed);
  words_.set(nc::SN_ORIP, k, spindle.is_oriented);
  words_.set(nc::SN_SSYNA, k, spindle.is_synchronous);
  words_.set(nc::SN_SINPOS, k, spindle.is_synchronous || spindle.is_oriented);
}

bool Spindles::read(uint32_t item, uint32_t number, double& value) const {
  if (number < 1 || number > kSpindles) return false;
  const Spindle& spindle = spindles_[number - 1];
  value = 0;
  switch (item) {
    case scope::ComPosSp:
    case scope::ActPosSp: value = spindle.position; break;
    case scope::ComVelSp:
    case scope::CommandSp:
    case scope::TachSp: value = spindle.speed / 60; break;
    case scope::NActSp: value = spindle.speed; break;
    case scope::NSetSp: value = spindle.command; break;
    case scope::NCommandSp: value = spindle.speed; break;
    default: break;
  }
  return true;
}

}  // namespace rung::nct

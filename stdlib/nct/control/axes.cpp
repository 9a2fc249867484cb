// SPDX-License-Identifier: Apache-2.0
// Axes of the simulated control: see axes.h.
#include "axes.h"

#include <algorithm>
#include <cmath>

#include "channels.h"
#include "spindles.h"

namespace rung::nct {
namespace {

constexpr double kRapid = 10000, kJog = 1000;  // units a minute
constexpr Code kNoAxis = 30, kNotOpen = 91;

// MOVCMND codes. NCT manual 6.15.
enum MoveCode : int32_t {
  kRapidAbsolute = 0,
  kRapidBy = 1,
  kFeedAbsolute = 2,
  kFeedBy = 3,
  kTurnAbsolute = 4,
  kTurnBy = 5,
  kMachine = 6,
  kReference1 = 7,
  kReference2 = 8,
  kReference4 = 10,
  kDwellSeconds = 11,
  kDwellTurns = 12,
  kJogging = 13,
  kHandwheel = 14
};

bool needsSpeed(int32_t code) { return code >= kFeedAbsolute && code <= kTurnBy; }
bool isRapid(int32_t code) { return code <= kRapidBy || (code >= kMachine && code <= kReference4); }

}  // namespace

bool Axes::exists(uint32_t axis) const { return parameters_.word(2, axis) > 0 && !axes_[axis].detached.is(); }

uint32_t Axes::channelOf(uint32_t axis) const {
  const uint32_t channel = parameters_.word(2, axis);
  return channel >= 1 && channel <= kChannels ? channel - 1 : 0;
}

void Axes::answer() {
  for (uint32_t k = 0; k < kAxes; ++k) {
    Axis& axis = axes_[k];
    if (parameters_.word(2, k) == 0) continue;
    const bool buffered = channels_.hasBlocks(channelOf(k));
    axis.detached.follow(words_.isSet(nc::AP_DETCHR, k), true);
    axis.open.follow(words_.isSet(nc::AP_OPNR, k), true);
    axis.mirrored.follow(words_.isSet(nc::AP_MIRR, k), true);
    axis.parked.follow(words_.isSet(nc::AP_PARKR, k), !buffered);
    axis.synchronous.follow(words_.isSet(nc::AP_SYNCR, k), !buffered && parameters_.word(2101, k) > 0);
    axis.composite.follow(words_.isSet(nc::AP_MIXR, k), !buffered && parameters_.word(2104, k) > 0);
    axis.superimposed.follow(words_.isSet(nc::AP_SPRPNR, k), !buffered && parameters_.word(2107, k) > 0);
    axis.of_plc.follow(words_.isSet(nc::AP_PLCR, k), !buffered && exists(k));
    if (axis.detached.is()) axis.has_reference = false;
    if (words_.isSet(nc::AP_RPE, k)) axis.has_reference = true;
    words_.set(nc::AN_LUBR, k, axis.lubricates);
    axis.lubricates = false;
    words_.set(nc::AN_DETCHA, k, axis.detached.is());
    words_.set(nc::AN_OPNA, k, axis.open.is());
    words_.set(nc::AN_MIRA, k, axis.mirrored.is());
    words_.set(nc::AN_PARKA, k, axis.parked.is());
    words_.set(nc::AN_SYNCA, k, axis.synchronous.is());
    words_.set(nc::AN_MIXA, k, axis.composite.is());
    words_.set(nc::AN_SPRPNA, k, axis.superimposed.is());
    words_.set(nc::AN_PLCA, k, axis.of_plc.is());
    words_.set(nc::AN_AXALM, k, axis.has_alarm);
  }
  // The masters of those that are coupled.
  const auto tellMasters = [&](const Symbol& symbol, uint32_t parameter, Answer Axis::*coupled) {
    for (uint32_t master = 0; master < kAxes; ++master) {
      bool has_slave = false;
      for (uint32_t slave = 0; slave < kAxes; ++slave)
        has_slave = has_slave || ((axes_[slave].*coupled).is() && parameters_.word(parameter, slave) == master + 1);
      words_.set(symbol, master, has_slave);
    }
  };
  tellMasters(nc::AN_SYNCM, 2101, &Axis::synchronous);
  tellMasters(nc::AN_MIXM, 2104, &Axis::composite);
  tellMasters(nc::AN_SPRPNM, 2107, &Axis::superimposed);
}

int32_t Axes::command(int32_t number, int32_t code, double speed, double distance) {
  if (number < 0 || number >= static_cast<int32_t>(kAxes) || code < 0 || code > kHandwheel) return RUNG_NC_REFUSED;
  Axis& axis = axes_[number];
  if (!axis.of_plc.is() || (needsSpeed(code) && !(speed > 0))) return RUNG_NC_REFUSED;
  if (axis.buffer.code >= 0) return RUNG_NC_BUSY;
  // The interpolator takes the first block at once.
  (axis.current.code < 0 ? axis.current : axis.buffer) = {code, speed, distance, false, 0};
  return RUNG_NC_DONE;
}

Code Axes::writePosition(const Block& block) {
  if (block.amount() != 3) return kWrongAmount;
  const uint32_t number = block.word(2);
  if (number >= kAxes) return kNoAxis;
  Axis& axis = axes_[number];
  const bool may = axis.open.is() && (words_.isSet(nc::AP_EFD, number) || parameters_.bit(514, 4, number));
  if (parameters_.word(2, number) == 0 || !may) return kNotOpen;
  axis.position = block.real(3);
  axis.has_reference = true;
  return kDone;
}

double Axes::rateOf(uint32_t number, const Command& command) const {
  if (isRapid(command.code)) return kRapid;
  if (command.code == kTurnAbsolute || command.code == kTurnBy)
    return command.speed * std::fabs(spindles_.speed(spindles_.ofChannel(channelOf(number))));
  return command.speed;
}

void Axes::begin(uint32_t number, Command& command) {
  const Axis& axis = axes_[number];
  command.begun = true;
  switch (command.code) {
    case kRapidBy:
    case kFeedBy:
    case kTurnBy: command.target = axis.position + command.distance; break;
    case kReference1:
    case kReference2:
    case kReference2 + 1:
    case kReference4:
      command.target = parameters_.real(200 + static_cast<uint32_t>(command.code - kReference1), number);
      break;
    default: command.target = command.distance; break;
  }
}

void Axes::move(double seconds) {
  if (seconds > 0) advance(seconds);
  for (uint32_t k = 0; k < kAxes; ++k) {
    if (parameters_.word(2, k) == 0) continue;
    tellBuffers(k);
    tellPositions(k);
  }
  tellSwitches();
}

void Axes::advance(double seconds) {
  std::array<double, kAxes> before;
  for (uint32_t k = 0; k < kAxes; ++k) before[k] = axes_[k].position;
  for (uint32_t k = 0; k < kAxes; ++k) {
    Axis& axis = axes_[k];
    axis.speed = 0;
    axis.referenced_now = false;
    if (parameters_.word(2, k) == 0) continue;
    words_.set(nc::AN_MTNRP, k, false);
    words_.set(nc::AN_MTNRN, k, false);
    if (exists(k) && !axis.open.is() && !axis.parked.is()) {
      if (axis.of_plc.is())
        run(k, seconds);
      else
        jog(k, seconds);
    }
  }
  // A coupled axis goes the way of its master.
  for (uint32_t k = 0; k < kAxes; ++k) {
    Axis& axis = axes_[k];
    const auto follow = [&](bool coupled, uint32_t parameter, uint32_t direction) {
      const uint32_t master = parameters_.word(parameter, k);
      if (!coupled || master == 0 || master > kAxes) return;
      const double way = axes_[master - 1].position - before[master - 1];
      axis.position += parameters_.bit(direction, 0, k) ? -way : way;
    };
    follow(axis.synchronous.is(), 2101, 2102);
    follow(axis.superimposed.is(), 2107, 2108);
    const double way = axis.position - before[k];
    axis.speed = way / seconds * 60;
    const double distance = parameters_.real(1273, k);
    axis.since_lubrication += std::fabs(way);
    if (distance > 0 && axis.since_lubrication > distance) {
      axis.since_lubrication = 0;
      axis.lubricates = true;
    }
  }
}

double Axes::moveBy(uint32_t number, double distance, bool rapid) {
  const bool forward = distance > 0;
  words_.set(nc::AN_RAPR, number, rapid);
  words_.set(nc::AN_MTNRP, number, distance > 0);
  words_.set(nc::AN_MTNRN, number, distance < 0);
  const bool disabled = words_.isSet(rapid ? nc::AP_RAPD : nc::AP_FEEDD, number) ||
                        words_.isSet(forward ? nc::AP_MTNDP : nc::AP_MTNDN, number) ||
                        words_.isSet(forward ? nc::AP_LIMP : nc::AP_LIMN, number);
  return disabled ? 0 : stroke(number, distance);
}

double Axes::stroke(uint32_t number, double distance) {
  Axis& axis = axes_[number];
  const double positive = parameters_.real(1002, number), negative = parameters_.real(1003, number);
  double to = axis.position + distance;
  if (positive > negative && axis.has_reference) to = std::clamp(to, negative, positive);
  const double way = to - axis.position;
  axis.position = to;
  return way;
}

// The commands of the PLC. NCT manual 6.15, 7.13.
void Axes::run(uint32_t number, double seconds) {
  Axis& axis = axes_[number];
  if (words_.isSet(nc::AP_RES, number)) {
    axis.current = axis.buffer = {};
  } else if (words_.isSet(nc::AP_GOR, number)) {
    double left = seconds;
    while (axis.current.code >= 0 && left > 0) {
      Command& command = axis.current;
      if (!command.begun) begin(number, command);
      if (command.code == kJogging || command.code == kHandwheel) {
        if (command.code == kJogging) {
          const double speed = command.speed > 0 ? command.speed : kJog;
          const double way = speed / 60 * left;
          if (words_.isSet(nc::AP_JOGP, number)) moveBy(number, way, false);
          if (words_.isSet(nc::AP_JOGN, number)) moveBy(number, -way, false);
        }
        if (axis.buffer.code < 0) break;
        left = 0;
      } else if (command.code == kDwellSeconds || command.code == kDwellTurns) {
        const double rate =
            command.code == kDwellSeconds
                ? 1
                : std::fabs(spindles_.speed(spindles_.ofChannel(channelOf(number)))) / 60;  // turns a second
        if (command.target > rate * left) {
          command.target -= rate * left;
          break;
        }
        if (rate > 0) left -= command.target / rate;
      } else {
        const double rate = rateOf(number, command) / 60, way = command.target - axis.position;
        const bool arrives = std::fabs(way) <= rate * left;
        const double step = arrives ? way : std::copysign(rate * left, way);
        const double moved = way == 0 ? 0 : moveBy(number, step, isRapid(command.code));
        if (!arrives || moved != step) break;
        axis.position = command.target;
        if (rate > 0) left -= std::fabs(way) / rate;
        if (command.code == kReference1) axis.has_reference = true;
      }
      axis.current = axis.buffer;
      axis.buffer = {};
    }
  }
}

void Axes::tellBuffers(uint32_t number) {
  const Axis& axis = axes_[number];
  if (!axis.of_plc.is()) return;
  words_.set(nc::AN_BEPTY, number, axis.buffer.code < 0);
  words_.set(nc::AN_IEPTY, number, axis.current.code < 0);
  words_.set(nc::AN_GOA, number, axis.current.code >= 0 && words_.isSet(nc::AP_GOR, number));
}

// The buttons of the operator. NCT manual 7.13.1, 7.15.1.
void Axes::jog(uint32_t number, double seconds) {
  Axis& axis = axes_[number];
  const uint32_t channel = channelOf(number);
  const bool forward = words_.isSet(nc::AP_JOGP, number), back = words_.isSet(nc::AP_JOGN, number);
  const bool was = axis.jogs;
  axis.jogs = forward != back;
  if (!axis.jogs) {
    axis.jogged = 0;
    return;
  }
  const bool rapid = words_.isSet(nc::CP_JOGRAP, channel);
  double way = (rapid ? kRapid : kJog) / 60 * seconds;
  switch (channels_.mode(channel)) {
    case Mode::Jog: break;
    case Mode::Increments: {
      const double increment = words_.real(nc::CP_INC, channel);
      if (!was) axis.jogged = 0;
      way = std::min(way, increment - axis.jogged);
      if (way <= 0) return;
      axis.jogged += way;
      break;
    }
    case Mode::Reference: {
      const double to = parameters_.real(200, number) - axis.position;
      const double moved = moveBy(number, std::copysign(std::min(std::fabs(to), way), to), false);
      if (to == moved) {
        axis.has_reference = true;
        axis.referenced_now = true;
        axis.position = parameters_.real(200, number);
      }
      return;
    }
    case Mode::Handwheel:
    case Mode::Edit:
    case Mode::Automatic:
    case Mode::Mdi: return;
  }
  moveBy(number, forward ? way : -way, rapid);
}

void Axes::turnHandwheel(uint32_t wheel, int32_t increments) {
  const Symbol* const axis_of[] = {&nc::P_H1AS, &nc::P_H2AS, &nc::P_H3AS, &nc::P_H4AS};
  const uint32_t number = words_.word(*axis_of[wheel]);
  if (number == 0 || number > kAxes || increments == 0 || !exists(number - 1)) return;
  Axis& axis = axes_[number - 1];
  const uint32_t channel = channelOf(number - 1);
  const bool by_plc = axis.of_plc.is() && axis.current.code == kHandwheel;
  if (!by_plc && (axis.of_plc.is() || channels_.mode(channel) != Mode::Handwheel)) return;
  moveBy(number - 1, increments * words_.real(nc::CP_INC, channel), false);
}

void Axes::tellPositions(uint32_t k) {
  const Axis& axis = axes_[k];
  const double window = parameters_.real(516, k);
  const auto near = [&](double position) { return std::fabs(axis.position - position) <= window; };
  words_.set(nc::AN_INPOS, k, axis.speed == 0);
  words_.set(nc::AN_RPE, k, axis.has_reference);
  if (axis.referenced_now) words_.set(nc::AN_REFEND, k, true);
  if (channels_.mode(channelOf(k)) != Mode::Reference) words_.set(nc::AN_REFEND, k, false);
  const Symbol* const reference[] = {&nc::AN_REFP1, &nc::AN_REFP2, &nc::AN_REFP3, &nc::AN_REFP4};
  for (uint32_t n = 0; n < 4; ++n)
    words_.set(*reference[n], k, axis.has_reference && near(parameters_.real(200 + n, k)));
  const double index = parameters_.real(110, k);
  words_.set(nc::AN_INDP, k, index > 0 && near(std::round(axis.position / index) * index));
  const double positive = parameters_.real(1002, k), negative = parameters_.real(1003, k);
  const bool limited = positive > negative && axis.has_reference;
  words_.set(nc::AN_OTP, k, limited && axis.position >= positive);
  words_.set(nc::AN_OTN, k, limited && axis.position <= negative);
}

// N_SW between both ends, N_SWN before and N_SWP after them; on an end none of them. NCT manual 7.10.
void Axes::tellSwitches() {
  for (uint32_t k = 0; k < 32; ++k) {
    const uint32_t number = parameters_.word(1101 + k);
    if (number == 0 || number > kAxes) continue;
    const double position = axes_[number - 1].position;
    const double low = parameters_.real(1133 + k), high = parameters_.real(1165 + k);
    words_.set(nc::N_SW, k, low < position && position < high);
    words_.set(nc::N_SWN, k, position < low);
    words_.set(nc::N_SWP, k, position > high);
  }
}

bool Axes::read(uint32_t item, uint32_t number, double& value) const {
  if (number < 1 || number > kAxes) return false;
  const Axis& axis = axes_[number - 1];
  value = 0;
  switch (item) {
    case scope::ComPosAx:
    case scope::ActPosAx: value = axis.position; break;
    case scope::ComVelAx:
    case scope::CommandAx:
    case scope::TachAx: value = axis.speed / 60; break;
    case scope::RotaryAx: {
      value = std::fmod(axis.position, 360);
      if (value < 0) value += 360;
      break;
    }
    default: break;  // an ideal axis has no errors, and nothing to compensate
  }
  return true;
}

}  // namespace rung::nct

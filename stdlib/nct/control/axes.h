// SPDX-License-Identifier: Apache-2.0
// The axes of the simulated control: requests and their answers, jogging, the motion commands of the PLC and position
// switches. A move has a constant speed, without ramps. Positions and distances in units of the machine (mm or
// degrees), speeds in units a minute. NCT manual 6.15, 6.24, 6.25, 7.10, 7.13.
#pragma once

#include <array>

#include "block.h"
#include "parameters.h"
#include "words.h"

namespace rung::nct {

class Channels;
class Spindles;

class Axes {
 public:
  Axes(Words& words, const Parameters& parameters, const Channels& channels, const Spindles& spindles)
      : words_(words), parameters_(parameters), channels_(channels), spindles_(spindles) {}

  // Requests and their answers, once in a cycle of Main.
  void answer();
  // Motion in the time since the last call, and what follows from positions.
  void move(double seconds);
  // A handwheel, from 0, was turned by `increments`.
  void turnHandwheel(uint32_t wheel, int32_t increments);

  int32_t command(int32_t axis, int32_t code, double speed, double distance);  // MOVCMND: a rung_nc_result
  Code writePosition(const Block& block);                                      // MW90
  // SCP: `item` is a scope from ComPosAx to EGBvTarAx. False: there is no such axis.
  bool read(uint32_t item, uint32_t axis, double& value) const;

  void setPosition(uint32_t axis, double position) { axes_[axis].position = position; }
  double position(uint32_t axis) const { return axes_[axis].position; }
  void setAlarm(uint32_t axis, bool alarm) { axes_[axis].has_alarm = alarm; }

  template <class Archive>
  void transfer(Archive& archive) {
    archive.value(axes_);
  }

 private:
  struct Command {
    int32_t code = -1;  // -1: none
    double speed = 0, distance = 0;
    bool begun = false;
    double target = 0;  // a position, or what is left of a dwell
  };
  struct Axis {
    double position = 0;
    double speed = 0;  // now, units a minute, with its sign
    double since_lubrication = 0, jogged = 0;
    bool has_reference = false, has_alarm = false, lubricates = false, jogs = false;
    bool referenced_now = false;
    Answer detached, open, parked, synchronous, composite, superimposed, of_plc, mirrored;
    Command current, buffer;
  };

  bool exists(uint32_t axis) const;
  uint32_t channelOf(uint32_t axis) const;  // from 0
  double rateOf(uint32_t axis, const Command& command) const;
  void begin(uint32_t axis, Command& command);
  void advance(double seconds);
  void run(uint32_t axis, double seconds);
  void jog(uint32_t axis, double seconds);
  // Moves by `distance` as far as it may; `rapid`: with AN_RAPR. Returns what it moved.
  double moveBy(uint32_t axis, double distance, bool rapid);
  double stroke(uint32_t axis, double distance);
  void tellBuffers(uint32_t axis);
  void tellPositions(uint32_t axis);
  void tellSwitches();

  Words& words_;
  const Parameters& parameters_;
  const Channels& channels_;
  const Spindles& spindles_;
  std::array<Axis, kAxes> axes_;
};

}  // namespace rung::nct

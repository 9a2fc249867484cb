// SPDX-License-Identifier: Apache-2.0
// The spindles of the simulated control: speed with ramps, orientation, synchronous running, detaching. Speeds in
// revolutions a minute. NCT manual 7.14.
#pragma once

#include <array>

#include "parameters.h"
#include "words.h"

namespace rung::nct {

class Spindles {
 public:
  Spindles(Words& words, const Parameters& parameters) : words_(words), parameters_(parameters) {}

  void answer();
  void move(double seconds);
  double speed(uint32_t spindle) const { return spindles_[spindle].speed; }
  // That of a plain S, from 0.
  uint32_t ofChannel(uint32_t channel) const;
  // SCP: `item` is a scope from ComPosSp to TachRealSp. False: there is no such spindle.
  bool read(uint32_t item, uint32_t spindle, double& value) const;
  void setAlarm(uint32_t spindle, bool alarm) { spindles_[spindle].has_alarm = alarm; }

  template <class Archive>
  void transfer(Archive& archive) {
    archive.value(spindles_);
  }

 private:
  // A spindle does one of these; a command that comes first here prevails over those after it.
  enum class Task : uint8_t { Stop, Turn, Orient, Synchronous, Close };
  struct Spindle {
    double command = 0;  // by the program
    double speed = 0;
    double position = 0;  // revolutions
    bool is_closed = false, is_oriented = false, is_synchronous = false, has_alarm = false;
    Task task = Task::Stop;
    Answer detached, phase_shifted;
  };

  bool exists(uint32_t spindle) const;
  Task taskOf(uint32_t spindle) const;
  uint32_t rangeOf(uint32_t spindle) const;  // from 0
  double programmed(uint32_t spindle) const;
  void tell(uint32_t spindle);

  Words& words_;
  const Parameters& parameters_;
  std::array<Spindle, kSpindles> spindles_;
};

}  // namespace rung::nct

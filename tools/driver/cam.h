// SPDX-License-Identifier: Apache-2.0
// `rung cam`: motion laws and cams. In: the subcommand with its words, and its options. Out: an exit code; results go
// to the sink and to the file of `-o`. Called by tools/rung. The subcommands are in cam_commands.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cam/laws/laws.h"
#include "tools/driver/sink.h"

namespace rung::driver {

struct CamOptions {
  std::vector<std::string> given;  // the names of all that were set
  double stroke = 1, length = 1;   // of the slave and of the master
  cam::Ends ends;                  // in units of the slave per unit of the master
  uint32_t points = 33;
  std::optional<double> speed;  // of the master

  // Of `fit`.
  struct Pair {
    double first = 0, second = 0;
    std::optional<double> third;
  };
  std::string name = "Cam", master_unit, slave_unit, repeat, loss;
  std::optional<double> period, tolerance, loss_scale, max_velocity, max_acceleration, max_jerk;
  std::optional<Pair> range, position;
  std::vector<Pair> exact, dwells;  // x, y; from, to, y
  uint32_t segments = 100;
  bool has_smooth_jerk = false;
};

// Sets the option `name` ("--v0"); returns an error message, or an empty string.
[[nodiscard]] std::string setCamOption(std::string_view name, std::string_view value, CamOptions& options);

int runCam(const std::vector<std::string>& inputs, const CamOptions& options, const std::string& output, Sink& sink);

}  // namespace rung::driver

// `rung cam`: the motion laws of cams. In: what to show, and the numbers of the motion. Out: an exit code; results go
// to the sink and to options.output. Called by tools/rung.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cam/laws/laws.h"
#include "tools/driver/sink.h"

namespace rung::driver {

struct CamOptions {
  double stroke = 1, length = 1;  // of the slave and of the master
  cam::Ends ends;                 // in units of the slave per unit of the master
  uint32_t points = 33;
};

// Sets the option `name` ("--v0"); returns an error message, or an empty string.
[[nodiscard]] std::string setCamOption(std::string_view name, std::string_view value, CamOptions& options);

// inputs: `law`, or `law NAME`; output: a CSV file for the points, or empty.
int runCam(const std::vector<std::string>& inputs, const CamOptions& options, const std::string& output, Sink& sink);

}  // namespace rung::driver

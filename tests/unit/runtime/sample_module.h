// SPDX-License-Identifier: Apache-2.0
// A module written by hand in the form of generated code: one program, a fast and a slow task, an event task, an
// image, retained data, tests. The host is tested with it, without any compiler.
#pragma once

#include <string>

#include "rung/module.h"

namespace sample {

struct Point {
  int16_t x;
  int16_t y;
};
struct Main {
  uint8_t run;
  int32_t count;
  float level;
  uint32_t elapsed;  // TIME
  int16_t color;     // (Red, Green, Blue)
  int16_t table[2][3];
  char name[11];
  Point point;
  Point* other;  // in-out
  uint16_t bits;
  int32_t divisor;
  uint8_t slow_runs, event_runs;
  uint8_t start_event;
  int32_t kept;         // RETAIN
  int32_t kept_always;  // PERSISTENT
};

const rung_module& module();
// The same with another layout hash: the retained variables are found by name.
const rung_module& changedModule();

// Letters appended by the tasks, in the order in which they ran.
extern std::string ran;

}  // namespace sample

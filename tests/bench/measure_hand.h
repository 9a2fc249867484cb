// SPDX-License-Identifier: Apache-2.0
// Measures a kernel written by hand. In: a type with run(rounds). Used by the hand.cpp of each set of kernels.
#pragma once

#include <cstdint>

// Runs the kernel and the same one of each module in turn; prints a line for each: who, name, rounds, CPU seconds of
// the best turn, and the check sum. Without `hand` only the modules. Defined in measure.cpp.
void measureKernel(const char* name, int32_t rounds, int32_t (*hand)(int32_t rounds));

template <class Kernel>
void measure(const char* name, int32_t rounds) {
  static Kernel kernel;
  measureKernel(name, rounds, [](int32_t count) { return kernel.run(count); });
}

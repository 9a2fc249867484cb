// Measures a kernel written by hand. In: a type with run(rounds). Out: a line with who, name, rounds, seconds of the
// best of five runs, and the checksum. Used by the hand.cpp of each set of kernels.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>

template <class Kernel>
void measure(const char* name, int32_t rounds) {
  static Kernel kernel;
  double best = 1e9;
  int32_t check = 0;
  for (int i = 0; i < 5; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    check = kernel.run(rounds);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::printf("hand\t%s\t%d\t%.6f\t%d\n", name, rounds, best, check);
}

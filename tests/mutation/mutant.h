// SPDX-License-Identifier: Apache-2.0
// Which mutant is active: included by the rewritten copies of sources that mutation.py builds, never by Rung. The
// number comes from RUNG_MUTANT (none: no mutant); with RUNG_MUTANTS_REACHED, a file of one byte for each mutant, the
// sites that a run evaluates leave a 1 there, also from a process that is killed.
#pragma once
#ifdef __cplusplus
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

namespace rung_mutation {

struct State {
  int active = -1;
  long size = 0;
  unsigned char* reached = nullptr;
};

inline State start() noexcept {
  State state;
  if (const char* number = getenv("RUNG_MUTANT")) state.active = atoi(number);
  const char* path = getenv("RUNG_MUTANTS_REACHED");
  const int file = path != nullptr ? open(path, O_RDWR | O_CLOEXEC) : -1;
  if (file < 0) return state;
  state.size = lseek(file, 0, SEEK_END);
  void* bytes = mmap(nullptr, static_cast<size_t>(state.size), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (bytes != MAP_FAILED) state.reached = static_cast<unsigned char*>(bytes);
  close(file);
  return state;
}

inline bool isActive(int number) noexcept {
  static const State state = start();
  if (state.reached != nullptr && number < state.size) state.reached[number] = 1;
  return number == state.active;
}

}  // namespace rung_mutation

inline bool rung_mutant(int number) noexcept { return rung_mutation::isActive(number); }

// For bodies of constexpr functions: no mutant while the compiler evaluates them.
constexpr bool rung_mutant_constexpr(int number) noexcept {
  return !__builtin_is_constant_evaluated() && rung_mutation::isActive(number);
}
#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* 1000 points in each direction, in a file that two processes map. */
#ifndef SHARED_POINTS_H
#define SHARED_POINTS_H
#include <stdbool.h>
#include <stdint.h>

enum { POINT_COUNT = 1000, POINT_BYTES = POINT_COUNT / 8 };
struct direction {
  uint32_t counter; /* odd: they are being written */
  uint8_t points[POINT_BYTES];
};
struct points {
  struct direction inputs, outputs;
};

static void give_points(struct direction* to, const uint8_t* from) {
  const uint32_t counter = __atomic_load_n(&to->counter, __ATOMIC_RELAXED);
  __atomic_store_n(&to->counter, counter + 1, __ATOMIC_SEQ_CST);
  for (int i = 0; i < POINT_BYTES; ++i) __atomic_store_n(&to->points[i], from[i], __ATOMIC_RELAXED);
  __atomic_store_n(&to->counter, counter + 2, __ATOMIC_SEQ_CST);
}

/* False: they are being written. */
static bool take_points(struct direction* from, uint8_t* to) {
  const uint32_t counter = __atomic_load_n(&from->counter, __ATOMIC_SEQ_CST);
  for (int i = 0; i < POINT_BYTES; ++i) to[i] = __atomic_load_n(&from->points[i], __ATOMIC_SEQ_CST);
  return counter % 2 == 0 && __atomic_load_n(&from->counter, __ATOMIC_SEQ_CST) == counter;
}
#endif

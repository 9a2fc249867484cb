// SPDX-License-Identifier: Apache-2.0
/* A control that writes a number to two inputs in each call, in a cycle of Main so slowly that Int0 is due in between, and
 * counts in a third one the calls in which it found different numbers in two outputs that the program writes together. */
#define _POSIX_C_SOURCE 199309L
#include <string.h>
#include <time.h>

#include "rung/nc.h"

static uint32_t number; /* the control has no data */

enum { N_ACTMSG = 5, P_CHSEL = 6, MKBTNS0 = 7, CN_POTNO = 855, CP_OFFSNO = 1071 };

static int64_t now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * INT64_C(1000000000) + time.tv_nsec;
}

static void exchange(void *data, uint32_t *slice, uint32_t *nonvolatile, bool is_cycle, int64_t now_ns) {
  (void)data;
  (void)nonvolatile;
  (void)now_ns;
  const int64_t begin = now();
  const uint32_t own = ++number;
  slice[N_ACTMSG] = own;
  while (is_cycle && now() - begin < 500000 + own * 7919 % 100000) continue; /* ends anywhere in a TimeSlice of 100 us */
  slice[CN_POTNO] = own;
  slice[MKBTNS0] += slice[P_CHSEL] != slice[CP_OFFSNO];
}

const rung_nc *rung_numerical_control(const char *argument, void **data);
const rung_nc *rung_numerical_control(const char *argument, void **data) {
  static rung_nc control;
  if (strcmp(argument, "pairs") != 0) return NULL;
  control.exchange = exchange;
  *data = NULL;
  return &control;
}

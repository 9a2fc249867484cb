// SPDX-License-Identifier: Apache-2.0
/* A driver for tests: its inputs are two bytes that count the reads, its outputs go to a file, a line for each write that
 * differs from the last one. The argument: FILE, or FILE,N to fail at the Nth read. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rung/module.h"

static FILE *log_file;
static long reads, fails_at;
static uint8_t last[4];

static bool read_inputs(void *data, uint8_t *inputs, int64_t now_ns) {
  (void)data, (void)now_ns;
  ++reads;
  inputs[0] = (uint8_t)reads;
  inputs[1] = (uint8_t)~reads;
  return fails_at == 0 || reads < fails_at;
}

static bool write_outputs(void *data, const uint8_t *outputs, int64_t now_ns) {
  (void)data, (void)now_ns;
  if (memcmp(last, outputs, sizeof last) == 0) return true;
  memcpy(last, outputs, sizeof last);
  fprintf(log_file, "%u %u %u %u\n", outputs[0], outputs[1], outputs[2], outputs[3]);
  fflush(log_file);
  return true;
}

const rung_driver *rung_drivers(const char *argument, uint32_t *count);
const rung_driver *rung_drivers(const char *argument, uint32_t *count) {
  static const rung_driver driver = {"log", NULL, 0, 2, 0, 4, read_inputs, write_outputs, NULL, NULL};
  char path[200];
  const char *comma = strchr(argument, ',');
  if (comma != NULL) fails_at = atol(comma + 1);
  snprintf(path, sizeof path, "%.*s", comma != NULL ? (int)(comma - argument) : (int)strlen(argument), argument);
  log_file = fopen(path, "w");
  *count = 1;
  return log_file != NULL ? &driver : NULL;
}

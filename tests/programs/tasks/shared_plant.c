// SPDX-License-Identifier: Apache-2.0
/* The other side of shared_driver.c: gives 1000 inputs another pattern each round and waits until every output is the
 * complement of its input. FILE ROUNDS; exits with 1 when an answer does not come within ten seconds. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "shared_points.h"

static bool answered(struct points* shared, const uint8_t* given) {
  const time_t end = time(0) + 10;
  while (time(0) < end) {
    uint8_t outputs[POINT_BYTES];
    bool is_complement = take_points(&shared->outputs, outputs);
    for (int i = 0; is_complement && i < POINT_BYTES; ++i) is_complement = (outputs[i] ^ given[i]) == 255;
    if (is_complement) return true;
    usleep(200);
  }
  return false;
}

int main(int argc, char** argv) {
  const int file = open(argv[1], O_RDWR);
  struct points* const shared = mmap(0, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (argc < 3 || file < 0 || shared == MAP_FAILED) return 2;
  uint32_t random = 1;
  for (int round = 0; round < atoi(argv[2]); ++round) {
    uint8_t pattern[POINT_BYTES];
    for (int i = 0; i < POINT_BYTES; ++i) pattern[i] = (uint8_t)((random = random * 1664525u + 1013904223u) >> 24);
    give_points(&shared->inputs, pattern);
    if (!answered(shared, pattern)) return printf("round %d: no answer\n", round), 1;
  }
  printf("%s rounds of %d points\n", argv[2], POINT_COUNT);
  return 0;
}

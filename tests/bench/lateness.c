// SPDX-License-Identifier: Apache-2.0
/* The reference of lateness.sh: a bare loop of clock_nanosleep with the period, policy and CPU of the task it is compared
 * with. Prints the 99.9th percentile of its lateness in microseconds. Argument: seconds. */
#define _GNU_SOURCE
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <time.h>

static unsigned counts[2048];

int main(int argc, char **argv) {
  const long long period = 1000000, n = (argc > 1 ? atoll(argv[1]) : 1) * 1000;
  cpu_set_t set, own;
  int last = 0;
  struct sched_param parameters = {.sched_priority = 78};
  struct timespec now;
  sched_getaffinity(0, sizeof set, &set);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &set)) last = cpu;
  CPU_ZERO(&own);
  CPU_SET(last, &own);
  sched_setaffinity(0, sizeof own, &own);
  mlockall(MCL_CURRENT | MCL_FUTURE);
  if (sched_setscheduler(0, SCHED_FIFO, &parameters) != 0) fprintf(stderr, "no right to use SCHED_FIFO\n");
  clock_gettime(CLOCK_MONOTONIC, &now);
  long long next = now.tv_sec * 1000000000LL + now.tv_nsec + period, seen = 0;
  for (long long i = 0; i < n; ++i, next += period) {
    struct timespec until = {next / 1000000000, next % 1000000000};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL);
    clock_gettime(CLOCK_MONOTONIC, &now);
    long long late = (now.tv_sec * 1000000000LL + now.tv_nsec - next) / 1000;
    ++counts[late < 0 ? 0 : late < 2047 ? late : 2047];
  }
  for (int i = 0; i < 2048; ++i) {
    seen += counts[i];
    if (seen * 1000 >= n * 999) {
      printf("%d\n", i + 1);
      return 0;
    }
  }
  return 0;
}

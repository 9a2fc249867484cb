// SPDX-License-Identifier: Apache-2.0
/* Times a cycle of timers in the shared library of `rung build`, as a host calls it. Arguments: the library, and the
 * limit in microseconds. Task T_n is measured, after task S_n has set its inputs; a cycle is 10 ms of program time.
 * Prints the CPU time of the fastest and of the median cycle of each; exits with 1 when a median is over the limit. */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "rung/module.h"

enum { CYCLES = 2000 };

static double cpu_microseconds(void) {
  struct timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return (double)time.tv_sec * 1e6 + (double)time.tv_nsec * 1e-3;
}

static int compared(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

static void* memory(uint64_t size) {
  void* const block = aligned_alloc(64, (size + 127) / 64 * 64);
  if (block == NULL) exit(2);
  return memset(block, 0, size);
}

static void run(rung_context* context, void (*code)(rung_context*)) {
  if (rung_guarded(context, code) != RUNG_FAULT_NONE) {
    fprintf(stderr, "the program faulted\n");
    exit(2);
  }
}

static const rung_task* task_named(const rung_module* module, char kind, const char* name) {
  for (uint32_t t = 0; t < module->tasks.count; ++t) {
    const char* const task = module->strings + rung_task_at(module, t)->name;
    if (task[0] == kind && strcmp(task + 1, name) == 0) return rung_task_at(module, t);
  }
  fprintf(stderr, "no task %c%s\n", kind, name);
  exit(2);
}

int main(int argc, char** argv) {
  void* const library = argc == 3 ? dlopen(argv[1], RTLD_NOW) : NULL;
  if (library == NULL) return 2;
  const double limit = atof(argv[2]);
  rung_module_function function;
  *(void**)&function = dlsym(library, "plc_module");
  const rung_module* const module = function();

  rung_host host;
  rung_context context;
  memset(&host, 0, sizeof host);
  memset(&context, 0, sizeof context);
  context.blocks = memory(module->blocks.count * sizeof(void*));
  context.areas = memory(module->areas.count * sizeof(void*));
  for (uint32_t i = 0; i < module->blocks.count; ++i) context.blocks[i] = memory(rung_block_at(module, i)->size);
  for (uint32_t i = 0; i < module->areas.count; ++i) context.areas[i] = memory(rung_area_at(module, i)->size + 8);
  context.module = module;
  context.host = &host;
  run(&context, module->init);

  int too_slow = 0;
  for (uint32_t t = 0; t < module->tasks.count; ++t) {
    const char* const name = module->strings + rung_task_at(module, t)->name;
    if (name[0] != 'T') continue;
    const rung_task* const setting = task_named(module, 'S', name + 1);
    static double cycles[CYCLES];
    for (int cycle = 0; cycle < CYCLES; ++cycle) {
      context.now_ns = cycle * INT64_C(10000000);
      run(&context, setting->run);
      const double begin = cpu_microseconds();
      run(&context, rung_task_at(module, t)->run);
      cycles[cycle] = cpu_microseconds() - begin;
    }
    qsort(cycles, CYCLES, sizeof cycles[0], compared);
    printf("%-10s %6.1f us fastest, %6.1f us median\n", name + 2, cycles[0], cycles[CYCLES / 2]);
    too_slow |= cycles[CYCLES / 2] > limit;
  }
  return too_slow;
}

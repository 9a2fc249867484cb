// SPDX-License-Identifier: Apache-2.0
/* A host that counts what is allocated while a program runs. Arguments: shared libraries of `rung build`. Each runs a
 * thousand cycles of 10 ms of all its tasks. The functions of counted_malloc.h replace those of the C library in the
 * whole process. Called by no_allocation.test. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rung/module.h"

enum { CYCLES = 1000 };

static int in_cycle;
static unsigned calls;

static void note(void) { calls += in_cycle != 0; }

#include "counted_malloc.h"

static void* memory(uint64_t size) { return memset(aligned_alloc(64, (size + 127) / 64 * 64), 0, size); }

static void run_all(const char* path) {
  void* const library = dlopen(path, RTLD_NOW);
  rung_host host;
  rung_context context;
  rung_module_function function;
  const rung_module* module;
  if (library == NULL) exit(2);
  *(void**)&function = dlsym(library, "plc_module");
  module = function();
  memset(&host, 0, sizeof host);
  memset(&context, 0, sizeof context);
  context.blocks = memory(module->blocks.count * sizeof(void*));
  context.areas = memory(module->areas.count * sizeof(void*));
  for (uint32_t i = 0; i < module->blocks.count; ++i) context.blocks[i] = memory(rung_block_at(module, i)->size);
  for (uint32_t i = 0; i < module->areas.count; ++i) context.areas[i] = memory(rung_area_at(module, i)->size + 8);
  context.module = module;
  context.host = &host;
  calls = 0;
  in_cycle = 1;
  int faults = rung_guarded(&context, module->init) != RUNG_FAULT_NONE;
  for (int cycle = 0; cycle < CYCLES && faults == 0; ++cycle) {
    context.now_ns = cycle * INT64_C(10000000);
    for (uint32_t t = 0; t < module->tasks.count; ++t)
      faults += rung_guarded(&context, rung_task_at(module, t)->run) != RUNG_FAULT_NONE;
  }
  in_cycle = 0;
  if (faults != 0) {
    const rung_site* const site = rung_site_at(module, context.fault.site);
    printf("%s: fault in %s\n", path, module->strings + site->pou);
  }
  printf("%s: %u calls of malloc and free\n", path, calls);
}

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) run_all(argv[i]);
  return 0;
}

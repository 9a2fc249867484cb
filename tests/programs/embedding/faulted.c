// SPDX-License-Identifier: Apache-2.0
/* A host that is told of each fault while the code that faulted is still on the stack (`host->faulted`), and that reads
 * its call path afterwards. Prints what it was told. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "rung/module.h"

const rung_module *plant_module(void);

static int inside;    /* a task runs */
static uintptr_t top; /* of the stack, where the task was called */

static void told(void *data, const rung_context *context) {
  const rung_module *module = context->module;
  const rung_site *site = rung_site_at(module, context->fault.site);
  char here;
  *(unsigned *)data += 1;
  printf("told: kind %u in %s, line %u, value %lld; the task %s, %s its stack\n", context->fault.kind,
         module->strings + site->pou, site->line, (long long)context->fault.value, inside ? "runs" : "has returned",
         (uintptr_t)&here < top ? "below" : "above");
}

int main(void) {
  const rung_module *module = plant_module();
  unsigned count = 0;
  rung_host host = {0};
  rung_context context = {0};
  uint64_t image[3][16] = {{0}};
  uint8_t *areas[] = {(uint8_t *)image[0], (uint8_t *)image[1], (uint8_t *)image[2]};
  void *blocks[16];
  char mark;
  host.faulted = told;
  context.module = module;
  context.host = &host;
  context.host_data = &count;
  context.areas = areas;
  context.blocks = blocks;
  for (uint32_t i = 0; i < module->blocks.count; ++i) blocks[i] = aligned_alloc(64, (rung_block_at(module, i)->size + 63) / 64 * 64);
  if (rung_guarded(&context, module->init) != RUNG_FAULT_NONE) return 1;
  top = (uintptr_t)&mark;
  for (int cycle = 0; cycle < 4; ++cycle) {
    inside = 1;
    const uint8_t fault = rung_guarded(&context, rung_task_at(module, 0)->run);
    inside = 0;
    printf("cycle %d: fault %u, told %u times\n", cycle, fault, count);
    if (fault == RUNG_FAULT_NONE) continue;
    for (uint32_t k = 0; k < context.caller_count; ++k) {
      const rung_site *site = rung_site_at(module, context.callers[k].site);
      printf("  called in %s, line %u\n", module->strings + site->pou, site->line);
    }
  }
  for (uint32_t i = 0; i < module->blocks.count; ++i) free(blocks[i]);
  return 0;
}

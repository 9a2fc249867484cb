/* The smallest product that runs a compiled project: it owns all memory, runs the cyclic tasks in virtual time and
 * prints one symbol. Built and run by tests/programs/embedding. See docs/embedding.md. */
#include <stdio.h>
#include <string.h>

#include "rung/module.h"

const rung_module *plant_module(void); /* from the compiled project: <--name>_module */

#define MAX_BLOCKS 16
static _Alignas(8) unsigned char memory[64 * 1024]; /* a product places blocks where it likes: RAM, battery-backed RAM */
static void *blocks[MAX_BLOCKS];
static _Alignas(8) unsigned char inputs[1024], outputs[1024], flags[1024]; /* %I, %Q, %M */
static uint8_t *areas[] = {inputs, outputs, flags};

/* Puts each block at its alignment; 0 when the memory or an area is too small. */
static int allocate_blocks(const rung_module *module) {
  size_t next = 0;
  for (uint32_t i = 0; i < module->block_count; ++i) {
    const rung_block *block = &module->blocks[i];
    next = (next + block->align - 1) / block->align * block->align;
    if (i >= MAX_BLOCKS || next + block->size > sizeof memory) return 0;
    blocks[i] = memory + next;
    next += block->size;
  }
  for (uint32_t i = 0; i < module->area_count; ++i)
    if (i >= 3 || module->areas[i].size > sizeof inputs) return 0;
  return 1;
}

int main(void) {
  const rung_module *module = plant_module();
  if (module->abi != RUNG_MODULE_ABI || !allocate_blocks(module)) return 2;

  rung_context context = {.blocks = blocks, .areas = areas, .module = module};
  module->init(&context);

  for (int cycle = 0; cycle < 5; ++cycle) {
    inputs[0] = cycle > 0; /* the product reads its inputs: %IX0.0 */
    for (uint32_t t = 0; t < module->task_count; ++t) {
      context.now_ns = cycle * module->tasks[t].interval_ns;
      if (rung_guarded(&context, module->tasks[t].run) != RUNG_FAULT_NONE) {
        const rung_site *site = &module->sites[context.fault.site];
        printf("fault in %s, line %u\n", module->strings + site->pou, (unsigned)site->line);
        memset(outputs, 0, sizeof outputs); /* safe outputs */
        return 3;
      }
    }
    printf("cycle %d: outputs %02x\n", cycle, outputs[0]); /* ... and writes its outputs: %QB0 */
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
/* Two compiled projects in one firmware: each has its own prefix, blocks and areas. */
#include <stdio.h>

#include "rung/module.h"

const rung_module *plant_module(void);
const rung_module *cooler_module(void);

typedef struct unit {
  _Alignas(8) unsigned char memory[4096];
  unsigned char images[3][16];
  uint8_t *areas[3];
  void *blocks[8];
  rung_context context;
} unit;

static int start(unit *u, const rung_module *module) {
  size_t next = 0;
  if (module->blocks.count > 8) return 0;
  for (uint32_t i = 0; i < module->blocks.count; ++i) {
    const rung_block *block = rung_block_at(module, i);
    next = (next + block->align - 1) / block->align * block->align;
    u->blocks[i] = u->memory + next;
    next += block->size;
  }
  for (uint32_t area = 0; area < module->areas.count; ++area) {
    if (area >= 3 || rung_area_at(module, area)->size > sizeof u->images[area]) return 0;
    u->areas[area] = u->images[area];
  }
  u->context.areas = u->areas;
  u->context.blocks = u->blocks;
  u->context.module = module;
  if (next > sizeof u->memory) return 0;
  module->init(&u->context);
  return 1;
}

static unit plant, cooler;

int main(void) {
  if (!start(&plant, plant_module()) || !start(&cooler, cooler_module())) return 2;
  for (int cycle = 0; cycle < 4; ++cycle) {
    plant.images[0][0] = 1;
    plant.context.now_ns = cycle * rung_task_at(plant.context.module, 0)->interval_ns;
    cooler.context.now_ns = plant.context.now_ns;
    if (rung_guarded(&plant.context, rung_task_at(plant.context.module, 0)->run) != RUNG_FAULT_NONE) return 3;
    if (rung_guarded(&cooler.context, rung_task_at(cooler.context.module, 0)->run) != RUNG_FAULT_NONE) return 3;
    printf("%d: plant %d, cooler %d\n", cycle, plant.images[1][0], cooler.images[1][0]);
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
/* Runs one cycle of a module and writes its memory as it is: block0, block1, ..., areaI, areaQ, areaM. */
#include <stdio.h>

#include "rung/module.h"

const rung_module *plant_module(void);

static uint64_t memory[16][1024];
static uint64_t images[3][64];

static void write_file(const char *name, const void *bytes, size_t size) {
  FILE *file = fopen(name, "wb");
  if (file == NULL || fwrite(bytes, 1, size, file) != size || fclose(file) != 0) printf("%s was not written\n", name);
}

int main(void) {
  const rung_module *module = plant_module();
  void *blocks[16];
  uint8_t *areas[3];
  char name[40];
  rung_context context = {.blocks = blocks, .areas = areas, .module = module};
  for (int i = 0; i < 16; ++i) blocks[i] = memory[i];
  for (int i = 0; i < 3; ++i) areas[i] = (uint8_t *)images[i];
  if (module->blocks.count > 16 || module->areas.count != 3 || module->tasks.count != 1) return 2;
  if (rung_guarded(&context, module->init) != RUNG_FAULT_NONE) return 3;
  if (rung_guarded(&context, rung_task_at(module, 0)->run) != RUNG_FAULT_NONE) return 3;
  for (uint32_t i = 0; i < module->blocks.count; ++i) {
    snprintf(name, sizeof name, "block%u", (unsigned)i);
    write_file(name, blocks[i], rung_block_at(module, i)->size);
  }
  for (uint32_t i = 0; i < 3; ++i) {
    snprintf(name, sizeof name, "area%s", module->strings + rung_area_at(module, i)->name);
    write_file(name, areas[i], rung_area_at(module, i)->size);
  }
  return 0;
}

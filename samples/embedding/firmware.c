/* The smallest product that runs a compiled project: it owns all memory, runs the cyclic tasks in virtual time and
 * prints a trace like that of `rung run`. C99, for any processor. Built and run by tests/programs/embedding. See
 * docs/embedding.md. */
#include <stdio.h>
#include <string.h>

#include "rung/module.h"
#include "rung/values.h"

const rung_module *plant_module(void); /* from the compiled project: <--name>_module */

#define MAX_BLOCKS 16
static uint64_t memory[1024]; /* a product places blocks where it likes: RAM, battery-backed RAM */
static void *blocks[MAX_BLOCKS];
static uint64_t inputs[16], outputs[16], flags[16]; /* %I, %Q, %M */
static uint8_t *areas[] = {(uint8_t *)inputs, (uint8_t *)outputs, (uint8_t *)flags};

/* Puts each block at its alignment; 0 when the memory or an area is too small. */
static int allocate_blocks(const rung_module *module) {
  size_t next = 0;
  for (uint32_t i = 0; i < module->block_count; ++i) {
    const rung_block *block = &module->blocks[i];
    next = (next + block->align - 1) / block->align * block->align;
    if (i >= MAX_BLOCKS || next + block->size > sizeof memory) return 0;
    blocks[i] = (uint8_t *)memory + next;
    next += block->size;
  }
  for (uint32_t i = 0; i < module->area_count; ++i)
    if (i >= 3 || module->areas[i].size > sizeof inputs) return 0;
  return 1;
}

/* Prints a variable of an elementary type: a located variable, or one of a program (`Main.level`). */
static void print(const rung_module *module, const char *path) {
  const char *dot = strchr(path, '.');
  for (uint32_t i = 0; i < module->symbol_count; ++i) {
    const rung_symbol *symbol = &module->symbols[i];
    const rung_type *type = &module->types[symbol->type];
    const char *name = module->strings + symbol->name;
    const uint8_t *value = (symbol->storage == RUNG_IN_AREA ? areas[symbol->index] : (uint8_t *)blocks[symbol->index]) +
                           symbol->offset;
    uint8_t bit;
    char text[RUNG_FORMATTED_SCALAR + 5 * 80];
    if (strcmp(name, path) != 0) {
      uint32_t f = 0;
      if (strlen(name) != (size_t)(dot - path) || memcmp(name, path, strlen(name)) != 0) continue;
      while (f < type->count && strcmp(module->strings + module->fields[type->first + f].name, dot + 1) != 0) ++f;
      if (f == type->count) continue;
      value += module->fields[type->first + f].offset;
      type = &module->types[module->fields[type->first + f].type];
    } else if (symbol->bit < 8) {
      bit = *value >> symbol->bit & 1;
      value = &bit;
    }
    rung_format(type->kind, type->is_signed != 0, value, text, sizeof text - 1);
    printf(",%s", text);
  }
}

int main(void) {
  static const char *const watched[] = {"Main.lamp", "Main.pump", "Main.level", "Main.starts", "Main.message"};
  const size_t watched_count = sizeof watched / sizeof *watched;
  const rung_module *module = plant_module();
  rung_context context = {.blocks = blocks, .areas = areas};
  if (module->abi != RUNG_MODULE_ABI || !allocate_blocks(module)) return 2;
  context.module = module;
  module->init(&context);

  printf("cycle,time_ms");
  for (size_t i = 0; i < watched_count; ++i) printf(",%s", watched[i]);
  printf("\n");
  for (int cycle = 0; cycle < 6; ++cycle) {
    areas[0][0] = cycle > 0; /* the product reads its inputs: %IX0.0 */
    for (uint32_t t = 0; t < module->task_count; ++t) {
      context.now_ns = cycle * module->tasks[t].interval_ns;
      if (rung_guarded(&context, module->tasks[t].run) != RUNG_FAULT_NONE) {
        const rung_site *site = &module->sites[context.fault.site];
        printf("fault in %s, line %u\n", module->strings + site->pou, (unsigned)site->line);
        memset(outputs, 0, sizeof outputs); /* safe outputs */
        return 3;
      }
    }
    /* ... and writes its outputs here: areas[1] is %QB0 */
    printf("%d,%ld", cycle, (long)(context.now_ns / 1000000));
    for (size_t i = 0; i < watched_count; ++i) print(module, watched[i]);
    printf("\n");
  }
  return 0;
}

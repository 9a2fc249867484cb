// SPDX-License-Identifier: Apache-2.0
/* Runs three cycles and prints every elementary variable of the program instances after each: `path = value`. */
#include <stdio.h>
#include <string.h>

#include "rung/module.h"
#include "rung/values.h"

const rung_module *types_module(void);

static uint64_t memory[4096];
static void *blocks[16];
static uint64_t images[3][16];
static uint8_t *areas[] = {(uint8_t *)images[0], (uint8_t *)images[1], (uint8_t *)images[2]};

static void print(const rung_module *module, const char *path, uint32_t number, const uint8_t *at) {
  const rung_type *type = rung_type_at(module, number);
  char text[2000];
  if (type->kind == RUNG_RECORD) {
    if (strstr(module->strings + type->name, "T_Arg") != NULL) return; /* holds addresses */
    for (uint32_t f = type->first; f < type->first + type->count; ++f) {
      const rung_field *field = rung_field_at(module, f);
      if (field->flags & (RUNG_FIELD_BY_REFERENCE | RUNG_FIELD_BIT)) continue;
      snprintf(text, sizeof text, "%s.%s", path, module->strings + field->name);
      print(module, text, field->type, at + field->offset);
    }
    return;
  }
  if (type->kind == RUNG_ARRAY) {
    const uint32_t size = rung_type_at(module, type->element)->size;
    for (uint32_t i = 0; i < type->size / size; ++i) {
      snprintf(text, sizeof text, "%s[%u]", path, (unsigned)i);
      print(module, text, type->element, at + i * size);
    }
    return;
  }
  if (type->kind == RUNG_POINTER) return;
  if (type->kind == RUNG_ENUM) type = rung_type_at(module, type->element);
  rung_format(type->kind, type->is_signed != 0, at, text, sizeof text - 1);
  printf("%s = %s\n", path, text);
}

int main(void) {
  const rung_module *module = types_module();
  rung_context context = {.blocks = blocks, .areas = areas};
  size_t next = 0;
  if (module->abi != RUNG_MODULE_ABI || module->layout != RUNG_MODULE_LAYOUT) return 2;
  for (uint32_t i = 0; i < module->blocks.count; ++i) {
    next = (next + 15) / 16 * 16;
    blocks[i] = (uint8_t *)memory + next;
    next += rung_block_at(module, i)->size;
    if (i >= 16 || next > sizeof memory) return 2;
  }
  context.module = module;
  if (rung_guarded(&context, module->init) != RUNG_FAULT_NONE) return 3;
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (uint32_t t = 0; t < module->tasks.count; ++t) {
      context.now_ns = cycle * rung_task_at(module, t)->interval_ns;
      const uint8_t fault = rung_guarded(&context, rung_task_at(module, t)->run);
      if (fault != RUNG_FAULT_NONE) printf("fault %u in line %u\n", fault, (unsigned)rung_site_at(module, context.fault.site)->line);
    }
    for (uint32_t s = 0; s < module->symbols.count; ++s) {
      const rung_symbol *symbol = rung_symbol_at(module, s);
      if (symbol->storage == RUNG_IN_BLOCK)
        print(module, module->strings + symbol->name, symbol->type, (uint8_t *)blocks[symbol->index] + symbol->offset);
    }
  }
  return 0;
}

/* SPDX-License-Identifier: Apache-2.0 */
#include "board.h"

#include <stdio.h>
#include <string.h>

#include "plant_tasks.h"
#include "rtos.h"
#include "rung/values.h"

static const char* const watched[] = {"Main.lamp",   "Main.pump",        "horn",        "level",
                                      "Main.starts", "Recorder.highest", "Alarm.alarms"};
#define WATCHED (sizeof watched / sizeof *watched)

void board_read(uint8_t* inputs, size_t bytes) {
  memset(inputs, 0, bytes);
  inputs[0] = rtos_now() >= 10;
}

void board_write(const uint8_t* outputs, size_t bytes) {
  (void)outputs; /* pins of a processor */
  (void)bytes;
}

bool board_runs(uint32_t tick) { return tick < 120; }

/* Prints a global variable (`level`), a located variable (`Main.lamp`) or another one of a program (`Main.starts`). */
static void print(const rung_context* context, const char* path) {
  const rung_module* module = context->module;
  const char* dot = strchr(path, '.');
  char text[RUNG_FORMATTED_SCALAR];
  for (uint32_t i = 0; i < module->symbols.count; ++i) {
    const rung_symbol* symbol = rung_symbol_at(module, i);
    const rung_type* type = rung_type_at(module, symbol->type);
    const char* name = module->strings + symbol->name;
    const uint8_t* memory =
        symbol->storage == RUNG_IN_AREA ? context->areas[symbol->index] : context->blocks[symbol->index];
    const uint8_t* value = memory + symbol->offset;
    uint8_t bit;
    if (strcmp(name, path) != 0) {
      const rung_field* field = NULL;
      if (dot == NULL || strlen(name) != (size_t)(dot - path) || memcmp(name, path, strlen(name)) != 0) continue;
      for (uint32_t f = 0; f < type->count && field == NULL; ++f) {
        const rung_field* candidate = rung_field_at(module, type->first + f);
        if (strcmp(module->strings + candidate->name, dot + 1) == 0) field = candidate;
      }
      if (field == NULL) continue;
      value += field->offset;
      type = rung_type_at(module, field->type);
    } else if (symbol->bit < 8) {
      bit = *value >> symbol->bit & 1;
      value = &bit;
    }
    rung_format(type->kind, type->is_signed != 0, value, text, sizeof text);
    printf(",%s", text);
    return;
  }
}

void board_trace(uint32_t tick) {
  if (tick % 10 != 0) return;
  if (tick == 0) {
    printf("cycle,time_ms");
    for (size_t i = 0; i < WATCHED; ++i) printf(",%s", watched[i]);
    printf("\n");
  }
  printf("%u,%u", (unsigned)(tick / 10), (unsigned)tick);
  for (size_t i = 0; i < WATCHED; ++i) print(plant_context(), watched[i]);
  printf("\n");
}

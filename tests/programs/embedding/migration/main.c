// SPDX-License-Identifier: Apache-2.0
/* Brings values of one version of a program to another: retained ones by a slot with a directory, then all of them from
 * memory to memory. Prints what is lost, and the new version's variables. C99, for any processor. */
#include <stdio.h>
#include <string.h>

#include "rung/module.h"
#include "rung/monitor.h"
#include "rung/retain.h"

const rung_module *before_module(void);
const rung_module *after_module(void);

enum { MOST_BLOCKS = 4 };
struct machine {
  uint64_t memory[MOST_BLOCKS][256], areas[3][8];
  void *blocks[MOST_BLOCKS];
  uint8_t *area_list[3];
  rung_context context;
};
static struct machine old_version, new_version;
static uint64_t slot[512];
static char path[128];

static int begin(struct machine *machine, const rung_module *module) {
  memset(machine, 0, sizeof *machine);
  for (uint32_t i = 0; i < MOST_BLOCKS; ++i) machine->blocks[i] = machine->memory[i];
  for (uint32_t i = 0; i < 3; ++i) machine->area_list[i] = (uint8_t *)machine->areas[i];
  machine->context.blocks = machine->blocks;
  machine->context.areas = machine->area_list;
  machine->context.module = module;
  if (module->blocks.count > MOST_BLOCKS || rung_block_at(module, 0)->size > sizeof machine->memory[0]) return 0;
  return rung_guarded(&machine->context, module->init) == RUNG_FAULT_NONE;
}

static void on_lost(void *data, const char *variable, rung_loss why, const char *old_type, const char *new_type) {
  static const char *const reasons[] = {"missing", "another type", "not retained"};
  (void)data;
  printf("  %s: %s, %s > %s\n", variable, reasons[why], old_type, new_type);
}

static rung_walk print(void *data, const rung_part *part) {
  char text[80];
  (void)data;
  if (part->variable->type->kind >= RUNG_ARRAY) return RUNG_WALK_ENTER;
  rung_read_text(&new_version.context, part->variable, text, sizeof text - 1);
  printf("  %s = %s\n", part->path, text);
  return RUNG_WALK_SKIP;
}

static void print_all(void) {
  const rung_module *module = new_version.context.module;
  for (uint32_t i = 0; i < module->symbols.count; ++i) {
    rung_variable variable;
    rung_variable_of_symbol(module, i, &variable);
    rung_path_of_symbol(module, i, path, sizeof path);
    rung_walk_variable(module, &variable, path, sizeof path, print, NULL);
  }
}

static void keep(rung_context *context, rung_migration *migration) {
  const uint32_t values = rung_retain_bytes(context->module);
  const uint32_t size =
      rung_retain_directory(context->module, (char *)slot + values, sizeof slot - values, migration);
  rung_retain_pack(context, slot);
  if (values + size > sizeof slot) printf("the slot is too small\n");
  ((rung_slot *)slot)->length += size;
  rung_retain_seal(slot, 1);
}

int main(void) {
  rung_migration migration = {path, sizeof path, on_lost, NULL, 0, 0};
  rung_context *context = &old_version.context;
  if (!begin(&old_version, before_module())) return 2;
  context->now_ns = 30000000;
  if (rung_guarded(context, rung_task_at(context->module, 0)->run) != RUNG_FAULT_NONE) return 3;
  keep(context, &migration);
  if (!rung_retain_is_complete(slot, sizeof slot)) return 4;

  for (int start = RUNG_COLD; start <= RUNG_WARM; ++start) {
    if (!begin(&new_version, after_module())) return 2;
    printf("%s\n", start == RUNG_COLD ? "cold" : "warm");
    if (rung_retain_unpack(&new_version.context, slot, (rung_start)start)) return 5;
    rung_retain_migrate(&new_version.context, slot, (rung_start)start, &migration);
  }
  print_all();
  printf("%u kept, %u lost, %u ms\n", (unsigned)migration.kept, (unsigned)migration.lost_count,
         (unsigned)(new_version.context.now_ns / 1000000));

  printf("from memory to memory\n");
  if (!begin(&new_version, after_module())) return 2;
  migration.kept = migration.lost_count = 0;
  rung_migrate(before_module(), context, after_module(), &new_version.context, &migration);
  print_all();
  printf("%u kept, %u lost\n", (unsigned)migration.kept, (unsigned)migration.lost_count);
  return 0;
}

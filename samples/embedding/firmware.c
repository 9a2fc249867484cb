/* The smallest product that runs a compiled project: it owns all memory, runs the tasks of a resource one at a time in
 * virtual time, keeps retained data in two regions of memory, forces a variable and prints a trace like that of
 * `rung run`. C99, for any processor. Built and run by tests/programs/embedding. See docs/embedding.md. */
#include <stdio.h>
#include <string.h>

#include "rung/module.h"
#include "rung/monitor.h"
#include "rung/retain.h"
#include "rung/values.h"

const rung_module *plant_module(void); /* from the compiled project: <--name>_module */

#define MAX_BLOCKS 16
#define MAX_TASKS 8
static uint64_t memory[1024]; /* a product places blocks where it likes: RAM, battery-backed RAM */
static void *blocks[MAX_BLOCKS];
static uint64_t inputs[16], outputs[16], flags[16]; /* %I, %Q, %M */
static uint8_t *areas[] = {(uint8_t *)inputs, (uint8_t *)outputs, (uint8_t *)flags};
static uint64_t fram[2][128]; /* two slots of retained data: memory that keeps its content */
static uint64_t sequence;
static uint32_t directory_size; /* of the names of retained variables, for a later version of the program */
static uint8_t has_directory[2];
static rung_forced forced[4]; /* what a service engineer may force at once */
static uint8_t forced_values[64];
static rung_forces forces = {forced, 4, 0, forced_values, sizeof forced_values, 0};
static rung_task_state states[MAX_TASKS]; /* statistics, which the program may read */
static int64_t started_at;                /* the common begin of all periods */
static uint8_t was_true[MAX_TASKS];       /* triggers of event tasks at the last sample */

/* Puts each block at its alignment; 0 when the memory or an area is too small. */
static int allocate(const rung_module *module) {
  size_t next = 0;
  for (uint32_t i = 0; i < module->blocks.count; ++i) {
    const rung_block *block = rung_block_at(module, i);
    next = (next + block->align - 1) / block->align * block->align;
    if (i >= MAX_BLOCKS || next + block->size > sizeof memory) return 0;
    blocks[i] = (uint8_t *)memory + next;
    next += block->size;
  }
  for (uint32_t i = 0; i < module->areas.count; ++i)
    if (i >= 3 || rung_area_at(module, i)->size > sizeof inputs) return 0;
  return module->tasks.count <= MAX_TASKS && rung_retain_bytes(module) <= sizeof fram[0];
}

static void print(const rung_context *context, const char *path) {
  rung_variable variable;
  char text[RUNG_FORMATTED_SCALAR + 5 * 80];
  if (!rung_find(context->module, path, &variable)) return;
  rung_read_text(context, &variable, text, sizeof text - 1);
  printf(",%s", text);
}

static int is_true(const rung_context *context, const char *path) {
  rung_variable variable;
  uint8_t value = 0;
  return rung_find(context->module, path, &variable) && rung_read_value(context, &variable, &value, 1) && value != 0;
}

/* Whether a task runs in the cycle that begins at `now`. */
static int is_due(const rung_context *context, uint32_t t, int64_t now) {
  const rung_module *module = context->module;
  const rung_task *task = rung_task_at(module, t);
  uint8_t before = was_true[t];
  if (task->kind == RUNG_CYCLIC) return (now - started_at) % task->interval_ns == 0;
  if (task->kind == RUNG_FREEWHEELING) return 1;
  if (task->kind == RUNG_EXTERNAL) return 0; /* a product starts them from its interrupts */
  was_true[t] = (uint8_t)is_true(context, module->strings + task->trigger);
  return was_true[t] && (task->kind == RUNG_STATUS || !before);
}

/* The program stops: outputs get their safe values. */
static void make_outputs_safe(rung_context *context) {
  memset(outputs, 0, sizeof outputs);
  if (context->module->safe != NULL) rung_guarded(context, context->module->safe);
}

static void on_lost(void *data, const char *path, rung_loss why, const char *old_type, const char *new_type) {
  (void)data;
  printf("%s (%s): %s%s\n", path, old_type, why == RUNG_LOSS_TYPE ? "now " : "lost", new_type);
}

/* No task runs: the values are those of a complete cycle. The older slot is written, the names once. */
static void keep(rung_context *context) {
  static char path[128];
  rung_migration migration = {path, sizeof path, NULL, NULL, 0, 0};
  const uint32_t values = rung_retain_bytes(context->module), n = sequence % 2;
  char *slot = (char *)fram[n];
  rung_retain_pack(context, slot);
  if (!has_directory[n])
    directory_size = rung_retain_directory(context->module, slot + values, sizeof fram[n] - values, &migration);
  has_directory[n] = 1;
  if (directory_size <= sizeof fram[n] - values) ((rung_slot *)fram[n])->length += directory_size;
  rung_retain_seal(slot, ++sequence);
}

/* All tasks of a cycle, by priority; 0 after a fault. A product with interrupts gives each priority a context of its
 * own. */
static int run_cycle(rung_context *context, int64_t now) {
  const rung_module *module = context->module;
  uint8_t due[MAX_TASKS];
  rung_apply_forces(context, &forces); /* the inputs have been taken */
  for (uint32_t t = 0; t < module->tasks.count; ++t) due[t] = (uint8_t)is_due(context, t, now);
  for (uint32_t priority = 0; priority < 32; ++priority) {
    for (uint32_t t = 0; t < module->tasks.count; ++t) {
      if (!due[t] || rung_task_at(module, t)->priority != priority) continue;
      context->now_ns = now;
      context->task = t + 1;
      context->activation = states[t].activations + 1;
      if (rung_guarded(context, rung_task_at(module, t)->run) != RUNG_FAULT_NONE) {
        const rung_site *site = rung_site_at(module, context->fault.site);
        printf("fault in %s, line %u\n", module->strings + site->pou, (unsigned)site->line);
        return 0;
      }
      rung_apply_forces(context, &forces); /* after the code, so before that of the next task and before the outputs */
      ++states[t].activations;             /* a product with a timer also measures last_ns, longest_ns, ... */
    }
  }
  keep(context);
  return 1;
}

/* Initial values, and what the last run left. */
static void start(rung_context *context, rung_start kind, int64_t now) {
  const void *newest = rung_retain_newest(fram[0], fram[1], sizeof fram[0]);
  started_at = context->now_ns = now;
  memset(was_true, 0, sizeof was_true);
  rung_guarded(context, context->module->init);
  if (newest != NULL && !rung_retain_unpack(context, newest, kind)) { /* of another version of the program */
    static char path[128];
    rung_migration migration = {path, sizeof path, on_lost, NULL, 0, 0};
    rung_retain_migrate(context, newest, kind, &migration);
  }
}

int main(void) {
  static const char *const watched[] = {"Main.lamp",   "Main.pump",        "horn",         "level",
                                        "Main.starts", "Recorder.highest", "Alarm.alarms", "Main.message"};
  const size_t watched_count = sizeof watched / sizeof *watched;
  const rung_module *module = plant_module();
  rung_context context = {.blocks = blocks, .areas = areas, .task_states = states};
  if (module->abi != RUNG_MODULE_ABI || !allocate(module)) return 2;
  context.module = module;
  rung_variable level;
  if (!rung_find(module, "level", &level)) return 2;
  start(&context, RUNG_COLD, 0);

  printf("cycle,time_ms");
  for (size_t i = 0; i < watched_count; ++i) printf(",%s", watched[i]);
  printf("\n");
  for (int cycle = 0; cycle < 12; ++cycle) {
    const int64_t now = (int64_t)cycle * 10000000;
    areas[0][0] = cycle > 0; /* the product reads its inputs: %IX0.0 */
    if (cycle == 7) {        /* the power fails: all memory but the two slots is lost */
      memset(memory, 0xa5, sizeof memory);
      memset(outputs, 0, sizeof outputs);
      start(&context, RUNG_WARM, now);
    }
    if (cycle == 9) rung_force_text(&forces, module, &level, "3.0", 3); /* the service port of the product */
    if (cycle == 11) rung_unforce(&forces, &level);
    if (!run_cycle(&context, now)) {
      make_outputs_safe(&context);
      return 3;
    }
    /* ... and writes its outputs here: areas[1] is %QB0 */
    printf("%d,%ld", cycle, (long)(now / 1000000));
    for (size_t i = 0; i < watched_count; ++i) print(&context, watched[i]);
    printf("\n");
  }
  make_outputs_safe(&context);
  printf("safe outputs: %u; activations:", (unsigned)areas[1][0]);
  for (uint32_t t = 0; t < module->tasks.count; ++t)
    printf(" %s %u", module->strings + rung_task_at(module, t)->name, (unsigned)states[t].activations);
  printf("\n");
  return 0;
}

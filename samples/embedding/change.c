/* A product that changes its program while it runs: two versions of a plant are linked here, where a product's loader
 * would bring the second one. It owns all memory, makes a plan, asks whether the change is possible, and lets the new
 * version take over between two activations. C99. Built and run by tests/programs/embedding. See docs/embedding.md. */
#include <stdio.h>
#include <string.h>

#include "rung/change.h"
#include "rung/monitor.h"
#include "rung/values.h"

const rung_module *old_module(void);
const rung_module *new_module(void);

#define MAX_BLOCKS 16
static uint64_t memory[2][512]; /* one for each version: blocks that stay are used where they are */
static void *blocks[2][MAX_BLOCKS];
static uint64_t inputs[16], outputs[16], flags[16]; /* %I, %Q, %M */
static uint8_t *areas[] = {(uint8_t *)inputs, (uint8_t *)outputs, (uint8_t *)flags};

/* What a plan needs. */
static char path[128], target[128];
static uint32_t same[256], kept[MAX_BLOCKS];
static uint8_t image[sizeof inputs + sizeof outputs + sizeof flags];
static rung_move moves[128];
static rung_holder holders[64];

/* Places the blocks of a version that do not stay; 0 when the memory is too small. */
static int allocate(const rung_module *module, int version, const uint32_t *stay) {
  size_t next = 0;
  for (uint32_t i = 0; i < module->blocks.count; ++i) {
    const rung_block *block = rung_block_at(module, i);
    if (i >= MAX_BLOCKS) return 0;
    if (stay != NULL && stay[i] != RUNG_NONE) {
      blocks[version][i] = blocks[1 - version][stay[i]];
      continue;
    }
    next = (next + block->align - 1) / block->align * block->align;
    if (next + block->size > sizeof memory[version]) return 0;
    blocks[version][i] = (uint8_t *)memory[version] + next;
    next += block->size;
  }
  return 1;
}

static void on_note(void *data, const rung_change_note *note) {
  static const char *const kinds[] = {"initialised", "removed", "refused"};
  (void)data;
  printf("  %s %s (%d) %s %s\n", kinds[note->kind], note->path, (int)note->reason, note->old_text, note->new_text);
}

/* 1: the new version has taken over. */
static int change(rung_context *context, rung_context *next) {
  rung_change plan = {.old_module = context->module, .module = next->module, .path = path, .target = target};
  rung_context *faulted = NULL;
  plan.path_capacity = sizeof path;
  plan.same = same;
  plan.kept = kept;
  plan.image = image;
  plan.moves = moves;
  plan.move_capacity = sizeof moves / sizeof *moves;
  plan.holders = holders;
  plan.holder_capacity = sizeof holders / sizeof *holders;
  plan.note = on_note;
  if (context->module->types.count > sizeof same / sizeof *same || !rung_plan_change(&plan)) return 0;
  if (!allocate(next->module, 1, kept)) return 0;
  /* From here on no activation runs: a product with interrupts disables those of its tasks. */
  if (!rung_check_change(&plan, context)) return 0;
  if (rung_apply_change(&plan, context, next, &faulted) != RUNG_FAULT_NONE) return 0;
  printf("%u variables keep their values\n", (unsigned)plan.kept_count);
  return 1;
}

static void print(const rung_context *context, const char *name) {
  rung_variable variable;
  char text[RUNG_FORMATTED_SCALAR + 5 * 80] = "-";
  if (rung_find(context->module, name, &variable)) rung_read_text(context, &variable, text, sizeof text - 1);
  printf(" %s = %s", name, text);
}

int main(void) {
  rung_context first = {.blocks = blocks[0], .areas = areas}, second = {.blocks = blocks[1], .areas = areas};
  rung_context *context = &first;
  first.module = old_module();
  second.module = new_module();
  if (!allocate(first.module, 0, NULL) || rung_guarded(&first, first.module->init) != RUNG_FAULT_NONE) return 2;
  for (int cycle = 0; cycle < 6; ++cycle) {
    if (cycle == 3 && change(&first, &second)) context = &second;
    context->now_ns = (int64_t)cycle * 10000000;
    for (uint32_t t = 0; t < context->module->tasks.count; ++t)
      if (rung_guarded(context, rung_task_at(context->module, t)->run) != RUNG_FAULT_NONE) return 3;
    printf("%d:", cycle);
    print(context, "Main.starts");
    print(context, "Main.pump.hours");
    print(context, "Main.pump.events");
    print(context, "Main.total");
    printf("\n");
  }
  return 0;
}

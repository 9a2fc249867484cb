/* SPDX-License-Identifier: Apache-2.0 */
/* The tasks of a compiled project as tasks of an RTOS: a static stack and a context for each, so that one may interrupt
 * another; the same order of priorities; cyclic tasks sleep until their next period, event tasks wait for the tick to
 * see their trigger. All memory is static. C99, for any RTOS that rtos.h can be written for. See docs/embedding.md. */
#include "plant_tasks.h"

#include <stdbool.h>
#include <string.h>

#include "rtos.h"

const rung_module* plant_module(void); /* from the compiled project: <--name>_module */

typedef struct plant_task {
  rtos_task rtos;
  uint64_t stack[RTOS_STACK_BYTES / 8];
  uint64_t images[PLANT_AREAS][PLANT_AREA_BYTES / 8]; /* its copy of the areas */
  uint8_t* areas[PLANT_AREAS];
  rung_context context;
  const uint8_t* trigger; /* of an event task; of a cyclic one null */
  uint8_t trigger_mask, was_true;
} plant_task;

static uint64_t memory[PLANT_MEMORY_BYTES / 8];
static void* blocks[PLANT_BLOCKS];
static uint64_t images[PLANT_AREAS][PLANT_AREA_BYTES / 8]; /* what tasks and the board exchange */
static uint8_t* areas[PLANT_AREAS];
static plant_task tasks[PLANT_TASKS];
static rung_task_state states[PLANT_TASKS]; /* statistics, which the program may read */
static uint32_t bus_task; /* reads inputs and writes outputs: the cyclic task with the shortest period */
static volatile bool stopped;
static rung_context start_context = {.blocks = blocks, .areas = areas, .task_states = states};

const rung_context* plant_context(void) { return &start_context; }

/* Puts each block at its alignment; false when the memory or an area is too small. */
static bool allocate(const rung_module* module) {
  size_t next = 0;
  for (uint32_t i = 0; i < module->blocks.count; ++i) {
    const rung_block* block = rung_block_at(module, i);
    next = (next + block->align - 1) / block->align * block->align;
    if (i >= PLANT_BLOCKS || next + block->size > sizeof memory) return false;
    blocks[i] = (uint8_t*)memory + next;
    next += block->size;
  }
  for (uint32_t i = 0; i < module->areas.count; ++i) {
    if (i >= PLANT_AREAS || rung_area_at(module, i)->size > sizeof images[i]) return false;
    areas[i] = (uint8_t*)images[i];
  }
  return module->tasks.count <= PLANT_TASKS;
}

/* Where a trigger is: a global variable, or one that a program locates at an address. */
static bool find_trigger(const rung_module* module, plant_task* self, const char* path) {
  for (uint32_t i = 0; i < module->symbols.count; ++i) {
    const rung_symbol* symbol = rung_symbol_at(module, i);
    if (strcmp(module->strings + symbol->name, path) != 0) continue;
    self->trigger =
        (symbol->storage == RUNG_IN_AREA ? areas[symbol->index] : (uint8_t*)blocks[symbol->index]) + symbol->offset;
    self->trigger_mask = symbol->bit < 8 ? (uint8_t)(1u << symbol->bit) : 0xff;
    return true;
  }
  return false;
}

/* Rung counts priorities from 0, the most urgent, to 31; the RTOS from 1 upwards. Those that the project uses keep
 * their order, and equal ones stay equal. */
static unsigned rtos_priority(const rung_module* module, uint32_t priority) {
  unsigned less_urgent = 0;
  for (uint32_t other = priority + 1; other < 32; ++other)
    for (uint32_t t = 0; t < module->tasks.count; ++t)
      if (rung_task_at(module, t)->priority == other) {
        ++less_urgent;
        break;
      }
  return 1 + less_urgent;
}

/* After a fault: no task runs any more, and outputs get their safe values. */
static void stop(void) {
  const rung_module* module = start_context.module;
  stopped = true;
  memset(areas[1], 0, rung_area_at(module, 1)->size);
  if (module->safe != NULL) rung_guarded(&start_context, module->safe);
  board_write(areas[1], rung_area_at(module, 1)->size);
}

/* One activation, on a copy of the areas: inputs do not change under it, and what it wrote leaves together. */
static void activate(plant_task* self) {
  const rung_module* module = start_context.module;
  const uint32_t t = (uint32_t)(self - tasks);
  const rung_task* task = rung_task_at(module, t);
  uint8_t fault;
  rtos_lock();
  if (t == bus_task) board_read(areas[0], rung_area_at(module, 0)->size);
  memcpy(self->images, images, sizeof images);
  rtos_unlock();
  self->context.now_ns = (int64_t)rtos_now() * RTOS_TICK_NS;
  self->context.activation = states[t].activations + 1;
  fault = rung_guarded(&self->context, task->run);
  rtos_lock();
  if (fault != RUNG_FAULT_NONE) {
    if (!stopped) stop();
  } else if (!stopped) {
    for (uint32_t w = task->first_write; w < task->first_write + task->write_count; ++w) {
      const rung_write* write = rung_write_at(module, w);
      uint8_t* to = areas[write->area] + write->offset;
      const uint8_t* from = self->areas[write->area] + write->offset;
      if (write->mask == 255)
        memcpy(to, from, write->size);
      else
        *to = (uint8_t)((*to & ~write->mask) | (*from & write->mask));
    }
    ++states[t].activations;
    if (t == bus_task) board_write(areas[1], rung_area_at(module, 1)->size);
  }
  rtos_unlock();
}

static void run_cyclic(void* argument) {
  plant_task* self = argument;
  const uint32_t t = (uint32_t)(self - tasks);
  const uint32_t period = (uint32_t)(rung_task_at(start_context.module, t)->interval_ns / RTOS_TICK_NS);
  for (uint32_t next = 0; !stopped;) {
    rtos_sleep_until(next);
    activate(self);
    for (next += period; (int32_t)(rtos_now() - next) >= (int32_t)period; next += period) ++states[t].overruns;
  }
  for (;;) rtos_wait();
}

static void run_on_event(void* argument) {
  plant_task* self = argument;
  while (!stopped) {
    rtos_wait();
    if (!stopped) activate(self);
  }
  for (;;) rtos_wait();
}

void plant_tick(void) {
  const rung_module* module = start_context.module;
  for (uint32_t t = 0; t < module->tasks.count; ++t) {
    plant_task* self = &tasks[t];
    uint8_t is_true;
    if (self->trigger == NULL) continue;
    is_true = (*self->trigger & self->trigger_mask) != 0;
    if (is_true && (rung_task_at(module, t)->kind == RUNG_STATUS || !self->was_true)) rtos_notify(&self->rtos);
    self->was_true = is_true;
  }
}

bool plant_start(void) {
  const rung_module* module = plant_module();
  bool has_bus_task = false;
  if (module->abi != RUNG_MODULE_ABI || !allocate(module)) return false;
  /* Copies of the global variables (docs/embedding.md) are more than this sample does. */
  if ((module->flags & RUNG_ALIGNED_GLOBALS) != 0 || module->resources.count > 1) return false;
  start_context.module = module;
  if (rung_guarded(&start_context, module->init) != RUNG_FAULT_NONE) return false;

  for (uint32_t t = 0; t < module->tasks.count; ++t) {
    const rung_task* task = rung_task_at(module, t);
    plant_task* self = &tasks[t];
    const unsigned priority = rtos_priority(module, task->priority);
    const bool is_cyclic = task->kind == RUNG_CYCLIC;
    if (priority >= RTOS_PRIORITIES) return false;
    if (is_cyclic && (task->interval_ns < RTOS_TICK_NS || task->interval_ns % RTOS_TICK_NS != 0)) return false;
    if (!is_cyclic && !find_trigger(module, self, module->strings + task->trigger)) return false;
    if (is_cyclic && (!has_bus_task || task->interval_ns < rung_task_at(module, bus_task)->interval_ns)) {
      bus_task = t;
      has_bus_task = true;
    }
    for (uint32_t i = 0; i < PLANT_AREAS; ++i) self->areas[i] = (uint8_t*)self->images[i];
    self->context = start_context;
    self->context.areas = self->areas;
    self->context.task = t + 1;
    rtos_create(&self->rtos, module->strings + task->name, is_cyclic ? run_cyclic : run_on_event, self, priority,
                self->stack, sizeof self->stack);
  }
  return has_bus_task;
}

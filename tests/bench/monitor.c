/* SPDX-License-Identifier: Apache-2.0 */
/* The CPU time of rung/monitor.h: see monitor.sh. In: two modules. Out: the median of eleven rounds of each figure. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "rung/monitor.h"

enum { ROUNDS = 11, TURNS = 20000, NAMES = 64 };

static rung_context context;
static int is_too_slow;

static double nanoseconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

static int ascending(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

/* `run` does `turns` of something; `unit` nanoseconds are printed as one. */
static void measure(const char* name, void (*run)(void), int turns, double unit, const char* unit_name, double limit) {
  double all[ROUNDS];
  run();
  for (int i = 0; i < ROUNDS; ++i) {
    const double begin = nanoseconds();
    run();
    all[i] = (nanoseconds() - begin) / turns / unit;
  }
  qsort(all, ROUNDS, sizeof *all, ascending);
  printf("%s: %.1f %s", name, all[ROUNDS / 2], unit_name);
  if (limit > 0) printf(" (at most %.0f)", limit);
  printf("\n");
  if (limit > 0 && all[ROUNDS / 2] > limit) is_too_slow = 1;
}

static const rung_module* load(const char* path, const char* function) {
  void* library = dlopen(path, RTLD_NOW);
  rung_module_function describe = NULL;
  if (library != NULL) *(void**)&describe = dlsym(library, function);
  if (describe == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    exit(2);
  }
  return describe();
}

/* The memory of a module, which is never freed: the process ends. */
static void place(const rung_module* module) {
  context.module = module;
  context.blocks = calloc(module->blocks.count + 1, sizeof *context.blocks);
  context.areas = calloc(module->areas.count + 1, sizeof *context.areas);
  for (uint32_t i = 0; i < module->blocks.count; ++i) context.blocks[i] = calloc(1, rung_block_at(module, i)->size + 8);
  for (uint32_t i = 0; i < module->areas.count; ++i) context.areas[i] = calloc(1, rung_area_at(module, i)->size + 8);
}

static char paths[NAMES][64];
static rung_variable variables[NAMES];
static rung_forced rows[NAMES];
static uint8_t values[NAMES * 8];
static rung_forces forces = {rows, NAMES, 0, values, sizeof values, 0};
static volatile int64_t sum;

static void findElements(void) {
  rung_variable variable;
  for (int i = 0; i < TURNS; ++i) sum += rung_find(context.module, "Main.pumps[2].level", &variable);
}
static void findMembers(void) {
  for (int i = 0; i < TURNS; ++i) sum += rung_find(context.module, paths[i % NAMES], &variables[i % NAMES]);
}
static void readValues(void) {
  int32_t value = 0;
  for (int i = 0; i < TURNS; ++i) {
    rung_read_value(&context, &variables[i % NAMES], &value, sizeof value);
    sum += value;
  }
}
static void readTexts(void) {
  char text[80];
  for (int i = 0; i < TURNS; ++i) sum += rung_read_text(&context, &variables[i % NAMES], text, sizeof text - 1);
}
static void applyForces(void) {
  for (int i = 0; i < TURNS; i += NAMES) rung_apply_forces(&context, &forces);
}

static uint32_t listed;
static rung_walk list(void* data, const rung_part* part) {
  const char* const type = context.module->strings + part->variable->type->name;
  (void)data;
  if (part->variable->type->kind >= RUNG_ARRAY) return RUNG_WALK_ENTER;
  ++listed;
  sum += part->path_size + (uint8_t)*type;
  return RUNG_WALK_SKIP;
}
static void listAll(void) {
  char path[256];
  listed = 0;
  for (uint32_t i = 0; i < context.module->symbols.count; ++i) {
    rung_variable variable;
    rung_path_of_symbol(context.module, i, path, sizeof path);
    rung_variable_of_symbol(context.module, i, &variable);
    rung_walk_variable(context.module, &variable, path, sizeof path, list, NULL);
  }
}

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  place(load(argv[1], argv[2]));
  for (int i = 0; i < NAMES; ++i) snprintf(paths[i], sizeof paths[i], "Plant.Cpu.Main.variable_%d", 1 + 37 * i);
  measure("find, Main.pumps[2].level", findElements, TURNS, 1, "ns", 200);
  measure("find, Plant.Cpu.Main.variable_N", findMembers, TURNS, 1, "ns", 0);
  measure("read", readValues, TURNS, 1, "ns", 20);
  measure("read as text", readTexts, TURNS, 1, "ns", 0);
  for (int i = 0; i < NAMES; ++i) rung_force(&forces, &variables[i], &i, sizeof i);
  measure("force", applyForces, TURNS, 1, "ns", 0);
  place(load(argv[3], argv[4]));
  measure("list", listAll, 1, 1e6, "ms", 50);
  printf("%u symbols listed\n", listed);
  return is_too_slow;
}

// SPDX-License-Identifier: Apache-2.0
/* Counts what is allocated while code of the program runs, in a process of the bundled host: linked with
 * --wrap=rung_guarded, through which the host enters the program. Prints the number at the end. Called by
 * no_allocation_with_host.test. */
#include <stdio.h>
#include <stdlib.h>

#include "rung/module.h"

uint8_t __real_rung_guarded(rung_context* ctx, void (*entry)(rung_context*));
uint8_t __wrap_rung_guarded(rung_context* ctx, void (*entry)(rung_context*));

static _Thread_local int depth;
static unsigned calls, entries;

static void note(void) {
  if (depth != 0) __atomic_fetch_add(&calls, 1, __ATOMIC_RELAXED);
}
#include "counted_malloc.h"

uint8_t __wrap_rung_guarded(rung_context* ctx, void (*entry)(rung_context*)) {
  ++depth;
  __atomic_fetch_add(&entries, 1, __ATOMIC_RELAXED);
  const uint8_t fault = __real_rung_guarded(ctx, entry);
  --depth;
  return fault;
}

static void report(void) {
  printf("%s activations, %u calls of malloc and free\n", entries > 50 ? "many" : "few", calls);
}
__attribute__((constructor)) static void begin(void) { atexit(report); }

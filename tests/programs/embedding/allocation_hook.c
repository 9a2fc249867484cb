/* Counts what is allocated while code of the program runs, in a process of the bundled host: linked with
 * --wrap=rung_guarded, through which the host enters the program. Prints the number at the end. Called by
 * no_allocation_with_host.test. */
#include <stdio.h>
#include <stdlib.h>

#include "rung/module.h"

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* old, size_t size);
extern void* __libc_memalign(size_t align, size_t size);
extern void __libc_free(void* old);
uint8_t __real_rung_guarded(rung_context* ctx, void (*entry)(rung_context*));
uint8_t __wrap_rung_guarded(rung_context* ctx, void (*entry)(rung_context*));

static _Thread_local int depth;
static unsigned calls, entries;

static void note(void) {
  if (depth != 0) __atomic_fetch_add(&calls, 1, __ATOMIC_RELAXED);
}
void* malloc(size_t size) {
  note();
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  note();
  return __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
  note();
  return __libc_realloc(old, size);
}
void* memalign(size_t align, size_t size) {
  note();
  return __libc_memalign(align, size);
}
void* aligned_alloc(size_t align, size_t size) { return memalign(align, size); }
int posix_memalign(void** to, size_t align, size_t size) { return (*to = memalign(align, size)) == NULL; }
void free(void* old) {
  note();
  __libc_free(old);
}

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

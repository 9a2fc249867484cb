/* SPDX-License-Identifier: Apache-2.0 */
/* Calls note(), of the file that includes this, for each call of malloc and its kin in the process. */
#include <stdlib.h>

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* old, size_t size);
extern void* __libc_memalign(size_t align, size_t size);
extern void __libc_free(void* old);

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

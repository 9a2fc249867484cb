/* SPDX-License-Identifier: Apache-2.0 */
/* Retained data in two slots, for any host: memory that keeps its content (FRAM, battery-backed RAM), or a file. A host
 * writes the slot that is not the newest, so whatever instruction a power failure comes at, one slot is complete. The
 * memory of a slot is aligned to 8 bytes. Plain C, no heap. docs/embedding.md has an example. */
#ifndef RUNG_RETAIN_H
#define RUNG_RETAIN_H

#include "rung/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The beginning of a slot; the retained bytes and then the persistent ones follow, in the order of the module's ranges.
 */
typedef struct rung_slot {
  char magic[8];
  uint64_t sequence; /* the greater one is newer */
  uint64_t layout_hash;
  int64_t time_ns;       /* the program's time: timers go on from there */
  uint32_t length;       /* of all that follows */
  uint32_t retain_bytes; /* how much of it is retained, not persistent */
  uint32_t value_bytes;  /* both together; a host may add data of its own after them */
  uint32_t crc;          /* CRC-32 of the slot with 0 here */
} rung_slot;

/* The size of a slot of this program. */
uint32_t rung_retain_bytes(const rung_module* module);

/* Copies the values and the time of the program to `slot`; quick enough for the end of a cycle. The slot is not
 * complete before rung_retain_seal. */
void rung_retain_pack(const rung_context* context, void* slot);

/* Completes a slot: its number, and the sum over `slot->length` bytes. */
void rung_retain_seal(void* slot, uint64_t sequence);

/* True when the header is one of a slot; its bytes may still be damaged. */
bool rung_retain_is_slot(const rung_slot* header);

/* True when the slot is complete and not longer than `bytes`. */
bool rung_retain_is_complete(const void* slot, size_t bytes);

/* The newer of two slots that are complete, or null. */
const void* rung_retain_newest(const void* one, const void* other, size_t bytes);

/* After rung_module::init: sets what the kind of start keeps (TM/TP manual 4.1.4) and the time of the context. False,
 * and nothing is set: the slot is of a program with another layout. */
bool rung_retain_unpack(rung_context* context, const void* slot, rung_start start);

uint32_t rung_crc32(const void* data, size_t size, uint32_t crc);

#ifdef __cplusplus
}
#endif
#endif

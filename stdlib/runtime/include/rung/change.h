/* SPDX-License-Identifier: Apache-2.0 */
/* Online change: another version of a program takes the place of the running one, and its variables go on with their
 * values. In: the descriptions and the memory of both versions, which were made with tables for it (`--online-change`
 * of `rung emit`). Out: the new version's memory, or why there is none. Plain C, no heap, no threads, no statics that
 * are written. docs/embedding.md has an example.
 *
 *   rung_plan_change     compares the descriptions: what keeps its value, is new, or is removed. At any time, and
 * twice: first to learn how much memory the plan needs. rung_check_change    looks at the running program: would a
 * pointer lose what it points to? rung_apply_change    between two activations of all tasks. */
#ifndef RUNG_CHANGE_H
#define RUNG_CHANGE_H

#include "rung/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The extension of a module with the tables for this; and of a host while a change is applied. */
#define RUNG_CHANGE "rung.change"
typedef struct rung_change_tables {
  rung_table blocks;  /* rung_block_life, in the order in which blocks are initialised */
  rung_table classes; /* uint32_t: the type of the blocks with class number 1, 2, … */
} rung_change_tables;
/* A block of memory as a whole. Each function may be null; rung_context::entry is its row. */
typedef struct rung_block_life {
  uint32_t block, type;           /* its number, and the record that it is */
  void (*init)(rung_context*);    /* sets the initial values in memory that is 0, FB_Init included */
  void (*refresh)(rung_context*); /* sets constants, {attribute 'init_on_onlchange'}, and located variables */
  void (*reinit)(rung_context*);  /* calls FB_Reinit of all instances that were copied */
  void (*exit)(rung_context*);    /* calls FB_Exit of all instances */
} rung_block_life;

/* A value that goes from an old place to a new one. A place is a block, or RUNG_RANGE_AREA + an area, and an offset. */
typedef struct rung_move {
  uint32_t from, from_offset, to, to_offset;
  uint32_t size; /* bytes; 0: an instance or structure whose members have rows of their own */
  uint32_t type; /* in the old module, of that instance or of the values; RUNG_NONE: a bit, or in the image */
  uint8_t from_bit, to_bit; /* of a bit; else 255 */
} rung_move;

/* Memory that depends on where other memory is: pointers, references, in-outs, interfaces, numbers of classes. */
enum rung_holder_kind {
  RUNG_HOLDS_POINTER, /* `what`: the type of the target in the old module */
  RUNG_HOLDS_IN_OUT,  /* the same, of a variable that each call binds: where its target is removed it becomes null */
  RUNG_HOLDS_NUMBER,  /* an integer as wide as a pointer: it may be an address */
  RUNG_HOLDS_CLASS    /* `what`: the number of the class in the new module */
};
typedef struct rung_holder {
  uint8_t kind; /* rung_holder_kind */
  uint32_t from, from_offset, to, to_offset, count, stride, what;
} rung_holder;

typedef enum rung_change_kind { RUNG_IS_INITIALISED, RUNG_IS_REMOVED, RUNG_IS_REFUSED } rung_change_kind;
typedef enum rung_change_reason {
  RUNG_REASON_NEW,      /* the old version has no such variable */
  RUNG_REASON_TYPE,     /* `old_text`, `new_text`: the types */
  RUNG_REASON_ELEMENTS, /* some elements; `old_text`, `new_text`: the arrays */
  RUNG_REASON_MISSING,  /* the new version has no such variable */
  RUNG_REASON_POINTER,  /* it points to `old_text`, which is removed or becomes something else */
  RUNG_REASON_ADDRESS,  /* its value is the address of `old_text`, which moves */
  RUNG_REASON_DYNAMIC,  /* objects of __NEW live, and types change */
  RUNG_REASON_TABLES    /* one of the versions was made without tables for a change */
} rung_change_reason;
typedef struct rung_change_note {
  rung_change_kind kind;
  rung_change_reason reason;
  const char *path, *old_text, *new_text; /* texts are '' where they say nothing */
} rung_change_note;

typedef struct rung_change {
  const rung_module *old_module, *module;
  /* Memory of the host. */
  char *path, *target; /* room for two paths, of this capacity each */
  uint32_t path_capacity;
  uint32_t* same; /* a cell for each type of the old module */
  uint32_t*
      kept; /* a cell for each block of the new module: the old block that it is, whose memory stays; or RUNG_NONE */
  uint8_t* image; /* as many bytes as all areas of the old module have */
  rung_move* moves;
  rung_holder* holders;
  uint32_t move_capacity, holder_capacity;
  void (*note)(void* data, const rung_change_note* note); /* may be null */
  void* data;
  /* Out: how many there are, which may be more than the capacity; and how many elementary variables keep their value.
   */
  uint32_t move_count, holder_count, kept_count, refused_count;
  bool keeps_types; /* out: objects of __NEW may be of any type, and all are as they were */
} rung_change;

/* Fills the plan. False: it is refused, or needs more rows than there is room for. */
bool rung_plan_change(rung_change* plan);
/* Tells whether every pointer of the running program goes on. No activation runs meanwhile. */
bool rung_check_change(rung_change* plan, const rung_context* old_context);
/* Brings the values to the memory of the new version: `context` has the old blocks that are kept, and for others memory
 * that is 0; its areas are those of the old version where they are as large, else memory that is 0. Calls FB_Exit,
 * FB_Init and FB_Reinit of instances whose memory moves. RUNG_FAULT_NONE, or the fault of one of them in
 * `*faulted_context`, after which neither version can go on: a host that wants to go back has saved the old memory. */
uint8_t rung_apply_change(const rung_change* plan, rung_context* old_context, rung_context* context,
                          rung_context** faulted_context);

/* bInCopyCode of FB_Init and FB_Exit: tells whether a change that is applied copies this instance. */
bool rung_in_copy_code(const rung_context* context, const void* instance);

#ifdef __cplusplus
}
#endif
#endif

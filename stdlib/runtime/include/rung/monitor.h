/* SPDX-License-Identifier: Apache-2.0 */
/* The variables of a running program by their paths, for any host: finds, reads, writes, lists and forces them, and
 * brings their values to another version of the program. In: the tables and the memory of a module. Out: values, or why
 * there is none. Plain C, no heap, no threads, no statics that are written: functions that change memory are called
 * where no activation runs, or from the task whose context they get. docs/embedding.md has examples. */
#ifndef RUNG_MONITOR_H
#define RUNG_MONITOR_H

#include "rung/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- variables */

/* A variable that a path names: a symbol, a member of one at any depth, a bit, or a part of an area that an address
 * names. It is a place, not a pointer: it holds for every context of the module and as long as the module. */
#define RUNG_VARIABLE_POINTERS 7u /* that a path may follow: in-outs, pointers and references */
typedef struct rung_variable {
  const rung_type* type;
  uint32_t flags;  /* rung_field_flags of the last symbol or field */
  uint8_t storage; /* rung_storage */
  uint8_t bit;     /* of a BOOL that is a bit of its byte (0..7), else 255 */
  uint8_t pointers;
  uint32_t index; /* of the block or area */
  /* The first is an offset in it; each further one is added to the pointer that is found there. */
  uint32_t offsets[1 + RUNG_VARIABLE_POINTERS];
} rung_variable;

/* Finds the variable at a path as traces have them: `Main.pumps[2].level`, `level`, `Plant.Cpu.Main.count`,
 * `Main.pump^.on`, `Main.word.3`, `%IX0.3`, `9056.17`. Upper and lower case are the same. */
bool rung_find(const rung_module* module, const char* path, rung_variable* variable);

/* The same step by step, for hosts that say what is wrong with a path. The first step finds a symbol or an address, and
 * each further one goes to a field, an element, a bit or the target of a pointer. After an error the path is at the
 * step that it cannot take, and the variable is the part of the path before it. */
typedef enum rung_path_error {
  RUNG_PATH_OK,
  RUNG_PATH_UNKNOWN,    /* no symbol has this name */
  RUNG_PATH_ADDRESS,    /* not an address */
  RUNG_PATH_WIDTH,      /* an address whose letter is not X, B, W, D or L */
  RUNG_PATH_OUTSIDE,    /* an address outside of the area `detail` */
  RUNG_PATH_STEP,       /* neither `.`, `[` nor `^` */
  RUNG_PATH_NO_POINTER, /* `^` after something else */
  RUNG_PATH_NO_ARRAY,
  RUNG_PATH_BRACKET,    /* `]` is missing */
  RUNG_PATH_DIMENSIONS, /* another number of indices than the array has */
  RUNG_PATH_INDEX,      /* that of dimension `detail` is not a number */
  RUNG_PATH_RANGE,      /* that of dimension `detail` is outside of its bounds */
  RUNG_PATH_NO_BIT,
  RUNG_PATH_NO_RECORD,
  RUNG_PATH_NO_FIELD,
  RUNG_PATH_DEPTH /* more than RUNG_VARIABLE_POINTERS */
} rung_path_error;
typedef struct rung_path {
  const char *at, *end; /* what is left */
  uint32_t detail;      /* after a step: the index of the symbol or field, else RUNG_NONE; after an error: see there */
} rung_path;
/* The first step is the one with variable->type null. */
rung_path_error rung_find_step(const rung_module* module, rung_path* path, rung_variable* variable);

/* ---- values */

typedef enum rung_access {
  RUNG_ACCESS_OK,
  RUNG_ACCESS_CONSTANT,
  RUNG_ACCESS_READ_ONLY, /* by a VAR_ACCESS */
  RUNG_ACCESS_ARRAY,     /* its elements are written one by one */
  RUNG_ACCESS_RECORD,
  RUNG_ACCESS_POINTER, /* is not written from outside */
  RUNG_ACCESS_NULL,    /* a pointer on the path is null */
  RUNG_ACCESS_VALUE,   /* the text is not a value of the type */
  RUNG_ACCESS_SIZE,    /* the buffer has another size than the value */
  RUNG_ACCESS_FULL     /* of the table of forces */
} rung_access;

/* Whether two paths led to the same place of the same type. Aliases by pointers and views of an area are other places.
 */
bool rung_is_same_variable(const rung_variable* one, const rung_variable* other);

/* Where the variable, or the byte of its bit, is; null: a pointer on the path is. */
void* rung_address(const rung_context* context, const rung_variable* variable);

/* Copies the value, `variable->type->size` bytes; a bit is a byte of 0 or 1. False: another size, or a null pointer. */
bool rung_read_value(const rung_context* context, const rung_variable* variable, void* value, size_t size);

/* Writes the value of an elementary variable, enumerations and strings included. */
rung_access rung_write_value(const rung_context* context, const rung_variable* variable, const void* value,
                             size_t size);

/* Whether such a write would be refused, as far as the declaration says. */
rung_access rung_is_writable(const rung_variable* variable);

/* The value as the trace prints it; enumerations by name. Cuts at `capacity` characters, ends with NUL (`text` has
 * capacity + 1 bytes), returns the length. Empty: arrays and records, and where a pointer on the path is null. */
uint32_t rung_read_text(const rung_context* context, const rung_variable* variable, char* text, uint32_t capacity);
/* The same of a value that rung_read_value gave. */
uint32_t rung_format_value(const rung_module* module, const rung_variable* variable, const void* value, char* text,
                           uint32_t capacity);
/* The characters that both may need. */
uint32_t rung_text_capacity(const rung_module* module, const rung_variable* variable);

/* Writes what a text says: what rung_read_text gives, or any literal of the language. */
rung_access rung_write_text(const rung_context* context, const rung_variable* variable, const char* text, size_t size);
/* The value of a text, in `variable->type->size` bytes; nothing is written after an error. */
rung_access rung_parse_value(const rung_module* module, const rung_variable* variable, const char* text, size_t size,
                             void* value);

/* ---- forces. A host applies them when inputs have been taken, before and after the code of each task, and before
 * outputs leave: code that writes a forced variable reads what it wrote until the end of its activation, and all others
 * see the forced value. A host that makes outputs safe does not apply them after that. */
typedef struct rung_forced {
  rung_variable variable;
  uint32_t value;  /* offset in rung_forces::values */
  uint8_t is_held; /* the host does not want it applied: an output of a task that a fault has stopped */
} rung_forced;
typedef struct rung_forces {
  rung_forced* rows; /* memory of the host, as `values`: the last one wins where two have bits in common */
  uint32_t capacity, count;
  uint8_t* values;
  uint32_t value_capacity, value_bytes;
} rung_forces;

/* Forces a variable, or gives it another value; RUNG_ACCESS_OK, or why not. */
rung_access rung_force(rung_forces* forces, const rung_variable* variable, const void* value, size_t size);
rung_access rung_force_text(rung_forces* forces, const rung_module* module, const rung_variable* variable,
                            const char* text, size_t size);
/* The variable keeps its value until somebody writes it. False: it was not forced. */
bool rung_unforce(rung_forces* forces, const rung_variable* variable);
/* Writes all forced values to the memory of this context. */
void rung_apply_forces(const rung_context* context, const rung_forces* forces);

/* ---- lists */

/* A variable on the way through all variables of a module. */
typedef struct rung_part {
  const char* path; /* NUL-terminated, `path_size` characters */
  uint32_t path_size;
  const rung_variable* variable;
  const rung_type* owner;  /* the record that it is a field of; null: a symbol, or the element of an array */
  const rung_field* field; /* and which one */
} rung_part;
typedef enum rung_walk { RUNG_WALK_ENTER, RUNG_WALK_SKIP, RUNG_WALK_END } rung_walk;
typedef rung_walk (*rung_visit)(void* data, const rung_part* part);

/* Visits a variable, and where the visitor wants to enter it what is in it: fields in the order of their declaration,
 * elements by index. Pointers are not followed. `path` has `capacity` bytes and begins with the path of the variable;
 * what needs a longer path is left out. False: the visitor has ended it. */
bool rung_walk_variable(const rung_module* module, const rung_variable* variable, char* path, uint32_t capacity,
                        rung_visit visit, void* data);
/* The variable of a symbol, and its path, with its prefix where another symbol has the same name. Returns the length of
 * the path; 0: it needs more than `capacity` bytes. */
void rung_variable_of_symbol(const rung_module* module, uint32_t symbol, rung_variable* variable);
uint32_t rung_path_of_symbol(const rung_module* module, uint32_t symbol, char* path, uint32_t capacity);

/* ---- another version of the program */

typedef enum rung_loss {
  RUNG_LOSS_MISSING,     /* it is not in the program any more */
  RUNG_LOSS_TYPE,        /* it has another type */
  RUNG_LOSS_NOT_RETAINED /* it is not retained any more */
} rung_loss;
typedef struct rung_migration {
  char* path; /* room of the host for a path */
  uint32_t path_capacity;
  /* Called for each variable whose value is lost; may be null. `new_type` is empty where it is missing. */
  void (*lost)(void* data, const char* path, rung_loss why, const char* old_type, const char* new_type);
  void* data;
  uint32_t kept, lost_count; /* out: variables */
} rung_migration;

/* Copies the values of all elementary variables that have the same path and type in both versions, from the memory of
 * the old one to that of the new one, which has its initial values. No constants, pointers and in-outs. */
void rung_migrate(const rung_module* old_module, const rung_context* old_context, const rung_module* module,
                  const rung_context* context, rung_migration* migration);

/* The directory of the variables in a slot of retained data (rung/retain.h): a host writes it after the values,
 * and adds its size to rung_slot::length before it seals the slot. Returns the size; with fewer than `capacity` bytes
 * nothing is complete. The path's room is that of the migration. */
uint32_t rung_retain_directory(const rung_module* module, char* directory, uint32_t capacity,
                               rung_migration* migration);
/* After rung_module::init, where rung_retain_unpack says that the slot is of another layout: sets each variable that
 * the kind of start keeps and that has the same path and type, and the time of the context. */
void rung_retain_migrate(rung_context* context, const void* slot, rung_start start, rung_migration* migration);

#ifdef __cplusplus
}
#endif
#endif

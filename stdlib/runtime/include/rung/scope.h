/* SPDX-License-Identifier: Apache-2.0 */
/* A trace on the controller: the values of some variables after activations of a task, kept in a ring in memory of the
 * host, from a trigger on or until somebody has read them. In: variables of rung/monitor.h, sampled by the task. Out:
 * rows, read later by whoever has time. No row is lost while the ring has room for what was not read. Plain C, no heap,
 * no threads. The bundled host has one for its monitor; docs/embedding.md shows one in a firmware. */
#ifndef RUNG_SCOPE_H
#define RUNG_SCOPE_H

#include "rung/monitor.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum rung_scope_condition {
  RUNG_SCOPE_NONE,    /* no trigger: rows follow each other until rung_scope_stop, new ones replace the oldest */
  RUNG_SCOPE_RISING,  /* from below the level to it or above: of a BOOL from FALSE to TRUE */
  RUNG_SCOPE_FALLING, /* from the level or above to below it */
  RUNG_SCOPE_ABOVE,   /* at the level or above, from the first row on */
  RUNG_SCOPE_BELOW
} rung_scope_condition;

typedef enum rung_scope_state {
  RUNG_SCOPE_OFF,
  RUNG_SCOPE_RUNNING,   /* without a trigger */
  RUNG_SCOPE_WAITING,   /* for the trigger */
  RUNG_SCOPE_TRIGGERED, /* takes what follows it */
  RUNG_SCOPE_COMPLETE   /* the ring stays as it is */
} rung_scope_state;

/* A row is the time in nanoseconds (int64_t), then the value of each channel, without gaps. A bit is a byte of 0 or 1.
 * Values that a null pointer leads to are 0. */
typedef struct rung_scope {
  /* Set before rung_scope_start; they stay while it runs. */
  const rung_variable* channels; /* elementary variables */
  uint32_t channel_count;
  uint8_t* ring;
  uint32_t ring_size;    /* bytes */
  uint32_t divider;      /* every so many activations are sampled; 0 is 1 */
  uint8_t condition;     /* rung_scope_condition */
  rung_variable trigger; /* a BOOL, a number, a bit string, an enumeration, a duration or a date */
  double level;          /* as rung_scope_number gives it */
  uint32_t rows_before;  /* that are kept of the time before the trigger */
  /* Written by the functions below. */
  uint8_t state; /* rung_scope_state */
  uint8_t was_at_level;
  uint8_t is_triggered;
  uint32_t row_size, capacity; /* of the ring, in rows */
  uint32_t taken;              /* rows since the start, the number of the next one; it may wrap */
  uint32_t kept;               /* of them, the last ones */
  uint32_t next;               /* where the next row goes in the ring */
  uint32_t trigger_row;        /* its number, when is_triggered */
  uint32_t left_out;           /* activations since the last row */
} rung_scope;

/* The bytes of a row with these channels. */
uint32_t rung_scope_row_size(const rung_variable* channels, uint32_t count);
/* The value of a variable that may be a trigger, as rung_read_value gives it, as a number; durations and dates in
 * their own unit. */
double rung_scope_number(const rung_variable* variable, const void* value);
bool rung_scope_is_trigger(const rung_variable* variable);

/* Forgets all rows and begins. False: there is no room for two rows, or `rows_before` leaves none after the trigger. */
bool rung_scope_start(rung_scope* scope);
/* The rows stay. */
void rung_scope_stop(rung_scope* scope);
/* Called by the task when its code has run. */
void rung_scope_sample(rung_scope* scope, const rung_context* context, int64_t now_ns);

/* Copies up to `count` rows from number `*from` on, or from the oldest that is kept, to which `*from` is set; returns
 * how many. Called where the task does not sample. */
uint32_t rung_scope_read(const rung_scope* scope, uint32_t* from, void* rows, uint32_t count);
/* What is in a row that was read. */
int64_t rung_scope_time(const void* row);
const void* rung_scope_value(const rung_scope* scope, const void* row, uint32_t channel);

#ifdef __cplusplus
}
#endif
#endif

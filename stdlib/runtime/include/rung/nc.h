/* SPDX-License-Identifier: Apache-2.0 */
/* The numerical control that an NCT program talks to, for hosts: what a product serves from its own control
 * (rung_host.nc). In: the TimeSlice memory, messages, motion commands, macro variables and services of the program.
 * Out: what the control answers. The bundled host simulates one. NCT manual 3.3, 6.13 to 6.18 and chapter 7;
 * docs/nct.md. */
#ifndef RUNG_NC_H
#define RUNG_NC_H

#include "rung/module.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { RUNG_NC_WORDS = 10000, RUNG_NC_SLICE_WORDS = 4000, RUNG_NC_NONVOLATILE_WORDS = 1024 };

/* How a call to the control ended. */
enum rung_nc_result {
  RUNG_NC_DONE = 0,
  RUNG_NC_BUSY = 1,    /* ask again in the next cycle */
  RUNG_NC_REFUSED = -1 /* the program gets FL_ER */
};

/* A message of the program, NCT manual 6.13. */
typedef struct rung_nc_message {
  uint32_t code;     /* channel * 1 000 000 + number * 100 + index: 8 digits */
  uint8_t is_shown;  /* MSG, ALR: on the screen, until it is withdrawn */
  uint8_t is_logged; /* ALR, REM */
  const char* text;  /* with its number printed; read during the call only */
} rung_nc_message;

/* A service of MR or MW, NCT manual 6.18. */
typedef struct rung_nc_request {
  uint8_t is_write;      /* MW */
  int32_t function;      /* 10 of MR10 */
  uint32_t address;      /* of the block in PLC memory */
  uint32_t count;        /* words of the block: its amount of data and 2 more; at least 2 */
  const uint32_t* block; /* read during the call only */
} rung_nc_request;

/* Functions of a control. None waits. All but `exchange` may be null: then the program gets FL_ER. Tasks of a program
 * may be threads, so a host that runs them so guards its own data. */
typedef struct rung_nc {
  /* A TimeSlice begins (`is_cycle` false), or a cycle of Main (true), which is one more call at the same time. Reads
   * what the program tells the control in `slice`, and writes there what the control tells the program: the words of
   * the NC symbols, at the addresses that `rung list nct` shows. `nonvolatile` has RUNG_NC_NONVOLATILE_WORDS words and
   * one more, which the program keeps with its retained data for a control that has no place of its own. */
  void (*exchange)(void* data, uint32_t* slice, uint32_t* nonvolatile, bool is_cycle, int64_t now_ns);
  /* The title of a button of the screen, from 1 to 32, in the first cycle. */
  void (*title)(void* data, uint32_t button, const char* text);
  /* The input of a message rises: BUSY until it is shown, or logged. Called in each cycle while the input is TRUE;
   * after DONE it tells whether it is still shown: REFUSED when the operator has deleted it. */
  int32_t (*message)(void* data, const rung_nc_message* message, bool is_new);
  /* The input falls. */
  void (*withdraw)(void* data, const rung_nc_message* message);
  /* MOVCMND: BUSY while the buffer of the axis is full. */
  int32_t (*move)(void* data, int32_t axis, int32_t code, double speed, double distance);
  /* Macro variables 100 to 999 of a channel, from 0. */
  int32_t (*read_macro)(void* data, int32_t channel, int32_t number, double* value);
  int32_t (*write_macro)(void* data, int32_t channel, int32_t number, double value);
  /* SCP: `scope` is the place of its name in the list of `rung list nct`, from 0. */
  int32_t (*scope)(void* data, int32_t scope, int32_t first, int32_t second, double* value);
  /* MR and MW. A number > 0, or 0: the control takes no more. */
  uint32_t (*submit)(void* data, const rung_nc_request* request);
  /* False: busy. True: the service has finished and its number is free again; the words that it gives, and the code of
   * execution in word 0 of the block, are written to `memory`, which has RUNG_NC_WORDS words. */
  bool (*poll)(void* data, uint32_t number, uint32_t* memory);
  /* The program asks no more for this service: it is cancelled, or nothing of it is written. */
  void (*cancel)(void* data, uint32_t number);
  /* Sets up a simulated control: stdlib/nct/simulation.st. REFUSED: there is no such thing. */
  int32_t (*simulate)(void* data, int32_t what, const double* values, uint32_t count, double* result);
  /* The text that a simulated control shows in row `row`, from 0, of the screen (`place` 0), its log (1) or the titles
   * of its buttons (2); its code, or 0: there is none. `text` has 256 bytes. */
  uint32_t (*text)(void* data, int32_t place, int32_t row, char* text);
} rung_nc;

#ifdef __cplusplus
}
#endif
#endif

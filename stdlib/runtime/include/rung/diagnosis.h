/* SPDX-License-Identifier: Apache-2.0 */
/* Current faults of a controller, its modules and its links: a table in memory of the host, in which programs, devices
 * and links report and which the host reads at any time (docs/embedding.md). The host points rung_host.diagnosis to one
 * that is all 0. Every function may be called from any thread; none locks or waits.
 * A code is one of AX 5.2 (16#10 to 16#CC), or of TM/TP manual 10.2: major code * 16#10000 + sub-code. */
#ifndef RUNG_DIAGNOSIS_H
#define RUNG_DIAGNOSIS_H

#include "rung/module.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RUNG_DIAGNOSIS_ENTRIES 64

typedef struct rung_current_fault {
  uint32_t code;
  uint32_t source;  /* which module, port or connection: a number of its reporter */
  int64_t since_ns; /* program time of the first report */
} rung_current_fault;

typedef struct rung_fault_slot { /* read them with rung_current_faults */
  uint32_t code, source, since_low, since_high;
} rung_fault_slot;
struct rung_diagnosis {
  rung_fault_slot entries[RUNG_DIAGNOSIS_ENTRIES];
  volatile uint8_t stopped; /* set by the host while it does not run the program */
};

/* A fault that is reported again keeps its time. False: the table is full, or there is none (null). */
bool rung_report_fault(rung_diagnosis* diagnosis, uint32_t code, uint32_t source, int64_t now_ns);
/* The fault is gone. False: it was not reported. */
bool rung_clear_fault(rung_diagnosis* diagnosis, uint32_t code, uint32_t source);
/* Copies up to `capacity` faults, the oldest first. Returns their number. */
uint32_t rung_current_faults(const rung_diagnosis* diagnosis, rung_current_fault* faults, uint32_t capacity);

/* The indicators of AX 5.1.1. CAN and ERR are reserved there and stay off. */
enum rung_indicator {
  RUNG_INDICATOR_SF = 1, /* the program does not run */
  RUNG_INDICATOR_BF = 2  /* a fault of Modbus RTU, Modbus TCP or the backplane */
};
uint8_t rung_indicators(const rung_diagnosis* diagnosis);
/* What the two-digit display shows: the oldest of the current faults with a code of AX 5.2, or 0. */
uint8_t rung_display_code(const rung_diagnosis* diagnosis);

#ifdef __cplusplus
}
#endif
#endif

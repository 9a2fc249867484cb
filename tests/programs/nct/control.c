// SPDX-License-Identifier: Apache-2.0
/* A numerical control of a product, as `rung run --driver` loads it: it starts the machine when the program asks, has one
 * axis and a service MR10 that gives its own number. Addresses are those of `rung list nct`. */
#include <stdio.h>
#include <string.h>

#include "rung/nc.h"

typedef struct machine {
  double position;
  int64_t last_ns;
  uint32_t asked, address; /* a service */
  double macro;
} machine;

static void exchange(void *data, uint32_t *slice, uint32_t *nonvolatile, bool is_cycle, int64_t now_ns) {
  machine *const all = data;
  (void)nonvolatile;
  if (!is_cycle) return;
  slice[2] = (slice[2] & ~(1u << 11)) | (slice[3] & 1u) << 11; /* N_MONST := P_MONREQ */
  all->position += (double)(now_ns - all->last_ns) * 1e-9;
  all->last_ns = now_ns;
}

static int32_t message(void *data, const rung_nc_message *sent, bool is_new) {
  (void)data;
  if (is_new) fprintf(stderr, "control: %08u %s\n", sent->code, sent->text);
  return RUNG_NC_DONE;
}
static void withdraw(void *data, const rung_nc_message *sent) {
  (void)data;
  fprintf(stderr, "control: %08u is gone\n", sent->code);
}

static int32_t read_macro(void *data, int32_t channel, int32_t number, double *value) {
  if (channel != 0 || number != 500) return RUNG_NC_REFUSED;
  *value = ((machine *)data)->macro;
  return RUNG_NC_DONE;
}

static int32_t scope(void *data, int32_t place, int32_t first, int32_t second, double *value) {
  (void)second;
  if (place != 10 || first != 1) return RUNG_NC_REFUSED; /* ActPosAx */
  *value = ((machine *)data)->position;
  return RUNG_NC_DONE;
}

static uint32_t submit(void *data, const rung_nc_request *request) {
  machine *const all = data;
  if (all->asked != 0) return 0;
  all->address = request->address;
  return all->asked = 7;
}
static bool poll_service(void *data, uint32_t number, uint32_t *memory) {
  machine *const all = data;
  memory[all->address + 2] = number;
  memory[all->address] = 0;
  all->asked = 0;
  return true;
}
static void cancel(void *data, uint32_t number) {
  (void)number;
  ((machine *)data)->asked = 0;
}

const rung_nc *rung_numerical_control(const char *argument, void **data);
const rung_nc *rung_numerical_control(const char *argument, void **data) {
  static rung_nc control;
  static machine all;
  if (strcmp(argument, "mill") != 0) return NULL;
  memset(&all, 0, sizeof all);
  all.macro = 4.5;
  control.exchange = exchange;
  control.message = message;
  control.withdraw = withdraw;
  control.read_macro = read_macro;
  control.scope = scope;
  control.submit = submit;
  control.poll = poll_service;
  control.cancel = cancel;
  *data = &all;
  return &control;
}

// SPDX-License-Identifier: Apache-2.0
/* Drives of a product, for `rung run --driver` and as an example: servo drives that a product would reach by its own
 * fieldbus. Here they only follow: the state machine of CiA 402 without faults, and the target position. Every
 * axis of the program gets one, in the order of its first cycle; `user` of rung_drive keeps which. The argument: how
 * many drives there are; further axes are simulated. */
#include <stdlib.h>
#include <string.h>

#include "rung/motion.h"

enum { MOST = 16 };

typedef struct servo {
  rung_drive sent; /* what the program has sent last */
  uint16_t status;
  double position;
} servo;

typedef struct product {
  servo servos[MOST];
  uint32_t count, used;
  rung_object_access pending;
  int busy;
} product;

static uint16_t next_status(uint16_t status, uint16_t controlword) {
  const uint16_t command = controlword & 0x0F;
  if ((controlword & 2) == 0) return 0x250;                  /* disable voltage: switch on disabled */
  if ((status & 0x4F) == 0x40 && command == 6) return 0x231; /* shutdown: ready to switch on */
  if ((status & 0x6F) == 0x21 && command == 7) return 0x233; /* switch on */
  if ((status & 0x6F) == 0x23 && command == 15) return 0x1237; /* enable operation */
  if ((status & 0x6F) == 0x27 && command == 6) return 0x231; /* shutdown */
  return status;
}

/* In front of the programs: what comes from the drive. */
static bool receive(void *data, rung_drive *drive, int64_t now_ns) {
  product *const all = data;
  (void)now_ns;
  if (drive->user == 0) {
    if (all->used == all->count) return false;
    drive->user = ++all->used;
    all->servos[drive->user - 1].status = 0x250;
  }
  servo *const one = &all->servos[drive->user - 1];
  drive->communication = 1;
  drive->mapped = RUNG_DRIVE_CONTROLWORD | RUNG_DRIVE_MODE | RUNG_DRIVE_TARGET_POSITION | RUNG_DRIVE_STATUSWORD |
                  RUNG_DRIVE_MODE_DISPLAY | RUNG_DRIVE_POSITION;
  drive->statusword = one->status;
  drive->mode_display = one->sent.mode;
  drive->position = (int32_t)one->position;
  return true;
}

/* After them: what goes to it. */
static void send(void *data, const rung_drive *drive, int64_t now_ns) {
  product *const all = data;
  servo *const one = &all->servos[drive->user - 1];
  (void)now_ns;
  one->status = next_status(one->status, drive->controlword);
  if ((one->status & 0x6F) == 0x27) one->position = drive->target_position;
  one->sent = *drive;
}

/* One access at a time, answered at the first question: object 6502h is all that these drives have. */
static int64_t begin(void *data, const rung_drive *drive, const rung_object_access *access) {
  product *const all = data;
  (void)drive;
  if (access->index != 0x6502 || access->length != 4) return RUNG_OBJECT_UNKNOWN;
  if (access->is_write) return RUNG_OBJECT_READ_ONLY;
  all->pending = *access;
  all->busy = 1;
  return 1;
}

static int64_t result(void *data, int64_t access, uint32_t *value) {
  product *const all = data;
  (void)access;
  if (all->busy++ < 3) return RUNG_OBJECT_BUSY;
  *value = 1u << 7; /* csp */
  return RUNG_OBJECT_DONE;
}

const rung_drives *rung_axis_drives(const char *argument, void **data);
const rung_drives *rung_axis_drives(const char *argument, void **data) {
  static const rung_drives drives = {receive, send, begin, result};
  static product all;
  memset(&all, 0, sizeof all);
  all.count = (uint32_t)atoi(argument);
  if (all.count == 0 || all.count > MOST) return NULL;
  *data = &all;
  return &drives;
}

/* SPDX-License-Identifier: Apache-2.0 */
/* Axes and their drives, for hosts: the process data of a drive by CiA 402, and how a product serves it from its own
 * fieldbus (docs/embedding.md). Each AXIS_REF_SM3 of a program has one rung_drive, which rung_find_axes finds. Without
 * such a host every axis has a simulated drive. Plain C. */
#ifndef RUNG_MOTION_H
#define RUNG_MOTION_H

#include "rung/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Process data of one drive; each member is one object, with its number. Positions and velocities are in
 * increments and increments per second, torques in 0.1 % of the rated torque. */
typedef struct rung_drive {
  /* To the drive. */
  uint16_t controlword;     /* 6040h */
  int8_t mode;              /* 6060h: 8 csp, 9 csv, 10 cst, 6 hm, 1 pp, 3 pv */
  uint8_t reserved_1;       /* 0 */
  int32_t target_position;  /* 607Ah */
  int32_t target_velocity;  /* 60FFh */
  int16_t target_torque;    /* 6071h */
  uint16_t probe_function;  /* 60B8h */
  uint32_t digital_outputs; /* 60FEh:01 */
  /* From the drive. */
  uint16_t statusword;     /* 6041h */
  int8_t mode_display;     /* 6061h */
  uint8_t communication;   /* 1: the process data is exchanged with the drive */
  int32_t position;        /* 6064h */
  int32_t velocity;        /* 606Ch */
  int16_t torque;          /* 6077h */
  uint16_t error_code;     /* 603Fh */
  uint16_t probe_status;   /* 60B9h */
  uint16_t reserved_2;     /* 0 */
  int32_t probe_1_rising;  /* 60BAh */
  int32_t probe_1_falling; /* 60BBh */
  int32_t probe_2_rising;  /* 60BCh */
  int32_t probe_2_falling; /* 60BDh */
  uint32_t digital_inputs; /* 60FDh: bit 0 negative limit switch, bit 1 positive limit switch, bit 2 home switch */
  /* Which objects the process data has: bits of rung_drive_object. */
  uint32_t mapped;
  /* Of the host; 0 at the start. */
  uint32_t user;
} rung_drive;

/* Where the rung_drive of an axis is. */
typedef struct rung_axis {
  char name[128]; /* the path of the AXIS_REF_SM3 as in the symbol map: `X`, `Line.axes[3]` */
  uint32_t block, offset;
} rung_axis;

/* Fills up to `capacity` rows with the axes of a module, in the order of the symbol map; returns how many there are. */
uint32_t rung_find_axes(const rung_module* module, rung_axis* axes, uint32_t capacity);

enum rung_drive_object {
  RUNG_DRIVE_CONTROLWORD = 1,
  RUNG_DRIVE_MODE = 2,
  RUNG_DRIVE_TARGET_POSITION = 4,
  RUNG_DRIVE_TARGET_VELOCITY = 8,
  RUNG_DRIVE_TARGET_TORQUE = 16,
  RUNG_DRIVE_PROBE_FUNCTION = 32,
  RUNG_DRIVE_DIGITAL_OUTPUTS = 64,
  RUNG_DRIVE_STATUSWORD = 256,
  RUNG_DRIVE_MODE_DISPLAY = 512,
  RUNG_DRIVE_POSITION = 1024,
  RUNG_DRIVE_VELOCITY = 2048,
  RUNG_DRIVE_TORQUE = 4096,
  RUNG_DRIVE_ERROR_CODE = 8192,
  RUNG_DRIVE_PROBE_STATUS = 16384,
  RUNG_DRIVE_PROBE_POSITIONS = 32768,
  RUNG_DRIVE_DIGITAL_INPUTS = 65536
};

/* A read or write of one object by the drive's service channel (SDO). */
typedef struct rung_object_access {
  uint16_t index;
  uint8_t subindex;
  uint8_t length; /* bytes: 1, 2 or 4 */
  uint8_t is_write;
  uint32_t value; /* to write */
} rung_object_access;
enum rung_object_result {
  RUNG_OBJECT_DONE = 0,
  RUNG_OBJECT_BUSY = 1,
  RUNG_OBJECT_UNKNOWN = -1,   /* the drive has no such object, or of another length */
  RUNG_OBJECT_READ_ONLY = -2, /* or write-only */
  RUNG_OBJECT_RANGE = -3,     /* the value is not allowed */
  RUNG_OBJECT_FAILED = -4     /* no answer */
};

/* Functions of a host that has drives. None waits. */
struct rung_drives {
  /* In front of each activation of the axis's task: fills what comes from the drive. False: the host has no drive for
   * this axis, and it is simulated. */
  bool (*receive)(void* data, rung_drive* drive, int64_t now_ns);
  /* After the activation: takes what goes to the drive. */
  void (*send)(void* data, const rung_drive* drive, int64_t now_ns);
  /* Begins an access: a number > 0, or a negative rung_object_result. */
  int64_t (*begin)(void* data, const rung_drive* drive, const rung_object_access* access);
  /* A rung_object_result; `value` is what was read. A result other than BUSY frees the number. */
  int64_t (*result)(void* data, int64_t access, uint32_t* value);
};

#ifdef __cplusplus
}
#endif
#endif

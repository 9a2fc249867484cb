/* SPDX-License-Identifier: Apache-2.0 */
/* The plant as tasks of an RTOS. Call plant_start once, then start the scheduler. */
#ifndef PLANT_TASKS_H
#define PLANT_TASKS_H

#include <stdbool.h>

#include "rung/module.h"

/* How much the project may need; plant_start refuses one that needs more. */
#define PLANT_MEMORY_BYTES 1024
#define PLANT_BLOCKS 8
#define PLANT_TASKS 4
#define PLANT_AREAS 3       /* I, Q, M */
#define PLANT_AREA_BYTES 16 /* of each */

bool plant_start(void);
const rung_context* plant_context(void); /* the common memory, for monitoring */

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* The firmware: the plant's tasks, and the scheduler of the RTOS. */
#include "plant_tasks.h"
#include "rtos.h"

int main(void) {
  if (!plant_start()) return 2;
  rtos_start();
  return 0;
}

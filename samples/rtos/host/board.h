/* SPDX-License-Identifier: Apache-2.0 */
/* The board on a PC: its button is pressed from 10 ms on; a trace shows the plant each 10 ms. */
#ifndef BOARD_H
#define BOARD_H

#include <stdbool.h>
#include <stdint.h>

bool board_runs(uint32_t tick);
void board_trace(uint32_t tick);

#endif

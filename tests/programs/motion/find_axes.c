// SPDX-License-Identifier: Apache-2.0
/* A host that lists the axes of a program, and finds their process data by block and offset. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rung/motion.h"

extern const rung_module *plc_module(void);

int main(void) {
  const rung_module *const module = plc_module();
  rung_axis axes[8];
  const uint32_t count = rung_find_axes(module, axes, 8);
  for (uint32_t i = 0; i < count && i < 8; ++i) {
    const rung_block *const block = rung_block_at(module, axes[i].block);
    printf("%s: %s\n", axes[i].name,
           axes[i].offset % 4 == 0 && axes[i].offset + sizeof(rung_drive) <= block->size ? "inside" : "outside");
  }
  return 0;
}

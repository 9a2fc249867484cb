// SPDX-License-Identifier: Apache-2.0
/* The module `plant` as a later version of Rung may describe it: each row of each table has further columns, and the
 * module has an extension. Linked in front of the module that it wraps, `present`. */
#include <stdlib.h>
#include <string.h>

#include "rung/module.h"

const rung_module *present_module(void);
const rung_module *plant_module(void);

enum { LATER_COLUMNS = 24 }; /* bytes */

static rung_table lengthened(const rung_table *table) {
  const uint32_t row_size = table->row_size + LATER_COLUMNS;
  unsigned char *rows = malloc((size_t)table->count * row_size + 1);
  for (uint32_t i = 0; i < table->count; ++i) {
    memcpy(rows + (size_t)i * row_size, rung_row(table, i), table->row_size);
    memset(rows + (size_t)i * row_size + table->row_size, 0xee, LATER_COLUMNS);
  }
  return (rung_table){rows, table->count, row_size};
}

const rung_module *plant_module(void) {
  static const uint32_t content = 42;
  static const rung_extension extensions[] = {{"rung.later", &content, sizeof content}};
  static rung_module later;
  rung_table *const tables[] = {&later.blocks,     &later.areas,      &later.resources,    &later.tasks,
                                &later.writes,     &later.io_modules, &later.symbols,      &later.types,
                                &later.fields,     &later.enum_items, &later.dimensions,   &later.retain,
                                &later.persistent, &later.sites,      &later.initialisers, &later.tests};
  later = *present_module();
  for (size_t i = 0; i < sizeof tables / sizeof *tables; ++i) *tables[i] = lengthened(tables[i]);
  later.extensions = (rung_table){extensions, 1, sizeof *extensions};
  return &later;
}

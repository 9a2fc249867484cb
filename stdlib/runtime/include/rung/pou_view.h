/* SPDX-License-Identifier: Apache-2.0 */
/* A body of the program as a monitor shows it: what `rung build` puts into an executable, beside the module, and what
 * `rung run` makes of the project. Not part of a module, so a firmware does not have it. */
#ifndef RUNG_POU_VIEW_H
#define RUNG_POU_VIEW_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rung_pou_view {
  const char* name;     /* `Pump`, `Pump.Start` */
  const char* block;    /* whose instances have its variables: `Pump`; '': a function, or the ladder of NCT */
  const char* language; /* `ST`, `IL`, `LD`, `FBD`, `CFC`, `SFC`, `NCT`, `C++` */
  const char* content;  /* a picture in SVG, or of text lines in JSON: docs/monitor.md */
} rung_pou_view;

#ifdef __cplusplus
}
#endif
#endif

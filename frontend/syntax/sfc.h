// SPDX-License-Identifier: Apache-2.0
// A Sequential Function Chart as the parser creates it: steps and transitions in source order, which is the order in
// which they are evaluated. Actions are members of the POU; of a MACRO_STEP only its steps and transitions remain. The
// chart becomes statements when the body is about to be checked (frontend/schedule/sfc_schedule.h). IEC
// 61131-3 ed. 3, 6.7; TM/TP manual 5.5.
#pragma once

#include <cstdint>

#include "frontend/syntax/ids.h"

namespace rung {

enum class SfcQualifier : uint8_t { N, R, S, L, D, P, P0, P1, SD, DS, SL, Entry, Active, Exit };
// L, D, SD, DS, SL
constexpr bool takesTime(SfcQualifier q) {
  return q == SfcQualifier::L || q == SfcQualifier::D || q == SfcQualifier::SD || q == SfcQualifier::DS ||
         q == SfcQualifier::SL;
}

// An expression with its source range, which the scheduler quotes.
struct SfcExpr {
  ExprId value;  // none: not written
  Loc begin, end;
};
struct SfcPosition {  // AT 100, 40, 60, 30: in the file in which the chart was drawn
  bool placed;
  int32_t x, y, width, height;
};
struct SfcAssociation {  // open(D, T#5s, opened);  {entry} prepare;
  Ident action;          // of an instance: one name with points, `motor.Turn`
  SfcQualifier qualifier;
  NameId word;  // the qualifier as written
  SfcExpr time;
  Loc loc;                  // of the qualifier, or of the name
  Slice<Ident> indicators;  // variables that show the effect of the action; documentation only
};
struct SfcStep {
  Ident name;
  bool initial;
  SfcExpr min, max;  // STEP s (TMIN := T#1s, TMAX := T#5s):
  Slice<SfcAssociation> actions;
  SfcPosition position;
};
struct SfcTransition {
  Ident name;  // none: unnamed
  Loc loc;     // of the name, or of the keyword TRANSITION
  uint32_t priority;
  bool has_priority;
  Slice<Ident> from, to;  // both empty: a condition that transitions of the same name use
  SfcExpr condition;      // := expression
  DeclId body;            // an action that assigns the condition to `target`; none: see `condition`
  Ident target;
  Loc begin, end;  // from TRANSITION to END_TRANSITION
  SfcPosition position;
};

}  // namespace rung

// A Sequential Function Chart as the parser leaves it: steps and transitions in the order of the text, which is the
// order in which they are judged. Actions are members of the POU. A MACRO_STEP leaves only its steps and transitions.
// The chart becomes statements when sema is about to check the body (frontend/text/sfc_schedule.h). IEC 61131-3 ed.
// 3, 6.7; TM/TP manual 5.5.
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

// An expression with its text, which the scheduler quotes.
struct SfcExpr {
  ExprId value;  // none: not written
  Loc begin, end;
};
struct SfcPosition {  // AT 100, 40, 60, 30: in the file that the chart was drawn in
  bool placed;
  int32_t x, y, width, height;
};
struct SfcAssociation {  // open(D, T#5s, opened);  {entry} prepare;
  Ident action;
  SfcQualifier qualifier;
  NameId word;  // the qualifier as written
  SfcExpr time;
  Loc loc;                  // of the qualifier, or of the name
  Slice<Ident> indicators;  // they show what became of the action, to a reader
};
struct SfcStep {
  Ident name;
  bool initial;
  SfcExpr min, max;  // STEP s (TMIN := T#1s, TMAX := T#5s):
  Slice<SfcAssociation> actions;
  SfcPosition position;
};
struct SfcTransition {
  Ident name;  // none: it has none
  Loc loc;     // of the name, or of the word TRANSITION
  uint32_t priority;
  bool has_priority;
  Slice<Ident> from, to;  // both empty: a condition that transitions of the same name use
  SfcExpr condition;      // := expression
  DeclId body;            // an action that assigns the condition to `target`; none: see `condition`
  Ident target;
  Loc begin, end;  // the text from TRANSITION to END_TRANSITION
  SfcPosition position;
};

}  // namespace rung

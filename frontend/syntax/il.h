// Instruction List as the parser leaves it: one entry per instruction, until the scheduler
// (frontend/text/il_schedule.h) has rebuilt statements from them. IEC 61131-3 ed. 2, 3.2; ed. 3, 7.2; TM/TP manual 5.4.
#pragma once

#include <cstdint>

#include "frontend/syntax/ids.h"

namespace rung {

enum class BinaryOp : uint8_t;
struct Argument;
struct IlNested;

enum class IlKind : uint8_t {
  Label,     // a label on a line of its own
  Load,      // LD
  Store,     // ST
  Set,       // S
  Reset,     // R
  Not,       // NOT
  Binary,    // AND ADD GT …: `op`
  Jump,      // JMP: `target`
  Call,      // CAL: `callee`
  Return,    // RET
  Close,     // )
  Function,  // a name in the operator's place: a function, a method, or an input operator such as `CU counter`
};
enum IlFlags : uint8_t {
  kIlNegated = 1,      // N
  kIlConditional = 2,  // C
  kIlDeferred = 4,     // OP( : up to its `)`
  kIlFormal = 8,       // the list names pins, or is empty: CAL t(IN := a), LIMIT(MN := 1)
  kIlInParens = 16,    // the list stands in parentheses
  kIlAttempt = 32,     // ST?
};
struct IlInstruction {
  IlKind kind;
  BinaryOp op;
  uint8_t flags;
  NameId word;  // the operator as written
  Loc loc;      // … and where
  Ident label;  // before it, or none
  Ident target;
  ExprId callee;
  Slice<Argument> operands;
  Slice<IlNested> nested;
};

// An operand that is an instruction list of its own: CAL t(IN := (LD a  AND b)).
struct IlNested {
  uint32_t operand;
  Slice<IlInstruction> list;
};

}  // namespace rung

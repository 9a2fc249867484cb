// SPDX-License-Identifier: Apache-2.0
// Instruction List as the parser creates it: one entry per instruction. It stays in the tree until the scheduler
// (frontend/schedule/il_schedule.h) turns it into statements. IEC 61131-3 ed. 2, 3.2; ed. 3, 7.2; TM/TP manual 5.4.
#pragma once

#include <cstdint>

#include "frontend/syntax/ids.h"

namespace rung {

enum class BinaryOp : uint8_t;
struct Argument;
struct IlNested;

enum class IlKind : uint8_t {
  Label,     // a label on its own line
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
  Function,  // a name in place of an operator: a function, a method, or an input operator such as `CU counter`
};
enum IlFlags : uint8_t {
  kIlNegated = 1,      // N
  kIlConditional = 2,  // C
  kIlDeferred = 4,     // OP( : deferred to its `)`
  kIlFormal = 8,       // the list names pins, or is empty: CAL t(IN := a), LIMIT(MN := 1)
  kIlInParens = 16,    // the list is in parentheses
  kIlAttempt = 32,     // ST?
};
struct IlInstruction {
  IlKind kind;
  BinaryOp op;
  uint8_t flags;
  NameId word;  // the operator as written
  Loc loc;      // … and its location
  Ident label;  // before it, or none
  Ident target;
  ExprId callee;
  Slice<Argument> operands;
  Slice<IlNested> nested;
};

// An operand that is itself an instruction list: CAL t(IN := (LD a  AND b)).
struct IlNested {
  uint32_t operand;
  Slice<IlInstruction> list;
};

}  // namespace rung

// SPDX-License-Identifier: Apache-2.0
// The instructions, by operation and by where their operands are. In: an operator, the type in memory, the modes of the
// operands. Out: the function of an Insn. Called by the translator only. Each group says which fields of the Insn its
// instructions read. Operators share rung/code.h with generated code, and a unit test compares all of them with the
// arithmetic kernel.
#pragma once

#include "ir/interpreter/code.h"
#include "sema/types/arithmetic.h"

namespace rung::ir::interpreter {

using types::Op;

// ---- handlers_arithmetic.cpp: a := b op c. Div and Mod of integers check the divisor when d is not 0.
// A constant is on the right, of Sub, Div and Mod also on the left. Shifts: c is 64 bits wide in the frame or imm.
Handler binaryHandler(Op op, Scalar type, Mode left, Mode right, Mode to);
Handler shiftHandler(Op op, Scalar type, Mode left, Mode right, Mode to);
Handler unaryHandler(Op op, Scalar type, Mode from, Mode to);  // a := op b
// a := b converted; null where nothing needs to be done, since memory of `from` read as `to` is the result.
Handler convertHandler(Scalar from, Scalar to, Mode source, Mode target);
// a := base b ** exponent c, both in the frame. Exponent: I64, U64 or F64; REAL bases have a F64 exponent.
Handler powerHandler(Scalar base, Scalar exponent);
// Checks, d is the site. Overflow: of b op c, in the frame. Range: b (I64 or U64) outside [low, high]: imm of the next
// two instructions.
Handler overflowHandler(Op op, Scalar type);
Handler rangeHandler(rung_fault_kind kind, bool is_signed);
// b is F64: rounds to outside of [low, high], in F64 bits in the next two instructions.
Handler roundedRangeHandler(types::Rounding rounding);
Handler wholeHandler(bool saturates);   // a (I64) := b (F64), both in the frame, halves away from zero
Handler zeroPowerHandler(Scalar base);  // base b is 0 and exponent c (I64) negative

// ---- handlers_compare.cpp
Handler compareHandler(Op op, Scalar type, Mode left, Mode right, Mode to);    // a := b op c
Handler branchHandler(Op op, Scalar type, Mode left, Mode right, bool sense);  // to d when (a op b) == sense
Handler branchTruthHandler(Mode mode, bool sense);                             // to d when a == sense
// Continues a loop: the control a steps by imm; to d while it has not passed the limit b (in the frame).
Handler forHandler(Scalar type, bool up, Mode control);
Handler forFlagHandler(Scalar type, bool up);  // the same in the frame, c := whether to continue
// To the distance in the table at `imm`, by a minus the lowest (imm of the next instruction), c entries, else d.
Handler switchHandler(Scalar type, Mode mode);
// Among c SwitchRange sorted by `low` at `imm`, else to d.
struct SwitchRange {
  uint64_t low, high;  // order-preserving: the highest bit of a signed one is flipped
  int32_t to;
};
Handler switchRangesHandler(Scalar type, Mode mode);

// ---- handlers_memory.cpp
Handler moveHandler(Scalar type, Mode from, Mode to);  // a := b
Handler loadHandler(Scalar type, Mode to);             // a := memory at (pointer slot b) + c
Handler storeHandler(Scalar type, Mode from);          // memory at (pointer slot a) + b := c
Handler loadElementHandler(Scalar type, Scalar index, Base base, Mode index_mode, Mode to);  // a := b[c]
// a := b[c, c of the next], indices I16 or I32. Of the next also a: the stride of the first index, d and imm.
Handler loadElementOfTwoHandler(Scalar type, Scalar index, Base base, Mode index_mode, Mode to);
Handler storeElementHandler(Scalar type, Scalar index, Base base, Mode index_mode, Mode from);  // b[c] := a
// Slot a := address of base b + (c - low) * stride. low: imm of the next; stride, offset: its a, b. imm: count.
Handler elementHandler(Scalar index, Base base, Mode index_mode);
Handler leaHandler(Base base);            // slot a := address of b, plus c
Handler checkNullHandler();               // pointer slot b
Handler loadBitHandler();                 // a := bit d of the byte at (pointer slot b) + c
Handler storeBitHandler();                // bit d of the byte at (pointer slot a) + b := truth in the frame at c
Handler copyHandler(Base to, Base from);  // c bytes
Handler clearHandler(Base to);            // c bytes
Handler blockHandler();                   // slot a := address of block b
Handler imageHandler();                   // slot a := address of image b
Handler selectHandler(Scalar type);       // a := d ? b : c, all in the frame
Handler compareMemoryHandler();           // truth a := c bytes at (slot b) equal those at (slot d)

// ---- handlers_string.cpp. Addresses of strings; capacity in c.
Handler assignStringHandler(bool wide, bool from_wide, Base to, Base from);  // a := b
Handler assignUtf8Handler(Base to, Base from);                               // of two USTRINGs
Handler compareStringHandler(bool wide, Base left, Base right);              // I32 a := order of b and c
Handler emptyStringHandler(bool wide, Base to);                              // a
Handler stringOfScalarHandler(bool wide);  // string at (slot a) of the bits in slot b, kind d
Handler scalarOfStringHandler(bool wide);  // slot a := bits of the string at (slot b), kind d

// ---- handlers_control.cpp
Handler jumpHandler();
Handler callHandler();           // of a function: its frame begins at a and needs c; imm: the site
Handler callOnSelfHandler();     // self + b
Handler callOnPointerHandler();  // slot b
// On the object at (slot b), its method by type id; imm: const VirtualCall*; d: the instruction's own number.
Handler callVirtualHandler();
struct VirtualEntry {
  uint32_t at = 0, frame = 0;  // as Code::Entry; a frame of 0: no method
};
struct VirtualCall {
  uint32_t first = 0, count = 0;  // classes; fault[cast] for others
  uint32_t site = 0;
  const VirtualEntry* entries = nullptr;
};
Handler returnHandler();
Handler haltHandler();
Handler passHandler();     // nothing
Handler stopHandler();     // tells the debugger, then does what the instruction did before
Handler nativeHandler();   // slots at a, imm: NativeThunk
Handler tryHandler();      // U8 a := fault of running the next instruction on until Halt; then to d
Handler rethrowHandler();  // when U8 a is not 0
Handler raiseHandler();    // fault a at site d, value in the frame at b
Handler stepHandler();
Handler debugStepHandler();  // counts rung_context::steps down
Handler countHandler();      // imm: uint64_t*
Handler calledHandler();     // notifies the host: imm the POU's name, slot b the address of its instance or null
// Assertions. Slots from b on: see handlers_control.cpp; imm: const AssertionSite*.
struct AssertionSite {
  rung_assertion is;
  uint8_t kind;      // of the values
  bool has_message;  // computed; else that of `is`
};
enum class AssertionKind : uint8_t { Truth, Compared, Equal, Near };
Handler assertHandler(AssertionKind kind);

}  // namespace rung::ir::interpreter

// SPDX-License-Identifier: Apache-2.0
// The compact form of a module that the interpreter executes: one array of instructions over the same memory layout as
// native code. In: verified IR, translated by translate.cpp. Out: instructions that dispatch.h runs.
//
// An instruction is a function and its operands. Operands are memory: byte offsets in the frame of the call or in the
// instance, or a constant in `imm`; scalars have their own width, so that a narrowing conversion costs nothing on the
// little-endian machines that this runs on. A frame is: the return address, parameters and result in slots of 8 bytes,
// other locals, temporaries; after it begins the frame of a callee, into which a caller writes the arguments.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "rung/module.h"

namespace rung::ir::interpreter {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "operands are narrowed in place");

struct Machine;
struct Insn;
class DebugCode;
using Handler = void (*)(const Insn* ip, uint8_t* fp, uint8_t* self, Machine* m);

struct Insn {
  Handler run = nullptr;
  uint32_t a = 0, b = 0, c = 0, d = 0;  // d: a jump's distance in instructions, or a check's site (0: no check)
  int64_t imm = 0;
};
static_assert(sizeof(Insn) == 32);

// The beginning of a frame.
struct Linkage {
  const Insn* ip;
  uint8_t *fp, *self;
};
constexpr uint32_t kFrameHeader = sizeof(Linkage), kFrameAlign = 16;

// One activation on one thread.
struct Machine {
  rung_context* ctx = nullptr;
  uint8_t* limit = nullptr;  // end of the stack of frames
  uint8_t* base = nullptr;   // its begin
  DebugCode* debug = nullptr;
  // The source location of an instruction as a site, from 1; null: unknown.
  uint32_t (*site_of)(const rung_context* ctx, const Insn* insn) = nullptr;
  // The next instruction, where instructions return to a loop instead of jumping to the next (dispatch.h); while
  // something else than instructions runs, the present one.
  const Insn* ip = nullptr;
  uint8_t *fp = nullptr, *self = nullptr;
};

// The site of a call instruction, from 1.
uint32_t siteOfCall(const Insn* call);

// Runs until Halt.
void execute(const Insn* ip, uint8_t* fp, uint8_t* self, Machine* m);

// Where an operand is.
enum class Mode : uint8_t {
  Frame,     // at fp + offset
  Self,      // at self + offset
  Constant,  // imm
};
// Where the memory is that an instruction takes by address.
enum class Base : uint8_t {
  Frame,
  Self,
  Pointer,  // the frame slot at the offset holds its address
  Constant  // imm is its address
};

// The type of a scalar in memory.
enum class Scalar : uint8_t { Bool, I8, I16, I32, I64, U8, U16, U32, U64, F32, F64 };
constexpr uint32_t sizeOf(Scalar s) {
  constexpr uint8_t kSizes[] = {1, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8};
  return kSizes[static_cast<int>(s)];
}
constexpr bool isReal(Scalar s) { return s >= Scalar::F32; }
constexpr bool isSigned(Scalar s) { return s >= Scalar::I8 && s <= Scalar::I64; }

// How often a line of the source was executed or, where `function` is set, that POU was called, or, where `branch` is
// not 0, that branch of the IF or CASE at line and column was taken.
struct Counter {
  const char *file, *function;
  uint32_t line;
  uint64_t count;
  uint32_t column = 0, branch = 0;
};

// A native library function with a uniform signature: arguments in `slots`, scalars by value and others by address, the
// instance first where there is one; then the result, or the address of its memory and, of a string, the capacity.
using NativeThunk = void (*)(rung_context* ctx, uint64_t* slots);
struct Native {
  const char* name;  // of the C function
  NativeThunk call;
};
// In a table that is sorted by name; null: not there.
const Native* findNative(std::span<const Native> natives, std::string_view function);

}  // namespace rung::ir::interpreter

// SPDX-License-Identifier: Apache-2.0
// Members of type BIT (codesys): eight in a row share a byte, the first is its lowest bit; see bit_members.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

bool isNamedBit(const Context& context, NameId name);
bool isBit(Context& context, TypeExprId written);
bool mayBeBit(Context& context, const Var& var, TypeExprId written);
void addBit(Context& context, TypeId record, VarId id);
VarId addByteOfBits(Context& context, TypeId record, VarId first);
void addBitAt(Context& context, TypeId record, VarId id, VarId byte, uint8_t bit);
uint8_t initialBits(Context& context, TypeId record, VarId byte);

}  // namespace rung::sema

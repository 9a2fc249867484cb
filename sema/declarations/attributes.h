// SPDX-License-Identifier: Apache-2.0
// Attributes whose value or position matters: {attribute 'pack_mode' := '1'}. In: the pragmas of a declaration. Out:
// the value, checked; a warning for an attribute that has no effect before such a declaration. Called by those who
// collect and resolve declarations. The pages are "Attribute: …" of the CODESYS help and "Attribute '…'" of the TwinCAT
// help.
#pragma once

#include <optional>

#include "sema/context.h"

namespace rung::sema {

// What an attribute is written before.
enum class Attributed : uint8_t { Structure, OtherType, Function, Block, Program, Method, Globals, Input, Variable };

// Forbids, with a warning, attributes where they do nothing.
void checkAttributes(Context& context, const DeclHeader& header, Attributed before);

// Those of a POU and of a variable of one, for their Pragmas.
void takeAttributes(Context& context, const DeclHeader& header, Pou& pou);
void takeVariableAttributes(Context& context, const DeclHeader& header, Var& var);
// When the variables of a POU have their types: finds the inputs that {attribute 'is_connected'} names.
void checkAttributesOf(Context& context, PouId pou);
// {attribute 'symbol'}; none: without it.
std::optional<types::SymbolAccess> symbolAccessOf(Context& context, const DeclHeader& header);
// {attribute 'global_init_slot'}; none: without it.
std::optional<int32_t> initSlotOf(Context& context, const DeclHeader& header);

// Of a structure or block: the most that its members are aligned to; 0: as their types are.
uint8_t packModeOf(Context& context, const DeclHeader& header);
// Warns of members that the pack mode of their record does not move.
void checkPacking(Context& context, TypeId record);

}  // namespace rung::sema

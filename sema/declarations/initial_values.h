// SPDX-License-Identifier: Apache-2.0
// Initial values of variables, fields and types: lists for arrays, members for structures and instances, and one
// constant for elementary types; see initial_values.cpp.
#pragma once

#include <string_view>

#include "sema/context.h"

namespace rung::sema {

// Checks the initial value of a variable, field or type against its type, converting in place; arrays, structures and
// FB instances by their initialisers.
void checkInitializer(Context& context, ExprId& init, TypeId type);

// What an initial value may read in codesys: only constants, variables with the same lifetime, also those of the call.
enum class InitialReads : uint8_t { Constants, Globals, Variables, Call };

// True when it reads variables.
bool checkInitializerAs(Context& context, ExprId& init, TypeId type, std::string_view what,
                        InitialReads may = InitialReads::Constants);

}  // namespace rung::sema

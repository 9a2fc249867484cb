// SPDX-License-Identifier: Apache-2.0
// Resolves declarations: types, POUs and lists; cuts types that contain themselves, lays everything out and checks
// initial values; see resolve.cpp.
#pragma once

#include <string_view>

#include "sema/context.h"

namespace rung::sema {

void resolveDeclarations(Context& context);
// Lays out a type, with what it holds resolved first. False when it is too large.
bool ensureLayout(Context& context, TypeId type);
// Whether the layout of a type can be known now; reports one that the expression with `function` determines itself.
bool checkLayout(Context& context, std::string_view function, TypeId type, Loc loc);

}  // namespace rung::sema

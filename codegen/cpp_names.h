// SPDX-License-Identifier: Apache-2.0
// Names of a program in the facade of a body in C++. In: names as declared. Out: valid C++ names.
// Called by cpp_bodies.cpp and the parts of the facade.
#pragma once

#include <string>
#include <string_view>

namespace rung::codegen {

// Types, items and functions are in upper case; of a path only the last name is used.
std::string cppUpper(std::string_view name);
// As the user wrote it; a `_` follows C++ keywords and common macros.
std::string cppIdentifier(std::string_view name);

}  // namespace rung::codegen

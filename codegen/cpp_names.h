// Names of a program in the facade of a body in C++. In: names as they are declared. Out: names that C++ takes.
// Called by cpp_bodies.cpp.
#pragma once

#include <string>
#include <string_view>

namespace rung::codegen {

// Types, items and functions are in upper case there; of a path the last name.
std::string cppUpper(std::string_view name);
// As the user wrote it; words of C++ and common macros get a `_` behind them.
std::string cppIdentifier(std::string_view name);

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// Names in the facade of a body in C++: see cpp_names.h.
#include "codegen/cpp_names.h"

#include "frontend/source/scanner.h"

namespace rung::codegen {

std::string cppUpper(std::string_view name) { return upper(name.substr(name.rfind('.') + 1)); }

std::string cppIdentifier(std::string_view name) {
  // C++ keywords and common macros, separated by blanks.
  static constexpr std::string_view kTaken =
      " "
      "alignas alignof and and_eq asm assert auto bitand bitor bool break case catch char char16_t char32_t class "
      "compl "
      "const const_cast constexpr continue decltype default delete do double dynamic_cast else enum EOF errno explicit "
      "export extern false float for friend goto if inline int linux long mutable namespace new noexcept not not_eq "
      "NULL "
      "nullptr operator or or_eq private protected public register reinterpret_cast return short signed sizeof static "
      "static_assert static_cast stderr stdin stdout struct switch template this thread_local throw true try typedef "
      "typeid typename union unix unsigned using virtual void volatile wchar_t while xor xor_eq ";
  std::string out(name);
  if (kTaken.find(" " + out + " ") != std::string_view::npos) out += '_';
  return out;
}

}  // namespace rung::codegen

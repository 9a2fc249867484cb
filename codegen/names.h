// SPDX-License-Identifier: Apache-2.0
// Names of the generated code: the only mangling scheme, and how numbers and literals are appended.
// In: names as the user wrote them. Out: C++ names. Called by every file of codegen.
//   variable, field      level    -> level_          C, C++ and POSIX define no name that ends like this
//   type                 Ramp     -> Ramp_type       a variable may have the name of its type
//   function, body, init Ramp     -> Ramp_fn, Ramp_body, Ramp_init
// A name that begins with `_` or has other characters than ASCII letters, digits and `_` becomes u…0u.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rung::codegen {

void appendMangled(std::string& out, std::string_view name);
// The stem of the files of a name: its mangled form, shortened when it is too long for a file system.
std::string fileStem(std::string_view name);

// The line that opens the namespace of a module. What it holds is hidden: a shared library exports only the module's
// function, and position-independent code calls and reads directly.
std::string openNamespace(std::string_view name_space);

void appendUnsigned(std::string& out, uint64_t value);
void appendSigned(std::string& out, int64_t value);
// In quotes; escapes `"`, `\`, `?` and everything but printable ASCII.
void appendQuoted(std::string& out, std::string_view text);
// The same as a char16_t literal; `text` is UTF-8.
void appendQuotedWide(std::string& out, std::string_view text);
// UTF-16 units of a UTF-8 string up to its first NUL.
uint32_t wideLength(std::string_view text);

// FNV-1a over the lower-case name: equal for all spellings of an identifier.
uint64_t nameHash(std::string_view name);
uint64_t hashBytes(uint64_t hash, const void* bytes, size_t size);
inline constexpr uint64_t kHashStart = 0xcbf29ce484222325u;

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// The source of a body in C++ as the user wrote it, with its lines kept. In: the source and its location. Out: the
// lines of the body, and the #include lines, which go to the front of its file. Called by cpp_bodies.cpp.
#pragma once

#include <string>
#include <string_view>

#include "frontend/source/files.h"

namespace rung::codegen {

// Appends to `code` and `front`. Where conditions surround an #include line, `front` gets a copy of these too.
void splitCppSource(std::string_view source, std::string_view path, const SourceLocation& location, std::string& code,
                    std::string& front);

}  // namespace rung::codegen

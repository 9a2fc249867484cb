// The namespace of a library by its folder below stdlib/. Called by libraries.cpp and the tool native_table.
#pragma once

#include <string>
#include <string_view>

namespace rung::tool {

std::string namespaceOf(std::string_view folder);

}  // namespace rung::tool

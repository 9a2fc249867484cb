// SPDX-License-Identifier: Apache-2.0
// The namespace of a library by its folder below stdlib/, and the names that other tools have for the libraries. Called
// by libraries.cpp, compile.cpp and the tool native_table.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rung::driver {

std::string namespaceOf(std::string_view folder);

// Another name of a library: Tc2_Standard.TON is Standard.TON.
struct NamespaceAlias {
  const char *alias, *name;
};
std::span<const NamespaceAlias> namespaceAliases();

}  // namespace rung::driver

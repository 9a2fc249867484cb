// SPDX-License-Identifier: Apache-2.0
// From a name to its declaration, the declaration of its type, and what implements it. In: a view and a byte of a file.
// Out: places in files.
#pragma once

#include <optional>
#include <vector>

#include "tools/ide/meanings.h"
#include "tools/ide/view.h"

namespace rung::ide {

struct Destination {
  FileRange name;   // of what is declared
  FileRange range;  // the declaration
};
struct Navigation {
  FileRange origin;  // the name at the cursor
  std::vector<Destination> destinations;
};

// None: no name that is known.
std::optional<NamePlace> nameAt(const View& view, FileId file, uint32_t byte);

enum class NavigationKind : uint8_t { Declaration, Definition, Type, Implementation };
// A VAR_EXTERNAL is declared where it is written, and defined where its global is; a method of an interface is
// implemented by those of the blocks that have it.
std::optional<Navigation> navigate(const View& view, FileId file, uint32_t byte, NavigationKind kind);

// Where an entity is declared; none: nowhere.
std::optional<Destination> destinationOf(const View& view, Entity entity);

}  // namespace rung::ide

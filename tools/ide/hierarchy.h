// SPDX-License-Identifier: Apache-2.0
// Who calls whom, and what is derived from what. In: a view and a POU, by its place or as an answer of before. Out:
// POUs with the places of the calls. A call through an interface or a base counts for each method that it may run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/ide/navigation.h"
#include "tools/ide/symbols.h"

namespace rung::ide {

// A POU, or a property.
struct HierarchyItem {
  Entity entity;
  std::string name, container;  // the block around a member
  SymbolKind kind = SymbolKind::Function;
  Destination at;
};
struct Caller {
  HierarchyItem item;
  std::vector<FileRange> calls;  // in the caller
};

// Of an instance its block. None: nothing that is called is there.
std::optional<HierarchyItem> callableAt(const View& view, FileId file, uint32_t byte);
std::vector<Caller> incomingCalls(const View& view, Entity callee);
std::vector<Caller> outgoingCalls(const View& view, Entity caller);

// A block, class or interface, or a structure; of an instance or variable that of its type.
std::optional<HierarchyItem> derivableAt(const View& view, FileId file, uint32_t byte);
std::vector<HierarchyItem> supertypesOf(const View& view, Entity type);
std::vector<HierarchyItem> subtypesOf(const View& view, Entity type);

}  // namespace rung::ide

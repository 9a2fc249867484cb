// SPDX-License-Identifier: Apache-2.0
// Names around what is declared: namespaces, configurations, resources, tasks and lists of globals, for which sema has
// no entity. In: a view and a byte of a file. Out: the name there, and all places that mean the same. Asked by
// references, navigation, hover and rename.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/ide/references.h"
#include "tools/ide/view.h"

namespace rung::ide {

enum class OuterKind : uint8_t { Namespace, Configuration, Resource, Task, List };

struct OuterName {
  OuterKind kind = OuterKind::Namespace;
  FileRange at;
  std::string name;                   // as it is written there
  std::string full;                   // with the names around it, as they are declared: `Plant.Drives`
  std::vector<std::string> path;      // the same, folded
  std::vector<Reference> references;  // in the order of the files; of a list only where it is used
  bool is_complete = true;            // no place is in code that was made from something else
};
// None: another name is there, or none.
std::optional<OuterName> outerNameAt(const View& view, FileId file, uint32_t byte);
// Whether something has the name that this one would get there.
bool isOuterNameTaken(const View& view, const OuterName& name, std::string_view new_name);

// `namespace`, and so on.
std::string_view wordOf(OuterKind kind);

// Where the file of a list says its name. Empty name: the file has the name of the list.
struct ListDeclaration {
  FileId file;  // none: the list has its name from something else
  FileRange name;
  FileRange section;  // the word VAR_GLOBAL of its first section in that file
};
ListDeclaration declarationOfList(const View& view, const OuterName& list);

}  // namespace rung::ide

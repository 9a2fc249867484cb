// SPDX-License-Identifier: Apache-2.0
// NAMESPACE and USING: the namespaces of the project, which of them are visible at a location, and the meaning of
// names there; see namespaces.cpp.
#pragma once

#include <string_view>
#include <vector>

#include "sema/context.h"
#include "sema/scopes.h"

namespace rung::sema {

// Whether `context` may use `found`; reports an entity that is INTERNAL to another namespace.
bool checkVisible(Context& context, Entity found, Loc loc);
// Whether `context` is in the namespace of a region, or in one within it.
bool isInside(const Context& context, RegionId declared);

struct DeclInRegion {
  DeclId decl;
  FileId file;
  RegionId region;
};

// The declarations of all files with their regions, those in NAMESPACEs included; creates the namespaces.
std::vector<DeclInRegion> collectNamespaces(Context& context);
// The region of a POU declared here: a new one if it has USINGs.
RegionId regionOfPou(Context& context, const PouDecl& decl);
// The NAMESPACE around the current location, or null.
Namespace* namespaceAround(Context& context);
// The namespace that a POU or type of this name is declared in: that NAMESPACE; in a library among the sources, the
// library where another declaration has the name; or null. And the name in it in full: `Simatic.Ax.Motor`.
Namespace* namespaceFor(Context& context, NameId name);
NameId qualifiedName(Context& context, NameId name);
// The Namespace of the library among the sources that a file belongs to, or kNoLibrary.
uint32_t libraryOfSource(const Context& context, FileId file);
// The meaning of a name in the namespaces around `context` and their USINGs; and in the USINGs of the file, which come
// after the names of the project.
Entity lookUpAround(Context& context, NameId key, Loc loc, bool types_only);
Entity lookUpOpened(Context& context, NameId key, Loc loc, bool types_only);
RegionId regionOfFile(const Context& context, FileId file);
// The meaning of `A.B.name`; Error after a report.
Entity lookUpQualified(Context& context, Slice<Ident> path);
// The namespace of a name at `context`: a NAMESPACE, a library, the project.
Entity findNamespace(Context& context, NameId name);
// The entity that a namespace declares under a name.
Entity lookUpNamespace(Context& context, uint32_t space, NameId key);
bool isVisible(Context& context, Entity found);
// The full name of an entity that some NAMESPACE declares under a name unknown here; empty when none does.
std::string_view nameElsewhere(Context& context, NameId key);

}  // namespace rung::sema

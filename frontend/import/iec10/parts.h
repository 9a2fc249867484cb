// SPDX-License-Identifier: Apache-2.0
// Shared by the parts of the reader. Private to frontend/import/iec10: iec10.cpp (the project and its POUs),
// declarations.cpp, networks.cpp.
#pragma once

#include <string>

#include "frontend/import/content.h"

namespace rung::importer::iec10 {

// The kind of an element by its xsi:type, without a prefix: Contact, FBD, StructTypeSpec.
std::string typeOf(const Reading& import, const xml::Element& element);

// ---- declarations.cpp

// The type in `holder`, an element such as <Type>, <BaseType> or <ResultType>.
void writeTypeRef(Reading& import, const xml::Element& holder, uint32_t depth = 0);
void writeTypeDecl(Reading& import, const xml::Element& declaration);
// VAR_INPUT … END_VAR for each list of variables in `owner`: <InputVars>, <Vars>, …
void writeVarLists(Reading& import, const xml::Element& owner);
void writeVarList(Reading& import, const xml::Element& list, std::string_view word);

// ---- networks.cpp

// The statements and networks of a <MainBody>; messages use `name` for the POU.
void writeMainBody(Reading& import, const xml::Element& body, const std::string& name);

}  // namespace rung::importer::iec10

// Shared by the parts of the reader. Private to frontend/import/iec10: iec10.cpp (the project and its POUs),
// declarations.cpp, networks.cpp. Content, names and locations are handled by the functions of frontend/import/plcopen.
#pragma once

#include <string>

#include "frontend/import/plcopen/import.h"

namespace rung::iec10 {

using plcopen::Import;

// The kind of an element by its xsi:type, without a prefix: Contact, FBD, StructTypeSpec.
std::string typeOf(const Import& import, const xml::Element& element);

// ---- declarations.cpp

// The type in `holder`, an element such as <Type>, <BaseType> or <ResultType>.
void writeTypeRef(Import& import, const xml::Element& holder, uint32_t depth = 0);
void writeTypeDecl(Import& import, const xml::Element& declaration);
// VAR_INPUT … END_VAR for each list of variables in `owner`: <InputVars>, <Vars>, …
void writeVarLists(Import& import, const xml::Element& owner);
void writeVarList(Import& import, const xml::Element& list, std::string_view word);

// ---- networks.cpp

// The statements and networks of a <MainBody>; messages use `name` for the POU.
void writeMainBody(Import& import, const xml::Element& body, const std::string& name);

}  // namespace rung::iec10

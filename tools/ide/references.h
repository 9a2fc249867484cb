// SPDX-License-Identifier: Apache-2.0
// Where a project names something. In: a view, and an entity or a byte of a file. Out: places in all files, in the
// order of the files, with how each uses the name; labels, which only their body knows; and the words of a statement
// that belong together.
#pragma once

#include <optional>
#include <vector>

#include "tools/ide/family.h"
#include "tools/ide/view.h"

namespace rung::ide {

enum class ReferenceKind : uint8_t { Name, Read, Write };  // Name: neither is read nor written: a type, a call
struct Reference {
  FileRange at;
  ReferenceKind kind = ReferenceKind::Name;
  bool is_declaration = false;
};

// All places with the name of the family, or with its other name `written`: INT_TO_STRING is a name of TO_STRING.
// `is_complete` becomes false where the check knows another place of the name, in code that is made from the file.
std::vector<Reference> referencesTo(const View& view, const Family& family, std::string_view written,
                                    bool* is_complete = nullptr);
// The label in the body around a location, and the jumps to it. Empty: no label is there.
std::vector<Reference> labelsAt(const View& view, Loc at);
// Of the name or label at a byte. Empty: there is none.
std::vector<Reference> referencesAt(const View& view, FileId file, uint32_t byte);

// The references in this file, or the words that belong together: IF and END_IF, FOR and its EXIT.
std::vector<Reference> highlightsAt(const View& view, FileId file, uint32_t byte);

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
// Texts of messages: the rules for each, and message files (.mes). In: lines `number<TAB>text` in UTF-8. Out: the
// messages that a ladder has in the end. The layout is Rung's: NCT manual 6.13 says that the editor exports and imports
// such files, that they are UTF-8, and how a text prints a number. Called by the reader of ladders (read.cpp, nct.cpp).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/import/formats.h"
#include "frontend/import/nct/program.h"

namespace rung::importer::nct {

inline constexpr uint32_t kMostMessage = 999;

// Reports a text that a message cannot have.
//   fails   a text of more than 255 bytes, an empty one, `{#0:F2}`, two items                E1434
void checkMessageText(const MessageLine& line, Diagnostics& diagnostics);

// Adds the texts of the message files. They replace those that the ladder has in MESSAGES, as an import does.
//   fails   `door open`, `1000<TAB>door open`, a number twice in the files     E1100 E1101 E1404
//   fails   a byte that is not UTF-8                                           E1102
//   warns   a number that MESSAGES has as well                                 W1104
void importMessages(const Sources& sources, std::span<const FileId> files, Program& program, Diagnostics& diagnostics);

}  // namespace rung::importer::nct

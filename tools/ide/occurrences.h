// SPDX-License-Identifier: Apache-2.0
// Whether it is known what each occurrence of a name in the sources means. In: a view, a name, and the places that are
// known already. Out: yes or no. Where it is known, an unused name in its place cannot change any meaning.
#pragma once

#include <string_view>
#include <vector>

#include "tools/ide/text_edits.h"

namespace rung::ide {

// Comments and strings do not count; a pragma with the name does, and what it means is not known.
// `where`: only the occurrences there; empty: all.
bool knowsAllOccurrences(const View& view, std::string_view name, const Edits& known,
                         const std::vector<Range>& where = {});
// Whether the edits are at all places of the name.
bool areAllOccurrences(const View& view, std::string_view name, const Edits& known);

}  // namespace rung::ide

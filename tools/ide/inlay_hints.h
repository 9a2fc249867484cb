// SPDX-License-Identifier: Apache-2.0
// What an editor shows between the words of a source: the pins of arguments without names, implicit conversions, values
// of enumeration items, and the addresses that the system gave to %I*. In: a view and a part of a file. Out: short
// texts and where they belong.
#pragma once

#include <string>
#include <vector>

#include "tools/ide/view.h"

namespace rung::ide {

enum class HintKind : uint8_t { Pin, Type, Value };
struct InlayHint {
  FileRange at;  // before this; of all but pins after it
  std::string label;
  HintKind kind;
};

// In the order of the file. Only code in ST has pins and conversions.
std::vector<InlayHint> hintsIn(const View& view, const FileRange& part);

// `%IB4`, `%QX0.1`: by bytes, because words are counted in two ways.
std::string addressText(const sema::Project& project, const sema::ImageView& at);

}  // namespace rung::ide

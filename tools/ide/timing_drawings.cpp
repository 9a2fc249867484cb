// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/timing_drawings.h"

#include <string>

#include "frontend/source/text.h"

namespace rung::ide {
namespace {

struct TimingDrawing {
  std::string_view blocks;  // their names in capitals, with blanks around each
  std::string_view lines;
};
constexpr TimingDrawing kDrawings[] = {
#define RUNG_DRAWING(blocks, lines) {blocks, lines},
#include "tools/ide/timing_drawings.def"
#undef RUNG_DRAWING
};

}  // namespace

std::string_view timingDrawingOf(std::string_view block) {
  const std::string name = " " + upper(block) + " ";
  for (const TimingDrawing& drawing : kDrawings)
    if (drawing.blocks.find(name) != std::string_view::npos) return drawing.lines;
  return {};
}

}  // namespace rung::ide

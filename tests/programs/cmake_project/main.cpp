// SPDX-License-Identifier: Apache-2.0
// The smallest host: it allocates the memory, opens and closes the press five times, and prints the strokes.
#include <cstdio>
#include <cstring>
#include <vector>

#include "rung/module.h"

extern "C" const rung_module* press_module(void);

namespace {

// The address of a field of the program instance Main.
void* field(const rung_module& module, rung_context& context, const char* name) {
  for (uint32_t s = 0; s < module.symbols.count; ++s) {
    const rung_symbol& symbol = *rung_symbol_at(&module, s);
    if (strcmp(module.strings + symbol.name, "Main") != 0) continue;
    const rung_type& type = *rung_type_at(&module, symbol.type);
    for (uint32_t f = type.first; f < type.first + type.count; ++f)
      if (strcmp(module.strings + rung_field_at(&module, f)->name, name) == 0)
        return static_cast<char*>(context.blocks[symbol.index]) + symbol.offset + rung_field_at(&module, f)->offset;
  }
  return nullptr;
}

}  // namespace

int main() {
  const rung_module& module = *press_module();
  std::vector<std::vector<uint64_t>> memory;
  std::vector<void*> blocks;
  for (uint32_t b = 0; b < module.blocks.count; ++b) {
    memory.emplace_back(rung_block_at(&module, b)->size / 8 + 1);
    blocks.push_back(memory.back().data());
  }
  rung_host host = {};
  rung_context context = {};
  context.blocks = blocks.data();
  context.module = &module;
  context.host = &host;
  if (rung_guarded(&context, module.init) != RUNG_FAULT_NONE) return 3;

  auto* closed = static_cast<uint8_t*>(field(module, context, "closed"));
  auto* strokes = static_cast<int16_t*>(field(module, context, "strokes"));
  if (closed == nullptr || strokes == nullptr) return 2;
  for (int cycle = 0; cycle < 10; ++cycle) {
    *closed = cycle % 2;
    context.now_ns = cycle * rung_task_at(&module, 0)->interval_ns;
    if (rung_guarded(&context, rung_task_at(&module, 0)->run) != RUNG_FAULT_NONE) return 3;
  }
  std::printf("strokes %d\n", *strokes);
  return 0;
}

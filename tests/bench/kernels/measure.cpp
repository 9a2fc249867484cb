// Times the tasks of a generated module: task T_name runs program instance P_name with the inputs `rounds` and the
// output `check`. Arguments: name=rounds. Prints the same columns as hand.cpp.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "rung/module.h"

extern "C" const rung_module* plc_module(void);

namespace {

// The address of a field of a program instance; null when there is none.
int32_t* field(const rung_module& m, rung_context& ctx, const std::string& program, const char* name) {
  for (uint32_t s = 0; s < m.symbol_count; ++s) {
    const rung_symbol& symbol = m.symbols[s];
    if (strcasecmp(m.strings + symbol.name, program.c_str()) != 0) continue;
    const rung_type& type = m.types[symbol.type];
    for (uint32_t f = type.first; f < type.first + type.count; ++f)
      if (strcasecmp(m.strings + m.fields[f].name, name) == 0)
        return reinterpret_cast<int32_t*>(static_cast<char*>(ctx.blocks[symbol.index]) + symbol.offset +
                                          m.fields[f].offset);
  }
  return nullptr;
}

}  // namespace

int main(int argc, char** argv) {
  const rung_module& m = *plc_module();
  std::vector<void*> blocks;
  for (uint32_t i = 0; i < m.block_count; ++i)
    blocks.push_back(aligned_alloc(64, (m.blocks[i].size + 63) / 64 * 64 + 64));
  std::vector<std::vector<uint8_t>> memory(m.area_count);
  std::vector<uint8_t*> areas;
  rung_context ctx = {};
  ctx.blocks = blocks.data();
  for (uint32_t i = 0; i < m.area_count; ++i) {
    memory[i].resize(m.areas[i].size + 8);
    areas.push_back(memory[i].data());
  }
  ctx.areas = areas.data();
  rung_host host = {};
  ctx.module = &m;
  ctx.host = &host;
  for (uint32_t i = 0; i < m.block_count; ++i) memset(blocks[i], 0, m.blocks[i].size);

  for (int a = 1; a < argc; ++a) {
    const std::string argument = argv[a], name = argument.substr(0, argument.find('='));
    const int32_t rounds = std::atoi(argument.c_str() + name.size() + 1);
    const rung_task* task = nullptr;
    for (uint32_t t = 0; t < m.task_count; ++t)
      if (strcasecmp(m.strings + m.tasks[t].name, ("T_" + name).c_str()) == 0) task = &m.tasks[t];
    int32_t* in = field(m, ctx, "P_" + name, "rounds");
    const int32_t* out = field(m, ctx, "P_" + name, "check");
    if (task == nullptr || in == nullptr || out == nullptr) {
      std::fprintf(stderr, "the module has no kernel `%s`\n", name.c_str());
      return 2;
    }
    double best = 1e9;
    for (int i = 0; i < 5; ++i) {
      if (rung_guarded(&ctx, m.init) != RUNG_FAULT_NONE) return 3;  // every run starts from the same memory
      *in = rounds;
      const auto begin = std::chrono::steady_clock::now();
      if (rung_guarded(&ctx, task->run) != RUNG_FAULT_NONE) {
        std::fprintf(stderr, "kernel `%s` faulted\n", name.c_str());
        return 3;
      }
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      if (seconds < best) best = seconds;
    }
    std::printf("rung\t%s\t%d\t%.6f\t%d\n", name.c_str(), rounds, best, *out);
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// Times kernels, see measure_hand.h: what `rung build --shared` made, as it ships, against code by hand. The modules
// are listed in RUNG_BENCH_MODULES as `who=path`, separated by colons. Task T_name runs program instance P_name with
// the input `rounds` and the output `check`. CPU time: other load on the machine does not count, and turns of all take
// place side by side.
#include <dlfcn.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "measure_hand.h"
#include "rung/module.h"

namespace {

constexpr int kTurns = 9;

[[noreturn]] void fail(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  std::exit(2);
}

double cpuSeconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

// A module with its memory.
class Unit {
 public:
  Unit(std::string who, const std::string& path) : who_(std::move(who)) {
    void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) fail(dlerror());
    module_ = reinterpret_cast<rung_module_function>(dlsym(library, "plc_module"))();
    for (uint32_t i = 0; i < module_->blocks.count; ++i)
      blocks_.push_back(aligned_alloc(64, (rung_block_at(module_, i)->size + 63) / 64 * 64 + 64));
    for (uint32_t i = 0; i < module_->areas.count; ++i)
      areas_.push_back(static_cast<uint8_t*>(calloc(1, rung_area_at(module_, i)->size + 8)));
    context_.blocks = blocks_.data();
    context_.areas = areas_.data();
    context_.module = module_;
    context_.host = &host_;
  }
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;

  const std::string& who() const { return who_; }

  // Runs a kernel; every run starts from the same memory. Returns its CPU time.
  double run(const std::string& name, int32_t rounds, int32_t& check) {
    const rung_task* task = nullptr;
    for (uint32_t t = 0; t < module_->tasks.count; ++t)
      if (strcasecmp(module_->strings + rung_task_at(module_, t)->name, ("T_" + name).c_str()) == 0)
        task = rung_task_at(module_, t);
    int32_t* const in = field("P_" + name, "rounds");
    const int32_t* const out = field("P_" + name, "check");
    if (task == nullptr || in == nullptr || out == nullptr) fail("module `" + who_ + "` has no kernel `" + name + "`");
    if (rung_guarded(&context_, module_->init) != RUNG_FAULT_NONE) fail("the initialization faulted");
    *in = rounds;
    const double begin = cpuSeconds();
    const uint8_t fault = rung_guarded(&context_, task->run);
    const double seconds = cpuSeconds() - begin;
    if (fault != RUNG_FAULT_NONE) fail("kernel `" + name + "` of module `" + who_ + "` faulted");
    check = *out;
    return seconds;
  }

 private:
  // The address of a field of a program instance; null when there is none.
  int32_t* field(const std::string& program, const char* name) {
    for (uint32_t s = 0; s < module_->symbols.count; ++s) {
      const rung_symbol& symbol = *rung_symbol_at(module_, s);
      if (strcasecmp(module_->strings + symbol.name, program.c_str()) != 0) continue;
      const rung_type& type = *rung_type_at(module_, symbol.type);
      for (uint32_t f = type.first; f < type.first + type.count; ++f)
        if (strcasecmp(module_->strings + rung_field_at(module_, f)->name, name) == 0)
          return reinterpret_cast<int32_t*>(static_cast<char*>(context_.blocks[symbol.index]) + symbol.offset +
                                            rung_field_at(module_, f)->offset);
    }
    return nullptr;
  }

  std::string who_;
  const rung_module* module_;
  std::vector<void*> blocks_;
  std::vector<uint8_t*> areas_;
  rung_host host_ = {};
  rung_context context_ = {};
};

std::vector<Unit*> openUnits() {
  const char* const list = std::getenv("RUNG_BENCH_MODULES");
  std::vector<Unit*> units;
  for (std::string rest = list == nullptr ? "" : list; !rest.empty();) {
    const size_t end = std::min(rest.find(':'), rest.size()), equals = rest.find('=');
    units.push_back(new Unit(rest.substr(0, equals), rest.substr(equals + 1, end - equals - 1)));
    rest.erase(0, end + 1);
  }
  return units;
}

}  // namespace

void measureKernel(const char* name, int32_t rounds, int32_t (*hand)(int32_t rounds)) {
  static const std::vector<Unit*> units = openUnits();
  struct Best {
    double seconds = 1e9;
    int32_t check = 0;
  };
  Best by_hand;
  std::vector<Best> best(units.size());
  for (int turn = 0; turn < kTurns; ++turn) {
    if (hand != nullptr) {
      const double begin = cpuSeconds();
      by_hand.check = hand(rounds);
      by_hand.seconds = std::min(by_hand.seconds, cpuSeconds() - begin);
    }
    for (size_t i = 0; i < units.size(); ++i)
      best[i].seconds = std::min(best[i].seconds, units[i]->run(name, rounds, best[i].check));
  }
  const auto print = [&](const char* who, const Best& of) {
    std::printf("%s\t%s\t%d\t%.6f\t%d\n", who, name, rounds, of.seconds, of.check);
  };
  if (hand != nullptr) print("hand", by_hand);
  for (size_t i = 0; i < units.size(); ++i) print(units[i]->who().c_str(), best[i]);
}

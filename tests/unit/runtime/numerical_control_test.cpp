// SPDX-License-Identifier: Apache-2.0
// The simulated numerical control is asked anything: each service answers, writes where a service may, and what it is
// given never makes it read or write beyond the memory of the program (each memory is of exactly its size, for the
// preset asan). RUNG_MUTATION_SEED and RUNG_MUTATION_COUNT repeat or prolong it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <random>

#include "rung/module.h"
#include "stdlib/nct/control/control.h"

namespace rung::nct {
namespace {

uint64_t settingOr(const char* name, uint64_t value) {
  const char* const text = std::getenv(name);
  return text == nullptr ? value : std::strtoull(text, nullptr, 10);
}

class Asked : public ::testing::Test {
 protected:
  Asked() { control_.serve(host_); }

  uint32_t below(uint32_t count) { return static_cast<uint32_t>(random_() % count); }
  // A program may have these there by mistake: small numbers, addresses, halves of doubles, anything.
  uint32_t word() {
    switch (below(8)) {
      case 0:
      case 1:
      case 2:
      case 3: return below(5);
      case 4: return 2 + below(RUNG_NC_WORDS);
      case 5: return below(2) == 0 ? 0 : 0x3FF00000u + (below(64) << 16);
      case 6: return ~below(3);
      default: return static_cast<uint32_t>(random_());
    }
  }
  void cycle() {
    now_ns_ += 10'000'000;
    host_.nc->exchange(host_.nc_data, slice_.get(), nonvolatile_.get(), true, now_ns_);
  }

  Control control_;
  rung_host host_{};
  std::mt19937_64 random_{settingOr("RUNG_MUTATION_SEED", 1)};
  std::unique_ptr<uint32_t[]> memory_ = std::make_unique<uint32_t[]>(RUNG_NC_WORDS);
  std::unique_ptr<uint32_t[]> slice_ = std::make_unique<uint32_t[]>(RUNG_NC_SLICE_WORDS);
  std::unique_ptr<uint32_t[]> nonvolatile_ = std::make_unique<uint32_t[]>(RUNG_NC_NONVOLATILE_WORDS + 1);
  int64_t now_ns_ = 0;
};

// All but those of the network, which would ask hosts.
constexpr int32_t kServices[] = {10,  11,  31,  32,  34,  35,  40,  41,  70,  81,  90,  100, 101, 102, 103, 104, 105,
                                 106, 107, 108, 201, 202, 300, 303, 304, 306, 307, 308, 309, 61,  62,  63,  999};

// Requests that are right, so that some of what is changed in them is right, too: MW11, MR10 and MW81.
struct Right {
  int32_t function;
  bool is_write;
  uint32_t data[3];
};
constexpr Right kRight[] = {{11, true, {0, 5000, 10}}, {10, false, {0, 5000, 10}}, {81, true, {1, 1, 300}}};

TEST_F(Asked, AnyBlockIsAnswered) {
  constexpr uint32_t kFirstKept = 4000;
  const uint64_t count = settingOr("RUNG_MUTATION_COUNT", 20'000);
  cycle();
  uint64_t done = 0;
  for (uint64_t n = 0; n < count; ++n) {
    const Right* const right = below(2) == 0 ? nullptr : &kRight[below(std::size(kRight))];
    const uint32_t words = right != nullptr ? 5 : 2 + (below(20) == 0 ? below(400) : 1 + below(5));
    const uint32_t address = kFirstKept + below(RUNG_NC_WORDS - kFirstKept - words + 1);
    memory_[address + 1] = words - 2;
    for (uint32_t k = 2; k < words; ++k)
      memory_[address + k] = right != nullptr && below(4) != 0 ? right->data[k - 2] : word();
    const std::unique_ptr<uint32_t[]> block(new uint32_t[words]);
    std::copy_n(&memory_[address], words, block.get());
    rung_nc_request request{};
    request.is_write = right != nullptr ? right->is_write : below(2) != 0;
    request.function = right != nullptr ? right->function : kServices[below(std::size(kServices))];
    request.address = address;
    request.count = words;
    request.block = block.get();
    const uint32_t number = host_.nc->submit(host_.nc_data, &request);
    ASSERT_NE(number, 0u);
    uint32_t cycles = 0;
    while (!host_.nc->poll(host_.nc_data, number, memory_.get())) {
      ASSERT_LT(++cycles, 1000u) << "service " << request.function << " of block " << n;
      cycle();
    }
    done += memory_[address] == 0 ? 1 : 0;
    for (uint32_t k = 0; k < kFirstKept; ++k)
      ASSERT_EQ(memory_[k], 0u) << "service " << request.function << " of block " << n << " wrote word " << k;
  }
  EXPECT_GT(done, count / 10) << "hardly any block is right";
}

TEST_F(Asked, AnyCommandIsAnswered) {
  const uint64_t count = settingOr("RUNG_MUTATION_COUNT", 20'000);
  for (uint64_t n = 0; n < count; ++n) {
    const auto number = [&] { return static_cast<int32_t>(word()); };
    const double value = static_cast<double>(number()) / (1 + below(1000));
    double result = 0;
    char text[256];
    switch (below(6)) {
      case 0: host_.nc->move(host_.nc_data, static_cast<int32_t>(below(40)), number(), value, value / 7); break;
      case 1: host_.nc->read_macro(host_.nc_data, number(), number(), &result); break;
      case 2: host_.nc->write_macro(host_.nc_data, number(), number(), value); break;
      case 3: host_.nc->scope(host_.nc_data, static_cast<int32_t>(below(60)), number(), number(), &result); break;
      case 4: host_.nc->text(host_.nc_data, static_cast<int32_t>(below(4)), number(), text); break;
      default:
        for (uint32_t k = below(8); k > 0; --k) slice_[below(RUNG_NC_SLICE_WORDS)] = word();
        cycle();
    }
  }
  cycle();
  double macro = 0;
  ASSERT_EQ(host_.nc->write_macro(host_.nc_data, 0, 500, 2.5), RUNG_NC_DONE);
  ASSERT_EQ(host_.nc->read_macro(host_.nc_data, 0, 500, &macro), RUNG_NC_DONE);
  EXPECT_EQ(macro, 2.5);
}

}  // namespace
}  // namespace rung::nct

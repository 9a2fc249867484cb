// SPDX-License-Identifier: Apache-2.0
// Modules of other versions of Rung on the bundled host: rows that are longer or shorter than those of this header,
// unknown extensions, another RUNG_MODULE_ABI; and new instances.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <deque>
#include <vector>

#include "rung/host.h"
#include "sample_module.h"
#include "stdlib/runtime/host/loaded_module.h"

using namespace rung::host;

namespace {

constexpr uint32_t kLaterColumns = 16;

// The sample module with rows of other sizes.
struct Resized {
  rung_module module = sample::module();
  std::deque<std::vector<uint64_t>> rows;

  void resize(rung_table& table, uint32_t row_size) {
    std::vector<uint64_t>& copy = rows.emplace_back(table.count * row_size / 8 + 1, 0xeeeeeeeeeeeeeeeeu);
    for (uint32_t i = 0; i < table.count; ++i)
      memcpy(reinterpret_cast<char*>(copy.data()) + size_t{i} * row_size, rung_row(&table, i),
             std::min(row_size, table.row_size));
    table = {copy.data(), table.count, row_size};
  }
  std::vector<rung_table*> tables() {
    return {&module.blocks,     &module.areas,  &module.tasks,      &module.writes,     &module.symbols,
            &module.types,      &module.fields, &module.enum_items, &module.dimensions, &module.retain,
            &module.persistent, &module.sites,  &module.tests};
  }
};

struct Outcome {
  int code;
  std::string out, err;
};
Outcome go(const rung_module& module) {
  RunOptions options;
  options.cycles = 5;
  options.watch = "Main.count,Main.table[2,2],Main.color,%QB0";
  options.trace_path = "-";
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = run(module, options);
  fflush(stdout);
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

TEST(Versions, LongerRowsAndExtensionsAreIgnored) {
  const Outcome now = go(sample::module());
  ASSERT_EQ(now.code, 0) << now.err;
  Resized later;
  for (rung_table* const table : later.tables()) later.resize(*table, table->row_size + kLaterColumns);
  static const uint32_t content = 42;
  static const rung_extension extensions[] = {{"rung.later", &content, sizeof content}};
  later.module.extensions = {extensions, 1, sizeof extensions[0]};
  const Outcome outcome = go(later.module);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, now.out);
}

TEST(Versions, ColumnsThatAModuleDoesNotHaveAreZero) {
  Resized earlier;
  earlier.resize(earlier.module.symbols, offsetof(rung_symbol, path));
  const LoadedModule loaded(earlier.module);
  ASSERT_EQ(loaded.symbols.size(), sample::module().symbols.count);
  const rung_symbol& first = *rung_symbol_at(&sample::module(), 0);
  EXPECT_STREQ(loaded.strings + loaded.symbols[0].name, "Main");
  EXPECT_EQ(loaded.symbols[0].type, first.type);
  EXPECT_NE(first.path, 0u);
  EXPECT_EQ(loaded.symbols[0].path, 0u);
  const Outcome outcome = go(earlier.module);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, go(sample::module()).out);
}

TEST(Versions, AnExtensionIsFoundByItsName) {
  static const uint32_t content = 42;
  static const rung_extension list[] = {{"rung.one", nullptr, 0}, {"rung.two", &content, sizeof content}};
  const rung_table extensions{list, 2, sizeof list[0]}, none{};
  EXPECT_EQ(rung_find_extension(&extensions, "rung.two"), &list[1]);
  EXPECT_EQ(rung_find_extension(&extensions, "rung"), nullptr);
  EXPECT_EQ(rung_find_extension(&none, "rung.one"), nullptr);
}

TEST(Versions, AnotherAbiIsRefused) {
  rung_module other = sample::module();
  ++other.abi;
  const Outcome outcome = go(other);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "error: the program was built for another version of the runtime; build it again\n");
  EXPECT_EQ(outcome.out, "");
}

// ---- rung_init_instance

void initPoint(rung_context*, void* instance) { static_cast<sample::Point*>(instance)->y = 7; }
void faultingInit(rung_context* context, void*) { rung_raise(context, RUNG_FAULT_INDEX, 1, 11); }

struct Instances : testing::Test {
  rung_module module = sample::module();
  rung_initialiser row{};
  rung_context context{};
  uint32_t type_of_point = RUNG_NONE;
  sample::Point point{1, 2};

  Instances() {
    for (uint32_t i = 0; i < module.types.count; ++i)
      if (std::string(module.strings + rung_type_at(&module, i)->name) == "Point") type_of_point = i;
    context.module = &module;
  }
  void use(void (*init)(rung_context*, void*)) {
    row = {type_of_point, init};
    module.initialisers = {&row, 1, sizeof row};
  }
};

TEST_F(Instances, BeginWithTheirInitialValues) {
  use(initPoint);
  EXPECT_EQ(rung_init_instance(&context, type_of_point, &point), RUNG_FAULT_NONE);
  EXPECT_EQ(point.x, 0);
  EXPECT_EQ(point.y, 7);
}

TEST_F(Instances, OfTypesWithoutInitialValuesAreZero) {
  EXPECT_EQ(rung_init_instance(&context, type_of_point, &point), RUNG_FAULT_NONE);
  EXPECT_EQ(point.x, 0);
  EXPECT_EQ(point.y, 0);
}

TEST_F(Instances, TellOfAFault) {
  use(faultingInit);
  EXPECT_EQ(rung_init_instance(&context, type_of_point, &point), RUNG_FAULT_INDEX);
  EXPECT_EQ(context.fault.value, 11);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// The module written by hand: see sample_module.h.
#include "sample_module.h"

#include <cstddef>
#include <map>
#include <vector>

#include "rung/code.h"

namespace sample {

std::string ran;

namespace {

std::string text(1, '\0');
uint32_t t(const std::string& word) {
  static std::map<std::string, uint32_t> known;
  const auto found = known.find(word);
  if (found != known.end()) return found->second;
  const uint32_t at = static_cast<uint32_t>(text.size());
  text += word;
  text += '\0';
  return known[word] = at;
}

Main& self(rung_context* ctx) { return *static_cast<Main*>(ctx->blocks[0]); }

void init(rung_context* ctx) {
  Main& m = self(ctx);
  m.level = 0.5f;
  m.divisor = 1;
  m.color = 1;
  m.kept = 5;
  m.kept_always = 50;
  m.table[1][2] = 7;
  rung_string_assign(m.name, 10, "a'b");
  m.other = &m.point;
}

void fast(rung_context* ctx) {
  Main& m = self(ctx);
  ran += 'f';
  if (m.divisor == 0) rung_raise(ctx, RUNG_FAULT_DIV, 0, 0);
  m.count += 10 / m.divisor;
  m.elapsed = static_cast<uint32_t>(ctx->now_ns / 1'000'000);
  m.kept += 1;
  m.kept_always += 1;
  ctx->areas[1][0] = static_cast<uint8_t>(ctx->areas[0][0] | 4);  // %QX0.2
}
void slow(rung_context* ctx) {
  ran += 's';
  ++self(ctx).slow_runs;
}
void onEvent(rung_context* ctx) {
  ran += 'e';
  ++self(ctx).event_runs;
}

rung_assertion at(uint32_t line, const char* text = nullptr) {
  return {"t.st", line, 0, nullptr, text, nullptr, nullptr};
}
void testOk(rung_context* ctx) {
  const rung_assertion first = at(3);
  rung_assert_equal(ctx, &first, RUNG_INT, 5, 5);
}
void testBad(rung_context* ctx) {
  const rung_assertion level = at(8, "the level"), text = at(9);
  rung_assert_equal(ctx, &level, RUNG_INT, 5, static_cast<uint64_t>(int64_t{-7}));
  rung_assert_equal(ctx, &text, RUNG_STRING, reinterpret_cast<uintptr_t>("a"), reinterpret_cast<uintptr_t>("b$"));
  const rung_assertion never{"t.st", 10, 4, "\tü ASSERT(FALSE);", "never", nullptr, nullptr};
  rung_assert(ctx, &never, false);
}
void testFaults(rung_context* ctx) { rung_raise(ctx, RUNG_FAULT_INDEX, 1, 11); }
void testUntilDone(rung_context* ctx) {
  Main& m = self(ctx);
  if (++m.count == 5) m.run = 1;
  const rung_assertion time = at(20);
  rung_assert_equal(ctx, &time, RUNG_TIME, static_cast<uint64_t>(m.count - 1) * 10,
                    static_cast<uint64_t>(ctx->now_ns / 1'000'000));
}
void testNever(rung_context*) {}

rung_type plain(rung_type_kind kind, uint32_t size) {
  return {static_cast<uint8_t>(kind), 0, 0, 0, size, RUNG_NONE, 0, 0, 0};
}

template <class Row>
rung_table table(const std::vector<Row>& rows) {
  return {rows.data(), static_cast<uint32_t>(rows.size()), sizeof(Row)};
}

struct Tables {
  std::vector<rung_type> types;
  std::vector<rung_field> fields;
  std::vector<rung_enum_item> items;
  std::vector<rung_dimension> dimensions;
  std::vector<rung_symbol> symbols;
  std::vector<rung_task> tasks;
  std::vector<rung_test> tests;
  rung_block block{t("Main"), sizeof(Main), alignof(Main)};
  rung_range retain{0, offsetof(Main, kept), 4}, persistent{0, offsetof(Main, kept_always), 4};
  rung_site sites[2];
  rung_module module{}, changed{};

  Tables() {
    enum : uint32_t { Bool, Int, DInt, Real, Time, Color, Row, Text, PointT, Word, MainT };
    types = {plain(RUNG_BOOL, 1), plain(RUNG_INT, 2), plain(RUNG_DINT, 4), plain(RUNG_REAL, 4), plain(RUNG_TIME, 4)};
    items = {{t("Red"), 0}, {t("Green"), 1}, {t("Blue"), 2}};
    types.push_back({RUNG_ENUM, 0, 0, t("Color"), 2, Int, 0, 0, 3});
    dimensions = {{1, 2}, {0, 2}};
    types.push_back({RUNG_ARRAY, 0, 0, 0, 12, Int, 0, 0, 2});
    types.push_back({RUNG_STRING, 0, 0, 0, 11, RUNG_NONE, 10, 0, 0});
    fields = {{t("x"), Int, 0, 0}, {t("y"), Int, 2, 0}};
    types.push_back({RUNG_RECORD, 0, 0, t("Point"), 4, RUNG_NONE, 0, 0, 2});
    types.push_back(plain(RUNG_WORD, 2));
    const uint32_t first = static_cast<uint32_t>(fields.size());
    const auto field = [&](const char* name, uint32_t type, size_t offset, uint32_t flags = 0) {
      fields.push_back({t(name), type, static_cast<uint32_t>(offset), flags});
    };
    field("run", Bool, offsetof(Main, run), RUNG_FIELD_INPUT);
    field("count", DInt, offsetof(Main, count));
    field("Level", Real, offsetof(Main, level));
    field("elapsed", Time, offsetof(Main, elapsed));
    field("color", Color, offsetof(Main, color));
    field("table", Row, offsetof(Main, table));
    field("name", Text, offsetof(Main, name));
    field("point", PointT, offsetof(Main, point));
    field("other", PointT, offsetof(Main, other), RUNG_FIELD_BY_REFERENCE);
    field("bits", Word, offsetof(Main, bits));
    field("divisor", DInt, offsetof(Main, divisor));
    field("start_event", Bool, offsetof(Main, start_event));
    field("kept", DInt, offsetof(Main, kept), RUNG_FIELD_RETAIN);
    field("kept_always", DInt, offsetof(Main, kept_always), RUNG_FIELD_PERSISTENT);
    types.push_back({RUNG_RECORD, 0, 0, t("Main"), sizeof(Main), RUNG_NONE, 0, first,
                     static_cast<uint32_t>(fields.size()) - first});

    symbols.push_back({t("Main"), MainT, RUNG_IN_BLOCK, 255, 1, 0, 0, 0, t("Plant.Cpu.")});
    symbols.push_back({t("Main.valve"), Bool, RUNG_IN_AREA, 2, 0, 1, 0, 0, t("Plant.Cpu.")});
    symbols.push_back({t("speed"), Word, RUNG_IN_AREA, 255, 0, 0, 2, 0, 0});

    tasks.push_back({t("Slow"), RUNG_CYCLIC, 1, 30'000'000, 0, 0, 0, 0, 0, 0, 0, 0, slow});
    tasks.push_back({t("Fast"), RUNG_CYCLIC, 1, 10'000'000, 0, 0, 0, 0, 0, 0, 1, 0, fast});
    tasks.push_back({t("Edge"), RUNG_EVENT, 0, 0, 0, 0, t("Main.start_event"), 0, 0, 0, 0, 0, onEvent});

    tests.push_back({t("good_test"), t("t.st"), 1, RUNG_NONE, 0, nullptr, testOk, nullptr});
    tests.push_back({t("bad_test"), t("t.st"), 6, RUNG_NONE, 0, nullptr, testBad, nullptr});
    tests.push_back({t("faulting_test"), t("t.st"), 12, RUNG_NONE, 0, nullptr, testFaults, nullptr});
    tests.push_back({t("cyclic_test"), t("t.st"), 16, 0, offsetof(Main, run), nullptr, testUntilDone, nullptr});
    tests.push_back({t("endless_test"), t("t.st"), 30, 0, offsetof(Main, run), nullptr, testNever, nullptr});

    sites[0] = {t("Main"), t("main.st"), 12, 7, 0, 0};
    sites[1] = {t("Main"), t("main.st"), 14, 3, 1, 10};

    module.abi = RUNG_MODULE_ABI;
    module.layout = RUNG_MODULE_LAYOUT;
    module.pointer_size = sizeof(void*);
    module.name = "sample";
    module.compiler = "by hand";
    module.strings = text.c_str();
    module.layout_hash = 1;
    module.blocks = {&block, 1, sizeof block};
    static const rung_area areas[] = {{t("I"), t("%I"), 4, RUNG_AREA_INPUT}, {t("Q"), t("%Q"), 1, RUNG_AREA_OUTPUT}};
    module.areas = {areas, 2, sizeof areas[0]};
    static const rung_write writes[] = {{1, 255, 0, 1}};  // of Fast
    module.writes = {writes, 1, sizeof writes[0]};
    module.tasks = table(tasks);
    module.symbols = table(symbols);
    module.types = table(types);
    module.fields = table(fields);
    module.enum_items = table(items);
    module.dimensions = table(dimensions);
    module.retain = {&retain, 1, sizeof retain};
    module.persistent = {&persistent, 1, sizeof persistent};
    module.sites = {sites, 2, sizeof sites[0]};
    module.tests = table(tests);
    module.init = init;
    changed = module;
    changed.layout_hash = 2;
  }
};

const Tables& tables() {
  static const Tables all;
  return all;
}

}  // namespace

const rung_module& module() { return tables().module; }
const rung_module& changedModule() { return tables().changed; }

}  // namespace sample

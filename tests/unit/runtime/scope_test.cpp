// SPDX-License-Identifier: Apache-2.0
// rung/scope.h in C on the module written by hand, and the scope of the bundled host: rows, triggers, what is lost.
#include "rung/scope.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sample_module.h"
#include "stdlib/runtime/host/memory.h"
#include "stdlib/runtime/host/session.h"

namespace {

struct Scopes : testing::Test {
  rung::host::LoadedModule module{sample::module()};
  rung::host::Memory memory{module};
  rung_variable channels[2];
  uint8_t ring[4 * (8 + 4 + 1)];  // four rows of the time, a DINT and a bit
  rung_scope scope{};

  Scopes() {
    memory.reset();
    EXPECT_TRUE(rung_find(&sample::module(), "Main.count", &channels[0]));
    EXPECT_TRUE(rung_find(&sample::module(), "Main.bits.3", &channels[1]));
    scope.channels = channels;
    scope.channel_count = 2;
    scope.ring = ring;
    scope.ring_size = sizeof ring;
  }
  sample::Main& main() { return *static_cast<sample::Main*>(memory.context().blocks[0]); }

  // One activation for each count.
  void sampleAll(const std::vector<int32_t>& counts) {
    for (const int32_t count : counts) {
      main().count = count;
      main().bits = count % 2 != 0 ? 8 : 0;
      rung_scope_sample(&scope, &memory.common(), 1'000 * count);
    }
  }
  // `count/bit` of the rows from this number on, and the number of the first.
  std::string rows(uint32_t from = 0, uint32_t count = 100) {
    std::vector<uint8_t> bytes(size_t{100} * scope.row_size);
    const uint32_t read = rung_scope_read(&scope, &from, bytes.data(), count);
    std::string text = std::to_string(from) + ":";
    for (uint32_t i = 0; i < read; ++i) {
      const uint8_t* const row = bytes.data() + size_t{i} * scope.row_size;
      int32_t value;
      memcpy(&value, rung_scope_value(&scope, row, 0), sizeof value);
      EXPECT_EQ(rung_scope_time(row), 1'000 * int64_t{value});
      text += " " + std::to_string(value) + "/" +
              std::to_string(*static_cast<const uint8_t*>(rung_scope_value(&scope, row, 1)));
    }
    return text;
  }
  void trigger(rung_scope_condition condition, double level, uint32_t before) {
    scope.condition = static_cast<uint8_t>(condition);
    scope.trigger = channels[0];
    scope.level = level;
    scope.rows_before = before;
  }
};

TEST_F(Scopes, WithoutATriggerNewRowsReplaceTheOldest) {
  EXPECT_EQ(rung_scope_row_size(channels, 2), 13u);
  EXPECT_TRUE(rung_scope_start(&scope));
  EXPECT_EQ(rows(), "0:");
  sampleAll({1, 2, 3});
  EXPECT_EQ(rows(), "0: 1/1 2/0 3/1");
  EXPECT_EQ(rows(1, 1), "1: 2/0");
  sampleAll({4, 5, 6});
  EXPECT_EQ(rows(3), "3: 4/0 5/1 6/0");
  EXPECT_EQ(rows(0), "2: 3/1 4/0 5/1 6/0") << "rows 0 and 1 are lost";
  EXPECT_EQ(rows(6), "6:");
  EXPECT_EQ(scope.state, RUNG_SCOPE_RUNNING);
  rung_scope_stop(&scope);
  sampleAll({7});
  EXPECT_EQ(rows(5), "5: 6/0");
  EXPECT_EQ(scope.state, RUNG_SCOPE_COMPLETE);
}

TEST_F(Scopes, NumbersOfRowsMayWrap) {
  EXPECT_TRUE(rung_scope_start(&scope));
  scope.taken = UINT32_MAX - 1;
  sampleAll({1, 2, 3});
  EXPECT_EQ(scope.taken, 1u);
  EXPECT_EQ(rows(UINT32_MAX - 1), "4294967294: 1/1 2/0 3/1");
  EXPECT_EQ(rows(0), "0: 3/1");
}

TEST_F(Scopes, TheDividerLeavesActivationsOut) {
  scope.divider = 3;
  EXPECT_TRUE(rung_scope_start(&scope));
  sampleAll({1, 2, 3, 4, 5, 6, 7});
  EXPECT_EQ(rows(), "0: 1/1 4/0 7/1");
}

TEST_F(Scopes, ARisingEdgeKeepsRowsBeforeIt) {
  trigger(RUNG_SCOPE_RISING, 10, 1);
  EXPECT_TRUE(rung_scope_start(&scope));
  sampleAll({20, 11, 5, 9});
  EXPECT_EQ(scope.state, RUNG_SCOPE_WAITING) << "it was above from the first row on";
  sampleAll({10});
  EXPECT_EQ(scope.state, RUNG_SCOPE_TRIGGERED);
  EXPECT_EQ(scope.trigger_row, 4u);
  sampleAll({1, 30, 31, 32});
  EXPECT_EQ(scope.state, RUNG_SCOPE_COMPLETE);
  EXPECT_EQ(rows(), "3: 9/1 10/0 1/1 30/0");
}

TEST_F(Scopes, AFallingEdge) {
  trigger(RUNG_SCOPE_FALLING, 10, 3);
  EXPECT_TRUE(rung_scope_start(&scope));
  sampleAll({9, 10, 9, 8});
  EXPECT_EQ(rows(), "0: 9/1 10/0 9/1");
  EXPECT_EQ(scope.trigger_row, 2u);
}

TEST_F(Scopes, LevelsTriggerWithTheFirstRow) {
  trigger(RUNG_SCOPE_ABOVE, 10, 0);
  EXPECT_TRUE(rung_scope_start(&scope));
  sampleAll({9, 10, 11, 12, 13, 14});
  EXPECT_EQ(rows(), "1: 10/0 11/1 12/0 13/1");
  trigger(RUNG_SCOPE_BELOW, 10, 0);
  EXPECT_TRUE(rung_scope_start(&scope));
  sampleAll({9, 10, 11, 12, 13, 14});
  EXPECT_EQ(rows(), "0: 9/1 10/0 11/1 12/0");
}

TEST_F(Scopes, NeedsRoomForRowsAfterTheTrigger) {
  trigger(RUNG_SCOPE_RISING, 10, 4);
  EXPECT_FALSE(rung_scope_start(&scope));
  scope.condition = RUNG_SCOPE_NONE;
  scope.ring_size = 2 * 13 - 1;
  EXPECT_FALSE(rung_scope_start(&scope));
  sampleAll({1});
  EXPECT_EQ(scope.state, RUNG_SCOPE_OFF);
}

TEST_F(Scopes, TriggersAreNumbers) {
  const auto number = [&](const char* path, const auto& value) {
    rung_variable variable;
    EXPECT_TRUE(rung_find(&sample::module(), path, &variable));
    EXPECT_TRUE(rung_scope_is_trigger(&variable));
    EXPECT_EQ(variable.type->size, sizeof value);
    return rung_scope_number(&variable, &value);
  };
  EXPECT_EQ(number("Main.count", int32_t{-5}), -5.0);
  EXPECT_EQ(number("Main.level", -0.5f), -0.5);
  EXPECT_EQ(number("Main.bits", uint16_t{0xffff}), 65535.0);
  EXPECT_EQ(number("Main.elapsed", uint32_t{4'000'000'000}), 4e9);
  EXPECT_EQ(number("Main.color", int16_t{-1}), -1.0);
  rung_variable name;
  EXPECT_TRUE(rung_find(&sample::module(), "Main.name", &name));
  EXPECT_FALSE(rung_scope_is_trigger(&name));
}

// The host: the task Fast counts by 10 each 10 ms.
struct HostScope : testing::Test {
  rung::host::Session session{sample::module(), {}, {}};
  rung::host::Scope& scope = session.tasks().scope();
  rung::host::ScopeOrder order;

  HostScope() {
    std::string error;
    EXPECT_TRUE(session.load(error)) << error;
    session.init();
    session.begin();
    order.paths = {"Main.count", "Main.color", "%QX0.2"};
    order.task = 1;
    order.rows = 50;
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      EXPECT_TRUE(session.cycle().isComplete());
      session.completeCycle();
    }
  }
  std::string rows(uint32_t from) {
    const rung::host::ScopeRows rows = scope.read(from, 1000);
    std::string text = std::to_string(rows.first) + ":";
    for (uint32_t i = 0; i < rows.count; ++i) {
      const uint8_t* const row = scope.row(rows, i);
      text += ' ' + std::to_string(rung::host::Scope::timeOf(row) / 1'000'000) + "ms";
      for (uint32_t c = 0; c < scope.variables().size(); ++c) text += ',' + scope.value(row, c);
    }
    return text;
  }
};

TEST_F(HostScope, HasARowForEachActivationOfItsTask) {
  EXPECT_EQ(rows(0), "0:");
  run(1);
  EXPECT_EQ(scope.start(order), "");
  run(3);
  EXPECT_EQ(rows(0), "0: 10ms,20,Green,TRUE 20ms,30,Green,TRUE 30ms,40,Green,TRUE");
  order.task = 0;  // Slow, each 30 ms
  EXPECT_EQ(scope.start(order), "");
  run(6);
  EXPECT_EQ(rows(0), "0: 60ms,60,Green,TRUE 90ms,90,Green,TRUE") << "Slow runs before Fast";
  EXPECT_EQ(scope.state().next, 2u);
}

TEST_F(HostScope, ATriggerHasALevelOfItsType) {
  order.condition = RUNG_SCOPE_ABOVE;
  order.trigger = "main.elapsed";
  order.level = "T#40ms";
  order.rows = 3;
  order.rows_before = 1;
  EXPECT_EQ(scope.start(order), "");
  run(10);
  EXPECT_EQ(scope.state().state, RUNG_SCOPE_COMPLETE);
  EXPECT_EQ(scope.state().trigger_row, 4u);
  EXPECT_EQ(rows(0), "3: 30ms,40,Green,TRUE 40ms,50,Green,TRUE 50ms,60,Green,TRUE");
}

TEST_F(HostScope, SaysWhatIsWrong) {
  const auto refusal = [&](auto change) {
    rung::host::ScopeOrder wrong = order;
    change(wrong);
    return scope.start(wrong);
  };
  EXPECT_EQ(refusal([](auto& o) { o.paths = {"Main.table"}; }),
            "`Main.table` has no value of its own; name a variable in it");
  EXPECT_EQ(refusal([](auto& o) { o.paths = {"Main.coun"}; }).substr(0, 12), "`Main` has n");
  EXPECT_EQ(refusal([](auto& o) { o.paths.assign(65, "Main.count"); }), "a scope has at most 64 variables");
  EXPECT_EQ(refusal([](auto& o) { o.rows = 1; }), "a scope has 2 to 1000000 rows");
  const auto trigger = [](const char* path, const char* level) {
    return [=](auto& o) {
      o.condition = RUNG_SCOPE_RISING;
      o.trigger = path;
      o.level = level;
    };
  };
  EXPECT_EQ(refusal(trigger("Main.name", "'a'")), "`Main.name` cannot be a trigger; use a BOOL, a number or a time");
  EXPECT_EQ(refusal(trigger("Main.count", "")), "the trigger `Main.count` needs a level");
  EXPECT_EQ(refusal(trigger("Main.count", "high")), "`high` is not a value of type DINT");
  EXPECT_EQ(refusal([&](auto& o) {
              trigger("Main.count", "5")(o);
              o.rows_before = 50;
            }),
            "no row is left after the trigger; use fewer before it, or more in all");
  EXPECT_EQ(scope.state().state, RUNG_SCOPE_OFF);
}

}  // namespace

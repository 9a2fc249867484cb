// SPDX-License-Identifier: Apache-2.0
// rung/monitor.h in C: variables of the module written by hand, which has no table of names; values as text and bytes,
// the table of forces, and values in another version.
#include "rung/monitor.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rung/retain.h"
#include "sample_module.h"
#include "stdlib/runtime/host/memory.h"

namespace {

struct Monitor : testing::Test {
  rung::host::LoadedModule module{sample::module()};
  rung::host::Memory memory{module};
  rung_forced rows[3];
  uint8_t values[16];
  rung_forces forces{rows, 3, 0, values, sizeof values, 0};
  Monitor() { memory.reset(); }

  rung_variable at(const std::string& path) {
    rung_variable variable;
    EXPECT_TRUE(rung_find(&sample::module(), path.c_str(), &variable)) << path;
    return variable;
  }
  std::string text(const std::string& path) {
    const rung_variable variable = at(path);
    char room[128];
    return std::string(room, rung_read_text(&memory.common(), &variable, room, sizeof room - 1));
  }
  rung_access write(const std::string& path, const std::string& text) {
    const rung_variable variable = at(path);
    return rung_write_text(&memory.common(), &variable, text.data(), text.size());
  }
  rung_access force(const std::string& path, const std::string& text) {
    const rung_variable variable = at(path);
    return rung_force_text(&forces, &sample::module(), &variable, text.data(), text.size());
  }
  bool unforce(const std::string& path) {
    const rung_variable variable = at(path);
    return rung_unforce(&forces, &variable);
  }
  std::string applied(const std::string& path) {
    rung_apply_forces(&memory.common(), &forces);
    return text(path);
  }
};

TEST_F(Monitor, FindsVariables) {
  EXPECT_EQ(text("MAIN.level"), "0.5");
  EXPECT_EQ(text("Main.table[2,2]"), "7");
  EXPECT_EQ(text("Main.color"), "Green");
  EXPECT_EQ(text("plant.cpu.Main.name"), "'a$'b'");
  EXPECT_EQ(text("Cpu.Main.valve"), "FALSE");
  EXPECT_EQ(text("%QX0.2"), "FALSE");
  EXPECT_EQ(text("Main.other.x"), "0");
  EXPECT_EQ(text("Main.bits.15"), "FALSE");
  EXPECT_EQ(text("Main.table"), "");
  rung_variable ignored;
  for (const char* const wrong : {"",
                                  ".",
                                  "Main.",
                                  "Main..level",
                                  "Mai",
                                  "Main.table[3,0]",
                                  "Main.table[1",
                                  "Main[1]",
                                  "Main.level.1",
                                  "Main.bits.16",
                                  "Main.bits.1.1",
                                  "Main.count^",
                                  "%",
                                  "%QX0.8",
                                  "%QB99",
                                  "%QX99999999999999999999",
                                  "u.Main.level",
                                  "Plant.Main.level",
                                  "Main.table[1,-1]",
                                  "Main.table[1,9223372036854775808]",
                                  "Main.level x",
                                  "0000",
                                  "Main.level "})
    EXPECT_FALSE(rung_find(&sample::module(), wrong, &ignored)) << wrong;
}

TEST_F(Monitor, ReadsAndWritesBytes) {
  const rung_variable count = at("Main.count"), bit = at("Main.bits.9"), name = at("Main.name");
  int32_t number = -3;
  EXPECT_EQ(rung_write_value(&memory.common(), &count, &number, 4), RUNG_ACCESS_OK);
  EXPECT_EQ(text("Main.count"), "-3");
  EXPECT_EQ(rung_write_value(&memory.common(), &count, &number, 2), RUNG_ACCESS_SIZE);
  number = 0;
  EXPECT_TRUE(rung_read_value(&memory.common(), &count, &number, 4));
  EXPECT_EQ(number, -3);
  uint8_t on = 1;
  EXPECT_EQ(rung_write_value(&memory.common(), &bit, &on, 1), RUNG_ACCESS_OK);
  EXPECT_EQ(text("Main.bits"), "512");
  on = 0;
  EXPECT_TRUE(rung_read_value(&memory.common(), &bit, &on, 1));
  EXPECT_EQ(on, 1);
  // A string ends, whatever is written.
  EXPECT_EQ(rung_write_value(&memory.common(), &name, "abcdefghijklmnop", 11), RUNG_ACCESS_OK);
  EXPECT_EQ(text("Main.name"), "'abcdefghij'");
}

TEST_F(Monitor, RefusesWhatCannotBeWritten) {
  EXPECT_EQ(write("Main.table", "1"), RUNG_ACCESS_ARRAY);
  EXPECT_EQ(write("Main.point", "1"), RUNG_ACCESS_RECORD);
  EXPECT_EQ(write("Main.count", "x"), RUNG_ACCESS_VALUE);
  EXPECT_EQ(write("Main.color", "Gren"), RUNG_ACCESS_VALUE);
  EXPECT_EQ(write("Main.color", "Color#Blue"), RUNG_ACCESS_OK);
  EXPECT_EQ(text("Main.color"), "Blue");
  reinterpret_cast<sample::Main*>(memory.block(0))->other = nullptr;
  EXPECT_EQ(write("Main.other.x", "1"), RUNG_ACCESS_NULL);
  EXPECT_EQ(text("Main.other.x"), "");
}

TEST_F(Monitor, TextsAreCut) {
  const rung_variable color = at("Main.color"), count = at("Main.count");
  char room[4] = "???";
  EXPECT_EQ(rung_read_text(&memory.common(), &color, room, 2), 2u);
  EXPECT_STREQ(room, "Gr");
  EXPECT_EQ(rung_read_text(&memory.common(), &count, room, 0), 0u);
  EXPECT_STREQ(room, "");
}

TEST_F(Monitor, ForcesHoldUntilTheyAreTakenBack) {
  EXPECT_EQ(force("Main.count", "12"), RUNG_ACCESS_OK);
  EXPECT_EQ(text("Main.count"), "0");  // it was not applied
  EXPECT_EQ(applied("Main.count"), "12");
  write("Main.count", "3");
  EXPECT_EQ(applied("Main.count"), "12");
  EXPECT_EQ(force("Main.count", "no"), RUNG_ACCESS_VALUE);  // the value before stays
  EXPECT_EQ(applied("Main.count"), "12");
  EXPECT_TRUE(unforce("main.COUNT"));
  EXPECT_FALSE(unforce("Main.count"));
  EXPECT_EQ(text("Main.count"), "12");
  write("Main.count", "3");
  EXPECT_EQ(applied("Main.count"), "3");
}

TEST_F(Monitor, TheLastForceWinsAndBitsLeaveTheirNeighbours) {
  write("Main.bits", "16#F0F0");
  EXPECT_EQ(force("Main.bits.0", "TRUE"), RUNG_ACCESS_OK);
  EXPECT_EQ(applied("Main.bits"), "61681");  // 16#F0F1
  EXPECT_EQ(force("Main.bits", "0"), RUNG_ACCESS_OK);
  EXPECT_EQ(applied("Main.bits"), "0");
  EXPECT_EQ(force("Main.bits.0", "TRUE"), RUNG_ACCESS_OK);  // the last again
  EXPECT_EQ(applied("Main.bits"), "1");
  EXPECT_EQ(forces.count, 2u);
  EXPECT_TRUE(unforce("Main.bits"));
  write("Main.bits", "16#FFFE");
  EXPECT_EQ(applied("Main.bits"), "65535");
  // A located variable and its address are one variable.
  EXPECT_EQ(force("%QX0.2", "TRUE"), RUNG_ACCESS_OK);
  EXPECT_EQ(applied("Main.valve"), "TRUE");
  EXPECT_TRUE(unforce("Main.valve"));
}

TEST_F(Monitor, TheTableHasTheSizeThatTheHostGaveIt) {
  EXPECT_EQ(force("Main.name", "'abc'"), RUNG_ACCESS_OK);  // 11 bytes of 16
  EXPECT_EQ(force("Main.count", "1"), RUNG_ACCESS_OK);
  EXPECT_EQ(force("Main.color", "Red"), RUNG_ACCESS_FULL);
  EXPECT_EQ(force("Main.run", "TRUE"), RUNG_ACCESS_OK);
  EXPECT_EQ(force("Main.point.x", "1"), RUNG_ACCESS_FULL);  // no row is left
  EXPECT_EQ(force("Main.name", "'x'"), RUNG_ACCESS_OK);     // in the place that it has
  EXPECT_TRUE(unforce("Main.name"));
  EXPECT_EQ(applied("Main.count"), "1");
  EXPECT_EQ(applied("Main.run"), "TRUE");
  EXPECT_EQ(force("Main.point.x", "-1"), RUNG_ACCESS_OK);
  EXPECT_EQ(applied("Main.point.x"), "-1");
}

TEST_F(Monitor, AHeldForceIsNotApplied) {
  force("Main.count", "5");
  rows[0].is_held = 1;
  EXPECT_EQ(applied("Main.count"), "0");
  rows[0].is_held = 0;
  EXPECT_EQ(applied("Main.count"), "5");
}

// ---- another version

struct Lost {
  std::string all;
  static void note(void* data, const char* path, rung_loss why, const char* old_type, const char* new_type) {
    static const char* const words[] = {"missing", "type", "not retained"};
    static_cast<Lost*>(data)->all += std::string(path) + ' ' + words[why] + ' ' + old_type + '>' + new_type + '\n';
  }
};

// The module with other names and types at some places.
struct Changed {
  std::vector<rung_field> fields;
  rung_module is = sample::module();
  explicit Changed(const char* renamed, const char* retyped) {
    const auto* const first = static_cast<const rung_field*>(is.fields.rows);
    fields.assign(first, first + is.fields.count);
    for (rung_field& field : fields) {
      if (strcmp(is.strings + field.name, renamed) == 0) field.name = 0;
      if (strcmp(is.strings + field.name, retyped) == 0) field.type = 3;  // REAL
    }
    is.fields.rows = fields.data();
    is.layout_hash = 99;
  }
};

TEST_F(Monitor, ValuesMoveToAnotherVersion) {
  const Changed changed("elapsed", "divisor");
  const rung::host::LoadedModule now_loaded(changed.is);
  rung::host::Memory now(now_loaded);
  now.reset();
  write("Main.count", "77");
  write("Main.name", "'kept'");
  write("Main.table[2,1]", "-9");
  write("Main.valve", "TRUE");
  char path[64];
  Lost lost;
  rung_migration migration{path, sizeof path, Lost::note, &lost, 0, 0};
  rung_migrate(&sample::module(), &memory.common(), &changed.is, &now.common(), &migration);
  EXPECT_EQ(lost.all, "Main.elapsed missing >\nMain.divisor type >\n");
  EXPECT_EQ(migration.lost_count, 2u);
  const auto& main = *reinterpret_cast<const sample::Main*>(now.block(0));
  EXPECT_EQ(main.count, 77);
  EXPECT_STREQ(main.name, "kept");
  EXPECT_EQ(main.table[1][1], -9);
  EXPECT_EQ(now.area(1)[0], 4);
  EXPECT_EQ(main.other, &main.point);  // in-outs are those of the new version
}

TEST_F(Monitor, RetainedDataHasADirectory) {
  char path[64], room[512] = {};
  rung_migration migration{path, sizeof path, nullptr, nullptr, 0, 0};
  const uint32_t size = rung_retain_directory(&sample::module(), room, sizeof room, &migration);
  EXPECT_EQ(std::string(room, size), "Main.kept\t7\t0\t4\t\nMain.kept_always\t7\t4\t4\t\n");
  EXPECT_EQ(rung_retain_directory(&sample::module(), nullptr, 0, &migration), size);

  std::vector<uint64_t> slot((rung_retain_bytes(&sample::module()) + size) / 8 + 1);
  auto& main = *reinterpret_cast<sample::Main*>(memory.block(0));
  main.kept = 6;
  main.kept_always = 60;
  memory.context().now_ns = 5;
  rung_retain_pack(&memory.context(), slot.data());
  memcpy(reinterpret_cast<char*>(slot.data()) + rung_retain_bytes(&sample::module()), room, size);
  reinterpret_cast<rung_slot*>(slot.data())->length += size;
  rung_retain_seal(slot.data(), 1);

  const Changed changed("kept_always", "");
  const rung::host::LoadedModule now_loaded(changed.is);
  rung::host::Memory now(now_loaded);
  for (const rung_start start : {RUNG_WARM, RUNG_COLD, RUNG_ORIGIN}) {
    now.reset();
    Lost lost;
    migration.lost = Lost::note;
    migration.data = &lost;
    EXPECT_FALSE(rung_retain_unpack(&now.context(), slot.data(), start));
    rung_retain_migrate(&now.context(), slot.data(), start, &migration);
    EXPECT_EQ(lost.all, start == RUNG_ORIGIN ? "" : "Main.kept_always missing >\n");
    EXPECT_EQ(reinterpret_cast<sample::Main*>(now.block(0))->kept, start == RUNG_WARM ? 6 : 5);
    EXPECT_EQ(now.context().now_ns, start == RUNG_WARM ? 5 : 0);
  }
}

}  // namespace

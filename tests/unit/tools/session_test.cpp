// SPDX-License-Identifier: Apache-2.0
// Sessions of real programs, interpreted and compiled: what goes on from a restored state is what went on the first
// time, between cycles and between two activations, with random inputs; new instances get their initial values.
#include "stdlib/runtime/host/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <random>
#include <sstream>
#include <tuple>

#include "stdlib/runtime/host/value_format.h"
#include "tests/unit/tools/loaded_project.h"

namespace rung::driver {
namespace {

using host::Ending;
using host::Session;
using host::SessionState;
using host::Variable;

// A session whose inputs and commands depend on the seed and the cycle alone.
class Machine {
 public:
  Machine(const rung_module& module, const std::vector<std::string>& inputs, uint32_t seed)
      : seed_(seed), session_(module, {}, {}) {
    std::string error;
    EXPECT_TRUE(session_.load(error)) << error;
    for (const std::string& path : inputs)
      EXPECT_TRUE(session_.symbols().find(path, inputs_.emplace_back(), error)) << error;
    for (const Variable& root : session_.symbols().programRoots()) session_.symbols().expand(root, leaves_);
    EXPECT_TRUE(session_.init().isComplete());
    EXPECT_TRUE(session_.begin().isComplete());
  }

  Session& session() { return session_; }

  // What a user does before a cycle.
  void drive(int64_t cycle) {
    std::mt19937 random(seed_ * 7919u + static_cast<uint32_t>(cycle));
    if (random() % 8 == 0) command(random());
    if (random() % 4 == 0) force(random());
    for (const Variable& input : inputs_) {
      if (random() % 3 != 0) continue;
      const uint32_t value = random() % 30;
      std::string text = std::to_string(value);
      if (input.type->kind == RUNG_BOOL) text = value % 2 != 0 ? "TRUE" : "FALSE";
      if (input.type->kind == RUNG_LREAL) text += ".5";
      EXPECT_EQ(host::assignValue(session_.module(), input, text), "") << input.path;
    }
  }

  // The rest of a cycle, and what programs have after it.
  std::string finishCycle(int64_t number) {
    const Ending ending = session_.cycle();
    EXPECT_TRUE(ending.isComplete()) << "cycle " << number << ": fault " << int{ending.fault.kind};
    std::string row = "cycle " + std::to_string(number) + ", " + std::to_string(session_.nowNs()) + " ns";
    for (const Variable& leaf : leaves_) {
      row += ' ' + leaf.path + '=';
      host::formatValue(session_.module(), leaf, row);
    }
    session_.completeCycle();
    session_.stopAfterSingleCycle();
    return row + '\n' + session_.tasks().statistics(0) + session_.forces().list();
  }

  std::string memory() {
    std::string bytes;
    const host::LoadedModule& module = session_.module();
    for (uint32_t i = 0; i < module.blocks.size(); ++i)
      bytes.append(reinterpret_cast<const char*>(session_.memory().block(i)), module.blocks[i].size);
    for (uint32_t i = 0; i < module.areas.size(); ++i)
      bytes.append(reinterpret_cast<const char*>(session_.memory().area(i)), module.areas[i].size);
    return bytes;
  }

 private:
  // Forces or unforces one of the leaves, or unforces all.
  void force(uint32_t random) {
    host::Command command;
    const Variable& leaf = leaves_[random % leaves_.size()];
    command.kind = random / 65536 % 3 == 0 ? host::Command::Unforce : host::Command::Force;
    std::string text;
    host::formatValue(session_.module(), leaf, text);
    command.values.push_back({random / 65536 % 9 == 0 ? "*" : leaf.path, text});
    EXPECT_EQ(session_.obey(command).error, "");
  }

  void command(uint32_t random) {
    host::Command command;
    const bool is_stopped = session_.isStopped();
    command.kind = !is_stopped ? host::Command::Stop : random % 3 == 0 ? host::Command::Cycle : host::Command::Start;
    if (is_stopped && random % 7 == 0) command.kind = host::Command::Reset;
    command.start = static_cast<rung_start>(random / 7 % 3);
    EXPECT_TRUE(session_.obey(command).goes_on);
  }

  const uint32_t seed_;
  Session session_;
  std::vector<Variable> inputs_, leaves_;
};

// ---- save and restore

struct Project {
  const char* folder;
  std::vector<std::string> inputs;
};
const Project kProjects[] = {
    {"tests/unit/tools/sessions/timers", {"Main.button", "Main.other", "Main.level"}},
    {"tests/unit/tools/sessions/tasks", {"f.go"}},
    {"tests/unit/tools/sessions/steps", {"Main.start", "Main.done"}},
    {"tests/unit/tools/sessions/devices", {"di.X8", "ad.V0", "ptc.T0"}},
    {"tests/unit/tools/sessions/interrupts", {}},
    {"samples/conveyor", {"Main.belt.start", "Main.belt.stop", "Main.belt.reset", "Main.belt.part"}},
    {"samples/traffic_light", {"Crossing.button"}},
    {"samples/packaging_line", {"Main.run"}},
    {"samples/milling_machine", {"Machine.DoorOpen", "Machine.StopPressed", "Machine.AirMissing"}},
};

// The first words of two rows that are not equal.
std::string firstDifference(const std::string& is, const std::string& was) {
  std::istringstream left(is), right(was);
  for (std::string a, b;;) {
    const bool has_left = static_cast<bool>(left >> a), has_right = static_cast<bool>(right >> b);
    if (!has_left && !has_right) return "";
    if (has_left != has_right || a != b) return a + " instead of " + b;
  }
}

struct Restored : testing::TestWithParam<std::tuple<size_t, Engine>> {};

// A moment of a run: before a cycle, or between two activations of it.
struct Moment {
  int64_t cycle;
  bool is_inside;
  SessionState state;
  std::string memory;
};

TEST_P(Restored, ARunGoesOnAsItDidTheFirstTime) {
  constexpr int64_t kCycles = 80;
  const auto& [number, engine] = GetParam();
  const Project& project = kProjects[number];
  const Loaded loaded(project.folder, engine);
  ASSERT_NE(loaded.module, nullptr);
  const uint32_t first = setting("RUNG_TEST_SEED", 1), runs = setting("RUNG_TEST_RUNS", 6);
  for (uint32_t seed = first; seed < first + runs; ++seed) {
    SCOPED_TRACE("RUNG_TEST_SEED=" + std::to_string(seed));
    Machine machine(*loaded.module, project.inputs, seed);
    std::mt19937 random(seed);
    std::vector<std::string> rows, memories;
    std::vector<Moment> moments;
    const auto remember = [&](bool is_inside) {
      if (random() % 16 == 0)
        moments.push_back({static_cast<int64_t>(rows.size()), is_inside, machine.session().save(), machine.memory()});
    };
    for (int64_t cycle = 0; cycle < kCycles; ++cycle) {
      remember(false);
      machine.drive(cycle);
      Ending ending;
      while (machine.session().activate(ending)) remember(true);
      rows.push_back(machine.finishCycle(cycle));
      memories.push_back(machine.memory());
    }
    std::shuffle(moments.begin(), moments.end(), random);
    for (const Moment& moment : moments) {
      machine.session().restore(moment.state);
      EXPECT_TRUE(machine.memory() == moment.memory);
      for (int64_t cycle = moment.cycle; cycle < kCycles; ++cycle) {
        if (cycle > moment.cycle || !moment.is_inside) machine.drive(cycle);
        ASSERT_EQ(firstDifference(machine.finishCycle(cycle), rows[static_cast<size_t>(cycle)]), "")
            << "cycle " << cycle << " after a state of cycle " << moment.cycle;
        ASSERT_TRUE(machine.memory() == memories[static_cast<size_t>(cycle)]) << "memory after cycle " << cycle;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Restored,
                         testing::Combine(testing::Range(size_t{0}, std::size(kProjects)),
                                          testing::Values(Engine::Interpreter, Engine::Native)),
                         [](const auto& test) {
                           const std::string folder = kProjects[std::get<0>(test.param)].folder;
                           const bool is_native = std::get<1>(test.param) == Engine::Native;
                           return folder.substr(folder.rfind('/') + 1) + (is_native ? "_native" : "_interpreted");
                         });

// ---- one engine at a time

struct Engines : testing::TestWithParam<Engine> {};

// The cycles of a test from one of them to its end, and what it asserted in them.
struct Testing {
  explicit Testing(const rung_module& module) : session(module, isolated(), hooks()) {}

  std::string run(uint32_t number) {
    session.chooseTest(number);
    EXPECT_TRUE(session.init().isComplete());
    EXPECT_TRUE(session.begin().isComplete());
    states.assign(1, session.save());
    const std::string all = goOn();
    for (size_t i = 0; i < states.size(); ++i) {
      const size_t before = rows_before[i];
      session.restore(states[i]);
      is_first = false;
      EXPECT_EQ(goOn(), all.substr(before)) << "from state " << i;
    }
    is_first = true;
    EXPECT_TRUE(session.endTest().isComplete());
    EXPECT_TRUE(session.end().isComplete());
    return all;
  }

  Session session;
  std::vector<SessionState> states;
  std::vector<size_t> rows_before{0};
  bool is_first = true;

 private:
  static host::SessionOptions isolated() {
    host::SessionOptions options;
    options.is_isolated = true;
    return options;
  }
  host::SessionHooks hooks() {
    host::SessionHooks hooks;
    hooks.assertion = [this](const rung_assertion& is, bool passed, const char*, const char*) {
      rows += std::to_string(is.line) + (passed ? " passed\n" : " failed\n");
    };
    return hooks;
  }

  std::string goOn() {
    rows.clear();
    do {
      rows += std::to_string(session.nowNs()) + '\n';
      EXPECT_TRUE(session.cycle().isComplete());
      session.completeCycle();
      if (!is_first || session.isDone() || states.size() > 60) continue;
      states.push_back(session.save());
      rows_before.resize(states.size());
      rows_before.back() = rows.size();
    } while (!session.isDone() && session.cyclesDone() < 2000);
    return rows;
  }

  std::string rows;
};

TEST_P(Engines, ATestIsRestoredAsAProgramIs) {
  const Loaded loaded("tests/unit/tools/sessions/testing", GetParam(), true);
  ASSERT_NE(loaded.module, nullptr);
  Testing testing(*loaded.module);
  const std::string rows = testing.run(0);
  // The lamp is on from the fourth cycle, 30 ms, and the twentieth, 190 ms, moves the time by 900 ms.
  EXPECT_EQ(testing.session.nowNs(), 1'100'000'000);
  EXPECT_EQ(rows.find("failed"), std::string::npos);
  EXPECT_EQ(testing.session.cyclesDone(), 21);
}

// Masters, slaves and lines of a test have bytes on their way at any moment.
TEST_P(Engines, TheSimulatedNetworkIsRestored) {
  for (const char* const file : {"tcp_master", "rtu_master", "slaves", "line_times"}) {
    SCOPED_TRACE(file);
    const Loaded loaded("tests/conformance/manuals/ax_modbus/" + std::string(file) + ".st", GetParam(), true);
    ASSERT_NE(loaded.module, nullptr);
    ASSERT_GT(loaded.module->tests.count, 0u);
    for (uint32_t i = 0; i < loaded.module->tests.count; ++i) {
      SCOPED_TRACE(loaded.module->strings + rung_test_at(loaded.module, i)->name);
      EXPECT_EQ(Testing(*loaded.module).run(i).find("failed"), std::string::npos);
    }
  }
}

// Between two activations the session's own context is that of the memory that all tasks share, not a task's copy.
TEST_P(Engines, NoCopyStaysAfterAnActivation) {
  const Loaded loaded("tests/unit/tools/sessions/tasks", GetParam());
  ASSERT_NE(loaded.module, nullptr);
  ASSERT_GT(loaded.module->tasks.count, 1u);
  Machine machine(*loaded.module, {}, 1);
  Session& session = machine.session();
  for (int64_t cycle = 0; cycle < 5; ++cycle) {
    machine.finishCycle(cycle);
    for (uint32_t i = 0; i < loaded.module->areas.count; ++i)
      EXPECT_EQ(session.context().areas[i], session.memory().area(i)) << "cycle " << cycle;
    for (uint32_t i = 0; i < loaded.module->blocks.count; ++i)
      EXPECT_EQ(session.context().blocks[i], session.memory().block(i)) << "cycle " << cycle;
  }
}

// With the table of names and without it: each variable of a program, and wrong paths made from its path.
TEST_P(Engines, NamesAreFoundAlike) {
  const Loaded loaded("samples/packaging_line", GetParam());
  ASSERT_NE(loaded.module, nullptr);
  ASSERT_NE(rung_find_extension(&loaded.module->extensions, RUNG_NAMES), nullptr);
  rung_module plain = *loaded.module;
  plain.extensions = {};
  Session session(*loaded.module, {}, {});
  std::vector<Variable> leaves;
  for (const Variable& root : session.symbols().roots()) session.symbols().expand(root, leaves);
  ASSERT_GT(leaves.size(), 100u);
  const auto find = [](const rung_module& module, const std::string& path) {
    rung_variable variable{};
    if (!rung_find(&module, path.c_str(), &variable)) return std::string("none");
    return std::to_string(variable.storage) + ' ' + std::to_string(variable.index) + ' ' +
           std::to_string(variable.offsets[variable.pointers]) + ' ' + std::to_string(variable.bit);
  };
  for (const Variable& leaf : leaves) {
    EXPECT_EQ(find(*loaded.module, leaf.path), std::to_string(leaf.storage) + ' ' + std::to_string(leaf.index) + ' ' +
                                                   std::to_string(leaf.offsets[0]) + ' ' + std::to_string(leaf.bit))
        << leaf.path;
    for (size_t size = 1; size <= leaf.path.size(); ++size) {
      const std::string part = leaf.path.substr(0, size), end = leaf.path.substr(size);
      EXPECT_EQ(find(*loaded.module, part), find(plain, part)) << part;
      EXPECT_EQ(find(*loaded.module, end), find(plain, end)) << end;
    }
  }
}

TEST_P(Engines, ANewInstanceIsThatOfADeclaration) {
  const Loaded loaded("tests/unit/tools/sessions/instances", GetParam());
  ASSERT_NE(loaded.module, nullptr);
  Session session(*loaded.module, {}, {});
  ASSERT_TRUE(session.init().isComplete());
  uint32_t checked = 0;
  for (const char* const path :
       {"Main.base", "Main.cell", "Main.holder", "Main.empty", "Main.limits", "Main.t", "Main.prepared"}) {
    Variable declared;
    std::string error;
    ASSERT_TRUE(session.symbols().find(path, declared, error)) << error;
    const auto type = static_cast<uint32_t>(declared.type - rung_type_at(loaded.module, 0));
    std::vector<uint64_t> made(declared.type->size / 8 + 1, 0xa5a5a5a5a5a5a5a5u);
    EXPECT_EQ(rung_init_instance(&session.context(), type, made.data()), RUNG_FAULT_NONE);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(made.data()), declared.type->size),
              std::string(reinterpret_cast<const char*>(declared.address()), declared.type->size))
        << path;
    ++checked;
  }
  EXPECT_EQ(checked, 7u);
}

// 3 * 2, and 6 of cells[2]; a declaration gives arguments that a new instance does not have.
TEST_P(Engines, ANewInstanceRunsFbInit) {
  const Loaded loaded("tests/unit/tools/sessions/instances", GetParam());
  ASSERT_NE(loaded.module, nullptr);
  Session session(*loaded.module, {}, {});
  ASSERT_TRUE(session.init().isComplete());
  const auto made = [&](const std::string& path, const std::string& member) {
    Variable whole, part;
    std::string text;
    EXPECT_TRUE(session.symbols().find(path, whole, text)) << text;
    EXPECT_TRUE(session.symbols().find(path + member, part, text)) << text;
    EXPECT_EQ(rung_init_instance(&session.context(), static_cast<uint32_t>(whole.type - rung_type_at(loaded.module, 0)),
                                 whole.address()),
              RUNG_FAULT_NONE);
    host::formatValue(session.module(), part, text);
    return text;
  };
  EXPECT_EQ(made("Main.prepared", ".n"), "12");
  EXPECT_EQ(made("Main.prepared", ".order"), "'base own after'");
  EXPECT_EQ(made("Main.sized", ".size"), "1");
}

INSTANTIATE_TEST_SUITE_P(, Engines, testing::Values(Engine::Interpreter, Engine::Native), [](const auto& test) {
  return std::string(test.param == Engine::Native ? "native" : "interpreted");
});

}  // namespace
}  // namespace rung::driver

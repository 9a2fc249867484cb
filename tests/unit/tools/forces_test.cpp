// SPDX-License-Identifier: Apache-2.0
// Forcing against a model: random programs with three tasks, aliases in areas, bits and an in-out; random sequences of
// force, unforce, write, stop and cycles. The model is bytes, a list of forces and the statements of the program; after
// each step it and the session must have the same values and the same forces. RUNG_FORCES_COUNT sequences, from the
// seed RUNG_FORCES_SEED (tools/long.sh forces).
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "stdlib/runtime/host/session.h"
#include "tests/unit/tools/loaded_project.h"
#include "tests/unit/tools/temporary_folder.h"

namespace rung::driver {
namespace {

using host::Command;
using host::Session;

constexpr uint32_t kSequencesOfAProgram = 10, kSteps = 40;
constexpr int64_t kSlowRows = 2;  // the period of the slow task

enum class Kind : uint8_t { Bool, Byte, Word, Int };

// Bytes of the model: areas M and Q, then variables of blocks.
constexpr uint32_t kOutputs = 4, kVariables = 6, kOutputBytes = 2;
constexpr uint8_t kNoBit = 255;

struct Place {
  const char* path;
  Kind kind;
  uint32_t at;  // in Model::bytes
  uint8_t bit = kNoBit;
  const char* name = nullptr;  // in the program; null: it has none there
  bool by_pointer = false;     // the in-out of Fast: it has a target once Fast has run

  bool isSameAs(const Place& other) const {
    return kind == other.kind && at == other.at && bit == other.bit && by_pointer == other.by_pointer;
  }
};

// The in-out is an alias of g2, which is another place for the table of forces: it is reached through a pointer.
constexpr uint32_t kG = kVariables, kPair = kG + 8, kRow = kPair + 4, kOwn = kRow + 6, kCount = kOwn + 4,
                   kBytes = kCount + 2;
const Place kPlaces[] = {{"m0", Kind::Byte, 0, kNoBit, "m0"},
                         {"%MB0", Kind::Byte, 0},
                         {"m3", Kind::Byte, 3, kNoBit, "m3"},
                         {"w0", Kind::Word, 0, kNoBit, "w0"},
                         {"%MW0", Kind::Word, 0},
                         {"i1", Kind::Int, 2, kNoBit, "i1"},
                         {"%MW1", Kind::Word, 2},
                         {"bit3", Kind::Bool, 0, 3, "bit3"},
                         {"%MX0.3", Kind::Bool, 0, 3},
                         {"%MX1.6", Kind::Bool, 1, 6},
                         {"go", Kind::Bool, 1, 1, "go"},
                         {"q0", Kind::Byte, kOutputs, kNoBit, "q0"},
                         {"lamp", Kind::Bool, kOutputs + 1, 2, "lamp"},
                         {"%QX0.5", Kind::Bool, kOutputs, 5},
                         {"g0", Kind::Int, kG, kNoBit, "g0"},
                         {"G1", Kind::Int, kG + 2, kNoBit, "g1"},
                         {"c.r.g2", Kind::Int, kG + 4, kNoBit, "g2"},
                         {"g3", Kind::Int, kG + 6, kNoBit, "g3"},
                         {"g0.4", Kind::Bool, kG, 4, "g0.4"},
                         {"g1.%X11", Kind::Bool, kG + 3, 3, "g1.11"},
                         {"g2.0", Kind::Bool, kG + 4, 0, "g2.0"},
                         {"duo.a", Kind::Int, kPair, kNoBit, "duo.a"},
                         {"duo.b", Kind::Int, kPair + 2, kNoBit, "duo.b"},
                         {"row[0]", Kind::Int, kRow, kNoBit, "row[0]"},
                         {"row[2]", Kind::Int, kRow + 4, kNoBit, "row[2]"},
                         {"Fast.own", Kind::Int, kOwn},
                         {"r.Slow.own", Kind::Int, kOwn + 2},
                         {"Fast.add.n", Kind::Int, kCount},
                         {"Fast.add.sum", Kind::Int, kG + 4, kNoBit, nullptr, true}};

struct Model {
  std::array<uint8_t, kBytes> bytes{};
  std::array<uint8_t, kOutputBytes> kept{};  // outputs, while the program is stopped
  struct Force {
    Place place;
    uint32_t value;
  };
  std::vector<Force> forces;
  bool has_target = false, is_stopped = false, go_was = false;
  int64_t slow_row = 0;  // at which Slow runs next

  uint32_t read(const Place& place) const {
    if (place.bit != kNoBit) return bytes[place.at] >> place.bit & 1;
    return bytes[place.at] + (place.kind == Kind::Byte ? 0u : bytes[place.at + 1] * 256u);
  }
  void write(const Place& place, uint32_t value) {
    if (place.bit != kNoBit) {
      const auto mask = static_cast<uint8_t>(1u << place.bit);
      bytes[place.at] = static_cast<uint8_t>(value != 0 ? bytes[place.at] | mask : bytes[place.at] & ~mask);
      return;
    }
    bytes[place.at] = static_cast<uint8_t>(value);
    if (place.kind != Kind::Byte) bytes[place.at + 1] = static_cast<uint8_t>(value >> 8);
  }
  bool exists(const Place& place) const { return !place.by_pointer || has_target; }
  void apply() {
    for (const Force& force : forces)
      if (exists(force.place)) write(force.place, force.value);
  }
  void unforce(const Place& place) {
    std::erase_if(forces, [&](const Force& force) { return force.place.isSameAs(place); });
  }
};

std::string textOf(Kind kind, uint32_t value) {
  if (kind == Kind::Bool) return value != 0 ? "TRUE" : "FALSE";
  return std::to_string(kind == Kind::Int ? static_cast<int16_t>(value) : static_cast<int32_t>(value));
}

// The path as it is declared, without the prefixes that it may have.
std::string declared(const Place& place) {
  std::string path = place.path;
  for (const char* const prefix : {"c.", "r."})
    if (path.compare(0, 2, prefix) == 0) path.erase(0, 2);
  return path == "G1" ? "g1" : path;
}

// A program, and what its tasks do with the model.
class RandomProgram {
 public:
  explicit RandomProgram(uint32_t seed) : random_(seed) {
    for (uint32_t task = 0; task < 3; ++task)
      for (uint32_t n = random_() % 5 + 1; n > 0; --n) bodies_[task] += statement(task);
  }

  std::string text() const {
    return R"(TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
VAR_GLOBAL m0 AT %MB0 : BYTE; m3 AT %MB3 : BYTE; w0 AT %MW0 : WORD; i1 AT %MW1 : INT; bit3 AT %MX0.3 : BOOL;
  go AT %MX1.1 : BOOL; q0 AT %QB0 : BYTE; lamp AT %QX1.2 : BOOL; duo : Pair; row : ARRAY[0..2] OF INT; END_VAR
FUNCTION_BLOCK Adder VAR_IN_OUT sum : INT; END_VAR VAR n : INT; END_VAR
n := n + 1; sum := sum + n;
END_FUNCTION_BLOCK
PROGRAM Fast
VAR add : Adder; own : INT; END_VAR
add(sum := g2); own := g0;
)" + bodies_[0] +
           "END_PROGRAM\nPROGRAM Slow\nVAR own : INT; END_VAR\nown := own + g1;\n" + bodies_[1] +
           "END_PROGRAM\nPROGRAM OnGo\ng3 := g3 + 1;\n" + bodies_[2] + R"(END_PROGRAM
CONFIGURATION c
RESOURCE r ON PLC
VAR_GLOBAL g2 : INT; END_VAR
TASK fast(INTERVAL := T#10ms, PRIORITY := 2); TASK slow(INTERVAL := T#20ms, PRIORITY := 1);
TASK event(SINGLE := go, PRIORITY := 3);
PROGRAM Fast WITH fast : Fast; PROGRAM Slow WITH slow : Slow; PROGRAM OnGo WITH event : OnGo;
END_RESOURCE
END_CONFIGURATION
VAR_GLOBAL g0, g1, g3 : INT; END_VAR
)";
  }

  void cycle(Model& model, int64_t row) const {
    if (model.is_stopped) return;
    model.apply();
    const bool go = model.read(placeAt("go")) != 0;
    const bool is_event = go && !model.go_was;
    model.go_was = go;
    if (model.slow_row <= row) {
      activate(model, 1);
      model.slow_row = row / kSlowRows * kSlowRows + kSlowRows;
    }
    activate(model, 0);
    if (is_event) activate(model, 2);
  }

  static const Place& placeAt(const std::string& path) {
    for (const Place& place : kPlaces)
      if (path == place.path) return place;
    return kPlaces[0];
  }

 private:
  using Action = std::function<void(Model&)>;

  const Place& named(Kind kind) {
    for (;;) {
      const Place& place = kPlaces[random_() % std::size(kPlaces)];
      if (place.name != nullptr && place.kind == kind) return place;
    }
  }

  std::string statement(uint32_t task) {
    const auto kind = static_cast<Kind>(random_() % 4);
    const Place &to = named(kind), &from = named(kind), &condition = named(Kind::Bool);
    const uint32_t number = random_() % 100;
    const bool is_conditional = random_() % 4 == 0;
    actions_[task].push_back([=](Model& model) {
      if (is_conditional && model.read(condition) == 0) return;
      const uint32_t value = model.read(from);
      model.write(to, kind == Kind::Bool ? value ^ 1 : kind == Kind::Int ? value + number : value ^ number);
    });
    std::string text = std::string(to.name) + " := ";
    if (kind == Kind::Bool) text += std::string("NOT ") + from.name;
    if (kind == Kind::Int) text += std::string(from.name) + " + " + std::to_string(number);
    if (kind == Kind::Byte || kind == Kind::Word) text += std::string(from.name) + " XOR " + std::to_string(number);
    if (is_conditional) text = std::string("IF ") + condition.name + " THEN " + text + "; END_IF";
    return text + ";\n";
  }

  // What the text of `text` has in front of the statements of a task.
  static void begin(Model& model, uint32_t task) {
    const auto add = [&](const char* to, uint32_t value) { model.write(placeAt(to), model.read(placeAt(to)) + value); };
    if (task == 0) {
      model.has_target = true;
      add("Fast.add.n", 1);
      add("c.r.g2", model.read(placeAt("Fast.add.n")));
      model.write(placeAt("Fast.own"), model.read(placeAt("g0")));
    } else if (task == 1) {
      add("r.Slow.own", model.read(placeAt("G1")));
    } else {
      add("g3", 1);
    }
  }

  void activate(Model& model, uint32_t task) const {
    model.apply();
    begin(model, task);
    for (const Action& action : actions_[task]) action(model);
    model.apply();
  }

  std::mt19937 random_;
  std::string bodies_[3];
  std::vector<Action> actions_[3];
};

// One sequence: the same steps in the session and in the model.
class Sequence {
 public:
  Sequence(const rung_module& module, const RandomProgram& program, uint32_t seed)
      : program_(program), session_(module, {}, {}), random_(seed) {
    std::string error;
    EXPECT_TRUE(session_.load(error)) << error;
    EXPECT_TRUE(session_.init().isComplete());
    EXPECT_TRUE(session_.begin().isComplete());
  }

  // Empty, or where they differ.
  std::string run() {
    for (uint32_t step = 0; step < kSteps; ++step) {
      log_ += take() + '\n';
      if (const std::string difference = compare(); !difference.empty()) return log_ + difference;
    }
    return "";
  }

 private:
  std::string obey(Command::Kind kind, const std::string& path = "", const std::string& value = "") {
    Command command;
    command.kind = kind;
    if (!path.empty()) command.values.push_back({path, value});
    const host::Answer answer = session_.obey(command);
    refusal_ = answer.error;
    return answer.values;
  }

  std::string take() {
    const Place& place = kPlaces[random_() % std::size(kPlaces)];
    uint32_t value = random_() & (place.kind == Kind::Bool ? 1u : place.kind == Kind::Byte ? 0xffu : 0xffffu);
    const std::string text = textOf(place.kind, value);
    switch (random_() % 12) {
      case 0:
      case 1:
      case 2:
        obey(Command::Force, place.path, text);
        model_.unforce(place);
        model_.forces.push_back({place, value});
        if (!model_.is_stopped) model_.apply();
        return std::string("force ") + place.path + '=' + text;
      case 3:
      case 4:
        obey(Command::Unforce, place.path);
        model_.unforce(place);
        return std::string("unforce ") + place.path;
      case 5:
      case 6:
        obey(Command::Set, place.path, text);
        EXPECT_EQ(refusal_.empty(), model_.exists(place)) << refusal_;
        if (model_.exists(place)) model_.write(place, value);
        return std::string("set ") + place.path + '=' + text;
      case 7: return takeRarely();
      default:
        EXPECT_TRUE(session_.cycle().isComplete());
        session_.completeCycle();
        program_.cycle(model_, row_++);
        return "cycle";
    }
  }

  std::string takeRarely() {
    if (random_() % 4 == 0) {
      obey(Command::Unforce, "*");
      model_.forces.clear();
      return "unforce *";
    }
    const auto outputs = model_.bytes.begin() + kOutputs;
    if (model_.is_stopped) {
      std::copy(model_.kept.begin(), model_.kept.end(), outputs);
    } else {
      std::copy_n(outputs, kOutputBytes, model_.kept.begin());
      std::fill_n(outputs, kOutputBytes, uint8_t{0});
    }
    model_.is_stopped = !model_.is_stopped;
    obey(model_.is_stopped ? Command::Stop : Command::Start);
    return model_.is_stopped ? "stop" : "start";
  }

  std::string compare() {
    std::string expected, seen, forces;
    for (const Place& place : kPlaces) {
      expected += std::string(place.path) + " = ";
      if (model_.exists(place)) expected += textOf(place.kind, model_.read(place));
      expected += '\n';
      seen += obey(Command::Get, place.path);
    }
    for (const Model::Force& force : model_.forces)
      forces += declared(force.place) + " = " + textOf(force.place.kind, force.value) + '\n';
    expected += forces;
    seen += obey(Command::Forces);
    return expected == seen ? "" : "expected\n" + expected + "seen\n" + seen;
  }

  const RandomProgram& program_;
  Session session_;
  std::mt19937 random_;
  Model model_;
  int64_t row_ = 0;
  std::string log_, refusal_;
};

void runSequences(Engine engine, uint32_t first, uint32_t count) {
  const TemporaryFolder folder;
  for (uint32_t seed = first; count > 0; ++seed) {
    const RandomProgram program(seed);
    const Loaded loaded(folder.write(std::to_string(seed) + ".st", program.text()), engine);
    ASSERT_NE(loaded.module, nullptr) << program.text();
    for (uint32_t i = 0; i < kSequencesOfAProgram && count > 0; ++i, --count) {
      const std::string difference = Sequence(*loaded.module, program, seed * kSequencesOfAProgram + i).run();
      ASSERT_EQ(difference, "") << "seed " << seed << ", sequence " << i << '\n' << program.text();
    }
  }
}

TEST(Forces, AreThoseOfAModel) {
  const uint32_t count = setting("RUNG_FORCES_COUNT", 200);
  runSequences(Engine::Interpreter, setting("RUNG_FORCES_SEED", 1), count - count / 50);
  runSequences(Engine::Native, setting("RUNG_FORCES_SEED", 1), count / 50);
}

}  // namespace
}  // namespace rung::driver

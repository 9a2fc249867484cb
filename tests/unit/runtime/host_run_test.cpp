// SPDX-License-Identifier: Apache-2.0
// `rung run` on the sample module: order of tasks, inputs, traces, faults, usage errors.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "rung/host.h"
#include "sample_module.h"

using namespace rung::host;

namespace {

std::string temporary(const std::string& name) { return testing::TempDir() + "rung_host_" + name; }
void write(const std::string& path, const std::string& content) { std::ofstream(path) << content; }
std::string read(const std::string& path) {
  std::ostringstream all;
  all << std::ifstream(path).rdbuf();
  return all.str();
}

struct Outcome {
  int code;
  std::string out, err;
};
Outcome go(const RunOptions& options) {
  sample::ran.clear();
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = run(sample::module(), options);
  fflush(stdout);
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

TEST(Run, TasksRunInOrderOfTimePriorityAndDeclaration) {
  RunOptions options;
  options.cycles = 4;
  options.sets = {{"Main.start_event", "TRUE"}};
  EXPECT_EQ(go(options).code, 0);
  EXPECT_EQ(sample::ran, "esfffsf");  // edge first (priority 0); Slow is declared before Fast and runs each third row
}

TEST(Run, TracesARowAfterEachCycle) {
  RunOptions options;
  options.for_ns = 25'000'000;  // ceil: 3 cycles
  options.watch = "Main.count, main.table[2,2],Main.elapsed,Main.name,Main.valve";
  options.trace_path = "-";
  const Outcome outcome = go(options);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out,
            "cycle,time_ms,Main.count,\"main.table[2,2]\",Main.elapsed,Main.name,Main.valve\n"
            "0,0,10,7,T#0ms,'a$'b',TRUE\n"
            "1,10,20,7,T#10ms,'a$'b',TRUE\n"
            "2,20,30,7,T#20ms,'a$'b',TRUE\n");
  EXPECT_EQ(outcome.err, "");
}

TEST(Run, PrintsTheLastRowWithoutTrace) {
  RunOptions options;
  options.cycles = 150;
  options.watch = "Main.count,Main.point";
  EXPECT_EQ(go(options).out,
            "Main.count = 1500\nMain.point.x = 0\nMain.point.y = 0\n150 cycles of 10 ms, 1 s 500 ms of program time\n");
}

TEST(Run, InputsSetVariablesBeforeTheirCycle) {
  const std::string inputs = temporary("inputs.csv"), trace = temporary("trace.csv");
  write(inputs, "cycle,Main.divisor,Main.table[2,1],Main.name,%IX0.0\n1,2,5,\"'x,y'\",\n3,,6,,TRUE\n");
  RunOptions options;
  options.inputs_path = inputs;  // as many cycles as the inputs need
  options.watch = "Main.count,Main.table[2,1],Main.name,%QB0";
  options.trace_path = trace;
  const Outcome outcome = go(options);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(read(trace),
            "cycle,time_ms,Main.count,\"Main.table[2,1]\",Main.name,%QB0\n"
            "0,0,10,0,'a$'b',4\n1,10,15,5,\"'x,y'\",4\n2,20,20,5,\"'x,y'\",4\n3,30,25,6,\"'x,y'\",5\n");
  // A trace may serve as input: time_ms is ignored.
  write(inputs, "cycle,time_ms,Main.count\n0,0,100\n");
  options.trace_path.clear();
  options.watch = "Main.count";
  EXPECT_EQ(go(options).out, "Main.count = 110\n1 cycles of 10 ms, 10 ms of program time\n");
}

TEST(Run, BadInputsNameTheirLocation) {
  const std::string inputs = temporary("bad.csv");
  RunOptions options;
  options.inputs_path = inputs;
  const auto error = [&](const std::string& content) {
    write(inputs, content);
    const Outcome outcome = go(options);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(sample::ran, "");
    const std::string head = "error: " + inputs + ":";
    EXPECT_EQ(outcome.err.compare(0, head.size(), head), 0) << outcome.err;
    return outcome.err.substr(head.size());
  };
  EXPECT_EQ(error(""), "1:1: expected the header `cycle,<path>,...`\n");
  EXPECT_EQ(error("time,a\n"), "1:1: the first column must be `cycle`, not `time`\n");
  EXPECT_EQ(error("cycle,Main.cuont\n"), "1:7: `Main` has no variable `cuont`; did you mean `count`?\n");
  EXPECT_EQ(error("cycle,Main.count\n0,5\n\nx,5\n"), "4:1: `x` is not a cycle number; write 0, 1, 2, ...\n");
  EXPECT_EQ(error("cycle,Main.count\n0,5.5\n"), "2:3: `5.5` is not a value of type DINT\n");
  EXPECT_EQ(error("cycle,Main.count\n0,5,6\n"), "2:5: the row has 3 cells, but the header has 2\n");
  options.inputs_path = temporary("missing.csv");
  EXPECT_EQ(go(options).code, 2);
}

TEST(Run, AFaultEndsTheRun) {
  const std::string trace = temporary("fault.csv");
  RunOptions options;
  options.cycles = 5;
  options.watch = "Main.count";
  options.trace_path = trace;
  options.sets = {{"main.divisor", "0"}};
  const Outcome outcome = go(options);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err, "main.st:12: fault[div]: division by zero in `Main`\n");
  EXPECT_EQ(read(trace), "cycle,time_ms,Main.count\n");
}

TEST(Run, UsageErrorsWriteNothing) {
  const std::string trace = temporary("never.csv");
  remove(trace.c_str());
  RunOptions options;
  options.trace_path = trace;
  options.watch = "Main.x";
  EXPECT_EQ(go(options).err, "error: --watch: `Main` has no variable `x`\n");
  options.watch.clear();
  options.sets = {{"Main.color", "Purple"}};
  EXPECT_EQ(go(options).code, 2);
  EXPECT_FALSE(std::ifstream(trace).good());
}

TEST(Run, RealTimeKeepsTheClock) {
  RunOptions options;
  options.cycles = 5;
  options.realtime = true;
  options.watch = "Main.count";
  const Outcome outcome = go(options);
  EXPECT_EQ(outcome.code, 0);
  // A start that comes too late is dropped and counted. Main counts in tens.
  int count = 0, activations = 0, overruns = 0;
  ASSERT_EQ(sscanf(outcome.out.c_str(), "Main.count = %d", &count), 1) << outcome.out;
  const size_t fast = outcome.out.find("task Fast: ");
  ASSERT_NE(fast, std::string::npos) << outcome.out;
  ASSERT_EQ(sscanf(outcome.out.c_str() + fast, "task Fast: %d activations, %d overruns", &activations, &overruns), 2);
  EXPECT_EQ(count, 10 * activations);
  EXPECT_EQ(activations + overruns, 5) << outcome.out;
  EXPECT_NE(outcome.out.find("5 cycles of 10 ms, 50 ms of program time\n"), std::string::npos);
}

TEST(Options, ParseBothForms) {
  RunOptions options;
  std::vector<std::string> rest;
  EXPECT_EQ(parseRunOptions({"p.st", "--cycles=7", "--for", "T#1.5s", "--interval", "5ms", "--set", "a.b=x=y",
                             "--watch=a", "--watch", "b", "--start", "Warm", "--realtime", "-O2"},
                            options, rest),
            "");
  EXPECT_EQ(options.cycles, 7);
  EXPECT_EQ(options.for_ns, 1'500'000'000);
  EXPECT_EQ(options.interval_ns, 5'000'000);
  EXPECT_EQ(options.sets[0], (std::pair<std::string, std::string>("a.b", "x=y")));
  EXPECT_EQ(options.watch, "a,b");
  EXPECT_EQ(options.start, RUNG_WARM);
  EXPECT_TRUE(options.realtime);
  EXPECT_EQ(rest, (std::vector<std::string>{"p.st", "-O2"}));
  EXPECT_EQ(parseRunOptions({"--cycles", "x"}, options, rest), "--cycles needs a number, not `x`");
  EXPECT_EQ(parseRunOptions({"--trace"}, options, rest), "--trace needs a value");
  EXPECT_EQ(parseRunOptions({"--for=2"}, options, rest), "--for needs a time such as T#2s, not `2`");
}

}  // namespace

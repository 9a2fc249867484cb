// SPDX-License-Identifier: Apache-2.0
// Writes a Structured Text project of about LINES lines for the benchmarks: stations of a line, each a scaling function
// and a block with history, filter, steps, timers and messages; areas that call twenty stations; one task per area.
//   generate LINES > project.st      equal LINES give equal bytes
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

std::string text(long n) { return std::to_string(n); }

const char kTypes[] = R"(TYPE
  StepKind : (Waiting, Filling, Mixing, Draining, Blocked);
  Reading : STRUCT
    raw : DINT;
    value : REAL;
    valid : BOOL;
    kind : StepKind;
  END_STRUCT;
  Window : ARRAY[1..12] OF REAL;
END_TYPE

)";

std::string scaling(long n) {
  const std::string id = text(n), gain = text(n % 9 + 2);
  return "FUNCTION Scale" + id + R"( : REAL
  VAR_INPUT
    raw : DINT;
    low, high : REAL;
  END_VAR
  VAR
    part : REAL;
  END_VAR
  IF high <= low THEN
    Scale)" +
         id + R"( := low;
    RETURN;
  END_IF;
  part := DINT_TO_REAL(raw MOD )" +
         gain + R"(00) / )" + gain + R"(00.0;
  IF part < 0.0 THEN
    part := -part;
  END_IF;
  Scale)" +
         id + R"( := LIMIT(low, low + part * (high - low), high);
END_FUNCTION

)";
}

// The second half of a station's body: its steps, and what it reports.
std::string stationSteps(const std::string& id, const std::string& a, const std::string& b) {
  return R"(  CASE step OF
    Waiting:
      valve := 0.0;
      IF started.Q AND reading.valid THEN
        step := Filling;
        sum := 0.0;
      END_IF;
    Filling:
      error := target - reading.value;
      sum := LIMIT(-50.0, sum + error * 0.0)" +
         a + R"(, 50.0);
      valve := LIMIT(0.0, error * )" +
         a + R"(.25 + sum, 100.0);
      IF ABS(error) < 1.0 THEN
        step := Mixing;
      ELSIF stop THEN
        step := Draining;
      END_IF;
    Mixing:
      valve := valve * 0.75;
      IF dwell.Q THEN
        step := Draining;
      END_IF;
    Draining:
      IF NOT pause.Q OR reading.value < 1.0 THEN
        step := Waiting;
      END_IF;
  ELSE
    step := Waiting;
  END_CASE;

  i := 0;
  REPEAT
    i := i + 1;
    mask := ROL(mask, 1) XOR 16#000)" +
         a + R"(;
  UNTIL i >= )" +
         b + R"( OR (mask AND 16#8000) <> 0
  END_REPEAT;
  WHILE i > 0 AND sum > )" +
         b + R"(.5 DO
    i := i - 1;
    sum := sum / 2.0;
  END_WHILE;

  busy := step <> Waiting;
  alarm := batches.Q OR (busy AND NOT reading.valid);
  IF alarm THEN
    message := CONCAT('station )" +
         id + R"( batch ', INT_TO_STRING(position));
  ELSE
    message := 'station )" +
         id + R"( good';
  END_IF;
END_FUNCTION_BLOCK

)";
}

std::string station(long n) {
  const std::string id = text(n), a = text(n % 4 + 1), b = text(n % 6 + 3);
  return "(* Station " + id + R"(: averages its level, steps through a batch, counts and reports. *)
FUNCTION_BLOCK Station)" +
         id + R"(
  VAR_INPUT
    start, stop : BOOL;
    level : DINT;
    target : REAL := )" +
         b + R"(0.0;
  END_VAR
  VAR_OUTPUT
    valve : REAL;
    busy, alarm : BOOL;
    message : STRING[40];
  END_VAR
  VAR
    step : StepKind;
    window : Window;
    reading : Reading;
    dwell : TON;
    pause : TOF;
    started : R_TRIG;
    batches : CTU;
    position, i : INT;
    mean, error, sum : REAL;
    mask : WORD := 16#00F)" +
         a + R"(;
  END_VAR

  // the window of the last values and its mean
  position := position MOD 12 + 1;
  window[position] := Scale)" +
         id + R"((raw := level, low := 0.0, high := )" + b + R"(00.0);
  mean := 0.0;
  FOR i := 1 TO 12 DO
    mean := mean + window[i];
  END_FOR;
  reading.raw := level;
  reading.value := mean / 12.0;
  reading.valid := reading.value > 0.5 AND reading.value < )" +
         b + R"(00.0;
  reading.kind := step;

  started(CLK := start AND NOT stop);
  dwell(IN := step = Mixing, PT := T#)" +
         a + R"(s);
  pause(IN := busy, PT := T#)" +
         b + R"(00ms);
  batches(CU := dwell.Q, RESET := stop, PV := )" +
         b + R"(0);

)" + stationSteps(id, a, b);
}

std::string area(long number, long first, long count) {
  std::string out = "PROGRAM Area" + text(number) + "\n  VAR\n";
  for (long n = first; n < first + count; ++n) out += "    s" + text(n) + " : Station" + text(n) + ";\n";
  out += "    ticks : DINT;\n    flow : REAL;\n    trouble : BOOL;\n  END_VAR\n\n  ticks := (ticks + 1) MOD 60000;\n";
  out += "  flow := 0.0;\n  trouble := FALSE;\n";
  for (long n = first; n < first + count; ++n) {
    const std::string s = "s" + text(n);
    out += "  " + s + "(start := ticks MOD " + text(n % 17 + 2) + " = 1, stop := ticks > 50000, level := ticks * " +
           text(n % 5 + 1) + ");\n";
    out += "  flow := flow + " + s + ".valve;\n  trouble := trouble OR " + s + ".alarm;\n";
  }
  return out + "END_PROGRAM\n\n";
}

std::string project(long stations) {
  std::string out = kTypes;
  for (long n = 0; n < stations; ++n) out += scaling(n) + station(n);
  long areas = 0;
  for (long n = 0; n < stations; n += 20) out += area(areas++, n, stations - n < 20 ? stations - n : 20);
  out += "CONFIGURATION Plant\n  RESOURCE Controller ON PLC\n";
  for (long n = 0; n < areas; ++n)
    out +=
        "    TASK Cycle" + text(n) + "(INTERVAL := T#" + text(n % 8 + 5) + "ms, PRIORITY := " + text(n % 16) + ");\n";
  for (long n = 0; n < areas; ++n)
    out += "    PROGRAM Run" + text(n) + " WITH Cycle" + text(n) + " : Area" + text(n) + ";\n";
  return out + "  END_RESOURCE\nEND_CONFIGURATION\n";
}

long lineCount(const std::string& s) {
  long lines = 0;
  for (char c : s) lines += c == '\n';
  return lines;
}

}  // namespace

int main(int argc, char** argv) {
  const long lines = argc == 2 ? std::atol(argv[1]) : 0;
  if (lines < 1) {
    std::fprintf(stderr, "usage: generate LINES > project.st\n");
    return 2;
  }
  const long per_hundred = lineCount(project(100));
  const long stations = (lines * 100 + per_hundred / 2) / per_hundred;
  const std::string out = project(stations < 1 ? 1 : stations);
  return std::fwrite(out.data(), 1, out.size(), stdout) == out.size() ? 0 : 2;
}

// SPDX-License-Identifier: Apache-2.0
// Lines that are not finished, as an editor sees them all day. Each line of each sample is cut after each token while
// the lines after it stay: the first error must be on the cut line, and at most one on the lines after it. Each token
// is deleted in turn: one error, on its line. A change that leaves a right program is not counted, except `n :=` above
// `k := 2;`, which is a chain in codesys and must draw a warning. Lines that begin with `|` stay as they are.
#include <gtest/gtest.h>

#include <algorithm>

#include "frontend/parse/lexer.h"
#include "tests/unit/parse/parse_helper.h"

namespace rung::text {
namespace {

struct Sample {
  const char* name;
  const char* text;
};

constexpr Sample kSamples[] = {
    {"statements", R"(|FUNCTION_BLOCK Ramp
|VAR_INPUT target : REAL; fast : BOOL; END_VAR
|VAR_OUTPUT value : REAL; done : BOOL; END_VAR
|END_FUNCTION_BLOCK
|PROGRAM Main
|VAR n, k, i : INT; x, y : REAL; ok : BOOL; t : TIME; a : ARRAY[0..9] OF INT; up : Ramp; timer : TON; END_VAR
  n := k + 2 * i;
  k := (n - 1) / 3;
  x := y ** 2.0;
  ok := n > 3 AND NOT (k = 2) XOR ok;
  a[n] := a[k + 1] - a[0];
  x := up.value;
  up.target := 12.5;
  up(target := x, fast := ok);
  up(fast := n < 3, done => ok);
  timer(IN := ok, PT := T#200ms);
  n := MAX(k, i);
  y := SQRT(ABS(x));
  up(
    target := x,
    fast := n < 3,
    done => ok);
  x := MAX(
    y,
    up.value
      + 1.0);
  t := T#1s200ms;
  n := a[LIMIT(0, k, 9)];
  IF n > 3 THEN
    n := 0;
  ELSIF k = 2 OR ok THEN
    k := n;
|  ELSE
    up(target := 1.0);
  END_IF;
  FOR i := 0 TO 9 BY 2 DO
    a[i] := n;
  END_FOR;
  WHILE n < 10 DO
    n := n + 1;
    IF ok THEN EXIT; END_IF;
  END_WHILE;
  REPEAT
    k := k + 1;
  UNTIL k > 10
  END_REPEAT;
  CASE n OF
    1: y := 1.0;
    2, 3: y := 2.0;
    4..9: y := x;
|  ELSE
    y := -1.0;
  END_CASE;
  k := 3;
|END_PROGRAM
)"},
    {"variables", R"(|TYPE Point : STRUCT x : REAL; y : REAL; END_STRUCT END_TYPE
|FUNCTION_BLOCK Motor
|VAR_INPUT
  enable : BOOL;
  speed : REAL := 0.5;
  rows : ARRAY[1..4] OF INT;
|END_VAR
|VAR_OUTPUT
  running, ready : BOOL := FALSE;
  name : STRING[20] := 'motor';
|END_VAR
|VAR_IN_OUT
  shared : INT;
|END_VAR
|VAR
  count : UDINT := 16#FF;
  grid : ARRAY[0..3, 1..2] OF REAL := [8(0.0)];
  origin : Point := (x := 1.0, y := 2.0);
  corner : Point := (
    x := 1.0,
    y := 2.0);
  timer : TON;
  pause : TIME := T#5s;
  state : Level := Level#mid;
  limits : ARRAY[0..2] OF INT := [1, 2, 3];
  total : LREAL;
  where : REF_TO INT;
|END_VAR
|VAR CONSTANT
  maximum : INT := 100;
  offset : INT := -5;
|END_VAR
|VAR_TEMP
  i : INT;
|END_VAR
  running := enable;
  i := 1;
|END_FUNCTION_BLOCK
|PROGRAM Main
|VAR
  m : Motor;
  lamp AT %QX0.0 : BOOL;
  input AT %IW2 : WORD;
  n : INT;
|END_VAR
  m(shared := n);
|END_PROGRAM
)"},
    {"types", R"(|TYPE
  Point : STRUCT
    x : REAL;
    y : REAL := 1.5;
    id : UDINT;
|  END_STRUCT;
  Color : (red, green, blue);
  Phase : (
    waiting,
    filling := 4,
    emptying);
  Mode : (idle := 0, run := 5);
  Row : ARRAY[1..10] OF Point;
  Percent : INT(0..100);
  Title : STRING[30];
  Matrix : ARRAY[0..2, 0..2] OF LREAL;
  Speed : REAL := 2.5;
|END_TYPE
FUNCTION Half : INT
|VAR_INPUT
  value : INT;
|END_VAR
  Half := value / 2;
|END_FUNCTION
FUNCTION Length : REAL
|VAR_INPUT
  p : Point;
|END_VAR
  Length := SQRT(p.x * p.x + p.y * p.y);
|END_FUNCTION
|PROGRAM Main
|VAR
  p : Point;
  r : Row;
  c : Color := Color#green;
  n : INT;
|END_VAR
  n := Half(value := 8);
  p.x := Length(p);
  r[n].id := 4;
  c := Color#blue;
|END_PROGRAM
)"},
    {"objects", R"(|INTERFACE IStart
METHOD Start : BOOL
|VAR_INPUT
  delay : TIME;
|END_VAR
|END_METHOD
|END_INTERFACE
FUNCTION_BLOCK Device IMPLEMENTS IStart
|VAR
  count : INT;
  pause : TIME;
|END_VAR
METHOD PUBLIC Start : BOOL
|VAR_INPUT
  delay : TIME;
|END_VAR
  pause := delay;
  count := count + 1;
  Start := count > 2;
|END_METHOD
METHOD PUBLIC Reset
  count := 0;
  pause := T#0s;
  THIS.Count2(amount := 1);
|END_METHOD
METHOD PRIVATE Count2
|VAR_INPUT
  amount : INT;
|END_VAR
  count := count + amount;
  IF count > 100 THEN
    count := 100;
    RETURN;
  END_IF;
  count := count;
|END_METHOD
PROPERTY Level : INT
|GET
  Level := count;
|END_GET
|SET
  count := Level;
|END_SET
|END_PROPERTY
|END_FUNCTION_BLOCK
|PROGRAM Main
|VAR
  d : Device;
  i : IStart;
  ok : BOOL;
  n : INT;
|END_VAR
  i := d;
  ok := d.Start(delay := T#2s);
  d.Reset();
  ok := i.Start(T#1s) AND ok;
  IF d.Start(T#0s) THEN
    n := 1;
  END_IF;
  n := n + 1;
|END_PROGRAM
)"},
    {"charts", R"(|PROGRAM Main
|VAR_EXTERNAL
  pressure : REAL;
  alarm : BOOL;
|END_VAR
|VAR
  go : BOOL := TRUE;
  n : INT;
  delay : TON;
|END_VAR
INITIAL_STEP Wait:
  Count(N);
|END_STEP
TRANSITION FROM Wait TO Fill := go AND n > 2;
|END_TRANSITION
STEP Fill:
  Open(N);
  Late(D, T#2s);
|END_STEP
TRANSITION FROM Fill TO Wait := pressure > 2.0;
|END_TRANSITION
ACTION Count:
  n := n + 1;
  delay(IN := go, PT := T#1s);
|END_ACTION
ACTION Open:
  pressure := pressure * 1.1;
  alarm := pressure > 5.0;
|END_ACTION
|END_PROGRAM
)"},
    {"instructions", R"(|PROGRAM Main
|VAR
  a, b : INT;
  q : BOOL;
  timer : TON;
|END_VAR
  LD a
  ADD 2
  MUL( b
  SUB 1
  )
  ST b
  GT 10
  JMPC over
  LDN q
  S q
over:
  CAL timer(IN := q, PT := T#1s)
  LD timer.Q
  ST q
|END_PROGRAM
)"},
    {"networks", R"(|PROGRAM Main
|VAR
  a, b, q : BOOL;
|END_VAR
|{network LD}
  rail 1;
  contact 5 (a) := 1;
  contact 2 (b) NOT := 5;
  coil 3 (q) := 2;
|{end_network}
|END_PROGRAM
|PROGRAM Free
|VAR
  n, m : INT;
|END_VAR
|{network CFC}
  input 1 (n + 1);
  input 2 (m);
  box 3 ADD ORDER 1 [IN1 := 1, IN2 := 2];
  output 4 (n) ORDER 2 := 3;
|{end_network}
|END_PROGRAM
)"},
    {"configurations", R"(|PROGRAM Main
|VAR x : INT; END_VAR
  x := x + 1;
|END_PROGRAM
CONFIGURATION Plant
|VAR_GLOBAL
  level : REAL := 1.0;
|END_VAR
RESOURCE Cpu ON PLC
  TASK fast(INTERVAL := T#10ms, PRIORITY := 1);
  TASK slow(INTERVAL := T#100ms, PRIORITY := 5);
  PROGRAM P1 WITH fast : Main;
  PROGRAM P2 WITH slow : Main;
|END_RESOURCE
|END_CONFIGURATION
)"},
};

struct Line {
  std::string text;
  bool fixed = false;
};

// Indented as written, or each line at the margin.
std::vector<Line> linesOf(const char* text, bool indented) {
  std::vector<Line> lines;
  for (const char* at = text; *at != '\0';) {
    const char* end = at;
    while (*end != '\n') ++end;
    Line line;
    line.fixed = *at == '|';
    if (line.fixed) ++at;
    if (!indented)
      while (*at == ' ') ++at;
    line.text.assign(at, end);
    lines.push_back(line);
    at = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<Line>& lines) {
  std::string all;
  for (const Line& line : lines) all += line.text + '\n';
  return all;
}

// Where the tokens of a line begin and end.
std::vector<std::pair<size_t, size_t>> tokensOf(const std::string& line) {
  Sources sources;
  Diagnostics diagnostics(sources);
  Names names;
  const FileId file = sources.add("line.st", line);
  TokenStream stream;
  lex(stream, names, sources, file, 0, static_cast<uint32_t>(line.size()), Dialect::Codesys, diagnostics);
  std::vector<std::pair<size_t, size_t>> out;
  for (const Token& t : stream.tokens) {
    if (t.kind == Tok::End) break;
    size_t end = t.offset + (isName(t.kind) || isTypeWord(t.kind) ? names.string({t.value}).size() : t.value);
    out.push_back({t.offset, std::min(end, line.size())});
  }
  return out;
}

struct Found {
  explicit Found(const std::vector<Line>& lines, Dialect dialect) {
    const Parsed parsed(joined(lines), dialect);
    for (const Diagnostic& d : parsed.diagnostics.all())
      (diagInfo(d.diag).severity == Severity::Error ? errors : warnings).push_back(parsed.sources.location(d.loc).line);
  }
  std::vector<uint32_t> errors, warnings;  // their lines
};

struct Count {
  uint32_t right = 0, all = 0;
  std::string wrong;
  void add(bool good, const std::string& what) {
    ++all;
    if (good)
      ++right;
    else
      wrong += "\n  " + what;
  }
};

template <class Visit>
void forEachLine(Visit visit) {
  for (const Sample& sample : kSamples)
    for (const Dialect dialect : {Dialect::Codesys, Dialect::Iec3})
      for (const bool indented : {true, false}) {
        const std::vector<Line> lines = linesOf(sample.text, indented);
        ASSERT_TRUE(Found(lines, dialect).errors.empty()) << sample.name;
        for (size_t i = 0; i < lines.size(); ++i)
          if (!lines[i].fixed) visit(lines, i, dialect, sample.name);
      }
}

TEST(Typing, CutLines) {
  Count count;
  forEachLine([&](std::vector<Line> lines, size_t i, Dialect dialect, const char* name) {
    const std::string whole = lines[i].text;
    const auto tokens = tokensOf(whole);
    for (size_t n = 0; n + 1 < tokens.size(); ++n) {
      lines[i].text = whole.substr(0, tokens[n].second);
      const Found found(lines, dialect);
      const auto at = static_cast<uint32_t>(i + 1);
      const bool chain = lines[i].text.ends_with(":=") && lines[i + 1].text.find(":=") != std::string::npos;
      if (found.errors.empty() && !chain) continue;  // a right program
      const bool good = found.errors.empty()
                            ? std::find(found.warnings.begin(), found.warnings.end(), at) != found.warnings.end()
                            : found.errors[0] == at && std::count_if(found.errors.begin(), found.errors.end(),
                                                                     [&](uint32_t line) { return line > at; }) <= 1;
      count.add(good, std::string(name) + ": " + lines[i].text);
    }
  });
  EXPECT_GE(count.right * 100, count.all * 99) << count.right << " of " << count.all << count.wrong;
}

TEST(Typing, DeletedTokens) {
  Count count;
  forEachLine([&](std::vector<Line> lines, size_t i, Dialect dialect, const char* name) {
    const std::string whole = lines[i].text;
    for (const auto& [begin, end] : tokensOf(whole)) {
      lines[i].text = whole.substr(0, begin) + whole.substr(end);
      const Found found(lines, dialect);
      if (found.errors.empty()) continue;  // a right program
      count.add(found.errors.size() == 1 && found.errors[0] == i + 1, std::string(name) + ": " + lines[i].text);
    }
  });
  EXPECT_GE(count.right * 1000, count.all * 955) << count.right << " of " << count.all << count.wrong;
}

}  // namespace
}  // namespace rung::text

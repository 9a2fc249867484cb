// SPDX-License-Identifier: Apache-2.0
// Runs the golden tests of the passes. In: folders or files *.ir, of which line 1 is the purpose; then IR text; then
//   ; run: @F(1, -2) == 3          the value, or `fault div`, before any pass and after each expected one; computed by
//                                  the evaluator and by the interpreter
//   ; expect <passes>: body @F {   the body after the passes (one, or several joined by `+`, or `all`),
//   ;   ...                        the following comment lines belong to it
//   ; }
// The module is verified before and after. Prints a difference and the command that repeats it; exit code 4 when
// a test fails. With --update rewrites the expected bodies (never the values).
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "evaluator.h"
#include "ir/interpreter/function.h"
#include "ir/passes/passes.h"
#include "ir/verify.h"
#include "ir_text.h"

namespace rung::ir {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  size_t from = 0;
  while (from < text.size()) {
    size_t end = text.find('\n', from);
    if (end == std::string::npos) end = text.size();
    lines.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return lines;
}

struct Run {
  std::string text, function, expected;
  std::vector<std::string> arguments;
};

std::string trim(std::string text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.pop_back();
  size_t from = 0;
  while (from < text.size() && text[from] == ' ') ++from;
  return text.substr(from);
}

// `@F(1, -2) == 3`; the rest after two blanks is a remark.
bool parseRun(const std::string& text, Run& run) {
  run.text = text;
  const size_t open = text.find('('), close = text.find(')'), equal = text.find("==");
  if (text.empty() || text[0] != '@' || open == std::string::npos || close == std::string::npos ||
      equal == std::string::npos)
    return false;
  run.function = text.substr(1, open - 1);
  std::string arguments = text.substr(open + 1, close - open - 1);
  while (!trim(arguments).empty()) {
    const size_t comma = std::min(arguments.find(','), arguments.size());
    run.arguments.push_back(trim(arguments.substr(0, comma)));
    arguments = comma < arguments.size() ? arguments.substr(comma + 1) : "";
  }
  std::string rest = trim(text.substr(equal + 2));
  run.expected = trim(rest.substr(0, rest.find("  ")));
  return true;
}

types::Value literal(const std::string& text, TypeId type, const types::TypeTable& types) {
  if (text == "true" || text == "false") return {type, text == "true"};
  if (types::TypeTable::isReal(types.plainKind(type))) return types::Value::ofReal(type, std::stod(text));
  if (text[0] != '-') return {type, std::stoull(text)};
  return {type, static_cast<uint64_t>(std::stoll(text))};
}

class Golden {
 public:
  explicit Golden(bool update) : update_(update) {}
  int failed = 0, passed = 0;

  void file(const std::string& path) {
    path_ = path;
    bad_ = false;
    ReadResult read = readFile(path);
    if (!read.error.empty()) return fail(read.error);
    text_ = read.content;
    std::vector<std::string> lines = linesOf(text_), out;
    std::vector<Run> runs;
    if (lines.empty() || lines[0].rfind("; ", 0) != 0) fail("line 1 is not the purpose");
    checkRuns({}, runs);
    for (const std::string& line : lines) {
      Run run;
      if (line.rfind("; run: ", 0) != 0) continue;
      if (!parseRun(line.substr(7), run))
        fail("`" + line + "` is not a run line");
      else
        runs.push_back(run);
    }
    checkRuns("", runs);
    for (size_t i = 0; i < lines.size(); ++i) {
      out.push_back(lines[i]);
      if (lines[i].rfind("; expect ", 0) != 0) continue;
      const size_t colon = lines[i].find(':');
      if (colon == std::string::npos) {
        fail("`" + lines[i] + "` has no `:`");
        continue;
      }
      const std::string passes = lines[i].substr(9, colon - 9);
      std::string expected = lines[i].substr(colon + 1);
      while (i + 1 < lines.size() && lines[i + 1].rfind("; ", 0) == 0 && lines[i + 1].rfind("; run:", 0) != 0 &&
             lines[i + 1].rfind("; expect ", 0) != 0)
        expected += "\n" + lines[++i].substr(2);
      const std::string given = afterPasses(passes, functionOf(expected), runs);
      if (squeeze(given) == squeeze(expected)) {
        out.back() = lines[i - static_cast<size_t>(std::count(expected.begin(), expected.end(), '\n'))];
        for (size_t k = i + 1 - static_cast<size_t>(std::count(expected.begin(), expected.end(), '\n')); k <= i; ++k)
          out.push_back(lines[k]);
        continue;
      }
      std::vector<std::string> body = linesOf(given);
      out.back() = "; expect " + passes + ": " + (body.empty() ? "" : body[0]);
      for (size_t k = 1; k < body.size(); ++k) out.push_back("; " + body[k]);
      if (!update_) fail("after " + passes + "\nexpected:" + expected + "\nbut got: " + given);
    }
    if (update_) {
      std::string whole;
      for (const std::string& line : out) whole += line + "\n";
      if (whole != text_) {
        std::ofstream(path, std::ios::binary) << whole;
        std::printf("updated %s\n", path.c_str());
      }
    }
    bad_ ? ++failed : ++passed;
  }

 private:
  void fail(const std::string& why) {
    std::printf("%s: %s\n  repeat: ir_golden %s\n", path_.c_str(), why.c_str(), path_.c_str());
    bad_ = true;
  }

  static std::string functionOf(const std::string& expected) {
    const size_t at = expected.find('@');
    if (at == std::string::npos) return "";
    size_t end = at + 1;
    while (end < expected.size() && (std::isalnum(static_cast<unsigned char>(expected[end])) || expected[end] == '_'))
      ++end;
    return expected.substr(at + 1, end - at - 1);
  }

  bool verified(const Module& module, const std::string& when) {
    const std::vector<std::string> problems = verify(module);
    for (const std::string& line : problems) fail(when + ": " + line);
    return problems.empty();
  }

  // Reads the module again, runs the passes over all bodies, checks the run lines; returns the body of `function`.
  std::string afterPasses(const std::string& passes, const std::string& function, const std::vector<Run>& runs) {
    TestModule m(text_, path_);
    if (!m.ok) return m.errors();
    size_t from = 0;
    while (from < passes.size()) {
      const size_t plus = std::min(passes.find('+', from), passes.size());
      const std::string name = passes.substr(from, plus - from);
      from = plus + 1;
      bool known = false;
      for (const Pass& pass : bodyPasses(1)) {
        if (name != "all" && name != pass.name) continue;
        if (name != "all" && known) break;
        known = true;
        for (size_t i = 1; i < m.module.bodies.size(); ++i) {
          Body& body = m.module.bodies[i];
          if (body.native) continue;
          pass.run(m.module, Exposure(m.module), body);
          const std::string once = print(m.module, body);
          if (!verified(m.module, std::string("after ") + pass.name)) return once;
        }
      }
      if (!known) fail("no pass is named `" + name + "`");
    }
    checkRunsIn(m, "after " + passes, runs);
    const Body* body = m.find(function);
    if (body == nullptr) return "no body @" + function;
    std::string printed = print(m.module, *body);
    return printed.substr(printed.find("body @"));
  }

  void checkRuns(const std::string& passes, const std::vector<Run>& runs) {
    TestModule m(text_, path_);
    if (!m.ok) return fail("\n" + m.errors());
    if (verified(m.module, "as written")) checkRunsIn(m, "as written" + passes, runs);
  }

  void checkRunsIn(TestModule& m, const std::string& when, const std::vector<Run>& runs) {
    for (const Run& one : runs) {
      const Body* body = m.find(one.function);
      if (body == nullptr) {
        fail("no function @" + one.function);
        continue;
      }
      std::vector<types::Value> arguments;
      size_t next = 0;
      for (const Local& local : parameters(*body))
        if (local.kind != LocalKind::Output && next < one.arguments.size())
          arguments.push_back(literal(one.arguments[next++], local.type, m.types));
      const RunResult result = run(m.module, *body, arguments);
      compare(m, when, one, result.trouble, result.fault, result.value);
      const auto index = static_cast<uint32_t>(std::find_if(m.module.bodies.begin(), m.module.bodies.end(),
                                                            [&](const Body& other) { return &other == body; }) -
                                               m.module.bodies.begin());
      const interpreter::FunctionResult second =
          interpreter::runFunction(m.module, {index}, arguments, {}, 1'000'000, m.names);
      compare(m, when + " (interpreted)", one, second.trouble, second.fault, second.value);
    }
  }

  void compare(TestModule& m, const std::string& when, const Run& one, const std::string& trouble, types::Fault fault,
               const types::Value& value) {
    std::string given;
    if (!trouble.empty()) {
      given = trouble;
    } else if (fault != types::Fault::None) {
      given = std::string("fault ") + types::word(fault);
    } else {
      const bool wants_fault = one.expected.rfind("fault", 0) == 0;
      if (!wants_fault && literal(one.expected, value.type, m.types).bits == value.bits) return;
      given = types::toString(m.types, m.names, value);
    }
    if (given != one.expected) fail(when + ": " + one.text + "\n  gives " + given);
  }

  bool update_;
  bool bad_ = false;
  std::string path_, text_;
};

}  // namespace
}  // namespace rung::ir

int main(int argc, char** argv) {
  std::set<std::string> files;
  bool update = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--update") {
      update = true;
    } else if (std::filesystem::is_directory(argument)) {
      for (const auto& entry : std::filesystem::directory_iterator(argument))
        if (entry.path().extension() == ".ir") files.insert(entry.path().string());
    } else {
      files.insert(argument);
    }
  }
  if (files.empty()) {
    std::puts("usage: ir_golden [--update] FOLDER|FILE.ir ...");
    return 2;
  }
  rung::ir::Golden golden(update);
  for (const std::string& file : files) golden.file(file);
  std::printf("%d passed, %d failed\n", golden.passed, golden.failed);
  return golden.failed == 0 ? 0 : 4;
}

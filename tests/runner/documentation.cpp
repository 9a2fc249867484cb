// SPDX-License-Identifier: Apache-2.0
// The programs in the documentation: fenced blocks of docs/**.md, README.md, CONTRIBUTING.md and samples/**.md.
//   ```st broken [options]    on docs/errors/E0231.md: `rung check` reports that code and no other error
//   ```st fixed [options]     on such a page: no error, and not that code
//   ```st run [options]       `rung run` succeeds; an ```output block after it is its output
//   ```st test [options]      the same for `rung test`
//   ```st check [options]     no error
//   ```xml broken, fixed      the same for a project in XML, and ```nct for a ladder of that language
//   ```ir broken, fixed       the same for IR text, which ir_golden reads; its comments begin with `; `
//   ```st name.st             a file for the console blocks of the same page (any language, any ending)
//   ```console                a session (console.h), in a folder that looks like the project's root;
//   ```console broken         a session that must mention the page's code
//       rung …               an indented line that begins with rung succeeds in that folder, unless it is a synopsis,
//                            with a word in capitals or brackets; two blanks end a command. Pages of samples are
//                            left out: their commands belong to their folder
//   <!-- no program: why -->  on a page of docs/errors whose mistake no test can provoke
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "tests/runner/console.h"
#include "tests/runner/diff.h"
#include "tests/runner/support.h"

namespace rung::tests {
namespace {

struct Block {
  std::string language, kind;  // of "```st broken --std=iec3": st, broken
  std::vector<std::string> options;
  std::vector<std::string> lines;
  size_t line;  // of the fence, from 1
};

// FILE, X.svg, FILE|DIR, [options]: what a reader replaces.
bool isPlaceholder(const std::string& word) {
  if (word[0] == '[') return true;
  const std::string name = word.substr(0, word.find_first_of(".|"));
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isupper(c) != 0 || c == '_'; });
}

// The command of an indented line, without the remark after it; empty: none, or a synopsis.
std::string commandOf(const std::string& line) {
  if (!startsWith(line, "    rung ")) return {};
  const std::string command = line.substr(4, line.find("  ", 4) - 4);
  const std::vector<std::string> words = splitWords(command);
  return std::any_of(words.begin(), words.end(), isPlaceholder) ? "" : command;
}

std::vector<Block> blocksOf(const std::vector<std::string>& lines) {
  std::vector<Block> blocks;
  for (size_t i = 0; i < lines.size(); ++i) {
    if (const std::string command = commandOf(lines[i]); !command.empty()) {
      // Its output is shown only if it fails.
      blocks.push_back({"command", "", {}, {"$ " + command + " > said 2>&1 || cat said"}, i + 1});
      continue;
    }
    const size_t ticks = std::min(lines[i].find_first_not_of('`'), lines[i].size());
    if (ticks < 3) continue;
    const std::string fence(ticks, '`');
    std::vector<std::string> words = splitWords(lines[i].substr(ticks));
    Block block;
    block.line = i + 1;
    if (!words.empty()) block.language = words[0];
    if (words.size() > 1) block.kind = words[1];
    if (words.size() > 2) block.options.assign(words.begin() + 2, words.end());
    for (++i; i < lines.size() && lines[i] != fence; ++i) block.lines.push_back(lines[i]);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

std::string textOf(const Block& block) {
  std::string text;
  for (const std::string& line : block.lines) text += line + '\n';
  return text;
}

bool isErrorPage(const std::string& file) {
  const std::string name = nameOf(file);
  return startsWith(file, "docs/errors/") && name.size() == 8 && std::string("EWI").find(name[0]) != std::string::npos;
}

class Page {
 public:
  Page(const Setting& setting, const std::string& file) : setting_(setting), file_(file) {
    lines_ = splitLines(readContent(setting.root + "/" + file));
    if (isErrorPage(file)) code_ = nameOf(file).substr(0, 5);
  }

  Result run() {
    const std::vector<Block> blocks = blocksOf(lines_);
    bool broken = false, fixed = false;
    for (size_t i = 0; i < blocks.size(); ++i) {
      const Block& block = blocks[i];
      broken = broken || block.kind == "broken";
      fixed = fixed || block.kind == "fixed";
      const Block* after = i + 1 < blocks.size() && blocks[i + 1].language == "output" ? &blocks[i + 1] : nullptr;
      if (block.language == "console" || (block.language == "command" && !startsWith(file_, "samples/"))) {
        runConsole(block);
      } else if ((block.language == "st" || block.language == "xml" || block.language == "nct") &&
                 (block.kind == "broken" || block.kind == "fixed" || block.kind == "check")) {
        runCheck(block);
      } else if (block.language == "ir" && (block.kind == "broken" || block.kind == "fixed")) {
        runIr(block);
      } else if ((block.language == "st" || block.language == "nct") && (block.kind == "run" || block.kind == "test")) {
        runProgram(block, after);
      } else if (block.kind.find('.') != std::string::npos) {
        const std::filesystem::path path = folder() + "/" + block.kind;
        std::filesystem::create_directories(path.parent_path());
        writeContent(path.string(), textOf(block));
      }
    }
    const bool excused = std::any_of(lines_.begin(), lines_.end(),
                                     [](const std::string& line) { return startsWith(line, "<!-- no program: "); });
    if (!code_.empty() && !(broken && fixed) && !excused) {
      result_.fail(file_, "  a page needs a ```st broken and a ```st fixed program (or ```console broken)\n", "");
    }
    return std::move(result_);
  }

 private:
  const std::string& folder() {
    if (folder_.empty()) folder_ = folderLikeRoot(setting_);
    return folder_;
  }

  std::string nameOfBlock(const Block& block) const { return file_ + ":" + std::to_string(block.line); }

  Command commandFor(const Block& block, const char* verb) {
    Command c;
    c.folder = freshFolder(setting_);
    const std::string name = "example." + block.language;
    writeContent(c.folder + "/" + name, textOf(block));
    c.arguments = {setting_.rung, verb, name};
    c.arguments.insert(c.arguments.end(), block.options.begin(), block.options.end());
    return c;
  }

  void runCheck(const Block& block) {
    const Command check = commandFor(block, "check");
    const Output output = rung::tests::run(check);
    std::string problem;
    bool reported = false;
    for (const std::string& heading : headingsOf(output.err)) {
      const bool own = !code_.empty() && heading.find("[" + code_ + "]") != std::string::npos;
      const bool error = heading.find(": error[") != std::string::npos;
      reported = reported || own;
      if (error && !(own && block.kind == "broken")) problem += "  " + heading + "\n";
      if (!error && own && block.kind == "fixed") problem += "  " + heading + "\n";
    }
    if (block.kind == "broken" && !reported) problem += "  " + code_ + " is not reported\n";
    if (output.exit_code != 0 && output.exit_code != 1)
      problem += "  exit code " + std::to_string(output.exit_code) + "\n";
    finish(block, problem, commandLine(check));
  }

  // ir_golden prints `line:column E0901 message`, once for each time it reads the text.
  void runIr(const Block& block) {
    Command read;
    read.folder = freshFolder(setting_);
    writeContent(read.folder + "/example.ir", textOf(block));
    read.arguments = {setting_.bin + "/ir_golden", "example.ir"};
    read.merged = true;
    if (!std::filesystem::exists(read.arguments[0])) return finish(block, "  ir_golden is not built\n", "");
    const Output output = rung::tests::run(read);
    std::string problem;
    bool reported = false;
    for (const std::string& line : splitLines(output.out)) {
      const std::vector<std::string> words = splitWords(line);
      if (words.size() < 2 || words[0].find(':') == std::string::npos || !startsWith(words[1], "E09")) continue;
      const bool own = words[1] == code_;
      reported = reported || own;
      if (!own || block.kind == "fixed") problem += "  " + line + "\n";
    }
    if (block.kind == "broken" && !reported) problem += "  " + code_ + " is not reported\n";
    if (block.kind == "fixed" && output.exit_code != 0)
      problem += "  exit code " + std::to_string(output.exit_code) + "\n";
    finish(block, problem, commandLine(read));
  }

  void runProgram(const Block& block, const Block* expected) {
    const Command c = commandFor(block, block.kind.c_str());
    const Output output = rung::tests::run(c);
    std::string problem;
    if (output.exit_code != 0)
      problem = "  exit code " + std::to_string(output.exit_code) + "\n" + output.err.substr(0, 4000);
    if (expected != nullptr) problem += diffWithGaps(expected->lines, splitLines(output.out));
    finish(block, problem, commandLine(c));
  }

  void runConsole(const Block& block) {
    std::vector<std::string> updated;
    Result session;
    runSession(setting_, nameOfBlock(block), block.lines, folder(), updated, session);
    std::string problem = session.log;
    const bool mentioned = std::any_of(updated.begin(), updated.end(), [&](const std::string& line) {
      return line.find("[" + code_ + "]") != std::string::npos;
    });
    if (block.kind == "broken" && !mentioned) problem += "  " + code_ + " is not reported\n";
    if (setting_.update && block.language == "console" && updated != block.lines) {
      lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(block.line + shift_),
                   lines_.begin() + static_cast<std::ptrdiff_t>(block.line + shift_ + block.lines.size()));
      lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(block.line + shift_), updated.begin(), updated.end());
      shift_ += updated.size() - block.lines.size();
      std::string text;
      for (const std::string& line : lines_) text += line + '\n';
      writeContent(setting_.root + "/" + file_, text);
      result_.log += "updated " + nameOfBlock(block) + "\n";
    }
    finish(block, problem, "");
  }

  void finish(const Block& block, const std::string& problem, const std::string& command) {
    if (problem.empty()) {
      result_.pass();
    } else {
      result_.fail(nameOfBlock(block) + " (" + block.language + " " + block.kind + ")", problem, command);
    }
  }

  const Setting& setting_;
  std::string file_, code_, folder_;
  std::vector<std::string> lines_;
  size_t shift_ = 0;  // lines that updates have added so far; wraps when they have removed some
  Result result_;
};

}  // namespace

void addDocumentation(const Setting& setting, std::vector<Job>& jobs) {
  std::vector<std::string> pages;
  for (const char* folder : {"docs", "samples"}) {
    for (std::string& file : filesBelow(setting, folder, ".md")) pages.push_back(std::move(file));
  }
  for (const char* file : {"README.md", "CONTRIBUTING.md"}) {
    if (isWanted(setting, file) && std::filesystem::exists(setting.root + "/" + file)) pages.emplace_back(file);
  }
  for (const std::string& file : pages) {
    jobs.push_back({file, isErrorPage(file) ? 0 : 5, [&setting, file] { return Page(setting, file).run(); }});
  }
}

}  // namespace rung::tests

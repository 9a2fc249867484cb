// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/program.h"

#include <algorithm>
#include <filesystem>

#include "frontend/source/files.h"
#include "tools/driver/options.h"

namespace rung::conformance {
namespace {

namespace fs = std::filesystem;

// The text after `// key:` or `<!-- key:`, where a comment of XML writes `\-` for a hyphen; false: the line is another.
bool isKey(std::string_view line, std::string_view key, std::string& value) {
  for (const std::string_view opening : {"// ", "<!-- "}) {
    const std::string begin = std::string(opening) + std::string(key) + ":";
    if (!line.starts_with(begin)) continue;
    line.remove_prefix(begin.size());
    if (line.ends_with("-->")) line.remove_suffix(3);
    while (line.starts_with(' ')) line.remove_prefix(1);
    while (line.ends_with(' ')) line.remove_suffix(1);
    value = line;
    for (size_t at; opening[0] == '<' && (at = value.find("\\-")) != std::string::npos;) value.erase(at, 1);
    return true;
  }
  return false;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

// `name.st:4:1: error[E0231]: …`; other severities are not an error that is due.
void noteExpectation(std::string_view heading, Program& program) {
  const size_t bracket = heading.find(": error[");
  const size_t colon = heading.find(':');
  if (bracket == std::string_view::npos || colon > bracket) return;
  const uint32_t line =
      static_cast<uint32_t>(std::strtoul(std::string(heading.substr(colon + 1)).c_str(), nullptr, 10));
  const size_t code = bracket + 8;
  program.errors.push_back({std::string(heading.substr(code, heading.find(']', code) - code)), line});
}

}  // namespace

std::vector<std::string> wordsOf(std::string_view line) {
  std::vector<std::string> words;
  size_t at = 0;
  while (at < line.size()) {
    const size_t end = std::min(line.find(' ', at), line.size());
    if (end > at) words.emplace_back(line.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    lines.emplace_back(text.substr(at, end - at));
    if (lines.back().ends_with('\r')) lines.back().pop_back();
    at = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  std::string all;
  for (const std::string& word : words) {
    if (!all.empty()) all += separator;
    all += word;
  }
  return all;
}

Program readProgram(const std::string& root, const std::string& path) {
  Program program;
  program.path = path;
  program.text = readFile(root + "/" + path).content;
  const std::vector<std::string> lines = linesOf(program.text);
  for (const std::string& line : lines) {
    std::string value;
    if (isKey(line, "features", value)) {
      append(program.features, wordsOf(value));
    } else if (isKey(line, "covers", value)) {
      for (const std::string& word : wordsOf(value)) {
        const std::string catalogue = word.substr(0, word.find(':'));
        if (std::find(program.catalogues.begin(), program.catalogues.end(), catalogue) == program.catalogues.end())
          program.catalogues.push_back(catalogue);
      }
    } else if (isKey(line, "args", value) || isKey(line, "run", value)) {
      append(program.arguments, wordsOf(value));
    } else if (isKey(line, "with", value)) {
      append(program.others, wordsOf(value));
    } else if (isKey(line, "expect", value)) {
      program.expects = true;
      noteExpectation(value, program);
    } else if (isKey(line, "trace", value)) {
      program.trace.push_back(value);
    } else if (isKey(line, "restart", value)) {
      program.restart = std::strtoll(value.c_str(), nullptr, 10);
    } else if (isKey(line, "exit", value)) {
      program.faults = true;
    } else if (program.purpose.empty() && (line.starts_with("// ") || line.starts_with("<!-- "))) {
      value = line.substr(line.starts_with("// ") ? 3 : 5);
      program.purpose = value.substr(0, value.find("-->"));
      while (program.purpose.ends_with(' ')) program.purpose.pop_back();
    }
  }
  for (const std::string& argument : program.arguments)
    if (argument.starts_with("--std=") && !driver::parseDialect(argument.substr(6), program.dialect).empty()) return {};
  return program;
}

std::vector<std::string> filesBelow(const std::string& root, const std::string& folder,
                                    const std::vector<std::string>& endings) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(root + "/" + folder, error)) {
    const std::string ending = entry.path().extension().string();
    if (std::find(endings.begin(), endings.end(), ending) == endings.end()) continue;
    paths.push_back(entry.path().lexically_relative(root).generic_string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace rung::conformance

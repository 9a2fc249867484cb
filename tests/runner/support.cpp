// SPDX-License-Identifier: Apache-2.0
// Shared parts of the test runner: see support.h.
#include "tests/runner/support.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/runner/diff.h"

namespace rung::tests {
namespace fs = std::filesystem;

void Result::fail(const std::string& test, const std::string& what, const std::string& command) {
  ++failed;
  log += "FAILED " + test + "\n" + what;
  if (!what.empty() && what.back() != '\n') log += '\n';
  if (!command.empty()) log += "  $ " + command + "\n";
}

std::string readContent(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

bool writeContent(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  return !out.fail();
}

bool isWanted(const Setting& setting, const std::string& path) {
  if (setting.wanted.empty()) return true;
  return std::any_of(setting.wanted.begin(), setting.wanted.end(),
                     [&](const std::string& wanted) { return path == wanted || startsWith(path, wanted + "/"); });
}

std::vector<std::string> filesBelow(const Setting& setting, const std::string& folder, const std::string& ending) {
  std::vector<std::string> files;
  std::error_code error;
  for (auto it = fs::recursive_directory_iterator(setting.root + "/" + folder, error);
       it != fs::recursive_directory_iterator(); it.increment(error)) {
    const std::string path = fs::path(it->path()).lexically_relative(setting.root).string();
    if (it->is_regular_file(error) && path.ends_with(ending) && isWanted(setting, path)) files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string folderOf(const std::string& path) { return fs::path(path).parent_path().string(); }
std::string nameOf(const std::string& path) { return fs::path(path).filename().string(); }

std::string freshFolder(const Setting& setting) {
  static std::atomic<unsigned> count{0};
  std::string folder = setting.scratch + "/" + std::to_string(count++);
  std::error_code error;
  fs::create_directories(folder, error);
  return folder;
}

std::vector<std::string> valuesOf(const std::vector<std::string>& lines, const std::string& key) {
  std::vector<std::string> values;
  for (const std::string& line : lines) {
    for (const char* comment : {"// ", "; ", "<!-- ", "# "}) {
      const std::string prefix = comment + key + ":";
      if (!startsWith(line, prefix)) continue;
      std::string value = line.substr(prefix.size());
      if (comment[0] == '<' && value.ends_with("-->")) value.resize(value.size() - 3);
      // A comment of XML has no two hyphens: \-\-std=iec3.
      for (size_t at; comment[0] == '<' && (at = value.find("\\-")) != std::string::npos;) value.erase(at, 1);
      values.push_back(trimmed(value));
      break;
    }
  }
  return values;
}

std::string valueOf(const std::vector<std::string>& lines, const std::string& key) {
  std::string all;
  for (const std::string& value : valuesOf(lines, key)) all += (all.empty() ? "" : " ") + value;
  return all;
}

std::vector<std::string> splitWords(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  bool inside = false;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) {
        quote = 0;
      } else {
        word += c;
      }
    } else if (c == '\'' || c == '"') {
      quote = c;
      inside = true;
    } else if (c == ' ' || c == '\t') {
      if (inside) words.push_back(word);
      word.clear();
      inside = false;
    } else {
      word += c;
      inside = true;
    }
  }
  if (inside) words.push_back(word);
  return words;
}

bool startsWith(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> headingsOf(const std::string& printed) {
  std::vector<std::string> headings;
  for (const std::string& line : splitLines(printed)) {
    if (line.empty() || line[0] == ' ') continue;  // source lines and underlines
    for (const char* word : {": error[", ": warning[", ": info[", ": note: ", ": fault[", " not shown (",
                             "internal error", ": runtime error: ", "ERROR: AddressSanitizer"}) {
      if (line.find(word) == std::string::npos) continue;
      headings.push_back(line);
      break;
    }
  }
  return headings;
}

std::string purposeProblem(const std::vector<std::string>& lines) {
  for (const char* comment : {"// ", "(* ", "; ", "# ", "<!-- ", "<?xml"}) {
    if (!lines.empty() && startsWith(lines[0], comment)) return {};
  }
  return "  line 1 must be a comment that describes the test\n";
}

}  // namespace rung::tests

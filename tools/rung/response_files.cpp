// SPDX-License-Identifier: Apache-2.0
// See response_files.h.
#include "tools/rung/response_files.h"

#include <iterator>
#include <string_view>

#include "frontend/source/files.h"
#include "tools/driver/options.h"

namespace rung::tool {
namespace {

constexpr uint32_t kMostFiles = 100;

// Appends the words of a text to `words`; false: it ends inside a quoted word.
bool split(std::string_view text, std::vector<std::string>& words) {
  std::string word;
  bool in_word = false;
  char quote = 0;
  for (size_t i = 0; i < text.size(); i++) {
    const char c = text[i];
    const bool is_blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (quote == 0 && is_blank) {
      if (in_word) words.push_back(std::move(word));
      word.clear();
      in_word = false;
      continue;
    }
    in_word = true;
    if (c == '\\' && quote != '\'' && i + 1 < text.size())
      word += text[++i];
    else if (quote != 0 && c == quote)
      quote = 0;
    else if (quote == 0 && (c == '\'' || c == '"'))
      quote = c;
    else
      word += c;
  }
  if (in_word) words.push_back(std::move(word));
  return quote == 0;
}

}  // namespace

std::string expandResponseFiles(std::vector<std::string>& arguments) {
  uint32_t files = 0;
  for (size_t i = 0; i < arguments.size(); i++) {
    if (arguments[i].size() < 2 || arguments[i][0] != '@') continue;
    const std::string path = arguments[i].substr(1);
    if (++files > kMostFiles)
      return "more than 100 response files; does " + driver::backquoted(arguments[i]) + " include itself?";
    const ReadResult read = readFile(path);
    if (!read.error.empty()) return "cannot read response file " + driver::backquoted(path) + ": " + read.error;
    std::vector<std::string> words;
    if (!split(read.content, words)) return "response file " + driver::backquoted(path) + " ends inside a quoted word";
    const auto at = arguments.erase(arguments.begin() + static_cast<ptrdiff_t>(i));
    arguments.insert(at, std::make_move_iterator(words.begin()), std::make_move_iterator(words.end()));
    i--;  // the first of the new arguments may be a response file too
  }
  return {};
}

}  // namespace rung::tool

// SPDX-License-Identifier: Apache-2.0
// A line that somebody types in a terminal, with history and completion. In: keys. Out: lines. Needs a terminal of the
// ANSI kind on stdin and stdout. Called by terminal.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace rung::debug {

class LineEditor {
 public:
  // The words that may be at the end of a line, each as a whole, and where that word begins.
  struct Completion {
    size_t begin = 0;
    std::vector<std::string> words;
  };
  using Complete = std::function<Completion(const std::string& line)>;

  LineEditor(std::string prompt, Complete complete) : prompt_(std::move(prompt)), complete_(std::move(complete)) {}
  // False: the input has ended.
  bool read(std::string& line);

 private:
  enum class Key { Text, Enter, Left, Right, Up, Down, Home, End, Back, Delete, Tab, Clear, Cut, Leave, Other };
  Key nextKey(char& c);
  Key escape();
  void draw() const;
  void recall(size_t entry);
  void complete();
  bool act(Key key, char c);
  void left();
  void right();
  void erase();

  const std::string prompt_;
  const Complete complete_;
  std::vector<std::string> history_;
  std::string line_;
  std::string typed_;  // while an older line is shown
  size_t cursor_ = 0, entry_ = 0;
};

}  // namespace rung::debug

// SPDX-License-Identifier: Apache-2.0
#include "tools/debug/line_editor.h"

#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace rung::debug {
namespace {

constexpr size_t kMostHistory = 1000, kLongest = 4096;

// Keys come one by one, while a line is read.
class RawMode {
 public:
  RawMode() {
    is_set_ = tcgetattr(0, &before_) == 0;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);
    if (is_set_) tcsetattr(0, TCSADRAIN, &raw);
  }
  ~RawMode() {
    if (is_set_) tcsetattr(0, TCSADRAIN, &before_);
  }
  RawMode(const RawMode&) = delete;
  RawMode& operator=(const RawMode&) = delete;

 private:
  termios before_{};
  bool is_set_;
};

bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }  // of a character in UTF-8
size_t charactersOf(const std::string& text, size_t end) {
  return static_cast<size_t>(std::count_if(text.begin(), text.begin() + static_cast<ptrdiff_t>(end),
                                           [](char c) { return !isContinuation(c); }));
}

void write(const std::string& text) {
  fwrite(text.data(), 1, text.size(), stdout);
  fflush(stdout);
}

}  // namespace

void LineEditor::draw() const {
  const size_t after = charactersOf(line_, line_.size()) - charactersOf(line_, cursor_);
  std::string text = '\r' + prompt_ + line_ + "\x1b[K";
  if (after > 0) text += "\x1b[" + std::to_string(after) + 'D';
  write(text);
}

LineEditor::Key LineEditor::escape() {
  char first = 0, second = 0, third = 0;
  if (::read(0, &first, 1) != 1 || (first != '[' && first != 'O') || ::read(0, &second, 1) != 1) return Key::Other;
  if (second >= '0' && second <= '9') {
    if (::read(0, &third, 1) != 1 || third != '~') return Key::Other;
    if (second == '3') return Key::Delete;
    if (second == '1' || second == '7') return Key::Home;
    return second == '4' || second == '8' ? Key::End : Key::Other;
  }
  switch (second) {
    case 'A': return Key::Up;
    case 'B': return Key::Down;
    case 'C': return Key::Right;
    case 'D': return Key::Left;
    case 'H': return Key::Home;
    case 'F': return Key::End;
    default: return Key::Other;
  }
}

LineEditor::Key LineEditor::nextKey(char& c) {
  if (::read(0, &c, 1) != 1) return Key::Leave;
  switch (c) {
    case '\r':
    case '\n': return Key::Enter;
    case '\t': return Key::Tab;
    case 1: return Key::Home;
    case 2: return Key::Left;
    case 3: return Key::Clear;
    case 4: return line_.empty() ? Key::Leave : Key::Delete;
    case 5: return Key::End;
    case 6: return Key::Right;
    case 11: return Key::Cut;
    case 14: return Key::Down;
    case 16: return Key::Up;
    case 8:
    case 127: return Key::Back;
    case 27: return escape();
    default: return static_cast<unsigned char>(c) < ' ' ? Key::Other : Key::Text;
  }
}

void LineEditor::left() {
  if (cursor_ > 0) --cursor_;
  while (cursor_ > 0 && isContinuation(line_[cursor_])) --cursor_;
}

void LineEditor::right() {
  if (cursor_ < line_.size()) ++cursor_;
  while (cursor_ < line_.size() && isContinuation(line_[cursor_])) ++cursor_;
}

void LineEditor::erase() {
  const size_t begin = cursor_;
  right();
  line_.erase(begin, cursor_ - begin);
  cursor_ = begin;
}

void LineEditor::recall(size_t entry) {
  if (entry > history_.size()) return;
  if (entry_ == history_.size()) typed_ = line_;
  entry_ = entry;
  line_ = entry == history_.size() ? typed_ : history_[entry];
  cursor_ = line_.size();
}

// What all words have in common; a second time, when that is nothing more, the words.
void LineEditor::complete() {
  const Completion found = complete_(line_.substr(0, cursor_));
  if (found.words.empty()) return;
  std::string common = found.words.front();
  for (const std::string& word : found.words) {
    size_t same = 0;
    while (same < common.size() && same < word.size() && common[same] == word[same]) ++same;
    common.resize(same);
  }
  if (found.words.size() == 1) common += ' ';
  if (common.size() > cursor_ - found.begin) {
    line_.replace(found.begin, cursor_ - found.begin, common);
    cursor_ = found.begin + common.size();
    return;
  }
  std::string all = "\n";
  for (const std::string& word : found.words) all += word + "  ";
  write(all + '\n');
}

bool LineEditor::act(Key key, char c) {
  switch (key) {
    case Key::Text:
      if (line_.size() < kLongest) line_.insert(cursor_++, 1, c);
      break;
    case Key::Left: left(); break;
    case Key::Right: right(); break;
    case Key::Home: cursor_ = 0; break;
    case Key::End: cursor_ = line_.size(); break;
    case Key::Up:
      if (entry_ > 0) recall(entry_ - 1);
      break;
    case Key::Down: recall(entry_ + 1); break;
    case Key::Back:
      if (cursor_ > 0) {
        left();
        erase();
      }
      break;
    case Key::Delete: erase(); break;
    case Key::Cut: line_.resize(cursor_); break;
    case Key::Clear:
      write("^C\n");
      line_.clear();
      cursor_ = 0;
      break;
    case Key::Tab: complete(); break;
    case Key::Other: break;
    case Key::Enter:
    case Key::Leave: return false;
  }
  return true;
}

bool LineEditor::read(std::string& line) {
  const RawMode raw;
  line_.clear();
  cursor_ = 0;
  entry_ = history_.size();
  for (;;) {
    draw();
    char c = 0;
    const Key key = nextKey(c);
    if (act(key, c)) continue;
    write("\n");
    if (key == Key::Leave) return false;
    break;
  }
  if (!line_.empty() && (history_.empty() || history_.back() != line_)) history_.push_back(line_);
  if (history_.size() > kMostHistory) history_.erase(history_.begin());
  line = line_;
  return true;
}

}  // namespace rung::debug

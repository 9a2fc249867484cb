// SPDX-License-Identifier: Apache-2.0
// NCT ladder text, docs/nct.md: a line is one element, so only its indentation and the blanks between its words change.
// Words keep their spelling; what is in quotes and after `//` stays as it is.
#include <algorithm>
#include <array>
#include <vector>

#include "frontend/format/format.h"
#include "frontend/source/names.h"

namespace rung::format {
namespace {

constexpr size_t kColumns = 2, kGap = 2;  // of symbols: the address and the text

struct LadderLine {
  std::vector<std::string_view> words;
  std::string_view comment;  // from `//`
  std::string_view source;   // the whole line
  size_t indent = 0;
  bool is_symbol = false;
  std::array<size_t, kColumns + 1> columns{};  // where its words begin
};

// After the quote that closes the text; two quotes are one character of it.
size_t endOfText(std::string_view line, size_t at) {
  for (size_t k = at + 1; k < line.size(); ++k) {
    if (line[k] != '"') continue;
    if (k + 1 >= line.size() || line[k + 1] != '"') return k + 1;
    ++k;
  }
  return line.size();
}

LadderLine split(std::string_view line) {
  LadderLine out;
  out.source = line;
  for (size_t at = 0; at < line.size();) {
    if (line[at] == ' ' || line[at] == '\t' || line[at] == '\r') {
      ++at;
      continue;
    }
    if (line.substr(at, 2) == "//") {
      out.comment = line.substr(at);
      while (!out.comment.empty() &&
             (out.comment.back() == ' ' || out.comment.back() == '\t' || out.comment.back() == '\r'))
        out.comment.remove_suffix(1);
      break;
    }
    size_t end = at;
    if (line[at] == '"') {
      end = endOfText(line, at);
    } else {
      while (end < line.size() && line[end] != ' ' && line[end] != '\t' && line[end] != '\r' && line[end] != '"' &&
             line.substr(end, 2) != "//")
        ++end;
    }
    out.words.push_back(line.substr(at, end - at));
    at = end;
  }
  return out;
}

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> list) {
  return std::any_of(list.begin(), list.end(), [&](std::string_view one) { return sameIdentifier(word, one); });
}

class LadderFormatter {
 public:
  LadderFormatter(const Style& style, LineRange range) : style_(style), range_(range) {}

  std::string run(std::string_view source) {
    const std::string_view newline = source.find("\r\n") == std::string_view::npos ? "\n" : "\r\n";
    for (size_t at = 0; at < source.size();) {
      const size_t end = std::min(source.find('\n', at), source.size());
      lines_.push_back(split(source.substr(at, end - at)));
      at = end + 1;
    }
    for (LadderLine& line : lines_) place(line);
    placeComments();
    alignSymbols();
    std::string out;
    uint32_t blank = 0;
    for (size_t k = 0; k < lines_.size(); ++k) {
      const bool may_change = k + 1 >= range_.first && k + 1 <= range_.last;
      const std::string text = may_change ? written(k) : std::string(withoutReturn(lines_[k].source));
      blank = text.empty() ? blank + 1 : 0;
      if (may_change && blank > (out.empty() ? 0 : style_.blank_lines)) continue;
      out += text;
      out += newline;
    }
    while (out.ends_with(std::string(newline) + std::string(newline))) out.resize(out.size() - newline.size());
    return out;
  }

 private:
  static std::string_view withoutReturn(std::string_view line) {
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
  }

  static bool opensSection(std::string_view word) {
    return isOneOf(word, {"SYMBOLS", "MODULE", "MESSAGES", "BUTTONS"});
  }
  static bool closesSection(std::string_view word) {
    return isOneOf(word, {"END_SYMBOLS", "END_MODULE", "END_MESSAGES", "END_BUTTONS"});
  }
  static bool isAtMargin(std::string_view word) { return isOneOf(word, {"RUNG", "SEC", "END", "JME", "SBN"}); }

  // Its indentation: rungs and markers are at the margin, elements a level deeper, those of branches one more for each.
  void place(LadderLine& line) {
    if (line.words.empty()) return;
    const std::string_view first = line.words[0];
    if (opensSection(first) || closesSection(first)) {
      section_ = !opensSection(first) ? Section::None : isOneOf(first, {"MODULE"}) ? Section::Module : Section::Table;
      branches_ = 0;
      return;
    }
    line.is_symbol = section_ == Section::Table;
    if (line.is_symbol) line.indent = style_.indent;
    if (section_ != Section::Module) return;
    if (isAtMargin(first)) {
      branches_ = 0;
      return;
    }
    if ((first == ")" || first == "]") && branches_ > 0) --branches_;
    line.indent = (branches_ + (first == "|" && branches_ > 0 ? 0 : 1)) * style_.indent;
    if (first == "(" || first == "[") ++branches_;
  }
  // A comment on its own line has the indentation of what follows.
  void placeComments() {
    size_t indent = 0;
    for (size_t k = lines_.size(); k-- > 0;) {
      if (lines_[k].words.empty())
        lines_[k].indent = indent;
      else
        indent = closesSection(lines_[k].words[0]) ? style_.indent : lines_[k].indent;
    }
  }

  std::string written(size_t k) const {
    const LadderLine& line = lines_[k];
    if (line.words.empty() && line.comment.empty()) return {};
    std::string out(line.indent, ' ');
    for (size_t word = 0; word < line.words.size(); ++word) {
      if (word > 0)
        out.append(line.is_symbol && word <= kColumns && style_.align ? line.columns[word] - out.size() : 1, ' ');
      out += line.words[word];
    }
    if (line.comment.empty()) return out;
    if (!line.words.empty()) out += "  ";
    return out + std::string(line.comment);
  }

  // The words of symbols that follow each other share their columns.
  void alignSymbols() {
    for (size_t k = 0; k < lines_.size();) {
      size_t end = k;
      while (end < lines_.size() && lines_[end].is_symbol) ++end;
      for (size_t word = 1; word <= kColumns; ++word) {
        size_t column = 0;
        for (size_t line = k; line < end; ++line) {
          const LadderLine& symbol = lines_[line];
          if (symbol.words.size() <= word) continue;
          const size_t begin = word == 1 ? symbol.indent : symbol.columns[word - 1];
          column = std::max(column, begin + symbol.words[word - 1].size() + kGap);
        }
        for (size_t line = k; line < end; ++line) lines_[line].columns[word] = column;
      }
      k = std::max(end, k + 1);
    }
  }

  const Style& style_;
  LineRange range_;
  std::vector<LadderLine> lines_;
  enum class Section : uint8_t { None, Table, Module };
  Section section_ = Section::None;
  size_t branches_ = 0;  // open in the rung
};

}  // namespace

std::string formattedLadder(std::string_view source, const Style& style, LineRange range) {
  return LadderFormatter(style, range).run(source);
}

}  // namespace rung::format

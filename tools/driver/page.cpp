// SPDX-License-Identifier: Apache-2.0
// Pages of errors without Markdown: see page.h. What the pages use: headings, paragraphs, tables and lists (as they
// are), fenced code, `code`, **strong** and [links](to).
#include "tools/driver/page.h"

namespace rung::driver {
namespace {

class PageText {
 public:
  PageText(std::string_view page, bool styled) : rest_(page), styled_(styled) {}

  std::string render() {
    while (!rest_.empty()) {
      const std::string_view line = takeLine();
      if (line.starts_with("```")) {
        code(line.substr(3));
      } else if (line.starts_with("#")) {
        const size_t begin = line.find_first_not_of("# ");
        if (begin != std::string_view::npos) heading(line.substr(begin));
      } else {
        inlineText(line);
        out_ += '\n';
      }
    }
    return std::move(out_);
  }

 private:
  std::string_view takeLine() {
    const size_t end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    return line;
  }

  void style(const char* sequence) {
    if (styled_) out_ += sequence;
  }

  void blankLine() {
    if (!out_.empty() && !out_.ends_with("\n\n")) out_ += '\n';
  }

  void heading(std::string_view text) {
    blankLine();
    style("\x1b[1m");
    inlineText(text);
    style("\x1b[0m");
    out_ += "\n\n";
  }

  // ```st broken
  void code(std::string_view info) {
    blankLine();
    const size_t blank = info.find(' ');
    const std::string_view kind = blank == std::string_view::npos ? std::string_view() : info.substr(blank + 1);
    if (kind.starts_with("broken") || kind.starts_with("fixed")) {
      style("\x1b[1m");
      out_ += kind.starts_with("broken") ? "Wrong:" : "Right:";
      style("\x1b[0m");
      out_ += "\n\n";
    }
    while (!rest_.empty()) {
      const std::string_view line = takeLine();
      if (line.starts_with("```")) break;
      style("\x1b[36m");
      if (!line.empty()) out_.append("    ").append(line);
      style("\x1b[0m");
      out_ += '\n';
    }
    if (!rest_.empty()) out_ += '\n';
  }

  // Names keep their backquotes where there are no colors, as in messages.
  void inlineText(std::string_view text) {
    while (!text.empty()) {
      if (text.front() == '`') {
        const size_t end = text.find('`', 1);
        if (end != std::string_view::npos) {
          style("\x1b[36m");
          out_ += styled_ ? text.substr(1, end - 1) : text.substr(0, end + 1);
          style("\x1b[39m");
          text.remove_prefix(end + 1);
          continue;
        }
      }
      if (text.starts_with("**")) {
        text.remove_prefix(2);
        continue;
      }
      if (text.front() == '[') {
        const size_t middle = text.find("](");
        const size_t end = middle == std::string_view::npos ? middle : text.find(')', middle);
        if (end != std::string_view::npos) {
          inlineText(text.substr(1, middle - 1));
          text.remove_prefix(end + 1);
          continue;
        }
      }
      out_ += text.front();
      text.remove_prefix(1);
    }
  }

  std::string_view rest_;
  const bool styled_;
  std::string out_;
};

}  // namespace

std::string renderPage(std::string_view page, bool styled) { return PageText(page, styled).render(); }

}  // namespace rung::driver

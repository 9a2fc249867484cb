// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/formatting.h"

#include <algorithm>

#include "sema/project.h"
#include "tools/driver/formatted_text.h"

namespace rung::ide {
namespace {

// The lines with their ends.
std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

bool isWithin(const TextEdit& edit, std::string_view text, format::LineRange lines) {
  const auto line = static_cast<uint32_t>(std::count(text.begin(), text.begin() + edit.range.begin, '\n')) + 1;
  return lines.first <= line && line <= lines.last;
}

}  // namespace

std::vector<TextEdit> lineEdits(FileId file, std::string_view before, std::string_view after) {
  const std::vector<std::string_view> old_lines = linesOf(before), new_lines = linesOf(after);
  const size_t most = std::min(old_lines.size(), new_lines.size());
  size_t head = 0, tail = 0;
  while (head < most && old_lines[head] == new_lines[head]) ++head;
  while (tail < most - head && old_lines[old_lines.size() - 1 - tail] == new_lines[new_lines.size() - 1 - tail]) ++tail;
  const size_t old_end = old_lines.size() - tail, new_end = new_lines.size() - tail;
  const auto offset = [&](size_t line) {
    return line < old_lines.size() ? static_cast<uint32_t>(old_lines[line].data() - before.data())
                                   : static_cast<uint32_t>(before.size());
  };
  std::vector<TextEdit> edits;
  if (old_lines.size() == new_lines.size()) {
    for (size_t i = head; i < old_end; ++i)
      if (old_lines[i] != new_lines[i]) edits.push_back({{file, offset(i), offset(i + 1)}, std::string(new_lines[i])});
  } else {
    std::string text;
    for (size_t i = head; i < new_end; ++i) text += new_lines[i];
    edits.push_back({{file, offset(head), offset(old_end)}, std::move(text)});
  }
  return edits;
}

std::optional<std::vector<TextEdit>> formattingOf(const View& view, FileId file, format::LineRange lines) {
  const workspace::Snapshot& snapshot = view.snapshot();
  const std::string path = view.pathOf(file);
  if (snapshot.project() == nullptr || path.empty()) return std::nullopt;
  driver::ProjectOptions options;
  options.dialect = snapshot.project()->options.dialect;
  options.dialect_given = true;
  const std::string before(view.textOf(file));
  const std::optional<std::string> after =
      driver::formattedText(options, {path, before}, snapshot.inputs().project.style, lines);
  if (!after) return std::nullopt;
  std::vector<TextEdit> edits = lineEdits(file, before, *after);
  const bool is_part = lines.first > 1 || lines.last != UINT32_MAX;
  if (is_part)  // a file of another tool is formatted as a whole
    std::erase_if(edits, [&](const TextEdit& edit) { return !isWithin(edit, before, lines); });
  return edits;
}

}  // namespace rung::ide

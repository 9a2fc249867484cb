// SPDX-License-Identifier: Apache-2.0
#include "tools/monitor/table.h"

#include <sys/ioctl.h>

#include <algorithm>

namespace rung::monitor {
namespace {

const char kHideCursor[] = "\033[?25l", kShowCursor[] = "\033[?25h", kClearLine[] = "\033[K", kClearBelow[] = "\033[J";

struct Window {
  size_t rows = 24, columns = 80;
};

Window windowOf(std::FILE* out) {
  winsize size{};
  Window window;
  if (ioctl(fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_row > 0 && size.ws_col > 0)
    window = {size.ws_row, size.ws_col};
  return window;
}

// The first `columns` characters of UTF-8.
std::string_view cut(std::string_view text, size_t columns) {
  size_t shown = 0;
  for (size_t i = 0; i < text.size(); ++i)
    if ((text[i] & 0xc0) != 0x80 && shown++ == columns) return text.substr(0, i);
  return text;
}

std::string rowOf(const host::JsonMember& value, size_t name_width) {
  std::string row = value.name;
  row.resize(std::max(row.size(), name_width), ' ');
  return row + "  " + (value.value.isNull() ? "(null)" : std::string(value.value.text()));
}

}  // namespace

Table::~Table() {
  if (lines_ > 0) std::fputs(kShowCursor, out_);
  std::fflush(out_);
}

void Table::show(const host::Json& event) {
  const Window window = windowOf(out_);
  const host::Json::Object& values = event["values"].members();
  const size_t most = window.rows > 3 ? window.rows - 3 : 1, shown = std::min(values.size(), most);
  size_t name_width = 0;
  for (const host::JsonMember& value : values)
    name_width = std::max(name_width, std::min<size_t>(value.name.size(), 60));
  std::string text = lines_ == 0 ? kHideCursor : "\033[" + std::to_string(lines_) + "A\r";
  const auto add = [&](const std::string& line) {
    text += cut(line, window.columns - 1);
    text += std::string(kClearLine) + "\n";
  };
  add("cycle " + std::to_string(event["cycle"].integer()) + ", " + std::to_string(event["time_ms"].integer()) + " ms");
  for (size_t i = 0; i < shown; ++i) add(rowOf(values[i], name_width));
  if (shown < values.size()) add("and " + std::to_string(values.size() - shown) + " more");
  lines_ = 1 + shown + (shown < values.size() ? 1 : 0);
  text += kClearBelow;
  std::fputs(text.c_str(), out_);
  std::fflush(out_);
}

}  // namespace rung::monitor

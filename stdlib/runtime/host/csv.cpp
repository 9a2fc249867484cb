// SPDX-License-Identifier: Apache-2.0
// Reading and quoting CSV: see csv.h.
#include "csv.h"

namespace rung::host {

bool readCsv(std::string_view text, std::vector<CsvRow>& rows, std::string& error) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  uint32_t line = 1;
  size_t at = 0, line_begin = 0;
  const auto fail = [&](CsvRow::Position position, const char* what) {
    error = std::to_string(position.line) + ":" + std::to_string(position.column) + ": " + what;
    return false;
  };
  while (at < text.size()) {
    CsvRow row;
    for (bool more = true; more;) {
      std::string cell;
      const auto here = [&] { return CsvRow::Position{line, static_cast<uint32_t>(at - line_begin) + 1}; };
      row.positions.push_back(here());
      if (at < text.size() && text[at] == '"') {
        for (++at;; ++at) {
          if (at == text.size()) return fail(row.positions.back(), "the quote of a cell is not closed");
          if (text[at] == '"') {
            if (at + 1 == text.size() || text[at + 1] != '"') break;
            ++at;
          }
          if (text[at] == '\n') {
            ++line;
            line_begin = at + 1;
          }
          cell += text[at];
        }
        ++at;
        if (at < text.size() && text[at] != ',' && text[at] != '\n' && text[at] != '\r')
          return fail(here(), "text after the closing quote of a cell");
      } else {
        const size_t begin = at;
        while (at < text.size() && text[at] != ',' && text[at] != '\n' && text[at] != '\r') ++at;
        cell = text.substr(begin, at - begin);
      }
      row.cells.push_back(std::move(cell));
      more = at < text.size() && text[at] == ',';
      if (more) ++at;
    }
    if (at < text.size() && text[at] == '\r') ++at;
    if (at < text.size() && text[at] == '\n') ++at;
    ++line;
    line_begin = at;
    if (row.cells.size() > 1 || !row.cells[0].empty()) rows.push_back(std::move(row));
  }
  return true;
}

void appendCell(std::string& to, std::string_view cell) {
  if (cell.find_first_of(",\"\r\n") == std::string_view::npos) {
    to += cell;
    return;
  }
  to += '"';
  for (const char c : cell) {
    if (c == '"') to += '"';
    to += c;
  }
  to += '"';
}

}  // namespace rung::host

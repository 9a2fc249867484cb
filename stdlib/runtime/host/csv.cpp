#include "csv.h"

namespace rung::host {

bool readCsv(std::string_view text, std::vector<CsvRow>& rows, std::string& error) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  uint32_t line = 1;
  size_t at = 0;
  while (at < text.size()) {
    CsvRow row{line, {}};
    for (bool more = true; more;) {
      std::string cell;
      if (at < text.size() && text[at] == '"') {
        const uint32_t opened = line;
        for (++at;; ++at) {
          if (at == text.size()) {
            error = std::to_string(opened) + ": the quote of a cell is not closed";
            return false;
          }
          if (text[at] == '"') {
            if (at + 1 == text.size() || text[at + 1] != '"') break;
            ++at;
          }
          if (text[at] == '\n') ++line;
          cell += text[at];
        }
        ++at;
        if (at < text.size() && text[at] != ',' && text[at] != '\n' && text[at] != '\r') {
          error = std::to_string(line) + ": text after the closing quote of a cell";
          return false;
        }
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

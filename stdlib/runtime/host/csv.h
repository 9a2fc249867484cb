// Comma-separated values as RFC 4180 says: reading the table of --inputs, quoting cells of the trace.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rung::host {

struct CsvRow {
  struct Position {
    uint32_t line, column;  // from 1; columns count bytes
  };
  std::vector<std::string> cells;
  std::vector<Position> positions;  // where each begins
};

// Reads a whole text; empty lines are passed over. False: `error` is "LINE:COLUMN: what is wrong".
bool readCsv(std::string_view text, std::vector<CsvRow>& rows, std::string& error);
// The cell, in quotes where it holds a comma, quote or line break.
void appendCell(std::string& to, std::string_view cell);

}  // namespace rung::host

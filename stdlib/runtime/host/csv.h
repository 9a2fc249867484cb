// SPDX-License-Identifier: Apache-2.0
// Comma-separated values (RFC 4180): reads the table of --inputs, quotes cells of the trace.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rung::host {

// The column of a trace that names what is forced; as an input it is ignored, unless a variable has the name.
constexpr char kForcedColumn[] = "forced";

struct CsvRow {
  struct Position {
    uint32_t line, column;  // from 1; columns count bytes
  };
  std::vector<std::string> cells;
  std::vector<Position> positions;  // where each begins
};

// Reads a whole table; empty lines are ignored. False: `error` is "LINE:COLUMN: message".
bool readCsv(std::string_view text, std::vector<CsvRow>& rows, std::string& error);
// The cell, in quotes when it has a comma, quote or line break.
void appendCell(std::string& to, std::string_view cell);

}  // namespace rung::host

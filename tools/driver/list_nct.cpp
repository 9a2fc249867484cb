// SPDX-License-Identifier: Apache-2.0
// `rung list nct`: the names of the NCT ladder, a line each, with tabs between its parts. In: the tables of
// frontend/import/nct. Out: symbols with kind, address, direction and index; instructions with their operands; scopes;
// services of MR and MW; execution codes.
#include <cstdio>

#include "frontend/import/nct/memory.h"
#include "frontend/import/nct/operands.h"
#include "frontend/import/nct/services.h"
#include "tools/driver/commands.h"
#include "tools/driver/list.h"

namespace rung::driver {
namespace {

using importer::nct::Direction;
using importer::nct::Instruction;
using importer::nct::NcSymbol;
using importer::nct::Symbol;
using importer::nct::SymbolKind;

// The lines of one kind; the first two parts are the name and what it is.
class Lines {
 public:
  explicit Lines(const ReportOptions& report) : list_(report) {}
  void add(std::initializer_list<std::string_view> titles, std::initializer_list<std::string_view> parts) {
    std::string line;
    JsonRow row;
    auto title = titles.begin();
    for (const std::string_view part : parts) {
      line += (line.empty() ? "" : "\t") + std::string(part);
      row.text(std::string(*title++).c_str(), part);
    }
    list_.add(line + "\n", row);
  }
  std::string text() const { return list_.text(); }

 private:
  List list_;
};

std::string_view word(SymbolKind kind) {
  switch (kind) {
    case SymbolKind::Bit: return "BIT";
    case SymbolKind::Word: return "DWORD";
    case SymbolKind::Double: return "DOUBLE";
    case SymbolKind::Integer: return "#";
    case SymbolKind::Pattern: return "#$";
    case SymbolKind::Number: return "*";
  }
  return "";
}

std::string_view word(Direction direction) {
  switch (direction) {
    case Direction::None: return "-";
    case Direction::In: return "IN";
    case Direction::Out: return "OUT";
  }
  return "";
}

std::string address(SymbolKind kind, int32_t word, uint8_t bit) {
  char text[16];
  if (kind == SymbolKind::Bit)
    snprintf(text, sizeof text, "%04d.%02d", word, bit);
  else
    snprintf(text, sizeof text, "%04d", word);
  return text;
}

// The forms that may follow the comma: `0...7`, `0,2...14` of doubles, which are two words.
std::string indexes(const NcSymbol& symbol) {
  if (symbol.units <= 1) return "-";
  const bool is_double = symbol.kind == SymbolKind::Double;
  return (is_double ? "0,2..." : "0...") + std::to_string((symbol.units - 1) * (is_double ? 2 : 1));
}

void addSymbol(Lines& lines, std::string_view name, const NcSymbol& symbol) {
  lines.add({"name", "kind", "address", "direction", "index"},
            {name, word(symbol.kind), address(symbol.kind, symbol.word, symbol.bit), word(symbol.direction),
             indexes(symbol)});
}

// FLAGS and its bits are the PLC's own, which no element writes.
void addOwn(Lines& lines, const Symbol& symbol) {
  const bool is_constant = symbol.kind == SymbolKind::Integer;
  lines.add({"name", "kind", "address", "direction", "index"},
            {symbol.name, word(symbol.kind),
             is_constant ? "#" + std::to_string(symbol.value) : address(symbol.kind, symbol.word, symbol.bit),
             word(symbol.word == 0 && !is_constant ? Direction::In : Direction::None), "-"});
}

void addSymbols(Lines& lines) {
  for (const Symbol& symbol : importer::nct::ownSymbols({})) addOwn(lines, symbol);
  lines.add({"name", "kind", "address", "direction", "index"}, {"PlcPeriod", "TASK", "Main", "-", "-"});
  lines.add({"name", "kind", "address", "direction", "index"}, {"TimeSlice", "TASK", "Int0", "-", "-"});
  for (const NcSymbol& symbol : importer::nct::ncSymbols()) addSymbol(lines, symbol.name, symbol);
  NcSymbol handwheels = *importer::nct::findNcSymbol("P_H1AS");  // P_H1AS to P_H4AS
  handwheels.units = 4;
  addSymbol(lines, "P_HnAS", handwheels);
  for (const importer::nct::NcSpelling& spelling : importer::nct::ncSpellings())
    addSymbol(lines, spelling.name, *importer::nct::findNcSymbol(spelling.of));
}

// A character of Instruction::operands.
std::string_view wordOfOperand(char kind) {
  switch (kind) {
    case 'b': return "BIT written";
    case 'c': return "BIT or DWORD";
    case 'w': return "DWORD written";
    case 'u': return "DWORD written";
    case 'W': return "DOUBLE written";
    case 't': return "DWORD kept";
    case 'r': return "DWORD";
    case 'R': return "DOUBLE";
    case 'k': return "DWORD or #";
    case 's': return "DWORD or # or #$";
    case 'h': return "DWORD or #$";
    case 'f': return "DOUBLE or *";
    case 'i': return "#";
    case 'l': return "label";
    case 'n': return "scope";
    default: return "";
  }
}

void addInstruction(Lines& lines, const Instruction& instruction) {
  std::string operands;
  size_t count = 0, required = 0;
  bool optional = false;
  for (const char kind : instruction.operands) {
    if (kind == '?') {
      optional = true;
      continue;
    }
    ++count;
    if (!optional) ++required;
    operands += (operands.empty() ? "" : "; ") + std::string(wordOfOperand(kind));
  }
  const std::string numbers = (required == count ? "" : std::to_string(required) + "...") + std::to_string(count);
  lines.add({"name", "kind", "count", "operands"},
            {instruction.word, "INSTRUCTION", numbers, operands.empty() ? "-" : operands});
}

}  // namespace

int listNct(const ProjectOptions& project, Sink& sink) {
  Lines lines(project.report);
  addSymbols(lines);
  for (const Instruction& instruction : importer::nct::allInstructions()) addInstruction(lines, instruction);
  for (const importer::nct::Scope& scope : importer::nct::scopes())
    lines.add({"name", "kind", "parameter"},
              {scope.name, "SCOPE", scope.last == 0 ? std::string("-") : "0..." + std::to_string(scope.last)});
  for (const importer::nct::Service& service : importer::nct::services()) {
    const std::string direction(wordOf(service.direction));
    const std::string amount =
        service.least == service.most
            ? std::to_string(service.least)
            : std::to_string(service.least) + "..." + (service.most == 0 ? "" : std::to_string(service.most));
    lines.add({"name", "kind", "amount", "section", "what"},
              {direction + std::to_string(service.code), "SERVICE", amount, service.section, service.what});
  }
  for (const importer::nct::ExecutionCode& code : importer::nct::executionCodes())
    lines.add({"name", "kind", "meaning"}, {std::to_string(code.code), "CODE", code.meaning});
  return printResult(sink, lines.text());
}

}  // namespace rung::driver

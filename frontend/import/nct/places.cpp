// SPDX-License-Identifier: Apache-2.0
// Located variables and operands of NCT programs in ST; see places.h.
#include "frontend/import/nct/places.h"

#include "frontend/parse/lexer.h"
#include "frontend/parse/parse.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::importer::nct {
namespace {

bool isNumbered(std::string_view name, std::string_view begin) {
  return name.starts_with(begin) && name.size() > begin.size() && name[begin.size()] >= '0' &&
         name[begin.size()] <= '9';
}
// Tells whether the generated ST has another use for the name, so that the symbol is reached by its address only.
bool isTaken(const std::string& name, const std::string& program) {
  return text::isReservedWord(name) || text::isElementaryType(name) || name.starts_with("NCT_") ||
         name.find("_TO_") != std::string::npos || name == program + "_MAIN" || name == program + "_INT0" ||
         name == "_CYCLIC" || name == "_MESSAGE" || name == "_KEPT" || name == "_STARTED" ||
         name.starts_with("_FLAGS") || isNumbered(name, "_") || isNumbered(name, "_T") || isNumbered(name, "_SUB");
}

// Of a symbol that is an address.
Part partOf(SymbolKind kind) {
  return kind == SymbolKind::Bit ? Part::Bit : kind == SymbolKind::Double ? Part::Double : Part::Word;
}

std::string hex(int64_t value) {
  char text[24];
  snprintf(text, sizeof text, "16#%X", static_cast<uint32_t>(value));
  return text;
}

}  // namespace

bool Places::isName(std::string_view name) const { return !isTaken(upper(name), upper(program_.name.text)); }

std::string Places::of(const Address& address, Part part, Space space) {
  const Symbol* const symbol = address.symbol;
  const bool fits = symbol != nullptr && isAddressKind(symbol->kind) && partOf(symbol->kind) == part;
  if (space == Space::Plc && fits && isName(symbol->name)) {
    if (!symbol->is_user) own_symbols_.insert({std::string(symbol->name), symbol});
    return std::string(symbol->name);
  }
  const uint64_t key = (static_cast<uint64_t>(space) << 32) | (static_cast<uint64_t>(part) << 24) |
                       (static_cast<uint64_t>(address.word) << 8) | (part == Part::Bit ? address.bit : 0);
  const auto [found, is_new] = places_.emplace(key, std::string());
  if (is_new) {
    char name[32];
    const char* const mark = space == Space::Plc ? "" : "t";
    if (part == Part::Bit)
      snprintf(name, sizeof name, "_%s%04d_%02d", mark, address.word, address.bit);
    else
      snprintf(name, sizeof name, "_%s%04d%s", mark, address.word, part == Part::Double ? "_d" : "");
    found->second = name;
    declare(name, program_.name.loc, part, address.word, address.bit, space);
  }
  return found->second;
}

void Places::declare(std::string_view name, Loc loc, Part part, int32_t word, uint8_t bit, Space space) {
  const std::string area = space == Space::Plc ? "%N" : "%T";
  const bool has_symbol = !name.starts_with('_');
  std::string text = has_symbol && (word == 0 || isInputWord(word)) ? "  {test_only} " : "  ";
  text += name;
  if (part == Part::Bit)
    text += " AT " + area + "X" + std::to_string(word * 4 + bit / 8) + "." + std::to_string(bit % 8) + " : BOOL;\n";
  else
    text += " AT " + area + "D" + std::to_string(word) + (part == Part::Word ? " : DWORD;\n" : " : LREAL;\n");
  declarations_.put(loc, text);
}

std::string Places::wordOf(const Address& address) {
  std::string text = std::to_string(address.word);
  if (address.offset >= 0) text += " + DWORD_TO_DINT(" + wordAt(address.offset) + ")";
  return text;
}

std::string Places::bitOf(const Address& address) {
  return address.bit_from >= 0 ? "DWORD_TO_DINT(" + wordAt(address.bit_from) + ")" : std::to_string(address.bit);
}

std::string Places::wordAt(int32_t word) {
  Address address;
  address.word = word;
  return of(address, Part::Word, Space::Plc);
}

std::string Places::asWord(const Operand& operand) {
  switch (operand.kind) {
    case OperandKind::Address:
      if (operand.isDynamic()) return "NCT_WORD(" + wordOf(operand.address) + ")";
      return of(operand.address, Part::Word, Space::Plc);
    case OperandKind::Integer:
    case OperandKind::Pattern: return "DWORD#" + hex(operand.value);
    case OperandKind::Number:
    case OperandKind::Broken: break;
  }
  return "DWORD#0";
}

std::string Places::asInteger(const Operand& operand) {
  if (operand.kind == OperandKind::Integer) return "DINT#" + std::to_string(operand.value);
  if (operand.kind == OperandKind::Pattern)
    return "DINT#" + std::to_string(static_cast<int32_t>(static_cast<uint32_t>(operand.value)));
  return "DWORD_TO_DINT(" + asWord(operand) + ")";
}

std::string Places::asDouble(const Operand& operand) {
  if (operand.kind == OperandKind::Number) {
    std::string text(operand.number);
    const size_t sign = text.starts_with("-") ? 1 : 0;
    if (text[sign] == '.') text.insert(sign, "0");
    const size_t point = text.find('.');
    if (point + 1 == text.size() || text[point + 1] == 'e' || text[point + 1] == 'E') text.insert(point + 1, "0");
    return "LREAL#" + text;
  }
  if (operand.kind != OperandKind::Address) return "LREAL#0.0";
  if (operand.isDynamic()) return "NCT_DOUBLE(" + wordOf(operand.address) + ")";
  return of(operand.address, Part::Double, Space::Plc);
}

std::string Places::filled(std::string_view pattern, std::span<const Operand> operands) {
  std::string text;
  for (size_t k = 0; k < pattern.size(); ++k) {
    if (pattern[k] != '{') {
      text += pattern[k];
      continue;
    }
    const char as = pattern[k + 1];
    const size_t index = static_cast<size_t>(pattern[k + 2] - '0');
    k += 3;
    if (index >= operands.size()) continue;
    const Operand& operand = operands[index];
    text += as == 'w'   ? asWord(operand)
            : as == 'd' ? asInteger(operand)
            : as == 'f' ? asDouble(operand)
            : as == 'a' ? wordOf(operand.address)
                        : std::to_string(operand.value);
  }
  return text;
}

void Places::writeTo(xml::SourceMappedText& out) {
  out.put(program_.name.loc, "VAR_GLOBAL\n");
  for (const Symbol& symbol : memory_.userSymbols()) {
    if (symbol.name.empty() || !isName(symbol.name) || !isAddressKind(symbol.kind)) continue;
    declare(symbol.name, symbol.loc, partOf(symbol.kind), symbol.word, symbol.bit, Space::Plc);
  }
  for (const auto& [name, symbol] : own_symbols_)
    declare(name, program_.name.loc, partOf(symbol->kind), symbol->word, symbol->bit, Space::Plc);
  declarations_.addTo(out);
  const Limits& limits = memory_.limits();
  out.put(program_.name.loc, "END_VAR\nVAR_GLOBAL RETAIN\n  _kept AT %ND" + std::to_string(limits.kept) +
                                 " : ARRAY[0.." + std::to_string(limits.volatile_ - limits.kept - 1) +
                                 "] OF DWORD;\nEND_VAR\n");
}

}  // namespace rung::importer::nct

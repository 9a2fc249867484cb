// SPDX-License-Identifier: Apache-2.0
// Symbols and addresses of NCT programs; see memory.h.
#include "frontend/import/nct/memory.h"

#include <algorithm>
#include <charconv>

#include "frontend/import/diagnostics.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::importer::nct {
namespace {

#define NC_SYMBOL(name, kind, direction, word, bit, units) \
  {#name, SymbolKind::kind, Direction::direction, word, bit, units},
#define NC_SPELLING(name, of)
constexpr NcSymbol kNcSymbols[] = {
#include "frontend/import/nct/nc_symbols.def"
};
#undef NC_SYMBOL
#undef NC_SPELLING

#define NC_SYMBOL(name, kind, direction, word, bit, units)
#define NC_SPELLING(name, of) {#name, #of},
constexpr NcSpelling kSpellings[] = {
#include "frontend/import/nct/nc_symbols.def"
};
#undef NC_SYMBOL
#undef NC_SPELLING

int32_t wordsOf(const NcSymbol& symbol) { return symbol.units * (symbol.kind == SymbolKind::Double ? 2 : 1); }

const std::bitset<kWords>& inputWords() {
  static const auto* const words = [] {
    auto* const set = new std::bitset<kWords>;
    for (const NcSymbol& symbol : kNcSymbols)
      if (symbol.direction == Direction::In)
        for (int32_t k = 0; k < wordsOf(symbol); ++k) set->set(static_cast<size_t>(symbol.word + k));
    return set;
  }();
  return *words;
}

// Symbols relative to one another, one after the other: more come from no drawing, and each is a call.
constexpr uint32_t kMostSymbols = 200;

bool isDigits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// `-12.5`, `.5`, `5.`, with an exponent: the point must be there.
bool isDouble(std::string_view text) {
  if (text.starts_with("-")) text.remove_prefix(1);
  const size_t exponent = std::min(text.find_first_of("eE"), text.size());
  const std::string_view mantissa = text.substr(0, exponent);
  const size_t point = mantissa.find('.');
  if (point == std::string_view::npos || mantissa.size() < 2) return false;
  const auto digits = [](std::string_view part) { return part.empty() || isDigits(part); };
  if (!digits(mantissa.substr(0, point)) || !digits(mantissa.substr(point + 1))) return false;
  if (exponent == text.size()) return true;
  std::string_view power = text.substr(exponent + 1);
  if (power.starts_with("-") || power.starts_with("+")) power.remove_prefix(1);
  return isDigits(power);
}

}  // namespace

std::span<const NcSymbol> ncSymbols() { return kNcSymbols; }
std::span<const NcSpelling> ncSpellings() { return kSpellings; }

std::vector<Symbol> ownSymbols(const Limits& limits) {
  std::vector<Symbol> symbols;
  const auto add = [&](std::string_view name, SymbolKind kind, int32_t word, uint8_t bit, int64_t value) {
    Symbol symbol;
    symbol.name = name;
    symbol.kind = kind;
    symbol.word = word;
    symbol.bit = bit;
    symbol.value = value;
    symbols.push_back(symbol);
  };
  add("FLAGS", SymbolKind::Word, 0, 0, 0);
  uint8_t bit = 0;
  for (const std::string_view flag : {"FL_ER", "FL_UF", "FL_OF", "FL_CY", "FL_GT", "FL_EQ", "FL_LT"})
    add(flag, SymbolKind::Bit, 0, bit++, 0);
  add("PLCNVRAM", SymbolKind::Word, limits.kept, 0, 0);
  add("PLCRAM", SymbolKind::Word, limits.volatile_, 0, 0);
  int64_t basis = 0;
  for (const std::string_view name : {"MSEC", "SEC", "MIN", "HOURS"}) add(name, SymbolKind::Integer, 0, 0, basis++);
  return symbols;
}

const NcSymbol* findNcSymbol(std::string_view name) {
  static const auto* const by_name = [] {
    auto* const map = new std::unordered_map<std::string, const NcSymbol*>;
    for (const NcSymbol& symbol : kNcSymbols) map->emplace(upper(symbol.name), &symbol);
    for (const NcSpelling& spelling : kSpellings) map->emplace(upper(spelling.name), map->at(upper(spelling.of)));
    return map;
  }();
  const auto found = by_name->find(upper(name));
  return found == by_name->end() ? nullptr : found->second;
}

bool isInputWord(int32_t word) { return word >= 0 && word < kWords && inputWords().test(static_cast<size_t>(word)); }

int32_t endOfNcWords() {
  int32_t end = 0;
  for (const NcSymbol& symbol : kNcSymbols) end = std::max(end, symbol.word + wordsOf(symbol));
  return end;
}

Memory::Memory(const Program& program, const Limits& limits, Diagnostics& diagnostics)
    : program_(program),
      limits_(limits),
      diagnostics_(diagnostics),
      user_(program.symbols.size()),
      states_(program.symbols.size(), kNew) {
  for (const Symbol& symbol : ownSymbols(limits)) nc_.emplace(upper(symbol.name), symbol);
  for (uint32_t k = 0; k < program.symbols.size(); ++k) {
    const Word& name = program.symbols[k].name;
    const auto [other, is_new] = lines_.emplace(upper(name.text), k);
    const auto own = nc_.find(other->first);
    const bool fixed = own != nc_.end() && own->second.kind != SymbolKind::Integer;
    if (fixed || findNcSymbol(name.text) != nullptr)
      report(diag::NctTwice, name, {"the symbol `" + std::string(name.text) + "` of the numerical control"});
    else if (!is_new)
      report(diag::NctTwice, name, {"`" + std::string(name.text) + "`"})
          .declaredHere(program.symbols[other->second].name.loc);
  }
  for (size_t k = 0; k < user_.size(); ++k) resolve(k);
}

// NAME value: a constant, or a static address.
void Memory::resolve(size_t line) {
  const SymbolLine& from = program_.symbols[line];
  if (states_[line] == kDone) return;
  if (states_[line] == kBusy) return void(report(diag::NctSymbolCycle, from.name, {from.name.text}));
  if (depth_ >= kMostSymbols) {
    report(diag::NctSymbolChain, from.name, {from.name.text, std::to_string(kMostSymbols)});
    states_[line] = kDone;
    return;
  }
  ++depth_;
  resolveNew(line);
  --depth_;
}

void Memory::resolveNew(size_t line) {
  const SymbolLine& from = program_.symbols[line];
  states_[line] = kBusy;
  Symbol symbol;
  symbol.name = from.name.text;
  symbol.loc = from.name.loc;
  symbol.is_user = true;
  const char first = from.value.text.front();
  bool good = true;
  if (first == '#' || first == '*') {
    Operand constant;
    good = readConstant(from.value, constant);
    symbol.kind = constant.kind == OperandKind::Integer   ? SymbolKind::Integer
                  : constant.kind == OperandKind::Pattern ? SymbolKind::Pattern
                                                          : SymbolKind::Number;
    symbol.value = constant.value;
    symbol.number = constant.number;
  } else {
    Address address;
    good = readAddress(from.value, address, true);
    if (good && !address.is_static()) {
      report(diag::NctOperandKind, from.value, {from.value.text, "a symbol has a fixed address"});
      good = false;
    }
    const bool is_double = from.marker.empty() ? !address.is_bit && beginsWithDouble(from.value.text)
                                               : sameIdentifier(from.marker.text, "DOUBLE");
    if (good && is_double && address.is_bit) {
      report(diag::NctOperandKind, from.marker, {from.marker.text, "this symbol is a bit"});
      good = false;
    }
    symbol.kind = address.is_bit ? SymbolKind::Bit : is_double ? SymbolKind::Double : SymbolKind::Word;
    symbol.word = address.word;
    symbol.bit = address.bit;
    if (good && is_double && symbol.word > kWords - 2) {
      report(diag::NctAddress, from.value, {from.value.text, "a double needs two words, so its last address is 9998"});
      good = false;
    }
  }
  if (good) user_[line] = symbol;
  states_[line] = kDone;
}

// CP_INC or CP_INC,#2: relative to a double, it is one too.
bool Memory::beginsWithDouble(std::string_view text) {
  const Symbol* const symbol = find(text.substr(0, text.find_first_of(",;.:")));
  return symbol != nullptr && symbol->kind == SymbolKind::Double;
}

const Symbol* Memory::find(std::string_view name) {
  const std::string key = upper(name);
  if (const auto found = lines_.find(key); found != lines_.end()) {
    resolve(found->second);
    return &user_[found->second];
  }
  if (const auto found = nc_.find(key); found != nc_.end()) return &found->second;
  const NcSymbol* const nc = findNcSymbol(name);
  if (nc == nullptr) return nullptr;
  Symbol symbol;
  symbol.name = nc->name;
  symbol.kind = nc->kind;
  symbol.word = nc->word;
  symbol.bit = nc->bit;
  symbol.units = nc->units;
  return &nc_.emplace(key, symbol).first->second;
}

// #14, #-25, #$AB, *1.5. Reports one that is malformed or out of range.
bool Memory::readConstant(const Word& word, Operand& operand) {
  const std::string_view text = word.text;
  if (text.starts_with("*")) {
    operand.kind = OperandKind::Number;
    operand.number = text.substr(1);
    if (!isDouble(operand.number)) {
      report(diag::NctConstant, word, {text, "a double has a decimal point: `*12.5`"});
      return false;
    }
    double value = 0;
    const auto [end, error] =
        std::from_chars(operand.number.data(), operand.number.data() + operand.number.size(), value);
    if (error == std::errc::result_out_of_range) {
      report(diag::NctConstant, word, {text, "a double reaches from 5.0e-324 to 1.7e308"});
      return false;
    }
    return true;
  }
  if (text.starts_with("#$")) {
    operand.kind = OperandKind::Pattern;
    const std::string_view digits = text.substr(2);
    uint32_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    operand.value = value;
    if (digits.empty() || digits.size() > 8 || error != std::errc() || end != digits.data() + digits.size()) {
      report(diag::NctConstant, word, {text, "`#$` takes 1 to 8 hexadecimal digits"});
      return false;
    }
    return true;
  }
  operand.kind = OperandKind::Integer;
  const std::string_view digits = text.substr(1);
  const bool negative = digits.starts_with("-");
  if (!isDigits(digits.substr(negative ? 1 : 0))) {
    report(diag::NctConstant, word, {text, "`#` takes a decimal number: `#14`, `#-25`"});
    return false;
  }
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), operand.value);
  if (error != std::errc() || operand.value < INT32_MIN || operand.value > INT32_MAX) {
    report(diag::NctConstant, word, {text, "`#` reaches from -2147483648 to 2147483647"});
    return false;
  }
  return true;
}

// A numeral of four digits or a name.
bool Memory::readBase(const Word& word, Address& address, bool in_declaration) {
  const std::string_view text = word.text;
  if (isDigits(text)) {
    if (text.size() != 4) {
      report(diag::NctAddress, word, {text, "an address has four digits, a constant begins with `#`"});
      return false;
    }
    std::from_chars(text.data(), text.data() + text.size(), address.word);
    if (address.word < limits_.kept) {
      if (in_declaration && address.word != 0)
        report(diag::NctSymbolAddress, word, {text});
      else if (!in_declaration && address.word != 0)
        report(diag::NctPhysicalAddress, word, {text});
    }
    return true;
  }
  if (!isIdentifier(text)) {
    report(diag::NctAddress, word, {text, "write a name or four digits"});
    return false;
  }
  const Symbol* const symbol = find(text);
  if (symbol == nullptr) {
    std::vector<std::string_view> names;
    for (const SymbolLine& line : program_.symbols) names.push_back(line.name.text);
    for (const NcSymbol& nc : kNcSymbols) names.push_back(nc.name);
    report(diag::NctUnknownSymbol, word, {text}).didYouMean(nearest(text, names));
    return false;
  }
  if (symbol->name.empty()) return false;  // broken, or in a cycle: reported
  address.word = symbol->word;
  address.symbol = symbol;
  if (symbol->kind == SymbolKind::Bit) {
    address.is_bit = true;
    address.bit = symbol->bit;
  }
  return true;
}

// .17 or :NAME after a word
bool Memory::readBit(const Word& word, Address& address) {
  if (address.is_bit) {
    report(diag::NctOperandKind, word, {word.text, "the symbol before it is a bit already"});
    return false;
  }
  const std::string_view text = word.text.substr(1);
  address.is_bit = true;
  address.symbol = nullptr;
  if (word.text[0] == '.') {
    if (!isDigits(text) || text.size() != 2 || text > "31") {
      report(diag::NctAddress, word, {word.text, "after the point a bit has two digits, 00 to 31"});
      return false;
    }
    address.bit = static_cast<uint8_t>((text[0] - '0') * 10 + (text[1] - '0'));
    return true;
  }
  Address from;
  if (!readBase({text, {word.loc.offset + 1}}, from, false)) return false;
  if (from.is_bit || (from.symbol != nullptr && !isAddressKind(from.symbol->kind))) {
    report(diag::NctOperandKind, word, {word.text, "the number of a bit is in a word"});
    return false;
  }
  address.bit_from = from.word;
  return true;
}

// ,#3 or ,REGISTER
bool Memory::readOffset(const Word& word, Address& address, bool in_declaration) {
  const Word offset{word.text.substr(1), {word.loc.offset + 1}};
  const Symbol* const unit = address.symbol;
  address.symbol = nullptr;
  int64_t constant = 0;
  if (offset.text.starts_with("#")) {
    Operand operand;
    if (!readConstant(offset, operand)) return false;
    constant = operand.value;
  } else {
    Address from;
    if (!readBase(offset, from, false)) return false;
    const bool is_constant = from.symbol != nullptr && from.symbol->kind == SymbolKind::Integer;
    if (from.is_bit || (from.symbol != nullptr && !is_constant && !isAddressKind(from.symbol->kind))) {
      report(diag::NctOperandKind, word, {word.text, "an index is a word or a `#` constant"});
      return false;
    }
    if (!is_constant) {
      if (in_declaration) {
        report(diag::NctOperandKind, word, {word.text, "a symbol has a fixed address"});
        return false;
      }
      address.offset = from.word;
      return true;
    }
    constant = from.symbol->value;
  }
  if (unit != nullptr && unit->units > 0) {
    const int64_t step = unit->kind == SymbolKind::Double ? 2 : 1;
    if (step == 2 && constant % 2 != 0)
      report(diag::NctOddIndex, word, {word.text, unit->name});
    else if (!in_declaration && (constant < 0 || constant >= unit->units * step))
      report(diag::NctBeyondUnits, word, {word.text, unit->name, std::to_string(unit->units)});
  }
  const int64_t sum = address.word + constant;
  address.word = static_cast<int32_t>(std::clamp<int64_t>(sum, -1, kWords));
  return true;
}

bool Memory::readAddress(Word word, Address& address, bool in_declaration) {
  const std::string_view text = word.text;
  const size_t comma = std::min(text.find_first_of(",;"), text.size());
  const size_t bit = std::min(text.find_first_of(".:"), comma);
  const auto part = [&](size_t begin, size_t end) {
    return Word{text.substr(begin, end - begin), {word.loc.offset + static_cast<uint32_t>(begin)}};
  };
  if (!readBase(part(0, bit), address, in_declaration)) return false;
  if (address.symbol != nullptr && !isAddressKind(address.symbol->kind)) {
    report(diag::NctOperandKind, word, {text, "the name is that of a constant"});
    return false;
  }
  if (bit < comma && !readBit(part(bit, comma), address)) return false;
  if (comma < text.size() && !readOffset(part(comma, text.size()), address, in_declaration)) return false;
  if (address.offset < 0 && (address.word < 0 || address.word >= kWords)) {
    report(diag::NctAddress, word, {text, "the memory reaches from 0000 to 9999"});
    return false;
  }
  return true;
}

Operand Memory::operandOf(const Word& word, bool takes_query) {
  Operand operand;
  operand.word = word;
  Word rest = word;
  const char first = word.text.front();
  if (first == '@' || first == '%' || first == '!') {
    if (!takes_query) {
      report(diag::NctOperandKind, word,
             {word.text,
              first == '!' ? "`!` belongs to contacts, OUT, OUTN, SET and RST" : "edges are queried by contacts only"});
      return operand;
    }
    operand.query = first == '@' ? Query::Rising : first == '%' ? Query::Falling : Query::Immediate;
    rest = {word.text.substr(1), {word.loc.offset + 1}};
    if (rest.empty()) {
      report(diag::NctAddress, word, {word.text, "an address follows it without a blank"});
      return operand;
    }
  }
  if (rest.text.front() == '#' || rest.text.front() == '*') {
    if (!readConstant(rest, operand)) operand.kind = OperandKind::Broken;
    return operand;
  }
  if (isIdentifier(rest.text)) {
    const Symbol* const symbol = find(rest.text);
    if (symbol != nullptr && !symbol->name.empty() && !isAddressKind(symbol->kind)) {
      operand.kind = symbol->kind == SymbolKind::Integer   ? OperandKind::Integer
                     : symbol->kind == SymbolKind::Pattern ? OperandKind::Pattern
                                                           : OperandKind::Number;
      operand.value = symbol->value;
      operand.number = symbol->number;
      return operand;
    }
  }
  if (readAddress(rest, operand.address, false)) operand.kind = OperandKind::Address;
  return operand;
}

}  // namespace rung::importer::nct

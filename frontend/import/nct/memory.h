// SPDX-License-Identifier: Apache-2.0
// The memory of an NCT program and its names: 10 000 double words, the symbols of the numerical control, those of the
// program. In: the symbol lines of a program. Out: operands, as the instructions take them: constants and addresses,
// static where the file says it all. NCT manual chapters 2, 4 and 7; docs/nct.md.
#pragma once

#include <bitset>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/import/nct/program.h"

namespace rung::importer::nct {

inline constexpr int32_t kWords = 10000;
inline constexpr int32_t kBits = 32;

// Where user memory begins: what is kept, and what is not.
struct Limits {
  int32_t kept = 4000;       // PLCNVRAM
  int32_t volatile_ = 5024;  // PLCRAM
};

enum class SymbolKind : uint8_t { Bit, Word, Double, Integer, Pattern, Number };
constexpr bool isAddressKind(SymbolKind kind) {
  return kind == SymbolKind::Bit || kind == SymbolKind::Word || kind == SymbolKind::Double;
}
enum class Direction : uint8_t { None, In, Out };

struct NcSymbol {
  std::string_view name;
  SymbolKind kind;
  Direction direction;
  int32_t word;
  uint8_t bit;
  uint8_t units;  // panels, axes, channels …: this many words or doubles, one after the other
};
std::span<const NcSymbol> ncSymbols();
struct NcSpelling {
  std::string_view name, of;
};
std::span<const NcSpelling> ncSpellings();
// By name or another spelling of it, any case; null: none.
const NcSymbol* findNcSymbol(std::string_view name);
// Tells whether the numerical control writes this word.
bool isInputWord(int32_t word);
// One past the last word of the numerical control.
int32_t endOfNcWords();

struct Symbol {
  std::string_view name;
  Loc loc;
  SymbolKind kind;
  bool is_user = false;
  int32_t word = 0;
  uint8_t bit = 0;
  uint8_t units = 0;          // of the numerical control
  int64_t value = 0;          // Integer, Pattern
  std::string_view number{};  // Number: without the `*`
};

// Symbols that every program has, besides those of the numerical control. NCT manual 2, 5; 6.4 for the time bases.
std::vector<Symbol> ownSymbols(const Limits& limits);

// A place in memory. With `offset` or `bit_from`, the place is known when the program runs.
struct Address {
  int32_t word = 0;
  bool is_bit = false;
  uint8_t bit = 0;
  int32_t offset = -1;             // the word that holds what is added; -1: none
  int32_t bit_from = -1;           // the word that holds the number of the bit; -1: `bit`
  const Symbol* symbol = nullptr;  // that names it, if the address is just this name
  bool is_static() const { return offset < 0 && bit_from < 0; }
};

enum class OperandKind : uint8_t { Broken, Address, Integer, Pattern, Number };
enum class Query : uint8_t { Level, Rising, Falling, Immediate };
struct Operand {
  OperandKind kind = OperandKind::Broken;
  Query query = Query::Level;
  Address address;
  int64_t value = 0;
  std::string_view number;
  Word word;
  // An address that is known when the program runs.
  bool isDynamic() const { return kind == OperandKind::Address && !address.is_static(); }
};

class Memory {
 public:
  // Takes the symbols of the program; reports those that are wrong.
  Memory(const Program& program, const Limits& limits, Diagnostics& diagnostics);

  const Limits& limits() const { return limits_; }
  std::span<const Symbol> userSymbols() const { return user_; }

  // The meaning of a word of an instruction; `contact`: may begin with @, % or !. Broken: has been reported.
  Operand operandOf(const Word& word, bool takes_query);
  // A name of the program, or of the numerical control. Null: none, not reported.
  const Symbol* find(std::string_view name);

 private:
  enum LineState : uint8_t { kNew, kBusy, kDone };
  void resolve(size_t line);
  bool beginsWithDouble(std::string_view text);
  void resolveNew(size_t line);
  bool readConstant(const Word& word, Operand& operand);
  bool readAddress(Word word, Address& address, bool in_declaration);
  bool readBase(const Word& word, Address& address, bool in_declaration);
  bool readBit(const Word& word, Address& address);
  bool readOffset(const Word& word, Address& address, bool in_declaration);
  bool checkRange(const Word& word, const Address& address);
  Report report(Diag diag, const Word& at, std::initializer_list<std::string_view> arguments) {
    return reportAt(diagnostics_, diag, at, arguments);
  }

  const Program& program_;
  Limits limits_;
  Diagnostics& diagnostics_;
  std::vector<Symbol> user_;  // by line; those that are broken have no name
  std::vector<LineState> states_;
  uint32_t depth_ = 0;                               // of symbols relative to symbols
  std::unordered_map<std::string, uint32_t> lines_;  // by upper-case name
  std::unordered_map<std::string, Symbol> nc_;       // those asked for
};

}  // namespace rung::importer::nct

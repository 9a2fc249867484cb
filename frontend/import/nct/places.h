// SPDX-License-Identifier: Apache-2.0
// The names in ST of the memory of an NCT program: located variables, and functions of the library nct for addresses
// that are known when the program runs. In: operands. Out: expressions, and the declarations of the variables that they
// need. Used by write.cpp.
#pragma once

#include <map>
#include <string>
#include <unordered_map>

#include "frontend/import/nct/memory.h"
#include "frontend/import/nct/pieces.h"

namespace rung::importer::nct {

enum class Part : uint8_t { Bit, Word, Double };
enum class Space : uint8_t { Plc, TimeSlice };

class Places {
 public:
  // Variables without a line of their own are declared at the name of the program.
  Places(const Program& program, const Memory& memory) : program_(program), memory_(memory) {}

  // The located variable of a place whose address is static.
  std::string of(const Address& address, Part part, Space space);
  // DINT expressions for the effective word and the number of the bit.
  std::string wordOf(const Address& address);
  std::string bitOf(const Address& address);
  std::string asWord(const Operand& operand);     // DWORD
  std::string asInteger(const Operand& operand);  // DINT
  std::string asDouble(const Operand& operand);   // LREAL
  // `{w1} AND {w2}` of instructions.def.
  std::string filled(std::string_view pattern, std::span<const Operand> operands);

  // VAR_GLOBAL with the symbols of the program and all that was asked for, and the memory that is kept.
  void writeTo(xml::SourceMappedText& out);

 private:
  bool isName(std::string_view name) const;
  std::string wordAt(int32_t word);
  void declare(std::string_view name, Loc loc, Part part, int32_t word, uint8_t bit, Space space);

  const Program& program_;
  const Memory& memory_;
  std::unordered_map<uint64_t, std::string> places_;  // without a symbol
  std::map<std::string, const Symbol*> own_symbols_;  // of the numerical control, those that are used
  Pieces declarations_;
};

}  // namespace rung::importer::nct

// SPDX-License-Identifier: Apache-2.0
// Takes the operands of instructions and checks them: their kinds (instructions.def), what may be written, and that
// each output has one driver. In: elements, module after module. Out: operands, or errors. Used by write.cpp.
#pragma once

#include <map>
#include <set>

#include "frontend/import/nct/memory.h"

namespace rung::importer::nct {

// SCP reads this: a row of nc_scopes.def.
struct Scope {
  std::string_view name;
  int32_t last;  // of the first parameter; 0: without
};
std::span<const Scope> scopes();

class Operands {
 public:
  Operands(const Program& program, Memory& memory, Diagnostics& diagnostics)
      : program_(program), memory_(memory), diagnostics_(diagnostics) {}

  // Tells whether the elements that follow are those of Int0.
  void enterModule(bool is_int0) { in_int0_ = is_int0; }
  // The operands of an instruction, each checked against its kind. False: one is wrong, which has been reported.
  bool take(const Element& element, std::vector<Operand>& operands);
  // The text of a message with a constant number.
  bool checkMessage(const Element& element, std::span<const Operand> operands);
  // The service of MR or MW.
  void checkService(const Element& element, std::span<const Operand> operands);
  // These are known when all modules have been taken.
  void checkDrivers();
  // Bits of the PLC memory that elements with `!` drive.
  const std::set<std::pair<int32_t, uint8_t>>& owned() const { return owned_; }

 private:
  // The elements that drive an output, a timer or a counter.
  struct Driver {
    Loc loc;
    bool immediate;
    bool is_coil;  // not SET or RST
  };

  Operand takeOperand(const Element& element, const Word& word, char kind);
  bool checkAddress(const Element& element, Operand& operand, char kind);
  Operand takeLabel(const Word& word);
  Operand takeScope(const Word& word);
  void noteDriver(const Element& element, const Operand& operand, char kind);
  Report report(Diag diag, const Word& at, std::initializer_list<std::string_view> arguments) {
    return reportAt(diagnostics_, diag, at, arguments);
  }

  const Program& program_;
  Memory& memory_;
  Diagnostics& diagnostics_;
  bool in_int0_ = false;
  std::map<uint32_t, std::vector<Driver>> drivers_;
  std::set<std::pair<int32_t, uint8_t>> owned_;
  std::map<int32_t, Word> blocks_;  // of MR and MW, by their address
};

}  // namespace rung::importer::nct

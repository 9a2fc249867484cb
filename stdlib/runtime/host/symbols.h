// SPDX-License-Identifier: Apache-2.0
// Paths of variables, `Instance.var[1,2].field`. In: the module's symbol tables and its memory. Out:
// variables that can be read, printed and set. Used by inputs, traces, --set, task triggers and retain files.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "memory.h"
#include "modules/simulated.h"

namespace rung::host {

struct Variable {
  std::string path;
  const rung_type* type = nullptr;
  uint8_t* base = nullptr;
  uint32_t offset = 0;
  uint32_t flags = 0;          // rung_field_flags of the last field
  uint8_t bit = 255;           // BOOL inside an image or integer: 0..7, else 255
  std::vector<uint32_t> hops;  // each: follow the pointer stored there, then add this offset

  void setFlags(uint32_t of_field) {
    flags = of_field;
    if ((flags & RUNG_FIELD_BIT) != 0) bit = static_cast<uint8_t>((flags >> RUNG_FIELD_BIT_SHIFT & 15) - 1);
  }
  // The offset that a further field or element changes.
  uint32_t& lastOffset() { return hops.empty() ? offset : hops.back(); }
  // nullptr when a pointer on the path is null.
  uint8_t* address() const {
    uint8_t* at = base + offset;
    for (const uint32_t hop : hops) {
      at = *reinterpret_cast<uint8_t**>(at);
      if (at == nullptr) return nullptr;
      at += hop;
    }
    return at;
  }
};

class Symbols {
 public:
  Symbols(const LoadedModule& module, const Memory& memory);

  // False: `error` has the message ("did you mean" included).
  bool find(std::string_view path, Variable& variable, std::string& error) const;
  // Which variables inside another one.
  enum class Detail : uint8_t {
    Everything,
    Watched,  // of an axis: its set values, its actual position and its state
    Own       // as Watched, and of library blocks only the pins
  };
  // The elementary variables, enumerations and pointers inside `variable`, in order of declaration.
  void expand(const Variable& variable, std::vector<Variable>& to, Detail detail = Detail::Everything,
              size_t most = SIZE_MAX) const;
  // How many `expand` lists for a variable of this type.
  uint64_t count(const rung_type& type, Detail detail = Detail::Everything) const;
  // All program instances and their located variables, whole. With Detail::Own they are all elementary variables of all
  // programs, without in-outs, pointers, constants and the internal variables of library blocks.
  std::vector<Variable> programRoots() const;
  // `module.wire` of a simulated module, which outlives this.
  void addTerminal(std::string_view module, Terminal& wire);
  // Every root, whole.
  std::vector<Variable> roots() const;
  Variable root(uint32_t symbol) const;

  const LoadedModule& module() const { return module_; }
  const char* text(uint32_t offset) const { return module_.strings + offset; }

 private:
  bool findAddress(std::string_view path, Variable& variable, std::string& error) const;
  bool enter(Variable& variable, std::string_view name, std::vector<std::string_view>& names) const;
  bool step(Variable& variable, std::string_view& rest, std::string& error) const;
  bool stepToTarget(Variable& variable, std::string_view& rest, std::string& error) const;
  bool stepToElement(Variable& variable, std::string_view& rest, std::string& error) const;
  bool stepToBit(Variable& variable, std::string_view name, std::string& error) const;
  bool stepToField(Variable& variable, std::string_view name, std::string& error) const;
  bool isListed(const rung_type& type, const rung_field& field, Detail detail) const;
  std::string inPrograms(std::string_view path) const;

  const LoadedModule& module_;
  const Memory& memory_;
  std::unordered_map<std::string, uint32_t> roots_;      // lower case, with and without their prefixes
  std::unordered_map<std::string, Variable> terminals_;  // by path in lower case
  std::unordered_set<uint32_t> shared_names_;            // of symbols whose name alone is that of another one too
};

// "; did you mean `x`?" for the candidate nearest to `written`, or empty.
std::string didYouMean(std::string_view written, const std::vector<std::string_view>& candidates);
std::string backquoted(std::string_view text);  // `text` in backquotes, as messages quote it
std::string lowerCase(std::string_view text);
// Splits at commas outside of brackets and quotes, and trims blanks around the parts.
std::vector<std::string> splitList(std::string_view list);

}  // namespace rung::host

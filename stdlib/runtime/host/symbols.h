// SPDX-License-Identifier: Apache-2.0
// Paths of variables, `Instance.var[1,2].field`. In: the module's symbol tables and its memory. Out:
// variables that can be read, printed and set. Used by inputs, traces, --set, task triggers and retain files.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "memory.h"
#include "modules/simulated.h"
#include "rung/monitor.h"

namespace rung::host {

// A variable in the memory that all tasks share, or in other memory that a context describes.
struct Variable : rung_variable {
  std::string path;
  const rung_context* context = nullptr;

  Variable() : rung_variable{} {}
  bool isEmpty() const { return type == nullptr; }
  // nullptr when a pointer on the path is null.
  uint8_t* address() const { return static_cast<uint8_t*>(rung_address(context, this)); }
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
  // The variables with the same paths in the memory of this version of the program; one that it does not have becomes
  // empty, and its path is returned.
  std::vector<std::string> findAgain(std::vector<Variable>& variables) const;
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
  // In the memory that all tasks share, not a terminal.
  bool isShared(const Variable& variable) const { return variable.context == &memory_.common(); }

  const LoadedModule& module() const { return module_; }
  const char* text(uint32_t offset) const { return module_.strings + offset; }

 private:
  void appendStep(std::string& path, std::string_view step, uint32_t detail) const;
  std::string explainRoot(rung_path_error problem, std::string_view path, uint32_t area) const;
  std::string explainStep(rung_path_error problem, const rung_path& rest, const Variable& variable) const;
  std::string explainIndices(rung_path_error problem, const rung_path& rest, const Variable& variable) const;
  void fieldNames(const rung_type& record, std::vector<std::string_view>& names) const;
  bool isListed(const rung_type& type, const rung_field& field, Detail detail) const;
  std::string inPrograms(std::string_view path) const;

  const LoadedModule& module_;
  const Memory& memory_;
  std::unordered_map<std::string, Variable> terminals_;  // by path in lower case
  std::vector<void*> terminal_blocks_;                   // a block for each
  rung_context terminal_context_{};
};

// "; did you mean `x`?" for the candidate nearest to `written`, or empty.
std::string didYouMean(std::string_view written, const std::vector<std::string_view>& candidates);
std::string backquoted(std::string_view text);  // `text` in backquotes, as messages quote it
// `Main.items[..].x` of `Main.items[3].x`: a changed array is one change.
std::string withoutIndices(const std::string& path);
std::string lowerCase(std::string_view text);
bool isBlank(char c);                             // a blank, a tab or a carriage return
std::string_view trimmed(std::string_view text);  // without blanks at both ends
// Splits at commas outside of brackets and quotes, and trims blanks around the parts.
std::vector<std::string> splitList(std::string_view list);

}  // namespace rung::host

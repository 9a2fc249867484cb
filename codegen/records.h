// SPDX-License-Identifier: Apache-2.0
// Where the struct of each record is defined. In: the records that each source of the module needs complete. Out:
// their definitions as C++ (cxx/nodes.h). Called by emit.cpp, after the bodies were written.
//
// A record that few sources use is written into each of them, after the records that it holds: a change of its fields
// then recompiles exactly its users, g++ opens no file for it, and a project of thousands of blocks makes few files
// (39 instead of 989 for 100 000 lines, and g++ parses a fifth less). A record that more than kMaxCopies sources use
// has its own header, so that the code stays linear in the project. Where sources are bundled (EmitOptions), a record
// that two use has a header too. The layout is asserted once, beside its code.
#pragma once

#include <string>
#include <vector>

#include "codegen/cxx/nodes.h"
#include "codegen/emit.h"
#include "codegen/facts.h"

namespace rung::codegen {

class RecordDefinitions {
 public:
  RecordDefinitions(const ir::Module& module, const Facts& facts, std::string_view name_space, bool bundled);

  // A source needs these complete. `shared`: it is itself a header, which must not repeat their definitions.
  void need(const std::vector<TypeId>& records, bool shared);

  // Called after all `need`: the headers that such a source includes, and the definitions that it writes itself.
  void collect(const std::vector<TypeId>& records, std::vector<std::string>& includes, cxx::Tree& tree,
               cxx::Declarations& definitions);
  void appendHeaders(std::vector<OutputFile>& files);

 private:
  static constexpr uint32_t kMaxCopies = 4;
  bool hasHeader(uint32_t row) const { return copies_[row] > max_copies_; }
  template <class F>
  void forEachHeld(const std::vector<TypeId>& records, bool into_headers, F&& f);  // each once, held records first
  template <class F>
  void visit(uint32_t row, bool into_headers, F& f);
  const std::string& definition(uint32_t row);
  void define(uint32_t row, cxx::Tree& tree, cxx::Declarations& to) const;
  const std::vector<uint32_t>& held(uint32_t row);

  const ir::Module& module_;
  const Facts& facts_;
  std::string name_space_;
  uint32_t max_copies_;
  std::vector<uint32_t> row_of_;  // by type: index into module.records + 1
  std::vector<uint32_t> copies_, seen_, held_seen_;
  std::vector<std::vector<uint32_t>> held_;
  std::vector<uint8_t> is_held_known_;
  std::vector<std::string> definitions_;  // printed; empty: not yet
  cxx::Tree tree_;                        // of one definition after the other
  uint32_t round_ = 0, held_round_ = 0;
};

}  // namespace rung::codegen

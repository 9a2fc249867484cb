// SPDX-License-Identifier: Apache-2.0
// Finds what a test of a program needs: the POUs and global variables that it reaches by their names. In: the source.
// Out: what stays and what is left out. Called by neutral.cpp.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tools/conformance/edits.h"
#include "tools/conformance/source.h"

namespace rung::conformance {

// A variable in VAR_GLOBAL of a file, a configuration or a resource.
struct Global {
  std::string key, name, type;
  bool constant;
  size_t section;  // index in Declarations::sections; kOfConfiguration
};
constexpr size_t kOfConfiguration = SIZE_MAX;

struct Needs {
  std::set<std::string> names;
  std::vector<DeclId> left_out;
  std::set<size_t> sections;  // of globals

  bool has(DeclId id) const;
};

class Declarations {
 public:
  // `form`: the standard's form, in which the types of globals are written.
  Declarations(const Source& source, const std::vector<Edit>& form);

  // Of no test: all of the file.
  Needs needsOf(DeclId test) const;
  // The names in a part of the text, in upper case; those after a point are members.
  void addNames(size_t from, size_t to, std::set<std::string>& names) const;
  // `PROGRAM p WITH t : Main;` of a configuration: a test runs alone. As edits that remove them.
  std::vector<Edit> instancesOf(DeclId configuration) const;
  bool hasPragma(DeclId id, std::string_view name) const;
  bool isTest(DeclId id) const;

  std::vector<DeclId> sections;  // VAR_GLOBAL of the file
  std::vector<Global> globals;   // each name once

 private:
  void noteGlobals(DeclId id, size_t section, const std::vector<Edit>& form);
  void noteMembers(Slice<DeclId> members, const std::vector<Edit>& form);
  void keepUnnamed(Needs& needs) const;
  void addConfigurationNames(DeclId id, std::set<std::string>& names) const;

  const Source& source_;
  const Tree& tree_;
  const std::vector<std::pair<size_t, size_t>> networks_;
};

}  // namespace rung::conformance

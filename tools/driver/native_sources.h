// SPDX-License-Identifier: Apache-2.0
// The C++ files of a project's native blocks: `native/*.cpp` and `native/*.h` in each folder that is compiled or
// searched for libraries. In: the folders. Out: their texts, which are compiled with the generated code. Called by
// compile.cpp.
#pragma once

#include <string>
#include <vector>

#include "codegen/emit.h"
#include "frontend/source/files.h"
#include "ir/ir.h"
#include "tools/driver/inputs.h"
#include "tools/driver/libraries.h"

namespace rung::driver {

class NativeSources {
 public:
  // The error names the file that could not be read.
  [[nodiscard]] std::string read(Inputs& inputs, const LibrarySet& libraries, Sources& sources);

  // Adds the files that the module's native bodies need: those of the project, and of each library that it uses.
  void addTo(std::vector<codegen::OutputFile>& files, const ir::Module& module, const Sources& sources) const;

  bool empty() const { return sources_.empty(); }
  // Tells whether some file has the word.
  bool mention(std::string_view function, const Sources& sources) const;

 private:
  struct Source {
    std::string library;  // empty: of the project
    std::string name;     // pump.cpp
    FileId file;
  };
  [[nodiscard]] std::string readFolder(const std::string& folder, const std::string& library, Inputs& inputs,
                                       Sources& sources);

  std::vector<Source> sources_;
};

// Tells whether the C function of a native body is part of Rung's runtime.
bool isNativeOfRung(std::string_view function);

}  // namespace rung::driver

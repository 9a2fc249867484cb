// SPDX-License-Identifier: Apache-2.0
// A compiled project loaded into this process. In: the path of a shared object. Out: its module descriptions.
// Called by run and test.
#pragma once

#include <string>

#include "rung/module.h"

namespace rung::driver {

// Tells whether this process can load a shared object: not where it is linked statically.
bool loadsCode();

class ModuleLibrary {
 public:
  ModuleLibrary() = default;
  ModuleLibrary(const ModuleLibrary&) = delete;
  ModuleLibrary& operator=(const ModuleLibrary&) = delete;
  ~ModuleLibrary();

  [[nodiscard]] std::string open(const std::string& path);
  // `<name>_module()`; null, with `error`, when it is missing or has another version.
  const rung_module* find(const std::string& name, std::string& error) const;

 private:
  void* handle_ = nullptr;
};

}  // namespace rung::driver

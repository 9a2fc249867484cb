// SPDX-License-Identifier: Apache-2.0
// A compiled project loaded into this process; see module_library.h.
#include "tools/driver/module_library.h"

#include <dlfcn.h>

namespace rung::driver {

ModuleLibrary::~ModuleLibrary() {
  if (handle_ != nullptr) dlclose(handle_);
}

std::string ModuleLibrary::open(const std::string& path) {
  handle_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ != nullptr) return {};
  const char* why = dlerror();
  return std::string("cannot load the compiled program: ") + (why == nullptr ? path.c_str() : why);
}

const rung_module* ModuleLibrary::find(const std::string& name, std::string& error) const {
  const std::string symbol = name + "_module";
  void* address = dlsym(handle_, symbol.c_str());
  if (address == nullptr) {
    error = "the compiled program has no `" + symbol + "`";
    return nullptr;
  }
  const rung_module* module = reinterpret_cast<rung_module_function>(address)();
  if (module->abi == RUNG_MODULE_ABI) return module;
  error = "the compiled program has module interface " + std::to_string(module->abi) + ", this rung has " +
          std::to_string(RUNG_MODULE_ABI);
  return nullptr;
}

}  // namespace rung::driver

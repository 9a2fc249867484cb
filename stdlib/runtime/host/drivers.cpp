// SPDX-License-Identifier: Apache-2.0
// Devices of a product: see drivers.h.
#include "drivers.h"

#include <dlfcn.h>
#include <algorithm>
#include <cstring>

namespace rung::host {
namespace {

constexpr uint32_t kInputs = 0, kOutputs = 1;

bool fits(const LoadedModule& module, uint32_t area, uint32_t offset, uint32_t size) {
  return size == 0 || (area < module.areas.size() && uint64_t{offset} + size <= module.areas[area].size);
}

}  // namespace

bool Drivers::load(const std::string& spec, std::string& error) {
  const size_t equals = spec.find('=');
  std::string path = spec.substr(0, equals);
  if (path.find('/') == std::string::npos) path.insert(0, "./");  // not a library of the system
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return error = dlerror(), false;
  const char* const argument = equals == std::string::npos ? "" : spec.c_str() + equals + 1;
  using Drivers = const rung_driver* (*)(const char*, uint32_t*);
  using Drives = const rung_drives* (*)(const char*, void**);
  const auto drivers = reinterpret_cast<Drivers>(dlsym(library, "rung_drivers"));
  using Control = const rung_nc* (*)(const char*, void**);
  const auto drives = reinterpret_cast<Drives>(dlsym(library, "rung_axis_drives"));
  const auto control = reinterpret_cast<Control>(dlsym(library, "rung_numerical_control"));
  if (drivers == nullptr && drives == nullptr && control == nullptr)
    return error = path + ": it has no function `rung_drivers`, `rung_axis_drives` or `rung_numerical_control`", false;
  if (drives != nullptr && drives_ != nullptr) return error = path + ": another library has drives", false;
  if (control != nullptr && control_ != nullptr) return error = path + ": another library has a control", false;
  if (drives != nullptr) drives_ = drives(argument, &drives_data_);
  if (control != nullptr) control_ = control(argument, &control_data_);
  uint32_t count = 0;
  const rung_driver* const all = drivers == nullptr ? nullptr : drivers(argument, &count);
  if ((drivers != nullptr && all == nullptr) || (drives != nullptr && drives_ == nullptr) ||
      (control != nullptr && control_ == nullptr))
    return error = path + ": it refuses `" + spec + "`", false;
  for (uint32_t i = 0; i < count; ++i) drivers_.push_back({all + i, RUNG_NONE});
  return true;
}

void Drivers::serve(rung_host& host) const {
  host.drives = drives_;
  host.drives_data = drives_data_;
  host.nc = control_;
  host.nc_data = control_data_;
}

void Drivers::simulateModules(Symbols& symbols, Hsio& hsio, rung_diagnosis& diagnosis) {
  for (uint32_t i = 0; i < module_->io_modules.size(); ++i) {
    const rung_io_module& row = module_->io_modules[i];
    const char* const name = module_->strings + row.name;
    const auto serves = [&](const Bound& bound) { return strcasecmp(bound.driver->name, name) == 0; };
    const ModuleType* const type = findModuleType(module_->strings + row.type, module_->strings[row.station] != 0);
    if (type == nullptr || std::any_of(drivers_.begin(), drivers_.end(), serves)) continue;
    std::unique_ptr<SimulatedModule> module = simulate(*type, row.input_offset, row.output_offset, hsio);
    if (module == nullptr) continue;
    module->reportTo(diagnosis, i + 1);
    rung_driver driver{};
    driver.name = names_.emplace_back(name).c_str();
    if (row.task != RUNG_NONE)
      driver.task = names_.emplace_back(module_->strings + module_->tasks[row.task].name).c_str();
    driver.input_offset = module->inputOffset();
    driver.input_size = module->inputSize();
    driver.output_offset = module->outputOffset();
    driver.output_size = module->outputSize();
    driver.read = [](void* data, uint8_t* inputs, int64_t now_ns) {
      static_cast<SimulatedModule*>(data)->read(inputs, now_ns);
      return true;
    };
    driver.write = [](void* data, const uint8_t* outputs, int64_t now_ns) {
      static_cast<SimulatedModule*>(data)->write(outputs, now_ns);
      return true;
    };
    driver.stopped = [](void* data, int64_t) { static_cast<SimulatedModule*>(data)->stopped(); };
    driver.data = module.get();
    of_modules_.push_back(driver);
    modules_.push_back(std::move(module));
    drivers_.push_back({&of_modules_.back(), RUNG_NONE});
  }
  addTerminals(symbols);
}

void Drivers::addTerminals(Symbols& symbols) const {
  for (size_t i = 0; i < modules_.size(); ++i)
    for (Terminal& wire : modules_[i]->terminals()) symbols.addTerminal(of_modules_[i].name, wire);
}

std::string Drivers::simulatedNames() const {
  std::string names;
  for (const rung_driver& driver : of_modules_) names += (names.empty() ? "" : ", ") + std::string(driver.name);
  return names;
}

bool Drivers::bind(uint32_t fastest, std::string& error) {
  for (Bound& bound : drivers_) {
    const rung_driver& driver = *bound.driver;
    if (!fits(*module_, kInputs, driver.input_offset, driver.input_size) ||
        !fits(*module_, kOutputs, driver.output_offset, driver.output_size))
      return error = std::string("driver `") + driver.name + "`: the program has fewer inputs or outputs", false;
    bound.task = fastest == RUNG_NONE ? 0 : fastest;
    if (driver.task == nullptr) continue;
    bound.task = RUNG_NONE;
    for (uint32_t i = 0; i < module_->tasks.size(); ++i)
      if (strcasecmp(module_->strings + module_->tasks[i].name, driver.task) == 0) bound.task = i;
    if (bound.task == RUNG_NONE)
      return error = std::string("driver `") + driver.name + "`: there is no task `" + driver.task + "`", false;
  }
  return true;
}

std::string Drivers::readAll(int64_t now_ns) const {
  for (uint32_t task = 0; task < module_->tasks.size(); ++task)
    if (std::string lost = read(task, now_ns); !lost.empty()) return lost;
  return {};
}

std::string Drivers::read(uint32_t task, int64_t now_ns) const {
  for (const auto& [driver, own] : drivers_)
    if (own == task && driver->read != nullptr &&
        !driver->read(driver->data, memory_->area(kInputs) + driver->input_offset, now_ns))
      return driver->name;
  return {};
}

std::string Drivers::write(uint32_t task, int64_t now_ns) const {
  for (const auto& [driver, own] : drivers_)
    if (own == task && driver->write != nullptr &&
        !driver->write(driver->data, memory_->area(kOutputs) + driver->output_offset, now_ns))
      return driver->name;
  return {};
}

void Drivers::writeAll(int64_t now_ns) const {
  for (const auto& [driver, own] : drivers_) {
    if (driver->stopped != nullptr) driver->stopped(driver->data, now_ns);
    if (driver->write != nullptr) driver->write(driver->data, memory_->area(kOutputs) + driver->output_offset, now_ns);
  }
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
#include "tools/debug/values.h"

#include <strings.h>

#include <algorithm>
#include <cstring>

#include "stdlib/runtime/host/faults.h"
#include "stdlib/runtime/host/value_format.h"

namespace rung::debug {
namespace {

constexpr uint32_t kFrameBlock = 0, kInstanceBlock = 1;

bool isSame(std::string_view one, std::string_view other) {
  return one.size() == other.size() && strncasecmp(one.data(), other.data(), one.size()) == 0;
}

uint64_t elementsOf(const rung_module& module, const rung_type& array) {
  uint64_t count = 1;
  for (uint32_t i = 0; i < array.count; ++i) {
    const rung_dimension& dimension = *rung_dimension_at(&module, array.first + i);
    count *= static_cast<uint64_t>(dimension.high - dimension.low + 1);
  }
  return count;
}

// `[2,1]` of the element with this number.
std::string indicesOf(const rung_module& module, const rung_type& array, uint64_t number) {
  std::string text;
  for (uint32_t i = array.count; i-- > 0;) {
    const rung_dimension& dimension = *rung_dimension_at(&module, array.first + i);
    const auto extent = static_cast<uint64_t>(dimension.high - dimension.low + 1);
    text = std::to_string(dimension.low + static_cast<int64_t>(number % extent)) + (text.empty() ? "" : ",") + text;
    number /= extent;
  }
  return '[' + text + ']';
}

}  // namespace

bool Values::isOfCall(const Variable& variable) {
  return variable.storage == RUNG_IN_BLOCK && variable.index == kFrameBlock && variable.path.empty();
}

const Values::FrameMemory& Values::memoryOf(const DebugFrame& frame) {
  for (const FrameMemory& memory : memories_)
    if (memory.frame.fp == frame.fp && memory.frame.self == frame.self) return memory;
  FrameMemory& memory = memories_.emplace_back();
  memory.frame = frame;
  memory.blocks[kFrameBlock] = frame.fp;
  memory.blocks[kInstanceBlock] = frame.self;
  memory.context = execution_.session().context();
  memory.context.blocks = memory.blocks;
  return memory;
}

Variable Values::local(const DebugFrame& frame, const ir::interpreter::DebugLocal& local) {
  Variable variable;
  variable.type = rung_type_at(&module(), local.type);
  variable.bit = 255;
  variable.index = kFrameBlock;
  variable.offsets[0] = local.offset;
  variable.pointers = local.by_reference ? 1 : 0;
  variable.context = &memoryOf(frame).context;
  return variable;
}

bool Values::instanceOf(const DebugFrame& frame, Variable& variable) {
  const ir::interpreter::DebugBody& body = execution_.code().bodies()[frame.body];
  if (body.self == RUNG_NONE || frame.self == nullptr) return false;
  variable = {};
  variable.type = rung_type_at(&module(), body.self);
  variable.bit = 255;
  variable.index = kInstanceBlock;
  variable.context = &memoryOf(frame).context;
  return true;
}

ShownVariable Values::show(std::string name, const Variable& variable) const {
  ShownVariable shown;
  shown.name = std::move(name);
  shown.place = variable;
  shown.type = host::typeName(execution_.session().module(), *variable.type);
  const bool is_null = variable.address() == nullptr;
  switch (variable.type->kind) {
    case RUNG_RECORD: shown.named = variable.type->count; break;
    case RUNG_ARRAY: shown.indexed = elementsOf(module(), *variable.type); break;
    case RUNG_POINTER: {
      void* target = nullptr;
      if (!is_null) memcpy(&target, variable.address(), sizeof target);
      shown.named = target == nullptr || variable.type->element == RUNG_NONE ? 0 : 1;
      if (target == nullptr) shown.value = "NULL";
      break;
    }
    default: break;
  }
  if (is_null) {
    shown.named = shown.indexed = 0;
    shown.value = "NULL";
  } else if (shown.value.empty()) {
    if (variable.type->kind == RUNG_RECORD || variable.type->kind == RUNG_ARRAY)
      shown.value = shown.type;
    else
      host::formatValue(execution_.session().module(), variable, shown.value);
  }
  return shown;
}

std::vector<ShownVariable> Values::locals(const DebugFrame& frame) {
  std::vector<ShownVariable> all;
  for (const ir::interpreter::DebugLocal& one : execution_.code().bodies()[frame.body].locals)
    all.push_back(show(one.name, local(frame, one)));
  return all;
}

std::vector<ShownVariable> Values::instance(const DebugFrame& frame) {
  Variable self;
  if (!instanceOf(frame, self)) return {};
  return inside(self, 0, UINT64_MAX);
}

std::vector<ShownVariable> Values::globals() {
  std::vector<ShownVariable> all;
  for (const Variable& root : execution_.session().symbols().roots()) all.push_back(show(root.path, root));
  return all;
}

std::vector<ShownVariable> Values::image() {
  std::vector<ShownVariable> all;
  std::string error;
  for (uint32_t i = 0; i < module().areas.count; ++i) {
    const rung_area& area = *rung_area_at(&module(), i);
    for (uint32_t byte = 0; byte < area.size; ++byte) {
      const std::string path = std::string(module().strings + area.prefix) + 'B' + std::to_string(byte);
      Variable variable;
      if (execution_.session().symbols().find(path, variable, error)) all.push_back(show(path, variable));
    }
  }
  return all;
}

std::vector<ShownVariable> Values::inside(const Variable& variable, uint64_t start, uint64_t count) const {
  std::vector<ShownVariable> all;
  std::string error;
  const rung_type& type = *variable.type;
  const auto add = [&](const std::string& name, const std::string& text) {
    Variable part = variable;
    if (step(part, text, error)) all.push_back(show(name, part));
  };
  if (type.kind == RUNG_POINTER) add("^", "^");
  if (type.kind == RUNG_ARRAY) {
    const uint64_t total = elementsOf(module(), type);
    for (uint64_t i = start; i < total && i - start < count; ++i) {
      const std::string indices = indicesOf(module(), type, i);
      add(indices, indices);
    }
  }
  if (type.kind != RUNG_RECORD) return all;
  for (uint32_t i = 0; i < type.count; ++i) {
    const rung_field& field = *rung_field_at(&module(), type.first + i);
    if ((field.flags & RUNG_FIELD_BASE) != 0) {
      Variable base = variable;
      base.type = rung_type_at(&module(), field.type);
      base.offsets[base.pointers] += field.offset;
      for (ShownVariable& inherited : inside(base, 0, UINT64_MAX)) all.push_back(std::move(inherited));
    } else {
      const std::string name = module().strings + field.name;
      if (!name.starts_with("__")) add(name, '.' + name);  // those of the compiler: the type of an object
    }
  }
  if (start == 0 && count == UINT64_MAX) return all;
  all.erase(all.begin(), all.begin() + static_cast<ptrdiff_t>(std::min<uint64_t>(start, all.size())));
  if (all.size() > count) all.resize(count);
  return all;
}

bool Values::step(Variable& variable, const std::string& text, std::string& error) const {
  rung_path path{text.data(), text.data() + text.size(), 0};
  while (path.at != path.end) {
    const char* const before = path.at;
    rung_path_error problem = rung_find_step(&module(), &path, &variable);
    if (problem == RUNG_PATH_OK) continue;
    const std::string rest(before, path.end);
    if (variable.type->kind == RUNG_POINTER && rest[0] != '^') {  // of a reference
      Variable target = variable;
      if (step(target, '^' + rest, error)) return variable = target, true;
    }
    error = "there is no `" + rest + "` in a variable of type " +
            host::typeName(execution_.session().module(), *variable.type);
    return false;
  }
  return true;
}

bool Values::find(const DebugFrame* frame, std::string_view name, Variable& variable) {
  std::string error;
  if (frame != nullptr) {
    for (const ir::interpreter::DebugLocal& one : execution_.code().bodies()[frame->body].locals)
      if (isSame(one.name, name)) return variable = local(*frame, one), true;
    Variable self;
    if (instanceOf(*frame, self) && step(self, '.' + std::string(name), error)) return variable = self, true;
    const std::string path = instancePath(*frame);  // a located variable of a program
    if (!path.empty() && execution_.session().symbols().find(path + '.' + std::string(name), variable, error))
      return true;
  }
  return execution_.session().symbols().find(name, variable, error);
}

std::string Values::instancePath(const DebugFrame& frame) const {
  if (frame.self == nullptr) return "";
  const uint32_t self = execution_.code().bodies()[frame.body].self;
  if (self == RUNG_NONE) return "";
  const char* const type = module().strings + rung_type_at(&module(), self)->name;
  return host::instancePath(execution_.session().context(), type, frame.self);
}

std::string Values::nameOf(const DebugFrame& frame) const {
  const std::string pou = execution_.code().bodies()[frame.body].name;
  const std::string path = instancePath(frame);
  return path.empty() || isSame(path, pou) ? pou : pou + " (" + path + ')';
}

}  // namespace rung::debug

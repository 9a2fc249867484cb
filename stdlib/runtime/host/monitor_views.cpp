// SPDX-License-Identifier: Apache-2.0
// The bodies of the program for clients of the monitor: see monitor_views.h.
#include "monitor_views.h"

#include <map>

#include "json.h"
#include "rung/monitor.h"
#include "symbols.h"

namespace rung::host {
namespace {

constexpr uint32_t kLongestInstance = 4096;
constexpr size_t kMostInstances = 1000;  // of a block

using Instances = std::map<std::string, Json::Array>;  // by the block in lower case

struct Collecting {
  const LoadedModule& module;
  Instances& instances;
};

// Each record whose type has the name of a block; of a derived one also for its bases, whose path is the same.
rung_walk collect(void* data, const rung_part* part) {
  auto& [module, instances] = *static_cast<Collecting*>(data);
  const rung_type& type = *part->variable->type;
  if ((part->variable->flags & (RUNG_FIELD_NO_EXTERNAL_READ | RUNG_FIELD_BY_REFERENCE)) != 0) return RUNG_WALK_SKIP;
  if (type.kind == RUNG_RECORD) {
    const auto of = instances.find(lowerCase(module.strings + type.name));
    if (of != instances.end() && of->second.size() < kMostInstances)
      of->second.emplace_back(std::string_view(part->path, part->path_size));
  }
  return RUNG_WALK_ENTER;
}

}  // namespace

std::string listPous(const LoadedModule& module, const std::vector<rung_pou_view>& pous) {
  Instances instances;
  for (const rung_pou_view& pou : pous) instances[lowerCase(pou.block)];
  Collecting collecting{module, instances};
  std::string path(kLongestInstance, '\0');
  for (uint32_t i = 0; i < module.symbols.size(); ++i) {
    rung_variable variable;
    rung_variable_of_symbol(&module.description, i, &variable);
    if (rung_path_of_symbol(&module.description, i, path.data(), kLongestInstance) != 0)
      rung_walk_variable(&module.description, &variable, path.data(), kLongestInstance, collect, &collecting);
  }
  Json::Array list;
  for (const rung_pou_view& pou : pous)
    list.push_back(Json{{"name", pou.name},
                        {"block", pou.block},
                        {"language", pou.language},
                        {"instances", instances[lowerCase(pou.block)]}});
  return Json(std::move(list)).toText();
}

const rung_pou_view* findPou(const std::vector<rung_pou_view>& pous, std::string_view name) {
  for (const rung_pou_view& pou : pous)
    if (lowerCase(pou.name) == lowerCase(name)) return &pou;
  return nullptr;
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// An online change: see change.h.
#include "change.h"

#include <cstring>

#include "symbols.h"

namespace rung::host {
namespace {

constexpr uint32_t kPathCapacity = 4096;

std::string reasonOf(const rung_change_note& note) {
  const std::string before = note.old_text, now = note.new_text;
  switch (note.reason) {
    case RUNG_REASON_NEW: return "it is new";
    case RUNG_REASON_TYPE: return "its type was " + before + " and is " + now;
    case RUNG_REASON_ELEMENTS: return "elements that only one of " + before + " and " + now + " has";
    case RUNG_REASON_MISSING: return "the program does not have it any more";
    case RUNG_REASON_POINTER:
      return "it points to `" + before + "`, which the program does not have any more in this form";
    case RUNG_REASON_ADDRESS:
      return "its value is the address of `" + before + "`, which moves; a POINTER would follow";
    case RUNG_REASON_DYNAMIC: return "objects of __NEW exist, and types change; __DELETE them first";
    case RUNG_REASON_TABLES: return "the program was built without --online-change";
  }
  return "";
}

void append(std::string& text, const char* what, const std::vector<ChangeReport::Item>& items) {
  constexpr size_t kMost = 20;
  for (size_t i = 0; i < items.size() && i < kMost; ++i)
    text +=
        "  " + std::string(what) + (items[i].path.empty() ? "" : " " + items[i].path) + ": " + items[i].reason + '\n';
  if (items.size() > kMost) text += "  " + std::string(what) + " " + std::to_string(items.size() - kMost) + " more\n";
}

}  // namespace

std::string ChangeReport::text() const {
  if (!error.empty()) {
    std::string reasons;
    append(reasons, "refused", refused);
    return reasons;
  }
  std::string text =
      std::to_string(kept) + (kept == 1 ? " variable keeps its value\n" : " variables keep their values\n");
  append(text, "initialised", initialised);
  append(text, "removed", removed);
  append(text, "refused", refused);
  for (const std::string& path : unforced) text += "  not forced any more " + path + '\n';
  return text;
}

Change::Change(const LoadedModule& old_module, const LoadedModule& module)
    : old_module_(old_module),
      module_(module),
      path_(kPathCapacity),
      target_(kPathCapacity),
      same_(old_module.types.size()),
      kept_(module.blocks.size()) {
  size_t bytes = 0;
  for (const rung_area& area : old_module.areas) bytes += area.size;
  image_.resize(bytes);
  plan_.old_module = &old_module.description;
  plan_.module = &module.description;
  plan_.path = path_.data();
  plan_.target = target_.data();
  plan_.path_capacity = kPathCapacity;
  plan_.same = same_.data();
  plan_.kept = kept_.data();
  plan_.image = image_.data();
  plan_.data = this;
}

void Change::onNote(void* data, const rung_change_note* note) {
  ChangeReport& report = static_cast<Change*>(data)->report_;
  std::vector<ChangeReport::Item>& items = note->kind == RUNG_IS_INITIALISED ? report.initialised
                                           : note->kind == RUNG_IS_REMOVED   ? report.removed
                                                                             : report.refused;
  items.push_back({note->path, reasonOf(*note)});
}

bool Change::refuse(std::string path, std::string reason) {
  report_.refused.push_back({std::move(path), std::move(reason)});
  return false;
}

// Devices are served by drivers, which stay; so does the shape of the image.
bool Change::compareDevices() {
  if (old_module_.areas.size() != module_.areas.size()) return refuse("", "the memory areas of the project differ");
  bool is_same = old_module_.io_modules.size() == module_.io_modules.size();
  for (uint32_t i = 0; is_same && i < module_.io_modules.size(); ++i) {
    const rung_io_module &before = old_module_.io_modules[i], &now = module_.io_modules[i];
    const auto same = [&](uint32_t rung_io_module::*text) {
      return std::strcmp(old_module_.strings + before.*text, module_.strings + now.*text) == 0;
    };
    is_same = same(&rung_io_module::name) && same(&rung_io_module::type) && same(&rung_io_module::station) &&
              before.input_offset == now.input_offset && before.output_offset == now.output_offset;
  }
  return is_same || refuse("", "the devices of the project differ; end the program and run it again");
}

bool Change::plan() {
  if (!compareDevices()) return false;
  rung_plan_change(&plan_);  // counts
  moves_.resize(plan_.move_count);
  holders_.resize(plan_.holder_count);
  plan_.moves = moves_.data();
  plan_.holders = holders_.data();
  plan_.move_capacity = plan_.move_count;
  plan_.holder_capacity = plan_.holder_count;
  plan_.note = onNote;
  const bool is_possible = rung_plan_change(&plan_);
  report_.kept = plan_.kept_count;
  return is_possible;
}

bool Change::check(const rung_context& old_context) { return rung_check_change(&plan_, &old_context); }

}  // namespace rung::host

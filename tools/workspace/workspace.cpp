// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/workspace.h"

#include <utility>

namespace rung::workspace {

Snapshot::Snapshot(driver::ProjectOptions options, const std::atomic<bool>* cancelled)
    : compilation_(std::move(options), times_, sink_) {
  compilation_.cancelled = cancelled;
  compilation_.check();
  compilation_.cancelled = nullptr;
  compilation_.finish();
}

std::shared_ptr<const Snapshot> Workspace::apply(std::vector<Change> changes, const std::atomic<bool>* cancelled) {
  for (Change& change : changes) {
    if (change.text)
      open_[change.path] = std::move(*change.text);
    else
      open_.erase(change.path);
  }
  driver::ProjectOptions options = options_;
  for (const auto& [path, text] : open_) options.unsaved.push_back({path, text});
  auto made = std::make_shared<const Snapshot>(std::move(options), cancelled);
  if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) return nullptr;
  return current_ = std::move(made);
}

}  // namespace rung::workspace

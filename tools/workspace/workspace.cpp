// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/workspace.h"

#include <utility>

namespace rung::workspace {

std::shared_ptr<const Snapshot> Workspace::apply(std::vector<Change> changes, const std::atomic<bool>* cancelled) {
  for (const Change& change : changes) {
    if (change.text)
      open_[change.path] = *change.text;
    else
      open_.erase(change.path);
  }
  if (editInPlace(changes, cancelled)) return current();
  lacks_changes_ = true;
  if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) return nullptr;
  driver::ProjectOptions options = options_;
  for (const auto& [path, text] : open_) options.unsaved.push_back({path, text});
  auto made = std::make_shared<Analysis>(std::move(options), cancelled);
  if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) return nullptr;
  analysis_ = std::move(made);
  lacks_changes_ = false;
  current_.reset();
  return current();
}

// Whether the last analysis has the change now. It is gone when it does not, and is not as it was.
bool Workspace::editInPlace(const std::vector<Change>& changes, const std::atomic<bool>* cancelled) {
  if (!analysis_ || lacks_changes_ || changes.size() != 1 || !changes[0].text) return false;
  if (analysis_->readers.load(std::memory_order_acquire) != 0) return false;
  const bool is_done = analysis_->edit(changes[0].path, *changes[0].text, cancelled);
  if (is_done && (cancelled == nullptr || !cancelled->load(std::memory_order_relaxed))) return true;
  analysis_.reset();
  return false;
}

std::shared_ptr<const Snapshot> Workspace::current() {
  std::shared_ptr<const Snapshot> snapshot = current_.lock();
  if (!snapshot && analysis_) current_ = snapshot = std::make_shared<const Snapshot>(analysis_);
  return snapshot;
}

}  // namespace rung::workspace

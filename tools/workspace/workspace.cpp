// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/workspace.h"

#include <utility>

#include "tools/workspace/process_copy.h"

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
  if (!analysis_ || lacks_changes_ || analysis_->readers.load(std::memory_order_acquire) != 0) return false;
  std::map<std::string, std::string> texts;
  for (const Change& change : changes) {
    if (!change.text) return false;
    texts[change.path] = *change.text;
  }
  // A body that was changed is known, also to who does not want it any more: the next key goes on from there.
  if (!texts.empty() && analysis_->edit(texts, cancelled)) return true;
  analysis_.reset();
  return false;
}

std::optional<std::vector<std::string>> Workspace::errorsOf(sema::PouId pou,
                                                            const std::vector<std::string>& statements) const {
  if (!analysis_) return std::nullopt;
  if (analysis_->staysUsable(pou, statements)) return analysis_->errorsOf(pou, statements);
  return errorsInCopy(pou, statements);
}

std::optional<std::vector<std::string>> Workspace::errorsInCopy(sema::PouId pou,
                                                                const std::vector<std::string>& statements) const {
  if (!analysis_) return std::nullopt;
  const std::optional<std::string> lines = inProcessCopy([&] {
    std::string all;
    for (const std::string& errors : analysis_->errorsOf(pou, statements)) all += errors + "\n";
    return all;
  });
  if (!lines) return std::nullopt;
  std::vector<std::string> found;
  for (size_t at = 0; at < lines->size();) {
    const size_t end = lines->find('\n', at);
    found.push_back(lines->substr(at, end - at));
    at = end + 1;
  }
  if (found.size() != statements.size()) return std::nullopt;
  return found;
}

std::optional<std::string> Workspace::goodTypes(const Analysis::TypeTrial& trial) const {
  if (!analysis_) return std::nullopt;
  std::optional<std::string> good = inProcessCopy([&] { return analysis_->goodTypes(trial); });
  return good && good->size() == trial.types.size() ? good : std::nullopt;
}

std::optional<std::string> Workspace::inTrial(const std::map<std::string, std::string>& texts,
                                              FunctionRef<std::string(std::shared_ptr<const Snapshot>)> use) {
  return inProcessCopy([&] {
    if (analysis_) analysis_->makeLast();
    if (!analysis_ || lacks_changes_ || !analysis_->edit(texts, nullptr)) {
      driver::ProjectOptions options = options_;
      std::map<std::string, std::string> open = open_;
      for (const auto& [path, text] : texts) open[path] = text;
      for (const auto& [path, text] : open) options.unsaved.push_back({path, text});
      analysis_ = std::make_shared<Analysis>(std::move(options), nullptr);
    }
    return use(std::make_shared<const Snapshot>(analysis_));
  });
}

std::shared_ptr<const Snapshot> Workspace::current() {
  std::shared_ptr<const Snapshot> snapshot = current_.lock();
  if (!snapshot && analysis_) current_ = snapshot = std::make_shared<const Snapshot>(analysis_);
  return snapshot;
}

}  // namespace rung::workspace

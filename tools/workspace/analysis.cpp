// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/analysis.h"

#include <algorithm>
#include <utility>

#include "sema/project.h"
#include "tools/driver/file_provider.h"

namespace rung::workspace {
namespace {

// Words by which the tree may grow with what is replaced, before it is made again: 32 MB.
constexpr uint32_t kMostGarbage = 8 << 20;

uint64_t nextRevision() {
  static std::atomic<uint64_t> last = 0;
  return ++last;
}

}  // namespace

Analysis::Analysis(driver::ProjectOptions options, const std::atomic<bool>* cancelled)
    : revision(nextRevision()), compilation_(std::move(options), times_, sink_) {
  compilation_.is_edited = true;
  compilation_.cancelled = cancelled;
  compilation_.check();
  compilation_.cancelled = nullptr;
  compilation_.finish();
  first_size_ = compilation_.writtenSize();
  checked_size_ = compilation_.tree.size();
}

bool Analysis::edit(const std::string& path, const std::string& text, const std::atomic<bool>* cancelled) {
  if (!compilation_.checked || !sink_.error_text.empty()) return false;
  EditedFile* const edited = editedFile(path);
  if (edited == nullptr) return false;
  const bool has_room = compilation_.tree.size() < checked_size_ + kMostGarbage;
  const bool is_done = (has_room && edited->replace(text)) || checkAgain(*edited, text, cancelled);
  if (is_done) compilation_.finish();
  return is_done;
}

EditedFile* Analysis::editedFile(const std::string& path) {
  const std::string absolute = driver::absolutePath(path);
  const auto known = edited_.find(absolute);
  if (known != edited_.end()) return &known->second;
  const std::vector<driver::InputFile>& files = compilation_.inputs.files;
  const auto file = std::find_if(files.begin(), files.end(), [&](const driver::InputFile& candidate) {
    return driver::absolutePath(candidate.path) == absolute;
  });
  return file == files.end() ? nullptr : &edited_.try_emplace(absolute, compilation_, file->file).first->second;
}

// Parses the edited files alone.
bool Analysis::checkAgain(EditedFile& edited, const std::string& text, const std::atomic<bool>* cancelled) {
  if (compilation_.writtenSize() > first_size_ + kMostGarbage || compilation_.asksForNames() || !edited.take(text))
    return false;
  std::vector<FileId> changed;
  for (const auto& [path, file] : edited_) changed.push_back(file.file());
  compilation_.cancelled = cancelled;
  const bool is_done = compilation_.checkAgain(changed);
  compilation_.cancelled = nullptr;
  for (auto& [path, file] : edited_) file.release();
  edited_.clear();
  checked_size_ = compilation_.tree.size();
  revision = nextRevision();
  return is_done;
}

}  // namespace rung::workspace

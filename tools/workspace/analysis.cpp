// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/analysis.h"

#include <algorithm>
#include <utility>

#include "sema/project.h"
#include "tools/driver/file_provider.h"

namespace rung::workspace {
namespace {

// Of source that was parsed again: each byte takes about twenty bytes of memory, until a new analysis frees them.
constexpr size_t kMostReplaced = 1 << 20, kMostKept = 2 << 20;

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
}

bool Analysis::edit(const std::string& path, const std::string& text, const std::atomic<bool>* cancelled) {
  if (!compilation_.checked || !sink_.error_text.empty()) return false;
  EditedFile* const edited = editedFile(path);
  if (edited == nullptr) return false;
  replaced_bytes_ += edited->bytesAround(text);
  const bool is_done =
      (replaced_bytes_ < kMostReplaced && edited->replace(text)) || checkAgain(*edited, text, cancelled);
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
  kept_bytes_ += text.size();
  if (kept_bytes_ > kMostKept || !canKeepTrees() || !edited.take(text)) return false;
  std::vector<FileId> changed;
  for (const auto& [path, file] : edited_) changed.push_back(file.file());
  compilation_.cancelled = cancelled;
  const bool is_done = compilation_.checkAgain(changed);
  compilation_.cancelled = nullptr;
  for (auto& [path, file] : edited_) file.release();
  edited_.clear();
  replaced_bytes_ = 0;
  revision = nextRevision();
  return is_done;
}

// Not where a condition of a pragma may ask what other files declare, nor where schedulers have noted something in the
// tree.
bool Analysis::canKeepTrees() const {
  const Sources& sources = compilation_.sources;
  const std::vector<driver::InputFile>& files = compilation_.inputs.files;
  const bool has_conditions = std::any_of(files.begin(), files.end(), [&](const driver::InputFile& file) {
    return sources.sourceText(file.file).data() != sources.original(file.file).data();
  });
  const sema::Project& project = *compilation_.project;
  return !has_conditions && std::none_of(project.pous.begin(), project.pous.end(), [&](const sema::Pou& pou) {
    return !pou.library && pou.decl && compilation_.tree.as<PouDecl>(pou.decl).body_kind == BodyKind::Network;
  });
}

}  // namespace rung::workspace

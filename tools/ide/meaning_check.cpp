// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/meaning_check.h"

#include <algorithm>

#include "tools/ide/meanings.h"

namespace rung::ide {
namespace {

MeaningRecord::Spot spotOf(const View& view, const Edits* edits, const FileRange& at) {
  if (!at) return {};
  return {view.pathOf(at.file), edits != nullptr ? edits->moved(at.file, at.begin) : at.begin};
}

// A name that hides another one is a problem too.
bool isProblem(const Diagnostic& diagnostic) {
  return diagnostic.severity == Severity::Error || diagnostic.diag == diagOf("W0769");
}

// `main.st:3:5`.
std::string placeText(const View& view, FileId file, uint32_t byte) {
  const std::string_view text = view.textOf(file).substr(0, byte);
  const size_t line = text.rfind('\n') + 1;
  const std::string path = view.pathOf(file);
  return path.substr(path.rfind('/') + 1) + ":" + std::to_string(std::count(text.begin(), text.end(), '\n') + 1) + ":" +
         std::to_string(byte - line + 1);
}

}  // namespace

MeaningRecord::MeaningRecord(const View& view, const Edits* edits, const std::string& old_name,
                             const std::string& new_name)
    : old_name_(old_name), new_name_(new_name) {
  if (view.snapshot().project() == nullptr) return;
  std::vector<NameId> keys;  // none: all
  for (const std::string* name : {&old_name, &new_name})
    if (const NameId known = view.names().find(*name)) keys.push_back(view.names().key(known));
  if (!keys.empty() || new_name.empty()) add(view, edits, keys);
  for (const Diagnostic& diagnostic : view.snapshot().diagnostics())
    if (isProblem(diagnostic))
      problems_.insert({spotOf(view, edits, view.tokenInFile(diagnostic.loc)), diagInfo(diagnostic.diag).code});
}

void MeaningRecord::add(const View& view, const Edits* edits, const std::vector<NameId>& keys) {
  const Scope& scope = view.meanings().scope();
  const auto addAll = [&](const std::vector<sema::Mention>& mentions) {
    for (const sema::Mention& mention : mentions) {
      const NameId name = scope.nameOf(mention.entity);
      if (!name) continue;
      if (!keys.empty() && std::find(keys.begin(), keys.end(), view.names().key(name)) == keys.end()) continue;
      const FileRange at = view.nameInFile(mention.loc);
      if (!at) continue;
      meant_.push_back({spotOf(view, edits, at), spotOf(view, edits, view.nameInFile(scope.locOf(mention.entity)))});
    }
  };
  addAll(scope.project().mentions);
  for (const sema::Pou& pou : scope.project().pous) addAll(pou.body.mentions);
  std::sort(meant_.begin(), meant_.end());
  meant_.erase(std::unique(meant_.begin(), meant_.end()), meant_.end());
}

std::string MeaningRecord::newProblemIn(const View& after) const {
  std::multiset<Problem> known = problems_;
  for (const Diagnostic& diagnostic : after.snapshot().diagnostics()) {
    if (!isProblem(diagnostic)) continue;
    const FileRange at = after.tokenInFile(diagnostic.loc);
    if (const auto same = known.find({spotOf(after, nullptr, at), diagInfo(diagnostic.diag).code});
        same != known.end()) {
      known.erase(same);
      continue;
    }
    return (at ? placeText(after, at.file, at.begin) + ": " : std::string()) + diagnostic.message;
  }
  return {};
}

std::string MeaningRecord::differenceIn(const View& after) const {
  if (after.snapshot().project() == nullptr) return "the project could not be read any more";
  if (std::string problem = newProblemIn(after); !problem.empty()) return problem;
  const std::vector<Meant> is = MeaningRecord(after, nullptr, old_name_, new_name_).meant_;
  const auto [lost, other] = std::mismatch(meant_.begin(), meant_.end(), is.begin(), is.end());
  if (lost == meant_.end() && other == is.end()) return {};
  const bool is_other = lost != meant_.end() && other != is.end() && lost->at == other->at;
  const bool is_new = lost == meant_.end() || is_other || (other != is.end() && *other < *lost);
  const auto text = [&](const Spot& spot) {
    const FileId file = after.fileAt(spot.path);
    return file ? placeText(after, file, spot.byte) : std::string("a library");
  };
  const Meant& meant = is_new ? *other : *lost;
  return text(meant.at) + ": this name would " + (is_new ? "mean that of " : "not mean that of ") +
         text(meant.declared) + (is_new ? "" : " any more");
}

}  // namespace rung::ide

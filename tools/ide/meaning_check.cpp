// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/meaning_check.h"

#include <algorithm>
#include <compare>
#include <set>
#include <unordered_map>

#include "tools/ide/meanings.h"

namespace rung::ide {
namespace {

// A byte of a file of the view before.
struct Spot {
  uint32_t file = 0, byte = 0;
  auto operator<=>(const Spot&) const = default;
};
// A name, and the name in the declaration that it means.
struct Meant {
  Spot at, declared;
  auto operator<=>(const Meant&) const = default;
};
struct Problem {
  Spot at;
  std::string code;
  auto operator<=>(const Problem&) const = default;
};

// The names and errors of one view at their places after the edits.
class Record {
 public:
  // `edits`: of the view before; none: the view has them.
  Record(const View& view, const View& before, const Edits* edits) : view_(view), before_(before), edits_(edits) {}

  std::vector<Meant> meantBy(std::string_view old_name, std::string_view new_name) {
    const sema::Project& project = *view_.snapshot().project();
    for (const std::string_view name : {old_name, new_name})
      if (const NameId known = view_.names().find(name)) keys_.push_back(view_.names().key(known));
    add(project.mentions);
    for (const sema::Pou& pou : project.pous) add(pou.body.mentions);
    std::sort(meant_.begin(), meant_.end());
    meant_.erase(std::unique(meant_.begin(), meant_.end()), meant_.end());
    return std::move(meant_);
  }

  // A name that hides another one is a problem too.
  std::vector<std::pair<Problem, const Diagnostic*>> problems() {
    std::vector<std::pair<Problem, const Diagnostic*>> found;
    for (const Diagnostic& diagnostic : view_.snapshot().diagnostics()) {
      const bool hides = diagnostic.diag == diagOf("W0769");
      if (diagnostic.severity == Severity::Error || hides)
        found.push_back({{spotOf(view_.tokenInFile(diagnostic.loc)), diagInfo(diagnostic.diag).code}, &diagnostic});
    }
    return found;
  }

 private:
  void add(const std::vector<sema::Mention>& mentions) {
    const Scope& scope = view_.meanings().scope();
    for (const sema::Mention& mention : mentions) {
      const NameId name = scope.nameOf(mention.entity);
      if (!name || std::find(keys_.begin(), keys_.end(), view_.names().key(name)) == keys_.end()) continue;
      const FileRange at = view_.nameInFile(mention.loc);
      if (at) meant_.push_back({spotOf(at), spotOf(view_.nameInFile(scope.locOf(mention.entity)))});
    }
  }

  Spot spotOf(const FileRange& at) {
    if (!at) return {};
    const uint32_t byte = edits_ != nullptr ? edits_->moved(at.file, at.begin) : at.begin;
    if (edits_ != nullptr) return {at.file.index, byte};
    const auto [known, is_new] = files_.try_emplace(at.file.index);
    if (is_new) known->second = before_.fileAt(view_.pathOf(at.file)).index;
    return {known->second, byte};
  }

  const View& view_;
  const View& before_;
  const Edits* edits_;
  std::vector<NameId> keys_;
  std::unordered_map<uint32_t, uint32_t> files_;  // of the view -> of the view before
  std::vector<Meant> meant_;
};

// `main.st:3:5`.
std::string placeText(const View& view, FileId file, uint32_t byte) {
  const std::string_view text = view.textOf(file).substr(0, byte);
  const size_t line = text.rfind('\n') + 1;
  const std::string path = view.pathOf(file);
  return path.substr(path.rfind('/') + 1) + ":" + std::to_string(std::count(text.begin(), text.end(), '\n') + 1) + ":" +
         std::to_string(byte - line + 1);
}

std::string newProblem(const View& before, const View& after, const Edits& edits) {
  std::multiset<Problem> known;
  for (auto& [problem, diagnostic] : Record(before, before, &edits).problems()) known.insert(problem);
  for (const auto& [problem, diagnostic] : Record(after, before, nullptr).problems()) {
    if (const auto same = known.find(problem); same != known.end()) {
      known.erase(same);
      continue;
    }
    const FileRange at = after.tokenInFile(diagnostic->loc);
    const std::string place = at ? placeText(after, at.file, at.begin) + ": " : std::string();
    return place + diagnostic->message;
  }
  return {};
}

}  // namespace

std::string changedMeaning(const View& before, const View& after, const Edits& edits, std::string_view old_name,
                           std::string_view new_name) {
  if (after.snapshot().project() == nullptr) return "the project could not be read any more";
  if (std::string problem = newProblem(before, after, edits); !problem.empty()) return problem;
  const std::vector<Meant> was = Record(before, before, &edits).meantBy(old_name, new_name);
  const std::vector<Meant> is = Record(after, before, nullptr).meantBy(old_name, new_name);
  const auto [lost, other] = std::mismatch(was.begin(), was.end(), is.begin(), is.end());
  if (lost == was.end() && other == is.end()) return {};
  const bool is_new = lost == was.end() || (other != is.end() && *other < *lost);
  const auto text = [&](const Spot& spot) {
    const FileId file = spot.file != 0 ? after.fileAt(before.pathOf({spot.file})) : FileId{};
    return file ? placeText(after, file, spot.byte) : std::string("a library");
  };
  const Meant& meant = is_new ? *other : *lost;
  return text(meant.at) + ": this name would " + (is_new ? "mean that of " : "not mean that of ") +
         text(meant.declared) + (is_new ? "" : " any more");
}

}  // namespace rung::ide

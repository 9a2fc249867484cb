// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/fix.h"

#include <algorithm>
#include <set>
#include <vector>

#include "frontend/source/fixes.h"
#include "tools/driver/changes.h"
#include "tools/driver/commands.h"
#include "tools/driver/encoding.h"
#include "tools/workspace/workspace.h"

namespace rung::workspace {
namespace {

constexpr uint32_t kMaxRounds = 10;
constexpr uint32_t kMaxTrials = 500;  // in all, so that a project with thousands of bad fixes ends

using Texts = std::map<std::string, std::string>;

struct PathEdit {
  std::string path;
  uint32_t begin, end;
  std::string text;
};
struct Candidate {
  std::string diagnostic;    // its path, code and message
  std::string fix;           // … and the title
  bool may_uncover = false;  // a sure fix of syntax: what comes after the mistake may not have been looked at
  std::vector<PathEdit> edits;
};
// The errors of a snapshot, and all diagnostics, each as often as it is there.
struct Findings {
  uint32_t errors = 0;
  std::multiset<std::string> all, of_errors;
};

std::string shownName(const Sources& sources, const Diagnostic& diagnostic) {
  const FileId file = sources.fileOf(sources.originalLocation(diagnostic.loc));
  const std::string path = file ? std::string(sources.displayPath(file)) : diagnostic.path;
  return path + '\n' + diagInfo(diagnostic.diag).code + '\n' + diagnostic.message;
}

Findings findingsOf(const Snapshot& snapshot) {
  Findings findings;
  for (const Diagnostic& diagnostic : snapshot.diagnostics()) {
    const std::string name = shownName(snapshot.sources(), diagnostic);
    findings.all.insert(name);
    if (diagnostic.severity != Severity::Error) continue;
    ++findings.errors;
    findings.of_errors.insert(name);
  }
  return findings;
}

class Fixer {
 public:
  Fixer(const driver::ProjectOptions& project, driver::FixSet fixes, std::string only)
      : workspace_(allErrorsOf(project)), fixes_(fixes), only_(std::move(only)) {}

  Fixed run() {
    snapshot_ = workspace_.apply({});
    for (uint32_t round = 0; round < kMaxRounds && snapshot_->error().empty(); ++round) {
      known_ = findingsOf(*snapshot_);
      base_ = texts_;
      accepted_.clear();
      const std::vector<Candidate> candidates = collect();
      if (candidates.empty()) break;
      std::vector<const Candidate*> all;
      for (const Candidate& candidate : candidates) all.push_back(&candidate);
      take(all);
      show(textsWith({}));  // the last trial may have been another one
      for (const Candidate* candidate : accepted_) ++fixed_.files[candidate->edits[0].path].fixes;
    }
    fixed_.error = snapshot_->error();
    for (auto& [path, file] : fixed_.files) file.after = texts_.count(path) != 0 ? texts_[path] : file.before;
    std::erase_if(fixed_.files, [](const auto& entry) { return entry.second.before == entry.second.after; });
    return std::move(fixed_);
  }

 private:
  static driver::ProjectOptions allErrorsOf(driver::ProjectOptions project) {
    project.report.max_errors = ~0u;
    project.report.path.clear();
    return project;
  }

  // ---- the fixes of a snapshot that are apart from each other

  std::vector<Candidate> collect() {
    std::vector<Candidate> candidates;
    std::map<std::string, std::vector<std::pair<uint32_t, uint32_t>>> taken;  // by path
    for (const Diagnostic& diagnostic : snapshot_->diagnostics()) {
      if (diagnostic.fixes.empty()) continue;
      Candidate candidate = candidateFor(diagnostic);
      if (!candidate.edits.empty() && isApart(candidate, taken)) candidates.push_back(std::move(candidate));
    }
    return candidates;
  }

  // A sure fix, else the first proposal, of those that were not taken back.
  Candidate candidateFor(const Diagnostic& diagnostic) {
    const std::string name = shownName(snapshot_->sources(), diagnostic);
    for (const bool is_sure : {true, false}) {
      if (!is_sure && fixes_ != driver::FixSet::All) break;
      for (const Fix& fix : diagnostic.fixes) {
        Candidate candidate{name, name + '\n' + fix.title, is_sure && diagnostic.reporter == 0, {}};
        if (fix.is_sure != is_sure || refused_.count(candidate.fix) != 0) continue;
        candidate.edits = inFiles(diagnostic, fix);
        if (!candidate.edits.empty()) return candidate;
      }
    }
    return {};
  }

  std::vector<PathEdit> inFiles(const Diagnostic& diagnostic, const Fix& fix) {
    std::vector<PathEdit> edits;
    const Sources& sources = snapshot_->sources();
    for (FileEdit& edit : fileEdits(sources, diagnostic, fix)) {
      const std::string path(sources.displayPath(edit.file));
      if (!only_.empty() && path != only_) return {};
      const std::vector<std::string>& read = snapshot_->inputs().read;
      if (std::find(read.begin(), read.end(), path) == read.end()) return {};  // of a library
      if (fixed_.files.count(path) == 0) fixed_.files[path].before = sources.original(edit.file);
      edits.push_back({path, edit.begin, edit.end, std::move(edit.text)});
    }
    return edits;
  }

  static bool isApart(const Candidate& candidate,
                      std::map<std::string, std::vector<std::pair<uint32_t, uint32_t>>>& taken) {
    const auto meets = [&](const PathEdit& edit) {
      const auto& others = taken[edit.path];
      return std::any_of(others.begin(), others.end(),
                         [&](const auto& other) { return edit.begin <= other.second && other.first <= edit.end; });
    };
    if (std::any_of(candidate.edits.begin(), candidate.edits.end(), meets)) return false;
    for (const PathEdit& edit : candidate.edits) taken[edit.path].push_back({edit.begin, edit.end});
    return true;
  }

  // ---- trying them

  // Accepts what of `candidates` removes its diagnostic: all of them, or those of each half.
  void take(const std::vector<const Candidate*>& candidates) {
    if (trials_++ >= kMaxTrials) return;
    show(textsWith(candidates));
    const Findings now = findingsOf(*snapshot_);
    if (isBetter(candidates, now)) {
      accepted_.insert(accepted_.end(), candidates.begin(), candidates.end());
      known_ = now;
      return;
    }
    if (candidates.size() == 1) {
      refused_.insert(candidates[0]->fix);
      return;
    }
    const auto middle = candidates.begin() + static_cast<std::ptrdiff_t>(candidates.size() / 2);
    take({candidates.begin(), middle});
    take({middle, candidates.end()});
  }

  bool isBetter(const std::vector<const Candidate*>& candidates, const Findings& now) const {
    if (!snapshot_->error().empty() || now.errors > known_.errors) return false;
    std::map<std::string, size_t> fixed;
    bool may_uncover = true;
    for (const Candidate* candidate : candidates) {
      ++fixed[candidate->diagnostic];
      may_uncover = may_uncover && candidate->may_uncover;
    }
    for (const auto& [diagnostic, count] : fixed)
      if (now.all.count(diagnostic) + count > known_.all.count(diagnostic)) return false;
    return may_uncover || std::all_of(now.of_errors.begin(), now.of_errors.end(), [&](const std::string& error) {
             return now.of_errors.count(error) <= known_.of_errors.count(error);
           });
  }

  Texts textsWith(const std::vector<const Candidate*>& candidates) const {
    std::map<std::string, std::vector<const PathEdit*>> edits;
    const auto add = [&](const Candidate* candidate) {
      for (const PathEdit& edit : candidate->edits) edits[edit.path].push_back(&edit);
    };
    std::for_each(accepted_.begin(), accepted_.end(), add);
    std::for_each(candidates.begin(), candidates.end(), add);
    Texts texts = base_;
    for (auto& [path, list] : edits) {
      std::string& text = texts.try_emplace(path, fixed_.files.at(path).before).first->second;
      std::sort(list.begin(), list.end(), [](const PathEdit* a, const PathEdit* b) { return a->begin > b->begin; });
      for (const PathEdit* edit : list) text.replace(edit->begin, edit->end - edit->begin, edit->text);
    }
    return texts;
  }

  void show(const Texts& texts) {
    std::vector<Change> changes;
    for (const auto& [path, text] : texts)
      if (const auto now = texts_.find(path); now == texts_.end() || now->second != text)
        changes.push_back({path, text});
    for (const auto& [path, text] : texts_)
      if (texts.count(path) == 0) changes.push_back({path, fixed_.files.at(path).before});
    if (changes.empty()) return;
    snapshot_.reset();  // the workspace may bring the last one up to date
    snapshot_ = workspace_.apply(changes);
    for (const Change& change : changes) texts_[change.path] = *change.text;
  }

  Workspace workspace_;
  driver::FixSet fixes_;
  std::string only_;
  std::shared_ptr<const Snapshot> snapshot_;
  Texts texts_;  // those that the workspace has
  Texts base_;   // to which the edits of this round belong
  Findings known_;
  std::vector<const Candidate*> accepted_;
  std::set<std::string> refused_;
  uint32_t trials_ = 0;
  Fixed fixed_;
};

// Returns an error message, or an empty string.
std::string writeFixed(const std::string& path, const FixedFile& file) {
  ReadResult read = readFile(path);
  if (!read.error.empty()) return "cannot read `" + path + "`: " + read.error;
  driver::Encoding encoding;
  if (!driver::decode(read.content, encoding) || read.content != file.before)
    return "`" + path + "` is not what was checked any more; run it again";
  return driver::rewriteFile(path, driver::encoded(file.after, encoding));
}

std::string summaryOf(const Fixed& fixed) {
  uint32_t count = 0;
  for (const auto& [path, file] : fixed.files) count += file.fixes;
  const size_t files = fixed.files.size();
  return "applied " + std::to_string(count) + (count == 1 ? " fix in " : " fixes in ") + std::to_string(files) +
         (files == 1 ? " file\n" : " files\n");
}

}  // namespace

Fixed applyFixes(const driver::ProjectOptions& project, driver::FixSet fixes, const std::string& only) {
  return Fixer(project, fixes, only).run();
}

int runFix(const driver::ProjectOptions& given, const driver::CheckOptions& options, driver::Sink& sink) {
  const Fixed fixed = applyFixes(given, options.fixes);
  driver::ProjectOptions project = given;
  std::string changes;
  for (const auto& [path, file] : fixed.files) {
    if (options.shows_changes) {
      changes += driver::unifiedDiff(file.before, file.after, path);
      project.unsaved.push_back({path, file.after});
    } else if (const std::string error = writeFixed(path, file); !error.empty()) {
      return driver::usageError(sink, error);
    }
  }
  if (!changes.empty())
    if (const std::string error = sink.output(changes); !error.empty()) return driver::usageError(sink, error);
  const bool is_text = given.report.format == DiagnosticFormat::Text;
  if (is_text && !options.shows_changes && !fixed.files.empty()) sink.message(summaryOf(fixed));
  return driver::runCheck(project, sink);
}

}  // namespace rung::workspace

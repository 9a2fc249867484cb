// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/workspace/typing.h"

#include <algorithm>
#include <filesystem>

namespace rung::workspace {
namespace {

namespace fs = std::filesystem;

std::string placeOf(const Snapshot& snapshot, Loc loc) {
  const SourceLocation at = snapshot.sources().location(loc);
  return std::string(snapshot.sources().path(at.file)) + " " + std::to_string(at.line) + ":" +
         std::to_string(at.column);
}

}  // namespace

std::string messagesOf(const Snapshot& snapshot) {
  std::string out;
  for (const Diagnostic& diagnostic : snapshot.diagnostics()) {
    out += placeOf(snapshot, diagnostic.loc) + " " + diagInfo(diagnostic.diag).code + " " + diagnostic.message + "\n";
    for (const Diagnostic::Attached& note : diagnostic.notes)
      out += "  " + placeOf(snapshot, note.loc) + " " + note.message + "\n";
  }
  return out;
}

Typing::Typing(const std::string& folder, uint32_t seed) : random_(seed) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".st") files_.push_back(entry.path().string());
  std::sort(files_.begin(), files_.end());
  for (const std::string& file : files_) texts_[file] = readFile(file).content;
}

Change Typing::next() {
  if (left_ == 0) {
    if (!file_.empty() && random_() % 16 != 0 && texts_[file_] != before_) {
      texts_[file_] = before_;
      return {file_, before_};
    }
    file_ = files_[random_() % files_.size()];
    before_ = texts_[file_];
    at_ = random_() % (before_.size() + 1);
    left_ = 1 + random_() % 8;
  }
  --left_;
  edit(texts_[file_]);
  return {file_, texts_[file_]};
}

void Typing::edit(std::string& text) {
  static constexpr const char* kTyped[] = {
      "a", "b", "x", "0",         "1",           " ",         "\n",     ";",  ":=", "(",      ")",
      ".", "'", "+", "x := 1;\n", "IF x THEN\n", "END_IF;\n", "// c\n", "(*", "*)", "%QX0.1", "TRUE"};
  at_ = std::min(at_ + random_() % 3, text.size());
  switch (random_() % 4) {
    case 0:
      if (at_ < text.size()) text.erase(at_, 1);
      break;
    case 1:
      if (at_ < text.size()) text[at_] = kTyped[random_() % 14][0];
      break;
    default: {
      const std::string typed = kTyped[random_() % std::size(kTyped)];
      text.insert(at_, typed);
      at_ += typed.size();
    }
  }
}

}  // namespace rung::workspace

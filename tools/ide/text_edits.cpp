// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/text_edits.h"

#include <algorithm>
#include <utility>

namespace rung::ide {
namespace {

auto placeOf(const TextEdit& edit) { return std::pair(edit.range.file.index, edit.range.begin); }

}  // namespace

Edits::Edits(std::vector<TextEdit> edits) : edits_(std::move(edits)) {
  std::stable_sort(edits_.begin(), edits_.end(),
                   [](const TextEdit& a, const TextEdit& b) { return placeOf(a) < placeOf(b); });
  const auto is_same = [](const TextEdit& a, const TextEdit& b) { return placeOf(a) == placeOf(b); };
  edits_.erase(std::unique(edits_.begin(), edits_.end(), is_same), edits_.end());
}

std::map<std::string, std::string> Edits::applied(const View& view) const {
  std::map<std::string, std::string> texts;
  for (auto edit = edits_.rbegin(); edit != edits_.rend(); ++edit) {
    const FileRange& at = edit->range;
    std::string& text = texts.try_emplace(view.pathOf(at.file), view.textOf(at.file)).first->second;
    text.replace(at.begin, at.end - at.begin, edit->text);
  }
  return texts;
}

uint32_t Edits::moved(FileId file, uint32_t byte) const {
  const auto first = std::partition_point(edits_.begin(), edits_.end(),
                                          [&](const TextEdit& edit) { return edit.range.file.index < file.index; });
  uint32_t result = byte;
  const auto is_before = [&](const FileRange& at) {  // an insertion at the byte is
    return at.file == file && (at.begin < byte || at.end == byte);
  };
  for (auto edit = first; edit != edits_.end() && is_before(edit->range); ++edit)
    result += static_cast<uint32_t>(edit->text.size()) - (edit->range.end - edit->range.begin);
  return result;
}

}  // namespace rung::ide

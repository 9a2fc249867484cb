// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/trivia.h"

#include <algorithm>
#include <string_view>

namespace rung {
namespace {

// The source between two locations of one file.
std::string_view between(const Sources& sources, Loc begin, Loc end) {
  const FileId file = sources.fileOf(begin);
  return sources.sourceText(file).substr(begin.offset - sources.begin(file).offset, end.offset - begin.offset);
}

// Tells whether anything precedes a location on its line.
bool followsOnLine(const Sources& sources, Loc loc) {
  const Loc begin = sources.begin(sources.fileOf(loc));
  const std::string_view source = between(sources, begin, loc);
  const size_t line = source.find_last_of("\r\n") + 1;  // npos + 1: the first line
  return source.find_first_not_of(" \t", line) != std::string_view::npos;
}

}  // namespace

void Trivia::add(std::span<const Comment> comments) {
  if (comments.empty()) return;
  comments_.insert(comments_.begin() + static_cast<std::ptrdiff_t>(firstFrom(comments.front().range.begin)),
                   comments.begin(), comments.end());
}

size_t Trivia::firstFrom(Loc loc) const {
  const auto found = std::lower_bound(comments_.begin(), comments_.end(), loc,
                                      [](const Comment& comment, Loc at) { return comment.range.begin < at; });
  return static_cast<size_t>(found - comments_.begin());
}

size_t Trivia::firstOnLine(const Sources& sources, size_t comment) const {
  for (; comment > 0; --comment) {
    const Range previous = comments_[comment - 1].range, own = comments_[comment].range;
    if (sources.fileOf(previous.begin) != sources.fileOf(own.begin) ||
        between(sources, previous.end, own.begin).find_first_not_of(" \t") != std::string_view::npos)
      break;
  }
  return comment;
}

std::span<const Comment> Trivia::within(Range range) const {
  return slice(firstFrom(range.begin), firstFrom(range.end));
}

std::span<const Comment> Trivia::before(const Sources& sources, Loc node) const {
  const size_t last = firstFrom(node);
  size_t first = last;
  for (Loc next = node; first > 0; --first) {
    const Range comment = comments_[first - 1].range;
    if (sources.fileOf(comment.begin) != sources.fileOf(node)) break;
    const std::string_view gap = between(sources, comment.end, next);
    if (gap.find_first_not_of(" \t\r\n") != std::string_view::npos) break;
    const bool own_line = gap.find('\n') != std::string_view::npos;
    if (own_line && followsOnLine(sources, comments_[firstOnLine(sources, first - 1)].range.begin))
      break;  // it belongs to what precedes it
    next = comment.begin;
  }
  return slice(first, last);
}

std::span<const Comment> Trivia::after(const Sources& sources, Loc node) const {
  const size_t first = firstFrom(node);
  size_t last = first;
  for (Loc previous = node; last < comments_.size(); ++last) {
    const Range comment = comments_[last].range;
    if (sources.fileOf(comment.begin) != sources.fileOf(node)) break;
    if (between(sources, previous, comment.begin).find_first_not_of(" \t;,") != std::string_view::npos) break;
    previous = comment.end;
  }
  return slice(first, last);
}

}  // namespace rung

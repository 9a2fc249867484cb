// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/view.h"

#include <algorithm>

#include "tools/driver/file_provider.h"
#include "tools/ide/meanings.h"

namespace rung::ide {

View::View(std::shared_ptr<const workspace::Snapshot> snapshot, const EmbeddedFiles& embedded)
    : snapshot_(std::move(snapshot)), embedded_(embedded) {
  for (uint32_t i = 1; i <= sources().fileCount(); ++i)
    if (std::string path = pathOf({i}); !path.empty()) by_path_.emplace(std::move(path), FileId{i});
}

View::~View() = default;

FileId View::fileAt(const std::string& path) const {
  const auto found = by_path_.find(path);
  return found == by_path_.end() ? FileId{} : found->second;
}

std::string View::pathOf(FileId file) const {
  if (!file || !sources().segments(file).empty()) return {};
  const std::string_view shown = sources().displayPath(file);
  if (shown.starts_with('/')) return driver::absolutePath(std::string(shown));
  return embedded_.pathOfLibrary(shown, sources().original(file));
}

// ---- from a file to what was parsed

// The pieces of a text that is made of others, traced back to files on disk.
std::vector<View::Piece> View::tracedPieces(FileId text) const {
  const std::vector<Segment>& segments = sources().segments(text);
  const uint32_t base = sources().begin(text).offset;
  std::vector<Piece> traced;
  for (size_t i = 0; i < segments.size(); ++i) {
    const Segment& segment = segments[i];
    const size_t end = i + 1 < segments.size() ? segments[i + 1].at : sources().sourceText(text).size();
    if (!segment.verbatim || end <= segment.at) continue;
    const Piece piece{segment.from, static_cast<uint32_t>(end) - segment.at, {base + segment.at}};
    const FileId from = sources().fileOf(segment.from);
    if (!from) continue;
    if (sources().segments(from).empty()) {
      traced.push_back(piece);
      continue;
    }
    for (const Piece& part : piecesOf(from)) {
      const uint32_t begin = std::max(part.at.offset, piece.from.offset);
      const uint32_t stop = std::min(part.at.offset + part.length, piece.from.offset + piece.length);
      if (begin < stop)
        traced.push_back({{part.from.offset + (begin - part.at.offset)},
                          stop - begin,
                          {piece.at.offset + (begin - piece.from.offset)}});
    }
  }
  std::sort(traced.begin(), traced.end(), [](const Piece& a, const Piece& b) { return a.from < b.from; });
  return traced;
}

const std::vector<View::Piece>& View::piecesOf(FileId text) const {
  if (const auto known = pieces_.find(text.index); known != pieces_.end()) return known->second;
  return pieces_.emplace(text.index, tracedPieces(text)).first->second;
}

std::vector<const FileUnit*> View::unitsOf(FileId file) const {
  std::vector<const FileUnit*> units;
  if (!file) return units;
  const Loc begin = sources().begin(file);
  const Loc end{begin.offset + static_cast<uint32_t>(textOf(file).size()) + 1};
  for (const FileUnit& unit : tree().files) {
    if (unit.file == file) {
      units.push_back(&unit);
    } else if (!sources().segments(unit.file).empty()) {
      const std::vector<Piece>& pieces = piecesOf(unit.file);
      const auto first =
          std::partition_point(pieces.begin(), pieces.end(), [&](const Piece& piece) { return piece.from < begin; });
      if (first != pieces.end() && first->from < end) units.push_back(&unit);
    }
  }
  return units;
}

Loc View::parsedAt(FileId file, uint32_t byte) const {
  const Loc at{sources().begin(file).offset + std::min(byte, static_cast<uint32_t>(textOf(file).size()))};
  Loc after;  // the location after a piece that ends here
  for (const FileUnit* unit : unitsOf(file)) {
    if (unit->file == file) return at;
    const std::vector<Piece>& pieces = piecesOf(unit->file);
    const auto next =
        std::partition_point(pieces.begin(), pieces.end(), [&](const Piece& piece) { return piece.from <= at; });
    for (auto piece = next; piece != pieces.begin();) {
      --piece;
      if (at.offset < piece->from.offset + piece->length) return {piece->at.offset + (at.offset - piece->from.offset)};
      if (at.offset == piece->from.offset + piece->length) after = {piece->at.offset + piece->length};
      if (piece->from < next[-1].from) break;
    }
  }
  return after;
}

const FileUnit* View::unitWith(Loc parsed) const {
  const FileId file = sources().fileOf(sources().current(parsed));
  for (const FileUnit& unit : tree().files)
    if (unit.file == file) return &unit;
  return nullptr;
}

// ---- from what was parsed to a file

FileRange View::bytesInFile(Loc parsed, uint32_t length) const {
  if (!parsed) return {};
  const Loc begin = sources().originalLocation(parsed);
  const FileId file = sources().fileOf(begin);
  if (!file) return {};
  const uint32_t first = begin.offset - sources().begin(file).offset;
  return {file, first, std::min(first + length, static_cast<uint32_t>(textOf(file).size()))};
}

FileRange View::tokenInFile(Loc parsed) const {
  return bytesInFile(parsed, static_cast<uint32_t>(sources().tokenAt(parsed).size()));
}

FileRange View::nameInFile(Loc parsed) const {
  const std::string_view token = sources().tokenAt(parsed);
  return bytesInFile(parsed, static_cast<uint32_t>(token.substr(0, token.find('#')).size()));
}

FileRange View::inFile(Range parsed) const {
  if (!parsed.begin || parsed.end <= parsed.begin) return tokenInFile(parsed.begin);
  FileRange range = bytesInFile(parsed.begin, 1);
  const Loc last = sources().originalLocation({parsed.end.offset - 1});
  if (sources().fileOf(last) != range.file) return tokenInFile(parsed.begin);
  const uint32_t end = last.offset - sources().begin(range.file).offset + 1;
  if (end <= range.begin) return tokenInFile(parsed.begin);
  range.end = std::min(end, static_cast<uint32_t>(textOf(range.file).size()));
  return range;
}

const Meanings& View::meanings() const {
  if (meanings_ == nullptr) meanings_ = std::make_unique<Meanings>(*this);
  return *meanings_;
}

}  // namespace rung::ide

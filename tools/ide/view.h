// SPDX-License-Identifier: Apache-2.0
// A snapshot as an editor sees it: files by their paths, and bytes of files. In: a snapshot. Out: the file at a path;
// the locations that the parser saw for a byte of a file, which differ in the files of other tools; the bytes of a file
// for what the parser saw. Read by all questions of this folder, in one thread at a time: tables are filled when
// needed.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "tools/ide/embedded_files.h"
#include "tools/workspace/workspace.h"

namespace rung::ide {

// Bytes of a file as it is on disk or in its editor.
struct FileRange {
  FileId file;  // none: no file has it
  uint32_t begin = 0, end = 0;
  explicit operator bool() const { return static_cast<bool>(file); }
  friend bool operator==(const FileRange&, const FileRange&) = default;
};

class Meanings;  // meanings.h

class View {
 public:
  View(std::shared_ptr<const workspace::Snapshot> snapshot, const EmbeddedFiles& embedded);
  ~View();

  const workspace::Snapshot& snapshot() const { return *snapshot_; }
  const Sources& sources() const { return snapshot_->sources(); }
  const Names& names() const { return snapshot_->names(); }
  const Tree& tree() const { return snapshot_->tree(); }

  // By absolute path; none: the project does not read it.
  FileId fileAt(const std::string& path) const;
  // The absolute path; empty: the text was made by Rung.
  std::string pathOf(FileId file) const;
  std::string_view textOf(FileId file) const { return sources().original(file); }

  // The parsed declarations of which at least a part is in this file.
  std::vector<const FileUnit*> unitsOf(FileId file) const;
  // The location in the parsed text that a byte of the file became, if any; also that after the last byte of a piece.
  Loc parsedAt(FileId file, uint32_t byte) const;
  const FileUnit* unitWith(Loc parsed) const;

  // What was parsed, in its file. None: Rung made it.
  FileRange inFile(Range parsed) const;
  // The token at a location.
  FileRange tokenInFile(Loc parsed) const;
  // The name at a location: of `Color#Green` the part before the sign.
  FileRange nameInFile(Loc parsed) const;
  FileRange bytesInFile(Loc parsed, uint32_t length) const;

  // What the names in the program mean; made when it is first asked for.
  const Meanings& meanings() const;

 private:
  // A part of a file that was copied byte for byte into a text that was parsed.
  struct Piece {
    Loc from;
    uint32_t length;
    Loc at;
  };
  const std::vector<Piece>& piecesOf(FileId text) const;
  std::vector<Piece> tracedPieces(FileId text) const;

  std::shared_ptr<const workspace::Snapshot> snapshot_;
  const EmbeddedFiles& embedded_;
  std::map<std::string, FileId> by_path_;
  mutable std::unordered_map<uint32_t, std::vector<Piece>> pieces_;  // by the parsed text; sorted by `from`
  mutable std::unique_ptr<Meanings> meanings_;
};

}  // namespace rung::ide

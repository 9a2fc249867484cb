// SPDX-License-Identifier: Apache-2.0
// Sources: the source of every input file, and the 32-bit locations that point into it.
// In: paths or sources. Out: Loc (an offset in one address space over all files), and the line and column of a Loc.
// Files get consecutive ranges; a file that is edited gets another one for its new text. Each source ends in a NUL that
// is not part of the file, so lexers need no end test. Lookups of locations fill caches: one thread at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace rung {

struct Loc {
  uint32_t offset = 0;  // 0: none
  explicit operator bool() const { return offset != 0; }
  friend bool operator==(Loc, Loc) = default;
  friend auto operator<=>(Loc, Loc) = default;
};

struct FileId {
  uint32_t index = 0;  // 0: no file
  explicit operator bool() const { return index != 0; }
  friend bool operator==(FileId, FileId) = default;
};

struct SourceLocation {
  FileId file;
  uint32_t line = 0;    // from 1
  uint32_t column = 0;  // from 1, in characters (UTF-8 code points)
};

// Of source-mapped text: the text from `at` on is a copy of the file at `from`, byte for byte (`verbatim`), or was
// generated for the location `from`: a decoded XML entity, or a keyword that the file leaves out.
struct Segment {
  uint32_t at;
  Loc from;
  bool verbatim;
};

class Sources {
 public:
  Sources();
  Sources(const Sources&) = delete;
  Sources& operator=(const Sources&) = delete;

  // Adds a source under the path that diagnostics print (relative to the project root where it is below it). A BOM is
  // dropped. Returns no file when the 32-bit space is full.
  FileId add(std::string path, std::string source);

  // Adds source-mapped text: text put together from parts of other files, such as the program in a vendor's XML. All
  // lookups below return locations in those files. Segments are sorted by `at`, the first has `at` 0.
  FileId addSourceMapped(std::string path, std::string source, std::vector<Segment> segments);

  // The file has this text from now on. Returns the id of its text of before, in which locations stay valid: it is a
  // source-mapped text, which remap() maps to the new one. No file when the 32-bit space is full.
  FileId edit(FileId file, std::string source);
  void remap(FileId file, std::vector<Segment> segments) { files_[file.index].segments = std::move(segments); }
  // No location leads there any more.
  void forget(FileId file);
  // The file whose text of before this is; else itself.
  FileId editedFile(FileId text) const {
    const FileId file = files_[text.index].before_of;
    return file ? file : text;
  }
  // The location in the text that the file has now.
  Loc current(Loc loc) const;

  // The path that messages show for the file, where it differs from its own.
  void setDisplayPath(FileId file, std::string display_path) {
    files_[file.index].display_path = std::move(display_path);
  }

  // Another language decides which names the file may have (the ladder of NCT): `a__b` and `a_` too.
  void allowAnyUnderscores(FileId file) { files_[file.index].any_underscores = true; }
  bool hasAnyUnderscores(FileId file) const { return files_[file.index].any_underscores; }

  // In the order of the files, and in them by place.
  bool isBefore(Loc a, Loc b) const;

  Loc begin(FileId file) const { return {files_[file.index].base}; }
  std::string_view path(FileId file) const { return files_[file.index].path; }
  std::string_view displayPath(FileId file) const {
    const File& f = files_[file.index];
    return f.display_path.empty() ? f.path : f.display_path;
  }
  // The source to parse: the file as it is, or as activate() changed it. sourceText(file).data()[size()] is NUL.
  std::string_view sourceText(FileId file) const {
    const File& of = files_[file.index];
    return of.active.empty() ? of.source : of.active;
  }
  std::string_view original(FileId file) const { return files_[file.index].source; }
  // Of source-mapped text; none: the file is as it was read.
  const std::vector<Segment>& segments(FileId file) const { return files_[file.index].segments; }
  // A source of the same length to parse instead, with the parts blanked that conditional pragmas exclude. Messages
  // show the original.
  void activate(FileId file, std::string source);
  uint32_t fileCount() const { return static_cast<uint32_t>(files_.size()) - 1; }

  FileId fileOf(Loc loc) const;
  Loc originalLocation(Loc loc) const;  // its location in the file on disk; differs only for source-mapped text
  // The byte of the file on disk of which this byte is a copy; none: it is not one.
  Loc copiedFrom(Loc loc) const;
  SourceLocation location(Loc loc) const;
  uint32_t lineNumber(Loc loc) const;  // location(loc).line without counting columns; 0: no location
  std::string_view line(FileId file, uint32_t line) const;  // without its line end

  // The token that starts at loc: an identifier, number, string, or one operator; what a caret underlines.
  std::string_view tokenAt(Loc loc) const;

 private:
  struct File {
    std::string path;
    std::string source;
    uint32_t base = 0;
    std::vector<Segment> segments;  // of source-mapped text
    std::string display_path;
    struct Lines {
      std::once_flag known;
      std::vector<uint32_t> starts;
      bool ascii = false;
    };
    std::unique_ptr<Lines> lines = std::make_unique<Lines>();  // found when they are first asked for
    std::string active = {};
    bool any_underscores = false;
    FileId before_of = {};
  };
  const std::vector<uint32_t>& lineStarts(const File& file) const;
  bool takeRange(uint32_t file, size_t bytes);
  static const Segment& segmentAt(const File& file, Loc loc);
  static Loc mapped(const File& file, Loc loc);

  std::deque<File> files_;
  struct Extent {
    uint32_t base, file;
  };
  std::vector<Extent> extents_;  // sorted
  uint64_t next_base_ = 1;
  bool is_edited_ = false;
  // Results of the last look-up: the next one is likely near. Several threads may read the same sources.
  mutable std::atomic<uint32_t> last_file_ = 0, last_line_ = 0;
  mutable std::mutex last_mutex_;
  mutable SourceLocation last_location_;
  mutable uint32_t last_location_at_ = 0;
};

// Converts a source that begins with a UTF-16 byte order mark to UTF-8. False: what follows the mark is not UTF-16.
[[nodiscard]] bool decodeUtf16(std::string& source);

void appendUtf8(std::string& out, uint32_t c);
uint32_t countCharacters(std::string_view utf8);

// Reads a whole file. The error is the message of the system ("No such file or directory").
struct ReadResult {
  std::string content;
  std::string error;  // empty: read
};
[[nodiscard]] ReadResult readFile(const std::string& path);

// First byte that is not UTF-8, or npos. This detects vendor exports in Latin-1.
size_t findInvalidUtf8(std::string_view source);
inline bool isUtf8(std::string_view source) { return findInvalidUtf8(source) == std::string_view::npos; }

}  // namespace rung

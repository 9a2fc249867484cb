// Sources: the text of every input file and the 32-bit locations that point into it.
// In: paths or text. Out: Loc (offset in one address space over all files), and line and column of a Loc.
// Files get consecutive ranges; each text ends in a NUL that is not part of the file, so lexers need no end test.
// Questions about places fill caches: one thread at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace rung {

struct Loc {
  uint32_t offset = 0;  // 0: nowhere
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

// Of an assembled text: what it has from `at` on stands in the file at `from`, byte for byte (`verbatim`), or was put
// there for what stands at `from`: an entity of XML, or a word that the file leaves out.
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

  // Adds a text under the path that diagnostics print (relative to the project root where it is below it).
  // A BOM is dropped. Returns no file when the 32-bit space is full.
  FileId add(std::string path, std::string source);

  // Adds a text that was put together from parts of other files: the program that a vendor's XML holds, say. Its
  // locations are places of those files, in every question below. Segments are sorted by `at`, the first has `at` 0.
  FileId addSourceMapped(std::string path, std::string source, std::vector<Segment> segments);

  // Messages name the file so, where that is not its path.
  void setDisplayPath(FileId file, std::string display_path) {
    files_[file.index].display_path = std::move(display_path);
  }

  Loc begin(FileId file) const { return {files_[file.index].base}; }
  std::string_view path(FileId file) const { return files_[file.index].path; }
  std::string_view displayPath(FileId file) const {
    const File& f = files_[file.index];
    return f.display_path.empty() ? f.path : f.display_path;
  }
  // What is parsed: the file as it is, or what activate() made of it. text().data()[size()] is NUL.
  std::string_view sourceText(FileId file) const {
    const File& of = files_[file.index];
    return of.active.empty() ? of.source : of.active;
  }
  std::string_view original(FileId file) const { return files_[file.index].source; }
  // A text of the same length to parse instead: conditional pragmas leave some out. Messages show the original.
  void activate(FileId file, std::string source);
  uint32_t fileCount() const { return static_cast<uint32_t>(files_.size()) - 1; }

  FileId fileOf(Loc loc) const;
  Loc originalLocation(Loc loc) const;  // where the file on disk has it: another place only for assembled texts
  SourceLocation location(Loc loc) const;
  uint32_t lineNumber(Loc loc) const;  // place(loc).line without the counting of columns; 0: nowhere
  std::string_view line(FileId file, uint32_t line) const;  // without its line end

  // The token that starts at loc: an identifier, number, string, or one operator; what a caret underlines.
  std::string_view tokenAt(Loc loc) const;

 private:
  struct File {
    std::string path;
    std::string source;
    uint32_t base;
    std::vector<Segment> segments;  // of an assembled text
    std::string display_path;
    mutable std::vector<uint32_t> line_starts;  // filled when first asked for
    mutable bool ascii;                         // known once line_starts is
    std::string active = {};
  };
  const std::vector<uint32_t>& lineStarts(const File& file) const;

  std::deque<File> files_;
  mutable uint32_t last_file_ = 0, last_line_ = 0;  // where the last questions led: the next is likely near
  mutable SourceLocation last_location_;
  mutable uint32_t last_location_at_ = 0;
};

// A text that begins with a UTF-16 byte order mark becomes UTF-8. False: it is no UTF-16 behind that mark.
[[nodiscard]] bool decodeUtf16(std::string& source);

void appendUtf8(std::string& out, uint32_t c);
uint32_t countCharacters(std::string_view utf8);

// Reads a whole file. The error says what the system said ("No such file or directory").
struct ReadResult {
  std::string content;
  std::string error;  // empty: read
};
[[nodiscard]] ReadResult readFile(const std::string& path);

// First byte that is not UTF-8, or npos. Vendor exports in Latin-1 are told apart by it.
size_t findInvalidUtf8(std::string_view source);
inline bool isUtf8(std::string_view source) { return findInvalidUtf8(source) == std::string_view::npos; }

}  // namespace rung

// SPDX-License-Identifier: Apache-2.0
// The table of input sources, and the mapping from a 32-bit location back to file, line and column. Line starts are
// computed on first use; a file that is plain ASCII needs no counting of characters.
#include "frontend/source/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "frontend/source/invariant.h"
#include "frontend/source/text.h"

namespace rung {
namespace {

constexpr size_t kMaxFileBytes = size_t{1} << 30;

bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

bool isWordChar(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

bool isAscii(std::string_view source) {
  constexpr uint64_t kHigh = 0x8080808080808080u;
  size_t i = 0;
  for (; i + 8 <= source.size(); i += 8) {
    uint64_t word = 0;
    std::memcpy(&word, source.data() + i, 8);
    if (word & kHigh) return false;
  }
  for (; i < source.size(); ++i) {
    if (static_cast<unsigned char>(source[i]) >= 0x80) return false;
  }
  return true;
}

// LF, CR LF and a lone CR each end a line.
std::vector<uint32_t> findLineStarts(std::string_view source) {
  std::vector<uint32_t> starts = {0};
  starts.reserve(source.size() / 24 + 1);
  if (source.find('\r') == std::string_view::npos) {
    for (size_t at = source.find('\n'); at != std::string_view::npos; at = source.find('\n', at + 1))
      starts.push_back(static_cast<uint32_t>(at) + 1);
    return starts;
  }
  for (uint32_t i = 0; i < source.size(); ++i) {
    if (source[i] > '\r') continue;
    if (source[i] == '\n' || (source[i] == '\r' && (i + 1 == source.size() || source[i + 1] != '\n')))
      starts.push_back(i + 1);
  }
  return starts;
}

// The length of the identifier or number at the start of `source` and, where `#` follows, of the literal that it
// begins: INT#5, 16#ff, T#1s500ms, DT#1970-01-01-00:00:00.
size_t literalLength(std::string_view source) {
  size_t n = 0;
  const bool number = isDigit(source[0]);
  while (n < source.size() && isWordChar(source[n])) ++n;
  if (number && n + 1 < source.size() && source[n] == '.' && isDigit(source[n + 1])) {
    ++n;
    while (n < source.size() && isWordChar(source[n])) ++n;
  }
  if (number && n + 1 < source.size() && (source[n] == '+' || source[n] == '-') &&
      foldedCharacter(source[n - 1]) == 'e' && isDigit(source[n + 1])) {
    ++n;
    while (n < source.size() && isWordChar(source[n])) ++n;
  }
  if (n < source.size() && source[n] == '#') {
    const std::string_view prefix = source.substr(0, n);
    const bool date = prefix.find_first_of("dDlLtT") == 0 && prefix.find_first_of("dD") != std::string_view::npos;
    ++n;
    if (n < source.size() && (source[n] == '-' || source[n] == '+')) ++n;
    while (n < source.size()) {
      const bool inside = isWordChar(source[n]) || (date && (source[n] == '-' || source[n] == ':')) ||
                          (source[n] == '.' && n + 1 < source.size() && isDigit(source[n + 1]));
      if (!inside) break;
      ++n;
    }
  }
  return n;
}

size_t quotedLength(std::string_view source) {
  for (size_t n = 1; n < source.size() && source[n] != '\n' && source[n] != '\r'; ++n) {
    if (source[n] == '$') {
      ++n;
    } else if (source[n] == source[0]) {
      return n + 1;
    }
  }
  return 1;
}

size_t addressLength(std::string_view source) {
  size_t n = 1;
  while (n < source.size() && (isWordChar(source[n]) || source[n] == '.' || source[n] == '*')) ++n;
  return n;
}

}  // namespace

uint32_t countCharacters(std::string_view utf8) {
  return static_cast<uint32_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) { return !isContinuation(c); }));
}

Sources::Sources() { files_.emplace_back(); }

// One past the NUL: the end of a file has its own location.
bool Sources::takeRange(uint32_t file, size_t bytes) {
  if (next_base_ + bytes + 1 > UINT32_MAX) return false;
  files_[file].base = static_cast<uint32_t>(next_base_);
  extents_.push_back({files_[file].base, file});
  next_base_ += bytes + 1;
  return true;
}

FileId Sources::add(std::string path, std::string source) {
  if (source.starts_with("\xef\xbb\xbf")) source.erase(0, 3);
  return addSourceMapped(std::move(path), std::move(source), {});
}

FileId Sources::addSourceMapped(std::string path, std::string source, std::vector<Segment> segments) {
  const auto index = static_cast<uint32_t>(files_.size());
  File& file = files_.emplace_back();
  if (!takeRange(index, source.size())) {
    files_.pop_back();
    return {};
  }
  file.path = std::move(path);
  file.source = std::move(source);
  file.segments = std::move(segments);
  return {index};
}

FileId Sources::edit(FileId file, std::string source) {
  const auto index = static_cast<uint32_t>(files_.size());
  File& before = files_.emplace_back();
  File& of = files_[file.index];
  before.before_of = file;
  before.path = of.path;
  before.display_path = of.display_path;
  before.source = std::move(of.source);
  before.active = std::move(of.active);
  before.base = of.base;
  before.segments = {{0, {static_cast<uint32_t>(next_base_)}, true}};
  before.lines = std::exchange(of.lines, std::make_unique<File::Lines>());
  const auto extent = std::lower_bound(extents_.begin(), extents_.end(), before.base,
                                       [](const Extent& of_extent, uint32_t base) { return of_extent.base < base; });
  extent->file = index;
  is_edited_ = true;
  last_location_ = {};
  of.source = std::move(source);
  return takeRange(file.index, of.source.size()) ? FileId{index} : FileId{};
}

void Sources::forget(FileId file) {
  File& of = files_[file.index];
  of.source = of.active = {};
  of.segments = {};
}

bool Sources::isBefore(Loc a, Loc b) const {
  if (!is_edited_) return a < b;
  a = current(a);
  b = current(b);
  const uint32_t file = fileOf(a).index, other = fileOf(b).index;
  return file != other ? file < other : a < b;
}

void Sources::activate(FileId file, std::string source) {
  File& of = files_[file.index];
  RUNG_INVARIANT(source.size() == of.source.size(), "content is replaced by content of the same length");
  of.active = std::move(source);
}

FileId Sources::fileOf(Loc loc) const {
  if (!loc) return {};
  const auto holds = [&](uint32_t i) {
    return loc.offset >= files_[i].base && loc.offset - files_[i].base <= files_[i].source.size();
  };
  if (const uint32_t last = last_file_.load(std::memory_order_relaxed); last != 0 && holds(last)) return {last};
  const auto after = std::upper_bound(extents_.begin(), extents_.end(), loc.offset,
                                      [](uint32_t offset, const Extent& extent) { return offset < extent.base; });
  if (after == extents_.begin()) return {};
  const uint32_t index = (after - 1)->file;
  if (!holds(index)) return {};
  last_file_.store(index, std::memory_order_relaxed);
  return {index};
}

// Of source-mapped text.
const Segment& Sources::segmentAt(const File& file, Loc loc) {
  const std::vector<Segment>& segments = file.segments;
  const uint32_t at = loc.offset - file.base;
  const auto after = std::upper_bound(segments.begin() + 1, segments.end(), at,
                                      [](uint32_t offset, const Segment& segment) { return offset < segment.at; });
  return *(after - 1);
}

// The location that a location in source-mapped text was made of.
Loc Sources::mapped(const File& file, Loc loc) {
  const Segment& segment = segmentAt(file, loc);
  return {segment.from.offset + (segment.verbatim ? loc.offset - file.base - segment.at : 0)};
}

Loc Sources::copiedFrom(Loc loc) const {
  const FileId id = fileOf(loc);
  if (!id) return {};
  const File& file = files_[id.index];
  if (file.segments.empty()) return loc;
  const bool is_copy = segmentAt(file, loc).verbatim && loc.offset - file.base < file.source.size();
  return is_copy ? copiedFrom(mapped(file, loc)) : Loc{};
}

Loc Sources::originalLocation(Loc loc) const {
  const FileId id = fileOf(loc);
  if (!id || files_[id.index].segments.empty()) return loc;
  return originalLocation(mapped(files_[id.index], loc));  // which may be source-mapped as well
}

Loc Sources::current(Loc loc) const {
  const FileId id = fileOf(loc);
  return id && files_[id.index].before_of ? mapped(files_[id.index], loc) : loc;
}

const std::vector<uint32_t>& Sources::lineStarts(const File& file) const {
  std::call_once(file.lines->known, [&] {
    file.lines->starts = findLineStarts(file.source);
    file.lines->ascii = isAscii(file.source);
  });
  return file.lines->starts;
}

uint32_t Sources::lineNumber(Loc loc) const {
  const FileId id = fileOf(loc);
  if (!id) return 0;
  const File& file = files_[id.index];
  if (!file.segments.empty()) return lineNumber(originalLocation(loc));
  const std::vector<uint32_t>& starts = lineStarts(file);
  const uint32_t at = loc.offset - file.base;
  // Most lookups come in order: try the last line and the next one before searching.
  const uint32_t last = last_line_.load(std::memory_order_relaxed);
  uint32_t line = last;
  const auto holds = [&] { return starts[line - 1] <= at && (line == starts.size() || at < starts[line]); };
  while (line != 0 && line <= last + 1 && line <= starts.size() && !holds()) ++line;
  if (line == 0 || line > last + 1 || line > starts.size())
    line = static_cast<uint32_t>(std::upper_bound(starts.begin(), starts.end(), at) - starts.begin());
  last_line_.store(line, std::memory_order_relaxed);
  return line;
}

SourceLocation Sources::location(Loc loc) const {
  loc = originalLocation(loc);
  const uint32_t line = lineNumber(loc);
  if (line == 0) return {};
  const FileId id = fileOf(loc);
  const File& file = files_[id.index];
  const uint32_t start = file.lines->starts[line - 1];
  const uint32_t at = loc.offset - file.base;
  if (file.lines->ascii) return {id, line, at - start + 1};
  // Counting resumes at the last location on the same line, so that one very long line does not cost quadratic time.
  const std::lock_guard guard(last_mutex_);
  const bool resume = last_location_.file == id && last_location_.line == line && last_location_at_ <= at;
  const uint32_t from = resume ? last_location_at_ : start;
  const uint32_t column = resume ? last_location_.column : 1;
  last_location_ = {id, line, column + countCharacters(std::string_view(file.source).substr(from, at - from))};
  last_location_at_ = at;
  return last_location_;
}

std::string_view Sources::line(FileId id, uint32_t line) const {
  const File& file = files_[id.index];
  const std::vector<uint32_t>& starts = lineStarts(file);
  if (line == 0 || line > starts.size()) return {};
  std::string_view source = file.source;
  source =
      source.substr(starts[line - 1], line < starts.size() ? starts[line] - starts[line - 1] : std::string_view::npos);
  while (!source.empty() && (source.back() == '\n' || source.back() == '\r')) source.remove_suffix(1);
  return source;
}

std::string_view Sources::tokenAt(Loc loc) const {
  const FileId id = fileOf(loc);
  if (!id) return {};
  const std::string_view source = std::string_view(files_[id.index].source).substr(loc.offset - files_[id.index].base);
  if (source.empty() || source[0] == '\n' || source[0] == '\r') return {};
  if (isWordChar(source[0])) return source.substr(0, literalLength(source));
  if (source[0] == '\'' || source[0] == '"') return source.substr(0, quotedLength(source));
  if (source[0] == '%') return source.substr(0, addressLength(source));
  for (const std::string_view op : {":=", "=>", "<=", ">=", "<>", "**", "..", "?=", "(*", "*)", "//", "/*", "*/"}) {
    if (source.starts_with(op)) return source.substr(0, op.size());
  }
  return source.substr(0, 1);
}

ReadResult readFile(const std::string& path) {
  ReadResult result;
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) {
    result.error = std::strerror(errno);
    return result;
  }
  struct stat info = {};
  const bool regular = ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
  size_t used = 0;
  // One byte more than the size: the read that does not fill the buffer is the one that sees the end of the file.
  result.content.resize(regular ? std::min(static_cast<size_t>(info.st_size), kMaxFileBytes) + 1 : 64 * 1024);
  for (;;) {
    if (used == result.content.size()) result.content.resize(used * 2);
    const ssize_t n = ::read(fd, result.content.data() + used, result.content.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) result.error = std::strerror(errno);
    if (n <= 0) break;
    used += static_cast<size_t>(n);
    if (used > kMaxFileBytes) {
      result.error = "larger than 1 GiB";
      break;
    }
  }
  ::close(fd);
  result.content.resize(result.error.empty() ? used : 0);
  return result;
}

void appendUtf8(std::string& out, uint32_t c) {
  const auto add = [&out](uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    add(c);
  } else if (c < 0x800) {
    add(0xc0 | c >> 6);
    add(0x80 | (c & 63));
  } else if (c < 0x10000) {
    add(0xe0 | c >> 12);
    add(0x80 | (c >> 6 & 63));
    add(0x80 | (c & 63));
  } else {
    add(0xf0 | c >> 18);
    add(0x80 | (c >> 12 & 63));
    add(0x80 | (c >> 6 & 63));
    add(0x80 | (c & 63));
  }
}

bool decodeUtf16(std::string& source) {
  const bool little = source.starts_with("\xff\xfe");
  if (!little && !source.starts_with("\xfe\xff")) return true;
  if (source.size() % 2 != 0) return false;
  std::string out;
  out.reserve(source.size());
  const auto unit = [&](size_t i) {
    const auto first = static_cast<unsigned char>(source[i]), second = static_cast<unsigned char>(source[i + 1]);
    return static_cast<uint32_t>(little ? first | second << 8 : first << 8 | second);
  };
  for (size_t i = 2; i < source.size(); i += 2) {
    uint32_t c = unit(i);
    if (c >= 0xd800 && c < 0xe000) {
      const uint32_t low = i + 2 < source.size() ? unit(i + 2) : 0;
      if (c >= 0xdc00 || low < 0xdc00 || low >= 0xe000) return false;
      c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
      i += 2;
    }
    appendUtf8(out, c);
  }
  source = std::move(out);
  return true;
}

size_t findInvalidUtf8(std::string_view source) {
  constexpr uint64_t kHigh = 0x8080808080808080u;
  size_t i = 0;
  while (i < source.size()) {
    if (i + 8 <= source.size()) {
      uint64_t word = 0;
      std::memcpy(&word, source.data() + i, 8);
      if ((word & kHigh) == 0) {
        i += 8;
        continue;
      }
    }
    const auto lead = static_cast<unsigned char>(source[i]);
    if (lead < 0x80) {
      ++i;
      continue;
    }
    const size_t size = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || source.size() - i < size) return i;
    for (size_t k = 1; k < size; ++k) {
      if (!isContinuation(source[i + k])) return i;
    }
    const auto second = static_cast<unsigned char>(source[i + 1]);
    const bool overlong = (lead == 0xe0 && second < 0xa0) || (lead == 0xf0 && second < 0x90);
    const bool surrogate = lead == 0xed && second >= 0xa0;
    const bool beyond = lead == 0xf4 && second >= 0x90;
    if (overlong || surrogate || beyond) return i;
    i += size;
  }
  return std::string_view::npos;
}

}  // namespace rung

// Retained variables: see retain.h. A slot has magic, sequence, layout hash, length, and the CRC of all that and of the
// payload; then the payload: the bytes of the retain ranges, of the persistent ranges, and a directory of their
// variables (`path TAB kind TAB offset TAB size TAB type`). Both slots have the same size, a multiple of 4096, and so
// share no sector.
#include "retain.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <unordered_map>

namespace rung::host {
namespace {

struct Header {
  char magic[8];
  uint64_t sequence;
  uint64_t layout_hash;
  uint64_t slot_bytes;
  uint32_t length;        // of the payload
  uint32_t retain_bytes;  // the first part of it
  uint32_t value_bytes;   // retained and persistent bytes together; the directory follows
  uint32_t crc;           // of the header with crc 0, then the payload
};
constexpr char kMagic[8] = {'R', 'U', 'N', 'G', 'r', 't', '0', '1'};
constexpr uint64_t kSector = 4096;

// All bytes through pread or pwrite, which may take a part of them.
template <class Byte, class Move>
bool moveAll(Move move, int file, uint64_t offset, Byte* at, size_t size) {
  while (size > 0) {
    const ssize_t n = move(file, at, size, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    offset += static_cast<uint64_t>(n);
    size -= static_cast<size_t>(n);
  }
  return true;
}
bool readAt(int file, uint64_t offset, void* to, size_t size) {
  return moveAll(pread, file, offset, static_cast<char*>(to), size);
}
bool writeAt(int file, uint64_t offset, const void* from, size_t size) {
  return moveAll(pwrite, file, offset, static_cast<const char*>(from), size);
}

uint32_t bytesOf(const rung_range* ranges, uint32_t count) {
  uint32_t total = 0;
  for (uint32_t i = 0; i < count; ++i) total += ranges[i].size;
  return total;
}

}  // namespace

uint32_t crc32(const void* data, size_t size, uint32_t crc) {
  struct Table {
    uint32_t entries[256];
    Table() {
      for (uint32_t i = 0; i < 256; ++i) {
        uint32_t c = i;
        for (int k = 0; k < 8; ++k) c = c & 1 ? 0xEDB88320u ^ c >> 1 : c >> 1;
        entries[i] = c;
      }
    }
  };
  static const Table table;
  crc = ~crc;
  const unsigned char* at = static_cast<const unsigned char*>(data);
  for (size_t i = 0; i < size; ++i) crc = table.entries[(crc ^ at[i]) & 255] ^ crc >> 8;
  return ~crc;
}

Retain::Retain(const rung_module& module, Memory& memory, std::string path)
    : module_(module), memory_(memory), path_(std::move(path)) {}

Retain::~Retain() {
  if (file_ >= 0) close(file_);
}

bool Retain::exists() const { return access(path_.c_str(), F_OK) == 0; }

bool Retain::open(std::string& error) {
  if (file_ >= 0) return true;
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) error = path_ + ": " + strerror(errno);
  return file_ >= 0;
}

bool Retain::readSlot(int index, Slot& slot) const {
  struct stat status;
  if (fstat(file_, &status) != 0) return false;
  const uint64_t slot_bytes = static_cast<uint64_t>(status.st_size) / 2;
  if (slot_bytes % kSector != 0 || slot_bytes == 0) return false;
  const uint64_t offset = static_cast<uint64_t>(index) * slot_bytes;
  Header header;
  if (!readAt(file_, offset, &header, sizeof header)) return false;
  if (memcmp(header.magic, kMagic, sizeof kMagic) != 0 || header.slot_bytes != slot_bytes) return false;
  if (sizeof header + uint64_t{header.length} > slot_bytes || header.value_bytes > header.length ||
      header.retain_bytes > header.value_bytes)
    return false;
  slot.payload.resize(header.length);
  if (!readAt(file_, offset + sizeof header, slot.payload.data(), header.length)) return false;
  const uint32_t crc = header.crc;
  header.crc = 0;
  if (crc32(slot.payload.data(), slot.payload.size(), crc32(&header, sizeof header)) != crc) return false;
  slot.sequence = header.sequence;
  slot.layout_hash = header.layout_hash;
  slot.value_bytes = header.value_bytes;
  return true;
}

std::string Retain::directory(const Symbols& symbols) const {
  struct Range {
    const uint8_t* begin;
    uint32_t size, offset;
  };
  std::vector<Range> ranges;
  uint32_t offset = 0;
  const auto add = [&](const rung_range* list, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      ranges.push_back({memory_.block(list[i].block) + list[i].offset, list[i].size, offset});
      offset += list[i].size;
    }
  };
  add(module_.retain, module_.retain_count);
  add(module_.persistent, module_.persistent_count);
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });

  std::string text;
  std::vector<Variable> leaves;
  for (const Variable& root : symbols.roots()) symbols.expand(root, leaves);
  for (const Variable& leaf : leaves) {
    const uint8_t* const at = leaf.address();
    auto range = std::upper_bound(ranges.begin(), ranges.end(), at,
                                  [](const uint8_t* p, const Range& r) { return p < r.begin; });
    if (range == ranges.begin()) continue;
    --range;
    if (at + leaf.type->size > range->begin + range->size) continue;
    text += lowerCase(leaf.path) + '\t' + std::to_string(leaf.type->kind) + '\t' +
            std::to_string(range->offset + static_cast<uint32_t>(at - range->begin)) + '\t' +
            std::to_string(leaf.type->size) + '\t' + (module_.strings + leaf.type->name) + '\n';
  }
  return text;
}

bool Retain::restore(rung_start start, const Symbols& symbols, std::string& error) {
  if (!exists()) return true;
  if (!open(error)) return false;
  Slot slots[2];
  const bool ok[2] = {readSlot(0, slots[0]), readSlot(1, slots[1])};
  if (!ok[0] && !ok[1]) return true;  // neither slot is complete: initial values
  const Slot& slot = ok[1] && (!ok[0] || slots[1].sequence > slots[0].sequence) ? slots[1] : slots[0];
  sequence_ = slot.sequence;
  if (start == RUNG_ORIGIN) return true;

  const uint32_t retain_bytes = bytesOf(module_.retain, module_.retain_count);
  const uint32_t persistent_bytes = bytesOf(module_.persistent, module_.persistent_count);
  if (slot.layout_hash != module_.layout_hash || slot.payload.size() < size_t{retain_bytes} + persistent_bytes) {
    restoreByName(slot, start, symbols);
    return true;
  }
  const char* at = slot.payload.data();
  const auto copy = [&](const rung_range* ranges, uint32_t count, bool wanted) {
    for (uint32_t i = 0; i < count; ++i) {
      if (wanted) memcpy(memory_.block(ranges[i].block) + ranges[i].offset, at, ranges[i].size);
      at += ranges[i].size;
    }
  };
  copy(module_.retain, module_.retain_count, start == RUNG_WARM);
  copy(module_.persistent, module_.persistent_count, true);
  return true;
}

struct Retain::Entry {
  unsigned kind = 0, offset = 0, size = 0;
  std::string type;  // empty in files of earlier versions
};

bool Retain::readEntry(const std::string& line, std::string& path, Entry& entry) {
  const size_t tab = line.find('\t');
  int length = 0;
  if (tab == std::string::npos ||
      sscanf(line.c_str() + tab, "\t%u\t%u\t%u%n", &entry.kind, &entry.offset, &entry.size, &length) != 3)
    return false;
  path = line.substr(0, tab);
  const size_t end = tab + static_cast<size_t>(length);
  entry.type = end < line.size() ? line.substr(end + 1) : "";
  return true;
}

void Retain::restoreByName(const Slot& slot, rung_start start, const Symbols& symbols) {
  const auto each = [](const std::string& directory, size_t at, auto use) {
    for (size_t end; at < directory.size() && (end = directory.find('\n', at)) != std::string::npos; at = end + 1) {
      std::string path;
      Entry entry;
      if (readEntry(directory.substr(at, end - at), path, entry)) use(path, entry);
    }
  };
  std::unordered_map<std::string, Entry> entries;
  each(slot.payload, slot.value_bytes,
       [&](const std::string& path, const Entry& entry) { entries.emplace(path, entry); });
  const uint32_t retain_bytes = bytesOf(module_.retain, module_.retain_count);
  each(directory(symbols), 0, [&](const std::string& path, const Entry& now) {
    if (now.offset < retain_bytes && start != RUNG_WARM) return;
    const auto found = entries.find(path);
    Variable variable;
    std::string ignored;
    if (found == entries.end() || !symbols.find(path, variable, ignored)) return;
    const Entry& before = found->second;
    if (before.kind != now.kind || before.size != now.size) {
      changes_.push_back("`" + variable.path + "` was " + (before.type.empty() ? "of another type" : before.type) +
                         " and is " + now.type + " now: it starts with its initial value");
      return;
    }
    if (size_t{before.offset} + now.size > slot.value_bytes) return;
    memcpy(variable.address(), slot.payload.data() + before.offset, now.size);
  });
}

bool Retain::save(const Symbols& symbols, std::string& error) {
  if (!open(error)) return false;
  if (directory_.empty()) directory_ = directory(symbols);
  std::string payload;
  const auto append = [&](const rung_range* ranges, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i)
      payload.append(reinterpret_cast<const char*>(memory_.block(ranges[i].block) + ranges[i].offset), ranges[i].size);
  };
  append(module_.retain, module_.retain_count);
  const uint32_t retain_bytes = static_cast<uint32_t>(payload.size());
  append(module_.persistent, module_.persistent_count);
  const uint32_t value_bytes = static_cast<uint32_t>(payload.size());
  payload += directory_;

  Header header{};
  memcpy(header.magic, kMagic, sizeof kMagic);
  header.sequence = ++sequence_;
  header.layout_hash = module_.layout_hash;
  header.slot_bytes = (sizeof header + payload.size() + kSector - 1) / kSector * kSector;
  header.length = static_cast<uint32_t>(payload.size());
  header.retain_bytes = retain_bytes;
  header.value_bytes = value_bytes;
  header.crc = crc32(payload.data(), payload.size(), crc32(&header, sizeof header));

  struct stat status;
  if (fstat(file_, &status) != 0) return error = path_ + ": " + strerror(errno), false;
  bool ok = true;
  if (static_cast<uint64_t>(status.st_size) != 2 * header.slot_bytes) {
    // The size of the state has changed: a new file replaces the old one as a whole.
    const std::string next = path_ + ".new";
    const int file = ::open(next.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) return error = next + ": " + strerror(errno), false;
    ok = ftruncate(file, static_cast<off_t>(2 * header.slot_bytes)) == 0;
    const uint64_t offset = header.sequence % 2 * header.slot_bytes;
    ok = ok && writeAt(file, offset, &header, sizeof header) &&
         writeAt(file, offset + sizeof header, payload.data(), payload.size());
    ok = ok && fsync(file) == 0 && rename(next.c_str(), path_.c_str()) == 0;
    if (!ok) {
      error = path_ + ": " + strerror(errno);
      close(file);
      unlink(next.c_str());
      return false;
    }
    close(file_);
    file_ = file;
    const size_t slash = path_.find_last_of('/');
    const int folder =
        ::open(slash == std::string::npos ? "." : path_.substr(0, slash + 1).c_str(), O_RDONLY | O_CLOEXEC);
    if (folder >= 0) {
      fsync(folder);
      close(folder);
    }
    return true;
  }
  const uint64_t offset = header.sequence % 2 * header.slot_bytes;
  ok = writeAt(file_, offset, &header, sizeof header) &&
       writeAt(file_, offset + sizeof header, payload.data(), payload.size()) && fdatasync(file_) == 0;
  if (!ok) error = path_ + ": " + strerror(errno);
  return ok;
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
#include "tools/driver/encoding.h"

#include <sys/stat.h>

#include <filesystem>

#include "frontend/source/files.h"
#include "frontend/source/text.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

constexpr std::string_view kMark = "\xef\xbb\xbf";

Encoding encodingOf(std::string_view content) {
  if (content.starts_with(kMark)) return Encoding::Utf8WithMark;
  if (content.starts_with("\xff\xfe")) return Encoding::Utf16Little;
  return content.starts_with("\xfe\xff") ? Encoding::Utf16Big : Encoding::Utf8;
}

// `source` is UTF-8.
std::string encodeUtf16(std::string_view source, bool little) {
  std::string out;
  out.reserve(2 * source.size() + 2);
  const auto unit = [&](uint32_t value) {
    const char high = static_cast<char>(value >> 8), low = static_cast<char>(value & 0xff);
    out += little ? low : high;
    out += little ? high : low;
  };
  unit(0xfeff);
  for (Utf16Units units(source); !units.done();) unit(units.next());
  return out;
}

}  // namespace

bool decode(std::string& content, Encoding& encoding) {
  encoding = encodingOf(content);
  if (!decodeUtf16(content)) return false;
  if (encoding == Encoding::Utf8WithMark) content.erase(0, kMark.size());
  return true;
}

std::string encoded(const std::string& text, Encoding encoding) {
  switch (encoding) {
    case Encoding::Utf8: return text;
    case Encoding::Utf8WithMark: return std::string(kMark) + text;
    case Encoding::Utf16Little: return encodeUtf16(text, true);
    case Encoding::Utf16Big: return encodeUtf16(text, false);
  }
  return text;
}

std::string rewriteFile(const std::string& path, const std::string& content) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(path, error);
  struct stat info;
  if (error || stat(real.c_str(), &info) != 0) return "cannot write `" + path + "`: it is gone";
  return writeFile(real.string(), content, info.st_mode & 07777);
}

}  // namespace rung::driver

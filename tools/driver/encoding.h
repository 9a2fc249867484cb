// SPDX-License-Identifier: Apache-2.0
// How a source file stores its characters, which a command that changes the file keeps. In: the bytes of a file. Out:
// its text in UTF-8, and the bytes for another text. Called by the commands that write sources.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rung::driver {

enum class Encoding : uint8_t { Utf8, Utf8WithMark, Utf16Little, Utf16Big };

// Makes the bytes of a file its text, without a byte order mark. False: they are not what their mark says.
[[nodiscard]] bool decode(std::string& content, Encoding& encoding);
// The bytes for a text in UTF-8, with the byte order mark.
std::string encoded(const std::string& text, Encoding encoding);

// Gives an existing file another content, whole; keeps its permissions and a link to it. Returns an error message, or
// an empty string.
[[nodiscard]] std::string rewriteFile(const std::string& path, const std::string& content);

}  // namespace rung::driver

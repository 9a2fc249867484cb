// SPDX-License-Identifier: Apache-2.0
// Messages with a Content-Length header over a stream, as the protocols of language servers and debuggers have them.
// In: a descriptor whose other end is a stranger. Out: one message after the other; what is broken is reported and
// skipped, and the next header that can be understood counts. Never keeps more than a message of the largest size.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rung::protocol {

inline constexpr size_t kMaxMessageBytes = size_t{128} << 20;
inline constexpr size_t kMaxHeaderBytes = size_t{16} << 10;

class MessageReader {
 public:
  // Reads until `input` ends or `stop` can be read.
  MessageReader(int input, int stop) : input_(input), stop_(stop) {}

  enum class Kind { Message, Broken, End };
  struct Result {
    Kind kind;
    std::string text;  // the message, or what is wrong with its header
  };
  Result next();

 private:
  bool fill();
  bool readLine(std::string& line, bool& is_cut);
  Result readBody(size_t length);

  int input_, stop_;
  std::string buffer_;
  size_t at_ = 0;
};

// False: the other end is gone.
[[nodiscard]] bool writeMessage(int output, std::string_view text);

}  // namespace rung::protocol

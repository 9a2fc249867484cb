// SPDX-License-Identifier: Apache-2.0
#include "frontend/import/nct/messages.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "frontend/import/diagnostics.h"
#include "frontend/source/message_line.h"

namespace rung::importer::nct {
namespace {

constexpr uint32_t kMostDigits = 15;
constexpr size_t kLongestMessage = 255;  // bytes: a STRING(255) holds it

bool hasOnlyDigits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}
// 0: not one of a message.
uint32_t numberOf(std::string_view text) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value <= kMostMessage ? value : 0;
}

class FileReader {
 public:
  FileReader(const Sources& sources, Program& program, Diagnostics& diagnostics)
      : sources_(sources), program_(program), diagnostics_(diagnostics) {
    for (size_t k = 0; k < program.messages.size(); ++k) places_[program.messages[k].number] = {true, false, k};
  }

  void read(FileId file) {
    source_ = sources_.sourceText(file);
    base_ = sources_.begin(file).offset;
    replaced_ = 0;
    if (const size_t bad = findInvalidUtf8(source_); bad != std::string_view::npos)
      diagnostics_.report(diag::NctMessageUtf8, {base_ + static_cast<uint32_t>(bad)}, {}).length(1);
    for (size_t at = 0; at < source_.size() && !diagnostics_.full();) {
      const size_t end = std::min(source_.find('\n', at), source_.size());
      readLine(source_.substr(at, end - at));
      at = end + 1;
    }
    if (replaced_ > 0)
      reportAt(diagnostics_, diag::NctMessagesReplaced, first_replacing_,
               {std::to_string(replaced_), replaced_ == 1 ? "text" : "texts"})
          .declaredHere(first_replaced_);
  }

 private:
  struct Place {
    bool is_known = false, is_imported = false;
    size_t row = 0;  // of the program's messages
  };

  Word wordOf(std::string_view part) const {
    return {part, {base_ + static_cast<uint32_t>(part.data() - source_.data())}};
  }

  void readLine(std::string_view line) {
    const MessageParts parts = messageParts(line);
    if (parts.number.empty()) return;
    const Word number = wordOf(parts.number);
    const uint32_t value = numberOf(number.text);
    if (value == 0) {
      program_.lost_messages = true;
      if (hasOnlyDigits(number.text))
        reportAt(diagnostics_, diag::NctMessageRange, number, {number.text});
      else
        reportAt(diagnostics_, diag::NctMessageLine, number, {});
      return;
    }
    const MessageLine message{value, parts.text.empty() ? number : wordOf(parts.text), std::string(parts.text)};
    if (parts.text.empty())
      reportAt(diagnostics_, diag::NctMessageLine, number, {});
    else
      checkMessageText(message, diagnostics_);
    take(message, number);
  }

  void take(const MessageLine& line, const Word& number) {
    Place& place = places_[line.number];
    if (place.is_imported)
      return void(reportAt(diagnostics_, diag::NctTwice, number, {"message " + std::to_string(line.number)})
                      .declaredHere(program_.messages[place.row].written.loc));
    place.is_imported = true;
    if (!place.is_known) {
      place = {true, true, program_.messages.size()};
      program_.messages.push_back(line);
      return;
    }
    MessageLine& own = program_.messages[place.row];
    if (replaced_++ == 0) {
      first_replacing_ = number;
      first_replaced_ = own.written.loc;
    }
    own = line;
  }

  const Sources& sources_;
  Program& program_;
  Diagnostics& diagnostics_;
  std::array<Place, kMostMessage + 1> places_{};  // by number
  std::string_view source_;
  uint32_t base_ = 0;
  uint32_t replaced_ = 0;
  Word first_replacing_;
  Loc first_replaced_;
};

}  // namespace

// One item at most, {#0:F0} or {*0:F0} to {*0:F15}. NCT manual 6.13.
void checkMessageText(const MessageLine& line, Diagnostics& diagnostics) {
  const std::string_view text = line.text;
  const auto refuse = [&](std::string_view why) { reportAt(diagnostics, diag::NctMessageText, line.written, {why}); };
  if (text.size() > kLongestMessage) return refuse("255 bytes is the longest");
  if (text.empty()) return refuse("an empty text shows nothing");
  uint32_t items = 0;
  for (size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
    const std::string_view rest = text.substr(at + 1);
    if (!rest.starts_with("#") && !rest.starts_with("*")) continue;
    const size_t close = rest.find('}');
    const bool has_form = close != std::string_view::npos && rest.substr(1, 3) == "0:F";
    const std::string_view digits = has_form ? rest.substr(4, close - 4) : std::string_view();
    uint32_t count = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
    if (digits.empty() || error != std::errc() || end != digits.data() + digits.size() || count > kMostDigits ||
        (rest[0] == '#' && count != 0))
      return refuse("an item is `{#0:F0}`, or `{*0:F0}` to `{*0:F15}`");
    ++items;
  }
  if (items > 1) refuse("it prints one number at most");
}

void importMessages(const Sources& sources, std::span<const FileId> files, Program& program, Diagnostics& diagnostics) {
  FileReader reader(sources, program, diagnostics);
  for (const FileId file : files) reader.read(file);
}

}  // namespace rung::importer::nct

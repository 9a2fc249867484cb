// SPDX-License-Identifier: Apache-2.0
// JSON as a value: see json.h.
#include "json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace rung::host {
namespace {

void appendUtf8(std::string& out, uint32_t c) {
  const auto add = [&out](uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) return add(c);
  if (c < 0x800) {
    add(0xc0 | c >> 6);
  } else if (c < 0x10000) {
    add(0xe0 | c >> 12);
    add(0x80 | (c >> 6 & 63));
  } else {
    add(0xf0 | c >> 18);
    add(0x80 | (c >> 12 & 63));
    add(0x80 | (c >> 6 & 63));
  }
  add(0x80 | (c & 63));
}

// The bytes of the character at the front of a text that is not empty; 0: they are not UTF-8.
size_t characterSize(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const size_t size = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < size) return 0;
  for (size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool is_overlong = (lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xf0 && byte(1) < 0x90);
  const bool is_surrogate = lead == 0xed && byte(1) >= 0xa0, is_beyond = lead == 0xf4 && byte(1) >= 0x90;
  return is_overlong || is_surrogate || is_beyond ? 0 : size;
}

bool isUtf8(std::string_view text) {
  for (size_t size = 0; !text.empty(); text.remove_prefix(size))
    if (size = characterSize(text); size == 0) return false;
  return true;
}

// A parser by recursive descent over RFC 8259.
class JsonParser {
 public:
  JsonParser(std::string_view text, JsonLimits limits) : text_(text), limits_(limits) {}

  JsonResult parse() {
    JsonResult result;
    if (!isUtf8(text_)) return {{}, "the text is not UTF-8"};
    result.value = value(0);
    skipBlanks();
    if (error_.empty() && at_ != text_.size()) fail("expected the end of the text");
    result.error = std::move(error_);
    if (!result.error.empty()) result.value = {};
    return result;
  }

 private:
  void fail(std::string_view what) {
    if (error_.empty()) error_ = std::string(what) + " at byte " + std::to_string(at_);
  }
  void skipBlanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool accept(char c) {
    skipBlanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool acceptWord(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  Json value(uint32_t depth) {
    skipBlanks();
    if (++count_ > limits_.values) fail("too many values");
    if (depth > limits_.depth) fail("values nested too deep");
    if (!error_.empty()) return {};
    const char c = peek();
    if (c == '{') return object(depth);
    if (c == '[') return array(depth);
    if (c == '"') return string();
    if (c == '-' || (c >= '0' && c <= '9')) return number();
    if (acceptWord("true")) return true;
    if (acceptWord("false")) return false;
    if (acceptWord("null")) return {};
    fail("expected a value");
    return {};
  }

  Json object(uint32_t depth) {
    ++at_;
    Json object = Json::emptyObject();
    if (accept('}')) return object;
    do {
      skipBlanks();
      if (peek() != '"') fail("expected the name of a member");
      if (!error_.empty()) return {};
      std::string name = string();
      if (!accept(':')) fail("expected `:`");
      object.set(std::move(name), value(depth + 1));
      if (!error_.empty()) return {};
    } while (accept(','));
    if (!accept('}')) fail("expected `,` or `}`");
    return object;
  }

  Json array(uint32_t depth) {
    ++at_;
    Json::Array items;
    if (accept(']')) return items;
    do {
      items.push_back(value(depth + 1));
      if (!error_.empty()) return {};
    } while (accept(','));
    if (!accept(']')) fail("expected `,` or `]`");
    return items;
  }

  Json number() {
    const size_t begin = at_;
    const auto digits = [&] {
      const size_t first = at_;
      while (peek() >= '0' && peek() <= '9') ++at_;
      if (at_ == first) fail("expected a digit");
    };
    if (peek() == '-') ++at_;
    if (peek() == '0') {
      ++at_;
    } else {
      digits();
    }
    const bool is_integer = peek() != '.' && peek() != 'e' && peek() != 'E';
    if (peek() == '.') {
      ++at_;
      digits();
    }
    if (peek() == 'e' || peek() == 'E') {
      ++at_;
      if (peek() == '+' || peek() == '-') ++at_;
      digits();
    }
    const char* first = text_.data() + begin;
    const char* last = text_.data() + at_;
    int64_t integer = 0;
    if (is_integer && std::from_chars(first, last, integer).ec == std::errc()) return integer;
    double real = 0;
    std::from_chars(first, last, real);  // beyond the range it stays 0
    return real;
  }

  // Four hexadecimal digits.
  uint32_t unit() {
    uint32_t value = 0;
    const std::string_view digits = text_.substr(at_, 4);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (error != std::errc() || end != digits.data() + 4) fail("expected four hexadecimal digits");
    at_ = std::min(at_ + 4, text_.size());
    return value;
  }

  // A surrogate without its other half becomes the replacement character.
  void appendEscape(std::string& out) {
    uint32_t c = unit();
    if (c >= 0xd800 && c < 0xdc00 && text_.substr(at_, 2) == "\\u") {
      at_ += 2;
      const uint32_t low = unit();
      c = low >= 0xdc00 && low < 0xe000 ? 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00) : 0xfffd;
    } else if (c >= 0xd800 && c < 0xe000) {
      c = 0xfffd;
    }
    appendUtf8(out, c);
  }

  std::string string() {
    std::string out;
    ++at_;
    while (error_.empty()) {
      const size_t begin = at_;
      while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\\' &&
             static_cast<unsigned char>(text_[at_]) >= 0x20)
        ++at_;
      out += text_.substr(begin, at_ - begin);
      if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\\')) {
        fail("expected the end of a string");
        break;
      }
      if (text_[at_++] == '"') break;
      static constexpr std::string_view kEscapes = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
      const char escape = peek();
      if (const size_t known = kEscapes.find(escape); escape != '\0' && known != std::string_view::npos) {
        ++at_;
        out += kMeanings[known];
      } else if (escape == 'u') {
        ++at_;
        appendEscape(out);
      } else {
        fail("unknown escape sequence");
      }
    }
    return out;
  }

  std::string_view text_;
  JsonLimits limits_;
  size_t at_ = 0;
  uint32_t count_ = 0;
  std::string error_;
};

const Json kNull;

}  // namespace

Json::Json() = default;
Json::Json(std::nullptr_t) {}
Json::Json(bool value) : value_(value) {}
Json::Json(int value) : value_(int64_t{value}) {}
Json::Json(uint32_t value) : value_(int64_t{value}) {}
Json::Json(int64_t value) : value_(value) {}
Json::Json(double value) : value_(value) {}
Json::Json(const char* value) : value_(std::string(value)) {}
Json::Json(std::string_view value) : value_(std::string(value)) {}
Json::Json(std::string value) : value_(std::move(value)) {}
Json::Json(Array values) : value_(std::move(values)) {}
Json::Json(Numbers values) : value_(std::move(values)) {}
Json::Json(std::initializer_list<JsonMember> members) {
  Object object;
  object.reserve(members.size());
  for (const JsonMember& member : members) object.push_back({std::move(member.name), std::move(member.value)});
  value_ = std::move(object);
}
Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;
Json::~Json() = default;

Json Json::emptyObject() {
  Json object;
  object.value_ = Object();
  return object;
}

const Json& Json::operator[](std::string_view member) const {
  for (const JsonMember& candidate : members())
    if (candidate.name == member) return candidate.value;
  return kNull;
}

const Json::Array& Json::items() const {
  static const Array kNone;
  const Array* items = std::get_if<Array>(&value_);
  return items == nullptr ? kNone : *items;
}

const Json::Object& Json::members() const {
  static const Object kNone;
  const Object* members = std::get_if<Object>(&value_);
  return members == nullptr ? kNone : *members;
}

bool Json::isTrue() const {
  const bool* value = std::get_if<bool>(&value_);
  return value != nullptr && *value;
}

std::string_view Json::text() const {
  const std::string* value = std::get_if<std::string>(&value_);
  return value == nullptr ? std::string_view() : *value;
}

int64_t Json::integer(int64_t otherwise) const {
  if (const int64_t* value = std::get_if<int64_t>(&value_)) return *value;
  const double* real = std::get_if<double>(&value_);
  return real != nullptr && std::abs(*real) < 9e15 ? static_cast<int64_t>(*real) : otherwise;
}

void Json::set(std::string name, Json value) {
  if (isNull()) value_ = Object();
  std::get<Object>(value_).push_back({std::move(name), std::move(value)});
}

void Json::add(Json value) {
  if (isNull()) value_ = Array();
  std::get<Array>(value_).push_back(std::move(value));
}

std::string Json::toText() const {
  std::string out;
  append(out);
  return out;
}

namespace {

template <class Values, class One>
void appendList(std::string& out, char open, const Values& values, char close, One one) {
  out += open;
  bool first = true;
  for (const auto& value : values) {
    if (!first) out += ',';
    first = false;
    one(value);
  }
  out += close;
}

void appendControl(std::string& out, unsigned char c) {
  char text[8];
  std::snprintf(text, sizeof text, "\\u%04x", static_cast<unsigned>(c));
  out += c == '\n' ? "\\n" : c == '\t' ? "\\t" : text;
}

void appendReal(std::string& out, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  out += std::isfinite(value) ? text : "null";
}

}  // namespace

void appendJsonText(std::string& out, std::string_view text) {
  out += '"';
  while (!text.empty()) {
    const auto lead = static_cast<unsigned char>(text[0]);
    const size_t size = characterSize(text);
    if (size == 0)
      out += "\\ufffd";
    else if (lead < 0x20 || lead == 0x7f)
      appendControl(out, lead);
    else if (lead == '"' || lead == '\\')
      (out += '\\') += text[0];
    else
      out += text.substr(0, size);
    text.remove_prefix(size == 0 ? 1 : size);
  }
  out += '"';
}

void Json::append(std::string& out) const {
  if (const bool* truth = std::get_if<bool>(&value_)) {
    out += *truth ? "true" : "false";
  } else if (const int64_t* integer = std::get_if<int64_t>(&value_)) {
    out += std::to_string(*integer);
  } else if (const double* real = std::get_if<double>(&value_)) {
    appendReal(out, *real);
  } else if (const std::string* text = std::get_if<std::string>(&value_)) {
    appendJsonText(out, *text);
  } else if (const Array* items = std::get_if<Array>(&value_)) {
    appendList(out, '[', *items, ']', [&](const Json& item) { item.append(out); });
  } else if (const Numbers* numbers = std::get_if<Numbers>(&value_)) {
    appendList(out, '[', *numbers, ']', [&](uint32_t number) { out += std::to_string(number); });
  } else if (const Object* members = std::get_if<Object>(&value_)) {
    appendList(out, '{', *members, '}', [&](const JsonMember& member) {
      appendJsonText(out, member.name);
      out += ':';
      member.value.append(out);
    });
  } else {
    out += "null";
  }
}

bool operator==(const Json& a, const Json& b) { return a.value_ == b.value_; }

JsonResult parseJson(std::string_view text, JsonLimits limits) { return JsonParser(text, limits).parse(); }

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// JSON as a value, for the monitor and for the protocols of editors and debuggers. In: a text of a stranger, read with
// limits on depth and on the number of values. Out: a value whose questions have an answer for any content, since a
// member that is missing is null; and the text of a value. Used by monitor.cpp and, by tools/protocol/json.h, by tools.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rung::host {

struct JsonMember;

class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::vector<JsonMember>;  // in the order of the text
  using Numbers = std::vector<uint32_t>;   // a long array of numbers, only written

  Json();
  Json(std::nullptr_t);
  Json(bool value);
  Json(int value);
  Json(uint32_t value);
  Json(int64_t value);
  Json(double value);
  Json(const char* value);
  Json(std::string_view value);
  Json(std::string value);
  Json(Array values);
  Json(Numbers values);
  Json(std::initializer_list<JsonMember> members);  // an object
  static Json emptyObject();
  Json(const Json&);
  Json(Json&&) noexcept;
  Json& operator=(const Json&);
  Json& operator=(Json&&) noexcept;
  ~Json();

  bool isNull() const { return std::holds_alternative<std::monostate>(value_); }
  bool isText() const { return std::holds_alternative<std::string>(value_); }
  bool isInteger() const { return std::holds_alternative<int64_t>(value_); }
  bool isObject() const { return std::holds_alternative<Object>(value_); }
  bool isArray() const { return std::holds_alternative<Array>(value_); }

  // What the value is not, is null, empty, false or 0.
  const Json& operator[](std::string_view member) const;
  const Array& items() const;
  const Object& members() const;
  bool isTrue() const;
  std::string_view text() const;
  int64_t integer(int64_t otherwise = 0) const;  // of a number; a fraction is cut

  // Adds a member to an object.
  void set(std::string name, Json value);
  // Adds an element to an array; null becomes one.
  void add(Json value);

  std::string toText() const;

  friend bool operator==(const Json& a, const Json& b);

 private:
  void append(std::string& out) const;

  std::variant<std::monostate, bool, int64_t, double, std::string, Array, Object, Numbers> value_;
};

// The object that is made of a list of members takes them over, so they may change although the list is constant.
struct JsonMember {
  mutable std::string name;
  mutable Json value;
  friend bool operator==(const JsonMember& a, const JsonMember& b) { return a.name == b.name && a.value == b.value; }
};

// Appends a text in quotes. Bytes that are not UTF-8 become the replacement character.
void appendJsonText(std::string& out, std::string_view text);

struct JsonLimits {
  uint32_t depth = 100;
  uint32_t values = 4'000'000;
};
// The value, or why the text is not JSON and where: "expected `,` or `}` at byte 12".
struct JsonResult {
  Json value;
  std::string error;  // empty: read
};
[[nodiscard]] JsonResult parseJson(std::string_view text, JsonLimits limits = {});

}  // namespace rung::host

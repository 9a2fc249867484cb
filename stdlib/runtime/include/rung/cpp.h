/* SPDX-License-Identifier: Apache-2.0 */
/* IEC types for a body in C++ (syntax manual 5.8). In: nothing but the standard library. Out: the elementary types by
 * their names, strings with c_str() and size(), arrays with `table`, and views of the program's memory as those.
 * Included by the file that rung makes for such a body (codegen/cpp_bodies.cpp), which adds the times, the structures,
 * the enumerations and the blocks of the program. All are views in place: no type here owns memory. */
#ifndef RUNG_CPP_H
#define RUNG_CPP_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <string>

#include "rung/code.h"

namespace rung {
namespace cpp {

/* Names the body that runs, for messages about crashes and bodies that do not end. */
class Running {
 public:
  Running(rung_context* context, const char* where) : context_(context), outer_(context->cpp_body) {
    context->cpp_body = where;
  }
  ~Running() { context_->cpp_body = outer_; }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  rung_context* context_;
  const char* outer_;
};

/* One byte, TRUE when it is not 0. */
struct RUNG_MAY_ALIAS BOOL {
  uint8_t byte;
  BOOL() = default;
  constexpr BOOL(bool value) : byte(value ? 1 : 0) {}
  constexpr operator bool() const { return byte != 0; }
  BOOL& operator&=(bool other) { return *this = *this && other; }
  BOOL& operator|=(bool other) { return *this = *this || other; }
  BOOL& operator^=(bool other) { return *this = static_cast<bool>(*this) != other; }
};

typedef uint8_t BYTE;
typedef uint16_t WORD;
typedef uint32_t DWORD;
typedef uint64_t LWORD;
typedef int8_t SINT;
typedef int16_t INT;
typedef int32_t DINT;
typedef int64_t LINT;
typedef uint8_t USINT;
typedef uint16_t UINT;
typedef uint32_t UDINT;
typedef uint64_t ULINT;
typedef float REAL;
typedef double LREAL;
typedef uint8_t CHAR;
typedef uint16_t WCHAR;
typedef uint32_t UCHAR;

/* STRING[N], USTRING[N], WSTRING[N]: characters and a NUL; values that do not fit are cut, USTRING between characters.
 */
template <class Char, uint32_t N, bool Utf8 = false>
struct RUNG_MAY_ALIAS BasicString {
  Char characters[N + 1];
  BasicString() { characters[0] = 0; }
  BasicString(const Char* string) { assign(string, std::char_traits<Char>::length(string)); }
  BasicString(const std::basic_string<Char>& string) { assign(string.data(), string.size()); }
  template <uint32_t M, bool Other>
  BasicString(const BasicString<Char, M, Other>& string) {
    assign(string.c_str(), string.size());
  }
  const Char* c_str() const { return characters; }
  size_t size() const {
    size_t length = 0;
    while (length < N && characters[length] != 0) ++length;
    return length;
  }
  operator std::basic_string<Char>() const { return {characters, size()}; }
  Char& operator[](size_t at) { return characters[at]; }
  const Char& operator[](size_t at) const { return characters[at]; }
  BasicString& operator+=(const std::basic_string<Char>& more) {
    return *this = static_cast<std::basic_string<Char>>(*this) + more;
  }
  friend bool operator==(const BasicString& a, const std::basic_string<Char>& b) { return b.compare(a.c_str()) == 0; }
  friend bool operator!=(const BasicString& a, const std::basic_string<Char>& b) { return !(a == b); }
  friend bool operator==(const BasicString& a, const Char* b) { return a == std::basic_string<Char>(b); }
  friend bool operator!=(const BasicString& a, const Char* b) { return !(a == b); }
  friend bool operator==(const BasicString& a, const BasicString& b) { return a == b.c_str(); }
  friend bool operator!=(const BasicString& a, const BasicString& b) { return !(a == b); }
  friend std::basic_string<Char> operator+(const BasicString& a, const std::basic_string<Char>& b) {
    return static_cast<std::basic_string<Char>>(a) + b;
  }
  friend std::basic_string<Char> operator+(const std::basic_string<Char>& a, const BasicString& b) {
    return a + b.c_str();
  }

 private:
  void assign(const Char* string, size_t length) {  // `string` may be part of *this
    if (length > N) {
      length = N;
      while (Utf8 && length > 0 && (static_cast<unsigned char>(string[length]) & 0xc0) == 0x80) --length;
    }
    memmove(characters, string, length * sizeof(Char));
    characters[length] = 0;
  }
};
template <uint32_t N>
using String = BasicString<char, N>;
template <uint32_t N>
using WideString = BasicString<char16_t, N>;
template <uint32_t N>
using Utf8String = BasicString<char, N, true>;
typedef String<255> STRING;
typedef WideString<255> WSTRING;
typedef Utf8String<255> USTRING;

/* ARRAY: `x.table[i - low]`; Table is a C array type. */
template <class Table>
struct RUNG_MAY_ALIAS Array {
  Table table;
};

/* Little-endian bytes at any address. */
template <class T>
T located(const uint8_t* bytes) {
  static_assert(sizeof(T) == 2 || sizeof(T) == 4 || sizeof(T) == 8, "one byte needs no order");
  T value;
  if (sizeof(T) == 2) {
    const uint16_t raw = rung_get16(bytes);
    memcpy(static_cast<void*>(&value), &raw, sizeof value);
  } else if (sizeof(T) == 4) {
    const uint32_t raw = rung_get32(bytes);
    memcpy(static_cast<void*>(&value), &raw, sizeof value);
  } else {
    const uint64_t raw = rung_get64(bytes);
    memcpy(static_cast<void*>(&value), &raw, sizeof value);
  }
  return value;
}
template <class T>
void locate(uint8_t* bytes, const T& value) {
  if (sizeof(T) == 2) {
    uint16_t raw = 0;
    memcpy(&raw, &value, sizeof value);
    rung_put16(bytes, raw);
  } else if (sizeof(T) == 4) {
    uint32_t raw = 0;
    memcpy(&raw, &value, sizeof value);
    rung_put32(bytes, raw);
  } else {
    uint64_t raw = 0;
    memcpy(&raw, &value, sizeof value);
    rung_put64(bytes, raw);
  }
}

/* A variable of several bytes in the process image: converts to its value, and takes one. */
template <class T>
struct RUNG_MAY_ALIAS Located {
  uint8_t bytes[sizeof(T)];
  operator T() const { return located<T>(bytes); }
  Located& operator=(T value) {
    locate(bytes, value);
    return *this;
  }
  template <class U>
  Located& operator+=(const U& by) {
    return *this = static_cast<T>(static_cast<T>(*this) + by);
  }
  template <class U>
  Located& operator-=(const U& by) {
    return *this = static_cast<T>(static_cast<T>(*this) - by);
  }
  template <class U>
  Located& operator*=(const U& by) {
    return *this = static_cast<T>(static_cast<T>(*this) * by);
  }
  template <class U>
  Located& operator/=(const U& by) {
    return *this = static_cast<T>(static_cast<T>(*this) / by);
  }
  template <class U>
  Located& operator%=(const U& by) {
    return *this = static_cast<T>(static_cast<T>(*this) % by);
  }
  template <class U>
  Located& operator&=(const U& by) {
    return *this = static_cast<T>(static_cast<T>(*this) & by);
  }
  template <class U>
  Located& operator|=(const U& by) {
    return *this = static_cast<T>(static_cast<T>(*this) | by);
  }
  template <class U>
  Located& operator^=(const U& by) {
    return *this = static_cast<T>(static_cast<T>(*this) ^ by);
  }
  Located& operator<<=(int by) { return *this = static_cast<T>(static_cast<T>(*this) << by); }
  Located& operator>>=(int by) { return *this = static_cast<T>(static_cast<T>(*this) >> by); }
  Located& operator++() { return *this += 1; }
  Located& operator--() { return *this -= 1; }
  T operator++(int) {
    const T before = *this;
    ++*this;
    return before;
  }
  T operator--(int) {
    const T before = *this;
    --*this;
    return before;
  }
};
/* An enumeration, which compares with its items. */
template <class T>
struct RUNG_MAY_ALIAS LocatedEnum : Located<T> {
  using Located<T>::operator=;
  operator typename T::Value() const { return located<T>(this->bytes).value; }
};
/* A WSTRING. */
template <uint32_t N>
struct RUNG_MAY_ALIAS Located<WideString<N>> {
  uint8_t bytes[sizeof(WideString<N>)];
  operator WideString<N>() const {
    WideString<N> value;
    for (uint32_t i = 0; i <= N; ++i) value.characters[i] = static_cast<char16_t>(rung_get16(bytes + i * 2));
    return value;
  }
  operator std::u16string() const { return static_cast<WideString<N>>(*this); }
  Located& operator=(const WideString<N>& value) {
    const uint32_t end = static_cast<uint32_t>(value.size());
    for (uint32_t i = 0; i <= end; ++i) rung_put16(bytes + i * 2, value.characters[i]);
    return *this;
  }
  size_t size() const { return static_cast<WideString<N>>(*this).size(); }
};

/* A BOOL at one bit of the process image. */
class ConstantBit {
 public:
  ConstantBit(uint8_t* byte, uint32_t bit) : byte_(byte), mask_(static_cast<uint8_t>(1u << bit)) {}
  operator bool() const { return (*byte_ & mask_) != 0; }
  operator BOOL() const { return static_cast<bool>(*this); }

 protected:
  uint8_t* byte_;
  uint8_t mask_;
};
class LocatedBit : public ConstantBit {
 public:
  using ConstantBit::ConstantBit;
  LocatedBit(const LocatedBit&) = default;
  const LocatedBit& operator=(bool value) const {
    *byte_ = static_cast<uint8_t>(value ? *byte_ | mask_ : *byte_ & ~mask_);
    return *this;
  }
  const LocatedBit& operator=(const LocatedBit& other) const { return *this = static_cast<bool>(other); }
  const LocatedBit& operator&=(bool other) const { return *this = *this && other; }
  const LocatedBit& operator|=(bool other) const { return *this = *this || other; }
  const LocatedBit& operator^=(bool other) const { return *this = static_cast<bool>(*this) != other; }
};

/* Memory of generated code, seen as the type that a body in C++ has for it, and vice versa. */
template <class To, class From>
To& view(From& memory) {
  static_assert(sizeof(To) == sizeof(From), "a view has the size of what it shows");
  return reinterpret_cast<To&>(memory);
}
template <class To, class From>
const To& view(const From& memory) {
  static_assert(sizeof(To) == sizeof(From), "a view has the size of what it shows");
  return reinterpret_cast<const To&>(memory);
}
template <class To, class From>
To bits(const From& value) {
  static_assert(sizeof(To) == sizeof(From), "a copy has the size of what it copies");
  To copy;
  memcpy(static_cast<void*>(&copy), &value, sizeof copy);
  return copy;
}

/* Converts milliseconds or seconds to a type of time; saturates at its range. */
template <class Time>
Time time(double units) {
  const double low = static_cast<Time>(-1) < static_cast<Time>(0) ? -2147483648.0 : 0.0;
  const double high = low < 0 ? 2147483647.0 : 4294967295.0;
  return static_cast<Time>(units < low ? low : units > high ? high : units < 0 ? units - 0.5 : units + 0.5);
}
/* Days from 1970-01-01 to a day of the calendar. */
inline int64_t days(int day, int month, int year) {
  const int64_t y = month <= 2 ? year - 1 : year, era = (y >= 0 ? y : y - 399) / 400, of_era = y - era * 400;
  const int64_t of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

}  // namespace cpp
}  // namespace rung

#include "rung/cpp_functions.h"

#endif

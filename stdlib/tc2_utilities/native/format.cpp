// SPDX-License-Identifier: Apache-2.0
// Native body of FB_FormatString in format.st. Nothing is read outside of the format and of the arguments; no heap.
#include <string.h>

#include "rung/code.h"
#include "rung/native_blocks.h"
#include "rung/reals.h"

namespace {

using namespace rung_tc2_utilities;
using Argument = T_Arg_type;

enum Trouble : uint32_t { kOk, kBadFormat, kMissing, kOtherType, kTooLong };

constexpr size_t kMax = 255;
constexpr int kMaxDigits = 64;  // of a precision: more digits than any number has

struct Output {
  char* text;
  size_t capacity, length;
  Trouble trouble;

  void put(const char* piece, size_t count) {
    const size_t room = capacity - length;
    if (count > room) trouble = kTooLong;
    memcpy(text + length, piece, count < room ? count : room);
    length += count < room ? count : room;
  }
};

const void* dataOf(const Argument& argument) {
  return reinterpret_cast<const void*>(static_cast<uintptr_t>(argument.pData_));
}

template <class Number>
Number read(const void* at) {
  Number number;
  memcpy(&number, at, sizeof number);
  return number;
}

bool isWhole(int16_t type) {
  return type >= ARGTYPE_BYTE_ && type <= ARGTYPE_ULINT_ && type != ARGTYPE_REAL_ && type != ARGTYPE_LREAL_ &&
         type != ARGTYPE_STRING_;
}

// The value of an integer; `width` is set to its bits.
int64_t wholeOf(const Argument& argument, int& width) {
  switch (static_cast<E_ArgType_type>(argument.eType_)) {
    case ARGTYPE_BYTE_:
    case ARGTYPE_USINT_: width = 8; return read<uint8_t>(dataOf(argument));
    case ARGTYPE_BOOL_: width = 8; return read<uint8_t>(dataOf(argument)) != 0 ? 1 : 0;
    case ARGTYPE_SINT_: width = 8; return read<int8_t>(dataOf(argument));
    case ARGTYPE_WORD_:
    case ARGTYPE_UINT_: width = 16; return read<uint16_t>(dataOf(argument));
    case ARGTYPE_INT_: width = 16; return read<int16_t>(dataOf(argument));
    case ARGTYPE_DWORD_:
    case ARGTYPE_UDINT_: width = 32; return read<uint32_t>(dataOf(argument));
    case ARGTYPE_DINT_: width = 32; return read<int32_t>(dataOf(argument));
    case ARGTYPE_LWORD_:
    case ARGTYPE_LINT_:
    case ARGTYPE_ULINT_: width = 64; return read<int64_t>(dataOf(argument));
    case ARGTYPE_UNKNOWN_:
    case ARGTYPE_REAL_:
    case ARGTYPE_LREAL_:
    case ARGTYPE_STRING_: break;
  }
  width = 64;
  return 0;
}

struct Specifier {
  char flags[6];
  int flag_count;
  int width;      // -1: none
  int precision;  // -1: none
};

bool has(const Specifier& specifier, char flag) {
  return memchr(specifier.flags, flag, static_cast<size_t>(specifier.flag_count)) != nullptr;
}

// One conversion: sign or `0x`, zeros, digits or characters; and blanks or zeros up to the width.
void putPadded(Output& out, const Specifier& specifier, const char* front, const char* text, size_t count, size_t zeros,
               bool may_fill_with_zeros) {
  const size_t length = strlen(front) + zeros + count;
  const size_t width = specifier.width < 0 ? 0 : static_cast<size_t>(specifier.width);
  const size_t room = width > length ? width - length : 0;
  const bool is_left = has(specifier, '-'), with_zeros = may_fill_with_zeros && !is_left && has(specifier, '0');
  for (size_t i = 0; !is_left && !with_zeros && i < room; ++i) out.put(" ", 1);
  out.put(front, strlen(front));
  for (size_t i = 0; i < zeros + (with_zeros ? room : 0); ++i) out.put("0", 1);
  out.put(text, count);
  for (size_t i = 0; is_left && i < room; ++i) out.put(" ", 1);
}

const char* signOf(const Specifier& specifier, bool negative) {
  return negative ? "-" : has(specifier, '+') ? "+" : has(specifier, ' ') ? " " : "";
}

// %d, %i, %u, %o, %x, %X as printf does, and %b.
void putWhole(Output& out, const Specifier& specifier, char type, bool negative, uint64_t magnitude) {
  const uint32_t base = type == 'b' ? 2 : type == 'o' ? 8 : type == 'x' || type == 'X' ? 16 : 10;
  const char* const symbols = type == 'X' ? "0123456789ABCDEF" : "0123456789abcdef";
  char digits[64];
  size_t begin = sizeof digits;
  for (uint64_t rest = magnitude; rest != 0; rest /= base) digits[--begin] = symbols[rest % base];
  if (magnitude == 0 && (specifier.precision != 0 || type == 'b')) digits[--begin] = '0';
  const size_t count = sizeof digits - begin;
  const size_t wanted = specifier.precision < 0 ? 0 : static_cast<size_t>(specifier.precision);
  size_t zeros = wanted > count ? wanted - count : 0;
  const char* front = type == 'd' || type == 'i' ? signOf(specifier, negative) : "";
  if (has(specifier, '#')) {
    if (base == 16 && magnitude != 0) front = type == 'x' ? "0x" : "0X";
    if (base == 8 && zeros == 0 && (count == 0 || digits[begin] != '0')) zeros = 1;
  }
  putPadded(out, specifier, front, digits + begin, count, zeros, specifier.precision < 0);
}

// %f, %e, %E, %g, %G as printf does.
void putReal(Output& out, const Specifier& specifier, char type, double number) {
  const bool is_upper = type < 'a', is_finite = __builtin_isfinite(number);
  char text[RUNG_REAL_PRINT_ROOM];
  uint32_t count = 3;
  if (is_finite)
    count = rung_real_print(number, is_upper ? static_cast<char>(type + 'a' - 'A') : type,
                            specifier.precision < 0 ? 6 : static_cast<uint32_t>(specifier.precision),
                            has(specifier, '#'), text);
  else
    memcpy(text, number != number ? "nan" : "inf", count);
  for (uint32_t i = 0; is_upper && i < count; ++i)
    if (text[i] >= 'a') text[i] = static_cast<char>(text[i] - 'a' + 'A');
  const bool negative = rung_bits_of_f64(number) >> 63 != 0;
  putPadded(out, specifier, signOf(specifier, negative), text, count, 0, is_finite);
}

void putArgument(Output& out, const Specifier& specifier, char type, const Argument& argument) {
  int bits_of_type = 64;
  switch (type) {
    case 'd':
    case 'i': {
      if (!isWhole(argument.eType_)) break;
      const int64_t value = wholeOf(argument, bits_of_type);
      const uint64_t bits = static_cast<uint64_t>(value);
      return putWhole(out, specifier, type, value < 0, value < 0 ? 0 - bits : bits);
    }
    case 'u':
    case 'b':
    case 'o':
    case 'x':
    case 'X': {
      if (!isWhole(argument.eType_)) break;
      uint64_t bits = static_cast<uint64_t>(wholeOf(argument, bits_of_type));
      if (bits_of_type < 64) bits &= (uint64_t{1} << bits_of_type) - 1;
      return putWhole(out, specifier, type, false, bits);
    }
    case 'f':
    case 'e':
    case 'E':
    case 'g':
    case 'G':
      if (argument.eType_ == ARGTYPE_REAL_)
        return putReal(out, specifier, type, static_cast<double>(read<float>(dataOf(argument))));
      if (argument.eType_ == ARGTYPE_LREAL_) return putReal(out, specifier, type, read<double>(dataOf(argument)));
      break;
    case 's': {
      const char* text = nullptr;
      if (argument.eType_ == ARGTYPE_STRING_) text = static_cast<const char*>(dataOf(argument));
      if (argument.eType_ == ARGTYPE_BOOL_) text = wholeOf(argument, bits_of_type) != 0 ? "TRUE" : "FALSE";
      if (text == nullptr) break;
      const size_t most = specifier.precision < 0 ? kMax : static_cast<size_t>(specifier.precision);
      const void* const end = memchr(text, 0, most);
      const size_t count = end == nullptr ? most : static_cast<size_t>(static_cast<const char*>(end) - text);
      return putPadded(out, specifier, "", text, count, 0, false);
    }
    case 'c': {
      if (!isWhole(argument.eType_)) break;
      const char character = static_cast<char>(wholeOf(argument, bits_of_type));
      if (character != 0) out.put(&character, 1);
      return;
    }
    default: out.trouble = kBadFormat; return;
  }
  out.trouble = kOtherType;
}

class Arguments {
 public:
  explicit Arguments(const FB_FormatString_type& block)
      : all_{&block.arg1_, &block.arg2_, &block.arg3_, &block.arg4_, &block.arg5_,
             &block.arg6_, &block.arg7_, &block.arg8_, &block.arg9_, &block.arg10_} {}
  const Argument* take() { return next_ == 10 || all_[next_]->pData_ == 0 ? nullptr : all_[next_++]; }

 private:
  const Argument* const all_[10];
  uint32_t next_ = 0;
};

// Reads a width or a precision: digits, or `*`, which takes an argument.
bool readNumber(const char*& at, Arguments& arguments, int most, int& number, Trouble& trouble) {
  if (*at == '*') {
    ++at;
    const Argument* const argument = arguments.take();
    if (argument == nullptr || !isWhole(argument->eType_)) {
      trouble = argument == nullptr ? kMissing : kOtherType;
      return false;
    }
    int bits = 0;
    const int64_t value = wholeOf(*argument, bits);
    if (value < 0 || value > most) {
      trouble = kBadFormat;
      return false;
    }
    number = static_cast<int>(value);
    return true;
  }
  for (; *at >= '0' && *at <= '9'; ++at) {
    number = (number < 0 ? 0 : number) * 10 + (*at - '0');
    if (number > most) {
      trouble = kBadFormat;
      return false;
    }
  }
  return true;
}

void format(Output& out, const char* at, Arguments& arguments) {
  while (*at != 0 && out.trouble == kOk) {
    if (*at != '%') {
      const char* const begin = at;
      while (*at != 0 && *at != '%') ++at;
      out.put(begin, static_cast<size_t>(at - begin));
      continue;
    }
    if (*++at == '%') {
      out.put(at++, 1);
      continue;
    }
    Specifier specifier{{}, 0, -1, -1};
    while (*at != 0 && strchr("-+ 0#", *at) != nullptr) {
      if (specifier.flag_count == 5) {
        out.trouble = kBadFormat;
        return;
      }
      specifier.flags[specifier.flag_count++] = *at++;
    }
    if (!readNumber(at, arguments, static_cast<int>(kMax), specifier.width, out.trouble)) return;
    if (*at == '.') {
      ++at;
      specifier.precision = 0;
      if (!readNumber(at, arguments, kMaxDigits, specifier.precision, out.trouble)) return;
    }
    if (*at == 0) {
      out.trouble = kBadFormat;
      return;
    }
    const Argument* const argument = arguments.take();
    if (argument == nullptr) {
      out.trouble = kMissing;
      return;
    }
    putArgument(out, specifier, *at++, *argument);
  }
}

}  // namespace

void rung_tc2_utilities_FB_FormatString(rung_context*, FB_FormatString_type* self) {
  Output out{self->sOut_, kMax, 0, kOk};
  Arguments arguments(*self);
  format(out, self->sFormat_, arguments);
  out.text[out.length] = 0;
  self->nErrId_ = out.trouble;
  self->bError_ = out.trouble != kOk;
}

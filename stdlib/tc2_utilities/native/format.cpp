// Native body of FB_FormatString in format.st. Nothing is read outside of the format and of the arguments; no heap.
#include <stdio.h>

#include "rung/code.h"
#include "rung/native_blocks.h"

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

// %b, which printf lacks: digits, then blanks or zeros to the width.
void putBits(Output& out, const Specifier& specifier, uint64_t bits) {
  char digits[64 + 1];
  int count = 0;
  do digits[count++] = static_cast<char>('0' + (bits & 1));
  while ((bits >>= 1) != 0);
  for (int i = 0; i < count / 2; ++i) {
    const char other = digits[i];
    digits[i] = digits[count - 1 - i];
    digits[count - 1 - i] = other;
  }
  bool left = false, zeros = false;
  for (int i = 0; i < specifier.flag_count; ++i) {
    left = left || specifier.flags[i] == '-';
    zeros = zeros || specifier.flags[i] == '0';
  }
  const int zero_count = specifier.precision > count ? specifier.precision - count
                         : specifier.precision < 0 && zeros && !left && specifier.width > count
                             ? specifier.width - count
                             : 0;
  const int blank_count = specifier.width > count + zero_count ? specifier.width - count - zero_count : 0;
  for (int i = 0; !left && i < blank_count; ++i) out.put(" ", 1);
  for (int i = 0; i < zero_count; ++i) out.put("0", 1);
  out.put(digits, static_cast<size_t>(count));
  for (int i = 0; left && i < blank_count; ++i) out.put(" ", 1);
}

// Writes a conversion for printf: its flags, `*` for width and precision, the length modifier, the type.
void specify(char* spec, const Specifier& specifier, const char* length, char type) {
  *spec++ = '%';
  for (int i = 0; i < specifier.flag_count; ++i) *spec++ = specifier.flags[i];
  for (const char* at = "*.*"; *at != 0; ++at) *spec++ = *at;
  for (; *length != 0; ++length) *spec++ = *length;
  *spec++ = type;
  *spec = 0;
}

void putArgument(Output& out, const Specifier& specifier, char type, const Argument& argument) {
  char spec[16], piece[512];
  const int width = specifier.width < 0 ? 0 : specifier.width;
  int count = 0, bits_of_type = 64;
  switch (type) {
    case 'd':
    case 'i':
      if (!isWhole(argument.eType_)) break;
      specify(spec, specifier, "ll", 'd');
      count = snprintf(piece, sizeof piece, spec, width, specifier.precision,
                       static_cast<long long>(wholeOf(argument, bits_of_type)));
      return out.put(piece, static_cast<size_t>(count));
    case 'u':
    case 'b':
    case 'o':
    case 'x':
    case 'X': {
      if (!isWhole(argument.eType_)) break;
      uint64_t bits = static_cast<uint64_t>(wholeOf(argument, bits_of_type));
      if (bits_of_type < 64) bits &= (uint64_t{1} << bits_of_type) - 1;
      if (type == 'b') return putBits(out, specifier, bits);
      specify(spec, specifier, "ll", type);
      count = snprintf(piece, sizeof piece, spec, width, specifier.precision, static_cast<unsigned long long>(bits));
      return out.put(piece, static_cast<size_t>(count));
    }
    case 'f':
    case 'e':
    case 'E':
    case 'g':
    case 'G': {
      if (argument.eType_ != ARGTYPE_REAL_ && argument.eType_ != ARGTYPE_LREAL_) break;
      const double number = argument.eType_ == ARGTYPE_REAL_ ? static_cast<double>(read<float>(dataOf(argument)))
                                                             : read<double>(dataOf(argument));
      specify(spec, specifier, "", type);
      count = snprintf(piece, sizeof piece, spec, width, specifier.precision < 0 ? 6 : specifier.precision, number);
      return out.put(piece, static_cast<size_t>(count) < sizeof piece ? static_cast<size_t>(count) : sizeof piece - 1);
    }
    case 's': {
      const char* text = nullptr;
      if (argument.eType_ == ARGTYPE_STRING_) text = static_cast<const char*>(dataOf(argument));
      if (argument.eType_ == ARGTYPE_BOOL_) text = wholeOf(argument, bits_of_type) != 0 ? "TRUE" : "FALSE";
      if (text == nullptr) break;
      specify(spec, specifier, "", 's');
      count = snprintf(piece, sizeof piece, spec, width,
                       specifier.precision < 0 ? static_cast<int>(kMax) : specifier.precision, text);
      return out.put(piece, static_cast<size_t>(count));
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

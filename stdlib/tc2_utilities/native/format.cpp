// Native body of FORMAT_ARGUMENTS in format.st: formats arguments, given by their addresses, into a string.
// Nothing is read outside of the format and of the arguments; no heap.
#include <stdio.h>

#include "rung/code.h"

namespace {

enum ArgumentType : int16_t {
  kByte = 1,
  kWord,
  kDWord,
  kReal,
  kLReal,
  kSInt,
  kInt,
  kDInt,
  kUSInt,
  kUInt,
  kUDInt,
  kString,
  kBool,
  kLWord = 19,
  kLInt,
  kULInt
};
struct Argument {  // T_Arg
  int16_t type;
  uint32_t bytes;
  const void* data;
};

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

template <class Number>
Number read(const void* at) {
  Number number;
  memcpy(&number, at, sizeof number);
  return number;
}

bool isWhole(int16_t type) {
  return type >= kByte && type <= kULInt && type != kReal && type != kLReal && type != kString;
}

// The value of an integer; `width` is set to its bits.
int64_t wholeOf(const Argument& argument, int& width) {
  switch (static_cast<ArgumentType>(argument.type)) {
    case kByte:
    case kUSInt: width = 8; return read<uint8_t>(argument.data);
    case kBool: width = 8; return read<uint8_t>(argument.data) != 0 ? 1 : 0;
    case kSInt: width = 8; return read<int8_t>(argument.data);
    case kWord:
    case kUInt: width = 16; return read<uint16_t>(argument.data);
    case kInt: width = 16; return read<int16_t>(argument.data);
    case kDWord:
    case kUDInt: width = 32; return read<uint32_t>(argument.data);
    case kDInt: width = 32; return read<int32_t>(argument.data);
    case kLWord:
    case kLInt:
    case kULInt: width = 64; return read<int64_t>(argument.data);
    case kReal:
    case kLReal:
    case kString: break;
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
      if (!isWhole(argument.type)) break;
      specify(spec, specifier, "ll", 'd');
      count = snprintf(piece, sizeof piece, spec, width, specifier.precision,
                       static_cast<long long>(wholeOf(argument, bits_of_type)));
      return out.put(piece, static_cast<size_t>(count));
    case 'u':
    case 'b':
    case 'o':
    case 'x':
    case 'X': {
      if (!isWhole(argument.type)) break;
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
      if (argument.type != kReal && argument.type != kLReal) break;
      const double number =
          argument.type == kReal ? static_cast<double>(read<float>(argument.data)) : read<double>(argument.data);
      specify(spec, specifier, "", type);
      count = snprintf(piece, sizeof piece, spec, width, specifier.precision < 0 ? 6 : specifier.precision, number);
      return out.put(piece, static_cast<size_t>(count) < sizeof piece ? static_cast<size_t>(count) : sizeof piece - 1);
    }
    case 's': {
      const char* text = nullptr;
      if (argument.type == kString) text = static_cast<const char*>(argument.data);
      if (argument.type == kBool) text = wholeOf(argument, bits_of_type) != 0 ? "TRUE" : "FALSE";
      if (text == nullptr) break;
      specify(spec, specifier, "", 's');
      count = snprintf(piece, sizeof piece, spec, width,
                       specifier.precision < 0 ? static_cast<int>(kMax) : specifier.precision, text);
      return out.put(piece, static_cast<size_t>(count));
    }
    case 'c': {
      if (!isWhole(argument.type)) break;
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
  Arguments(const Argument* first, uint32_t count) : next_(first), end_(first + count) {}
  const Argument* take() { return next_ == end_ || next_->data == nullptr ? nullptr : next_++; }

 private:
  const Argument *next_, *end_;
};

// Reads a width or a precision: digits, or `*`, which takes an argument.
bool readNumber(const char*& at, Arguments& arguments, int most, int& number, Trouble& trouble) {
  if (*at == '*') {
    ++at;
    const Argument* const argument = arguments.take();
    if (argument == nullptr || !isWhole(argument->type)) {
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

extern "C" uint32_t rung_tc2_utilities_FORMAT_ARGUMENTS(rung_context*, const char* format_text, void* arguments,
                                                        uint16_t count, void* error, char* text, uint32_t capacity) {
  Output out{text, capacity < kMax ? capacity : kMax, 0, kOk};
  Arguments list(static_cast<const Argument*>(arguments), count);
  format(out, format_text, list);
  out.text[out.length] = 0;
  const uint32_t trouble = out.trouble;
  if (error != nullptr) memcpy(error, &trouble, sizeof trouble);
  return static_cast<uint32_t>(out.length);
}

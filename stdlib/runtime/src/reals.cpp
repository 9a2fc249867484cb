// SPDX-License-Identifier: Apache-2.0
// REAL and LREAL as characters (rung/reals.h). The shortest digits are found as in R. Giulietti, "The Schubfach way to
// render doubles" (2020); reading multiplies by the same powers of ten, as in D. Lemire, "Number parsing at a gigabyte
// per second" (2021). What 128 bits do not decide, and printing with a given precision, is computed exactly in Big.
#include "rung/reals.h"

#include <float.h>
#include <string.h>

#include "rung/code.h"

namespace {

struct Wide {
  uint64_t high, low;
};

Wide product(uint64_t a, uint64_t b) {
#ifdef __SIZEOF_INT128__
  __extension__ typedef unsigned __int128 Uint128;
  const Uint128 all = static_cast<Uint128>(a) * b;
  return {static_cast<uint64_t>(all >> 64), static_cast<uint64_t>(all)};
#else
  const uint64_t a0 = static_cast<uint32_t>(a), a1 = a >> 32, b0 = static_cast<uint32_t>(b), b1 = b >> 32;
  const uint64_t low = a0 * b0, middle = a1 * b0 + (low >> 32), other = a0 * b1 + static_cast<uint32_t>(middle);
  return {a1 * b1 + (middle >> 32) + (other >> 32), other << 32 | static_cast<uint32_t>(low)};
#endif
}

// ---- powers of ten in 128 bits, rounded up, the highest bit set: 10^k = power * 2^(log2OfPower(k) - 127)

constexpr int kLowestPower = -292, kHighestPower = 324, kStep = 27;

// floor(log2(10^k))
int log2OfPower(int k) { return (k * 1741647) >> 19; }

// 10^kLowestPower and every kStep-th power from there.
constexpr uint64_t kPowers[][2] = {
    {0xff77b1fcbebcdc4f, 0x25e8e89c13bb0f7b}, {0xce5d73ff402d98e3, 0xfb0a3d212dc81290},
    {0xa6b34ad8c9dfc06f, 0xf42faa48c0ea481f}, {0x86a8d39ef77164bc, 0xae5dff9c02033198},
    {0xd98ddaee19068c76, 0x3badd624dd9b0958}, {0xafbd2350644eeacf, 0xe5d1929ef90898fb},
    {0x8df5efabc5979c8f, 0xca8d3ffa1ef463c2}, {0xe55990879ddcaabd, 0xcc420a6a101d0516},
    {0xb94470938fa89bce, 0xf808e40e8d5b3e6a}, {0x95a8637627989aad, 0xdde7001379a44aa9},
    {0xf1c90080baf72cb1, 0x5324c68b12dd6339}, {0xc350000000000000, 0x0000000000000000},
    {0x9dc5ada82b70b59d, 0xf020000000000000}, {0xfee50b7025c36a08, 0x02f236d04753d5b5},
    {0xcde6fd5e09abcf26, 0xed4c0226b55e6f87}, {0xa6539930bf6bff45, 0x84db8346b786151d},
    {0x865b86925b9bc5c2, 0x0b8a2392ba45a9b3}, {0xd910f7ff28069da4, 0x1b2ba1518094da05},
    {0xaf58416654a6babb, 0x387ac8d1970027b3}, {0x8da471a9de737e24, 0x5ceaecfed289e5d3},
    {0xe4d5e82392a40515, 0x0fabaf3feaa5334b}, {0xb8da1662e7b00a17, 0x3d6a751f3b936244},
    {0x95527a5202df0ccb, 0x0f37801e0c43ebc9},
};
// For each power: what a table entry times a power of five, cut to 128 bits, lacks; plus 1, in two bits.
constexpr uint32_t kCorrections[] = {0xa965aa59, 0xa95aaa9a, 0xaa5aa6aa, 0xaaaa996a, 0xa5a6aaa6, 0x50415106, 0xa5154114,
                                     0x5965995a, 0xaa565559, 0x5a559556, 0xa6aaa999, 0xa6959a96, 0xaa695aaa, 0x6aa9aa9a,
                                     0xa9aaaaaa, 0x5654516a, 0x95556955, 0x5665696a, 0x55555559, 0x55555555, 0x55555555,
                                     0x6a555555, 0x699aaaa9, 0x9a9a9665, 0xaaaaa6aa, 0xa59996a9, 0x6965566a, 0x15555595,
                                     0xa9556555, 0xaa9a69aa, 0x55865aa6, 0x55454555, 0xa9a695a4, 0x6956aa96, 0x695aaa66,
                                     0xaa69656a, 0xaaaaaaaa, 0x6a6a655a, 0x0002aaa9};

constexpr uint64_t powerOfFive(int n) { return n == 0 ? 1 : 5 * powerOfFive(n - 1); }
constexpr uint64_t kPowersOfFive[kStep] = {
    powerOfFive(0),  powerOfFive(1),  powerOfFive(2),  powerOfFive(3),  powerOfFive(4),  powerOfFive(5),
    powerOfFive(6),  powerOfFive(7),  powerOfFive(8),  powerOfFive(9),  powerOfFive(10), powerOfFive(11),
    powerOfFive(12), powerOfFive(13), powerOfFive(14), powerOfFive(15), powerOfFive(16), powerOfFive(17),
    powerOfFive(18), powerOfFive(19), powerOfFive(20), powerOfFive(21), powerOfFive(22), powerOfFive(23),
    powerOfFive(24), powerOfFive(25), powerOfFive(26)};

Wide powerOfTen(int k) {
  const uint32_t number = static_cast<uint32_t>(k - kLowestPower), step = number % kStep;
  Wide power = {kPowers[number / kStep][0], kPowers[number / kStep][1]};
  if (step != 0) {
    const Wide low = product(power.low, kPowersOfFive[step]);
    Wide high = product(power.high, kPowersOfFive[step]);
    high.low += low.high;
    high.high += high.low < low.high;
    const int shift = __builtin_clzll(high.high);
    power.high = high.high << shift | high.low >> (64 - shift);
    power.low = high.low << shift | low.low >> (64 - shift);
  }
  const uint64_t before = power.low;
  power.low += (kCorrections[number / 16] >> (2 * (number % 16)) & 3) - uint64_t{1};
  if (before == 0 && power.low == UINT64_MAX) --power.high;
  if (before == UINT64_MAX && power.low == 0) ++power.high;
  return power;
}

// ---- values in parts

// A finite magnitude: significand * 2^exponent.
struct Binary {
  uint64_t significand;
  int exponent;
  bool is_lowest_of_exponent;  // the next lower value is only half as far away as the next higher one
};

Binary partsOf(double value, bool is_single) {
  const uint64_t bits = rung_bits_of_f64(value);
  const uint32_t single = rung_bits_of_f32(static_cast<float>(value));
  const int width = is_single ? 23 : 52;
  const uint64_t fraction = is_single ? single & 0x7fffff : bits & 0xfffffffffffff;
  const int biased = static_cast<int>(is_single ? single >> 23 & 0xff : bits >> 52 & 0x7ff);
  const int lowest = (is_single ? -126 : -1022) - width;
  if (biased == 0) return {fraction, lowest, false};
  return {fraction | uint64_t{1} << width, biased - 1 + lowest, fraction == 0 && biased > 1};
}

// Writes the digits of a number, returns how many. Divides 32 bits where it can: 64 are slow on many processors.
int putDigits(uint64_t value, char* out) {
  char backwards[20];
  int count = 0;
  while (value > UINT32_MAX) {
    uint32_t low = static_cast<uint32_t>(value % 100000000);
    value /= 100000000;
    for (int i = 0; i < 8; ++i, low /= 10) backwards[count++] = static_cast<char>('0' + low % 10);
  }
  uint32_t rest = static_cast<uint32_t>(value);
  do backwards[count++] = static_cast<char>('0' + rest % 10);
  while ((rest /= 10) != 0);
  for (int i = 0; i < count; ++i) out[i] = backwards[count - 1 - i];
  return count;
}

// ---- the shortest digits

struct Decimal {
  uint64_t digits;
  int exponent;
};

// The highest 64 bits of power * factor / 2^64; the lowest is set when something is cut that matters.
uint64_t scaled(const Wide& power, uint64_t factor) {
  const Wide low = product(power.low, factor);
  Wide high = product(power.high, factor);
  high.low += low.high;
  high.high += high.low < low.high;
  return high.high | (high.low > 1 ? 1 : 0);
}

// Four times the value and the middles to its neighbours are compared as numbers of the decimal grid 10^k, whose step
// is the largest that is not above the distance of the middles.
Decimal shortestOf(const Binary& value) {
  const bool is_odd = (value.significand & 1) != 0;
  const int q = value.exponent;
  const int k = (q * 1262611 - (value.is_lowest_of_exponent ? 524031 : 0)) >> 22;
  const int shift = q + log2OfPower(-k) + 1;
  const Wide power = powerOfTen(-k);
  const uint64_t four = 4 * value.significand;
  const uint64_t low = scaled(power, (four - 2 + (value.is_lowest_of_exponent ? 1 : 0)) << shift) + (is_odd ? 1 : 0);
  const uint64_t middle = scaled(power, four << shift);
  const uint64_t high = scaled(power, (four + 2) << shift) - (is_odd ? 1 : 0);

  const uint64_t s = middle / 4;
  if (s >= 10) {  // one digit less
    const uint64_t tens = s / 10;
    const bool is_lower_inside = low <= 40 * tens, is_upper_inside = 40 * tens + 40 <= high;
    if (is_lower_inside != is_upper_inside) return {tens + (is_upper_inside ? 1 : 0), k + 1};
  }
  const bool is_lower_inside = low <= 4 * s, is_upper_inside = 4 * s + 4 <= high;
  if (is_lower_inside != is_upper_inside) return {s + (is_upper_inside ? 1 : 0), k};
  const uint64_t half = 4 * s + 2;
  const bool is_up = middle > half || (middle == half && (s & 1) != 0);
  return {s + (is_up ? 1 : 0), k};
}

// ---- exact numbers

// A natural number of at most 3072 bits: enough for 770 digits, and for 5^1100.
class Big {
 public:
  explicit Big(uint64_t value) {
    for (; value != 0; value >>= 32) limbs_[count_++] = static_cast<uint32_t>(value);
  }
  bool isZero() const { return count_ == 0; }
  int bits() const { return count_ == 0 ? 0 : 32 * count_ - __builtin_clz(limbs_[count_ - 1]); }

  void multiplyAdd(uint32_t factor, uint32_t summand) {
    uint64_t carry = summand;
    for (int i = 0; i < count_; ++i) {
      carry += uint64_t{limbs_[i]} * factor;
      limbs_[i] = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) limbs_[count_++] = static_cast<uint32_t>(carry);
  }
  void multiplyByPowerOfFive(int n) {
    for (; n >= 13; n -= 13) multiplyAdd(1220703125, 0);
    multiplyAdd(static_cast<uint32_t>(kPowersOfFive[n]), 0);
  }
  // Returns the remainder.
  uint32_t divide(uint32_t divisor) {
    uint64_t rest = 0;
    for (int i = count_ - 1; i >= 0; --i) {
      rest = rest << 32 | limbs_[i];
      limbs_[i] = static_cast<uint32_t>(rest / divisor);
      rest %= divisor;
    }
    trim();
    return static_cast<uint32_t>(rest);
  }
  void shiftLeft(int n) {
    if (count_ == 0 || n == 0) return;
    const int limbs = n / 32, part = n % 32;
    limbs_[count_] = 0;
    for (int i = count_; i >= 0; --i) {
      const uint32_t below = i > 0 && part != 0 ? limbs_[i - 1] >> (32 - part) : 0;
      limbs_[i + limbs] = limbs_[i] << part | below;
    }
    for (int i = 0; i < limbs; ++i) limbs_[i] = 0;
    count_ += limbs + 1;
    trim();
  }
  // Divides by 2^n: to the nearest, in the middle to even; or down, and says whether something was `cut`.
  void shiftRight(int n, bool* cut) {
    if (n > bits()) {
      if (cut != nullptr) *cut = count_ != 0;
      count_ = 0;
      return;
    }
    const bool half = bit(n - 1);
    bool rest = false;
    for (int i = 0; i < n - 1 && !rest; ++i) rest = bit(i);
    const int limbs = n / 32, part = n % 32;
    for (int i = 0; i + limbs < count_; ++i) {
      const uint32_t above = i + limbs + 1 < count_ && part != 0 ? limbs_[i + limbs + 1] << (32 - part) : 0;
      limbs_[i] = limbs_[i + limbs] >> part | above;
    }
    count_ -= limbs;
    trim();
    if (cut != nullptr)
      *cut = half || rest;
    else if (half && (rest || (count_ > 0 && (limbs_[0] & 1) != 0)))
      increment();
  }
  bool isLess(const Big& other) const {
    if (count_ != other.count_) return count_ < other.count_;
    int i = count_ - 1;
    while (i > 0 && limbs_[i] == other.limbs_[i]) --i;
    return i >= 0 && limbs_[i] < other.limbs_[i];
  }
  void subtract(const Big& other) {
    uint64_t borrow = 0;
    for (int i = 0; i < count_; ++i) {
      const uint64_t difference = uint64_t{limbs_[i]} - (i < other.count_ ? other.limbs_[i] : 0) - borrow;
      limbs_[i] = static_cast<uint32_t>(difference);
      borrow = difference >> 63;
    }
    trim();
  }

 private:
  bool bit(int n) const { return (limbs_[n / 32] >> (n % 32) & 1) != 0; }
  void trim() {
    while (count_ > 0 && limbs_[count_ - 1] == 0) --count_;
  }
  void increment() {
    for (int i = 0; i < count_; ++i)
      if (++limbs_[i] != 0) return;
    limbs_[count_++] = 1;
  }

  uint32_t limbs_[97];
  int count_ = 0;
};

// The digits of value * 10^places as an integer, rounded or cut as in Big::shiftRight; `0` for zero. Returns how many.
uint32_t exactDigits(const Binary& value, int places, char* out, bool* cut = nullptr) {
  Big number(value.significand);
  number.multiplyByPowerOfFive(places);
  const int shift = value.exponent + places;
  if (shift >= 0)
    number.shiftLeft(shift);
  else
    number.shiftRight(-shift, cut);
  char backwards[RUNG_REAL_PRINT_ROOM];
  uint32_t count = 0;
  while (!number.isZero()) {
    uint32_t part = number.divide(1000000000);
    for (int i = 0; number.isZero() ? part != 0 : i < 9; ++i, part /= 10)
      backwards[count++] = static_cast<char>('0' + part % 10);
  }
  if (count == 0) backwards[count++] = '0';
  for (uint32_t i = 0; i < count; ++i) out[i] = backwards[count - 1 - i];
  return count;
}

// ---- notation

class Text {
 public:
  explicit Text(char* out) : out_(out) {}
  void put(char c) { out_[length_++] = c; }
  void put(const char* from, int count) {
    for (int i = 0; i < count; ++i) put(from[i]);
  }
  void zeros(int count) {
    for (int i = 0; i < count; ++i) put('0');
  }
  // `e+05`: two digits at least.
  void exponent(int value) {
    put('e');
    put(value < 0 ? '-' : '+');
    const int magnitude = value < 0 ? -value : value;
    if (magnitude >= 100) put(static_cast<char>('0' + magnitude / 100));
    put(static_cast<char>('0' + magnitude / 10 % 10));
    put(static_cast<char>('0' + magnitude % 10));
  }
  uint32_t length() const { return length_; }

 private:
  char* out_;
  uint32_t length_ = 0;
};

// d.ddd: digits with a point after the first, where any follow or `has_point` wants it.
void putScientific(Text& to, const char* digits, int count, int exponent, bool has_point) {
  to.put(digits[0]);
  if (count > 1 || has_point) to.put('.');
  to.put(digits + 1, count - 1);
  to.exponent(exponent);
}

// The digits as a number with `places` digits after the point; fewer digits get zeros in front.
void putFixed(Text& to, const char* digits, int count, int places, bool has_point) {
  if (count <= places) {
    to.put('0');
    to.put('.');
    to.zeros(places - count);
    return to.put(digits, count);
  }
  to.put(digits, count - places);
  if (places > 0 || has_point) to.put('.');
  to.put(digits + count - places, places);
}

// The digits of the value in scientific notation with `precision` digits after the point; sets the exponent.
void scientificDigits(const Binary& value, int precision, char* digits, int& exponent) {
  if (value.significand == 0) {
    exponent = 0;
    memset(digits, '0', static_cast<size_t>(precision) + 1);
    return;
  }
  const Decimal shortest = shortestOf(value);
  exponent = shortest.exponent + putDigits(shortest.digits, digits) -
             1;  // one too large when the shortest digits are rounded up
  for (;; --exponent) {
    const int places = precision - exponent;
    bool rest = false;
    const int count =
        static_cast<int>(exactDigits(value, places < 0 ? 0 : places, digits, places < 0 ? &rest : nullptr));
    if (places < 0) {  // an integer with more digits than wanted
      if (count <= exponent) continue;
      const int last = precision;  // digits[last] is the last that stays
      const bool is_half = digits[last + 1] == '5';
      for (int i = last + 2; i < count; ++i) rest = rest || digits[i] != '0';
      bool is_up = digits[last + 1] > '5' || (is_half && (rest || (digits[last] & 1) != 0));
      for (int i = last; is_up && i >= 0; --i) {
        is_up = digits[i] == '9';
        digits[i] = is_up ? '0' : static_cast<char>(digits[i] + 1);
      }
      if (!is_up) return;
      digits[0] = '1';  // 9.99 became 10.0: the other digits are zeros
      ++exponent;
      return;
    }
    if (count > precision + 1) ++exponent;  // likewise
    if (count > precision) return;
  }
}

// ---- reading

// Rounds high:low * 2^exponent, whose highest or second highest bit is set, to a value; in the middle to even, or false
// when the bits are `approximate` (too large by less than 1) and in the middle.
bool roundToValue(const Wide& number, int exponent, bool is_single, bool approximate, double& value) {
  const int width = is_single ? 24 : 53, lowest = is_single ? -149 : -1074, highest = is_single ? 104 : 971;
  int drop = (number.high >> 63 != 0 ? 128 : 127) - width;
  if (exponent + drop < lowest) drop = lowest - exponent;
  value = 0;
  if (drop > 128) return true;  // less than half of the lowest value
  const int part = drop - 64;   // the width leaves 74 bits at least
  uint64_t kept = part == 64 ? 0 : number.high >> part;
  // The bits that are dropped; the first is the highest of `cut`.
  const Wide cut = {part == 64 ? number.high : number.high << (64 - part) | number.low >> part,
                    part == 64 ? number.low : number.low << (64 - part)};
  const uint64_t half = uint64_t{1} << 63;
  if (approximate && cut.high == half && cut.low == 0) return false;
  if (cut.high > half || (cut.high == half && (cut.low != 0 || (kept & 1) != 0))) ++kept;
  exponent += drop;
  if (kept >> width != 0) {
    kept >>= 1;
    ++exponent;
  }
  if (exponent > highest) {
    value = __builtin_inf();
    return true;
  }
  if (!is_single && kept >> 52 == 0) {
    value = rung_f64_of(kept);  // below the normal numbers, or zero
  } else {
    const double whole = static_cast<double>(kept);
    value = kept == 0
                ? 0
                : rung_f64_of(rung_bits_of_f64(whole) + (static_cast<uint64_t>(static_cast<int64_t>(exponent)) << 52));
  }
  return true;
}

struct Digits {
  uint64_t first;           // the first 19 that count
  int count;                // how many those are
  bool has_more;            // further digits that are not all zeros
  int exponent;             // the value is first * 10^exponent, and more
  const char *begin, *end;  // all of them, with the point
};

// Returns where the number ends; `begin` when there is none.
const char* readDigits(const char* begin, const char* end, Digits& number) {
  number = {0, 0, false, 0, begin, begin};
  bool has_digit = false, has_point = false;
  const char* at = begin;
  for (; at != end; ++at) {
    if (*at == '.' && !has_point) {
      has_point = true;
      continue;
    }
    if (*at < '0' || *at > '9') break;
    has_digit = true;
    if (number.count < 19) {
      number.first = number.first * 10 + static_cast<uint64_t>(*at - '0');
      if (number.first != 0) ++number.count;
      if (has_point) --number.exponent;
    } else {
      number.has_more = number.has_more || *at != '0';
      if (!has_point) ++number.exponent;
    }
  }
  if (!has_digit) return begin;
  number.end = at;
  if (at == end || (*at != 'e' && *at != 'E')) return at;
  const char* digit = at + 1;
  const bool is_negative = digit != end && *digit == '-';
  if (digit != end && (*digit == '-' || *digit == '+')) ++digit;
  if (digit == end || *digit < '0' || *digit > '9') return at;
  int exponent = 0;
  for (; digit != end && *digit >= '0' && *digit <= '9'; ++digit)
    if (exponent < 100000) exponent = exponent * 10 + (*digit - '0');
  number.exponent += is_negative ? -exponent : exponent;
  return digit;
}

// The value by long division of exact numbers. Beyond 770 digits only matters whether one is not zero.
double exactValue(const Digits& number, bool is_single) {
  Big above(0), below(1);
  int exponent = number.exponent + number.count, count = 0;  // of 0.ddd
  bool rest = false;
  for (const char* at = number.begin; at != number.end; ++at) {
    if (*at == '.' || (count == 0 && *at == '0')) continue;
    if (count == 769) {
      rest = rest || *at != '0';
      continue;
    }
    above.multiplyAdd(10, static_cast<uint32_t>(*at - '0'));
    ++count;
  }
  if (rest) {
    above.multiplyAdd(10, 1);
    ++count;
  }
  exponent -= count;
  if (exponent >= 0)
    above.multiplyByPowerOfFive(exponent);
  else
    below.multiplyByPowerOfFive(-exponent);
  const int difference = above.bits() - below.bits();
  above.shiftLeft(difference < 0 ? -difference : 0);
  below.shiftLeft(difference > 0 ? difference : 0);
  exponent += difference;
  if (above.isLess(below)) {
    above.shiftLeft(1);
    --exponent;
  }
  Wide quotient = {0, 0};
  for (int i = 0; i < 64; ++i) {
    quotient.high <<= 1;
    if (!above.isLess(below)) {
      above.subtract(below);
      quotient.high |= 1;
    }
    above.shiftLeft(1);
  }
  quotient.low = above.isZero() ? 0 : 1;
  double value = 0;
  roundToValue(quotient, exponent - 127, is_single, false, value);
  return value;
}

#if FLT_EVAL_METHOD == 0
// The usual case: digits and power of ten are exact, so that one operation rounds once. False: they are not.
template <class Real>
bool valueInOneOperation(const Digits& number, uint64_t exact_below, int highest_power, double& value) {
  constexpr Real kTens[] = {1e0F,
                            1e1F,
                            1e2F,
                            1e3F,
                            1e4F,
                            1e5F,
                            1e6F,
                            1e7F,
                            1e8F,
                            1e9F,
                            1e10F,
                            static_cast<Real>(1e11),
                            static_cast<Real>(1e12),
                            static_cast<Real>(1e13),
                            static_cast<Real>(1e14),
                            static_cast<Real>(1e15),
                            static_cast<Real>(1e16),
                            static_cast<Real>(1e17),
                            static_cast<Real>(1e18),
                            static_cast<Real>(1e19),
                            static_cast<Real>(1e20),
                            static_cast<Real>(1e21),
                            static_cast<Real>(1e22)};
  const int power = number.exponent < 0 ? -number.exponent : number.exponent;
  if (number.has_more || number.first > exact_below || power > highest_power) return false;
  const Real digits = static_cast<Real>(number.first);
  value = static_cast<double>(number.exponent < 0 ? digits / kTens[power] : digits * kTens[power]);
  return true;
}
#endif

double valueOf(const Digits& number, bool is_single) {
  if (number.first == 0) return 0;
#if FLT_EVAL_METHOD == 0
  double exact = 0;
  const bool is_exact = is_single ? valueInOneOperation<float>(number, uint64_t{1} << 24, 10, exact)
                                  : valueInOneOperation<double>(number, uint64_t{1} << 53, 22, exact);
  if (is_exact) return exact;
#endif
  const int magnitude = number.exponent + number.count;  // the value is below 10^magnitude
  if (magnitude > 310) return __builtin_inf();
  if (magnitude < -330) return 0;
  if (number.has_more || number.exponent < kLowestPower || number.exponent > kHighestPower)
    return exactValue(number, is_single);
  const int shift = __builtin_clzll(number.first);
  const Wide power = powerOfTen(number.exponent);
  const Wide low = product(power.low, number.first << shift);
  Wide high = product(power.high, number.first << shift);
  high.low += low.high;
  high.high += high.low < low.high;
  double value = 0;
  const bool is_decided = roundToValue(high, log2OfPower(number.exponent) - 63 - shift, is_single, true, value);
  return is_decided ? value : exactValue(number, is_single);
}

}  // namespace

uint32_t rung_real_format(double value, bool is_single, char* out) {
  Text text(out);
  if (value != value) {
    text.put("NaN", 3);
    return text.length();
  }
  if ((rung_bits_of_f64(value) >> 63) != 0) text.put('-');
  const double magnitude = __builtin_fabs(value);
  if (magnitude == __builtin_inf()) {
    text.put("Inf", 3);
    return text.length();
  }
  if (magnitude == 0) {
    text.put('0');
    return text.length();
  }
  const Binary parts = partsOf(magnitude, is_single);
  const Decimal shortest = shortestOf(parts);
  int exponent = shortest.exponent;
  char digits[RUNG_REAL_ROOM];
  int count = putDigits(shortest.digits, digits);
  for (; digits[count - 1] == '0'; --count) ++exponent;
  // One digit needs no point in scientific notation.
  if (exponent < (count == 1 ? -3 : -3 - count) || exponent > (count == 1 ? 4 : 5)) {
    putScientific(text, digits, count, exponent + count - 1, false);
  } else if (exponent > 0) {
    text.put(digits, static_cast<int>(exactDigits(parts, 0, digits)));
  } else {
    putFixed(text, digits, count, -exponent, false);
  }
  return text.length();
}

uint32_t rung_real_print(double value, char type, uint32_t precision, bool keep_zeros, char* out) {
  const Binary parts = partsOf(__builtin_fabs(value), false);
  Text text(out);
  char digits[RUNG_REAL_PRINT_ROOM];
  int places = static_cast<int>(precision < RUNG_REAL_PRECISION ? precision : RUNG_REAL_PRECISION);
  int exponent = 0;
  bool is_fixed = type == 'f';
  if (type == 'g') {
    const int significant = places == 0 ? 1 : places;
    scientificDigits(parts, significant - 1, digits, exponent);
    is_fixed = exponent >= -4 && exponent < significant;
    places = is_fixed ? significant - 1 - exponent : significant - 1;
    int count = significant;
    if (!keep_zeros)
      for (; places > 0 && digits[count - 1] == '0'; --count) --places;
    if (is_fixed)
      putFixed(text, digits, count, places, keep_zeros);
    else
      putScientific(text, digits, count, exponent, keep_zeros);
    return text.length();
  }
  if (is_fixed) {
    putFixed(text, digits, static_cast<int>(exactDigits(parts, places, digits)), places, keep_zeros);
  } else {
    scientificDigits(parts, places, digits, exponent);
    putScientific(text, digits, places + 1, exponent, keep_zeros);
  }
  return text.length();
}

rung_real_result rung_real_parse(const char* text, size_t* size, bool is_single, double* value) {
  Digits number;
  const char* const end = readDigits(text, text + *size, number);
  *size = static_cast<size_t>(end - text);
  if (*size == 0) return RUNG_REAL_NONE;
  *value = valueOf(number, is_single);
  if (*value == __builtin_inf()) return RUNG_REAL_OVERFLOW;
  return *value == 0 && number.first != 0 ? RUNG_REAL_UNDERFLOW : RUNG_REAL_READ;
}

// SPDX-License-Identifier: Apache-2.0
// sites.py must find some of this and leave the rest alone; mutation.py --sample compares its sites with the list at
// the end, and runs this program with each of them active: every one changes what main prints.
#include <cstdio>
#include <string>
#include <vector>

enum class Kind {
  None = 0,
  Some = 4
};  // enumerators, array sizes, labels and static_assert are for the compiler alone
struct Row {
  const char* name;
  int width;
};
constexpr Row kRows[] = {{"bool", 1}, {"word", 16}};
static_assert(sizeof(Row) >= 2 * sizeof(int));

constexpr int twice(int value) { return value * 2; }  // evaluated by the compiler, and when the program runs

template <int N = 3>
int first(const std::vector<int>& values, const int* other) {
  char buffer[8] = {'x', 'y'};
  if (values.size() < N) return -1;
  if (const int found = values[0]; found > 55) {
    std::printf("error %d\n", found);
    return found - *other;
  }
  std::string text = "a" + std::string("b");  // no minus for strings
  bool is_even = !(values[0] & 1);
  int sum = static_cast<int>(text.size()) - 5;
  for (const int value : values) sum += is_even && value > 50 ? value : 0;
  switch (sum) {
    case 48 + 1: return buffer[0] - buffer[1];
    default: return sum / 2;
  }
}

int main() {
  const int other = sizeof(int);
  const std::vector<int> few = {'6'}, some = {'6', '3', '2'}, odd = {'7', '1', '9'}, large = {'8', '9', '3'};
  std::printf("%d %d %d %d ", first(few, &other), first(some, &other), first(odd, &other), first(large, &other));
  std::printf("%d\n", first({'4', '1', '1'}, &other));
  for (const Row& row : kRows) std::printf("%s %d\n", row.name, row.width);
  std::printf("%d\n", twice(other));
}

// Sites:
// 16 table: "bool" -> "word"
// 16 constant: 1 -> 2
// 16 table: 1 -> 16
// 16 table: "word" -> "bool"
// 16 constant: 16 -> 17
// 16 table: 16 -> 1
// 19 operator: value * 2 -> value / 2
// 19 constant: 2 -> 3
// 23 table: 'x' -> 'y'
// 23 table: 'y' -> 'x'
// 24 operator: values.size() < N -> values.size() <= N
// 24 check: values.size() < N -> false
// 24 constant: 1 -> 2
// 25 constant: 0 -> 1
// 25 operator: found > 55 -> found >= 55
// 25 check: found > 55 -> false
// 25 constant: 55 -> 56
// 27 operator: found - *other -> found + *other
// 30 operator: !(values[0] & 1) -> !!((values[0] & 1))
// 30 operator: values[0] & 1 -> values[0] | 1
// 30 constant: 0 -> 1
// 30 constant: 1 -> 2
// 31 operator: static_cast<int>(text.size()) - 5 -> static_cast<int>(text.size()) + 5
// 31 constant: 5 -> 6
// 32 operator: sum += is_even && value > 50 ? value : 0 -> sum -= is_even && value > 50 ? value : 0
// 32 operator: is_even && value > 50 -> is_even || value > 50
// 32 operator: value > 50 -> value >= 50
// 32 constant: 50 -> 51
// 32 constant: 0 -> 1
// 34 operator: buffer[0] - buffer[1] -> buffer[0] + buffer[1]
// 34 constant: 0 -> 1
// 34 constant: 1 -> 2
// 35 operator: sum / 2 -> sum * 2
// 35 constant: 2 -> 3

// SPDX-License-Identifier: Apache-2.0
// What sites.py must find and what it must leave alone; mutation.py --sample compares its sites with the list at the
// end, and runs this program with each of them active: every one changes what main prints.
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
// 15 table: "bool" -> "word"
// 15 constant: 1 -> 2
// 15 table: 1 -> 16
// 15 table: "word" -> "bool"
// 15 constant: 16 -> 17
// 15 table: 16 -> 1
// 18 operator: value * 2 -> value / 2
// 18 constant: 2 -> 3
// 22 table: 'x' -> 'y'
// 22 table: 'y' -> 'x'
// 23 operator: values.size() < N -> values.size() <= N
// 23 check: values.size() < N -> false
// 23 constant: 1 -> 2
// 24 constant: 0 -> 1
// 24 operator: found > 55 -> found >= 55
// 24 check: found > 55 -> false
// 24 constant: 55 -> 56
// 26 operator: found - *other -> found + *other
// 29 operator: !(values[0] & 1) -> !!((values[0] & 1))
// 29 operator: values[0] & 1 -> values[0] | 1
// 29 constant: 0 -> 1
// 29 constant: 1 -> 2
// 30 operator: static_cast<int>(text.size()) - 5 -> static_cast<int>(text.size()) + 5
// 30 constant: 5 -> 6
// 31 operator: sum += is_even && value > 50 ? value : 0 -> sum -= is_even && value > 50 ? value : 0
// 31 operator: is_even && value > 50 -> is_even || value > 50
// 31 operator: value > 50 -> value >= 50
// 31 constant: 50 -> 51
// 31 constant: 0 -> 1
// 33 operator: buffer[0] - buffer[1] -> buffer[0] + buffer[1]
// 33 constant: 0 -> 1
// 33 constant: 1 -> 2
// 34 operator: sum / 2 -> sum * 2
// 34 constant: 2 -> 3

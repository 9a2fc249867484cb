// SPDX-License-Identifier: Apache-2.0
// The kernels of kernels.st as C++ that an engineer writes by hand: arrays by reference, text in buffers, numbers by
// to_chars and from_chars.
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "../measure_hand.h"

namespace {

using Matrix = double[8][8];

__attribute__((noinline)) bool invert(Matrix& a, Matrix& b, int n) {
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) b[i][k] = i == k ? 1.0 : 0.0;
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    if (std::fabs(a[pivot][k]) < 1.0E-12) return false;
    if (pivot != k) {
      for (int c = 0; c < n; ++c) {
        std::swap(a[k][c], a[pivot][c]);
        std::swap(b[k][c], b[pivot][c]);
      }
    }
    double factor = 1.0 / a[k][k];
    for (int c = 0; c < n; ++c) {
      a[k][c] *= factor;
      b[k][c] *= factor;
    }
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      factor = a[i][k];
      for (int c = 0; c < n; ++c) {
        a[i][c] -= factor * a[k][c];
        b[i][c] -= factor * b[k][c];
      }
    }
  }
  return true;
}

struct Inverse {
  Matrix m, inverse;
  int32_t run(int32_t rounds) {
    double total = 0.0;
    for (int32_t r = 1; r <= rounds; ++r) {
      for (int i = 0; i < 8; ++i) {
        for (int k = 0; k < 8; ++k) m[i][k] = (i * 5 + k * 3) % 13;
        m[i][i] += 10 + r % 4;
      }
      if (invert(m, inverse, 8)) total += inverse[2][5] * 1000.0;
    }
    return static_cast<int32_t>(std::lrint(total));
  }
};

struct Builder {
  char line[121];
  int32_t values[8];
  int32_t run(int32_t rounds) {
    int32_t sum = 0;
    for (int32_t r = 1; r <= rounds; ++r) {
      for (int i = 0; i < 8; ++i) values[i] = (r * 37 + i * 1013) % 20011 - 9000;
      char* at = line;
      for (int i = 0; i < 8; ++i) {
        at = std::to_chars(at, line + 120, values[i]).ptr;
        if (at < line + 120) *at++ = ';';
      }
      *at = '\0';
      sum = (sum + static_cast<int32_t>(std::strlen(line)) * 7) % 99991;
    }
    return sum;
  }
};

__attribute__((noinline)) int32_t nextNumber(std::string_view& line) {
  const size_t at = std::min(line.find(';'), line.size());
  int32_t number = 0;
  std::from_chars(line.data(), line.data() + at, number);
  line.remove_prefix(std::min(at + 1, line.size()));
  return number;
}

struct Parser {
  char text[121] = "417;-23;100000;8;-99999;0;65535;12";
  int32_t run(int32_t rounds) {
    int32_t sum = 0;
    for (int32_t r = 1; r <= rounds; ++r) {
      std::string_view line = text;
      while (!line.empty()) sum += nextNumber(line) % 1009;
      sum %= 99991;
    }
    return sum;
  }
};

__attribute__((noinline)) double interpolate(const double* xs, const double* ys, int count, double x) {
  int low = 0, high = count - 1;
  if (x <= xs[low]) return ys[low];
  if (x >= xs[high]) return ys[high];
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    if (xs[middle] <= x)
      low = middle;
    else
      high = middle;
  }
  return ys[low] + (ys[high] - ys[low]) * (x - xs[low]) / (xs[high] - xs[low]);
}

struct Curve {
  double xs[64], ys[64];
  int32_t run(int32_t rounds) {
    for (int i = 1; i <= 64; ++i) {
      xs[i - 1] = i * i * 0.25;
      ys[i - 1] = i * 29 % 67;
    }
    double total = 0.0;
    for (int32_t r = 1; r <= rounds; ++r) total += interpolate(xs, ys, 64, r * 53 % 1100);
    return static_cast<int32_t>(std::lrint(total));
  }
};

struct Node {
  int32_t key;
  Node* next;
};

struct SortedList {
  Node pool[32];
  Node *first, *free;
  void reset() {
    first = free = nullptr;
    for (Node& node : pool) {
      node.next = free;
      free = &node;
    }
  }
  __attribute__((noinline)) void insert(int32_t key) {
    if (free == nullptr) return;
    Node* const node = free;
    free = node->next;
    node->key = key;
    Node** at = &first;
    while (*at != nullptr && (*at)->key < key) at = &(*at)->next;
    node->next = *at;
    *at = node;
  }
  __attribute__((noinline)) int32_t takeFirst() {
    if (first == nullptr) return 0;
    Node* const node = first;
    first = node->next;
    node->next = free;
    free = node;
    return node->key;
  }
};

struct Lists {
  SortedList list;
  int32_t run(int32_t rounds) {
    list.reset();
    int32_t seed = 7, sum = 0;
    for (int32_t r = 0; r < rounds; ++r) {
      for (int i = 0; i < 12; ++i) {
        seed = (seed * 1021 + 7477) % 31991;
        list.insert(seed);
      }
      for (int i = 0; i < 12; ++i) sum = (sum * 3 + list.takeFirst()) % 99991;
    }
    return sum;
  }
};

struct Order {
  int32_t number, amount;
  int16_t station;
  bool urgent;
};
struct OrderRing {
  Order items[64];
  int head, count;
};

__attribute__((noinline)) bool push(OrderRing& ring, const Order& one) {
  if (ring.count > 63) return false;
  ring.items[(ring.head + ring.count) % 64] = one;
  ++ring.count;
  return true;
}
__attribute__((noinline)) bool pop(OrderRing& ring, Order& one) {
  if (ring.count <= 0) return false;
  one = ring.items[ring.head];
  ring.head = (ring.head + 1) % 64;
  --ring.count;
  return true;
}

struct Orders {
  OrderRing ring;
  int32_t run(int32_t rounds) {
    ring.head = ring.count = 0;
    int32_t sum = 0;
    Order one;
    for (int32_t r = 1; r <= rounds; ++r) {
      for (int i = 1; i <= 20; ++i) {
        one.number = r + i;
        one.amount = (r * 7 + i * 13) % 100;
        one.station = static_cast<int16_t>(i % 5);
        one.urgent = one.amount > 90;
        push(ring, one);
      }
      while (pop(ring, one)) {
        sum += one.amount * one.station;
        if (one.urgent) sum += one.number % 7;
      }
      sum %= 99991;
    }
    return sum;
  }
};

__attribute__((noinline)) int16_t medianAt(const int16_t (&picture)[32][32], int y, int x) {
  int16_t window[9];
  int n = 0;
  for (int i = y - 1; i <= y + 1; ++i)
    for (int k = x - 1; k <= x + 1; ++k) window[n++] = picture[i][k];
  for (int i = 1; i < 9; ++i) {
    const int16_t value = window[i];
    int k = i - 1;
    for (; k >= 0 && window[k] > value; --k) window[k + 1] = window[k];
    window[k + 1] = value;
  }
  return window[4];
}

struct Medians {
  int16_t grey[32][32], smooth[32][32];
  int32_t run(int32_t rounds) {
    int32_t seed = 5, sum = 0;
    for (auto& row : grey) {
      for (int16_t& one : row) {
        seed = (seed * 1021 + 7477) % 31991;
        one = static_cast<int16_t>(seed % 256);
      }
    }
    for (int32_t r = 1; r <= rounds; ++r) {
      for (int y = 1; y <= 30; ++y)
        for (int x = 1; x <= 30; ++x) smooth[y][x] = medianAt(grey, y, x);
      grey[r % 30 + 1][r % 29 + 1] = smooth[r % 28 + 1][r % 27 + 1];
      sum = (sum + smooth[15][15] + smooth[3][27]) % 99991;
    }
    return sum;
  }
};

struct Product {
  const float (*left)[12], (*right)[12];
  float result[12][12], largest;
  __attribute__((noinline)) void call() {
    largest = 0.0f;
    for (int i = 0; i < 12; ++i) {
      float row = 0.0f;
      for (int k = 0; k < 12; ++k) {
        float sum = 0.0f;
        for (int c = 0; c < 12; ++c) sum += left[i][c] * right[c][k];
        result[i][k] = sum;
        row += std::fabs(sum);
      }
      largest = std::max(largest, row);
    }
  }
};

struct Products {
  float a[12][12], b[12][12];
  Product product;
  int32_t run(int32_t rounds) {
    for (int i = 1; i <= 12; ++i) {
      for (int k = 1; k <= 12; ++k) {
        a[i - 1][k - 1] = static_cast<float>((i * 7 + k) % 9);
        b[i - 1][k - 1] = static_cast<float>((i + k * 5) % 11);
      }
    }
    product.left = a;
    product.right = b;
    double total = 0.0;
    for (int32_t r = 1; r <= rounds; ++r) {
      a[0][0] = static_cast<float>(r % 17);
      product.call();
      total += product.largest;
    }
    return static_cast<int32_t>(std::lrint(total / 16.0));
  }
};

}  // namespace

int main() {
  measure<Inverse>("inverse", 96000);
  measure<Builder>("builder", 640000);
  measure<Parser>("parser", 640000);
  measure<Curve>("curve", 3200000);
  measure<Lists>("lists", 320000);
  measure<Orders>("orders", 480000);
  measure<Medians>("medians", 960);
  measure<Products>("products", 64000);
}

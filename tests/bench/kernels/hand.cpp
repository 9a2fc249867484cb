// SPDX-License-Identifier: Apache-2.0
// The kernels as a C++ programmer writes them; kernels.st does the same work in ST. Prints who, name, rounds, seconds
// of the best of five runs, and the checksum, which must equal that of the generated code.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "../measure_hand.h"

namespace {

struct Filter {
  float z1[48], z2[48], gain[48];
  int32_t run(int32_t rounds) {
    for (int i = 0; i < 48; ++i) {
      z1[i] = z2[i] = 0.0f;
      gain[i] = 0.5f + static_cast<float>(i) * 0.01f;
    }
    float x = 1.0f, total = 0.0f;
    for (int32_t r = 0; r < rounds; ++r) {
      total = 0.0f;
      for (int i = 0; i < 48; ++i) {
        const float y = gain[i] * x + z1[i];
        z1[i] = 0.3f * x - 0.2f * y + z2[i];
        z2[i] = 0.1f * x - 0.05f * y;
        total += y;
      }
      x = std::clamp(1.0f - total * 0.01f, -1.0f, 1.0f);
    }
    return static_cast<int32_t>(std::lrint(total * 100.0f));
  }
};

struct Sorting {
  int16_t a[600];
  int32_t run(int32_t rounds) {
    int32_t seed = 91, sum = 0;
    for (int32_t r = 0; r < rounds; ++r) {
      for (int16_t& v : a) {
        seed = (seed * 1021 + 7477) % 31991;
        v = static_cast<int16_t>(seed - 15000);
      }
      for (int gap = 300; gap > 0; gap /= 2) {
        for (int i = gap; i < 600; ++i) {
          const int16_t v = a[i];
          int k = i;
          for (; k >= gap && a[k - gap] > v; k -= gap) a[k] = a[k - gap];
          a[k] = v;
        }
      }
      sum = (sum + a[7] + static_cast<int16_t>(a[301] * 3) + 100000) % 99991;
    }
    return sum;
  }
};

struct Linear {
  double m[20][21], x[20];
  int32_t run(int32_t rounds) {
    double total = 0.0;
    for (int32_t r = 0; r < rounds; ++r) {
      for (int i = 0; i < 20; ++i) {
        for (int k = 0; k < 20; ++k)
          m[i][k] = i == k ? 30.0 : static_cast<double>(((i + 1) * 7 + (k + 1) * 3) % 11) * 0.1;
        m[i][20] = i + 1;
      }
      for (int k = 0; k < 19; ++k) {
        for (int i = k + 1; i < 20; ++i) {
          const double factor = m[i][k] / m[k][k];
          for (int c = k; c < 21; ++c) m[i][c] -= factor * m[k][c];
        }
      }
      for (int i = 19; i >= 0; --i) {
        double sum = m[i][20];
        for (int k = i + 1; k < 20; ++k) sum -= m[i][k] * x[k];
        x[i] = sum / m[i][i];
      }
      total += x[2];
    }
    return static_cast<int32_t>(std::lrint(total));
  }
};

struct Telegram {
  std::string_view line = "M12,ready,0417,axis3,idle,0099,";
  int32_t run(int32_t rounds) {
    int32_t sum = 0;
    char answer[81];
    for (int32_t r = 0; r < rounds; ++r) {
      std::string_view rest = line;
      size_t length = 0, fields = 0;
      for (size_t at = rest.find(','); at != std::string_view::npos; at = rest.find(',')) {
        const std::string_view field = rest.substr(0, at);
        rest.remove_prefix(at + 1);
        if (field == "ready" || field == "idle") {
          const size_t room = std::min<size_t>(field.size(), 78 - length);
          answer[length++] = '<';
          std::memcpy(answer + length, field.data(), room);
          length += room;
          answer[length++] = '>';
        } else {
          fields += field.size();
        }
      }
      answer[length] = '\0';
      sum = static_cast<int32_t>((static_cast<size_t>(sum) + fields + std::strlen(answer) * 5) % 99991);
    }
    return sum;
  }
};

struct Steps {
  int32_t run(int32_t rounds) {
    int step = 0, fill = 0, faults = 0;
    int32_t seed = 3, sum = 0;
    bool door = false;
    for (int32_t r = 0; r < rounds; ++r) {
      seed = (seed * 1021 + 7477) % 31991;
      const bool up = seed % 5 == 0, down = seed % 23 == 0;
      door = (door || seed % 71 == 0) && seed % 13 != 0;
      switch (step) {
        case 0:
          if (up && !down) step = 1;
          break;
        case 1:
        case 2:
        case 3:
          fill += 4;
          if (fill > 80 || down) ++step;
          break;
        case 4:
        case 6:
          fill -= 7;
          if (fill < 5) step = 7;
          break;
        case 5: step = 6; break;
        case 7:
          fill = 0;
          step = 0;
          break;
        default: ++faults; step = 0;
      }
      if (door && up) step = 50;
      sum = (sum + step + fill) % 99991;
    }
    return sum + faults;
  }
};

struct Integrator {
  int32_t y = 0;
  void operator()(int32_t x, bool hold) {
    if (!hold) y = (y + x) % 99991;
  }
};
int32_t blend(int32_t a, int32_t b) { return (a * 3 + b) % 9973; }

struct Calling {
  Integrator one, two;
  int32_t run(int32_t rounds) {
    int32_t v = 1;
    one.y = two.y = 0;
    for (int32_t r = 1; r <= rounds; ++r) {
      v = blend(v, r);
      one(v, v % 4 == 0);
      two(one.y, false);
    }
    return two.y;
  }
};

struct Checksum {
  uint8_t data[128];
  int32_t run(int32_t rounds) {
    for (int i = 0; i < 128; ++i) data[i] = static_cast<uint8_t>(i * 5);
    uint16_t crc = 0xffff;
    for (int32_t r = 0; r < rounds; ++r) {
      for (uint8_t byte : data) {
        crc ^= byte;
        for (int n = 0; n < 8; ++n) crc = static_cast<uint16_t>((crc & 1) != 0 ? (crc >> 1) ^ 0xa001 : crc >> 1);
      }
    }
    return crc;
  }
};

}  // namespace

int main() {
  measure<Filter>("filter", 500000);
  measure<Sorting>("sorting", 3000);
  measure<Linear>("linear", 20000);
  measure<Telegram>("telegram", 500000);
  measure<Steps>("steps", 10000000);
  measure<Calling>("calling", 10000000);
  measure<Checksum>("checksum", 50000);
  return 0;
}

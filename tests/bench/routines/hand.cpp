// SPDX-License-Identifier: Apache-2.0
// The routines as a C++ programmer writes them; kernels.st does the same work in ST. Prints who, name, rounds, seconds
// of the best of five runs, and the checksum, which must equal that of the generated code.
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "../measure_hand.h"

namespace {

int32_t nextSeed(int32_t seed) { return (seed * 1021 + 7477) % 31991; }

struct Smoother {
  float ring[32] = {}, sum = 0.0f, mean = 0.0f;
  int next = 0, filled = 0;
  void operator()(float value) {
    sum += value - ring[next];
    ring[next] = value;
    if (++next == 32) next = 0;
    filled = std::min(filled + 1, 32);
    mean = sum / static_cast<float>(filled);
  }
};

struct Average {
  int32_t run(int32_t rounds) {
    Smoother a, b;
    int32_t seed = 7;
    float total = 0.0f;
    for (int32_t r = 0; r < rounds; ++r) {
      seed = nextSeed(seed);
      a(static_cast<float>(seed % 256));
      b(a.mean);
      total = total * 0.5f + b.mean;
    }
    return static_cast<int32_t>(std::lrint(total * 64.0f));
  }
};

struct Crc {
  uint16_t table[256];
  uint8_t frame[64];
  int32_t run(int32_t rounds) {
    for (int i = 0; i < 256; ++i) {
      uint16_t w = static_cast<uint16_t>(i);
      for (int n = 0; n < 8; ++n) w = static_cast<uint16_t>((w & 1) != 0 ? (w >> 1) ^ 0xa001 : w >> 1);
      table[i] = w;
    }
    for (int i = 0; i < 64; ++i) frame[i] = static_cast<uint8_t>((i + 1) * 7);
    uint16_t crc = 0;
    for (int32_t r = 0; r < rounds; ++r) {
      crc = 0xffff;
      for (uint8_t byte : frame) crc = static_cast<uint16_t>(crc >> 8 ^ table[(crc ^ byte) & 0xff]);
      frame[0] = static_cast<uint8_t>(crc);
    }
    return crc;
  }
};

struct Delay {
  uint32_t elapsed = 0;
  bool done = false;
  void operator()(bool run, uint32_t preset, uint32_t cycle) {
    if (!run) {
      elapsed = 0;
      done = false;
    } else if (!done) {
      elapsed += cycle;
      if (elapsed >= preset) {
        elapsed = preset;
        done = true;
      }
    }
  }
};

struct Machine {
  enum State { Idle, Filling, Heating, Draining, Faulted };
  int32_t run(int32_t rounds) {
    State phase = Idle;
    Delay fill, heat, limit;
    int32_t seed = 11, sum = 0, parts = 0;
    for (int32_t r = 0; r < rounds; ++r) {
      seed = nextSeed(seed);
      const bool start = seed % 3 == 0, jam = seed % 211 == 0;
      switch (phase) {
        case Idle:
          if (start) phase = Filling;
          break;
        case Filling:
          if (fill.done) phase = Heating;
          break;
        case Heating:
          if (heat.done) {
            phase = Draining;
            ++parts;
          }
          break;
        case Draining:
          if (!start) phase = Idle;
          break;
        case Faulted:
          if (start && !jam) phase = Idle;
          break;
      }
      const bool valve = phase == Filling, heater = phase == Heating, pump = valve || phase == Draining;
      fill(valve, 120, 10);
      heat(heater, 250, 10);
      limit(valve || heater, 300, 10);
      if (jam || limit.done) phase = Faulted;
      if (pump) ++sum;
    }
    return sum + parts * 7;
  }
};

struct Recipes {
  struct Recipe {
    int32_t id;
    float weight, speed;
    bool enabled;
    char name[16];
  };
  Recipe book[40];
  int32_t run(int32_t rounds) {
    for (int i = 1; i <= 40; ++i) {
      Recipe& one = book[i - 1];
      one.id = 1000 + i * 17 % 41;
      one.weight = static_cast<float>(i * 29 % 43) * 2.5f;
      one.speed = static_cast<float>(i);
      one.enabled = i % 3 != 0;
      std::strcpy(one.name, i % 5 == 0 ? "spare" : "used");
    }
    int32_t sum = 0;
    for (int32_t r = 1; r <= rounds; ++r) {
      const float wanted = static_cast<float>(r % 107);
      const Recipe* best = nullptr;
      float nearest = 1.0e6f;
      for (const Recipe& one : book) {
        if (!one.enabled || std::strcmp(one.name, "spare") == 0) continue;
        const float distance = std::fabs(one.weight - wanted);
        if (distance < nearest) {
          nearest = distance;
          best = &one;
        }
      }
      if (best != nullptr) sum = (sum + best->id + static_cast<int32_t>(std::lrint(best->speed))) % 99991;
    }
    return sum;
  }
};

struct Packing {
  bool flags[16];
  int32_t run(int32_t rounds) {
    int32_t seed = 23, sum = 0;
    for (int32_t r = 0; r < rounds; ++r) {
      seed = nextSeed(seed);
      const uint16_t mask = static_cast<uint16_t>(seed);
      for (int i = 0; i < 16; ++i) flags[i] = (mask >> i & 1) != 0;
      uint16_t status = 0;
      int ones = 0;
      for (int i = 0; i < 16; ++i) {
        if (flags[15 - i]) {
          status = static_cast<uint16_t>(status | 1 << i);
          ++ones;
        }
      }
      const uint32_t third = (mask >> 12 & 1) & ~(mask >> 5 & 1);
      status = static_cast<uint16_t>((status & ~8u) | third << 3);
      uint32_t wide = static_cast<uint32_t>(status) << 16 | mask;
      wide = wide << 5 | wide >> 27;
      sum = (sum + static_cast<int32_t>(wide & 0xffff) + ones) % 99991;
    }
    return sum;
  }
};

struct Report {
  int32_t run(int32_t rounds) {
    const std::string_view unit = "mm";
    int32_t sum = 0;
    char line[81];
    for (int32_t r = 1; r <= rounds; ++r) {
      char* end = line;
      auto add = [&](std::string_view part) {
        const size_t count = std::min<size_t>(part.size(), static_cast<size_t>(line + 80 - end));
        std::memcpy(end, part.data(), count);
        end += count;
      };
      add("pos ");
      for (int i = 1; i <= 6; ++i) {
        add(" ");
        char digits[12];
        add({digits, static_cast<size_t>(std::to_chars(digits, digits + 12, r % 1000 * i).ptr - digits)});
        add(unit);
      }
      const std::string_view text(line, static_cast<size_t>(end - line));
      sum = static_cast<int32_t>((static_cast<size_t>(sum) + text.size() + (text.find('7') + 1)) % 99991);
    }
    return sum;
  }
};

struct Lag {
  double y = 0.0;
  void operator()(double x, double share) { y += (x - y) * share; }
};

struct Controller {
  double integral = 0.0, out = 0.0;
  void operator()(double wanted, double actual, double gain, double integral_share, double most) {
    const double error = wanted - actual;
    integral = std::clamp(integral + error * integral_share, -most, most);
    out = std::clamp(error * gain + integral, -most, most);
  }
};

struct Cascade {
  int32_t run(int32_t rounds) {
    Controller outer, inner;
    Lag motor, load;
    double wanted = 0.0;
    for (int32_t r = 1; r <= rounds; ++r) {
      if (r % 500 == 0) wanted = 60.0 - wanted;
      outer(wanted, load.y, 1.5, 0.002, 80.0);
      inner(outer.out, motor.y, 0.8, 0.01, 120.0);
      motor(inner.out, 0.05);
      load(motor.y, 0.01);
    }
    return static_cast<int32_t>(std::lrint(load.y * 1000.0));
  }
};

struct Transform {
  double a[4][4], b[4][4], c[4][4], p[4], q[4];
  int32_t run(int32_t rounds) {
    for (int i = 0; i < 4; ++i) {
      p[i] = i + 1;
      for (int j = 0; j < 4; ++j) {
        b[i][j] = static_cast<double>((i + 1) * 3 - (j + 1)) * 0.05;
        a[i][j] = i == j ? 1.0 : 0.0;
      }
    }
    for (int32_t r = 0; r < rounds; ++r) {
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
          double acc = 0.0;
          for (int k = 0; k < 4; ++k) acc += a[i][k] * b[k][j];
          c[i][j] = acc;
        }
      }
      for (int i = 0; i < 4; ++i) {
        q[i] = 0.0;
        for (int k = 0; k < 4; ++k) q[i] += c[i][k] * p[k];
      }
      for (int i = 0; i < 4; ++i) p[i] = q[i] * 0.3 + (i + 1);
      std::memcpy(a, c, sizeof a);
      for (int i = 0; i < 4; ++i) a[i][i] = a[i][i] * 0.5 + 0.5;
    }
    return static_cast<int32_t>(std::lrint(p[1] * 1000.0));
  }
};

struct Ranking {
  int32_t key[60];
  int16_t rank[60];
  int32_t run(int32_t rounds) {
    int32_t seed = 5, sum = 0;
    for (int32_t r = 0; r < rounds; ++r) {
      for (int i = 0; i < 60; ++i) {
        seed = nextSeed(seed);
        key[i] = seed;
        rank[i] = static_cast<int16_t>(i + 1);
      }
      for (int i = 1; i < 60; ++i) {
        const int32_t value = key[i];
        const int16_t moved = rank[i];
        int k = i - 1;
        for (; k >= 0 && key[k] > value; --k) {
          key[k + 1] = key[k];
          rank[k + 1] = rank[k];
        }
        key[k + 1] = value;
        rank[k + 1] = moved;
      }
      sum = (sum + rank[2] + key[29]) % 99991;
    }
    return sum;
  }
};

struct Calendar {
  static int32_t dayOf(int32_t y, int32_t m, int32_t day) {
    if (m <= 2) {
      --y;
      m += 12;
    }
    return 365 * y + y / 4 - y / 100 + y / 400 + (153 * (m - 3) + 2) / 5 + day;
  }
  int32_t run(int32_t rounds) {
    int32_t year = 1996, month = 1, day = 1, sum = 0;
    for (int32_t r = 0; r < rounds; ++r) {
      const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
      int32_t last;
      switch (month) {
        case 2: last = leap ? 29 : 28; break;
        case 4:
        case 6:
        case 9:
        case 11: last = 30; break;
        default: last = 31;
      }
      day += 9;
      if (day > last) {
        day -= last;
        if (++month > 12) {
          month = 1;
          if (++year > 2100) year = 1996;
        }
      }
      const int32_t week = (dayOf(year, month, day) + 2) % 7;
      sum = (sum + week * 31 + month) % 99991;
    }
    return sum;
  }
};

struct Stations {
  struct Station {
    virtual int32_t step(int32_t x) = 0;
    virtual void clear() = 0;
  };
  struct Feeder : Station {
    uint32_t n = 0;
    int32_t step(int32_t x) override { return static_cast<int32_t>(n += static_cast<uint32_t>(x)); }
    void clear() override { n = 0; }
  };
  struct Press : Feeder {
    uint32_t turns = 0;
    int32_t step(int32_t x) override { return static_cast<int32_t>(static_cast<uint32_t>(x) * 3 + ++turns); }
    void clear() override { turns = 0; }
  };
  struct Sorter : Station {
    uint32_t last = 0;
    int32_t step(int32_t x) override {
      const uint32_t now = static_cast<uint32_t>(x), before = last;
      last = now;
      return static_cast<int32_t>(now - before);
    }
    void clear() override { last = 0; }
  };
  Feeder feeders[3];
  Press presses[3];
  Sorter sorters[2];
  Station* line[8] = {&feeders[0], &presses[0], &sorters[0], &feeders[1],
                      &presses[1], &sorters[1], &feeders[2], &presses[2]};
  int32_t run(int32_t rounds) {
    int32_t x = 1;
    for (Station* station : line) station->clear();
    for (int32_t r = 0; r < rounds; ++r)
      for (Station* station : line) x = station->step(x);
    return x;
  }
};

struct Conveyors {
  struct Conveyor {
    uint32_t n = 0, last = 0;
    int32_t step(int32_t x) {
      n += static_cast<uint32_t>(x);
      const uint32_t before = last;
      last = static_cast<uint32_t>(x);
      return static_cast<int32_t>(n - before);
    }
    void clear() { n = last = 0; }
  };
  Conveyor line[8];
  int32_t run(int32_t rounds) {
    int32_t x = 1;
    for (Conveyor& conveyor : line) conveyor.clear();
    for (int32_t r = 0; r < rounds; ++r)
      for (Conveyor& conveyor : line) x = conveyor.step(x);
    return x;
  }
};

using Name = std::array<char, 81>;

struct Queue {
  Name waiting[16];
  __attribute__((noinline)) static int kindOf(const char* name) {
    if (std::strcmp(name, "on") == 0) return 1;
    return std::strcmp(name, "off") == 0 ? 2 : 3;
  }
  int32_t run(int32_t rounds) {
    const char* const first[] = {"on", "off", "maintenance"};
    for (int i = 0; i < 16; ++i) {
      waiting[i] = {};
      std::strcpy(waiting[i].data(), first[i % 3]);
    }
    int32_t sum = 0;
    for (int32_t r = 0; r < rounds; ++r) {
      std::rotate(waiting, waiting + 1, waiting + 16);
      for (const Name& name : waiting) sum += kindOf(name.data());
      sum %= 99991;
    }
    return sum;
  }
};

}  // namespace

int main() {
  measure<Average>("average", 1000000);
  measure<Crc>("crc", 50000);
  measure<Machine>("machine", 2000000);
  measure<Recipes>("recipes", 100000);
  measure<Packing>("packing", 500000);
  measure<Report>("report", 50000);
  measure<Cascade>("cascade", 500000);
  measure<Transform>("transform", 200000);
  measure<Ranking>("ranking", 5000);
  measure<Calendar>("calendar", 1000000);
  measure<Stations>("stations", 1000000);
  measure<Conveyors>("conveyors", 1000000);
  measure<Queue>("queue", 200000);
  return 0;
}

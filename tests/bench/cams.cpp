// SPDX-License-Identifier: Apache-2.0
// The measurement of cams.sh. Out: two lines; exit code 1: a moving master costs more than 20 ns.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

#include "cam/table/table.h"

using namespace rung::cam;

namespace {

constexpr double kMost = 20;  // ns
constexpr int kSegments = 1000, kCount = 100000, kRounds = 50;

double cpuNanoseconds() {
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

// The best round; `sum` keeps the compiler from leaving the work out.
double measure(const Table& table, const std::vector<double>& masters, double& sum) {
  double best = 1e9;
  for (int round = 0; round < kRounds; ++round) {
    int32_t segment = 0;
    const double begin = cpuNanoseconds();
    for (const double x : masters) {
      Value value = {};
      if (at(table, x, segment, value)) sum += value.position + value.slope + value.curvature;
    }
    best = std::min(best, (cpuNanoseconds() - begin) / static_cast<double>(masters.size()));
  }
  return best;
}

}  // namespace

int main() {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any(-1, 1), width(0.5, 2);
  std::vector<Point> points = {{0, 0, 0, 0}};
  while (points.size() <= kSegments)
    points.push_back({points.back().x + width(random), any(random), any(random), any(random)});
  Table table = {};
  table.points = points.data();
  table.count = static_cast<int32_t>(points.size());
  table.kind = Kind::QuinticPoints;
  table.end = points.back().x;

  std::vector<double> moving, jumping;
  std::uniform_real_distribution<double> anywhere(0, table.end);
  for (int i = 0; i < kCount; ++i) {
    moving.push_back(table.end * i / kCount);
    jumping.push_back(anywhere(random));
  }
  double sum = 0;
  const double moves = measure(table, moving, sum), jumps = measure(table, jumping, sum);
  std::printf("%.1f ns with a moving master (at most %.0f)\n%.1f ns after a jump\n", moves, kMost, jumps);
  return moves <= kMost && sum == sum ? 0 : 1;
}

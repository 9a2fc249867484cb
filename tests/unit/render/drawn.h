// SPDX-License-Identifier: Apache-2.0
// Parses a program and draws it; helpers of the picture tests for lines and boxes.
#pragma once

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "frontend/parse/parse.h"
#include "frontend/render/svg.h"
#include "frontend/source/dialect.h"

namespace rung::picture {

struct Drawn {
  explicit Drawn(const std::string& source) : diagnostics(sources) {
    const FileUnit unit =
        text::parseFile(tree, names, sources, sources.add("test.st", source), Dialect::Codesys, diagnostics);
    EXPECT_EQ(0u, diagnostics.errorCount()) << source;
    pou = &tree.as<PouDecl>(tree.list(unit.decls)[0]);
  }
  Sources sources;
  Diagnostics diagnostics;
  Names names;
  Tree tree;
  const PouDecl* pou;
};

// Random numbers that are the same on every machine.
class Numbers {
 public:
  explicit Numbers(uint32_t seed) : state_(seed * 2654435761u + 1) {}
  uint32_t below(uint32_t n) {
    state_ = state_ * 1664525u + 1013904223u;
    return (state_ >> 8) % n;
  }

 private:
  uint32_t state_;
};

struct Segment {
  Point a, b;
  bool holds(Point p) const {
    return p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) && p.y >= std::min(a.y, b.y) &&
           p.y <= std::max(a.y, b.y);
  }
  bool touches(const Segment& o) const { return holds(o.a) || holds(o.b) || o.holds(a) || o.holds(b); }
  // True when the line runs through the inside of the box.
  bool cuts(const Rect& r) const {
    return std::max(a.x, b.x) > r.x && std::min(a.x, b.x) < r.right() && std::max(a.y, b.y) > r.y &&
           std::min(a.y, b.y) < r.bottom();
  }
};

// Finds which of many lines are connected.
class Connected {
 public:
  explicit Connected(std::vector<Segment> lines) : lines_(std::move(lines)), group_(lines_.size()) {
    std::iota(group_.begin(), group_.end(), 0u);
    for (size_t i = 0; i < lines_.size(); ++i)
      for (size_t k = 0; k < i; ++k)
        if (lines_[i].touches(lines_[k])) group_[find(i)] = find(k);
  }
  // The group of the line that contains the point; the number of lines when there is none.
  size_t groupAt(Point p) {
    for (size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].holds(p)) return find(i);
    return lines_.size();
  }
  size_t none() const { return lines_.size(); }

 private:
  size_t find(size_t i) {
    while (group_[i] != i) i = group_[i];
    return i;
  }
  std::vector<Segment> lines_;
  std::vector<size_t> group_;
};

}  // namespace rung::picture

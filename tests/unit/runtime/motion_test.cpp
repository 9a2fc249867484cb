// SPDX-License-Identifier: Apache-2.0
// rung_find_axes: axes in programs, lists, arrays of several dimensions and base blocks, and none through references.
#include "rung/motion.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

// A module of types and symbols, without code.
class Layout {
 public:
  uint32_t text(const char* name) {
    const auto at = static_cast<uint32_t>(strings_.size());
    strings_.append(name).push_back('\0');
    return at;
  }
  uint32_t elementary(uint32_t size) { return add({RUNG_DINT, 1, 0, text("DINT"), size, RUNG_NONE, 0, 0, 0}); }
  uint32_t record(const char* name, uint32_t size, const std::vector<rung_field>& fields) {
    const auto first = static_cast<uint32_t>(fields_.size());
    fields_.insert(fields_.end(), fields.begin(), fields.end());
    return add({RUNG_RECORD, 0, 0, text(name), size, RUNG_NONE, 0, first, static_cast<uint32_t>(fields.size())});
  }
  uint32_t array(uint32_t element, uint32_t size, const std::vector<rung_dimension>& dimensions) {
    const auto first = static_cast<uint32_t>(dimensions_.size());
    dimensions_.insert(dimensions_.end(), dimensions.begin(), dimensions.end());
    return add({RUNG_ARRAY, 0, 0, 0, size, element, 0, first, static_cast<uint32_t>(dimensions.size())});
  }
  rung_field field(const char* name, uint32_t type, uint32_t offset, uint32_t flags = 0) {
    return {text(name), type, offset, flags};
  }
  void symbol(const char* name, uint32_t type, uint32_t block, uint32_t offset, uint32_t flags = 0) {
    symbols_.push_back({text(name), type, RUNG_IN_BLOCK, 255, 0, block, offset, flags, text("")});
  }
  std::vector<std::string> find(uint32_t capacity = 16) {
    rung_module module = {};
    module.strings = strings_.data();
    module.types = table(types_);
    module.fields = table(fields_);
    module.dimensions = table(dimensions_);
    module.symbols = table(symbols_);
    rung_axis axes[16];
    count = rung_find_axes(&module, axes, capacity);
    std::vector<std::string> found;
    for (uint32_t i = 0; i < count && i < capacity; ++i)
      found.push_back(std::string(axes[i].name) + " " + std::to_string(axes[i].block) + "+" +
                      std::to_string(axes[i].offset));
    return found;
  }
  uint32_t count = 0;

 private:
  template <class Row>
  static rung_table table(const std::vector<Row>& rows) {
    return {rows.data(), static_cast<uint32_t>(rows.size()), sizeof(Row)};
  }
  uint32_t add(const rung_type& type) {
    types_.push_back(type);
    return static_cast<uint32_t>(types_.size() - 1);
  }
  std::string strings_ = std::string(1, '\0');
  std::vector<rung_type> types_;
  std::vector<rung_field> fields_;
  std::vector<rung_dimension> dimensions_;
  std::vector<rung_symbol> symbols_;
};

struct Axes : testing::Test {
  Layout layout;
  uint32_t number = layout.elementary(4);
  uint32_t drive = layout.record("RUNG_DRIVE", 80, {layout.field("position", number, 36)});
  uint32_t axis = layout.record("AXIS_REF_SM3", 200, {layout.field("x", number, 0), layout.field("drive", drive, 100)});
};

TEST_F(Axes, InVariablesAndRecords) {
  const uint32_t station =
      layout.record("Station", 500, {layout.field("lift", axis, 8), layout.field("n", number, 300)});
  layout.symbol("X", axis, 2, 16);
  layout.symbol("Main", station, 1, 0);
  EXPECT_EQ((std::vector<std::string>{"X 2+116", "Main.lift 1+108"}), layout.find());
}

TEST_F(Axes, InArraysTheLastIndexCountsFastest) {
  layout.symbol("line", layout.array(axis, 800, {{-1, 0}, {5, 6}}), 0, 0);
  EXPECT_EQ((std::vector<std::string>{"line[-1,5] 0+100", "line[-1,6] 0+300", "line[0,5] 0+500", "line[0,6] 0+700"}),
            layout.find());
}

TEST_F(Axes, OfABaseBlockWithoutItsName) {
  const uint32_t derived = layout.record("Derived", 208, {layout.field("base", axis, 0, RUNG_FIELD_BASE)});
  layout.symbol("d", derived, 0, 0);
  EXPECT_EQ(std::vector<std::string>{"d 0+100"}, layout.find());
}

TEST_F(Axes, NotThroughReferences) {
  const uint32_t user = layout.record("User", 8, {layout.field("axis", axis, 0, RUNG_FIELD_BY_REFERENCE)});
  layout.symbol("u", user, 0, 0);
  layout.symbol("r", axis, 0, 8, RUNG_FIELD_BY_REFERENCE);
  EXPECT_TRUE(layout.find().empty());
}

TEST_F(Axes, CountsMoreThanThereIsRoomFor) {
  layout.symbol("line", layout.array(axis, 600, {{1, 3}}), 0, 0);
  EXPECT_EQ(std::vector<std::string>{"line[1] 0+100"}, layout.find(1));
  EXPECT_EQ(3u, layout.count);
}

TEST_F(Axes, LongPathsAreCut) {
  layout.symbol(std::string(300, 'x').c_str(), axis, 0, 0);
  EXPECT_EQ(std::string(127, 'x') + " 0+100", layout.find()[0]);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// A module as the bundled host reads it. In: the tables of a module with this RUNG_MODULE_ABI, whose rows may be longer
// or shorter than those of this header. Out: the same tables with typed rows; columns that the module does not have are
// 0. It refers to the module, which outlives it.
#pragma once

#include <cstddef>
#include <iterator>
#include <vector>

#include "rung/module.h"

namespace rung::host {

template <class Row>
class Table {
 public:
  explicit Table(const rung_table& from) : table_(from) {
    if (from.row_size >= sizeof(Row)) return;
    copies_.resize(from.count);
    for (uint32_t i = 0; i < from.count; ++i) rung_copy_row(&from, i, &copies_[i], sizeof(Row));
    table_ = {copies_.data(), from.count, sizeof(Row)};
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Row;
    using difference_type = ptrdiff_t;
    using pointer = const Row*;
    using reference = const Row&;
    Iterator(const rung_table& table, uint32_t index) : table_(&table), index_(index) {}
    reference operator*() const { return *static_cast<pointer>(rung_row(table_, index_)); }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }
    bool operator!=(const Iterator& other) const { return index_ != other.index_; }

   private:
    const rung_table* table_;
    uint32_t index_;
  };

  uint32_t size() const { return table_.count; }
  const Row& operator[](uint32_t index) const { return *static_cast<const Row*>(rung_row(&table_, index)); }
  Iterator begin() const { return {table_, 0}; }
  Iterator end() const { return {table_, table_.count}; }

 private:
  rung_table table_;
  std::vector<Row> copies_;  // where the rows of the module are shorter
};

struct LoadedModule {
  explicit LoadedModule(const rung_module& module)
      : description(module),
        strings(module.strings),
        blocks(module.blocks),
        areas(module.areas),
        resources(module.resources),
        tasks(module.tasks),
        writes(module.writes),
        io_modules(module.io_modules),
        symbols(module.symbols),
        types(module.types),
        fields(module.fields),
        enum_items(module.enum_items),
        dimensions(module.dimensions),
        retain(module.retain),
        persistent(module.persistent),
        tests(module.tests) {}

  const rung_module& description;
  const char* strings;
  Table<rung_block> blocks;
  Table<rung_area> areas;
  Table<uint32_t> resources;
  Table<rung_task> tasks;
  Table<rung_write> writes;
  Table<rung_io_module> io_modules;
  Table<rung_symbol> symbols;
  Table<rung_type> types;
  Table<rung_field> fields;
  Table<rung_enum_item> enum_items;
  Table<rung_dimension> dimensions;
  Table<rung_range> retain, persistent;
  Table<rung_test> tests;
};

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// Initial values of a large array that repeat: loops that store them, instead of data as large as the array. In: the
// bytes of the array's initial value. Out: assignments, or nothing when the value does not repeat. Called by
// initial_values.cpp for every array of constants.
#include <algorithm>
#include <bit>

#include "ir/lower/lowering.h"

namespace rung::ir {

namespace {

constexpr size_t kSmallArray = 8192;       // bytes: its data costs less than loops
constexpr uint64_t kBytesPerStore = 1024;  // of the array, for each assignment that is emitted
constexpr uint64_t kMaxPeriod = 8;

// The `period` rows from `first` on, `count` times.
struct RowRun {
  uint64_t first, period, count;
};

// The rows of one dimension of an array: elements, or rows of the next dimension.
struct Rows {
  std::span<const uint8_t> bytes;
  uint64_t count;

  uint64_t size() const { return bytes.size() / count; }
  std::span<const uint8_t> row(uint64_t i) const { return bytes.subspan(i * size(), size()); }
  bool areEqual(uint64_t a, uint64_t b) const { return std::ranges::equal(row(a), row(b)); }
  RowRun runAt(uint64_t first) const;
};

// The longest repetition from `first` on.
RowRun Rows::runAt(uint64_t first) const {
  RowRun best{first, 1, 1};
  for (uint64_t period = 1; period <= kMaxPeriod && first + period < count; ++period) {
    uint64_t end = first + period;
    while (end < count && areEqual(end, end - period)) ++end;
    const uint64_t times = (end - first) / period;
    if (times > 1 && times * period > best.period * best.count) best = {first, period, times};
    if (end == count) break;
  }
  return best;
}

Rows rowsOf(const TypeInfo& array, uint32_t dimension, std::span<const uint8_t> bytes) {
  return {bytes, array.dimensions[dimension].count()};
}

// How many assignments the loops contain; at most about `limit`.
uint64_t storesOf(const TypeInfo& array, uint32_t dimension, std::span<const uint8_t> bytes, uint64_t limit) {
  if (dimension == array.dimensions.size()) return 1;
  const Rows rows = rowsOf(array, dimension, bytes);
  uint64_t stores = 0;
  for (uint64_t i = 0; i < rows.count && stores <= limit;) {
    const RowRun run = rows.runAt(i);
    for (uint64_t k = 0; k < run.period; ++k) stores += storesOf(array, dimension + 1, rows.row(i + k), limit - stores);
    i += run.period * run.count;
  }
  return stores;
}

// The reverse of storeScalar in initial_values.cpp.
uint64_t scalarBits(const TypeTable& types, TypeKind kind, std::span<const uint8_t> bytes) {
  uint64_t bits = 0;
  for (size_t i = bytes.size(); i-- > 0;) bits = bits << 8 | bytes[i];
  if (kind == TypeKind::Real) return Value::ofReal({}, std::bit_cast<float>(static_cast<uint32_t>(bits))).bits;
  const uint32_t unused = 64 - 8 * static_cast<uint32_t>(bytes.size());
  if (types.isSigned(kind)) return static_cast<uint64_t>(static_cast<int64_t>(bits << unused) >> unused);
  return bits;
}

bool isAllZero(std::span<const uint8_t> bytes) {
  return std::ranges::all_of(bytes, [](uint8_t b) { return b == 0; });
}

}  // namespace

bool ObjectLowering::storeRepeated(ExprId place, TypeId type, std::span<const uint8_t> bytes, bool place_is_zero) {
  const uint64_t limit = bytes.size() / kBytesPerStore;
  if (bytes.size() < kSmallArray || storesOf(types_.info(type), 0, bytes, limit) > limit) return false;
  std::vector<ExprId> indices;
  storeRows(place, type, bytes, indices, place_is_zero);
  return true;
}

// The part of the array at `indices`; rows that repeat are stored by a loop.
void ObjectLowering::storeRows(ExprId array, TypeId type, std::span<const uint8_t> bytes, std::vector<ExprId>& indices,
                               bool place_is_zero) {
  if (place_is_zero && isAllZero(bytes)) return;
  const TypeInfo& info = types_.info(type);
  const uint32_t dimension = static_cast<uint32_t>(indices.size());
  const Loc loc = body_.expr(array).loc;
  if (dimension == info.dimensions.size()) {
    std::vector<ExprId> at;
    for (const ExprId index : indices) at.push_back(copy(index));
    return storeBytes(element(copy(array), at, loc), info.base, bytes);
  }
  const Rows rows = rowsOf(info, dimension, bytes);
  const int64_t low = info.dimensions[dimension].low;
  const auto number = [&](uint64_t n) { return constant(types::kDInt, n, loc); };
  const auto rowAt = [&](uint64_t row, ExprId index) {
    indices.push_back(index);
    storeRows(array, type, rows.row(row), indices, place_is_zero);
    indices.pop_back();
  };
  for (uint64_t i = 0; i < rows.count;) {
    const RowRun run = rows.runAt(i);
    const uint64_t from = static_cast<uint64_t>(low) + i;
    i += run.period * run.count;
    if (run.count == 1) {
      rowAt(run.first, number(from));
      continue;
    }
    const ExprId control = temp(types::kDInt, loc);
    const StmtId body = block([&] {
      for (uint64_t k = 0; k < run.period; ++k)
        rowAt(run.first + k, k == 0 ? control : binary(Op::Add, types::kDInt, copy(control), number(k), loc));
    });
    append(loc, ForStmt{.control = copy(control),
                        .from = number(from),
                        .to = number(from + run.period * (run.count - 1)),
                        .step = number(run.period),
                        .body_block = body});
  }
}

// One element whose value is known as bytes. A structure or array inside has its own loops where it has its default.
void ObjectLowering::storeBytes(ExprId place, TypeId declared, std::span<const uint8_t> bytes) {
  const TypeId type = strip(declared);
  const Loc loc = body_.expr(place).loc;
  if (isAllZero(bytes)) return assign(place, zero(type, loc), loc);
  if (bytes.size() >= kSmallArray) {
    std::vector<uint8_t> by_default(bytes.size());
    if (writeDefault(declared, by_default.data()) && std::ranges::equal(bytes, by_default))
      return storeInitial(place, declared, {}, false);
    if (types_.kind(type) == TypeKind::Array && storeRepeated(place, type, bytes, false)) return;
  }
  const TypeKind kind = types_.plainKind(type);
  if (TypeTable::isScalar(kind)) return assign(place, constant(type, scalarBits(types_, kind, bytes), loc), loc);
  in_.module.data.push_back({type, {bytes.begin(), bytes.end()}});
  assign(place, add(loc, type, DataExpr{.index = static_cast<uint32_t>(in_.module.data.size() - 1)}), loc);
}

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// The services of MR and MW and their execution codes: nc_services.def, nc_codes.def. Used by operands.cpp, which
// checks constant function codes, and by `rung list nct`. NCT manual 6.18 to 6.29.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace rung::importer::nct {

enum class ServiceDirection : uint8_t { Read, Write };  // MR, MW

struct Service {
  ServiceDirection direction;
  int32_t code;
  int32_t least, most;  // amount of data; most 0: open
  std::string_view section, what;
};
std::span<const Service> services();
// By its function code; null: none.
const Service* findService(int64_t code);

struct ExecutionCode {
  int32_t code;
  std::string_view meaning;
};
std::span<const ExecutionCode> executionCodes();

constexpr std::string_view wordOf(ServiceDirection direction) {
  return direction == ServiceDirection::Read ? "MR" : "MW";
}

}  // namespace rung::importer::nct

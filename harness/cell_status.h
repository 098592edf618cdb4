#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fracbench {

/// How a cell ended. Each of these is a result: failure is a record too.
enum class CellStatus : std::uint8_t {
  ok,             ///< it broke and its fragments are valid
  unbroken,       ///< the target stayed whole
  invalid,        ///< the method gave up, or its fragments are not solids that fill the target
  timeout,        ///< it took longer than allowed
  out_of_memory,  ///< it needed more memory than there is
  crash,          ///< its process died
};

inline constexpr std::array<CellStatus, 6> kCellStatuses = {
    CellStatus::ok,      CellStatus::unbroken,      CellStatus::invalid,
    CellStatus::timeout, CellStatus::out_of_memory, CellStatus::crash};

/// "ok", "unbroken", "invalid", "timeout", "out-of-memory" or "crash".
std::string_view to_string(CellStatus status);

/// The status of that name, if it is one.
std::optional<CellStatus> parse_cell_status(std::string_view name);

}  // namespace fracbench

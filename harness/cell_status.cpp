#include "harness/cell_status.h"

namespace fracbench {

std::string_view to_string(CellStatus status) {
  switch (status) {
    case CellStatus::ok:
      return "ok";
    case CellStatus::unbroken:
      return "unbroken";
    case CellStatus::invalid:
      return "invalid";
    case CellStatus::timeout:
      return "timeout";
    case CellStatus::out_of_memory:
      return "out-of-memory";
    case CellStatus::crash:
      return "crash";
  }
  return "";
}

std::optional<CellStatus> parse_cell_status(std::string_view name) {
  for (const CellStatus status : kCellStatuses) {
    if (to_string(status) == name) return status;
  }
  return std::nullopt;
}

}  // namespace fracbench

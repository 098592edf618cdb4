#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "harness/plan.h"

namespace fracbench {

/// What a worker is given once: a plan with one shape and one method, whose cells come one by one.
struct WorkerJob {
  Plan plan;
  std::uint64_t memory = 0;  ///< that the process may take, bytes
};

/// Everything that a worker needs to measure cells of this one's shape and method.
std::string encode_job(const Plan& plan, const Cell& cell, std::uint64_t memory);

/// Throws DataError for bytes that are no job, InputError for a method that `catalog` has not.
WorkerJob decode_job(std::string_view bytes, const Catalog& catalog);

/// One cell, with its scene.
std::string encode_cell(const Plan& plan, const Cell& cell);

/// Makes the scene the only one of the job's shape, and returns its cell. Throws DataError.
Cell decode_cell(std::string_view bytes, Plan& plan);

}  // namespace fracbench

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/fragments.h"
#include "metrics/metric.h"

namespace fracbench {

/// Adds the value where it is finite: what does not exist is left out.
void add_value(Measurement& measurement, std::string name, double value, std::string unit = "");

/// Whether every index is in range, every vertex finite and every face has a tag, so that it can be
/// measured without care. A fragment that is not so fails `validity` and is ignored by the others.
bool is_well_formed(const Fragment& fragment);

/// The fragments that are well formed, in their order.
std::vector<std::reference_wrapper<const Fragment>> measurable(const Fragments& fragments);

}  // namespace fracbench

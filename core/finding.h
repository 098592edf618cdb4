#pragma once

#include <string>
#include <vector>

namespace fracbench {

/// Numbers that a method knows of its own work and no metric can see, such as the loss of each
/// epoch of a training. They stand in the record beside the metrics, as a series of that name,
/// which begins with the method's.
struct Finding {
  std::string name;
  std::vector<double> values;
  std::string unit = {};  ///< empty: pure numbers
};

}  // namespace fracbench

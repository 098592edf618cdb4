#pragma once

#include <string>
#include <vector>

namespace fracbench {

/// One time from table 2 of the paper.
struct PublishedTime {
  std::string table, row, column;  ///< where it stands there
  std::string shape;               ///< "squirrel"; "mean" for the last row
  std::string method;              ///< name in the registry
  std::string resolution;          ///< "128", "256"; empty where it does not depend on it
  std::string stage;               ///< of that method; "total" for the whole
  std::string printed;             ///< as it stands there: "16.9 min"
  double seconds = 0;
};

/// One thing that is wrong or missing in the paper, and what follows for a reproduction.
struct Erratum {
  std::string name, place, finding, consequence;
};

/// The values that come with the program, below reports/published. Throws InputError where they are
/// not there or damaged.
std::vector<PublishedTime> published_times();
std::vector<Erratum> published_errata();

}  // namespace fracbench

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace fracbench {

// What the paper says, as data: the files below reports/published. Every reader throws InputError,
// with the place, where a file is not there or damaged.

/// One stage of a method, as Table 2 has it.
struct PublishedStage {
  std::string method;  ///< name in the registry
  std::string stage;   ///< of that method; "total" for the whole
  int resolution = 0;  ///< of the method; 0: does not depend on it
  bool operator==(const PublishedStage&) const = default;
};

/// One time from Table 2.
struct PublishedTime {
  std::string row, column;  ///< where it stands there
  std::string shape;        ///< "squirrel"; "mean" for the last row
  PublishedStage stage;
  std::string printed;  ///< as it stands there: "16.9 min"
  double seconds = 0;
  std::string erratum;  ///< name of what is wrong with it; empty: nothing known
};

/// A quotient of two times of one shape, which may be compared between machines.
struct PublishedRatio {
  std::string name;
  PublishedStage over, under;
  std::string erratum;
};

/// One line of Table 1: what kind of method it is.
struct PublishedMethod {
  std::string row;
  std::string method;  ///< name in the registry; empty: there is none here
  std::string run_time, training, shape_type;
  bool retains_surface = false;
  bool refracture = false;
  std::string erratum;
};

/// One thing that the paper says of methods beside each other.
struct Claim {
  std::string name, place, says;
  std::string statistic;  ///< see reports/published/claims.toml
  std::string metric;     ///< where the statistic is of one
  std::string subject;    ///< label of a method
  std::vector<std::string> others;
  std::string erratum;
};

struct Claims {
  std::vector<Claim> list;
  /// Labels that give claims their meaning: a prediction is worth something beyond them.
  std::vector<std::string> baselines;
};

/// One thing that is wrong or missing in the paper, and what follows for a reproduction.
struct Erratum {
  std::string name, place, finding, consequence;
};

std::vector<PublishedTime> published_times();
std::vector<PublishedRatio> published_ratios();
std::vector<PublishedMethod> published_methods();
Claims published_claims();
std::vector<Erratum> published_errata();

/// The value of a ratio for a shape by these times; nothing where one of them is not among them.
std::optional<double> published_value(const PublishedRatio& ratio, const std::string& shape,
                                      const std::vector<PublishedTime>& times);

}  // namespace fracbench

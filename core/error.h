#pragma once

#include <stdexcept>
#include <string>

namespace fracbench {

/// Wrong usage or bad input: exit code 2. The message names the file, the value and the way out.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A method could not answer for this body or impact. The runner stores it as a record with the
/// status `invalid`; it does not end the run.
class MethodFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work was asked to stop (Ctrl-C).
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("stopped") {}
};

}  // namespace fracbench

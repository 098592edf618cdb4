#pragma once

#include <cmath>

namespace fracbench {

/// Neumaier's compensated sum: the error does not grow with the number of terms.
class Sum {
 public:
  Sum& operator+=(double term) {
    const double next = sum_ + term;
    compensation_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
    return *this;
  }
  double value() const { return sum_ + compensation_; }

 private:
  double sum_ = 0;
  double compensation_ = 0;
};

}  // namespace fracbench

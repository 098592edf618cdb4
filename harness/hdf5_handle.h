#pragma once

#include <hdf5.h>

#include <string>
#include <string_view>
#include <utility>

#include "harness/data_tree.h"

namespace fracbench {

/// An HDF5 identifier that is closed when it goes out of scope.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// Throws DataError, naming `what`, where the identifier is not valid.
  Hdf5Handle(hid_t id, Close close, std::string_view what) : id_(id), close_(close) {
    if (id_ < 0) throw DataError("HDF5: " + std::string(what) + " failed");
  }
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;

  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

}  // namespace fracbench

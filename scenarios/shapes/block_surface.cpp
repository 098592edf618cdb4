#include "scenarios/shapes/block_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace fracbench {
namespace {

/// The coordinates of the lattice along one axis: the blocks' own, with equal steps between.
std::vector<double> lattice_coordinates(std::vector<double> planes, double spacing) {
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
    const double length = planes[i + 1] - planes[i];
    const int steps = std::max(1, static_cast<int>(std::lround(length / spacing)));
    for (int k = 0; k < steps; ++k) result.push_back(planes[i] + length * k / steps);
  }
  result.push_back(planes.back());
  return result;
}

class Lattice {
 public:
  Lattice(const std::vector<Block>& blocks, double spacing) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> planes;
      for (const Block& block : blocks) {
        planes.push_back(block.low[axis]);
        planes.push_back(block.high[axis]);
      }
      coordinates_[axis] = lattice_coordinates(planes, spacing);
      cells_[axis] = static_cast<int>(coordinates_[axis].size()) - 1;
    }
    filled_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2], 0);
    for (const Block& block : blocks) fill(block);
  }

  TriangleMesh surface() {
    std::array<int, 3> cell;
    for (cell[2] = 0; cell[2] < cells_[2]; ++cell[2]) {
      for (cell[1] = 0; cell[1] < cells_[1]; ++cell[1]) {
        for (cell[0] = 0; cell[0] < cells_[0]; ++cell[0]) {
          if (filled(cell)) add_open_sides(cell);
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  std::size_t index(const std::array<int, 3>& cell) const {
    return cell[0] + static_cast<std::size_t>(cells_[0]) *
                         (cell[1] + static_cast<std::size_t>(cells_[1]) * cell[2]);
  }

  bool filled(const std::array<int, 3>& cell) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= cells_[axis]) return false;
    }
    return filled_[index(cell)] != 0;
  }

  void fill(const Block& block) {
    std::array<int, 3> begin, end;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& c = coordinates_[axis];
      begin[axis] =
          static_cast<int>(std::lower_bound(c.begin(), c.end(), block.low[axis]) - c.begin());
      end[axis] =
          static_cast<int>(std::lower_bound(c.begin(), c.end(), block.high[axis]) - c.begin());
    }
    for (int k = begin[2]; k < end[2]; ++k) {
      for (int j = begin[1]; j < end[1]; ++j) {
        for (int i = begin[0]; i < end[0]; ++i) filled_[index({i, j, k})] = 1;
      }
    }
  }

  void add_open_sides(const std::array<int, 3>& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> neighbour = cell;
        neighbour[axis] += side ? 1 : -1;
        if (filled(neighbour)) continue;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        // Counter-clockwise about the positive axis.
        std::array<std::array<int, 3>, 4> corner{cell, cell, cell, cell};
        for (auto& c : corner) c[axis] += side;
        ++corner[1][u];
        ++corner[2][u];
        ++corner[2][v];
        ++corner[3][v];
        if (side == 0) std::swap(corner[1], corner[3]);
        // Diagonals alternate like the colours of a chessboard: no direction is preferred.
        const int turn = (cell[u] + cell[v]) % 2;
        std::array<std::int32_t, 4> id;
        for (int k = 0; k < 4; ++k) id[k] = vertex(corner[(k + turn) % 4]);
        mesh_.faces.push_back({id[0], id[1], id[2]});
        mesh_.faces.push_back({id[0], id[2], id[3]});
      }
    }
  }

  std::int32_t vertex(const std::array<int, 3>& at) {
    const auto [known, added] =
        ids_.try_emplace(at, static_cast<std::int32_t>(mesh_.vertices.size()));
    if (added) {
      mesh_.vertices.emplace_back(coordinates_[0][at[0]], coordinates_[1][at[1]],
                                  coordinates_[2][at[2]]);
    }
    return known->second;
  }

  std::array<std::vector<double>, 3> coordinates_;
  std::array<int, 3> cells_{};
  std::vector<char> filled_;
  std::map<std::array<int, 3>, std::int32_t> ids_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh block_surface(const std::vector<Block>& blocks, double spacing) {
  return Lattice(blocks, spacing).surface();
}

}  // namespace fracbench

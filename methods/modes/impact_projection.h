#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/context.h"
#include "core/impact.h"
#include "methods/modes/atomic_pieces.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

/// How the pieces of a body answer to impulses (Sellan et al. 2023, "Breaking Good", impact
/// projection). In the unit box, an impulse at the tets' vertices spreads for one implicit step
///     (M - h L) x = f,   h = 1/30,
/// with the lumped masses M (a quarter of each tet's volume per corner) and the linear finite
/// elements' Laplacian L; a piece answers with the mass-weighted mean of x over its tets. Since L
/// keeps constants, the mean over all tets is that of a rigid body.
struct ImpactProjection {
  /// Two pieces that touch.
  struct Bond {
    std::array<std::int32_t, 2> pieces{-1, -1};
    double area = 0;  ///< m^2
    bool operator==(const Bond&) const = default;
  };
  UnitBox frame;
  std::vector<Vec3> vertices;  ///< of the tets, in the unit box
  /// (vertices x pieces): the answer of each piece to a unit impulse at each vertex, for density 1
  /// in the unit box. The same in all three directions.
  Eigen::MatrixXd response;
  /// Per vertex the pieces that its tets belong to: those from piece_begin[v] to piece_begin[v +
  /// 1].
  std::vector<std::int32_t> piece_begin, piece_at;
  std::vector<Bond> bonds;  ///< ascending by their pieces

  std::int32_t piece_count() const { return static_cast<std::int32_t>(response.cols()); }
};

/// Throws MethodFailure where the linear system cannot be solved, Cancelled.
ImpactProjection project_impacts(const TetMesh& tets, const AtomicPieces& pieces, Context& context);

/// Impulses reach the vertices within this distance of the contact, a share of the longest side;
/// where there is none, the nearest.
inline constexpr double kContactRadius = 0.05;

/// Velocities that impulses give to the pieces, m/s: (pieces x 3). An impulse of J (N s) spreads
/// evenly over the vertices S around its point that touch one of `pieces` (ascending), and
///     v_p = J d / (rho s^3) * mean over S of response(., p)
/// with the density rho (kg / m^3) and the size s of the unit box (m). Rows of pieces that are not
/// among `pieces` are 0.
Eigen::MatrixX3d piece_velocities(const ImpactProjection& projection,
                                  std::span<const std::int32_t> pieces,
                                  std::span<const Impulse> impulses, double density);

/// The largest threshold at which held_together() has two groups for `pieces` that are connected,
/// m/s; 0 for a single piece: the largest difference of velocity that cannot be avoided on the way
/// between two pieces (in the minimum spanning tree of the bonds).
double parting_jump(const ImpactProjection& projection, std::span<const std::int32_t> pieces,
                    const Eigen::MatrixX3d& velocities);

/// For each of `pieces` its group: they stay joined where their velocities differ by less than
/// `threshold` (m/s). Numbered 0, 1, ... in the order of their first pieces.
std::vector<std::int32_t> held_together(const ImpactProjection& projection,
                                        std::span<const std::int32_t> pieces,
                                        const Eigen::MatrixX3d& velocities, double threshold);

/// The median over points spread evenly over the body's surface of the parting jump that a unit
/// impulse there makes, m/s per N s; 0 where there is a single piece.
double typical_jump(const ImpactProjection& projection, const TriangleMesh& body, double density);

}  // namespace fracbench::modes

#include "methods/deepfracture/reconstruct.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/sum.h"
#include "geometry/measures.h"
#include "geometry/partition_by_labels.h"

namespace fracbench::deepfracture {

namespace {

/// Mean length of the edges, each as often as faces meet at it, m.
double mean_edge(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) sum += (mesh.corner(f, k) - mesh.corner(f, (k + 1) % 3)).norm();
  }
  return sum / (3 * static_cast<double>(mesh.faces.size()));
}

/// The same labels on a grid of about `spacing` over the same box: each sample has that of the
/// nearest voxel.
VoxelGrid<std::int32_t> resampled(const VoxelGrid<std::int32_t>& labels, double spacing) {
  const double side = labels.size[0] * labels.spacing;
  const int count = std::max(2, static_cast<int>(std::lround(side / spacing)));
  const double step = side / count;
  const Vec3 corner = labels.origin - Vec3::Constant(labels.spacing / 2);
  VoxelGrid<std::int32_t> result({count, count, count}, corner + Vec3::Constant(step / 2), step);
  const auto nearest = [&](int i) {
    return std::min(labels.size[0] - 1, static_cast<int>((i + 0.5) * step / labels.spacing));
  };
  for (int k = 0; k < count; ++k) {
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < count; ++i) {
        result.at(i, j, k) = labels.at(nearest(i), nearest(j), nearest(k));
      }
    }
  }
  return result;
}

Segmentation segment(const VoxelGrid<float>& field, SegmentationOptions options, Context& context) {
  const auto stage = context.timer.stage("segmentation");
  options.threads = context.threads;
  try {
    return caged_sdf_segmentation(field, options);
  } catch (const InputError& error) {
    throw MethodFailure(
        fmt::format("deepfracture: the predicted field cannot be segmented: {}", error.what()));
  }
}

/// The whole body, where nothing is cut.
std::vector<Piece> whole(const TriangleMesh& mesh) {
  Piece piece{.mesh = mesh, .faces = {}, .next = nullptr};
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    piece.faces.push_back({.parent_face = static_cast<std::int32_t>(f)});
  }
  return {std::move(piece)};
}

/// Without the pieces for which `lost` is not 0.
std::vector<Piece> without(std::vector<Piece> pieces, const std::vector<std::uint8_t>& lost) {
  std::vector<std::int32_t> place(pieces.size(), -1);
  std::vector<Piece> kept;
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    if (lost[n]) continue;
    place[n] = static_cast<std::int32_t>(kept.size());
    kept.push_back(std::move(pieces[n]));
  }
  for (Piece& piece : kept) {
    for (PieceFace& face : piece.faces) {
      if (face.neighbour >= 0) face.neighbour = place[face.neighbour];
    }
  }
  return kept;
}

/// What belongs to no label becomes pieces of its own, which are lost, like components of few
/// faces.
std::vector<Piece> cut_with_losses(const TriangleMesh& body, Segmentation segments,
                                   int minimum_faces, Context& context) {
  const std::int32_t dams = segments.count + 1;
  for (std::int32_t& label : segments.labels.values) {
    if (label == 0) label = dams;
  }
  Partition partition =
      partition_by_labels(body, segments.labels, {.minimum_voxels = 0, .threads = context.threads});
  std::vector<std::uint8_t> lost;
  int small = 0;
  for (std::size_t n = 0; n < partition.pieces.size(); ++n) {
    const bool dam = partition.report.piece_label[n] == dams;
    const bool few = static_cast<int>(partition.pieces[n].mesh.faces.size()) < minimum_faces;
    small += few && !dam;
    lost.push_back(dam || few);
  }
  std::vector<Piece> pieces = without(std::move(partition.pieces), lost);
  context.note(fmt::format("deepfracture: dams and {} components of less than {} faces are lost",
                           small, minimum_faces));
  if (pieces.empty())
    throw MethodFailure("deepfracture: all fragments have too few faces: none is left");
  return pieces;
}

void require_full(const TriangleMesh& body, const std::vector<Piece>& pieces) {
  constexpr double kTolerance = 1e-9;  // of the volume: what MethodInfo promises by default
  Sum sum;
  for (const Piece& piece : pieces) sum += volume(piece.mesh);
  const double ratio = sum.value() / volume(body);
  if (!(std::abs(ratio - 1) <= kTolerance)) {
    throw MethodFailure(
        fmt::format("deepfracture: the pieces have {} times the volume of the body", ratio));
  }
}

}  // namespace

int minimum_faces(int resolution) { return resolution <= 64 ? 50 : resolution <= 128 ? 200 : 400; }

std::vector<Piece> reconstruct(const TriangleMesh& body, const VoxelGrid<float>& field,
                               const ReconstructOptions& options, Context& context) {
  Segmentation segments = segment(field, options.segmentation, context);
  context.stop_if_asked();
  const bool parity = options.segmentation.parity;
  context.note(fmt::format(
      "deepfracture: {} labels, cage {:.3g} m, {:.1f} % of the voxels in dams, {} small labels {}",
      segments.count, segments.cage,
      100.0 * static_cast<double>(segments.dam_voxels) / static_cast<double>(segments.mask_voxels),
      segments.dropped_labels, parity ? "lost" : "given to neighbours"));

  if (segments.count > options.most_fragments) {
    throw MethodFailure(fmt::format(
        "deepfracture: the predicted field falls into {} fragments, more than most_fragments = {}: "
        "the network has not learned these fractures; train it for more epochs, or raise 'h'",
        segments.count, options.most_fragments));
  }
  const auto stage = context.timer.stage("boolean");
  if (parity) {
    const int least =
        options.minimum_faces > 0 ? options.minimum_faces : minimum_faces(field.size[0]);
    return cut_with_losses(body, std::move(segments), least, context);
  }
  if (segments.count < 2) return whole(body);
  const double edge = mean_edge(body);
  if (options.as_coarse_as_surface && edge > field.spacing) {
    segments.labels = resampled(segments.labels, edge);
  }
  std::vector<Piece> pieces =
      partition_by_labels(body, segments.labels, {.threads = context.threads}).pieces;
  require_full(body, pieces);
  return pieces;
}

}  // namespace fracbench::deepfracture

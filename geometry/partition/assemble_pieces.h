#pragma once

#include "geometry/partition/arrangement.h"
#include "geometry/partition_by_labels.h"

namespace fracbench::partition {

/// The connected solids of an arrangement as pieces, those below `minimum_volume` (m^3) merged into
/// the neighbour with the largest shared area. `labels`: the label of each region but the void.
/// Fills the parts of the report that are about pieces.
Partition assemble_pieces(const Arrangement& arrangement, const std::vector<std::int32_t>& labels,
                          double minimum_volume, int threads);

/// Sets split_labels and labels_without_piece from piece_label.
void report_labels(const std::vector<std::int32_t>& labels, PartitionReport& report);

}  // namespace fracbench::partition

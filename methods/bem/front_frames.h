#pragma once

#include <vector>

#include "methods/bem/crack_sheet.h"

namespace fracbench::bem {

/// The frame at every vertex of the sheet's boundary, parallel to `sheet.boundary`. The normal is
/// the mean of the adjacent triangles' normals, weighted by their angles at the vertex and made
/// orthogonal to the front; the tangent is that of the circle through the vertex and its two
/// neighbours on the boundary. Where the front ends (one neighbour advances, the vertex itself and
/// its other neighbour do not), the tangent follows the segment on the front's side, so that the
/// corner between front and mouth does not turn it.
///
/// Throws InputError where the boundary has less than three vertices, names a vertex that is not
/// there or has another length than `states`. A vertex without a plane (its triangles have no
/// extent, fold back on each other or stand across the front) takes the frame of the nearest one
/// along the boundary that has one; MethodFailure where none has.
std::vector<FrontFrame> front_frames(const CrackSheet& sheet);

/// Area of the sheet, m^2, one side.
double sheet_area(const CrackSheet& sheet);

}  // namespace fracbench::bem

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "core/vec3.h"

// The bytes of a file, per format.
namespace fracbench::formats {

/// How a part moves: a pose of its mesh at each of some times. Before the first and after the last,
/// where others move still, it is not seen.
struct Motion {
  std::vector<float> seconds = {};  ///< ascending
  std::vector<Pose> poses = {};     ///< parallel to it
};

/// A mesh with a name; where `fracture` is given, it tells for each face whether it is fracture
/// surface (not 0).
struct Part {
  std::string name;
  const TriangleMesh* mesh = nullptr;
  std::vector<std::uint8_t> fracture = {};
  /// A column of numbers per face, for formats that hold them.
  struct FaceProperty {
    std::string name;
    std::vector<std::int32_t> values;
  };
  std::vector<FaceProperty> face_properties = {};
  Motion motion = {};  ///< for formats that hold it; empty: it rests
};

/// A group per part; the shortest decimals that give the same bits when read.
std::string obj_bytes(std::span<const Part> parts);

/// One mesh, binary, little endian, 64-bit floats, with the face properties, which must be the same
/// in all parts.
std::string ply_bytes(std::span<const Part> parts);

/// One mesh, binary.
std::string stl_bytes(std::span<const Part> parts);

/// glTF 2.0 binary: a node with a colour per part; the fracture surface of each part is a primitive
/// of its own with flat normals and a common material, the rest has smooth normals but for creases.
/// Motions are one animation of translation, rotation and scale (0: not seen).
/// Throws InputError where the file would be larger than the format allows (4 GiB).
std::string glb_bytes(std::span<const Part> parts);

}  // namespace fracbench::formats

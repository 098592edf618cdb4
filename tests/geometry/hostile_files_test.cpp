#include <fstream>

#include "core/error.h"
#include "core/random.h"
#include "geometry/check_mesh.h"
#include "geometry/read_mesh.h"
#include "geometry/write_mesh.h"
#include "tests/geometry/temporary_folder.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;

/// Whatever the bytes are: a mesh whose values are all good, or an InputError.
class HostileFiles : public TemporaryFolder {
 protected:
  void try_to_read(const std::string& name, const std::string& bytes) {
    try {
      const TriangleMesh mesh = mesh_from_bytes(bytes, name);
      EXPECT_FALSE(mesh.empty());
      EXPECT_TRUE(check_mesh(mesh, {.self_intersections = false}).finite);
      ++read_;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
      ++refused_;
    }
  }

  /// A small file of every format: name and bytes.
  std::vector<std::pair<std::string, std::string>> files() {
    const TriangleMesh mesh = torus(6, 4);
    std::vector<std::pair<std::string, std::string>> result;
    for (const char* name : {"a.obj", "a.ply", "a.stl"}) {
      write_mesh(folder_ / name, mesh);
      result.emplace_back(name, content(folder_ / name));
    }
    std::string off = "OFF\n" + std::to_string(mesh.vertices.size()) + " " +
                      std::to_string(mesh.faces.size()) + " 0\n";
    std::string ply =
        "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
        "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
        std::to_string(mesh.faces.size()) + "\nproperty list uchar int vertex_index\nend_header\n";
    std::string rows, stl = "solid a\n";
    for (const Vec3& v : mesh.vertices) {
      for (int i = 0; i < 3; ++i) {
        rows += std::to_string(v[i]);
        rows += i < 2 ? ' ' : '\n';
      }
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      rows += '3';
      stl += "facet normal 0 0 1\nouter loop\n";
      for (int k = 0; k < 3; ++k) {
        rows += ' ';
        rows += std::to_string(mesh.faces[f][k]);
        const Vec3& v = mesh.corner(f, k);
        stl += "vertex " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " +
               std::to_string(v.z()) + "\n";
      }
      rows += "\n";
      stl += "endloop\nendfacet\n";
    }
    result.emplace_back("b.off", off + rows);
    result.emplace_back("b.ply", ply + rows);
    result.emplace_back("b.stl", stl + "endsolid a\n");
    return result;
  }

  int read_ = 0, refused_ = 0;
};

TEST_F(HostileFiles, WholeOnesAreRead) {
  for (const auto& [name, bytes] : files()) try_to_read(name, bytes);
  EXPECT_EQ(read_, 6);
}

TEST_F(HostileFiles, CutShortAnywhereAreRefusedOrStillAMesh) {
  for (const auto& [name, bytes] : files()) {
    const std::size_t step = std::max<std::size_t>(1, bytes.size() / 150);
    for (std::size_t size = 0; size < bytes.size(); size += step) {
      try_to_read(name, bytes.substr(0, size));
    }
  }
  EXPECT_GT(refused_, 600);
}

TEST_F(HostileFiles, WithWrongBytesAreRefusedOrStillAMesh) {
  Random random(4);
  for (const auto& [name, bytes] : files()) {
    for (int i = 0; i < 200; ++i) {
      std::string bad = bytes;
      const std::uint64_t count = 1 + random.below(8);
      // Half of them near the beginning, where the counts are.
      for (std::uint64_t n = 0; n < count; ++n) {
        const std::size_t range = i % 2 ? bad.size() : std::min<std::size_t>(bad.size(), 300);
        bad[random.below(range)] = static_cast<char>(random.below(256));
      }
      try_to_read(name, bad);
    }
  }
  EXPECT_GT(refused_, 200);
}

TEST_F(HostileFiles, WithDigitsChangedAreRefusedOrStillAMesh) {
  Random random(5);
  for (const auto& [name, bytes] : files()) {
    for (int i = 0; i < 200; ++i) {
      std::string bad = bytes;
      const std::uint64_t count = 1 + random.below(4);
      for (std::uint64_t n = 0; n < count; ++n) {
        std::size_t at = random.below(bad.size());
        while (at < bad.size() && (bad[at] < '0' || bad[at] > '9')) ++at;
        static const std::string replacements = "0123456789-.eE+/ \n#x";
        if (at < bad.size()) bad[at] = replacements[random.below(replacements.size())];
      }
      try_to_read(name, bad);
    }
  }
}

TEST_F(HostileFiles, OfGarbageAreRefused) {
  Random random(6);
  for (const char* extension : {"obj", "ply", "stl", "off", "glb", ""}) {
    for (int i = 0; i < 40; ++i) {
      std::string garbage(random.below(3000), '\0');
      for (char& c : garbage) c = static_cast<char>(random.below(256));
      try_to_read(std::string("garbage.") + extension, garbage);
    }
  }
  EXPECT_EQ(read_, 0);
}

TEST_F(HostileFiles, OfAnotherFormatThanTheirNameSaysAreRefusedOrRead) {
  for (const auto& [name, bytes] : files()) {
    for (const char* other : {"x.obj", "x.ply", "x.stl", "x.off", "x"}) try_to_read(other, bytes);
  }
}

}  // namespace
}  // namespace fracbench

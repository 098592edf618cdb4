#include "geometry/write_mesh.h"

#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "geometry/measures.h"
#include "geometry/palette.h"
#include "geometry/read_mesh.h"
#include "tests/geometry/temporary_folder.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;
using testing::HasSubstr;
using Json = nlohmann::json;

class WriteMesh : public TemporaryFolder {};

TEST_F(WriteMesh, AsObjAndPlyGivesTheSameBitsBack) {
  for (const auto& [name, mesh] : solids()) {
    for (const char* file : {"a.obj", "a.ply", "B.PLY"}) {
      write_mesh(folder_ / file, mesh);
      const TriangleMesh back = read_mesh(folder_ / file);
      EXPECT_EQ(back.vertices, mesh.vertices) << name << " " << file;
      EXPECT_EQ(back.faces, mesh.faces) << name << " " << file;
    }
  }
}

TEST_F(WriteMesh, AsStlGivesTheFacesBackInSinglePrecision) {
  const TriangleMesh mesh = sphere(12, 16);
  write_mesh(folder_ / "a.stl", mesh);
  const TriangleMesh back = read_mesh(folder_ / "a.stl");
  EXPECT_EQ(back.vertices.size(), mesh.vertices.size());
  ASSERT_EQ(back.faces.size(), mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(back.corner(f, k).cast<float>(), mesh.corner(f, k).cast<float>());
    }
  }
}

TEST_F(WriteMesh, RefusesUnknownFormatsAndFoldersThatAreNotThere) {
  EXPECT_THROW(write_mesh(folder_ / "a.xyz", cube()), InputError);
  EXPECT_THROW(write_mesh(folder_ / "a", cube()), InputError);
  try {
    write_mesh(folder_ / "none" / "a.obj", cube());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("No such file or directory"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

/// Two halves of a box, cut at x = 0.
Fragments halves() {
  Fragments fragments;
  for (const double sign : {-1.0, 1.0}) {
    Fragment half;
    half.mesh =
        sign < 0 ? box(Vec3(-1, -1, -1), Vec3(0, 1, 1)) : box(Vec3(0, -1, -1), Vec3(1, 1, 1));
    for (std::size_t f = 0; f < half.mesh.faces.size(); ++f) {
      bool cut = true;
      for (int k = 0; k < 3; ++k) cut = cut && half.mesh.corner(f, k).x() == 0;
      half.faces.push_back(cut ? FragmentFace{-1, 3} : FragmentFace{static_cast<int>(f), -1});
    }
    fragments.push_back(std::move(half));
  }
  return fragments;
}

TEST_F(WriteMesh, OfFragmentsAsObjHasAGroupForEach) {
  write_fragments(folder_ / "a.obj", halves());
  const std::string text = content(folder_ / "a.obj");
  EXPECT_THAT(text, HasSubstr("g fragment_000\n"));
  EXPECT_THAT(text, HasSubstr("g fragment_001\n"));
  const TriangleMesh back = read_mesh(folder_ / "a.obj");
  EXPECT_EQ(back.faces.size(), 24u);
  EXPECT_EQ(volume(back), 8);
}

TEST_F(WriteMesh, OfFragmentsAsPlyTellsWhereFacesComeFrom) {
  write_fragments(folder_ / "a.ply", halves());
  const std::string bytes = content(folder_ / "a.ply");
  EXPECT_THAT(bytes, HasSubstr("property int part\nproperty int original_face\nproperty int "
                               "interface\nend_header\n"));
  EXPECT_EQ(volume(read_mesh(folder_ / "a.ply")), 8);
  // The last face of the second half is on its far side, not on the cut.
  std::int32_t last[3];
  std::memcpy(last, bytes.data() + bytes.size() - 12, 12);
  EXPECT_THAT(last, testing::ElementsAre(1, 11, -1));
}

/// Takes a GLB file apart and checks what the specification demands of it.
struct Glb {
  Json json;
  std::string data;

  explicit Glb(const std::string& bytes) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data() + at, 4);
      return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2u);
    EXPECT_EQ(word(8), bytes.size());
    const std::uint32_t size = word(12);
    EXPECT_EQ(size % 4, 0u);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    json = Json::parse(bytes.substr(20, size));
    EXPECT_EQ(word(20 + size), bytes.size() - 28 - size);
    EXPECT_EQ(bytes.substr(24 + size, 4), std::string("BIN\0", 4));
    data = bytes.substr(28 + size);
    EXPECT_EQ(json["buffers"][0]["byteLength"], data.size());
    EXPECT_EQ(data.size() % 4, 0u);
  }

  template <typename T>
  std::vector<T> values(int accessor_index) const {
    const Json& accessor = json["accessors"][accessor_index];
    const Json& view = json["bufferViews"][accessor["bufferView"].get<int>()];
    const std::size_t components = accessor["type"] == "VEC3" ? 3 : 1;
    const std::size_t count = components * accessor["count"].get<std::size_t>();
    const std::size_t offset = view["byteOffset"];
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_EQ(view["byteLength"], count * sizeof(T));
    EXPECT_LE(offset + count * sizeof(T), data.size());
    std::vector<T> result(count);
    std::memcpy(result.data(), data.data() + offset, count * sizeof(T));
    return result;
  }
};

TEST_F(WriteMesh, OfFragmentsAsGlbHasANodeForEachAndFractureSurfaceApart) {
  write_fragments(folder_ / "a.glb", halves());
  const Glb glb(content(folder_ / "a.glb"));
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  ASSERT_EQ(glb.json["nodes"].size(), 2u);
  EXPECT_EQ(glb.json["scenes"][0]["nodes"], Json({0, 1}));
  ASSERT_EQ(glb.json["materials"].size(), 3u);
  for (int node = 0; node < 2; ++node) {
    const Json& mesh = glb.json["meshes"][glb.json["nodes"][node]["mesh"].get<int>()];
    ASSERT_EQ(mesh["primitives"].size(), 2u);
    EXPECT_EQ(mesh["primitives"][1]["material"], 1);  // the same for both
    const auto triangles = [&](int primitive) {
      return glb.values<std::uint32_t>(mesh["primitives"][primitive]["indices"]).size() / 3;
    };
    EXPECT_EQ(triangles(0), 10u);
    EXPECT_EQ(triangles(1), 2u);
  }
  EXPECT_NE(glb.json["meshes"][0]["primitives"][0]["material"],
            glb.json["meshes"][1]["primitives"][0]["material"]);
}

TEST_F(WriteMesh, AsGlbKeepsPlacesNormalsAndBounds) {
  for (const auto& [name, mesh] : solids()) {
    SCOPED_TRACE(name);
    write_mesh(folder_ / "a.glb", mesh);
    const Glb glb(content(folder_ / "a.glb"));
    const Json& primitive = glb.json["meshes"][0]["primitives"][0];
    const Json& accessor = glb.json["accessors"][primitive["attributes"]["POSITION"].get<int>()];
    const auto positions = glb.values<float>(primitive["attributes"]["POSITION"]);
    const auto normals = glb.values<float>(primitive["attributes"]["NORMAL"]);
    const auto indices = glb.values<std::uint32_t>(primitive["indices"]);
    ASSERT_EQ(indices.size(), 3 * mesh.faces.size());
    ASSERT_EQ(positions.size(), normals.size());
    Eigen::Array3f low = Eigen::Array3f::Constant(1e30f), high = -low;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      ASSERT_LT(3 * indices[i], positions.size());
      const Eigen::Vector3f p(positions[3 * indices[i]], positions[3 * indices[i] + 1],
                              positions[3 * indices[i] + 2]);
      const Eigen::Vector3f n(normals[3 * indices[i]], normals[3 * indices[i] + 1],
                              normals[3 * indices[i] + 2]);
      EXPECT_EQ(p, mesh.corner(i / 3, i % 3).cast<float>());
      EXPECT_NEAR(n.norm(), 1, 1e-6);
      EXPECT_GT(n.dot(area_vector2(mesh, i / 3).normalized().cast<float>()), 0.5);
      low = low.min(p.array());
      high = high.max(p.array());
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(accessor["min"][i].get<float>(), low[i]);
      EXPECT_EQ(accessor["max"][i].get<float>(), high[i]);
    }
  }
}

TEST_F(WriteMesh, AsGlbIsSmoothOnASphereAndSharpOnACube) {
  const auto vertices = [&](const TriangleMesh& mesh) {
    write_mesh(folder_ / "a.glb", mesh);
    const Glb glb(content(folder_ / "a.glb"));
    const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
    return glb.values<float>(attributes["POSITION"]).size() / 3;
  };
  const TriangleMesh ball = sphere(24, 32);
  EXPECT_EQ(vertices(ball), ball.vertices.size());
  EXPECT_EQ(vertices(cube()), 24u);
}

TEST_F(WriteMesh, IsTheSameBytesEveryTime) {
  for (const char* name : {"a.obj", "a.ply", "a.stl", "a.glb"}) {
    write_fragments(folder_ / name, halves());
    const std::string first = content(folder_ / name);
    write_fragments(folder_ / name, halves());
    EXPECT_EQ(content(folder_ / name), first) << name;
  }
}

TEST_F(WriteMesh, TakesFragmentsWithoutFaces) {
  Fragments fragments(2);
  fragments[1].mesh = cube();
  for (const char* name : {"a.obj", "a.ply", "a.stl", "a.glb"}) {
    EXPECT_NO_THROW(write_fragments(folder_ / name, fragments)) << name;
    EXPECT_NO_THROW(write_fragments(folder_ / name, {})) << name;
  }
}

TEST(Palette, GivesColoursThatDiffer) {
  for (std::size_t i = 0; i < 28; ++i) {
    EXPECT_TRUE((fragment_color(i).array() >= 0).all() && (fragment_color(i).array() <= 1).all());
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT((fragment_color(i) - fragment_color(j)).norm(), 0.1) << i << " " << j;
    }
  }
  EXPECT_NEAR(linear_color(Vec3(0, 0.5, 1)).y(), 0.21404, 1e-5);
}

}  // namespace
}  // namespace fracbench

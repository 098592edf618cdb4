#include "geometry/read_mesh.h"

#include <gmock/gmock.h>

#include <bit>
#include <cstring>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "tests/geometry/temporary_folder.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class ReadMesh : public TemporaryFolder {
 protected:
  TriangleMesh read(const std::string& name, std::string_view bytes) const {
    return read_mesh(save(name, bytes));
  }
  /// The message that a file gives.
  std::string error(const std::string& name, std::string_view bytes) const {
    const auto file = save(name, bytes);
    try {
      read_mesh(file);
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(file.string()));
      return e.what();
    }
    return "no error";
  }
};

/// Values as the bytes of a binary file, the other way round where `swap` is set.
class Bytes {
 public:
  explicit Bytes(bool swap = false) : swap_(swap) {}
  template <typename T>
  Bytes& operator<<(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (swap_) std::reverse(raw, raw + sizeof(T));
    text.append(raw, sizeof(T));
    return *this;
  }
  std::string text;

 private:
  bool swap_;
};

const std::string tetrahedron_obj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

void expect_tetrahedron(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.vertices, tetrahedron().vertices);
  EXPECT_EQ(mesh.faces, tetrahedron().faces);
}

TEST_F(ReadMesh, TakesPlainObj) { expect_tetrahedron(read("a.obj", tetrahedron_obj)); }

TEST_F(ReadMesh, TakesObjWithEverythingThatIsPassedOver) {
  expect_tetrahedron(read("A.OBJ",
                          "# comment\r\nmtllib a.mtl\r\no thing\r\n\r\nv 0 0 0 1.0\r\n"
                          "v +1 0e5 0.0 0.5 0.5 0.5\r\nvt 0 0\r\nvn 0 0 1\r\nv 0 1 0 # here\r\n"
                          "\tv  0\t0 1  \r\ng a b\r\ns off\r\nusemtl m\r\nf 1/1/1 3/1 2//1\r\n"
                          "f -4 -3 \\\r\n -1\r\nf 1 4 3\r\nl 1 2\r\np 1\r\nf 2// 3// 4//"));
}

TEST_F(ReadMesh, TakesObjThatEndsItsLinesWithCarriageReturns) {
  std::string text = tetrahedron_obj;
  std::replace(text.begin(), text.end(), '\n', '\r');
  expect_tetrahedron(read("a.obj", text));
}

TEST_F(ReadMesh, TakesObjWhoseFacesComeBeforeTheirVertices) {
  const std::size_t split = tetrahedron_obj.find('f');
  expect_tetrahedron(
      read("a.obj", tetrahedron_obj.substr(split) + tetrahedron_obj.substr(0, split)));
}

TEST_F(ReadMesh, KeepsEveryBitOfTheCoordinates) {
  const TriangleMesh mesh = read("a.obj",
                                 "v 0.1 -0.30000000000000004 1e-310\nv 1.7976931348623157e308 "
                                 "-0 123456789.123456789\nv 4.9e-324 1e-400 3\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertices[0], Vec3(0.1, -0.30000000000000004, 1e-310));
  EXPECT_EQ(mesh.vertices[1], Vec3(1.7976931348623157e308, 0, 123456789.123456789));
  EXPECT_TRUE(std::signbit(mesh.vertices[1].y()));
  EXPECT_EQ(mesh.vertices[2], Vec3(4.9e-324, 0, 3));
}

TEST_F(ReadMesh, TakesOffInAllItsForms) {
  const std::string data = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  expect_tetrahedron(read("a.off", "OFF\n4 4 6\n" + data));
  expect_tetrahedron(read("a.off", "OFF 4 4 0\n" + data));
  expect_tetrahedron(read("a.off", "4 4 0\n" + data));
  expect_tetrahedron(read("a.off", "# made\nOFF # by\n\n#hand\n4 4\n" + data));
  expect_tetrahedron(read("thing", "OFF\n4 4 6\n" + data));
  expect_tetrahedron(read("a.off",
                          "COFF\r\n4 4 0\r\n0 0 0 255 0 0 255\r\n1 0 0 255 0 0 255\r\n"
                          "0 1 0 1 1 1 1\r\n0 0 1 1 1 1 1\r\n3 0 2 1 0.5 0.5 0.5\r\n3 0 1 3\r\n"
                          "3 0 3 2 7\r\n3 1 2 3\r\n"));
}

std::string text_stl(const TriangleMesh& mesh) {
  std::string text = "solid thing with a name\n";
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (int k = 0; k < 3; ++k) {
      const Vec3& v = mesh.corner(f, k);
      text += "   vertex " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " +
              std::to_string(v.z()) + "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid thing\n";
}

std::string binary_stl(const TriangleMesh& mesh, std::string header) {
  header.resize(80, ' ');
  Bytes bytes;
  bytes.text = header;
  bytes << static_cast<std::uint32_t>(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    bytes << 0.f << 0.f << 0.f;
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) bytes << static_cast<float>(mesh.corner(f, k)[i]);
    }
    bytes << std::uint16_t{0};
  }
  return bytes.text;
}

TEST_F(ReadMesh, WeldsTheVerticesOfStl) {
  for (const std::string& bytes :
       {text_stl(cube()), binary_stl(cube(), "made by"), binary_stl(cube(), "solid as text")}) {
    const TriangleMesh mesh = read("a.stl", bytes);
    EXPECT_EQ(mesh.vertices.size(), 8u);
    EXPECT_TRUE(check_mesh(mesh).is_solid());
    EXPECT_EQ(volume(mesh), 8);
    for (std::size_t f = 0; f < 12; ++f) EXPECT_EQ(mesh.corner(f, 1), cube().corner(f, 1));
  }
}

TEST_F(ReadMesh, KnowsStlWithoutItsExtension) {
  EXPECT_EQ(read("thing", binary_stl(cube(), "x")).faces.size(), 12u);
  EXPECT_EQ(read("thing", text_stl(cube())).faces.size(), 12u);
}

TEST_F(ReadMesh, TakesTextStlInCapitals) {
  std::string text = text_stl(tetrahedron());
  std::transform(text.begin(), text.end(), text.begin(), [](char c) { return std::toupper(c); });
  EXPECT_EQ(volume(read("a.stl", text)), 1.0 / 6);
}

TEST_F(ReadMesh, WeldsZeroAndMinusZeroOfStl) {
  std::string text = text_stl(tetrahedron());
  text.replace(text.find("vertex 0.0"), 10, "vertex -0.0");
  EXPECT_EQ(read("a.stl", text).vertices.size(), 4u);
}

const std::string ply_properties =
    "comment a comment\nobj_info more\n"
    "element camera 1\nproperty float fov\nproperty list uchar double pose\n"
    "element vertex 4\nproperty uchar red\nproperty double x\nproperty float y\n"
    "property list ushort short tags\nproperty int16 z\n"
    "element face 4\nproperty list uint8 int texture\nproperty list int uint vertex_indices\n"
    "property char flag\nelement rest 2\nproperty uint a\nend_header\n";

TEST_F(ReadMesh, TakesBinaryPlyOfBothByteOrders) {
  for (const bool swap : {false, true}) {
    Bytes b(swap);
    b.text = std::string("ply\nformat binary_") + (swap ? "big" : "little") + "_endian 1.0\n" +
             ply_properties;
    b << 1.5f << std::uint8_t{2} << 1.0 << 2.0;
    for (const Vec3& v : tetrahedron().vertices) {
      b << std::uint8_t{9} << v.x() << static_cast<float>(v.y()) << std::uint16_t{1}
        << std::int16_t{-5} << static_cast<std::int16_t>(v.z());
    }
    for (const Face& f : tetrahedron().faces) {
      b << std::uint8_t{1} << std::int32_t{77} << std::int32_t{3};
      for (const std::int32_t v : f) b << static_cast<std::uint32_t>(v);
      b << std::int8_t{-1};
    }
    b << std::uint32_t{1} << std::uint32_t{2};
    expect_tetrahedron(read("a.ply", b.text));
    expect_tetrahedron(read("no_extension", b.text));
  }
}

TEST_F(ReadMesh, TakesTextPly) {
  expect_tetrahedron(read("a.ply", "ply\nformat ascii 1.0\n" + ply_properties +
                                       "1.5 2 1 2\n9 0 0 1 -5 0\n9 1 0 1 -5 0\n9 0 1 0 0\n\n"
                                       "9 0 0 2 3 4 1\n1 77 3 0 2 1 -1\n0 3 0 1 3 -1\n"
                                       "0 3 0 3 2 -1\n0 3 1 2 3 -1\n1\n2"));
  expect_tetrahedron(read("a.ply",
                          "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float32 x\r\n"
                          "property float32 y\r\nproperty float32 z\r\nproperty float quality\r\n"
                          "element face 4\r\nproperty list uchar int vertex_index\r\n"
                          "end_header\r\n0 0 0 nan\r\n1 0 0 1\r\n0 1 0 1\r\n0 0 1 1\r\n"
                          "3 0 2 1\r\n3 0 1 3\r\n3 0 3 2\r\n3 1 2 3\r\n"));
}

TEST_F(ReadMesh, TriangulatesPolygons) {
  // A prism over an L, its two ends as polygons with six corners, its sides as quadrilaterals.
  std::string text;
  for (const char* z : {" 0\n", " 3\n"}) {
    for (const char* xy : {"v 0 0", "v 2 0", "v 2 1", "v 1 1", "v 1 2", "v 0 2"}) {
      text += std::string(xy) + z;
    }
  }
  text += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
  for (int i = 1; i <= 6; ++i) {
    const int j = i % 6 + 1;
    for (const int v : {i, j, j + 6, i + 6}) text += (v == i ? "f " : " ") + std::to_string(v);
    text += "\n";
  }
  const TriangleMesh mesh = read("l.obj", text);
  EXPECT_EQ(mesh.faces.size(), 4u + 4u + 12u);
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.is_solid()) << report.describe();
  EXPECT_FALSE(report.degenerate_faces);
  EXPECT_DOUBLE_EQ(report.volume, 9);
}

TEST_F(ReadMesh, SaysWhatIsWrongWithAFileThatCannotBeRead) {
  EXPECT_THAT(error("empty.obj", ""), HasSubstr("the file is empty"));
  EXPECT_THAT(error("a.xyz", "hello"), HasSubstr("known are OBJ, STL, PLY and OFF"));
  EXPECT_THAT(error("a.obj", "v 0 0 0\n"), HasSubstr("it holds no faces"));
  for (const auto& [file, part] :
       {std::pair{folder_ / "none.obj", "No such file or directory; check the name"},
        std::pair{folder_, "it is a folder"}}) {
    try {
      read_mesh(file);
      FAIL();
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr(file.string()), HasSubstr(part)));
    }
  }
}

TEST_F(ReadMesh, NeedsPermission) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
  const auto file = save("a.obj", tetrahedron_obj);
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_THROW(read_mesh(file), InputError);
}

TEST_F(ReadMesh, NamesTheLineOfAMistakeInObj) {
  const auto message = [&](const std::string& line) {
    return error("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + line + "\nf 1 2 3\n");
  };
  EXPECT_THAT(message("f 1 2 9"),
              HasSubstr("line 4: vertex 9 is out of range: the file has 3 vertices"));
  EXPECT_THAT(message("f 1 2 -4"), HasSubstr("line 4: vertex -4 is out of range"));
  EXPECT_THAT(message("f 0 1 2"), HasSubstr("line 4: a corner is '0'"));
  EXPECT_THAT(message("f 1 2"), HasSubstr("line 4: a face has 2 corners"));
  EXPECT_THAT(message("f 1 2 x"), HasSubstr("line 4: a corner is 'x'"));
  EXPECT_THAT(message("f 1 2 99999999999999999999"), HasSubstr("line 4"));
  EXPECT_THAT(message("f 1 2 4294967297"), HasSubstr("line 4"));
  EXPECT_THAT(message("v 1 2"), HasSubstr("line 4: z is missing"));
  EXPECT_THAT(message("v 1 nan 2"), HasSubstr("line 4: y is 'nan', not finite"));
  EXPECT_THAT(message("v 1 2 -inf"), HasSubstr("line 4: z is '-inf', not finite"));
  EXPECT_THAT(message("v 1e999 1 2"), HasSubstr("line 4: x is '1e999', not finite"));
  EXPECT_THAT(message("v 1,5 1 2"), HasSubstr("line 4: x is '1,5', which is not a number"));
  EXPECT_THAT(message("\x01\x02"), HasSubstr("line 4: this is not text"));
}

TEST_F(ReadMesh, NamesTheLineOfAMistakeInOff) {
  EXPECT_THAT(error("a.off", "OFF\n-1 1 0\n"), HasSubstr("line 2: the number of vertices is -1"));
  EXPECT_THAT(error("a.off", "OFF\n3 2000000000 0\n0 0 0\n"), HasSubstr("more than the file"));
  EXPECT_THAT(error("a.off", "OFF\n9000000000000000000 1 0\n"), HasSubstr("more than the file"));
  EXPECT_THAT(error("a.off", "OFF BINARY\n"), HasSubstr("binary OFF"));
  EXPECT_THAT(error("a.off", "4OFF\n"), HasSubstr("not a mesh in three dimensions"));
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(error("a.off", vertices), HasSubstr("cut short: 0 of 1 faces"));
  EXPECT_THAT(error("a.off", vertices + "3 0 1 3\n"), HasSubstr("line 6: vertex 3 is out of"));
  EXPECT_THAT(error("a.off", vertices + "2 0 1\n"), HasSubstr("line 6: a face has 2 corners"));
  EXPECT_THAT(error("a.off", vertices + "3 0 1\n"), HasSubstr("line 6: a corner is missing"));
}

TEST_F(ReadMesh, NamesThePlaceOfAMistakeInPly) {
  const auto with = [](const std::string& vertices, const std::string& faces,
                       const std::string& data) {
    return "ply\nformat ascii 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n" + data;
  };
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(read("a.ply", with("3", "1", three + "3 0 1 2\n")).faces.size(), 1u);
  EXPECT_THAT(error("a.ply", with("-3", "1", three)), HasSubstr("line 3: the number of elements"));
  EXPECT_THAT(error("a.ply", with("3000000000", "1", three)), HasSubstr("cut short"));
  EXPECT_THAT(error("a.ply", with("x", "1", three)), HasSubstr("line 3"));
  EXPECT_THAT(error("a.ply", with("3", "1", three)), HasSubstr("0 of 1 elements 'face'"));
  EXPECT_THAT(error("a.ply", with("3", "1", three + "3 0 1 7\n")),
              HasSubstr("line 13: vertex 7 is out of range"));
  EXPECT_THAT(error("a.ply", with("3", "1", three + "3 0 1 -1\n")), HasSubstr("out of range"));
  EXPECT_THAT(error("a.ply", with("3", "1", three + "3 0 1 1.5\n")), HasSubstr("out of range"));
  EXPECT_THAT(error("a.ply", with("3", "1", three + "3 0 1\n")), HasSubstr("line 13"));
  EXPECT_THAT(error("a.ply", with("3", "1", "0 0 inf\n" + three)), HasSubstr("line 10: z is inf"));
  EXPECT_THAT(error("a.ply", "ply\nformat ascii 1.0\n"), HasSubstr("ends within its header"));
  EXPECT_THAT(error("a.ply", "solid"), HasSubstr("begins with 'ply'"));
  EXPECT_THAT(error("a.ply", "ply\nend_header\n"), HasSubstr("format"));
  EXPECT_THAT(error("a.ply", "ply\nformat ascii 1.0\nend_header\n"), HasSubstr("must be there"));
}

TEST_F(ReadMesh, ChecksCountsBeforeItAsksForMemory) {
  std::string stl = binary_stl(cube(), "x");
  stl.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_THAT(error("a.stl", stl), HasSubstr("announces 4294967295 triangles"));
  EXPECT_THAT(error("a.ply",
                    "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty "
                    "float x\nproperty float y\nproperty float z\nelement face 1\nproperty list "
                    "uchar int vertex_indices\nend_header\n"),
              HasSubstr("2000000000 elements 'vertex' take at least 12 bytes each, but 0 bytes"));
  EXPECT_THAT(error("a.ply",
                    "ply\nformat ascii 1.0\nelement nothing 9000000000000000000\nelement vertex "
                    "0\nproperty float x\nproperty float y\nproperty float z\nelement face "
                    "0\nproperty list uchar int vertex_indices\nend_header\n"),
              HasSubstr("it holds no faces"));
}

TEST_F(ReadMesh, ReadsTextBehindAByteOrderMark) {
  const TriangleMesh mesh = read("a.obj", "\xef\xbb\xbf" + tetrahedron_obj);
  EXPECT_EQ(mesh.vertices, read("b.obj", tetrahedron_obj).vertices);
  EXPECT_THAT(error("c.obj", "\xef\xbb\xbf"), HasSubstr("empty"));
}

TEST_F(ReadMesh, SaysThatStlIsCutShort) {
  const std::string binary = binary_stl(cube(), "x");
  EXPECT_THAT(error("a.stl", binary.substr(0, 300)), HasSubstr("cut short"));
  EXPECT_THAT(error("a.stl", binary.substr(0, 50)), HasSubstr("cut short"));
  const std::string text = text_stl(cube());
  EXPECT_THAT(error("a.stl", text.substr(0, text.find("  endloop"))), HasSubstr("cut short"));
  EXPECT_THAT(error("a.stl", text.substr(0, text.rfind("endsolid"))),
              HasSubstr("ends before 'endsolid'"));
  EXPECT_THAT(error("a.stl", "solid a\nfacet\nouter loop\nvertex 0 0 0\nendloop\nendfacet\n"),
              HasSubstr("line 6: a facet has 1 corners"));
}

TEST(ReadMeshOf, TheDevelopmentShapesGivesSolids) {
  bool any = false;
  for (const auto& [name, faces, volume_given] :
       {std::tuple{"squirrel.obj", 17596, 1.58142}, std::tuple{"base.obj", 20494, 0.68150},
        std::tuple{"bunny.obj", 15774, 0.0}, std::tuple{"mug.obj", 24640, 0.0},
        std::tuple{"pot_standin.obj", 1968, 0.0}, std::tuple{"spot.obj", 5856, 0.0},
        std::tuple{"letter_p.off", 52, 0.0}, std::tuple{"ball.obj", 1280, 0.0}}) {
    const auto file = shared_mesh(name);
    if (file.empty()) continue;
    any = true;
    const TriangleMesh mesh = read_mesh(file);
    const MeshReport report = check_mesh(mesh);
    EXPECT_EQ(report.faces, static_cast<std::size_t>(faces)) << name;
    EXPECT_TRUE(report.is_solid()) << name << ": " << report.describe();
    EXPECT_EQ(report.components, 1u) << name;
    if (volume_given > 0) {
      EXPECT_NEAR(report.volume, volume_given, 5e-6) << name;
    }
  }
  if (!any) GTEST_SKIP() << "the folder of development shapes is not beside the checkout";
}

}  // namespace
}  // namespace fracbench

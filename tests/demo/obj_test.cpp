#include "demo/scenes/obj.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "demo/input_error.h"
#include "engine/pleat.h"

namespace pleat::demo {
namespace {

TriangleMesh read(const std::string& text) {
  std::istringstream stream(text);
  return read_obj(stream, "mesh.obj");
}

/// What the reader says about a file that it must refuse.
std::string complaint(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
using Indices = std::vector<uint32_t>;

TEST(Obj, ReadsVerticesAndTriangles) {
  const TriangleMesh mesh = read("# comment\nmtllib x.mtl\no thing\n" + kThree + "g part\ns off\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions, (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(mesh.triangles, (Indices{0, 1, 2}));
  EXPECT_TRUE(mesh.uvs.empty());
}

TEST(Obj, ReadsEveryFormOfACorner) {
  const std::string head = kThree + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1", "f -3 -2 -1",
                           "f -3/-3/-1 -2/-2/-1 -1/-1/-1", "f  1\t2 3 \r"}) {
    EXPECT_EQ(read(head + face + "\n").triangles, (Indices{0, 1, 2})) << face;
  }
  EXPECT_EQ(read(head + "f 1/2 2/3 3/1\n").uvs, (std::vector<float>{1, 0, 0, 1, 0, 0}));
}

TEST(Obj, ByteOrderMarkAndNumbersTooSmallForAFloatAreNoMistakes) {
  const TriangleMesh mesh = read("\xEF\xBB\xBFv 0 0 1e-60\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions, (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
}

TEST(Obj, PolygonsBecomeFansAndGroupsOneMesh) {
  const TriangleMesh mesh = read(kThree + "v 1 1 0\nv 2 2 0\ng a\nf 1 2 4 3\ng b\nf 2 5 4\n");
  EXPECT_EQ(mesh.triangles, (Indices{0, 1, 3, 0, 3, 2, 1, 4, 3}));
}

TEST(Obj, NegativeIndicesCountFromTheLastVertexSoFar) {
  EXPECT_EQ(read(kThree + "f -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n").triangles, (Indices{0, 1, 2, 3, 2, 1}));
}

TEST(Obj, RefusesBadInputAndNamesTheLine) {
  const struct {
    std::string text, place, what;
  } cases[] = {
      {"", "mesh.obj: ", "no vertex"},
      {"# nothing\n", "mesh.obj: ", "no vertex"},
      {kThree, "mesh.obj: ", "no face"},
      {kThree + "f 1 2 4\n", "mesh.obj:4: ", "vertex 4"},
      {kThree + "f 0 1 2\n", "mesh.obj:4: ", "vertex 0"},
      {kThree + "f -4 1 2\n", "mesh.obj:4: ", "vertex -4"},
      {kThree + "f 1/1 2/2 3/3\n", "mesh.obj:4: ", "texture coordinate 1"},
      {kThree + "f 1 2\n", "mesh.obj:4: ", "2 corners"},
      {kThree + "f 1 2 x\n", "mesh.obj:4: ", "`x`"},
      {kThree + "f 1 2 3.5\n", "mesh.obj:4: ", "`3.5`"},
      {kThree + "f 1 2 /3\n", "mesh.obj:4: ", "`/3`"},
      {kThree + "f 1 2 99999999999999999999\n", "mesh.obj:4: ", "99999"},
      {"v 0 0 0\nv 1 nan 0\n", "mesh.obj:2: ", "nan"},
      {"v 0 0 0\nv 1 inf 0\n", "mesh.obj:2: ", "inf"},
      {"v 0 0 0\nv 1 1e99 0\n", "mesh.obj:2: ", "1e99"},
      {"v 0 0 0\nv 1 0x 0\n", "mesh.obj:2: ", "`0x`"},
      {"v 0 0 0\nv 1 0", "mesh.obj:2: ", "cut short"},
  };
  for (const auto& [text, place, what] : cases) {
    const std::string said = complaint(text);
    EXPECT_EQ(said.rfind(place, 0), 0u) << said;
    EXPECT_NE(said.find(what), std::string::npos) << said;
  }
}

TEST(Obj, RefusesMoreVerticesThanTheEngineTakes) {
  std::string text;
  for (uint32_t i = 0; i <= PLEAT_MAX_PARTICLES; ++i) text += "v 0 0 0\n";
  EXPECT_NE(complaint(text).find("vertices"), std::string::npos);
}

TEST(Obj, RefusesMoreTrianglesThanTheEngineTakes) {
  std::string text = kThree + "f";
  for (uint32_t i = 0; i < PLEAT_MAX_TRIANGLES + 3; ++i) text += " 1";
  EXPECT_NE(complaint(text).find("triangles"), std::string::npos);
}

TEST(Obj, AMissingFileIsNamed) {
  try {
    load_obj("no/such.obj");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "no/such.obj: cannot be opened");
  }
}

TEST(Obj, ReadsEveryRealFile) {
  const std::filesystem::path data = PLEAT_SHARED_DATA;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no real data at " << data;
  int read_files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    if (entry.path().extension() != ".obj") continue;
    const TriangleMesh mesh = load_obj(entry.path().string());
    EXPECT_GT(mesh.triangle_count(), 100u) << entry.path();
    for (const uint32_t index : mesh.triangles) ASSERT_LT(index, mesh.vertex_count()) << entry.path();
    ++read_files;
  }
  EXPECT_GE(read_files, 10);
  const TriangleMesh body = load_obj((data / "makehuman/body.obj").string());
  EXPECT_EQ(body.triangle_count(), 26756u);
  const TriangleMesh skirt = load_obj((data / "garments/diffcloth_skirt1252.obj").string());
  EXPECT_EQ(skirt.vertex_count(), 681u);
}

}  // namespace
}  // namespace pleat::demo

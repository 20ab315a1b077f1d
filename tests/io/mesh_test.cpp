#include "mamo/io/mesh.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <map>

#include "io/convex_hull.hpp"
#include "support/scratch_folder.hpp"

#include "mamo/common/random.hpp"

namespace mamo::io {
namespace {

using testing::HasSubstr;

const Eigen::Vector3d kOne(1, 1, 1);

/// The box [0,1] x [0,2] x [0,3] as an OBJ file.
const char* const kBoxObj =
    "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

using Triangle = std::array<std::array<float, 3>, 3>;
const std::vector<Triangle> kTetrahedron = {{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                                            {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                            {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                            {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

std::string binary_stl(const std::vector<Triangle>& triangles) {
  std::string bytes(80, ' ');
  const auto append = [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
  const auto count = static_cast<std::uint32_t>(triangles.size());
  append(&count, 4);
  for (const Triangle& t : triangles) {
    const float normal[3] = {0, 0, 1};
    append(normal, 12);
    append(&t, 36);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string ascii_stl(const std::vector<Triangle>& triangles) {
  std::string text = "solid t\n";
  for (const Triangle& t : triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto& v : t)
      text += "vertex " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

/// The same tetrahedron in a COLLADA file with a unit and an up axis.
std::string collada(const std::string& unit, const std::string& up) {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><asset>"
         "<unit name='u' meter='" +
         unit + "'/><up_axis>" + up +
         "</up_axis></asset><library_geometries><geometry id='g'><mesh>"
         "<source id='s'><float_array id='f' count='12'>0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common>"
         "<accessor source='#f' count='4' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
         "<param name='Z' type='float'/></accessor></technique_common></source><vertices id='v'><input "
         "semantic='POSITION' "
         "source='#s'/></vertices><triangles count='4'><input semantic='VERTEX' source='#v' offset='0'/>"
         "<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
         "<visual_scene id='vs'><node id='n'><translate>10 0 0</translate><instance_geometry "
         "url='#g'/></node></visual_scene>"
         "</library_visual_scenes><scene><instance_visual_scene url='#vs'/></scene></COLLADA>";
}

/// Every edge is used once in each direction, every vertex lies behind every face.
void expect_closed_and_convex(const ConvexHull& hull, double tolerance) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : hull.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.count({edge.second, edge.first}));
  }
  EXPECT_EQ(hull.triangles.size(), 2 * hull.vertices.size() - 4);  // Euler
  for (const auto& v : hull.vertices)
    EXPECT_LE(signed_distance(Mesh{std::make_shared<ConvexHull>(hull)}, v), tolerance);
}

std::vector<Eigen::Vector3d> random_ball(std::uint64_t seed, int count, const Eigen::Vector3d& radii) {
  RandomStream random(seed, {1});
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d d(random.normal(), random.normal(), random.normal());
    points.push_back(d.normalized().cwiseProduct(radii));
  }
  return points;
}

class MeshFile : public testing::Test {
 protected:
  Result<LoadedHull> load(const std::string& name, const std::string& bytes, const Eigen::Vector3d& scale = kOne) {
    path_ = folder_.write(name, bytes);
    return load_hull(path_, scale);
  }
  void expect_error(const std::string& name, const std::string& bytes, const std::string& what) {
    const auto hull = load(name, bytes);
    ASSERT_FALSE(hull.ok()) << name;
    EXPECT_THAT(hull.error().message, testing::StartsWith(path_ + ": "));
    EXPECT_THAT(hull.error().message, HasSubstr(what));
    EXPECT_THAT(hull.error().message, testing::Not(HasSubstr("\n")));
  }
  test::ScratchFolder folder_;
  std::string path_;
};

TEST_F(MeshFile, ABoxKeepsItsCornersVolumeAndCentroid) {
  const auto loaded = load("box.obj", kBoxObj);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const ConvexHull& hull = *loaded->hull;
  EXPECT_EQ(hull.vertices.size(), 8u);
  EXPECT_NEAR(hull.volume, 6, 1e-12);
  EXPECT_LT((hull.centroid - Eigen::Vector3d(0.5, 1, 1.5)).norm(), 1e-12);
  EXPECT_EQ(hull.source, path_);
  EXPECT_EQ(loaded->growth, 0);
  expect_closed_and_convex(hull, 1e-12);
}

TEST_F(MeshFile, ScaleIsAppliedAndMayMirror) {
  const auto loaded = load("box.obj", kBoxObj, {0.001, 0.002, -0.001});
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_NEAR(loaded->hull->volume, 6 * 2e-9, 1e-18);
  EXPECT_LT((loaded->hull->centroid - Eigen::Vector3d(0.0005, 0.002, -0.0015)).norm(), 1e-12);
  EXPECT_EQ(loaded->hull->scale.y(), 0.002);
  expect_closed_and_convex(*loaded->hull, 1e-12);
  EXPECT_FALSE(load("box.obj", kBoxObj, {1, 0, 1}).ok());
}

TEST_F(MeshFile, BinaryAndAsciiStlAgreeInAnyCaseOfTheExtension) {
  const auto binary = load("t.STL", binary_stl(kTetrahedron));
  const auto ascii = load("u.stl", ascii_stl(kTetrahedron));
  ASSERT_TRUE(binary.ok()) << binary.error().message;
  ASSERT_TRUE(ascii.ok()) << ascii.error().message;
  EXPECT_NEAR(binary->hull->volume, 1.0 / 6, 1e-9);
  EXPECT_EQ(binary->hull->volume, ascii->hull->volume);
  EXPECT_EQ(binary->hull->vertices, ascii->hull->vertices);
}

TEST_F(MeshFile, ColladaUnitsCountAndItsUpAxisDoesNot) {
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    const auto loaded = load("t.dae", collada("0.01", up));
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    const Eigen::AlignedBox3d box = bounds(Mesh{loaded->hull}, Eigen::Isometry3d::Identity());
    EXPECT_LT((box.min() - Eigen::Vector3d(0.10, 0, 0)).norm(), 1e-6) << up << " " << box.min().transpose();
    EXPECT_LT((box.max() - Eigen::Vector3d(0.11, 0.02, 0.03)).norm(), 1e-6) << up << " " << box.max().transpose();
  }
}

TEST_F(MeshFile, BadMeshesAreOneClearLine) {
  expect_error("empty.stl", "", "empty mesh file");
  expect_error("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "no volume");
  expect_error("sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0.3 0.3 0\nf 1 2 3\nf 2 4 3\nf 5 2 1\n",
               "no volume");
  expect_error("points.obj", "v 0 0 0\nv 1 0 0\n", "");
  expect_error("garbage.stl", std::string(200, '\x5a'), "");
  expect_error("garbage.dae", "<COLLADA><unclosed>", "not a readable dae mesh");
  expect_error("garbage.obj", std::string("\0\1\2\3", 4), "");
  expect_error("truncated.stl", binary_stl(kTetrahedron).substr(0, 140), "");
  auto broken = kTetrahedron;
  broken[3][1][2] = std::numeric_limits<float>::quiet_NaN();
  expect_error("nan.stl", binary_stl(broken), "not finite");
  broken[3][1][2] = std::numeric_limits<float>::infinity();
  expect_error("inf.stl", binary_stl(broken), "not finite");
  expect_error("model.blend", "x", "unsupported mesh format '.blend'");
  EXPECT_THAT(load_hull(folder_.path() + "/none.stl", kOne).error().message, HasSubstr("none.stl: no such file"));
}

TEST(ConvexHullOf, RandomPointsIsClosedConvexAndContainsThem) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto points = random_ball(seed, 12, {0.1, 0.05, 0.2});
    const auto hull = convex_hull(points);
    ASSERT_TRUE(hull);
    expect_closed_and_convex(*hull, 1e-9);
    for (const auto& p : points) EXPECT_LE(signed_distance(Mesh{std::make_shared<ConvexHull>(*hull)}, p), 5e-5);
  }
}

TEST(Simplify, FewVerticesStillContainEverythingAndGrowLittle) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto full = convex_hull(random_ball(seed, 2000, {0.05, 0.04, 0.06}));
    ASSERT_TRUE(full);
    const SimplifiedHull small = simplify(*full);
    EXPECT_LE(small.hull.vertices.size(), 96u);
    expect_closed_and_convex(small.hull, 1e-9);
    const Mesh mesh{std::make_shared<ConvexHull>(small.hull)};
    for (const auto& v : full->vertices) EXPECT_LE(signed_distance(mesh, v), 2e-5);
    const Mesh original{std::make_shared<ConvexHull>(*full)};
    for (const auto& v : small.hull.vertices) EXPECT_LE(signed_distance(original, v), small.growth + 2e-5);
    EXPECT_LT(small.growth, 3e-3);
    EXPECT_EQ(simplify(*full).hull.vertices, small.hull.vertices);
  }
}

// A tessellated can: all of its rim matters, but 0.2 mm of it does not.
TEST(Simplify, ACanOfThousandsOfVerticesStaysWithinAMillimetre) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 2000; ++i) {
    const double a = 2 * 3.141592653589793 * i / 2000;
    for (const double z : {0.0, 0.1}) points.emplace_back(0.033 * std::cos(a), 0.033 * std::sin(a), z);
  }
  const auto full = convex_hull(points);
  ASSERT_TRUE(full);
  const SimplifiedHull small = simplify(*full);
  EXPECT_LE(small.hull.vertices.size(), 64u);
  EXPECT_LE(small.growth, 1e-3);
  EXPECT_NEAR(small.hull.volume / full->volume, 1, 0.03);
}

TEST(Simplify, SmallHullsComeBackUnchanged) {
  const auto full = convex_hull(random_ball(3, 40, {1, 1, 1}));
  ASSERT_TRUE(full);
  const SimplifiedHull same = simplify(*full);
  EXPECT_EQ(same.hull.vertices, full->vertices);
  EXPECT_EQ(same.growth, 0);
}

TEST(LoadTriangles, KeepsTheSurfaceAsItIsScaledPolygonsCut) {
  const test::ScratchFolder folder;
  const auto box = load_triangles(folder.write("box.obj", kBoxObj), Eigen::Vector3d(2, 1, 1));
  ASSERT_TRUE(box.ok()) << box.error().message;
  EXPECT_EQ(box->triangles.size(), 12u);
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& p : box->vertices) bounds.extend(p);
  EXPECT_EQ(bounds.max(), Eigen::Vector3d(2, 2, 3));
  EXPECT_FALSE(load_triangles(folder.path() + "/none.stl", kOne).ok());
}

}  // namespace
}  // namespace mamo::io

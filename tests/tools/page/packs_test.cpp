// Laws of what pages are packed of: what is packed is restored, what is thinned keeps its bounds
// and its budget, and nothing depends on the number of threads.
#include "tools/page/packs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "assets/catalog.hpp"
#include "bench/score/coverage_curve.hpp"
#include "sim/mesh/texture_file.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/fault.hpp"
#include "tests/tools/page/page_arrays.hpp"
#include "tools/page/jpeg.hpp"

namespace gnbv {
namespace {

using test::numbers;
using test::random_points;
using test::sheet;
using Numbers = std::vector<double>;

TEST(Arrays, EachIsRestoredFromWhereABrowserMayReadIt) {
  page::Arrays arrays;
  const auto expect_back = [&](const auto& values) {
    const auto array = arrays.add(values);
    EXPECT_EQ(array.at % 8, 0U);
    EXPECT_EQ(numbers(array, arrays), Numbers(values.begin(), values.end()));
  };
  expect_back(std::vector<std::uint8_t>{1, 2, 255});
  expect_back(std::vector<std::int16_t>{-32768, 32767});
  expect_back(std::vector<std::uint16_t>{65535});
  expect_back(std::vector<std::uint32_t>{0xffffffffU, 5});
  expect_back(std::vector<float>{0.1F, -1e30F});
  expect_back(std::vector<double>{0.1, 1e300});
  expect_back(std::vector<double>{});
  const std::vector<std::uint32_t> whole = {0, 127, 128, 300, 16384, 0xffffffffU};
  const std::size_t before = arrays.bytes().size();
  const page::Numbers packed = arrays.add_numbers(whole);
  EXPECT_EQ(numbers(packed, arrays), Numbers(whole.begin(), whole.end()));
  EXPECT_EQ(arrays.bytes().size(), (before + 7) / 8 * 8 + 1 + 1 + 2 + 2 + 3 + 5);
}

TEST(Arrays, PointsAreRestoredWithinHalfAStepAndOneHeightExactly) {
  page::Arrays arrays;
  std::vector<Vec3f> points = sheet(2000);
  for (int pass = 0; pass < 2; ++pass) {
    const page::Points packed = arrays.add_points(points);
    const Numbers back = numbers(packed, arrays);
    for (std::size_t i = 0; i < back.size(); ++i) {
      // half a step, and the rounding of float32 at 10 m
      EXPECT_NEAR(back[i], points[i / 3][static_cast<Eigen::Index>(i % 3)],
                  packed.size_m[i % 3] / 131070.0 + 2e-6);
    }
    for (Vec3f& p : points) p.z() = 2.5F;
  }
  EXPECT_TRUE(numbers(arrays.add_points({}), arrays).empty());
}

TEST(Thinning, KeepsTheBudgetAndTheFirstPointOfEachCell) {
  const std::vector<Vec3f> points = sheet(20000);
  const ThinnedPoints thin = thinned(points, 1500, 0.02);
  ASSERT_LE(thin.kept.size(), 1500U);
  EXPECT_GT(thin.kept.size(), 500U);  // a lattice 1.25 times as coarse keeps 1 / 1.56 of a sheet
  EXPECT_TRUE(std::is_sorted(thin.kept.begin(), thin.kept.end()));
  // whatever went lies in the cell of one that stayed
  const double diagonal_m = thin.cell_m * std::sqrt(3.0);
  for (std::size_t i = 0; i < points.size(); i += 97) {
    EXPECT_TRUE(std::any_of(thin.kept.begin(), thin.kept.end(), [&](std::size_t k) {
      return (points[k] - points[i]).norm() <= diagonal_m;
    })) << i;
  }
  const std::vector<Vec3f> few = {
      {0.15F, 0, 0}, {0.05F, 0, 0}, {0.11F, 0, 0}, {-0.05F, 0, 0}, {0.01F, 0.01F, 0.01F}};
  EXPECT_EQ(first_points(few, 0.1), (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_EQ(thinned(few, 5, 0.1).kept.size(), 5U);
  EXPECT_EQ(thinned(few, 5, 0.1).cell_m, 0.0);
}

/// A square with a picture of 8 x 8 squares, black and white, and a plain one beside it.
TriangleMesh chessboard() {
  Image image{64, 64, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    image.rgb.insert(image.rgb.end(), 3, (i / 8 + i / 512) % 2 == 0 ? 255 : 0);
  }
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  mesh.materials[0] = {.rgb = {1, 1, 1}, .texture = {"", std::make_shared<const Image>(image), {}}};
  const auto corner = [](float u, float v) { return CornerLook{.uv = {u, v}}; };
  mesh.face_looks = {{corner(0, 0), corner(1, 0), corner(1, 1)},
                     {corner(0, 0), corner(1, 1), corner(0, 1)}};
  return mesh;
}

TEST(PaintedMesh, IsCutUntilItsVerticesShowThePicture) {
  const TriangleMesh coarse = chessboard();
  const TriangleMesh fine = cut_finer(coarse, 20'000, 100'000);
  EXPECT_GT(fine.faces.size(), 5'000U);
  EXPECT_LE(fine.faces.size(), 100'000U);
  EXPECT_NEAR(surface_area_m2(fine), 64.0, 1e-3);
  VertexColours colours(fine);
  const std::vector<std::uint16_t> of = colours.of(fine.vertices_m);
  std::size_t wrong = 0, inside = 0;
  for (std::size_t i = 0; i < fine.vertices_m.size(); ++i) {
    const Vec3f& p = fine.vertices_m[i];
    const float x = p.x() - std::floor(p.x()), y = p.y() - std::floor(p.y());
    if (std::min(std::min(x, 1.0F - x), std::min(y, 1.0F - y)) < 0.25F) continue;  // of the border
    const bool is_white = (static_cast<int>(p.x()) + static_cast<int>(p.y())) % 2 == 0;
    ++inside;
    if (of[3 * i] != (is_white ? 65535 : 0)) ++wrong;
  }
  EXPECT_GT(inside, 1000U);
  EXPECT_EQ(wrong, 0U);
  // no edge is cut on one side alone: the same cut of every edge, each of two faces or on the rim
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& face : fine.faces) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax({face[k], face[(k + 1) % 3]})];
  }
  for (const auto& [edge, count] : edges) {
    const auto is_on_rim = [&](std::uint32_t v) {
      const Vec3f& p = fine.vertices_m[v];
      return p.x() == 0 || p.x() == 8 || p.y() == 0 || p.y() == 8;
    };
    ASSERT_TRUE(count == 2 || (is_on_rim(edge.first) && is_on_rim(edge.second)));
  }
  const TriangleMesh plain = make_builtin_structure("smoke");
  EXPECT_EQ(cut_finer(plain, 20'000, 100'000).faces, plain.faces);
  page::Arrays arrays;
  const page::MeshData packed = pack_mesh(coarse, 4'000'000, arrays);
  EXPECT_EQ(packed.all_faces, 2U);
  ASSERT_TRUE(packed.colours);
  EXPECT_EQ(packed.colours->rows, packed.vertices.rows);
}

TEST(Jpeg, IsReadAsItWasWritten) {
  Image image{40, 24, {}};
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 40; ++x) {
      for (const int c : {6 * x, 10 * y, 128}) image.rgb.push_back(static_cast<std::uint8_t>(c));
    }
  }
  const std::vector<std::uint8_t> bytes = jpeg_bytes(image, 98);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const Image read = read_picture(text, 960);
  ASSERT_EQ(std::pair(read.width_px, read.height_px), std::pair(40, 24));
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    EXPECT_NEAR(read.rgb[i], image.rgb[i], 12) << i;  // chroma is halved
  }
  const auto fault = [](std::string_view of, std::size_t most_px) {
    return test::fault_of([&] { read_picture(of, most_px); });
  };
  EXPECT_THAT(fault(text, 959), testing::HasSubstr("too large (40 x 24"));
  for (std::size_t cut = 3; cut + 2 < text.size(); cut += 37) {
    EXPECT_THAT(fault(text.substr(0, cut), 960), testing::HasSubstr("damaged")) << cut;
  }
  EXPECT_EQ(read_picture(std::string(text) + "more", 960).rgb, read.rgb);
}

TEST(Thinning, AMeshKeepsItsPlaceItsMaterialsAndItsBudget) {
  const TriangleMesh whole = make_builtin_structure("aircraft");
  const TriangleMesh thin = with_fewer_faces(whole, 6000);
  ASSERT_LE(thin.faces.size(), 6000U);
  EXPECT_GT(thin.faces.size(), 2000U);
  EXPECT_EQ(thin.faces.size(), thin.face_material.size());
  EXPECT_TRUE(bounds_m(whole).contains(bounds_m(thin)));
  EXPECT_NEAR(bounds_m(thin).diagonal().norm(), bounds_m(whole).diagonal().norm(), 0.5);
  for (const auto& face : thin.faces) {
    EXPECT_EQ(std::set<std::uint32_t>(face.begin(), face.end()).size(), 3U);
    for (const std::uint32_t corner : face) ASSERT_LT(corner, thin.vertices_m.size());
  }
  EXPECT_EQ(with_fewer_faces(whole, 1'000'000).faces.size(), whole.faces.size());
  for (const std::size_t bytes : {20'000U, 200'000U}) {
    page::Arrays arrays;
    pack_mesh(whole, bytes, arrays);
    EXPECT_LE(arrays.bytes().size(), bytes);
    EXPECT_GT(arrays.bytes().size(), bytes / 4);
  }
}

/// In each voxel of 1 m, among the first `end` points.
std::map<std::array<double, 3>, double> brute_counts(const RunCloud& cloud, std::size_t end) {
  std::map<std::array<double, 3>, double> counts;
  for (std::size_t i = 0; i < end; ++i) {
    const Vec3f& p = cloud.points_world_m[i];
    counts[{std::floor(p.x()), std::floor(p.y()), std::floor(p.z())}] += 1.0;
  }
  return counts;
}

/// The counts after each state, as the page adds them up, are those of the points until then.
void expect_brute_counts(const RunCloud& cloud) {
  page::Arrays arrays;
  const page::VoxelData voxels = pack_voxels(cloud, 1.0, 100'000'000, arrays);
  const Numbers index = numbers(voxels.index, arrays);
  const Numbers after = numbers(voxels.after, arrays);
  const Numbers gains = numbers(voxels.gains, arrays);
  const Numbers gains_after = numbers(voxels.gains_after, arrays);
  ASSERT_EQ(after.size(), cloud.view_points.size() + 1);
  Numbers counts(index.size() / 3, 0.0);
  std::size_t gain = 0;
  for (std::size_t state = 0; state < after.size(); ++state) {
    for (std::size_t voxel = 0; gain < static_cast<std::size_t>(gains_after[state]); gain += 2) {
      voxel += static_cast<std::size_t>(gains[gain]);
      counts.at(voxel) += gains[gain + 1];
    }
    const bool is_last = state + 1 == after.size();
    const auto expected = brute_counts(cloud, is_last      ? cloud.points_world_m.size()
                                              : state == 0 ? cloud.profile_points
                                                           : cloud.view_points[state - 1]);
    EXPECT_EQ(after[state], static_cast<double>(expected.size()));
    for (std::size_t v = 0; v < counts.size(); ++v) {
      const auto at = expected.find({index[3 * v], index[3 * v + 1], index[3 * v + 2]});
      ASSERT_EQ(counts[v], at == expected.end() ? 0.0 : at->second) << "state " << state;
      EXPECT_EQ(static_cast<double>(v) < after[state], at != expected.end());
    }
  }
}

TEST(VoxelGrowth, TheCountsAfterEachViewAreThoseOfItsPoints) {
  // the last points came after the last view and count to it
  expect_brute_counts(
      {.points_world_m = sheet(6000), .profile_points = 900, .view_points = {900, 4000, 5900}});
  expect_brute_counts({.points_world_m = sheet(50), .profile_points = 20, .view_points = {}});
}

TEST(CloudPack, APointIsThereAfterTheViewThatBroughtIt) {
  const RunCloud cloud{
      .points_world_m = sheet(100), .profile_points = 20, .view_points = {30, 30, 90}};
  page::Arrays arrays;
  const page::CloudData packed =
      pack_cloud(cloud, {.cell_m = 0.5, .kept = {3, 19, 20, 29, 88, 95}}, nullptr, 1, arrays);
  EXPECT_EQ(numbers(packed.after, arrays), (Numbers{2, 4, 4, 6}));
  EXPECT_EQ(numbers(packed.points, arrays).size(), 18U);
}

TEST(TrueSurface, FoundAfterEachViewIsTheCurveOfCoverage) {
  SurfaceReference reference;
  reference.counted = at_all_sizes(voxels_of(random_points(2000, 2.0F, 1), 0.05));
  reference.raw = reference.counted;
  RunCloud cloud{.points_world_m = random_points(5000, 2.0F, 2),
                 .profile_points = 700,
                 .view_points = {900, 900, 3100, 5000}};
  std::vector<std::size_t> prefixes = {cloud.profile_points};
  prefixes.insert(prefixes.end(), cloud.view_points.begin(), cloud.view_points.end());
  const auto curve = coverage_of_prefixes(reference, cloud.points_world_m, prefixes, 1);
  const TrueVoxels voxels = true_voxels(reference, 1'000'000);
  EXPECT_EQ(voxels.size_m, 0.05);
  const std::vector<std::uint16_t> until = views_until_found(voxels, cloud);
  for (std::size_t n = 0; n < curve.size(); ++n) {
    const auto found = std::count_if(until.begin(), until.end(), [&](auto u) { return u <= n; });
    EXPECT_EQ(static_cast<double>(found) / static_cast<double>(until.size()), curve[n].counted[0]);
  }
  EXPECT_GT(std::count(until.begin(), until.end(), kNeverFound), 0);
  // what came after the last view counts to it
  const TrueVoxels two{.size_m = 0.5, .codes = {code_of({0, 0, 0}), code_of({1, 0, 0})}};
  EXPECT_EQ(views_until_found(two, {.points_world_m = {{0.25F, 0, 0}, {0.75F, 0, 0}},
                                    .profile_points = 1,
                                    .view_points = {1, 1}}),
            (std::vector<std::uint16_t>{0, 2}));
}

TEST(TrueSurface, IsAsFineAsThePageHasRoomFor) {
  SurfaceReference reference;
  reference.counted = at_all_sizes(voxels_of(random_points(2000, 2.0F, 1), 0.05));
  for (std::size_t size = 0; size < 3; ++size) {
    const std::size_t count = reference.counted[size].size();
    EXPECT_EQ(true_voxels(reference, count).size_m, kCoverageSizes_m[size]);
  }
  EXPECT_TRUE(true_voxels(reference, reference.counted[2].size() - 1).codes.empty());
  // an index beyond 16 bits at 0.05 m
  reference.counted = at_all_sizes(voxels_of(std::vector<Vec3f>{{2000, 0, 0}}, 0.05));
  EXPECT_EQ(true_voxels(reference, 10).size_m, 0.10);
}

TEST(TrueSurface, ErrorsAreDistancesToTheStructureAloneAndTheirScaleIsOfThem) {
  World world;
  test::add_box(world.structure, {-1, -1, 0.5}, {2, 2, 2});
  world.obstacles = box_mesh(Box3(Vec3(3, -2, 0), Vec3(3.2, 2, 3)));
  const RayScene scene(world);
  const RunCloud cloud{
      .points_world_m = {{1, 0, 1}, {1.0304F, 0, 1}, {1.6F, 0, 1}, {3, 0, 1}, {-6, 0, 1}},
      .profile_points = 5,
      .view_points = {}};
  const std::vector<std::uint8_t> errors = {0, 30, 254, kNotOfStructure, 254};
  EXPECT_EQ(point_errors(scene, cloud.points_world_m, 1), errors);
  EXPECT_EQ(point_errors(scene, cloud.points_world_m, 3), errors);
  page::Arrays arrays;
  const page::CloudData packed =
      pack_cloud(cloud, {.cell_m = 0.0, .kept = {0, 1, 3}}, &scene, 1, arrays);
  EXPECT_EQ(packed.error_most_mm, 50.0);  // 95 % of 0 and 30 mm lie within
  EXPECT_EQ(packed.error_median_mm, 0.0);
}

}  // namespace
}  // namespace gnbv

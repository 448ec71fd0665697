// Laws of the picture of what the cloud covers of the true surface.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <ranges>

#include "bench/score/surface_reference.hpp"
#include "sim/core/text.hpp"
#include "tests/tools/render/laid_out.hpp"
#include "tests/tools/render/watched.hpp"
#include "tools/run/cloud_file.hpp"

namespace gnbv {
namespace {

/// The clouds of the mission that was watched, as files of its run.
void write_clouds(const std::filesystem::path& folder) {
  write_cloud_ply(watched().flown.result.belief.cloud.points_world_m(), folder / "cloud.ply");
  write_cloud_ply(watched().flown.result.profile_points_world_m, folder / "profile.ply");
}

TEST(CoveragePicture, CoversTheShareThatTheScoreSays) {
  const TempFolder temp;
  write_clouds(temp.path());
  const auto points = watched().flown.result.belief.cloud.points_world_m();
  RunSource run = source(temp.path());
  const RenderView view = view_of(kCoveragePicture, run);
  const Picture picture = kCoveragePicture.draw(run, {}, view);
  ASSERT_EQ(picture.panels.size(), 2U);
  const SurfaceItem& cubes = picture.panels[0].scene.surfaces.at(0);
  // a colour for each corner: voxels of the reference by whether the cloud covers them
  const VoxelSet seen = covered_voxels(points, 0);
  const Rgb& missed = picture.legend.at(1).colours.front();
  std::set<std::uint64_t> shown_voxels, missed_voxels;
  for (std::size_t i = 0; i < cubes.mesh.faces.size(); i += 2) {
    Vec3f middle_m = Vec3f::Zero();  // of a square, drawn as two faces
    for (std::size_t k = 0; k < 4; ++k) {
      middle_m += 0.25F * cubes.mesh.vertices_m[cubes.mesh.faces[i][0] + k];
    }
    const Vec3f a_m = cubes.mesh.vertices_m[cubes.mesh.faces[i][0]];
    const Vec3f n = (cubes.mesh.vertices_m[cubes.mesh.faces[i][1]] - a_m)
                        .cross(cubes.mesh.vertices_m[cubes.mesh.faces[i][2]] - a_m)
                        .normalized();
    const std::uint64_t voxel = voxel_code(middle_m - 0.02F * n, kCoverageSizes_m[0]);
    const bool is_missed = cubes.vertex_colours[cubes.mesh.faces[i][0]] == missed;
    ASSERT_EQ(is_missed, !std::binary_search(seen.begin(), seen.end(), voxel));
    shown_voxels.insert(voxel);
    if (is_missed) missed_voxels.insert(voxel);
  }
  // amid six others a voxel has no face to show; all the others are there
  const VoxelSet& counted = run.reference().counted[0];
  for (const std::uint64_t code : counted) {
    const Vec3 centre_m = voxel_centre_m(code, kCoverageSizes_m[0]);
    const auto is_counted = [&](int side) {
      const Vec3 step_m = (side % 2 == 0 ? -1.0 : 1.0) * kCoverageSizes_m[0] * Vec3::Unit(side / 2);
      return std::ranges::binary_search(
          counted, voxel_code((centre_m + step_m).cast<float>(), kCoverageSizes_m[0]));
    };
    const bool is_amid = std::ranges::all_of(std::views::iota(0, 6), is_counted);
    ASSERT_NE(is_amid, shown_voxels.contains(code));
    if (is_amid && !std::ranges::binary_search(seen, code)) missed_voxels.insert(code);
  }
  EXPECT_DOUBLE_EQ(
      1.0 - static_cast<double>(missed_voxels.size()) / static_cast<double>(counted.size()),
      coverage_at_all_sizes(run.reference().counted, points)[0]);
  // the other side is another one, and shows all of it, too
  ASSERT_TRUE(picture.panels[1].view.has_value());
  EXPECT_GT((picture.panels[1].view->T_world_camera.linear() - view.T_world_camera.linear()).norm(),
            0.1);
}

/// A voxel smaller than a pixel would flicker: drawn larger, it says so, and counts the same.
TEST(CoveragePicture, DrawsNoVoxelsSmallerThanAPixelAndAHalf) {
  const TempFolder temp;
  write_clouds(temp.path());
  RunSource run = source(temp.path());
  RenderView view = view_of(kCoveragePicture, run);
  const Picture near = kCoveragePicture.draw(run, {}, view);
  EXPECT_EQ(near.detail.find("drawn in"), std::string::npos);
  view.focus_m *= 0.05 * px_per_m_at_focus(view);  // to a pixel a voxel
  const Picture far = kCoveragePicture.draw(run, {}, view);
  EXPECT_NE(far.detail.find("; drawn in voxels of 0.10 m"), std::string::npos);
  EXPECT_EQ(far.detail.substr(0, near.detail.size()), near.detail);
  EXPECT_EQ(far.panels[0].note, near.panels[0].note);
  const auto faces = [](const Picture& picture) {
    return picture.panels[0].scene.surfaces.at(0).mesh.faces.size();
  };
  EXPECT_LT(faces(far), faces(near) / 2);
}

/// Pictures in a row of a sheet can be compared.
TEST(CoveragePicture, SecondPanelsOfSeveralRunsLookTheSameWay) {
  const TempFolder temp;
  write_clouds(temp.path());
  RunSource run = source(temp.path());
  RunSource other = source(temp.path());
  RunSource* const runs[] = {&run, &other};
  const RenderView view = view_of(kCoveragePicture, run);
  EXPECT_FALSE(with_shared_angles(kCoveragePicture, std::span(runs).first(1), {}, view)
                   .second_angles.has_value());
  PictureOptions shared = with_shared_angles(kCoveragePicture, runs, {}, view);
  ASSERT_TRUE(shared.second_angles.has_value());
  const auto pose = [&](RunSource& of) {
    return kCoveragePicture.draw(of, shared, view).panels[1].view->T_world_camera.matrix();
  };
  EXPECT_EQ(pose(run), pose(other));
  for (const auto& [azimuth_deg, words] : {std::pair{0.0, "from the east"},
                                           {90.0, "from the north"},
                                           {-135.0, "from the south-west"},
                                           {190.0, "from the west"}}) {
    shared.second_angles = {deg_to_rad(azimuth_deg), 0.1};
    const std::string note = kCoveragePicture.draw(run, shared, view).panels[1].note;
    EXPECT_NE(note.find(fmt::format(" in sight {};", words)), std::string::npos) << note;
  }
}

/// Whether a triangle of the mesh lies on the way from a place to an eye, farther than `beside_m`
/// from the place (Moeller and Trumbore 1997).
bool stands_between(const TriangleMesh& mesh, const Vec3& p_m, const Vec3& eye_m, double beside_m) {
  const Vec3 way_m = eye_m - p_m;
  return std::any_of(mesh.faces.begin(), mesh.faces.end(), [&](const auto& face) {
    const Vec3 a = mesh.vertices_m[face[0]].template cast<double>();
    const Vec3 ab = mesh.vertices_m[face[1]].template cast<double>() - a;
    const Vec3 ac = mesh.vertices_m[face[2]].template cast<double>() - a;
    const Vec3 p = way_m.cross(ac);
    const double determinant = ab.dot(p);
    if (determinant == 0.0) return false;
    const double u = (p_m - a).dot(p) / determinant;
    const Vec3 q = (p_m - a).cross(ab);
    const double v = way_m.dot(q) / determinant;
    const double t = ac.dot(q) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t * way_m.norm() > beside_m;
  });
}

/// What the notes count of what is missed, against brute force.
TEST(CoveragePicture, NotesCountWhatTheirPanelsShow) {
  const TempFolder temp;
  write_clouds(temp.path());
  RunSource run = source(temp.path());
  const RenderView view = view_of(kCoveragePicture, run);
  const Picture picture = kCoveragePicture.draw(run, {}, view);
  const SurfaceReference& reference = run.reference();
  const double size_m = kCoverageSizes_m.front();
  const VoxelSet seen = covered_voxels(run.cloud().points_world_m, 0);
  std::size_t missed = 0;
  std::array<std::size_t, 2> shown{};
  std::size_t in_neither = 0;
  const std::array<RenderView, 2> views = {view, *picture.panels[1].view};
  for (std::size_t i = 0; i < reference.counted.front().size(); ++i) {
    if (std::binary_search(seen.begin(), seen.end(), reference.counted.front()[i])) continue;
    ++missed;
    const Vec3 p_m = reference.points_world_m[i].cast<double>();
    bool is_any = false;
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3 eye_m = views[k].T_world_camera.translation();
      const bool is_shown = is_within(views[k], p_m) &&
                            !stands_between(run.world().structure, p_m, eye_m, 0.2 * size_m);
      shown[k] += is_shown ? 1 : 0;
      is_any |= is_shown;
    }
    in_neither += is_any ? 0 : 1;
  }
  EXPECT_GT(missed, in_neither);
  EXPECT_EQ(picture.panels[0].note, fmt::format("{} voxels missed, {} of them in sight",
                                                grouped(missed), grouped(shown[0])));
  EXPECT_TRUE(picture.panels[1].note.starts_with(fmt::format("{} in sight", grouped(shown[1]))));
  EXPECT_TRUE(
      picture.panels[1].note.ends_with(fmt::format("; {} in neither", grouped(in_neither))));
}

}  // namespace
}  // namespace gnbv

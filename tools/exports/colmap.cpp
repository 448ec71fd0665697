#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/exports/export_folder.hpp"
#include "tools/exports/formats.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr const char* kColmapReadme =
    R"(A gnbv run as a COLMAP model with known poses.

sparse/0/cameras.txt   PINHOLE, OPENCV, FULL_OPENCV or OPENCV_FISHEYE with COLMAP's parameters of
                       it in pixels; the centre of the first pixel is (0.5, 0.5)
sparse/0/images.txt    world to camera (x right, y down, z forward), world ENU in metres
sparse/0/points3D.txt  points of the run's cloud, with the images whose depth shows them
images/CAMERA_N.png    colour of view N, all in one folder, where the readers of Gaussian splatting
                       look; the depth images are in the run's folder frames/
cameras/ID.txt         the images of that camera of cameras.txt

Poses are those that the vehicle believed; `gnbv export --format tum` has the true ones, too.
The keypoints in images.txt are projections of the points, not detected features: their
reprojection error is 0. To work with features instead:

  colmap feature_extractor --database_path d.db --image_path images \
    --image_list_path cameras/1.txt --ImageReader.single_camera 1 \
    --ImageReader.camera_model PINHOLE    (or as cameras.txt says)
  colmap exhaustive_matcher --database_path d.db
  mkdir triangulated && colmap point_triangulator --database_path d.db --image_path images \
    --input_path sparse/0 --output_path triangulated --clear_points 1

The first line once for each camera, in the order of their numbers: so the database numbers
images and cameras as this model does. --ImageReader.camera_params with the camera's numbers of
cameras.txt lets the matcher know them, too.
)";

std::string image_path(const FrameRecord& frames, const RecordedFrame& frame) {
  return fmt::format("{}_{}.png", file_word(frames.cameras[frame.camera]), frame_number(frame));
}

/// The frames in the order of their names: COLMAP's own programs number images so, from 1.
std::vector<std::size_t> frames_by_name(const FrameRecord& frames) {
  std::vector<std::size_t> order(frames.frames.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return image_path(frames, frames.frames[a]) < image_path(frames, frames.frames[b]);
  });
  return order;
}

/// Of each camera, from 1: in the order in which the names of its images come. What follows the
/// camera's name counts: "rgbd-down_0..." comes before "rgbd_0...".
std::vector<std::ptrdiff_t> camera_ids(const FrameRecord& frames) {
  std::vector<std::string> begins;
  for (const FrameCamera& camera : frames.cameras) begins.push_back(file_word(camera) + "_0");
  std::vector<std::ptrdiff_t> ids;
  for (const std::string& begin : begins) {
    const auto is_before = [&](const std::string& other) { return other < begin; };
    ids.push_back(1 + std::ranges::count_if(begins, is_before));
  }
  return ids;
}

struct ColmapModel {
  const char* name;
  std::vector<double> coefficients;
};

ColmapModel colmap_model(const FrameCamera& camera) {
  need_no_skew(camera, "COLMAP");
  std::vector<double> all = camera.coefficients();
  if (camera.distortion() == Distortion::none) return {"PINHOLE", {}};
  if (camera.distortion() == Distortion::kannala_brandt) return {"OPENCV_FISHEYE", all};
  const bool is_short = std::all_of(all.begin() + 4, all.end(), [](double k) { return k == 0.0; });
  if (is_short) all.resize(4);
  return {is_short ? "OPENCV" : "FULL_OPENCV", all};
}

std::string cameras_text(const FrameRecord& frames, const std::vector<std::ptrdiff_t>& ids) {
  std::string text =
      "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]: fx, fy, cx, cy, then the distortion's\n";
  for (std::size_t i = 0; i < frames.cameras.size(); ++i) {
    const FrameCamera& c = frames.cameras[i];
    const auto [model, coefficients] = colmap_model(c);
    text += fmt::format("{} {} {} {} {} {} {} {}{}{}\n", ids[i], model, c.width_px, c.height_px,
                        c.fx_px, c.fy_px, c.cx_px, c.cy_px, coefficients.empty() ? "" : " ",
                        fmt::join(coefficients, " "));
  }
  return text;
}

std::string images_text(const FrameRecord& frames, const SparseModel& model,
                        const std::vector<std::size_t>& order,
                        const std::vector<std::ptrdiff_t>& ids) {
  std::string text =
      "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[]: X, Y, POINT3D_ID\n";
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const RecordedFrame& frame = frames.frames[order[i]];
    const Isometry T_camera_world = frame.T_world_camera.inverse();
    const Eigen::Quaterniond q(T_camera_world.linear());
    const Vec3 t = T_camera_world.translation();
    fmt::format_to(out, "{} {} {} {} {} {} {} {} {} {}\n", i + 1, q.w(), q.x(), q.y(), q.z(), t.x(),
                   t.y(), t.z(), ids[frame.camera], image_path(frames, frame));
    const char* separator = "";
    for (const Observation& o : model.observations[order[i]]) {
      fmt::format_to(out, "{}{:.2f} {:.2f} {}", separator, o.u_px, o.v_px, o.point + 1);
      separator = " ";
    }
    text += '\n';
  }
  return text;
}

/// What images_text() says the other way round: each point with image number and index in its list.
std::string points_text(const SparseModel& model, const std::vector<std::size_t>& order) {
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> tracks(model.points_world_m.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& of_frame = model.observations[order[i]];
    for (std::size_t j = 0; j < of_frame.size(); ++j)
      tracks[of_frame[j].point].push_back({i + 1, j});
  }
  std::string text = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[]: IMAGE_ID, POINT2D_IDX\n";
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Vec3f& p = model.points_world_m[i];
    const Rgb8& c = model.colours[i];
    fmt::format_to(out, "{} {} {} {} {} {} {} 0", i + 1, p.x(), p.y(), p.z(), c[0], c[1], c[2]);
    for (const auto& [image, index] : tracks[i]) fmt::format_to(out, " {} {}", image, index);
    text += '\n';
  }
  return text;
}

}  // namespace

void write_colmap(const FrameRecord& frames, const SparseModel& model, const fs::path& folder) {
  const std::vector<std::size_t> order = frames_by_name(frames);
  const std::vector<std::ptrdiff_t> ids = camera_ids(frames);
  const fs::path sparse = folder / "sparse" / "0";
  fs::create_directories(sparse);
  write_file_atomically(sparse / "cameras.txt", cameras_text(frames, ids));
  write_file_atomically(sparse / "images.txt", images_text(frames, model, order, ids));
  write_file_atomically(sparse / "points3D.txt", points_text(model, order));
  write_file_atomically(folder / "README.txt", kColmapReadme);
  std::vector<std::string> lists(ids.size());
  for (const std::size_t i : order) {
    const RecordedFrame& frame = frames.frames[i];
    lists[frame.camera] += image_path(frames, frame) + "\n";
    link_or_copy(frame.colour, folder / "images" / image_path(frames, frame));
  }
  fs::create_directories(folder / "cameras");
  for (std::size_t camera = 0; camera < ids.size(); ++camera) {
    write_file_atomically(folder / "cameras" / fmt::format("{}.txt", ids[camera]), lists[camera]);
  }
}

}  // namespace gnbv

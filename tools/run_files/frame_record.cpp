#include "tools/run_files/frame_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run_files/run_record.hpp"
#include "tools/run_files/separated_text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPosesHeader =
    "iteration,camera,time_s,x_m,y_m,z_m,qx,qy,qz,qw,rgb,depth";

std::vector<FrameCamera> read_cameras(const fs::path& path) {
  std::vector<FrameCamera> cameras;
  try {
    for (const nlohmann::json& entry : nlohmann::json::parse(read_file(path))) {
      cameras.push_back({.name = entry.at("name").get<std::string>(),
                         .width_px = entry.at("width_px").get<int>(),
                         .height_px = entry.at("height_px").get<int>(),
                         .fx_px = entry.at("fx_px").get<double>(),
                         .fy_px = entry.at("fy_px").get<double>(),
                         .cx_px = entry.at("cx_px").get<double>(),
                         .cy_px = entry.at("cy_px").get<double>(),
                         .depth_scale_m = entry.at("depth_scale_m").get<double>()});
      const FrameCamera& c = cameras.back();
      if (c.width_px < 1 || c.height_px < 1 || !(c.fx_px > 0.0) || !(c.fy_px > 0.0) ||
          !(c.depth_scale_m > 0.0)) {
        throw BadInput(
            fmt::format("{}: camera '{}': sizes, focal lengths and depth scale must be "
                        "positive",
                        path.string(), c.name));
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw BadInput(fmt::format("{}: {}", path.string(), error.what()));
  }
  return cameras;
}

/// An image of the folder itself, so that a damaged file cannot name any other.
fs::path image_of(const fs::path& folder, std::string_view name, const TextPlace& place) {
  const fs::path file(trimmed(name));
  if (file.empty() || file != file.filename() || !fs::exists(folder / file)) {
    throw BadInput(
        fmt::format("{}: no image `{}` in {}", to_string(place), file.string(), folder.string()));
  }
  return folder / file;
}

RecordedFrame frame_of(std::string_view row, const std::vector<FrameCamera>& cameras,
                       const TextPlace& place) {
  std::array<std::string_view, 12> cells;
  for (std::string_view& cell : cells) cell = next_part(row, ',');
  const auto camera = std::find_if(cameras.begin(), cameras.end(),
                                   [&](const FrameCamera& c) { return c.name == cells[1]; });
  if (camera == cameras.end()) {
    throw BadInput(
        fmt::format("{}: camera `{}` is not in cameras.json", to_string(place), cells[1]));
  }
  std::array<double, 8> numbers{};  // time x y z qx qy qz qw
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = to_number(cells[i + 2], place, "time or pose");
  }
  const Eigen::Quaterniond q(numbers[7], numbers[4], numbers[5], numbers[6]);
  if (std::abs(q.norm() - 1.0) > 1e-3) {
    throw BadInput(fmt::format("{}: qx qy qz qw are no unit quaternion", to_string(place)));
  }
  RecordedFrame frame{.iteration = to_count(cells[0], place, "iteration"),
                      .camera = static_cast<std::size_t>(camera - cameras.begin()),
                      .time_s = numbers[0]};
  frame.T_world_camera.translate(Vec3(numbers[1], numbers[2], numbers[3]));
  frame.T_world_camera.rotate(q.normalized());
  const fs::path folder = place.file.parent_path();
  frame.colour = image_of(folder, cells[10], place);
  frame.depth = image_of(folder, cells[11], place);
  return frame;
}

/// The image, which `file` holds, of a camera of its size.
template <typename AnyImage>
AnyImage of_size(AnyImage image, const FrameCamera& camera, const fs::path& file) {
  if (image.width_px == camera.width_px && image.height_px == camera.height_px) return image;
  throw BadInput(fmt::format("{}: {} x {} px, but cameras.json says {} x {} px of camera `{}`",
                             file.string(), image.width_px, image.height_px, camera.width_px,
                             camera.height_px, camera.name));
}

}  // namespace

bool has_frames(const fs::path& run) {
  return fs::exists(run / "frames" / "poses.csv") || fs::exists(run / "frames" / "cameras.json");
}

FrameRecord read_frames(const fs::path& run) {
  const fs::path poses = run / "frames" / "poses.csv";
  if (!has_frames(run)) {
    throw BadInput(fmt::format("{}: the run has no frames; {} flies it again and keeps them",
                               (run / "frames").string(), command_to_fly_again(run, "--frames")));
  }
  for (const fs::path& file : {poses, run / "frames" / "cameras.json"}) {
    if (fs::exists(file)) continue;
    throw BadInput(fmt::format("{}: is missing; {} flies it again and writes it", file.string(),
                               command_to_fly_again(run, "--frames")));
  }
  FrameRecord record{.cameras = read_cameras(run / "frames" / "cameras.json"), .frames = {}};
  const std::string text = read_file(poses);
  std::string_view rest = text;
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view row = trimmed(next_part(rest, '\n'));
    const TextPlace place{poses, line};
    if (line == 1 && row != kPosesHeader) {
      throw BadInput(
          fmt::format("{}: is not the header that this version writes; {} flies the "
                      "mission again",
                      to_string(place), command_to_fly_again(run, "--frames")));
    }
    if (line == 1 || row.empty()) continue;
    record.frames.push_back(frame_of(row, record.cameras, place));
  }
  if (record.frames.empty()) throw BadInput(fmt::format("{}: holds no frame", poses.string()));
  return record;
}

Image read_colour(const FrameRecord& record, std::size_t frame) {
  const RecordedFrame& f = record.frames[frame];
  return of_size(read_png(f.colour), record.cameras[f.camera], f.colour);
}

GreyImage16 read_depth(const FrameRecord& record, std::size_t frame) {
  const RecordedFrame& f = record.frames[frame];
  return of_size(read_png_grey16(f.depth), record.cameras[f.camera], f.depth);
}

}  // namespace gnbv

#include "tools/run/frames_folder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kCamerasFile = "cameras.json";
constexpr const char* kPosesFile = "poses.csv";
constexpr std::string_view kPosesHeader =
    "iteration,camera,time_s,x_m,y_m,z_m,qx,qy,qz,qw,rgb,depth";

constexpr std::array<std::pair<const char*, double FrameCamera::*>, 5> kCameraNumbers = {
    {{"fx_px", &FrameCamera::fx_px},
     {"fy_px", &FrameCamera::fy_px},
     {"cx_px", &FrameCamera::cx_px},
     {"cy_px", &FrameCamera::cy_px},
     {"depth_scale_m", &FrameCamera::depth_scale_m}}};

std::uint16_t millimetres(float depth_m) {
  constexpr float kMax_mm = 65535.0F;
  const float depth_mm = std::round(1000.0F * depth_m);
  return depth_mm > 0.0F && depth_mm <= kMax_mm ? static_cast<std::uint16_t>(depth_mm) : 0;
}

GreyImage16 image_of(const DepthFrame& frame, const CameraConfig& camera) {
  GreyImage16 image{camera.width_px, camera.height_px, {}};
  image.values.resize(frame.depth_m.size());
  std::transform(frame.depth_m.begin(), frame.depth_m.end(), image.values.begin(), millimetres);
  return image;
}

Image image_of(const ColourFrame& frame, const CameraConfig& camera) {
  Image image{camera.width_px, camera.height_px, {}};
  image.rgb.reserve(3 * frame.rgb.size());
  for (const auto& pixel : frame.rgb) image.rgb.insert(image.rgb.end(), pixel.begin(), pixel.end());
  return image;
}

/// An image of the folder itself, so that a damaged file cannot name any other.
fs::path image_named(const fs::path& folder, std::string_view name, const TextPlace& place) {
  const fs::path file(trimmed(name));
  if (file.empty() || file != file.filename() || !fs::exists(folder / file)) {
    throw BadInput("{}: no image `{}` in {}", to_string(place), file.string(), folder.string());
  }
  return folder / file;
}

RecordedFrame frame_of(std::string_view row, const std::vector<FrameCamera>& cameras,
                       const TextPlace& place) {
  std::vector<std::string_view> cells = split(row, ',');
  cells.resize(12);
  const auto camera = std::ranges::find(cameras, cells[1], &FrameCamera::name);
  if (camera == cameras.end()) {
    throw BadInput("{}: camera `{}` is not in {}", to_string(place), cells[1], kCamerasFile);
  }
  std::array<double, 8> numbers{};  // time x y z qx qy qz qw
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = to_number(cells[i + 2], place, "time or pose");
  }
  const fs::path folder = place.file.parent_path();
  return {.iteration = to_count(cells[0], place, "iteration"),
          .camera = static_cast<std::size_t>(camera - cameras.begin()),
          .time_s = numbers[0],
          .T_world_camera = to_pose(std::span(numbers).subspan<1>(), place),
          .colour = image_named(folder, cells[10], place),
          .depth = image_named(folder, cells[11], place)};
}

FrameCamera frame_camera_of(const CameraModel& camera) {
  FrameCamera frame = {camera.config.name, camera.config.width_px, camera.config.height_px,
                       camera.fx_px,       camera.fy_px,           camera.cx_px,
                       camera.cy_px};
  if (camera.lens && !camera.lens->is_pinhole()) frame.lens = camera.lens;
  return frame;
}

Json json_of(const FrameCamera& camera) {
  Json json = {
      {"name", camera.name}, {"width_px", camera.width_px}, {"height_px", camera.height_px}};
  for (const auto& [name, number] : kCameraNumbers) json[name] = camera.*number;
  if (!camera.lens) return json;
  const DistortionConfig& distortion = camera.lens->distortion();
  json["skew_px"] = camera.skew_px();
  json["distortion"] = {{"model", distortion_name(distortion.model)}};
  for (const auto& [name, member] : kCoefficients) json["distortion"][name] = distortion.*member;
  json["distortion"]["max_angle_rad"] = distortion.max_angle_rad;
  return json;
}

FrameCamera camera_of(const Json& json) {
  FrameCamera c{json.at("name"), json.at("width_px"), json.at("height_px")};
  for (const auto& [name, number] : kCameraNumbers) c.*number = json.at(name);
  const bool is_camera =
      c.width_px > 0 && c.height_px > 0 && c.fx_px > 0.0 && c.fy_px > 0.0 && c.depth_scale_m > 0.0;
  if (is_camera && json.contains("distortion")) {
    const Json& given = json.at("distortion");
    DistortionConfig distortion;
    distortion.model = distortion_named(given.at("model").get<std::string>());
    for (const auto& [name, member] : kCoefficients) distortion.*member = given.at(name);
    distortion.max_angle_rad = given.at("max_angle_rad");
    const Lens::Pinhole pinhole = {c.fx_px, c.fy_px, c.cx_px, c.cy_px, json.at("skew_px")};
    c.lens = std::make_shared<const Lens>(c.width_px, c.height_px, pinhole, distortion);
  }
  if (is_camera) return c;
  throw BadInput("camera '{}': sizes, focal lengths and depth scale must be positive", c.name);
}

std::vector<FrameCamera> read_cameras(const fs::path& path) {
  const std::string text = read_file(path);
  std::vector<FrameCamera> cameras;
  try {
    for (const Json& entry : Json::parse(text)) cameras.push_back(camera_of(entry));
  } catch (const std::exception& error) {
    throw BadInput("{}: {}", path.string(), json_reason(error));
  }
  return cameras;
}

/// The image, which `file` holds.
template <typename AnyImage>
AnyImage of_size(AnyImage image, const FrameCamera& camera, const fs::path& file) {
  if (image.width_px == camera.width_px && image.height_px == camera.height_px) return image;
  throw BadInput("{}: {} x {} px, but cameras.json says {} x {} px of camera `{}`", file.string(),
                 image.width_px, image.height_px, camera.width_px, camera.height_px, camera.name);
}

std::string none_kept(const fs::path& run) {
  return fmt::format("{}: no frames were kept; {} keeps them", (run / kFramesFolder).string(),
                     command_to_fly_again(run, "--frames"));
}

}  // namespace

std::string frame_stem(std::size_t iteration, const std::string& camera) {
  return fmt::format("{:04}_{}", iteration, camera);
}

FramesFolder::FramesFolder(const fs::path& run, std::vector<CameraModel> cameras)
    : folder_(run / kFramesFolder),
      cameras_(std::move(cameras)),
      poses_((make_folder(folder_), folder_ / kPosesFile), fmt::format("{}\n", kPosesHeader)) {
  Json intrinsics = Json::array();
  for (const CameraModel& camera : cameras_) intrinsics.push_back(json_of(frame_camera_of(camera)));
  write_file_atomically(folder_ / kCamerasFile, intrinsics.dump(2) + "\n");
}

void FramesFolder::write(std::size_t iteration, double time_s, std::span<const DepthFrame> depth,
                         std::span<const ColourFrame> colour) {
  GNBV_CHECK(depth.size() == colour.size(), "{} depth frames, {} colour frames", depth.size(),
             colour.size());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const CameraConfig& camera = cameras_[static_cast<std::size_t>(depth[i].camera)].config;
    const std::string stem = frame_stem(iteration, camera.name);
    write_png(image_of(colour[i], camera), folder_ / (stem + ".rgb.png"), Lasting::the_process);
    write_png(image_of(depth[i], camera), folder_ / (stem + ".depth.png"), Lasting::the_process);
    poses_.write(fmt::format("{},{},{:.3f},{},{}.rgb.png,{}.depth.png\n", iteration, camera.name,
                             time_s, pose_text(depth[i].T_world_camera, ','), stem, stem));
  }
}

bool has_frames(const fs::path& run) {
  const fs::path folder = run / kFramesFolder;
  if (!fs::exists(folder / kPosesFile)) return fs::exists(folder / kCamerasFile);
  const std::string rows = read_file(folder / kPosesFile);
  return trimmed(rows) != kPosesHeader;
}

std::string why_no_frames(const RunRecord& record) {
  const fs::path folder = record.folder / kFramesFolder;
  if (record.scenario.cameras.empty()) {
    return fmt::format("{}: there are no frames: the vehicle has no camera", folder.string());
  }
  if (fs::exists(folder)) {
    return fmt::format("{}: there are no frames: none was taken", folder.string());
  }
  return none_kept(record.folder);
}

FrameRecord read_frames(const fs::path& run) {
  const fs::path folder = run / kFramesFolder;
  if (!fs::exists(folder)) throw BadInput(none_kept(run));
  const std::string again = command_to_fly_again(run, "--frames");
  const fs::path poses = folder / kPosesFile;
  for (const fs::path& file : {poses, folder / kCamerasFile}) {
    if (fs::exists(file)) continue;
    throw BadInput("{}: is missing; {} flies it again and writes it", file.string(), again);
  }
  FrameRecord record{.cameras = read_cameras(folder / kCamerasFile), .frames = {}};
  const std::string text = read_file(poses);
  std::string_view rest(text.data(), text.rfind('\n') + 1);  // a killed run may not end a row
  need_header(trimmed(next_part(rest, '\n')), kPosesHeader, {poses, 1},
              fmt::format("; {} flies the mission again", again));
  const auto take = [&](std::string_view line, const TextPlace& place) {
    const std::string_view row = trimmed(line);
    if (!row.empty()) record.frames.push_back(frame_of(row, record.cameras, place));
  };
  for_each_line(rest, poses, take, 2);
  if (record.frames.empty()) throw BadInput("{}: holds no frame", poses.string());
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

#include "tools/live/camera_stream.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

/// Row-major, as NumPy has it.
void append_matrix(std::string& bytes, const Eigen::MatrixXd& matrix) {
  for (int row = 0; row < matrix.rows(); ++row) {
    for (int column = 0; column < matrix.cols(); ++column) append_bytes(bytes, matrix(row, column));
  }
}

template <typename Value>
void append_all(std::string& bytes, const std::vector<Value>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

/// Magic, version, length, and a dictionary that ends in a line feed, in a multiple of 64 bytes.
std::string npy_head(const CameraConfig& camera) {
  const std::string image = fmt::format("{}, {}", camera.height_px, camera.width_px);
  std::string about = fmt::format(
      "{{'descr': [('sequence', '<u8'), ('time_s', '<f8'), ('K', '<f8', (3, 3)), "
      "('T_body_camera', '<f8', (4, 4)), ('depth_m', '<f4', ({0})), ('rgb', '|u1', ({0}, 3))], "
      "'fortran_order': False, 'shape': ()}}",
      image);
  constexpr std::size_t kBefore = 10;
  about.append(63 - (kBefore + about.size()) % 64, ' ');
  about += '\n';
  const std::string length = {static_cast<char>(about.size() & 0xff),
                              static_cast<char>(about.size() >> 8)};
  return "\x93NUMPY" + std::string{1, 0} + length + about;
}

std::vector<std::string> ffmpeg_command(const CameraConfig& camera, double images_per_s,
                                        const std::string& url) {
  return {"ffmpeg",
          "-v",
          "error",
          "-f",
          "rawvideo",
          "-pixel_format",
          "rgb24",
          "-video_size",
          fmt::format("{}x{}", camera.width_px, camera.height_px),
          "-framerate",
          fmt::format("{}", images_per_s),
          "-i",
          "-",
          "-vf",
          "crop=trunc(iw/2)*2:trunc(ih/2)*2",
          "-c:v",
          "libx264",
          "-preset",
          "ultrafast",
          "-tune",
          "zerolatency",
          "-g",
          "10",  // who comes later sees within ten frames
          "-pix_fmt",
          "yuv420p",
          "-f",
          "rtp",
          url};
}

}  // namespace

std::string npy_of(const CameraModel& camera, std::uint64_t sequence, double time_s,
                   const DepthFrame& depth, const ColourFrame& colour) {
  Eigen::Matrix3d K;
  K << camera.fx_px, camera.config.skew_px, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0,
      1.0;
  std::string bytes = npy_head(camera.config);
  append_bytes(bytes, sequence);
  append_bytes(bytes, time_s);
  append_matrix(bytes, K);
  append_matrix(bytes, camera.T_body_camera.matrix());
  append_all(bytes, depth.depth_m);
  append_all(bytes, colour.rgb);
  return bytes;
}

CameraStream::CameraStream(const RayScene& scene, std::vector<CameraModel> cameras,
                           CameraStreamOptions options)
    : scene_(scene),
      cameras_(std::move(cameras)),
      options_(std::move(options)),
      keeps_files_(!options_.folder.empty()) {
  if (cameras_.empty()) throw BadInput("cameras: there is none to show frames of");
  std::set<std::string> names;
  for (const CameraModel& camera : cameras_) {
    if (names.insert(camera.config.name).second) continue;
    throw BadInput("cameras: two are named '{}', and so would their frames be", camera.config.name);
  }
  if (keeps_files_) make_folder(options_.folder);
  if (!options_.video_url.empty()) {
    video_ = std::make_unique<ChildProcess>(
        ffmpeg_command(cameras_.front().config, options_.rate_hz * options_.speed,
                       options_.video_url),
        // ffmpeg prints what a receiver has to know (SDP); MAVLink's camera protocol says it, too
        ChildOptions{.in = ChildStream::pipe, .out = ChildStream::nothing, .is_apart = true});
    if (video_->start_error() != 0) {
      throw BadInput("--video: needs ffmpeg on the PATH, Debian package ffmpeg");
    }
  }
  thread_ = std::thread([this] { work(); });
}

CameraStream::~CameraStream() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  is_offered_.notify_one();
  thread_.join();
  std::error_code ignored;
  for (const CameraModel& camera : cameras_) {
    if (!options_.folder.empty()) std::filesystem::remove(file_of(camera), ignored);
  }
}

std::filesystem::path CameraStream::file_of(const CameraModel& camera) const {
  return options_.folder / (camera.config.name + ".npy");
}

void CameraStream::offer(const Isometry& T_world_body, double time_s) {
  if (time_s < due_s_) return;
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  if (next_) return;
  const double period_s = 1.0 / options_.rate_hz;
  due_s_ = std::max(due_s_, time_s - period_s) + period_s;
  next_ = Moment{T_world_body, time_s};
  is_offered_.notify_one();
}

void CameraStream::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    is_offered_.wait(lock, [this] { return is_over_ || next_; });
    if (is_over_) return;
    const Moment moment = *next_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      take(moment);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    failure_ = failure;
    next_.reset();
  }
}

void CameraStream::take(const Moment& moment) {
  ++sequence_;
  const RayScene scene = scene_.at(moment.time_s);
  const NoiseKey key{options_.seed, sequence_};
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const CameraModel& camera = cameras_[i];
    const int index = static_cast<int>(i);
    const bool is_shown = i == 0 && video_;
    if (!keeps_files_ && !is_shown) continue;
    const ColourFrame colour = capture_colour(scene, camera, index, moment.T_world_body, 1);
    if (is_shown) {
      video_->write({reinterpret_cast<const char*>(colour.rgb.data()), 3 * colour.rgb.size()});
      if (!video_->is_open()) {
        say("--video: ffmpeg gave up ({}); the flight goes on without video", video_->end().text());
        video_.reset();
      }
    }
    if (!keeps_files_) continue;
    const DepthFrame depth = capture_depth(scene, camera, index, moment.T_world_body, key, 1);
    try {
      write_file_atomically(file_of(camera),
                            npy_of(camera, sequence_, moment.time_s, depth, colour),
                            Lasting::the_process);
    } catch (const std::exception& error) {
      keeps_files_ = false;
      say("--frames: {}; the flight goes on without frames", error.what());
    }
  }
}

}  // namespace gnbv

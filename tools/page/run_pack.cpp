#include "tools/page/run_pack.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/planners.hpp"
#include "sim/core/error.hpp"
#include "tools/page/frames_seen.hpp"
#include "tools/page/packs.hpp"
#include "tools/run/run_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPointBytes = 7;  // place and error
constexpr std::size_t kColourBytes = 3;

class RunPacker {
 public:
  RunPacker(const RunRecord& record, const KnownStructure* known, const RunBudget& budget,
            int threads, const ShareDone& progress, page::Arrays& arrays, page::RunData& run)
      : record_(record),
        known_(known),
        budget_(budget),
        threads_(threads),
        progress_(progress),
        arrays_(arrays),
        run_(run),
        begin_(arrays.bytes().size()) {}

  void pack() {
    if (!record_.path.empty()) run_.path = pack_path(record_.path, left() / 8, arrays_);
    if (traits_of(record_.scenario.planner).makes_tours) {
      unless_damaged([&] { run_.plan = pack_plan(record_, left() / 8, arrays_); });
    }
    unless_damaged([&] { run_.candidates = pack_candidates(record_, left() / 3, arrays_); });
    unless_damaged([&] { run_.beliefs = pack_beliefs(record_, left() / 8, arrays_); });
    if (auto why = why_no_beliefs(record_); !why.empty()) run_.missing.push_back(std::move(why));
    unless_damaged([&] { run_.surface = pack_surface(record_, left() / 3, arrays_); });
    bool has_cloud = false;
    unless_damaged([&] {
      cloud_ = read_run_cloud(record_);
      has_cloud = true;
      pack_growth();
    });
    if (!has_frames(record_.folder)) {
      run_.missing.push_back(fmt::format("{}: colour images were not kept; {} keeps them",
                                         (record_.folder / kFramesFolder).string(),
                                         command_to_fly_again(record_.folder, "--frames")));
    }
    if (has_cloud || RunFiles(record_.folder).find(kCloudFile)) {
      pack_points();
      unless_damaged([&] { pack_frames(); });
    } else {
      unless_damaged([&] { pack_growing(); });
    }
  }

 private:
  /// The page does without what cannot be read.
  template <typename Pack>
  void unless_damaged(const Pack& pack) {
    try {
      pack();
    } catch (const BadInput& error) {
      run_.missing.emplace_back(error.what());
    }
  }

  /// Of the budget, after the counts and the padding of what is still to come.
  std::size_t left() const {
    constexpr std::size_t kPaddingBytes = 200;
    const std::size_t used =
        arrays_.bytes().size() - begin_ + 16 * (record_.views.size() + 1) + kPaddingBytes;
    return budget_.bytes - std::min(budget_.bytes, used);
  }

  void pack_growth() {
    if (known_ != nullptr && !known_->to_find.codes.empty() && record_.views.size() < kNeverFound) {
      run_.found = arrays_.add(views_until_found(known_->to_find, cloud_));
    }
    run_.voxels =
        pack_voxels(cloud_, record_.scenario.planner.map.resolution_m, left() / 4, arrays_);
  }

  void pack_points() {
    if (cloud_.points_world_m.empty()) return;
    const std::size_t room = has_frames(record_.folder)
                                 ? left() / 10 * 6 / (kPointBytes + kColourBytes)
                                 : left() / kPointBytes;
    thin_ = thinned(cloud_.points_world_m,
                    std::clamp(room, kLeastElements, std::max(kLeastElements, budget_.points)),
                    std::max(record_.scenario.planner.cloud.leaf_m, 1e-3));
    run_.cloud =
        pack_cloud(cloud_, thin_, known_ == nullptr ? nullptr : &known_->scene, threads_, arrays_);
  }

  void pack_frames() {
    if (!has_frames(record_.folder)) return;
    const FrameRecord frames = read_frames(record_.folder);
    FramesSeen seen = look_at_frames(record_, frames, cloud_, thin_.kept, threads_, progress_);
    add(frames, std::move(seen.thumbnails), seen.colour);
  }

  /// Of a run that still flies what its frames show.
  void pack_growing() {
    if (!has_frames(record_.folder)) return;
    const FrameRecord frames = read_frames(record_.folder);
    FramesSeen seen = look_at_growing_frames(record_, frames, threads_, progress_, cloud_);
    run_.missing.emplace_back(
        "Points are those of the depth images until then, without the profile's; what of the "
        "surface was found is told when the mission has ended");
    pack_points();
    std::vector<Rgb8> colour;
    for (const std::size_t i : thin_.kept) colour.push_back(seen.colour[i]);
    add(frames, std::move(seen.thumbnails), colour);
  }

  void add(const FrameRecord& frames, std::vector<Thumbnail> thumbnails,
           std::span<const Rgb8> colour) {
    if (run_.cloud) {
      std::vector<std::uint8_t> bytes;
      for (const Rgb8& rgb : colour) bytes.insert(bytes.end(), rgb.begin(), rgb.end());
      run_.cloud->colour = arrays_.add<3>(bytes);
    }
    for (const Thumbnail& t : within(std::move(thumbnails), frames, left())) {
      const RecordedFrame& frame = frames.frames[t.frame];
      run_.frames.push_back({.view = frame.iteration,
                             .camera = frames.cameras[frame.camera].name,
                             .width_px = t.width_px,
                             .height_px = t.height_px,
                             .jpeg = arrays_.add(t.jpeg),
                             .depth_jpeg = arrays_.add(t.depth_jpeg)});
    }
  }

  const RunRecord& record_;
  const KnownStructure* known_;
  const RunBudget& budget_;
  int threads_;
  const ShareDone& progress_;
  page::Arrays& arrays_;
  page::RunData& run_;
  std::size_t begin_;  // of the run's arrays
  RunCloud cloud_ = {};
  ThinnedPoints thin_ = {};
};

}  // namespace

void pack_run(const RunRecord& record, const KnownStructure* known, const RunBudget& budget,
              int threads, const ShareDone& progress, page::Arrays& arrays, page::RunData& run) {
  RunPacker(record, known, budget, threads, progress, arrays, run).pack();
}

}  // namespace gnbv

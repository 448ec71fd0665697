
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

struct RunPacker {
  const RunRecord& record;
  const KnownStructure* known;
  const RunBudget& budget;
  int threads;
  const ShareDone& progress;
  page::Arrays& arrays;
  page::RunData& run;
  std::size_t begin = arrays.bytes().size();  // of the run's arrays
  RunCloud cloud = {};
  ThinnedPoints thin = {};

  void pack() {
    if (!record.path.empty()) run.path = pack_path(record.path, left() / 8, arrays);
    if (traits_of(record.scenario.planner).makes_tours) {
      unless_damaged([&] { run.plan = pack_plan(record, left() / 8, arrays); });
    }
    unless_damaged([&] { run.candidates = pack_candidates(record, left() / 3, arrays); });
    unless_damaged([&] { run.beliefs = pack_beliefs(record, left() / 8, arrays); });
    if (auto why = why_no_beliefs(record); !why.empty()) run.missing.push_back(std::move(why));
    unless_damaged([&] { run.surface = pack_surface(record, left() / 3, arrays); });
    bool has_cloud = false;
    unless_damaged([&] {
      cloud = read_run_cloud(record);
      has_cloud = true;
      pack_growth();
    });
    if (!has_frames(record.folder)) run.missing.push_back(why_no_frames(record));
    if (has_cloud || RunFiles(record.folder).find(kCloudFile)) {
      pack_points();
      unless_damaged([&] { pack_frames(); });
    } else {
      unless_damaged([&] { pack_growing(); });
    }
  }

  /// The page does without what cannot be read.
  template <typename Pack>
  void unless_damaged(const Pack& pack) {
    try {
      pack();
    } catch (const BadInput& error) {
      run.missing.emplace_back(error.what());
    }
  }

  /// Of the budget, after the counts and the padding of what is still to come.
  std::size_t left() const {
    constexpr std::size_t kPaddingBytes = 200;
    const std::size_t used =
        arrays.bytes().size() - begin + 16 * (record.views.size() + 1) + kPaddingBytes;
    return budget.bytes - std::min(budget.bytes, used);
  }

  void pack_growth() {
    if (known != nullptr && !known->to_find.codes.empty() && record.views.size() < kNeverFound) {
      run.found = arrays.add(views_until_found(known->to_find, cloud));
    }
    run.voxels = pack_voxels(cloud, record.scenario.planner.map.resolution_m, left() / 4, arrays);
  }

  void pack_points() {
    if (cloud.points_world_m.empty()) return;
    const std::size_t room = has_frames(record.folder)
                                 ? left() / 10 * 6 / (kPointBytes + kColourBytes)
                                 : left() / kPointBytes;
    thin = thinned(cloud.points_world_m,
                   std::clamp(room, kLeastElements, std::max(kLeastElements, budget.points)),
                   std::max(record.scenario.planner.cloud.leaf_m, 1e-3));
    run.cloud =
        pack_cloud(cloud, thin, known == nullptr ? nullptr : &known->scene, threads, arrays);
  }

  void pack_frames() {
    if (!has_frames(record.folder)) return;
    const FrameRecord frames = read_frames(record.folder);
    FramesSeen seen = look_at_frames(record, frames, cloud, thin.kept, threads, progress);
    add(frames, seen.thumbnails, seen.colour);
  }

  /// Of a run that still flies what its frames show.
  void pack_growing() {
    if (!has_frames(record.folder)) return;
    const FrameRecord frames = read_frames(record.folder);
    FramesSeen seen = look_at_growing_frames(record, frames, threads, progress, cloud);
    run.missing.emplace_back(
        "Points are those of the depth images until then, without the profile's; what of the "
        "surface was found is told when the mission has ended");
    pack_points();
    std::vector<Rgb8> colour;
    for (const std::size_t i : thin.kept) colour.push_back(seen.colour[i]);
    add(frames, seen.thumbnails, colour);
  }

  void add(const FrameRecord& frames, const std::vector<Thumbnail>& thumbnails,
           std::span<const Rgb8> colour) {
    if (run.cloud) {
      std::vector<std::uint8_t> bytes;
      for (const Rgb8& rgb : colour) bytes.insert(bytes.end(), rgb.begin(), rgb.end());
      run.cloud->colour = arrays.add<3>(bytes);
    }
    // of every view, or of every second, third ... one, with the least step that fits
    const std::size_t before = arrays.bytes().size();
    const std::size_t most = before + left();
    for (int every = 1; every <= static_cast<int>(thumbnails.size()); ++every) {
      for (const Thumbnail& t : thumbnails) {
        const RecordedFrame& frame = frames.frames[t.frame];
        if (frame.iteration % every != 0) continue;
        run.frames.push_back({.view = frame.iteration,
                              .camera = frames.cameras[frame.camera].name,
                              .width_px = t.width_px,
                              .height_px = t.height_px,
                              .jpeg = arrays.add(t.jpeg),
                              .depth_jpeg = arrays.add(t.depth_jpeg)});
      }
      if (arrays.bytes().size() <= most) return;
      arrays.cut(before);
      run.frames.clear();
    }
  }
};

}  // namespace

void pack_run(const RunRecord& record, const KnownStructure* known, const RunBudget& budget,
              int threads, const ShareDone& progress, page::Arrays& arrays, page::RunData& run) {
  RunPacker{record, known, budget, threads, progress, arrays, run}.pack();
}

}  // namespace gnbv

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "sim/core/error.hpp"
#include "tools/exports/export_folder.hpp"
#include "tools/exports/formats.hpp"
#include "tools/frames/frame_sight.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  fs::path run;
  fs::path out;
  std::string format;
  std::optional<std::size_t> points;
  std::optional<double> depth_factor;
  int threads = 0;
  bool quiet = false;
};

/// What every format is made of. Progress is that of the frames, which take nearly all the time.
struct Export {
  const ExportOptions& options;
  const RunRecord& record;
  int threads;
  ShareDone progress;
};

SparseModel sparse_model(const Export& e, const FrameRecord& frames) {
  const RunCloud cloud = read_run_cloud(e.record);
  SparseModel model =
      make_sparse_model(cloud.points_world_m, frames,
                        {.max_points = e.options.points.value_or(SparseModelOptions{}.max_points),
                         .blur_m = cloud_blur_m(e.record),
                         .threads = e.threads,
                         .progress = e.progress});
  if (!e.options.quiet) {
    say("{} of the cloud's {} points are shown by two of the {} frames or more, in {} observations",
        model.points_world_m.size(), cloud.points_world_m.size(), frames.frames.size(),
        model.observation_count());
  }
  return model;
}

template <auto kWrite>
void fill_sparse(const Export& e, const fs::path& folder) {
  if (!has_frames(e.record.folder)) throw BadInput(why_no_frames(e.record));
  const FrameRecord frames = read_frames(e.record.folder);
  kWrite(frames, sparse_model(e, frames), folder);
}

/// Says so when there are none.
std::optional<FrameRecord> frames_if_kept(const RunRecord& record) {
  if (has_frames(record.folder)) return read_frames(record.folder);
  say(std::string_view(why_no_frames(record)));
  return std::nullopt;
}

/// Says so, with the command that makes it, when it is not all there. Throws for a damaged one.
std::optional<RunCloud> cloud_if_there(const RunRecord& record) {
  const RunFiles files(record.folder);
  const bool is_there = files.find(kCloudFile) && files.find(kProfileCloudFile);
  try {
    return read_run_cloud(record);
  } catch (const BadInput& error) {
    if (is_there) throw;
    say(std::string_view(error.what()));
    return std::nullopt;
  }
}

void fill_tum(const Export& e, const fs::path& folder) {
  const double steps_per_m = e.options.depth_factor.value_or(kTumDepthStepsPerM);
  const std::size_t too_far = write_tum(e.record, frames_if_kept(e.record), steps_per_m, folder);
  if (too_far > 0) {
    say("{} pixels are deeper than {:.1f} m, the most that 16 bits hold at {} steps per metre. "
        "They are written as no depth; a smaller --depth-factor reaches farther",
        too_far, 65535.0 / steps_per_m, steps_per_m);
  }
}

void fill_plain(const Export& e, const fs::path& folder) {
  ExportParts parts{.frames = frames_if_kept(e.record), .cloud = cloud_if_there(e.record)};
  const RunFiles files(e.record.folder);
  if (!files.find(kMapOddsFile)) {
    say("{}: is missing, so that no voxels are written; {} makes one",
        (e.record.folder / kMapOddsFile).string(), command_to_fly_again(e.record.folder));
  }
  if (parts.frames && parts.cloud) {
    parts.colours = colours_of_cloud(e.record, *parts.cloud, *parts.frames, e.threads, e.progress);
  }
  write_plain(e.record, parts, folder);
}

/// What is written is what was flown. Where the structure's file is another one by now, that is
/// told: what needs the structure, as timelines do, is of the new one.
void note_changed_inputs(const RunRecord& record) {
  std::vector<std::string> told_by_run;
  std::vector<RunInput> inputs;
  try {
    inputs = world_inputs(record.scenario, load_world_anywhere(record.scenario, told_by_run));
  } catch (const BadInput&) {
    return;  // moved, as it may be
  }
  try {
    need_same_inputs(record.folder, inputs, "the export is of the mesh that the run flew around");
  } catch (const BadInput& error) {
    say(std::string_view(error.what()));
  }
}

std::optional<TriangleMesh> structure_if_there(const RunRecord& record) {
  try {
    std::vector<std::string> warnings;
    return load_structure(record.scenario, warnings);
  } catch (const BadInput& error) {
    say(std::string_view(error.what()));
    return std::nullopt;
  }
}

void fill_timeline(const Export& e, const fs::path& folder) {
  const std::string written = write_timeline(e.record,
                                             {.frames = frames_if_kept(e.record),
                                              .cloud = cloud_if_there(e.record),
                                              .structure = structure_if_there(e.record)},
                                             e.options.format, folder);
  if (!e.options.quiet) say("{}", written);
}

using Fill = void (*)(const Export&, const fs::path&);
const std::map<std::string, Fill> kFills = {{"colmap", fill_sparse<write_colmap>},
                                            {"mcap", fill_timeline},
                                            {"nerfstudio", fill_sparse<write_nerfstudio>},
                                            {"plain", fill_plain},
                                            {"rerun", fill_timeline},
                                            {"tum", fill_tum}};

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const auto& [name, fill] : kFills) names.push_back(name);
  return names;
}

void export_run(const ExportOptions& options) {
  if (options.points && options.format != "colmap" && options.format != "nerfstudio") {
    throw BadInput("--points: {} has no sparse model", options.format);
  }
  if (options.depth_factor && options.format != "tum") {
    throw BadInput("--depth-factor: {} has a scale of its own", options.format);
  }
  const RunRecord record = read_run(options.run);
  const fs::path folder =
      options.out.empty() ? record.folder / "export" / options.format : options.out;
  ProgressBar bar("export " + options.format, options.quiet);
  const Export e{options, record, thread_count(options.threads),
                 [&](double share) { bar.show(share, "frames"); }};
  write_export_folder(record, options.format, folder,
                      [&](const fs::path& part) { kFills.at(options.format)(e, part); });
  for (const std::string& missing : record.missing) say(missing);
  note_changed_inputs(record);
  fmt::print("{}\n", folder.string());
}

}  // namespace

void add_export_command(CLI::App& app) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* const command = app.add_subcommand("export", "write a run as other programs read it");
  command->add_option("RUN", options->run, "run directory")->required();
  command
      ->add_option("--format", options->format,
                   "format of the folder. Images have the poses that the vehicle believed; tum "
                   "also has the true ones. rerun and mcap are written in Python")
      ->required()
      ->check(is_one_of(format_names()));
  command->add_option(
      "-o,--out", options->out,
      "folder to write (default: RUN/export/FORMAT); an earlier export is replaced");
  command
      ->add_option("--points", options->points,
                   "most points in the sparse model (colmap, nerfstudio; default: 100000)")
      ->check(CLI::Range(1, 100'000'000));
  command
      ->add_option("--depth-factor", options->depth_factor,
                   "steps per metre in depth images (tum; default: 5000, as in the TUM benchmark)")
      ->check(CLI::Range(1.0, 65535.0));
  add_threads_option(*command, options->threads);
  add_quiet_option(*command, options->quiet, "progress, no notes");
  command->callback([options] { export_run(*options); });
}

}  // namespace gnbv

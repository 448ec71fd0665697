#include "tools/run/run_files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <span>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/run/summary_json.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kGrowing = {kIterationsFile, kCandidatesFile,
                                                      kBeliefsFile};
constexpr std::array<std::string_view, 10> kWrittenAtTheEnd = {
    kSummaryFile, kCoverageFile, kTrajectoryFile, kCloudFile,       kProfileCloudFile,
    kMapFile,     kMapOddsFile,  kViewsFile,      kPredictionsFile, kPlanFile};

bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

std::ptrdiff_t lines_of(const fs::path& file) {
  const std::string text = is_there(file) ? read_file(file) : "";
  return std::count(text.begin(), text.end(), '\n');
}

}  // namespace

RunFiles::RunFiles(fs::path folder) : folder_(std::move(folder)) {
  const fs::path csv = folder_ / kIterationsFile;
  goes_on_ = is_there(part_of(csv)) && (!is_there(csv) || lines_of(part_of(csv)) > lines_of(csv));
}

std::optional<fs::path> RunFiles::find(std::string_view name) const {
  const fs::path file = folder_ / name;
  const bool is_record = name == kIterationsFile;
  if (is_one_of(kWrittenAtTheEnd, name) && goes_on_) return std::nullopt;
  if (is_record ? goes_on_ : is_one_of(kGrowing, name) && is_there(part_of(file))) {
    return part_of(file);
  }
  return is_there(file) ? std::optional(file) : std::nullopt;
}

bool RunFiles::is_finished() const {
  for (const char* name : {kScenarioFile, kTrajectoryFile, kCloudFile, kProfileCloudFile,
                           kIterationsFile, kCoverageFile, kMapFile, kSummaryFile}) {
    if (!find(name)) return false;
  }
  try {
    const auto termination = read_summary(folder_).termination;
    return termination && *termination != "interrupted";
  } catch (const BadInput&) {
    return false;
  }
}

std::string whole_lines(const fs::path& file) {
  std::string text = read_file(file);
  if (file.extension() == ".part") text.resize(text.rfind('\n') + 1);  // npos + 1: none
  return text;
}

GrowingFile::GrowingFile(fs::path path, std::string_view text) : path_(std::move(path)) {
  write_file_atomically(path_, text, Lasting::the_process);
  file_.open(path_, std::ios::binary | std::ios::app);
  write("");
}

void GrowingFile::write(std::string_view text) {
  errno = 0;
  file_ << text << std::flush;
  if (!file_) refuse_to_write(path_, errno);
}

std::string command_to_resume(const fs::path& folder, const std::string& options) {
  std::error_code ignored;
  const auto keeps = [&](const fs::path& name) { return fs::exists(folder / name, ignored); };
  const bool has_candidates = keeps(kCandidatesFile) || keeps(part_of(kCandidatesFile));
  return fmt::format(
      "`gnbv run {} {}--resume --out {}{}{}`", shell_word((folder / kScenarioFile).string()),
      options.empty() ? "" : options + " ", shell_word(folder.string()),
      keeps(kFramesFolder) ? " --frames" : "", has_candidates ? " --candidates" : "");
}

std::string command_to_fly_again(const fs::path& folder, const std::string& options) {
  return fmt::format("`gnbv run {} {}--out NEW`", shell_word((folder / kScenarioFile).string()),
                     options.empty() ? "" : options + " ");
}

}  // namespace gnbv

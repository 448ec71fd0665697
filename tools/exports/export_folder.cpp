#include "tools/exports/export_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "gnbv-export.json";
constexpr const char* kSchema = "gnbv-export-1";

bool is_export(const fs::path& folder) {
  if (!fs::is_regular_file(folder / kMarker)) return false;
  const auto marker = nlohmann::json::parse(read_file(folder / kMarker), nullptr, false);
  return marker.is_object() && marker.value("schema", "") == kSchema;
}

void need_place_for(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (fs::is_directory(folder) && (fs::is_empty(folder) || is_export(folder))) return;
  throw BadInput(
      fmt::format("{}: is there and no earlier export: nothing is written over it; -o names "
                  "another folder",
                  folder.string()));
}

std::string marker_text(const RunRecord& record, std::string_view format) {
  const nlohmann::ordered_json marker = {{"schema", kSchema},
                                         {"format", format},
                                         {"written_by", "gnbv " GNBV_VERSION},
                                         {"scenario", record.scenario.name},
                                         {"utility", record.scenario.planner.utility.name},
                                         {"seed", record.scenario.seed}};
  return marker.dump(2) + "\n";
}

/// The folder beside it that is filled, and what was there before on its way out.
fs::path beside(const fs::path& folder, const char* what) {
  return folder.parent_path() /
         fmt::format(".{}.{}-{}", folder.filename().string(), what, getpid());
}

void take_place(const fs::path& part, const fs::path& folder) {
  const fs::path old = beside(folder, "old");
  const bool was_there = fs::exists(folder);
  if (was_there) fs::rename(folder, old);
  std::error_code error;
  fs::rename(part, folder, error);
  if (error && was_there) fs::rename(old, folder);
  if (error) throw fs::filesystem_error("rename", folder, error);
  fs::remove_all(old);
}

}  // namespace

void write_export_folder(const RunRecord& record, std::string_view format, const fs::path& folder,
                         const std::function<void(const fs::path&)>& fill) {
  // "." and "a/" have no name of their own to rename to
  fs::path place = fs::absolute(folder).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();
  fs::path part;
  try {
    need_place_for(place);
    part = beside(place, "part");
    fs::remove_all(part);
    fs::create_directories(part);
    fill(part);
    write_file_atomically(part / kMarker, marker_text(record, format));
    take_place(part, place);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    if (!part.empty()) fs::remove_all(part, ignored);
    throw BadInput(fmt::format("{}: cannot write: {}", folder.string(), error.code().message()));
  } catch (...) {
    std::error_code ignored;
    if (!part.empty()) fs::remove_all(part, ignored);
    throw;
  }
}

void link_or_copy(const fs::path& file, const fs::path& second_name) {
  std::error_code error;
  fs::create_directories(second_name.parent_path(), error);
  if (!error) fs::create_hard_link(file, second_name, error);
  if (!error) return;
  fs::copy_file(file, second_name, error);
  if (error) {
    throw BadInput(fmt::format("{}: cannot write: {}", second_name.string(), error.message()));
  }
}

std::string frame_number(const RecordedFrame& frame) {
  return fmt::format("{:06}", frame.iteration);
}

std::string file_word(const FrameCamera& camera) {
  const bool is_word = !camera.name.empty() && camera.name.front() != '.' &&
                       std::all_of(camera.name.begin(), camera.name.end(), [](char c) {
                         return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                                (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
                       });
  if (is_word) return camera.name;
  throw BadInput(fmt::format(
      "cameras.json: camera '{}' cannot name files: only letters, digits, '.', '_' and '-' can",
      camera.name));
}

}  // namespace gnbv

#include "tools/exports/export_folder.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "gnbv-export-1";

/// All that is in the folder, by the path from there; folders only as far as they hold something.
std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink()) continue;
    files.push_back(entry.path().lexically_relative(folder).generic_string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The files that an export wrote there, ascending; nothing when the folder is no export.
std::optional<std::vector<std::string>> exported_files(const fs::path& folder) {
  if (!fs::is_regular_file(folder / kExportMarker)) return std::nullopt;
  const auto marker = nlohmann::json::parse(read_file(folder / kExportMarker), nullptr, false);
  if (!marker.is_object() || marker.value("schema", "") != kSchema) return std::nullopt;
  std::vector<std::string> files = {kExportMarker};
  for (const auto& file : marker.value("files", nlohmann::json::array())) {
    if (file.is_string()) files.push_back(file.get<std::string>());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void need_place_for(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (fs::is_directory(folder) && fs::is_empty(folder)) return;
  const auto own = exported_files(folder);
  if (!own) {
    throw BadInput(
        "{}: is there and no earlier export: nothing is written over it; -o names another folder",
        folder.string());
  }
  const std::vector<std::string> there = files_in(folder);
  std::vector<std::string> foreign;
  std::ranges::set_difference(there, *own, std::back_inserter(foreign));
  if (foreign.empty()) return;
  throw BadInput(
      "{}: holds files that no export wrote, {} for one ({} in all): remove them, or let -o name "
      "another folder",
      folder.string(), foreign.front(), foreign.size());
}

std::string marker_text(const RunRecord& record, std::string_view format,
                        const std::vector<std::string>& files) {
  const nlohmann::ordered_json marker = {
      {"schema", kSchema},
      {"format", format},
      {"written_by", "gnbv " GNBV_VERSION},
      {"scenario", record.scenario.name},
      {"utility", utility_label(record.scenario.planner.utility)},
      {"seed", record.scenario.seed},
      {"files", files}};
  return marker.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// The folder beside it that is filled ("part"), and what was there before on its way out ("old").
/// The names are always the same, so that the next export clears up after one that was killed.
fs::path beside(const fs::path& folder, const char* what) {
  return folder.parent_path() / fmt::format(".{}.gnbv-{}", folder.filename().string(), what);
}

/// What a killed export left: of a half-finished exchange the earlier export comes back.
void clear_up(const fs::path& folder) {
  const fs::path old = beside(folder, "old");
  if (fs::exists(old) && !fs::exists(folder)) fs::rename(old, folder);
  fs::remove_all(old);
  fs::remove_all(beside(folder, "part"));
}

void take_place(const fs::path& part, const fs::path& folder) {
  const fs::path old = beside(folder, "old");
  const bool was_there = fs::exists(folder);
  if (was_there) fs::rename(folder, old);
  std::error_code error;
  fs::rename(part, folder, error);
  if (error && was_there) fs::rename(old, folder);
  if (error) throw fs::filesystem_error("rename", folder, error);
  sync_to_disk(folder.parent_path());
  fs::remove_all(old);
}

/// The topmost of a path's folders that is not there; "" when all are.
fs::path first_missing(fs::path folder) {
  fs::path missing;
  for (; !folder.empty() && !fs::exists(fs::symlink_status(folder)); folder = folder.parent_path())
    missing = folder;
  return missing;
}

}  // namespace

void write_export_folder(const RunRecord& record, std::string_view format, const fs::path& folder,
                         const std::function<void(const fs::path&)>& fill) {
  // "." and "a/" have no name of their own to rename to
  fs::path place = fs::absolute(folder).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();
  if (fs::is_symlink(place) && fs::exists(place)) place = fs::canonical(place);  // the link stays
  const fs::path part = beside(place, "part");
  fs::path made;
  const auto undo = [&] {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    // the folders above, which stay as soon as they hold anything
    for (fs::path above = place.parent_path(); !made.empty(); above = above.parent_path()) {
      if (fs::is_directory(fs::symlink_status(above, ignored))) fs::remove(above, ignored);
      if (above == made) break;
    }
  };
  try {
    made = first_missing(place.parent_path());
    clear_up(place);
    need_place_for(place);
    fs::create_directories(part);
    fill(part);
    write_file_atomically(part / kExportMarker, marker_text(record, format, files_in(part)));
    take_place(part, place);
  } catch (const fs::filesystem_error& error) {
    undo();
    refuse_to_write(folder, error.code().value());
  } catch (...) {
    undo();
    throw;
  }
}

void link_or_copy(const fs::path& file, const fs::path& second_name) {
  std::error_code error;
  fs::create_directories(second_name.parent_path(), error);
  if (!error) fs::create_hard_link(file, second_name, error);
  if (!error) return;
  write_file_atomically(second_name, read_file(file));
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
  throw BadInput(
      "cameras.json: camera '{}' cannot name files: only letters, digits, '.', '_' and '-' can",
      camera.name);
}

void need_no_skew(const FrameCamera& camera, std::string_view program) {
  if (camera.skew_px() == 0.0) return;
  throw BadInput("camera '{}': {} has no camera with skew_px = {}; --format plain has", camera.name,
                 program, camera.skew_px());
}

std::string image_name(const FrameRecord& frames, const RecordedFrame& frame) {
  return fmt::format("{}_{}.png", frame_number(frame), file_word(frames.cameras[frame.camera]));
}

void link_images(const FrameRecord& frames, const fs::path& folder) {
  for (const RecordedFrame& frame : frames.frames) {
    const std::string name = image_name(frames, frame);
    link_or_copy(frame.colour, folder / "images" / name);
    link_or_copy(frame.depth, folder / "depth" / name);
  }
}

}  // namespace gnbv

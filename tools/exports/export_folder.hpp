// Folders of files for other programs, that are either whole or not there.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "tools/run/frames_folder.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// The file by which a folder is known as an export.
constexpr const char* kExportMarker = "gnbv-export.json";

/// Fills a folder beside `folder`, which then takes that name: nobody sees a part of it. It also
/// gets gnbv-export.json, which says what it is and lists its files. Takes the place of an earlier
/// export or of an empty folder; throws BadInput naming `folder` when anything else is there, also
/// among the files of an earlier export, before `fill` runs, or when it cannot be written. What an
/// export left that was killed is cleared up first.
void write_export_folder(const RunRecord& record, std::string_view format,
                         const std::filesystem::path& folder,
                         const std::function<void(const std::filesystem::path&)>& fill);

/// Gives `file` a second name: a hard link where the file system can, else a copy. Makes the
/// folders above it. Throws BadInput naming the path.
void link_or_copy(const std::filesystem::path& file, const std::filesystem::path& second_name);

/// "000007": numbers of one width, so that names sort as the frames were taken.
std::string frame_number(const RecordedFrame& frame);

/// The camera's name as part of file names. Throws BadInput when it cannot be one.
std::string file_word(const FrameCamera& camera);

/// Throws BadInput for a camera with skewed rows, which that program's cameras do not have.
void need_no_skew(const FrameCamera& camera, std::string_view program);

/// "000007_rgbd.png": of a frame's images, where one folder holds those of all cameras.
std::string image_name(const FrameRecord& frames, const RecordedFrame& frame);

/// Links them into images/ and depth/ of the folder.
void link_images(const FrameRecord& frames, const std::filesystem::path& folder);

}  // namespace gnbv

// The readers behind read_cloud() (tools/run/cloud_file.hpp), a format each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// What the points of a file go to. Single precision comes last: what a map grid's offset would
/// round off is kept.
struct CloudPoints {
  std::filesystem::path path;  // for messages
  Vec3 offset_m = Vec3::Zero();
  std::vector<Vec3f> points_m = {};
  std::vector<std::string> warnings = {};  // what is left out, a sentence each

  void add(const Vec3& p_file_m) { points_m.push_back((p_file_m + offset_m).cast<float>()); }
  /// Throws BadInput naming the file, and the line, counted from 1, where there is one.
  [[noreturn]] void fail(const std::string& what, std::size_t line = 0) const;
  /// Warns of what was passed over; nothing for none of it.
  void left_out(std::uint64_t count, const std::string& what);
};

/// Rows of numbers between blanks, commas or semicolons: the first three, or those under x, y and z
/// where the first row names its columns. A comma parts nothing in a row with semicolons or tabs,
/// and a decimal comma is refused. A row of one whole number before them says how many
/// follow (PTS, which may hold several such blocks). Empty rows and those that begin with #, // or
/// % are none.
void read_text_cloud(CloudPoints& to);
/// PCD: ascii, binary, binary_compressed. Points that are not finite are what an organised cloud
/// has where nothing returned: they are left out, with a warning.
void read_pcd_cloud(CloudPoints& to);
/// LAS 1.0 to 1.4, without its compressed kind. Points beyond those announced are left out, with a
/// warning.
void read_las_cloud(CloudPoints& to);

}  // namespace gnbv

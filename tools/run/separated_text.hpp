// Text files of numbers in columns, with errors that name file and line; the text of JSON files.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Without blanks at either end.
std::string_view trimmed(std::string_view text);

/// Cuts off and returns the part before the next `separator`; all of it without one.
std::string_view next_part(std::string_view& rest, char separator);

/// All parts of a row.
std::vector<std::string_view> split(std::string_view row, char separator);

/// The fields of a record of RFC 4180 that is one line.
std::vector<std::string> csv_fields(std::string_view record);

/// `FILE:LINE`, as errors begin.
struct TextPlace {
  const std::filesystem::path& file;
  int line;
};
std::string to_string(const TextPlace& place);

/// The text of a JSON file. Throws BadInput naming it where its lists lie deeper than whoever
/// copies or prints a value can go: they call themselves for each level.
std::string read_json_text(const std::filesystem::path& file);

/// Calls `take` with each line and its place; lines count from `first`.
void for_each_line(std::string_view text, const std::filesystem::path& file,
                   const std::function<void(std::string_view row, const TextPlace& place)>& take,
                   int first = 1);

/// The finite number that is all of the text. Throws BadInput naming place, `what` and text.
double to_number(std::string_view text, const TextPlace& place, std::string_view what);

/// The same for a count: whole, and from 0 to 10^9.
int to_count(std::string_view text, const TextPlace& place, std::string_view what);

/// What is wrong with a JSON text, without the library's own number of the error.
std::string json_reason(const std::exception& error);

/// Throws BadInput naming the place, and `help`, for a first row that is not `header`.
void need_header(std::string_view row, std::string_view header, const TextPlace& place,
                 std::string_view help = "");

/// "x y z qx qy qz qw" of a pose, with `separator` between them: micrometres, unit quaternion.
std::string pose_text(const Isometry& T, char separator);

/// The pose of these seven numbers. Throws BadInput naming the place for no unit quaternion.
Isometry to_pose(std::span<const double, 7> numbers, const TextPlace& place);

}  // namespace gnbv

#include "tools/run/cloud_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/ply_write.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {

namespace {

/// Whether a line is three numbers with a decimal comma each, which commas between numbers would
/// be taken for.
bool has_decimal_commas(std::string_view line) {
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = take_word(line);
    const std::size_t comma = word.find(',');
    const bool is_between_digits = comma != word.npos && comma > 0 && comma + 1 < word.size();
    if (!is_between_digits || word.find(',', comma + 1) != word.npos) return false;
  }
  return true;
}

/// The next number of a line, which is cut off; nothing where there is none.
std::optional<float> take_number(std::string_view& line) {
  constexpr std::string_view kBetween = " \t\r,;";
  line.remove_prefix(std::min(line.find_first_not_of(kBetween), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBetween));
  line.remove_prefix(word.size());
  const auto value = read_decimal(word);
  return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
}

std::vector<Vec3f> read_xyz_cloud(const std::filesystem::path& path) {
  std::ifstream file = open_file(path);
  std::vector<Vec3f> points_m;
  LineReader lines(file);
  for (std::string_view whole; lines.next(whole);) {
    const std::size_t first = whole.find_first_not_of(" \t\r");
    if (first == std::string::npos || whole[first] == '#') continue;
    std::string_view line = whole;
    if (has_decimal_commas(line)) {
      throw BadInput(fmt::format("{}:{}: '{}' has decimal commas: write decimal points",
                                 path.string(), lines.number(), whole.substr(0, 60)));
    }
    Vec3f p_m;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto value = take_number(line);
      if (!value) {
        throw BadInput(fmt::format("{}:{}: '{}' does not begin with three numbers", path.string(),
                                   lines.number(), whole.substr(0, 60)));
      }
      p_m[axis] = *value;
    }
    points_m.push_back(p_m);
  }
  if (file.bad()) throw BadInput(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  return points_m;
}

}  // namespace

void write_cloud_ply(std::span<const Vec3f> points_world_m, const std::filesystem::path& path,
                     const CloudColumns& columns) {
  write_file_atomically(path, ply_bytes({.places_world_m = points_world_m,
                                         .colours = columns.colours,
                                         .views = columns.views}));
}

std::vector<Vec3f> read_cloud(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension != ".ply" && extension != ".xyz") {
    throw BadInput(fmt::format("{}: a cloud is a .ply or an .xyz file", path.string()));
  }
  return extension == ".ply" ? read_ply_points(path) : read_xyz_cloud(path);
}

}  // namespace gnbv

#include "tools/run/cloud_file.hpp"

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "sim/mesh/ply_write.hpp"
#include "sim/mesh/polygon_mesh.hpp"
#include "tools/run/cloud_formats.hpp"

namespace gnbv {

void write_cloud_ply(std::span<const Vec3f> points_world_m, const std::filesystem::path& path,
                     const CloudColumns& columns) {
  write_file_atomically(path, ply_bytes({.places_world_m = points_world_m,
                                         .colours = columns.colours,
                                         .views = columns.views}));
}

void CloudPoints::fail(const std::string& what, std::size_t line) const {
  const std::string place = line > 0 ? fmt::format(":{}", line) : "";
  throw BadInput("{}{}: {}", path.string(), place, printable(what));
}

void CloudPoints::left_out(std::uint64_t count, const std::string& what) {
  if (count > 0) {
    warnings.push_back(fmt::format("{}: {} {} left out", path.string(), count, what));
  }
}

std::vector<Vec3f> read_cloud(const std::filesystem::path& path, const Vec3& offset_m,
                              std::vector<std::string>* warnings) {
  const std::string extension = extension_of(path);
  CloudPoints points{.path = path, .offset_m = offset_m};
  const auto reader = [&]() -> void (*)(CloudPoints&) {
    if (extension == ".ply") {
      return
          [](CloudPoints& to) { to.points_m = read_ply_points(to.path, to.offset_m, to.warnings); };
    }
    if (extension == ".pcd") return read_pcd_cloud;
    if (extension == ".las" || extension == ".laz") return read_las_cloud;
    for (const char* text : {".xyz", ".pts", ".txt", ".asc", ".csv", ".xyzn", ".xyzrgb"}) {
      if (extension == text) return read_text_cloud;
    }
    throw BadInput(
        "{}: a cloud is a .ply, .pcd, .las, .xyz, .pts, .txt, .asc or .csv file; CloudCompare "
        "turns others into .ply",
        path.string());
  }();
  reader(points);
  if (warnings != nullptr) {
    warnings->insert(warnings->end(), points.warnings.begin(), points.warnings.end());
  }
  return std::move(points.points_m);
}

}  // namespace gnbv

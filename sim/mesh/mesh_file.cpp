#include "sim/mesh/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

using Matrix4 = Eigen::Matrix4d;

constexpr std::array<std::string_view, 6> kFormats = {".obj", ".ply",  ".stl",
                                                      ".dae", ".gltf", ".glb"};

void check_config(const MeshFileConfig& config) {
  const auto need = [](bool holds, const std::string& fault) {
    if (!holds) throw BadInput("mesh: " + fault);
  };
  const auto& [path, scale, yaw_rad, offset_m, up, unit_m] = config;
  need(!path.empty(), "path is empty");
  need(scale > 0.0 && std::isfinite(scale), fmt::format("scale = {} is not positive", scale));
  need(unit_m >= 0.0 && std::isfinite(unit_m),
       fmt::format("unit_m = {} is neither positive nor 0", unit_m));
  need(offset_m.allFinite(), "offset_m is not finite");
  need(std::isfinite(yaw_rad), "yaw is not finite");
  need(up == "auto" || up == "x" || up == "y" || up == "z",
       fmt::format("up_axis = {} is none of auto, x, y, z", up));
}

void check_file(const std::string& path, const std::string& extension) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) read_file(path);  // throws, with the cause
  if (std::filesystem::file_size(path, ignored) == 0) {
    throw BadInput(fmt::format("{}: is empty", path));
  }
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end()) {
    throw BadInput(fmt::format("{}: '{}' is no known mesh format, only {} are", path, extension,
                               fmt::join(kFormats, ", ")));
  }
}

std::string_view without_blanks(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(" \t\v\f\r\n"), text.size()));
}

/// The number in meter="0.01"; nothing where the tag has none.
std::optional<double> meter_of(std::string_view tag) {
  constexpr std::string_view kName = "meter";
  for (auto at = tag.find(kName); at != tag.npos; at = tag.find(kName, at + 1)) {
    std::string_view rest = without_blanks(tag.substr(at + kName.size()));
    if (!rest.starts_with('=')) continue;  // it is the value of another attribute
    rest = without_blanks(rest.substr(1));
    if (!rest.starts_with('"') && !rest.starts_with('\'')) continue;
    rest = without_blanks(rest.substr(1));
    return read_decimal(rest.substr(0, rest.find_first_of(" \t\r\n\"'")));
  }
  return std::nullopt;
}

DeclaredAxes declared_by(const std::string& path, const std::string& extension) {
  if (extension == ".dae") return declared_by_collada(read_file(path));
  if (extension == ".gltf" || extension == ".glb") return {1.0, 'y'};
  return {};
}

/// From what a reader delivers to the world. Of a COLLADA file assimp has applied the unit, and has
/// turned it to y up unless the config names the axis.
Matrix4 T_world_read(const MeshFileConfig& config, const MeshReading& reading) {
  const bool is_collada = extension_of(config.path) == ".dae";
  const double unit_m = reading.unit_m / (is_collada ? reading.declared.unit_m.value() : 1.0);
  const char up = is_collada && config.up_axis == "auto" ? 'y' : reading.up_axis;
  Matrix4 T = Matrix4::Identity();
  T.topLeftCorner<3, 3>() = unit_m * config.scale * R_yaw(config.yaw_rad) * R_z_up(up);
  T.topRightCorner<3, 1>() = config.offset_m;
  return T;
}

TriangleMesh read_polygons(const MeshFileConfig& config, const Matrix4& T_world_file,
                           MeshReading& reading) {
  const bool is_obj = extension_of(config.path) == ".obj";
  PolygonMesh polygons = (is_obj ? read_obj : read_ply)(config.path, reading.warnings);
  if (polygons.face_ends.empty()) throw BadInput(fmt::format("{}: holds no faces", config.path));
  for (Vec3& p : polygons.vertices) {
    p = (T_world_file.topLeftCorner<3, 3>() * p + T_world_file.topRightCorner<3, 1>()).eval();
  }
  reading.not_finite = std::move(polygons.not_finite);
  return triangulated(std::move(polygons));
}

}  // namespace

MeshReading read_mesh(const MeshFileConfig& config) {
  check_config(config);
  const std::string extension = extension_of(config.path);
  check_file(config.path, extension);
  MeshReading reading;
  reading.declared = declared_by(config.path, extension);
  reading.unit_m = config.unit_m > 0.0 ? config.unit_m : reading.declared.unit_m.value_or(1.0);
  reading.up_axis =
      config.up_axis != "auto" ? config.up_axis[0] : reading.declared.up_axis.value_or('z');
  const Matrix4 T_world = T_world_read(config, reading);
  const bool is_own = extension == ".obj" || extension == ".ply";
  reading.mesh = is_own ? read_polygons(config, T_world, reading) : import_mesh(config, T_world);
  const auto& vertices = reading.mesh.vertices_m;
  const auto bad =
      std::find_if(vertices.begin(), vertices.end(), [](const Vec3f& p) { return !p.allFinite(); });
  if (bad != vertices.end() && reading.not_finite.empty()) {
    reading.not_finite = fmt::format("{}: vertex {} comes to lie at ({}, {}, {}) m", config.path,
                                     bad - vertices.begin(), bad->x(), bad->y(), bad->z());
  }
  return reading;
}

TriangleMesh load_mesh(const MeshFileConfig& config, std::vector<std::string>* warnings) {
  MeshReading reading = read_mesh(config);
  if (!reading.not_finite.empty()) throw BadInput(reading.not_finite);
  TriangleMesh& mesh = reading.mesh;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (is_flat(mesh, i)) continue;
    mesh.faces[kept] = mesh.faces[i];
    mesh.face_material[kept++] = mesh.face_material[i];
  }
  const std::size_t flat = mesh.faces.size() - kept;
  if (kept == 0) throw BadInput(fmt::format("{}: holds no faces with an area", config.path));
  mesh.faces.resize(kept);
  mesh.face_material.resize(kept);
  if (flat > 0) {
    reading.warnings.push_back(
        fmt::format("{}: {} faces without area left out", config.path, flat));
  }
  if (warnings != nullptr) {
    warnings->insert(warnings->end(), reading.warnings.begin(), reading.warnings.end());
  }
  return std::move(mesh);
}

DeclaredAxes declared_by_collada(std::string_view content) {
  const std::string_view asset = content.substr(0, content.find("</asset>"));
  DeclaredAxes declared = {1.0, 'y'};  // COLLADA 1.4.1: the defaults of unit and up_axis
  if (const auto at = asset.find("<unit"); at != asset.npos) {
    const auto unit_m = meter_of(asset.substr(at, asset.find('>', at) - at));
    if (unit_m > 0.0) declared.unit_m = unit_m;
  }
  constexpr std::string_view kUp = "<up_axis>";
  if (const auto at = asset.find(kUp); at != asset.npos) {
    const std::string_view axis = without_blanks(asset.substr(at + kUp.size())).substr(0, 4);
    if (axis == "X_UP" || axis == "Y_UP" || axis == "Z_UP") {
      declared.up_axis = static_cast<char>(axis[0] - 'X' + 'x');
    }
  }
  return declared;
}

Eigen::Matrix3d R_z_up(char up) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (up == 'y') {
    R << 1, 0, 0,  //
        0, 0, -1,  //
        0, 1, 0;
  } else if (up == 'x') {
    R << 0, -1, 0,  //
        0, 0, -1,   //
        1, 0, 0;
  }
  return R;
}

Eigen::Matrix3d R_yaw(double yaw_rad) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(yaw_rad).toRotationMatrix();
  return R;
}

}  // namespace gnbv

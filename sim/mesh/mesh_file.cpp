#include "sim/mesh/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/file_kind.hpp"
#include "sim/mesh/mesh_scene.hpp"
#include "sim/mesh/model_parts.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

using Matrix4 = Eigen::Matrix4d;

constexpr std::array<std::string_view, 9> kFormats = {".obj", ".ply", ".stl",   ".dae", ".gltf",
                                                      ".glb", ".sdf", ".world", ".urdf"};

void check_config(const MeshFileConfig& config) {
  const auto need = [](bool holds, const std::string& fault) {
    if (!holds) throw BadInput("mesh: " + fault);
  };
  const auto& [path, scale, yaw_rad, offset_m, up, unit_m, lost_max] = config;
  need(!path.empty(), "path is empty");
  need(scale > 0.0 && std::isfinite(scale), fmt::format("scale = {} is not positive", scale));
  need(unit_m >= 0.0 && std::isfinite(unit_m),
       fmt::format("unit_m = {} is neither positive nor 0", unit_m));
  need(lost_max >= 0.0 && lost_max <= 1.0, fmt::format("lost_max = {} is no share", lost_max));
  need(offset_m.allFinite(), "offset_m is not finite");
  need(std::isfinite(yaw_rad), "yaw is not finite");
  need(up == "auto" || up == "x" || up == "y" || up == "z",
       fmt::format("up_axis = {} is none of auto, x, y, z", up));
}

void check_file(const std::string& path, const std::string& extension) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) read_file(path);  // throws, with the cause
  if (std::filesystem::file_size(path, ignored) == 0) throw BadInput("{}: is empty", path);
  if (const std::string what = what_it_is_instead(path, extension); !what.empty()) {
    throw BadInput("{}: {}", path, what);
  }
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end()) {
    throw BadInput("{}: '{}' is no known mesh format, only {} are", path, extension,
                   fmt::join(kFormats, ", "));
  }
}

/// Fills all but the mesh, of which it returns what makes world coordinates.
Matrix4 declare(const MeshFileConfig& config, const DeclaredAxes& declared, MeshReading& reading) {
  reading.declared = declared;
  reading.unit_m = config.unit_m > 0.0 ? config.unit_m : declared.unit_m.value_or(1.0);
  reading.up_axis = config.up_axis != "auto" ? config.up_axis[0] : declared.up_axis.value_or('z');
  // in single precision as COLLADA's other numbers
  const double unit_m = config.unit_m > 0.0 ? config.unit_m : static_cast<float>(reading.unit_m);
  Matrix4 T = Matrix4::Identity();
  T.topLeftCorner<3, 3>() = unit_m * config.scale * R_yaw(config.yaw_rad) * R_z_up(reading.up_axis);
  T.topRightCorner<3, 1>() = config.offset_m;
  return T;
}

/// A message without the path that it begins with.
std::string without_path(const std::string& path, const std::string& message) {
  const std::string begin = path + ": ";
  return message.starts_with(begin) ? message.substr(begin.size()) : message;
}

void read_polygons(const MeshFileConfig& config, bool is_obj, bool keeps_uvs,
                   MeshReading& reading) {
  const Matrix4 T_world_file = declare(config, {}, reading);
  PolygonMesh polygons = is_obj ? read_obj(config.path, reading.warnings, keeps_uvs)
                                : read_ply(config.path, reading.warnings);
  if (polygons.face_ends.empty()) {
    throw BadInput("{}: {}", config.path,
                   polygons.lost_faces > 0
                       ? "holds no faces: " + without_path(config.path, reading.warnings.back())
                       : no_faces_text(polygons.vertices.size()));
  }
  for (Vec3& p : polygons.vertices) {
    p = (T_world_file.topLeftCorner<3, 3>() * p + T_world_file.topRightCorner<3, 1>()).eval();
  }
  reading.not_finite = std::move(polygons.not_finite);
  reading.lost_faces = polygons.lost_faces;
  reading.files = std::move(polygons.files);
  reading.mesh = triangulated(std::move(polygons));
}

void read_scene(const MeshFileConfig& config, const std::string& extension, bool keeps_uvs,
                MeshReading& reading) {
  MeshScene scene = extension == ".stl"   ? read_stl(config.path)
                    : extension == ".dae" ? read_collada(config.path, keeps_uvs)
                                          : read_gltf(config.path, keeps_uvs);
  reading.mesh = assembled(scene, declare(config, scene.declared, reading), config.path);
  reading.warnings = std::move(scene.warnings);
  reading.lost_faces = scene.lost_faces;
  reading.files = std::move(scene.files);
  if (reading.mesh.faces.empty()) {
    const std::string path = config.path + ":";
    const std::string why = reading.warnings.empty() ? "" : reading.warnings.front();
    const bool is_of_all = why.starts_with(path + " ");  // not of a line
    throw BadInput("{} holds no faces{}", path, is_of_all ? ":" + why.substr(path.size()) : "");
  }
}

void read_links(const MeshFileConfig& config, const std::string& path, MeshReading& reading) {
  MeshReading model = read_model(path, declare(config, {1.0, 'z', true}, reading));
  if (model.mesh.faces.empty()) {
    throw BadInput("{}: holds no faces: no <visual> of it has any", path);
  }
  reading.mesh = std::move(model.mesh);
  reading.not_finite = std::move(model.not_finite);
  reading.warnings = std::move(model.warnings);
  reading.lost_faces = model.lost_faces;
  reading.files = std::move(model.files);
}

/// Of materials whose picture is there, without all of its texture coordinates.
std::size_t faces_without_coordinates(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (!mesh.materials[material_of(mesh, i)].texture.image) continue;
    const bool has_all = !mesh.face_looks.empty() &&
                         std::ranges::all_of(mesh.face_looks[i], [](const CornerLook& look) {
                           return look.uv.allFinite();
                         });
    if (!has_all) ++count;
  }
  return count;
}

}  // namespace

MeshReading read_mesh(const MeshFileConfig& config, bool keeps_uvs) {
  check_config(config);
  const std::string path = model_file_of(config.path).string();
  const std::string extension = extension_of(path);
  check_file(path, extension);
  MeshReading reading;
  if (is_model(path)) {
    read_links(config, path, reading);
  } else if (extension == ".obj" || extension == ".ply") {
    read_polygons(config, extension == ".obj", keeps_uvs, reading);
  } else {
    read_scene(config, extension, keeps_uvs, reading);
  }
  const std::size_t plain = is_model(path) ? 0 : faces_without_coordinates(reading.mesh);
  if (plain > 0) {
    reading.warnings.push_back(fmt::format(
        "{}: {} faces lack texture coordinates, and show no picture", config.path, plain));
  }
  const auto& vertices = reading.mesh.vertices_m;
  const auto bad =
      std::find_if(vertices.begin(), vertices.end(), [](const Vec3f& p) { return !p.allFinite(); });
  if (bad != vertices.end() && reading.not_finite.empty()) {
    reading.not_finite = fmt::format("{}: vertex {} comes to lie at ({}, {}, {}) m", config.path,
                                     bad - vertices.begin(), bad->x(), bad->y(), bad->z());
  }
  return reading;
}

bool has_lost_more(const MeshReading& reading, double lost_max) {
  const std::size_t held = reading.lost_faces + reading.mesh.faces.size();
  return static_cast<double>(reading.lost_faces) > lost_max * static_cast<double>(held);
}

std::optional<Vec3> offset_to_origin_m(const TriangleMesh& mesh) {
  constexpr double kFine_m = 16'384.0;  // half a step of a float is a millimetre there
  const Box3 box_m = bounds_m(mesh);
  const Vec3 centre_m = box_m.center();
  const bool is_far =
      centre_m.cwiseAbs().maxCoeff() > kFine_m && centre_m.norm() > 4.0 * box_m.diagonal().norm();
  if (!is_far) return std::nullopt;
  return Vec3(-std::round(centre_m.x()), -std::round(centre_m.y()), 0.0);
}

TriangleMesh load_mesh(const MeshFileConfig& config, std::vector<std::string>* warnings) {
  MeshReading reading = read_mesh(config);
  if (!reading.not_finite.empty()) throw BadInput(reading.not_finite);
  if (has_lost_more(reading, config.lost_max)) {
    throw BadInput(
        "{}: {} faces of {} could not be used, more than its key lost_max = {} allows: {}",
        config.path, reading.lost_faces, reading.lost_faces + reading.mesh.faces.size(),
        config.lost_max,
        reading.warnings.empty() ? "?" : without_path(config.path, reading.warnings.front()));
  }
  if (const auto offset_m = offset_to_origin_m(reading.mesh)) {
    const Vec3 whole_m = config.offset_m + *offset_m;
    throw BadInput(
        "{}: lies so far from the origin that single precision loses millimetres: set its key "
        "offset_m to [{:.0f}, {:.0f}, {:.0f}]",
        config.path, whole_m.x(), whole_m.y(), whole_m.z());
  }
  TriangleMesh& mesh = reading.mesh;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (is_flat(mesh, i)) continue;
    mesh.faces[kept] = mesh.faces[i];
    if (!mesh.face_looks.empty()) mesh.face_looks[kept] = mesh.face_looks[i];
    mesh.face_material[kept++] = mesh.face_material[i];
  }
  const std::size_t flat = mesh.faces.size() - kept;
  if (kept == 0) throw BadInput("{}: holds no faces with an area", config.path);
  mesh.faces.resize(kept);
  mesh.face_material.resize(kept);
  mesh.face_looks.resize(mesh.face_looks.empty() ? 0 : kept);
  if (flat > 0) {
    reading.warnings.push_back(
        fmt::format("{}: {} faces without area left out", config.path, flat));
  }
  if (warnings != nullptr) {
    warnings->insert(warnings->end(), reading.warnings.begin(), reading.warnings.end());
  }
  return std::move(mesh);
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

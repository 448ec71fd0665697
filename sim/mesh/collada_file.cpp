// read_collada() of sim/mesh/mesh_scene.hpp.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sim/core/pose.hpp"
#include "sim/mesh/collada_shape.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"
#include "sim/mesh/texture_file.hpp"

namespace gnbv {
namespace {

using Matrix4 = Eigen::Matrix4d;

std::string first_word_of(const std::string& text) {
  std::string_view rest = text;
  return std::string(take_word(rest));
}

/// Its specification says metres with y up where it is silent.
DeclaredAxes declared_by(const XmlElement& root) {
  DeclaredAxes declared = {1.0, 'y'};
  const XmlElement asset = root.child("asset");
  const auto meter = asset.child("unit").attribute("meter");
  const auto unit_m = read_with_comma(first_word_of(meter.value_or("")));
  if (unit_m > 0.0) declared.unit_m = unit_m;
  const std::string axis = first_word_of(asset.child("up_axis").text());
  if (axis == "X_UP" || axis == "Y_UP" || axis == "Z_UP") {
    declared.up_axis = static_cast<char>(axis[0] - 'X' + 'x');
  }
  return declared;
}

class ColladaReader {
 public:
  ColladaReader(const std::filesystem::path& path, bool keeps_uvs)
      : keeps_uvs_(keeps_uvs), file_(path, out_.warnings), textures_(path) {}

  MeshScene read() {
    out_.declared = declared_by(file_.root());
    const XmlElement shown =
        file_.named_by(file_.root().child("scene").child("instance_visual_scene"), "url");
    const XmlElement first = file_.root().child("library_visual_scenes").child("visual_scene");
    if (shown || first) {
      add_children(shown ? shown : first, Matrix4::Identity());
    } else {
      add_all_geometries();
    }
    const std::string path = file_.path().string();
    const auto warn = [&](std::size_t count, std::string_view what) {
      if (count > 0) out_.warnings.push_back(fmt::format("{}: {} {}", path, count, what));
    };
    out_.lose(path, lost_instances_, "instances of what is not in this file");
    out_.lose(path, unread_, "surfaces that are no polygons");
    out_.lose(path, impossible_, "faces of vertices that do not exist");
    textures_.warn(out_.warnings);
    out_.warnings.insert(out_.warnings.end(), faults_.begin(), faults_.end());
    out_.files = textures_.files();
    warn(skins_, "skinned meshes are shown as they were bound, not as their joints stand");
    return std::move(out_);
  }

 private:
  static constexpr std::size_t kMostDeep = 400;
  static constexpr std::size_t kMostNodes = 2'000'000;  // with all instances of them

  void add_children(const XmlElement& node, const Matrix4& T_file_node) {
    if (std::find(open_.begin(), open_.end(), node.node()) != open_.end()) {
      file_.fail(node,
                 fmt::format("the node '{}' is within itself", node.attribute("id").value_or("")));
    }
    if (open_.size() >= kMostDeep) file_.fail(node, fmt::format("nodes {} deep", open_.size()));
    if (++nodes_ > kMostNodes) file_.fail(node, fmt::format("more than {} nodes", kMostNodes));
    open_.push_back(node.node());
    for (const XmlElement& child : node.children()) {
      const std::string_view kind = child.name();
      if (kind == "node") {
        add_children(child, T_file_node * T_parent_node(child));
      } else if (kind == "instance_node") {
        const XmlElement instanced = file_.named_by(child, "url");
        if (!instanced) ++lost_instances_;
        if (instanced) add_children(instanced, T_file_node * T_parent_node(instanced));
      } else if (kind == "instance_geometry") {
        add_geometry(child, file_.named_by(child, "url"), T_file_node);
      } else if (kind == "instance_controller") {
        add_controller(child, T_file_node);
      }
    }
    open_.pop_back();
  }

  Matrix4 T_parent_node(const XmlElement& node) const {
    Matrix4 T = Matrix4::Identity();
    for (const XmlElement& step : node.children()) {
      const std::string_view kind = step.name();
      const std::size_t count = kind == "matrix"      ? 16
                                : kind == "translate" ? 3
                                : kind == "scale"     ? 3
                                : kind == "rotate"    ? 4
                                : kind == "lookat"    ? 9
                                : kind == "skew"      ? 7
                                                      : 0;
      if (count == 0) continue;
      const std::vector<double> v = file_.singles(step);
      if (v.size() < count) file_.fail(step, fmt::format("<{}> of {} numbers", kind, v.size()));
      T = T * step_of(kind, v);
    }
    return T;
  }

  static Matrix4 step_of(std::string_view kind, const std::vector<double>& v) {
    Matrix4 T = Matrix4::Identity();
    const Vec3 first(v[0], v[1], v[2]);
    if (kind == "matrix") {
      T = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v.data());
    } else if (kind == "translate") {
      T.topRightCorner<3, 1>() = first;
    } else if (kind == "scale") {
      T.diagonal().head<3>() = first;
    } else if (kind == "rotate" && first.norm() > 0.0) {
      T.topLeftCorner<3, 3>() =
          Eigen::AngleAxisd(deg_to_rad(v[3]), first.normalized()).toRotationMatrix();
    } else if (kind == "lookat") {
      const Vec3 back = (first - Vec3(v[3], v[4], v[5])).normalized();
      const Vec3 right = Vec3(v[6], v[7], v[8]).cross(back).normalized();
      T.topLeftCorner<3, 3>() << right, back.cross(right), back;
      T.topRightCorner<3, 1>() = first;
    } else if (kind == "skew") {  // angle, axis of rotation, axis of translation
      const Vec3 turn = Vec3(v[1], v[2], v[3]).normalized();
      const Vec3 along = Vec3(v[4], v[5], v[6]).normalized();
      T.topLeftCorner<3, 3>() += std::tan(deg_to_rad(v[0])) * along * turn.transpose();
    }
    return T;
  }

  void add_controller(const XmlElement& instance, const Matrix4& T_file_node) {
    XmlElement body = file_.named_by(instance, "url");
    Matrix4 T = T_file_node;
    for (std::size_t deep = 0; body && body.name() == "controller" && deep < kMostDeep; ++deep) {
      const XmlElement skin = body.child("skin");
      const XmlElement morph = body.child("morph");
      if (skin) {
        ++skins_;
        const XmlElement bind = skin.child("bind_shape_matrix");
        const std::vector<double> v = file_.singles(bind);
        // joints place it, not its node
        T = v.size() >= 16 ? step_of("matrix", v) : Matrix4::Identity();
      }
      body = file_.named_by(skin ? skin : morph, "source");
    }
    add_geometry(instance, body, T);
  }

  void add_geometry(const XmlElement& instance, const XmlElement& geometry, const Matrix4& T) {
    if (!geometry || geometry.name() != "geometry") {
      ++lost_instances_;
      return;
    }
    std::map<std::string, XmlElement> bound;  // <instance_material> by symbol
    const XmlElement binding = instance.child("bind_material").child("technique_common");
    for (const XmlElement& material : binding.children("instance_material")) {
      bound[material.attribute("symbol").value_or("")] = material;
    }
    const auto [entry, is_new] = shapes_.try_emplace(geometry.node());
    if (is_new) read_shape(geometry, entry->second);
    for (const auto& [symbol, part] : entry->second) {
      const auto found = bound.find(symbol);
      const XmlElement binds = found != bound.end() ? found->second : XmlElement();
      const std::size_t material = material_of(file_.named_by(binds, "target"));
      out_.instances.push_back({part, material, T, uv_set_of(part, material, binds)});
    }
  }

  void read_shape(const XmlElement& geometry,
                  std::vector<std::pair<std::string, std::size_t>>& to) {
    ColladaShape shape = collada_shape(file_, geometry, keeps_uvs_ || file_.has_images());
    faults_.insert(shape.faults.begin(), shape.faults.end());
    impossible_ += shape.impossible_faces;
    unread_ += shape.unread;
    for (ColladaShape::Group& group : shape.groups) {
      to.emplace_back(group.material, out_.parts.size());
      out_.parts.push_back(std::move(group.part));
    }
  }

  void add_all_geometries() {
    std::size_t count = 0;
    for (const XmlElement& library : file_.root().children("library_geometries")) {
      for (const XmlElement& geometry : library.children("geometry")) {
        add_geometry(XmlElement(), geometry, Matrix4::Identity());
        ++count;
      }
    }
    if (count == 0) return;
    out_.warnings.push_back(fmt::format("{}: has no scene: its {} geometries stand where they are",
                                        file_.path().string(), count));
  }

  std::size_t material_of(const XmlElement& element) {
    const auto [entry, is_new] = materials_.try_emplace(element.node(), out_.materials.size());
    if (is_new) out_.materials.push_back(material(element));
    return entry->second;
  }

  /// What the instance binds to the name that the picture's coordinates have in the effect, or the
  /// first there is.
  std::optional<std::size_t> uv_set_of(std::size_t part, std::size_t material,
                                       const XmlElement& binds) const {
    const auto& looks = out_.parts[part].looks;
    const bool has_picture = out_.materials[material].texture.image != nullptr;
    if (looks.empty() || !(has_picture || keeps_uvs_)) return std::nullopt;
    if (!has_picture) return looks.begin()->first;
    for (const XmlElement& input : binds.children("bind_vertex_input")) {
      if (input.attribute("semantic") != texcoords_.at(material)) continue;
      const double set =
          read_decimal(trimmed(input.attribute("input_set").value_or("0"))).value_or(-1.0);
      const auto found = looks.find(set >= 0.0 && set < 1e9 ? static_cast<std::size_t>(set) : 0);
      if (found != looks.end()) return found->first;
    }
    return looks.begin()->first;
  }

  Material material(const XmlElement& element) {
    Material out = {.name = std::string(kDefaultMaterial), .rgb = kDefaultColour};
    if (!element) return out;
    out.name = element.attribute("name").value_or(element.attribute("id").value_or(out.name));
    const XmlElement effect = file_.named_by(element.child("instance_effect"), "url");
    const XmlElement technique = effect.child("profile_COMMON").child("technique");
    for (const char* shading : {"phong", "lambert", "blinn", "constant"}) {
      const XmlElement diffuse = technique.child(shading).child("diffuse");
      if (const XmlElement texture = diffuse.child("texture")) {
        out.rgb = {1.0F, 1.0F, 1.0F};
        out.texture = picture(effect, texture);
        texcoords_[out_.materials.size()] = texture.attribute("texcoord").value_or("");
      }
      const std::string text = diffuse.child("color").text();
      std::string_view rest = text;
      std::array<float, 3> rgb{};
      bool is_whole = true;
      for (float& channel : rgb) {
        const double value = read_decimal(take_word(rest)).value_or(NAN);
        is_whole = is_whole && !std::isnan(value);
        channel = static_cast<float>(std::clamp(value, 0.0, 1.0));
      }
      if (is_whole) out.rgb = rgb;
    }
    return out;
  }

  /// From a <texture> by its sampler and surface (1.4), its sampler (1.5) or at once to the image.
  Texture picture(const XmlElement& effect, const XmlElement& texture) {
    const XmlElement profile = effect.child("profile_COMMON");
    std::array<Wrap, 2> wrap = {};
    std::string name = trimmed(texture.attribute("texture").value_or(""));
    XmlElement image;
    constexpr int kMostSteps = 4;
    for (int step = 0; step < kMostSteps && !image; ++step) {
      const XmlElement param = param_of({effect, profile, profile.child("technique")}, name);
      if (!param) break;
      if (const XmlElement sampler = param.child("sampler2D")) {
        wrap = {wrap_of(sampler.child("wrap_s")), wrap_of(sampler.child("wrap_t"))};
        image = file_.named_by(sampler.child("instance_image"), "url");
        name = trimmed(sampler.child("source").text());
      } else {
        name = trimmed(param.child("surface").child("init_from").text());
      }
    }
    if (!image) image = file_.by_id(name);
    const std::string uri = trimmed(image.child("init_from").text());
    if (!uri.empty()) return textures_.at(uri, wrap);
    textures_.miss(name.empty() ? "one without a name" : name, "not there");
    return {};
  }

  static XmlElement param_of(std::initializer_list<XmlElement> places, const std::string& sid) {
    for (const XmlElement& place : places) {
      for (const XmlElement& param : place.children("newparam")) {
        if (param.attribute("sid") == sid) return param;
      }
    }
    return {};
  }

  static Wrap wrap_of(const XmlElement& mode) {
    const std::string word = trimmed(mode.text());
    if (word == "MIRROR") return Wrap::mirror;
    return word == "CLAMP" || word == "BORDER" || word == "NONE" ? Wrap::clamp : Wrap::repeat;
  }

  const bool keeps_uvs_;
  MeshScene out_;
  ColladaFile file_;
  TextureFiles textures_;
  std::map<std::size_t, std::string> texcoords_;  // of materials with pictures, in their effects
  std::set<std::string> faults_;
  std::vector<const _xmlNode*> open_;  // the nodes that we are in
  std::map<const _xmlNode*, std::vector<std::pair<std::string, std::size_t>>> shapes_;
  std::map<const _xmlNode*, std::size_t> materials_;
  std::size_t nodes_ = 0, lost_instances_ = 0, unread_ = 0, impossible_ = 0, skins_ = 0;
};

}  // namespace

MeshScene read_collada(const std::filesystem::path& path, bool keeps_uvs) {
  return ColladaReader(path, keeps_uvs).read();
}

}  // namespace gnbv

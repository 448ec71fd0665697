// read_sdf() of sim/mesh/model_parts.hpp: http://sdformat.org/spec, and its pose semantics.
#include <algorithm>

#include "sim/mesh/model_parts.hpp"
#include "sim/mesh/plain_text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Matrix4 = Eigen::Matrix4d;

/// A place in an SDF document.
struct Place {
  const fs::path& document;
  XmlElement element;
};

[[noreturn]] void fail(const Place& at, const std::string& what) {
  fail_at(at.document, at.element, what);
}

/// The <pose> of an element, in whatever it is relative to.
Matrix4 pose_of(const Place& of) {
  const XmlElement pose = of.element.child("pose");
  if (!pose) return Matrix4::Identity();
  const bool is_quaternion = pose.attribute("rotation_format").value_or("") == "quat_xyzw";
  const auto v = is_quaternion ? numbers_of(of.document, pose, pose.text(), {0, 7})
                               : numbers_of(of.document, pose, pose.text(), {0, 6});
  if (v.empty()) return Matrix4::Identity();
  const Vec3 p_m(v[0], v[1], v[2]);
  if (is_quaternion) {
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!(q.norm() > 0.0)) fail({of.document, pose}, "<pose> has a quaternion of 0");
    return placed(p_m, q.normalized().toRotationMatrix());
  }
  const std::string degrees = in_lower_case(pose.attribute("degrees").value_or("false"));
  const double unit_rad = degrees == "true" || degrees == "1" ? kPi / 180.0 : 1.0;
  return placed(p_m, R_rpy(unit_rad * v[3], unit_rad * v[4], unit_rad * v[5]));
}

/// What its pose names, or the fallback.
std::string base_of(const Place& of, std::string fallback) {
  const XmlElement pose = of.element.child("pose");
  if (!pose.attribute("frame").value_or("").empty()) {
    fail({of.document, pose}, "<pose frame> of SDF 1.5 and 1.6 is not read: use relative_to");
  }
  const std::string name = pose.attribute("relative_to").value_or("");
  return name.empty() ? std::move(fallback) : name;
}

/// The frames of one model: links, joints, nested models and <frame>s by name, in its own; of an
/// <include> that says its name and pose, too.
class ModelFrames {
 public:
  ModelFrames(const fs::path& document, const XmlElement& model)
      : document_(document), own_(model.name() == "world" ? "world" : "__model__") {
    for (const XmlElement& element : model.children()) {
      const std::string_view kind = element.name();
      std::string base = own_;
      if (kind == "joint") base = trimmed(element.child("child").text());
      if (kind == "frame") base = element.attribute("attached_to").value_or(base);
      const bool is_include = kind == "include" && element.child("name") && element.child("pose");
      const bool is_frame =
          is_include || kind == "link" || kind == "joint" || kind == "frame" || kind == "model";
      if (!is_frame) continue;
      const std::string name = is_include ? trimmed(element.child("name").text())
                                          : element.attribute("name").value_or("");
      base = base_of({document, element}, base);
      const auto [entry, is_new] = frames_.try_emplace(name, element, base);
      // a joint of SDF 1.6 may have its link's name, which means the link
      const bool is_of_joint = entry->second.first.name() == "joint";
      if (!is_new && kind == "link" && is_of_joint) entry->second = {element, base};
    }
  }

  Matrix4 T_model_frame(const std::string& name, const XmlElement& asked_by, int deep = 0) const {
    if (name == own_ || name.empty()) return Matrix4::Identity();
    const auto found = frames_.find(name);
    if (found == frames_.end()) {
      fail({document_, asked_by},
           fmt::format("the frame '{}' is not in this model, nor does an <include> with a <pose> "
                       "<name> it",
                       name));
    }
    constexpr int kMostDeep = 200;
    if (deep > kMostDeep) {
      fail({document_, asked_by},
           fmt::format("the frame '{}' depends on itself, or on more than {} others", name,
                       kMostDeep));
    }
    const auto& [element, base] = found->second;
    return T_model_frame(base, element, deep + 1) * pose_of({document_, element});
  }
  /// Of an element in the model whose pose counts from the model, or from an element that it is in,
  /// where it names nothing.
  Matrix4 T_model_of(const XmlElement& element, const XmlElement& parent = {}) const {
    const std::string base = base_of({document_, element}, "");
    const Matrix4 T_model_base =
        parent && base.empty() ? T_model_of(parent) : T_model_frame(base, element);
    return T_model_base * pose_of({document_, element});
  }

 private:
  const fs::path& document_;
  const std::string own_;  // the name of the model's frame, or of the world's
  std::map<std::string, std::pair<XmlElement, std::string>> frames_;
};

class SdfReader {
 public:
  explicit SdfReader(ModelParts& to) : to_(to) {}

  /// All models of a document; `T_placed` stands for the pose of its only one.
  void read(const fs::path& document, const Matrix4& T_world, const Matrix4* T_placed) {
    const XmlTree tree(document, to_.reading.warnings);
    const XmlElement root = tree.root();
    if (root.name() != "sdf" && root.name() != "gazebo") {
      fail({document, root}, "is no SDF: its root is no <sdf>");
    }
    add_models(document, root, T_world, T_placed);
    for (const XmlElement& world : root.children("world")) {
      add_models(document, world, T_world, nullptr);
      if (const XmlElement state = world.child("state")) {
        to_.reading.warnings.push_back(
            fmt::format("{}:{}: <state> is not read: models stand where their own <pose> says",
                        document.string(), state.line()));
      }
    }
  }

 private:
  static constexpr std::size_t kMostModels = 10'000;

  void count(const Place& at) {
    if (++models_ > kMostModels || open_ > 30) {
      fail(at, fmt::format("more than {} models, or models more than 30 deep", kMostModels));
    }
    for (const char* const moves : {"placement_frame", "params"}) {
      if (at.element.attribute(moves) || at.element.child(moves)) {
        fail(at, fmt::format("{} is not read", moves));
      }
    }
  }

  void add_models(const fs::path& document, const XmlElement& parent, const Matrix4& T_world,
                  const Matrix4* T_placed) {
    const ModelFrames frames(document, parent);
    for (const XmlElement& element : parent.children()) {
      const std::string_view kind = element.name();
      if (kind != "model" && kind != "include") {
        if (kind == "actor" || kind == "road" || kind == "population") {
          fail({document, element}, fmt::format("<{}> is not read", kind));
        }
        continue;
      }
      count({document, element});
      ++open_;
      const Matrix4 T =
          T_world *
          (T_placed != nullptr && kind == "model" ? *T_placed : frames.T_model_of(element));
      kind == "model" ? add_model(document, element, T) : add_included(document, element, T);
      --open_;
    }
  }

  /// Without a pose beside it, the model's own counts.
  void add_included(const fs::path& document, const XmlElement& include, const Matrix4& T) {
    const fs::path found = resolved(document, include, include.child("uri").text());
    const Matrix4 here = Matrix4::Identity();
    read(model_file_of(found), T, include.child("pose") ? &here : nullptr);
  }

  void add_model(const fs::path& document, const XmlElement& model, const Matrix4& T_world_model) {
    const ModelFrames frames(document, model);
    for (const XmlElement& link : model.children("link")) {
      for (const XmlElement& visual : link.children("visual")) {
        to_.add(document, visual, T_world_model * frames.T_model_of(visual, link),
                look_of(document, visual));
      }
    }
    add_models(document, model, T_world_model, nullptr);
  }

  ModelParts::Look look_of(const fs::path& document, const XmlElement& visual) {
    const XmlElement material = visual.child("material");
    ModelParts::Look look;
    const XmlElement diffuse = material.child("diffuse");
    if (diffuse) look.rgb = rgb_of(document, diffuse, diffuse.text());
    for (const char* workflow : {"metal", "specular"}) {
      const XmlElement albedo = material.child("pbr").child(workflow).child("albedo_map");
      if (albedo) look.texture = to_.picture(document, albedo, albedo.text());
    }
    return look;
  }

  ModelParts& to_;
  std::size_t models_ = 0;
  int open_ = 0;
};

}  // namespace

void read_sdf(const fs::path& path, ModelParts& to) {
  SdfReader(to).read(path, Matrix4::Identity(), nullptr);
}

}  // namespace gnbv

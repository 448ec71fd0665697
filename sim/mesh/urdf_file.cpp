// read_urdf() of sim/mesh/model_parts.hpp: http://wiki.ros.org/urdf/XML.
#include <algorithm>

#include "sim/mesh/model_parts.hpp"

namespace gnbv {
namespace {

using Matrix4 = Eigen::Matrix4d;

class UrdfReader {
 public:
  UrdfReader(const std::filesystem::path& path, ModelParts& to)
      : path_(path), to_(to), tree_(path, to.reading.warnings) {}

  void read() {
    const XmlElement robot = tree_.root();
    if (robot.name() != "robot") fail_at(path_, robot, "is no URDF: its root is no <robot>");
    tree_.for_each([&](const XmlElement& element) {
      // a call of a macro is an element of that prefix; what it stands for would be lost
      const bool is_macro =
          element.has_prefix("xacro") ||
          element.attribute("filename").value_or("").find("$(") != std::string::npos;
      if (element.name() == "macro" || element.name() == "include" || is_macro) {
        fail_at(path_, element, "is xacro: `xacro FILE.xacro > FILE.urdf` expands it");
      }
    });
    for (const XmlElement& material : robot.children("material")) look_of(material);
    for (const XmlElement& link : robot.children("link")) {
      const std::string name = link.attribute("name").value_or("");
      const bool is_new = links_.emplace(name, Link{.element = link}).second;
      if (!is_new) fail_at(path_, link, fmt::format("a second link of the name '{}'", name));
    }
    for (const XmlElement& joint : robot.children("joint")) hang(joint);
    for (auto& [name, link] : links_) add(link);
  }

 private:
  struct Link {
    XmlElement element;
    Link* parent = nullptr;
    Matrix4 T_parent_link = Matrix4::Identity();
  };

  Link& link_of(const XmlElement& joint, const char* end) {
    const std::string name = joint.child(end).attribute("link").value_or("");
    const auto found = links_.find(name);
    if (found == links_.end()) {
      fail_at(path_, joint, fmt::format("its {} '{}' is no link", end, name));
    }
    return found->second;
  }

  void hang(const XmlElement& joint) {
    Link& child = link_of(joint, "child");
    if (child.parent != nullptr) fail_at(path_, joint, "its child hangs on another joint already");
    child.parent = &link_of(joint, "parent");
    child.T_parent_link = origin_of(joint);
  }

  Matrix4 origin_of(const XmlElement& element) const {
    const XmlElement origin = element.child("origin");
    const auto triple = [&](const char* name) {
      const auto v = numbers_of(path_, origin, origin.attribute(name).value_or("0 0 0"), {3});
      return Vec3(v[0], v[1], v[2]);
    };
    if (!origin) return Matrix4::Identity();
    const Vec3 rpy_rad = triple("rpy");
    return placed(triple("xyz"), R_rpy(rpy_rad.x(), rpy_rad.y(), rpy_rad.z()));
  }

  void add(const Link& link) {
    Matrix4 T_root_link = Matrix4::Identity();
    std::size_t steps = 0;
    for (const Link* at = &link; at->parent != nullptr; at = at->parent) {
      if (++steps > std::min(links_.size(), std::size_t{1000})) {
        fail_at(path_, link.element, "its joints lead back to it, or are more than 1000 deep");
      }
      T_root_link = at->T_parent_link * T_root_link;
    }
    for (const XmlElement& visual : link.element.children("visual")) {
      to_.add(path_, visual, T_root_link * origin_of(visual), look_of(visual.child("material")));
    }
  }

  /// Remembers it by name.
  const ModelParts::Look& look_of(const XmlElement& material) {
    ModelParts::Look& look = looks_[material.attribute("name").value_or("")];
    const XmlElement colour = material.child("color"), texture = material.child("texture");
    if (colour || texture) look = {};  // of no name, or said again
    if (colour) look.rgb = rgb_of(path_, colour, colour.attribute("rgba").value_or(""));
    if (texture) {
      look.texture = to_.picture(path_, texture, texture.attribute("filename").value_or(""));
    }
    return look;
  }

  const std::filesystem::path& path_;
  ModelParts& to_;
  XmlTree tree_;
  std::map<std::string, Link> links_;
  std::map<std::string, ModelParts::Look> looks_;
};

}  // namespace

void read_urdf(const std::filesystem::path& path, ModelParts& to) { UrdfReader(path, to).read(); }

}  // namespace gnbv

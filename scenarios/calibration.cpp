#include "scenarios/calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <sstream>
#include <vector>

#include "scenarios/document.hpp"
#include "scenarios/fields.hpp"
#include "scenarios/values.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/xml_tree.hpp"

namespace gnbv {
namespace {

/// A value of the file: of a matrix all numbers of it, row by row.
struct Value {
  std::size_t line = 0;
  std::string text;  // of a scalar
  std::vector<double> numbers;
  std::string wrong;  // the first of them that is none
};

void take(std::string_view word, Value& value) {
  double number = 0.0;
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.ends_with('.')) word.remove_suffix(1);  // OpenCV's "1."
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_number = error == std::errc{} && end == word.data() + word.size();
  if (!(is_number && std::isfinite(number)) && value.wrong.empty()) value.wrong = word;
  value.numbers.push_back(number);
}

/// The keys of a camera.
struct Calibration {
  std::string file;
  std::map<std::string, Value> values;

  const Value* find(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      if (const auto at = values.find(name); at != values.end()) return &at->second;
    }
    return nullptr;
  }
  [[noreturn]] void fail(const Value* value, const char* key, const std::string& what) const {
    const std::string line = value != nullptr ? fmt::format(":{}", value->line) : "";
    throw BadInput(fmt::format("{}{}: {}: {}", file, line, key, what));
  }
  /// As many numbers as one of `counts` says, all of them finite.
  std::vector<double> numbers(std::initializer_list<const char*> names,
                              std::initializer_list<std::size_t> counts) const {
    const char* key = *names.begin();
    const Value* value = find(names);
    if (value == nullptr) fail(nullptr, key, "is missing");
    if (!value->wrong.empty()) fail(value, key, fmt::format("'{}' is no number", value->wrong));
    if (std::ranges::count(counts, value->numbers.size()) == 0) {
      fail(value, key,
           fmt::format("holds {} numbers, expects {}", value->numbers.size(),
                       fmt::join(counts, " or ")));
    }
    return value->numbers;
  }
};

Value value_of(const YamlEntry& entry) {
  const YamlNode& node = entry.value;
  Value value;
  value.line = static_cast<std::size_t>(entry.location.line);
  const YamlNode* const data = node.find("data");
  const YamlNode& held = data != nullptr ? *data : node;
  value.text = held.text;
  if (held.kind == YamlNode::Kind::scalar) take(held.text, value);
  if (held.kind == YamlNode::Kind::map) value.wrong = "a map";
  for (const YamlNode& item : held.items) {
    take(item.kind == YamlNode::Kind::scalar ? item.text : "a list", value);
  }
  return value;
}

bool is_before_keys(const std::string& line) {
  return line == "---" || line.find_first_of("%#\r\n") == 0;
}

Calibration of_yaml(const std::string& file, std::string text, const std::string& camera) {
  Calibration out{file, {}};
  // before the keys: OpenCV's first line, which is no directive that YAML knows, comments, a marker
  std::size_t begin = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  std::size_t lines = 0;
  for (; begin < text.size() && is_before_keys(text.substr(begin, 3)); ++lines) {
    begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
  }
  text.replace(0, begin, lines, '\n');
  // OpenCV's matrices have a tag
  const std::string tag = "!!opencv-matrix";
  for (auto at = text.find(tag); at != text.npos; at = text.find(tag)) text.erase(at, tag.size());
  // ROS ends each message that it prints with the line that begins the next
  text.resize(std::min(text.find("\n---"), text.size()));
  ValidationErrors errors;
  const auto root = parse_document(text, {file, 1, 0}, errors);
  errors.throw_if_any();
  if (!root || root->kind != YamlNode::Kind::map) {
    throw BadInput(fmt::format("{}: holds no map of keys", file));
  }
  const auto is_of_chain = [](const YamlEntry& entry) {
    return entry.value.find("camera_model") != nullptr;
  };
  const auto first = std::ranges::find_if(root->entries, is_of_chain);
  const std::string chosen = camera.empty() && first != root->entries.end() ? first->key : camera;
  const YamlNode* const node = chosen.empty() ? &*root : root->find(chosen);
  if (node == nullptr) throw BadInput(fmt::format("{}: holds no camera '{}'", file, chosen));
  for (const YamlEntry& entry : node->entries) out.values[entry.key] = value_of(entry);
  return out;
}

Calibration of_xml(const std::string& file) {
  Calibration out{file, {}};
  std::vector<std::string> ignored;
  const XmlTree tree(file, ignored);
  for (const XmlElement& element : tree.root().children()) {
    Value value;
    value.line = element.line();
    const XmlElement data = element.child("data");
    std::istringstream words(data ? data.text() : element.text());
    for (std::string word; words >> word; take(word, value)) value.text = word;
    out.values[std::string(element.name())] = value;
  }
  return out;
}

/// A file's centre counts from the middle of the first pixel.
void set_pinhole(double fx, double fy, double cx, double cy, double skew, CameraConfig& camera) {
  constexpr double kCorner_px = 0.5;
  camera.fx_px = fx;
  camera.fy_px = fy;
  camera.cx_px = cx + kCorner_px;
  camera.cy_px = cy + kCorner_px;
  camera.skew_px = skew;
}

using Names = std::initializer_list<const char*>;
constexpr Names kMatrixNames = {
    "camera_matrix", "Camera_Matrix", "cameraMatrix", "CameraMatrix", "K", "k", "M1", "M"};

void set_matrix(const Calibration& from, CameraConfig& camera) {
  const std::vector<double> k = from.numbers(kMatrixNames, {9});
  if (k[3] != 0.0 || k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0) {
    from.fail(from.find(kMatrixNames), *kMatrixNames.begin(),
              fmt::format("its last row is {} {} {}, and the one above begins with {}; expects "
                          "fx s cx, 0 fy cy, 0 0 1, row by row",
                          k[6], k[7], k[8], k[3]));
  }
  set_pinhole(k[0], k[4], k[2], k[5], k[1], camera);
}

/// `listed` in OpenCV's order; what is not listed is 0.
void set_distortion(Distortion model, const std::vector<double>& listed, CameraConfig& camera) {
  DistortionConfig& d = camera.distortion = {};
  d.model = model;
  const bool is_fisheye = model == Distortion::kannala_brandt;
  for (std::size_t i = 0; i < listed.size(); ++i) {
    d.*kCoefficients[is_fisheye && i > 1 ? i + 2 : i].second = listed[i];  // it has no p1 and p2
  }
  if (std::ranges::all_of(listed, [](double k) { return k == 0.0; }) && !is_fisheye) d = {};
}

void set_size(const Calibration& from, std::initializer_list<const char*> names, std::size_t item,
              int& pixels) {
  constexpr double kMost = 8192.0;
  const double size = from.numbers(names, {item == 0 ? std::size_t{1} : 2, 2}).at(item);
  if (!(size >= 1.0 && size <= kMost) || size != std::floor(size)) {
    from.fail(from.find(names), *names.begin(),
              fmt::format("{} is no image size from 1 to {}", size, kMost));
  }
  pixels = static_cast<int>(size);
}

void set_kalibr(const Calibration& from, CameraConfig& camera) {
  const Value& model = *from.find({"camera_model"});
  if (model.text != "pinhole") {
    from.fail(&model, "camera_model", fmt::format("'{}' is not read; pinhole is", model.text));
  }
  const std::vector<double> k = from.numbers({"intrinsics"}, {4});
  set_pinhole(k[0], k[1], k[2], k[3], 0.0, camera);
  set_size(from, {"resolution"}, 0, camera.width_px);
  set_size(from, {"resolution"}, 1, camera.height_px);
  const Value* kind = from.find({"distortion_model"});
  const std::string name = kind != nullptr ? kind->text : "none";
  if (name == "none") return set_distortion(Distortion::none, {}, camera);
  const bool is_fisheye = name == "equidistant";
  if (!is_fisheye && name != "radtan") {
    from.fail(kind, "distortion_model",
              fmt::format("'{}' is not read; radtan, equidistant and none are", name));
  }
  set_distortion(is_fisheye ? Distortion::kannala_brandt : Distortion::brown_conrady,
                 from.numbers({"distortion_coeffs"}, {4}), camera);
}

constexpr Names kCoefficientNames = {"distortion_coefficients",
                                     "Distortion_Coefficients",
                                     "distCoeffs",
                                     "DistCoeffs",
                                     "D",
                                     "d",
                                     "D1",
                                     "dist_coeffs"};

/// As many as `counts` says; a rectified camera has none.
void set_brown_conrady(const Calibration& from, std::initializer_list<std::size_t> counts,
                       CameraConfig& camera) {
  std::vector<double> listed = from.numbers(kCoefficientNames, counts);
  for (std::size_t i = kCoefficients.size(); i < listed.size(); ++i) {
    if (listed[i] == 0.0) continue;
    from.fail(from.find(kCoefficientNames), *kCoefficientNames.begin(),
              "thin prisms and tilted sensors (the ninth coefficient and on) are not read");
  }
  listed.resize(std::min(listed.size(), kCoefficients.size()));
  set_distortion(Distortion::brown_conrady, listed, camera);
}

/// A file of camera_calibration's, or the message that `ros2 topic echo` prints.
void set_ros(const Calibration& from, const Value& kind, CameraConfig& camera) {
  set_matrix(from, camera);
  set_size(from, {"image_width", "width"}, 0, camera.width_px);
  set_size(from, {"image_height", "height"}, 0, camera.height_px);
  for (const char* key : {"binning_x", "binning_y"}) {
    const Value* binning = from.find({key});
    if (binning == nullptr || binning->text == "0" || binning->text == "1") continue;
    from.fail(binning, key,
              fmt::format("'{}' is not read: the matrix is of the image before", binning->text));
  }
  if (kind.text == "equidistant" || kind.text == "fisheye") {
    set_distortion(Distortion::kannala_brandt, from.numbers(kCoefficientNames, {4}), camera);
  } else if (kind.text == "plumb_bob") {
    set_brown_conrady(from, {0, 4, 5}, camera);
  } else if (kind.text == "rational_polynomial") {
    set_brown_conrady(from, {0, 8, 12, 14}, camera);
  } else if (kind.text.empty()) {
    set_brown_conrady(from, {0, 4, 5, 8, 12, 14}, camera);
  } else {
    from.fail(&kind, "distortion_model",
              fmt::format("'{}' is not read; plumb_bob, rational_polynomial and equidistant are",
                          kind.text));
  }
}

void set_opencv(const Calibration& from, CameraConfig& camera) {
  set_matrix(from, camera);
  // a stereo calibration's file has no image size: the scenario's keys say it
  if (from.find({"image_width", "image_Width"}) != nullptr) {
    set_size(from, {"image_width", "image_Width"}, 0, camera.width_px);
    set_size(from, {"image_height", "image_Height"}, 0, camera.height_px);
  }
  const Value* fisheye = from.find({"fisheye_model", "fisheye"});
  if (fisheye != nullptr && (fisheye->text == "1" || fisheye->text == "true")) {
    return set_distortion(Distortion::kannala_brandt, from.numbers(kCoefficientNames, {4}), camera);
  }
  set_brown_conrady(from, {4, 5, 8, 12, 14}, camera);
}

/// Refuses a number that the scenario's key would not take.
class RangeCheck final : public FieldVisitor {
 public:
  explicit RangeCheck(const std::string& file) : file_(file) {}
  void leaf(const Field& field, const FieldValue& value) override {
    const auto* const number = std::get_if<double*>(&value);
    if (number == nullptr || field.kind == FieldKind::angle) return;
    if (contains(field.allowed, **number)) return;
    throw BadInput(fmt::format("{}: {}: value '{}': {}", file_, field.path, **number,
                               out_of_range(field.allowed)));
  }

 private:
  const std::string& file_;
};

}  // namespace

CameraConfig calibrated(const std::string& file, CameraConfig camera) {
  const std::size_t at = file.rfind("#");
  const bool names_camera = at != file.npos && !std::filesystem::exists(file);
  const std::string path = names_camera ? file.substr(0, at) : file;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw BadInput(fmt::format("{}: there is no such file", path));
  }
  const std::string text = read_file(path);
  const bool is_xml = text.find_first_not_of(" \t\r\n\xef\xbb\xbf") != text.npos &&
                      text[text.find_first_not_of(" \t\r\n\xef\xbb\xbf")] == '<';
  const Calibration from =
      is_xml ? of_xml(path) : of_yaml(path, text, names_camera ? file.substr(at + 1) : "");
  const Value* kind = from.find({"distortion_model"});
  if (from.find({"camera_model"}) != nullptr) {
    set_kalibr(from, camera);
  } else if (kind != nullptr) {
    set_ros(from, *kind, camera);
  } else {
    set_opencv(from, camera);
  }
  if (!(camera.fx_px > 0.0 && camera.fy_px > 0.0)) {
    throw BadInput(fmt::format("{}: focal lengths {} and {} px have to be above 0", path,
                               camera.fx_px, camera.fy_px));
  }
  RangeCheck check(path);
  fields(Keys(check), camera);
  return camera;
}

}  // namespace gnbv

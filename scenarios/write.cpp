#include "scenarios/write.hpp"

#include <fmt/format.h>

#include "scenarios/fields.hpp"
#include "scenarios/load.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

/// Block style, two spaces a level; vectors on one line.
class YamlWriter final : public FieldVisitor {
 public:
  std::string text;

 private:
  void leaf(const Field& field, const FieldValue& value) override {
    line(fmt::format("{}: {}", field.key, yaml_text(field, value)));
  }
  void begin_section(std::string_view key, std::string_view) override {
    line(fmt::format("{}:", key));
    depth_ += 1;
  }
  void end_section() override { depth_ -= 1; }
  std::optional<std::size_t> begin_list(std::string_view key, std::size_t size, const ListSize&,
                                        std::string_view) override {
    line(fmt::format("{}:{}", key, size == 0 ? " []" : ""));
    depth_ += 1;
    return std::nullopt;
  }
  void end_list() override { depth_ -= 1; }
  void begin_item(std::size_t) override {
    depth_ += 1;
    is_first_of_item_ = true;
  }
  void end_item() override { depth_ -= 1; }

  void line(const std::string& content) {
    std::string indent(2 * depth_, ' ');
    if (is_first_of_item_) indent[indent.size() - 2] = '-';
    is_first_of_item_ = false;
    text += indent + content + '\n';
  }

  std::size_t depth_ = 0;
  bool is_first_of_item_ = false;
};

class ValueLister final : public FieldVisitor {
 public:
  explicit ValueLister(bool asks_for_use) { asks_for_use_ = asks_for_use; }

  std::vector<ValueUse> values;

 private:
  void leaf(const Field& field, const FieldValue& value) override {
    const std::string_view by = field.use.unused_by;
    values.push_back({path_ + std::string(field.key), yaml_text(field, value),
                      by.starts_with('.') ? path_ + std::string(by.substr(1)) : std::string(by),
                      field.use.is_papers_setting});
  }
  void begin_section(std::string_view key, std::string_view) override { enter(key); }
  void end_section() override { leave(); }
  std::optional<std::size_t> begin_list(std::string_view key, std::size_t, const ListSize&,
                                        std::string_view) override {
    enter(key);
    return std::nullopt;
  }
  void end_list() override { leave(); }
  void begin_item(std::size_t index) override { enter(std::to_string(index)); }
  void end_item() override { leave(); }

  void enter(std::string_view key) { path_ += fmt::format("{}.", key); }
  void leave() {
    path_.pop_back();
    path_.resize(path_.rfind('.') + 1);  // npos + 1 = 0: back at the root
  }

  std::string path_;
};

std::vector<ValueUse> listed(const Scenario& scenario, bool asks_for_use) {
  Scenario copy = scenario;
  ValueLister lister(asks_for_use);
  fields(lister, copy);
  return std::move(lister.values);
}

}  // namespace

std::string to_yaml(const Scenario& scenario) {
  Scenario copy = scenario;  // visitors may write, this one does not
  YamlWriter writer;
  fields(writer, copy);
  return writer.text;
}

std::string views_override(std::span<const ViewPose> views) {
  std::string text = "planner.routes.views=[";
  for (const ViewPose& view : views) {
    const Vec3& p = view.p_world_m;
    text += fmt::format("{}{{position_m: [{}, {}, {}], yaw_deg: {}, pitch_deg: {}}}",
                        text.back() == '[' ? "" : ", ", p.x(), p.y(), p.z(),
                        degrees_of(view.yaw_rad), degrees_of(view.gimbal_pitch_rad));
  }
  return text + ']';
}

std::vector<ValueUse> value_uses(const Scenario& scenario) { return listed(scenario, true); }

std::vector<std::pair<std::string, std::string>> scenario_values(const Scenario& scenario) {
  std::vector<std::pair<std::string, std::string>> values;
  for (ValueUse& value : listed(scenario, false)) {
    values.emplace_back(std::move(value.path), std::move(value.text));
  }
  return values;
}

}  // namespace gnbv

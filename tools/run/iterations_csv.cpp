#include "tools/run/iterations_csv.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "planner/planners.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

/// Wall time: no result depends on it, and nobody needs all its digits.
template <typename Seconds>
struct Wall {
  Seconds& s;
};
template <typename Seconds>
Wall(Seconds&) -> Wall<Seconds>;

// Every column in its order, for whoever writes its name, writes its value or reads it: `View` is a
// ViewRecord, const for writers.

template <typename View, typename Column>
void visit_decision(View& view, Column&& column) {
  auto& d = view.decision;
  column("sampler", d.sampler);
  column("scale", d.scale);
  column("candidates", d.candidates);
  column("valid", d.valid);
  column("utility", d.score.value);
  column("information", d.score.information);
  column("density_term", d.score.density);
  column("prediction", d.score.prediction);
  column("distance_factor", d.score.distance);
  column("entropy_nat", view.entropy_nat);
  column("density_points_per_voxel", view.density_points_per_voxel);
  column("cloud_points", view.cloud_points);
  column("straight_m", view.straight_m);
  column("flown_m", view.flown_m);
  column("time_s", view.time_s);
}

template <typename View, typename Column>
void visit_columns(View& view, Columns columns, Column&& column) {
  auto& d = view.decision;
  column("iteration", view.iteration);
  column("x", d.view.p_world_m.x());
  column("y", d.view.p_world_m.y());
  column("z", d.view.p_world_m.z());
  column("yaw", d.view.yaw_rad);
  visit_decision(view, column);
  column("wall_sense_s", Wall{view.wall.sense_s});
  column("wall_map_s", Wall{view.wall.map_s});
  column("wall_plan_s", Wall{view.wall.plan_s});
  column("wall_fly_s", Wall{view.wall.fly_s});
  column("via", d.via_world_m);
  if (columns.gimbal) column("gimbal_pitch", d.view.gimbal_pitch_rad);
  if (columns.plans) column("plan_view", d.plan_view);
  if (columns.energy) column("energy_wh", view.energy_wh);
}

std::string text_of(const auto& value) { return fmt::format("{}", value); }
std::string text_of(const Sampler& sampler) { return std::string(traits_of(sampler).name); }
std::string text_of(const std::optional<double>& value) { return value ? text_of(*value) : ""; }
std::string text_of(const Wall<const double>& wall) { return fmt::format("{:.6f}", wall.s); }
/// "x:y:z;x:y:z"; an empty cell for none.
std::string text_of(const std::vector<Vec3>& points_m) {
  std::string text;
  for (const Vec3& p : points_m) {
    text += fmt::format("{}{}:{}:{}", text.empty() ? "" : ";", p.x(), p.y(), p.z());
  }
  return text;
}

/// Each column's name and value.
struct Cells {
  std::vector<std::string> names = {};
  std::vector<std::string> values = {};
  bool has_walls = true;

  void operator()(std::string_view name, const auto& value) {
    names.emplace_back(name);
    values.push_back(text_of(value));
  }
  void operator()(std::string_view name, const Wall<const double>& wall) {
    if (!has_walls) return;
    names.emplace_back(name);
    values.push_back(text_of(wall));
  }
};

Cells cells_of(const ViewRecord& view, Columns columns, bool has_walls = true) {
  Cells cells{.has_walls = has_walls};
  visit_columns(view, columns, cells);
  return cells;
}

std::string joined(const std::vector<std::string>& cells) {
  return fmt::format("{}", fmt::join(cells, ","));
}

constexpr std::string_view kCheckColumn = ",check";

/// Of a row, with the check of the row before.
std::string check_of(std::string_view before, std::string_view row) {
  return sha256_of(fmt::format("{}{}", before, row)).substr(0, 16);
}

/// Cuts off the row's check. Throws BadInput when it is another's.
std::string take_check(std::string_view before, std::string_view& row, const TextPlace& place) {
  const std::size_t comma = row.rfind(',');
  const std::string_view cell = comma == row.npos ? row : row.substr(comma + 1);
  row = row.substr(0, std::min(comma, row.size()));
  const std::string check = check_of(before, row);
  if (cell == check) return check;
  throw BadInput("{}: is not the row that was written: edited or damaged", to_string(place));
}

/// A row's cells, read left to right.
struct Row {
  std::string_view rest;
  const TextPlace& place;

  void operator()(std::string_view name, double& value) {
    value = to_number(next_part(rest, ','), place, name);
  }
  void operator()(std::string_view name, std::optional<double>& value) {
    const std::string_view cell = next_part(rest, ',');
    if (!cell.empty()) value = to_number(cell, place, name);
  }
  void operator()(std::string_view name, int& count) {
    count = to_count(next_part(rest, ','), place, name);
  }
  void operator()(std::string_view name, std::size_t& count) {
    count = static_cast<std::size_t>(to_count(next_part(rest, ','), place, name));
  }
  void operator()(std::string_view name, Wall<double> wall) { (*this)(name, wall.s); }
  void operator()(std::string_view, Sampler& sampler) {
    const std::string_view cell = next_part(rest, ',');
    const auto known = sampler_named(cell);
    if (!known) throw BadInput("{}: '{}' is no sampler", to_string(place), cell);
    sampler = *known;
  }
  void operator()(std::string_view name, std::vector<Vec3>& points_m) {
    std::string_view points = next_part(rest, ',');
    while (!points.empty()) {
      std::string_view point = next_part(points, ';');
      if (std::count(point.begin(), point.end(), ':') != 2) {
        throw BadInput("{}: {} '{}' is no list of x:y:z", to_string(place), name, point);
      }
      Vec3& p_m = points_m.emplace_back();
      for (double& x : p_m) x = to_number(next_part(point, ':'), place, name);
    }
  }
};

std::string header_text(Columns columns) { return joined(cells_of({}, columns).names); }

ViewRecord record_of(std::string_view row, Columns columns, int iteration, const TextPlace& place) {
  const std::size_t expected = cells_of({}, columns).names.size();
  if (split(row, ',').size() != expected) {
    throw BadInput("{}: '{}' must have {} columns", to_string(place), row, expected);
  }
  ViewRecord view;
  visit_columns(view, columns, Row{row, place});
  if (view.iteration != iteration) {
    throw BadInput("{}: '{}' must be iteration {}", to_string(place), view.iteration, iteration);
  }
  const int number = view.decision.plan_view;
  if (number < 1 || number > std::max(iteration, 1)) {
    throw BadInput("{}: no plan has a view {} here", to_string(place), number);
  }
  return view;
}

}  // namespace

Columns columns_of(const Scenario& scenario) {
  const PlannerConfig& planner = scenario.planner;
  return {.gimbal = gimbal_of(scenario.cameras).has_value(),
          .plans = traits_of(planner).scores_views && planner.fvs.enabled &&
                   planner.fvs.mode == FvsMode::burst,
          .energy = true};
}

std::string iterations_csv(std::span<const ViewRecord> views, Columns columns) {
  std::string csv = header_text(columns) + "\n";
  for (const ViewRecord& view : views) csv += joined(cells_of(view, columns).values) + "\n";
  return csv;
}

std::string JournalRows::header() const {
  return fmt::format("{}{}\n", header_text(columns_), kCheckColumn);
}

std::string JournalRows::row(const ViewRecord& view) {
  const std::string cells = joined(cells_of(view, columns_).values);
  check_ = check_of(check_, cells);
  return fmt::format("{},{}\n", cells, check_);
}

std::optional<Difference> first_difference(const ViewRecord& now, const ViewRecord& recorded) {
  const Columns columns = {.gimbal = true, .plans = true, .energy = recorded.energy_wh.has_value()};
  const Cells of_now = cells_of(now, columns, false);
  const Cells of_recorded = cells_of(recorded, columns, false);
  for (std::size_t i = 0; i < of_now.names.size(); ++i) {
    if (of_now.values[i] == of_recorded.values[i]) continue;
    return Difference{of_now.names[i], of_now.values[i], of_recorded.values[i]};
  }
  return std::nullopt;
}

std::string views_sha256(std::span<const ViewRecord> views) {
  Sha256 sha;
  for (const ViewRecord& view : views) {
    // so that runs without bursts, and older ones, keep theirs
    const Columns columns = {.gimbal = true,
                             .plans = view.decision.plan_view != 1,
                             .energy = view.energy_wh.has_value()};
    sha.add(joined(cells_of(view, columns, false).values) + ",");
  }
  return sha.hex();
}

std::string decision_header() {
  Cells cells;
  const ViewRecord view;
  visit_decision(view, cells);
  return joined(cells.names);
}

std::string decision_cells(const ViewRecord& view) {
  Cells cells;
  visit_decision(view, cells);
  return joined(cells.values);
}

std::vector<ViewRecord> read_view_records(const std::filesystem::path& csv) {
  const std::string text = read_file(csv);
  std::vector<ViewRecord> views;
  Columns columns;
  bool has_checks = false;
  std::string check;
  const auto take = [&](std::string_view row, const TextPlace& place) {
    if (place.line > 1) {
      if (has_checks) check = take_check(check, row, place);
      views.push_back(record_of(row, columns, place.line - 2, place));
      return;
    }
    has_checks = row.ends_with(kCheckColumn);
    if (has_checks) row.remove_suffix(kCheckColumn.size());
    for (const int some : {1, 2, 3, 4, 5, 6, 7}) {
      const Columns more = {(some & 1) != 0, (some & 2) != 0, (some & 4) != 0};
      if (row == header_text(more)) columns = more;
    }
    need_header(row, header_text(columns), place,
                fmt::format(": of another version, and {} flies its mission again",
                            command_to_fly_again(csv.parent_path())));
  };
  for_each_line(std::string_view(text).substr(0, text.rfind('\n') + 1), csv, take);  // npos: none
  return views;
}

}  // namespace gnbv

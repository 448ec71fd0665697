#include "planner/tour/timed_tour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "planner/motion/config.hpp"
#include "planner/tour/tour_search.hpp"

namespace gnbv {
namespace {

constexpr float kNoWay_s = 1e6F;

/// Frames on the way are looked at so far apart.
constexpr double kEnRoute_m = 1.0;
constexpr double kEnRoute_rad = deg_to_rad(45.0);

constexpr std::uint32_t kStart = std::numeric_limits<std::uint32_t>::max();

/// How long each leg takes: a row for each view that a search has had in a tour.
class LegTable {
 public:
  explicit LegTable(const TimedProblem& problem)
      : problem_(problem), rows_s_(problem.poses.size() + 1) {
    for (const ViewPose& pose : problem.poses) {
      const auto known = std::find(yaws_rad_.begin(), yaws_rad_.end(), pose.yaw_rad);
      yaw_of_.push_back(static_cast<std::uint8_t>(known - yaws_rad_.begin()));
      if (known == yaws_rad_.end()) yaws_rad_.push_back(pose.yaw_rad);
    }
  }

  const TimedProblem& problem() const { return problem_; }
  const ViewPose& pose(std::uint32_t view) const {
    return view == kStart ? problem_.start : problem_.poses[view];
  }

  /// From the view, or the start, to each.
  const std::vector<float>& row_s(std::uint32_t from) {
    std::vector<float>& row = rows_s_[from == kStart ? problem_.poses.size() : from];
    if (!row.empty() || problem_.poses.empty()) return row;
    const OrienteeringProblem& views = *problem_.views;
    const std::span<const float> row_m =
        views.row_m(from == kStart ? views.start : views.node[from]);
    std::vector<float> turn_s;
    for (const double yaw_rad : yaws_rad_) {
      const double turn_rad = wrap_angle_rad(yaw_rad - pose(from).yaw_rad);
      turn_s.push_back(static_cast<float>(problem_.travel->turn_s(turn_rad)));
    }
    const auto per_m = static_cast<float>(problem_.travel->way_s(1.0));
    for (std::size_t v = 0; v < problem_.poses.size(); ++v) {
      row.push_back(std::min(kNoWay_s, std::max(per_m * row_m[views.node[v]], turn_s[yaw_of_[v]])));
    }
    return row;
  }

 private:
  const TimedProblem& problem_;
  std::vector<std::vector<float>> rows_s_;
  std::vector<double> yaws_rad_;
  std::vector<std::uint8_t> yaw_of_;  // of each view
};

/// Views in order, the start before them, while a search changes them.
class Sequence {
 public:
  explicit Sequence(LegTable& legs)
      : legs_(&legs),
        problem_(&legs.problem()),
        cover_(*problem_->views),
        held_(problem_->poses.size(), 0) {}

  const std::vector<std::uint32_t>& chosen() const { return order_; }

  double worth() const {
    const OrienteeringProblem& views = *problem_->views;
    return cover_.found() - views.price * (seconds() + views.way_per_view * double(order_.size()));
  }

  void append(std::uint32_t view) { insert(view, order_.size()); }

  void complete(double price_of_view, std::span<const double> weights) {
    const OrienteeringProblem& views = *problem_->views;
    while (true) {
      find_detours();
      double most = kTolerance * views.price;
      std::optional<std::uint32_t> best;
      for (std::uint32_t view = 0; view < extra_s_.size(); ++view) {
        if (held_[view] > 0 || extra_s_[view] >= kNoWay_s) continue;
        double rate = cover_.gains()[view] / (extra_s_[view] + price_of_view);
        if (!weights.empty()) rate *= static_cast<float>(weights[view]);
        if (rate <= most) continue;
        most = rate;
        best = view;
      }
      if (!best) return;
      insert(*best, static_cast<std::size_t>(at_[*best]));
    }
  }

  void drop_unpaid() {
    std::vector<std::pair<double, std::uint32_t>> unpaid;
    for (const std::uint32_t view : order_) {
      const double worth = worth_of(view);
      if (worth < 0.0) unpaid.emplace_back(worth, view);
    }
    std::sort(unpaid.begin(), unpaid.end());
    for (const auto& [worth, view] : unpaid) {
      if (worth_of(view) < 0.0) remove(place_of(view));
    }
  }

  void remove_some(Rng& rng) {
    constexpr std::size_t kFewest = 2;
    constexpr std::size_t kMost = 12;
    const std::size_t count = std::min(order_.size(), kFewest + rng.below(kMost - kFewest + 1));
    const std::size_t first = rng.below(order_.size());
    const std::size_t way = rng.below(3);
    std::vector<std::pair<double, std::uint32_t>> keyed;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const std::size_t after = (i + order_.size() - first) % order_.size();
      keyed.emplace_back(way == 0 ? static_cast<double>(after)
                         : way == 1
                             ? (pose(order_[i]).p_world_m - pose(order_[first]).p_world_m).norm()
                             : rng.uniform(),
                         order_[i]);
    }
    std::sort(keyed.begin(), keyed.end());
    for (std::size_t i = 0; i < count; ++i) remove(place_of(keyed[i].second));
  }

  void shorten() {
    const std::size_t stops = order_.size() + 1;
    Distances seconds(stops, std::vector<double>(stops, 0.0));
    for (std::size_t i = 0; i < stops; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        seconds[i][j] = seconds[j][i] =
            j == 0 ? between(kStart, order_[i - 1]) : between(order_[j - 1], order_[i - 1]);
      }
    }
    std::vector<std::size_t> tour(stops);
    std::iota(tour.begin(), tour.end(), std::size_t{0});
    improve_tour(seconds, tour);
    std::vector<std::uint32_t> order;
    for (std::size_t i = 1; i < stops; ++i) order.push_back(order_[tour[i] - 1]);
    if (order == order_) return;
    while (!order_.empty()) remove(order_.size() - 1);
    for (const std::uint32_t view : order) append(view);
  }

 private:
  const ViewPose& pose(std::uint32_t view) const { return legs_->pose(view); }
  std::uint32_t before(std::size_t place) const { return place == 0 ? kStart : order_[place - 1]; }
  std::size_t place_of(std::uint32_t view) const {
    return static_cast<std::size_t>(std::find(order_.begin(), order_.end(), view) - order_.begin());
  }

  double between(std::uint32_t a, std::uint32_t b) const { return legs_->row_s(a)[b]; }

  /// What turning off at b costs a vehicle in motion, up to 1.6 s where it comes back.
  double corner_s(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Vec3 in_m = pose(b).p_world_m - pose(a).p_world_m;
    const Vec3 out_m = pose(c).p_world_m - pose(b).p_world_m;
    const double scale_m2 = in_m.norm() * out_m.norm();
    if (scale_m2 == 0.0) return 0.0;
    constexpr double kBack_s = 1.6;
    return 0.5 * kBack_s * (1.0 - in_m.dot(out_m) / scale_m2);
  }

  double seconds() const {
    double sum_s = 0.0;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      sum_s += between(before(i), order_[i]);
      if (i > 0) sum_s += corner_s(before(i - 1), before(i), order_[i]);
    }
    return sum_s;
  }

  void hold(std::uint32_t view) {
    if (held_[view]++ == 0) cover_.set(view, true);
  }
  void let_go(std::uint32_t view) {
    if (--held_[view] == 0) cover_.set(view, false);
  }

  template <typename Use>
  void for_each_en_route(std::uint32_t a, std::uint32_t b, const Use& use) const {
    if (!problem_->view_at) return;
    const Vec3 way_m = pose(b).p_world_m - pose(a).p_world_m;
    const double turn_rad = wrap_angle_rad(pose(b).yaw_rad - pose(a).yaw_rad);
    const int steps = static_cast<int>(
        std::ceil(std::max(way_m.norm() / kEnRoute_m, std::abs(turn_rad) / kEnRoute_rad) - 1e-6));
    for (int i = 1; i < steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const auto view = problem_->view_at(
          {pose(a).p_world_m + share * way_m, pose(a).yaw_rad + share * turn_rad});
      if (view && *view != a && *view != b) use(*view);
    }
  }

  void insert(std::uint32_t view, std::size_t place) {
    const std::uint32_t a = before(place);
    if (place < order_.size()) {
      for_each_en_route(a, order_[place], [&](std::uint32_t v) { let_go(v); });
    }
    hold(view);
    for_each_en_route(a, view, [&](std::uint32_t v) { hold(v); });
    if (place < order_.size()) {
      for_each_en_route(view, order_[place], [&](std::uint32_t v) { hold(v); });
    }
    order_.insert(order_.begin() + static_cast<std::ptrdiff_t>(place), view);
  }

  void remove(std::size_t place) {
    const std::uint32_t view = order_[place];
    const std::uint32_t a = before(place);
    const bool has_next = place + 1 < order_.size();
    for_each_en_route(a, view, [&](std::uint32_t v) { let_go(v); });
    if (has_next) {
      for_each_en_route(view, order_[place + 1], [&](std::uint32_t v) { let_go(v); });
      for_each_en_route(a, order_[place + 1], [&](std::uint32_t v) { hold(v); });
    }
    let_go(view);
    order_.erase(order_.begin() + static_cast<std::ptrdiff_t>(place));
  }

  /// Of a chosen view: what it brings beyond its cost.
  double worth_of(std::uint32_t view) const {
    const std::size_t place = place_of(view);
    const std::uint32_t a = before(place);
    double saved_s = between(a, view);
    bool is_seen_without = held_[view] > 1;
    if (place + 1 < order_.size()) {
      const std::uint32_t b = order_[place + 1];
      saved_s += between(view, b) - between(a, b) + corner_s(a, view, b);
      for_each_en_route(a, b, [&](std::uint32_t v) { is_seen_without |= v == view; });
    }
    const OrienteeringProblem& views = *problem_->views;
    const double lost = is_seen_without ? 0.0 : cover_.loss_without(view);
    return lost - views.price * (views.way_per_view + saved_s);
  }

  /// What each view would add at the place where it adds the least, and where that is.
  void find_detours() {
    const std::size_t count = problem_->poses.size();
    extra_s_.assign(count, kNoWay_s);
    at_.assign(count, 0);
    for (std::size_t place = 0; place <= order_.size(); ++place) {
      const float* const in_s = legs_->row_s(before(place)).data();
      const bool is_last = place == order_.size();
      const float* const out_s = is_last ? nullptr : legs_->row_s(order_[place]).data();
      const float leg = is_last ? 0.0F : in_s[order_[place]];
      float* const least_s = extra_s_.data();
      std::int32_t* const at = at_.data();
      for (std::size_t v = 0; v < count; ++v) {
        const float extra = is_last ? in_s[v] : in_s[v] + out_s[v] - leg;
        at[v] = extra < least_s[v] ? static_cast<std::int32_t>(place) : at[v];
        least_s[v] = std::min(extra, least_s[v]);
      }
    }
    for (float& extra : extra_s_) extra = std::max(extra, 0.0F);
  }

  LegTable* legs_;
  const TimedProblem* problem_;
  ExpectedCover cover_;
  std::vector<std::uint16_t> held_;  // of each view: chosen, and how often it is seen from en route
  std::vector<std::uint32_t> order_;
  std::vector<float> extra_s_;
  std::vector<std::int32_t> at_;
};

}  // namespace

std::vector<std::uint32_t> solve(const TimedProblem& problem, std::span<const std::uint32_t> from,
                                 int iterations, std::uint64_t seed) {
  LegTable legs(problem);
  Sequence tour(legs);
  for (const std::uint32_t view : from) tour.append(view);
  tour.complete(1.0, {});
  tour.drop_unpaid();
  tour.shorten();
  return search(std::move(tour), problem.poses.size(), iterations, {.price = problem.views->price},
                seed)
      .chosen();
}

}  // namespace gnbv

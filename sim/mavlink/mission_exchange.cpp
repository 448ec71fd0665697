#include "sim/mavlink/mission_exchange.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "sim/mavlink/border.hpp"

namespace gnbv::mavlink {
namespace {

using Kind = MissionStep::Kind;
using Context = MissionExchange::Context;

enum ItemCommand : std::uint16_t {  // MAV_CMD
  kWaypoint = 16,
  kLoiterUnlimited = 17,
  kLoiterTime = 19,
  kReturnToLaunch = 20,
  kLand = 21,
  kTakeoff = 22,
  kDelay = 93,
  kChangeSpeed = 178
};
// regions of interest, triggers, mounts, cameras and gimbals
constexpr std::array<std::uint16_t, 19> kWithoutEffect = {195,  196,  197,  201,  203, 204,  205,
                                                          206,  214,  530,  531,  532, 1000, 1001,
                                                          2000, 2001, 2003, 2500, 2501};

constexpr std::uint8_t kFlightPlan = 0, kAllTypes = 255;  // MAV_MISSION_TYPE
constexpr double kRemind_s = 0.5;
constexpr double kGiveUp_s = 5.0;

/// Of parameter 1 to 7.
MissionResult invalid(int parameter) {
  return static_cast<MissionResult>(static_cast<int>(MissionResult::invalid_param1) + parameter -
                                    1);
}

/// Where the item is; NaN what it leaves open: a takeoff or a landing without a place (0, 0).
std::variant<Vec3, MissionResult> place_in(const MissionItemInt& item) {
  if (!is_global(item.frame)) return MissionResult::unsupported_frame;
  const bool is_open =
      (item.x == kNoCoordinate && item.y == kNoCoordinate) || (item.x == 0 && item.y == 0);
  if (std::abs(std::int64_t{item.x}) > 900'000'000 && !is_open) return invalid(5);
  if (std::abs(std::int64_t{item.y}) > 1'800'000'000 && !is_open) return invalid(6);
  Vec3 p_world_m = world_of_place(1e-7 * item.x, 1e-7 * item.y, static_cast<double>(item.z));
  const bool may_be_open = item.command == kTakeoff || item.command == kLand;
  if (is_open && may_be_open) p_world_m.head<2>().setConstant(kNotControlled);
  if (item.command == kLand) p_world_m.z() = 0.0;  // the ground is found by touch
  if (!std::isfinite(p_world_m.z())) return invalid(7);
  if (!is_in_bounds(p_world_m)) return invalid(5);
  return p_world_m;
}

/// Seconds, NaN for none.
std::optional<double> duration_s(float param) {
  if (std::isnan(param)) return 0.0;
  if (!(param >= 0.0F && std::isfinite(param))) return std::nullopt;
  return param;
}

std::variant<MissionStep, MissionResult> step_at_place(const MissionItemInt& item) {
  const auto place = place_in(item);
  if (const auto* const why = std::get_if<MissionResult>(&place)) return *why;
  MissionStep step{.kind = item.command == kTakeoff ? Kind::takeoff
                           : item.command == kLand  ? Kind::land
                                                    : Kind::waypoint,
                   .p_world_m = std::get<Vec3>(place),
                   .is_above_home = is_above_home(item.frame)};
  if (item.command == kLand) step.acceptance_m = 0.5;
  if (std::isinf(item.param[3])) return invalid(4);
  step.yaw_rad = swap_yaw_enu_ned(deg_to_rad(static_cast<double>(item.param[3])));
  if (item.command == kLoiterUnlimited) step.hold_s = std::numeric_limits<double>::infinity();
  if (item.command == kWaypoint || item.command == kLoiterTime) {
    const std::optional<double> hold_s = duration_s(item.param[0]);
    if (!hold_s) return invalid(1);
    step.hold_s = *hold_s;
  }
  if (item.command == kWaypoint && item.param[1] > 0.0F) {
    if (std::isinf(item.param[1])) return invalid(2);
    step.acceptance_m = item.param[1];
  }
  return step;
}

Frame acknowledged(MissionResult result, std::uint8_t type, std::uint8_t system_id,
                   std::uint8_t component_id) {
  return packed(MissionAck{system_id, component_id, static_cast<std::uint8_t>(result), type});
}

MissionExchange::Answer acknowledge(MissionResult result, std::uint8_t type,
                                    const Context& context) {
  return {acknowledged(result, type, context.system_id, context.component_id)};
}

/// One kind of item as the other: NaN is no coordinate.
template <typename To>
To converted(const auto& item, const auto& coordinate_of) {
  return To{item.param, coordinate_of(item.x), coordinate_of(item.y), item.z,
            item.seq,   item.command,          item.target_system,    item.target_component,
            item.frame, item.current,          item.autocontinue,     item.mission_type};
}

}  // namespace

std::variant<MissionStep, MissionResult> step_of(const MissionItemInt& item) {
  switch (item.command) {
    case kWaypoint:
    case kLoiterUnlimited:
    case kLoiterTime:
    case kLand:
    case kTakeoff:
      return step_at_place(item);
    case kReturnToLaunch:
      return MissionStep{.kind = Kind::return_home};
    case kDelay: {
      const std::optional<double> hold_s = duration_s(item.param[0]);
      if (!hold_s) return invalid(1);  // -1: until a time of day
      return MissionStep{.kind = Kind::waypoint, .hold_s = *hold_s};
    }
    case kChangeSpeed: {
      const double speed_m_s = item.param[1];
      if (item.param[0] != 0.0F && item.param[0] != 1.0F) return invalid(1);
      if (speed_m_s == -1.0) return MissionStep{};
      if (speed_m_s == -2.0) return MissionStep{.kind = Kind::speed};
      if (!(speed_m_s > 0.0 && speed_m_s <= 1e3)) return invalid(2);
      return MissionStep{.kind = Kind::speed, .speed_m_s = speed_m_s};
    }
    default:
      if (std::ranges::find(kWithoutEffect, item.command) == kWithoutEffect.end())
        return MissionResult::unsupported;
      return MissionStep{};
  }
}

MissionExchange::Answer MissionExchange::request_next(double now_s) {
  upload_->asked_s = now_s;
  Frame request = packed(MissionRequestInt{static_cast<std::uint16_t>(upload_->items.size()),
                                           upload_->system_id, upload_->component_id, kFlightPlan});
  if (upload_->asks_in_floats) request.message_id = MissionRequest::kInfo.id;  // all else is alike
  return {request};
}

bool MissionExchange::is_anothers_turn(const Context& context) const {
  return upload_ &&
         (upload_->system_id != context.system_id || upload_->component_id != context.component_id);
}

MissionExchange::Answer MissionExchange::receive(const MissionCount& asked,
                                                 const Context& context) {
  if (is_anothers_turn(context)) {
    return acknowledge(MissionResult::error, asked.mission_type, context);
  }
  if (asked.number == 0) {
    return receive(MissionClearAll{.mission_type = asked.mission_type}, context);
  }
  if (asked.mission_type != kFlightPlan) {
    return acknowledge(MissionResult::unsupported, asked.mission_type, context);
  }
  if (asked.number > kMissionItemsMax) {
    return acknowledge(MissionResult::no_space, kFlightPlan, context);
  }
  upload_ = Upload{.system_id = context.system_id,
                   .component_id = context.component_id,
                   .count = asked.number,
                   .heard_s = context.now_s,
                   .asked_s = context.now_s};
  return request_next(context.now_s);
}

MissionExchange::Answer MissionExchange::receive(const MissionItemInt& item,
                                                 const Context& context) {
  if (is_anothers_turn(context)) {
    return acknowledge(MissionResult::error, item.mission_type, context);
  }
  if (item.mission_type != kFlightPlan || !upload_) {
    const std::vector<MissionItemInt>& mission = context.aboard.mission;
    const bool is_last_again = !mission.empty() && payload_of(item) == payload_of(mission.back());
    return acknowledge(is_last_again ? MissionResult::accepted : MissionResult::invalid_sequence,
                       item.mission_type, context);
  }
  if (item.seq != upload_->items.size()) return {};  // one that came twice, or too early
  const auto read = step_of(item);
  if (const auto* const why = std::get_if<MissionResult>(&read)) {
    upload_.reset();
    return acknowledge(*why, kFlightPlan, context);
  }
  upload_->heard_s = context.now_s;
  upload_->items.push_back(item);
  upload_->steps.push_back(std::get<MissionStep>(read));
  upload_->steps.back().waits = item.autocontinue == 0;
  if (upload_->items.size() < upload_->count) return request_next(context.now_s);
  context.aboard.mission = std::move(upload_->items);
  context.px4.set_mission(std::move(upload_->steps));
  for (const MissionItemInt& sent : context.aboard.mission) {
    if (sent.current != 0) context.px4.set_current_step(sent.seq);
  }
  upload_.reset();
  return acknowledge(MissionResult::accepted, kFlightPlan, context);
}

MissionExchange::Answer MissionExchange::receive(const MissionItem& item, const Context& context) {
  const auto e7_of = [](float deg) {
    if (std::isnan(deg)) return kNoCoordinate;
    return static_cast<std::int32_t>(
        std::lround(1e7 * std::clamp(static_cast<double>(deg), -200.0, 200.0)));
  };
  return receive(converted<MissionItemInt>(item, e7_of), context);
}

MissionExchange::Answer MissionExchange::receive(const MissionRequestList& asked,
                                                 const Context& context) const {
  const std::size_t count = asked.mission_type == kFlightPlan ? context.aboard.mission.size() : 0;
  return {packed(MissionCount{static_cast<std::uint16_t>(count), context.system_id,
                              context.component_id, asked.mission_type})};
}

MissionExchange::Answer MissionExchange::receive(const MissionRequestInt& asked,
                                                 const Context& context) const {
  const std::vector<MissionItemInt>& mission = context.aboard.mission;
  if (asked.mission_type != kFlightPlan || asked.number >= mission.size()) {
    return acknowledge(MissionResult::invalid_sequence, asked.mission_type, context);
  }
  MissionItemInt item = mission[asked.number];
  item.target_system = context.system_id;
  item.target_component = context.component_id;
  item.current = context.px4.mission().current == asked.number ? 1 : 0;
  return {packed(item)};
}

MissionExchange::Answer MissionExchange::receive(const MissionRequest& asked,
                                                 const Context& context) const {
  Answer answer = receive(MissionRequestInt{asked.number, asked.target_system,
                                            asked.target_component, asked.mission_type},
                          context);
  if (answer[0].message_id != MissionItemInt::kInfo.id) return answer;
  const auto deg_of = [](std::int32_t e7) {
    return e7 == kNoCoordinate ? std::nanf("") : static_cast<float>(1e-7 * e7);
  };
  return {packed(converted<MissionItem>(message_of<MissionItemInt>(answer[0].payload), deg_of))};
}

MissionExchange::Answer MissionExchange::receive(const MissionClearAll& asked,
                                                 const Context& context) {
  if (asked.mission_type == kFlightPlan || asked.mission_type == kAllTypes) {
    upload_.reset();
    context.aboard.mission.clear();
    context.px4.set_mission({});
  }
  return acknowledge(MissionResult::accepted, asked.mission_type, context);
}

MissionExchange::Answer MissionExchange::receive(const MissionAck& told, const Context& context) {
  if (told.result != 0 && !is_anothers_turn(context)) upload_.reset();  // the client gives up
  return {};
}

MissionExchange::Answer MissionExchange::remind(double now_s) {
  if (!upload_ || now_s - upload_->asked_s < kRemind_s) return {};
  upload_->asks_in_floats = !upload_->asks_in_floats;  // which is all that old clients know
  if (now_s - upload_->heard_s < kGiveUp_s) return request_next(now_s);
  const Upload over = *std::exchange(upload_, std::nullopt);
  return {acknowledged(MissionResult::cancelled, kFlightPlan, over.system_id, over.component_id)};
}

}  // namespace gnbv::mavlink

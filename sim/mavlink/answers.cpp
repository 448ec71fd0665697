#include "sim/mavlink/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "sim/mavlink/link.hpp"
#include "sim/mavlink/parameters.hpp"
#include "sim/mavlink/query_messages.hpp"
#include "sim/mavlink/telemetry.hpp"

namespace gnbv::mavlink {
namespace {

using Answers = std::vector<Packed>;

// MAV_MISSION_RESULT
constexpr std::uint8_t kMissionAccepted = 0;
constexpr std::uint8_t kMissionUnsupported = 3;
constexpr std::uint8_t kMissionInvalidSequence = 13;

std::int64_t now_ns(const Quadrotor& vehicle) {
  return vehicle.tick() * (1'000'000'000 / kTicksPerSecond);
}

std::string text_of(const ParameterId& id) { return {id.begin(), std::ranges::find(id, '\0')}; }

/// Short enough for one STATUSTEXT.
Packed refusal(const std::string& text) {
  return packed(status_texts_of({.severity = kSeverityCritical, .text = text}, 1).front());
}

Answers answer(const ParamRequestList&, const Frame&, Quadrotor& vehicle) {
  Answers all;
  for (int i = 0; const auto value = parameter_at(vehicle.px4().commander(), i); ++i) {
    all.push_back(packed(*value));
  }
  return all;
}

Answers answer(const ParamRequestRead& asked, const Frame&, Quadrotor& vehicle) {
  const int index =
      asked.param_index >= 0 ? asked.param_index : find_parameter(asked.param_id).value_or(-1);
  if (const auto value = parameter_at(vehicle.px4().commander(), index)) return {packed(*value)};
  return {refusal(asked.param_index >= 0
                      ? fmt::format("no parameter {}", asked.param_index)
                      : fmt::format("no parameter {}", text_of(asked.param_id)))};
}

Answers answer(const ParamSet& asked, const Frame&, Quadrotor& vehicle) {
  const std::optional<int> index = find_parameter(asked.param_id);
  if (!index) return {refusal(fmt::format("no parameter {}", text_of(asked.param_id)))};
  CommanderParameters commander = vehicle.px4().commander();
  Answers answers;
  if (set_parameter(commander, *index, asked)) {
    vehicle.px4().set_commander(commander);
  } else {
    answers.push_back(refusal(fmt::format("parameter {} not set", text_of(asked.param_id))));
  }
  answers.push_back(packed(*parameter_at(vehicle.px4().commander(), *index)));
  return answers;
}

Answers answer(const MissionRequestList& asked, const Frame& from, Quadrotor&) {
  return {packed(MissionCount{.target_system = from.system_id,
                              .target_component = from.component_id,
                              .mission_type = asked.mission_type})};
}

Answers mission_ack(std::uint8_t result, std::uint8_t mission_type, const Frame& from) {
  return {packed(MissionAck{from.system_id, from.component_id, result, mission_type})};
}

Answers answer(const MissionCount& asked, const Frame& from, Quadrotor&) {
  return mission_ack(asked.count == 0 ? kMissionAccepted : kMissionUnsupported, asked.mission_type,
                     from);
}

Answers answer(const MissionClearAll& asked, const Frame& from, Quadrotor&) {
  return mission_ack(kMissionAccepted, asked.mission_type, from);
}

template <std::uint32_t id, std::uint8_t crc_extra>
Answers answer(const AnyMissionRequest<id, crc_extra>& asked, const Frame& from, Quadrotor&) {
  return mission_ack(kMissionInvalidSequence, asked.mission_type, from);
}

Answers answer(const MissionAck&, const Frame&, Quadrotor&) { return {}; }

Answers answer(const Timesync& asked, const Frame& from, Quadrotor& vehicle) {
  if (asked.tc1_ns != 0) return {};  // an answer, and we never ask
  return {packed(Timesync{now_ns(vehicle), asked.ts1_ns, from.system_id, from.component_id})};
}

Answers answer(const Ping& asked, const Frame& from, Quadrotor&) {
  if (asked.target_system != 0) return {};  // an answer likewise
  return {packed(Ping{asked.time_us, asked.seq, from.system_id, from.component_id})};
}

template <typename Message>
std::optional<Answers> answer_if(const Frame& frame, Quadrotor& vehicle) {
  const auto message = message_of<Message>(frame.payload);
  if (!is_for_us(message.target_system, message.target_component)) return std::nullopt;
  return answer(message, frame, vehicle);
}

/// The first of these kinds that the frame is.
template <typename... Messages>
std::optional<Answers> answer_any(const Frame& frame, Quadrotor& vehicle) {
  std::optional<Answers> answers;
  const auto is_it = [&]<typename Message>() {
    if (frame.message_id != Message::kInfo.id) return false;
    answers = answer_if<Message>(frame, vehicle);
    return true;
  };
  (void)(is_it.template operator()<Messages>() || ...);
  return answers;
}

}  // namespace

std::optional<Answers> answers_to(const Frame& question, Quadrotor& vehicle) {
  return answer_any<ParamRequestList, ParamRequestRead, ParamSet, MissionRequestList, MissionCount,
                    MissionClearAll, MissionRequest, MissionRequestInt, MissionAck, Timesync, Ping>(
      question, vehicle);
}

}  // namespace gnbv::mavlink

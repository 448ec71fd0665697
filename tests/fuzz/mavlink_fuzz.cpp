// Whatever arrives as a datagram: reading it never fails, and what was read keeps its promises.
// libFuzzer runs it with its own main (tools/fuzz); the tests run it over the corpus.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/mavlink/border.hpp"
#include "sim/mavlink/link.hpp"

namespace gnbv::mavlink {
namespace {

void check_setpoint(const Frame& frame) {
  const auto message = message_of<SetPositionTargetLocalNed>(frame.payload);
  const auto read = setpoint_of(message, 0.5);
  const auto* const setpoint = std::get_if<Setpoint>(&read);
  if (setpoint == nullptr) return;
  const auto check_bound = [](const Vec3& v, double limit) {
    GNBV_CHECK(!(v.array().abs() > limit).any(), "a setpoint beyond {}", limit);
  };
  check_bound(setpoint->p_world_m, 1e6);
  check_bound(setpoint->v_world_m_s, 1e3);
  check_bound(setpoint->a_world_m_s2, 1e3);
  GNBV_CHECK(!(std::abs(setpoint->yaw_rad) > kPi), "a yaw of {}", setpoint->yaw_rad);
}

/// A frame that was read is written and read again as the same.
void check_round_trip(const Frame& frame) {
  ReadCounts counts;
  const std::vector<Frame> again = read_frames(write_frame(frame), counts);
  GNBV_CHECK(again.size() == 1 && again[0].payload == frame.payload &&
                 again[0].message_id == frame.message_id && again[0].sequence == frame.sequence &&
                 again[0].system_id == frame.system_id &&
                 again[0].component_id == frame.component_id,
             "message {}", frame.message_id);
}

void check(std::span<const std::uint8_t> datagram) {
  Link link;
  const std::vector<Frame> frames = link.receive(datagram, {1, 1}, 0.0, false);
  for (const Frame& frame : frames) {
    check_round_trip(frame);
    if (frame.message_id == SetPositionTargetLocalNed::kInfo.id) check_setpoint(frame);
  }
  const LinkCounts& counts = link.counts();
  GNBV_CHECK(counts.accepted == frames.size() && counts.accepted == counts.frames.read,
             "frames that nobody accounts for");
  GNBV_CHECK(link.client().has_value() == (counts.frames.read > 0), "a client of bad frames");
  GNBV_CHECK(frames.empty() || link.receive(datagram, {1, 2}, 1.0, true).empty(),
             "a vehicle taken over in flight");
}

/// The bytes as the payload of a setpoint, framed well: mutations would hardly ever find the CRC.
std::vector<std::uint8_t> framed_setpoint(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> payload(bytes.begin(), bytes.end());
  payload.resize(SetPositionTargetLocalNed::kInfo.size, 0);
  return write_frame({0, 255, 190, SetPositionTargetLocalNed::kInfo.id, payload});
}

}  // namespace
}  // namespace gnbv::mavlink

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gnbv::mavlink::check({data, size});
  gnbv::mavlink::check(gnbv::mavlink::framed_setpoint({data, size}));
  return 0;
}

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/mavlink/serve.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/live/camera_stream.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

struct FlyOptions {
  ScenarioOptions scenario;
  std::vector<std::string> urls = {"udpout://127.0.0.1:14540"};  // PX4's onboard link
  std::string local_origin = "home";
  double speed = 1.0;
  double duration_s = 0.0;
  CameraStreamOptions cameras;
  bool json = false;
};

constexpr std::string_view kRtp = "rtp://";

constexpr std::array<std::string_view, 3> kServeEndNames = {"stopped", "duration", "collision"};

using Stations = std::vector<std::unique_ptr<Station>>;

/// One of the counts, of all links together.
std::uint64_t sum(const Stations& stations, const auto& count_of) {
  std::uint64_t all = 0;
  for (const auto& station : stations) all += count_of(station->endpoint);
  return all;
}

nlohmann::ordered_json summary_of(const Scenario& scenario, const Quadrotor& vehicle,
                                  const Stations& stations, const ServeResult& result) {
  using mavlink::EndpointCounts;
  using mavlink::LinkCounts;
  using mavlink::ReadCounts;
  const auto obeyed = [&](std::uint64_t EndpointCounts::*count) {
    return sum(stations, [&](const mavlink::Endpoint& e) { return e.counts().*count; });
  };
  const auto link = [&](std::uint64_t LinkCounts::*count) {
    return sum(stations, [&](const mavlink::Endpoint& e) { return e.link_counts().*count; });
  };
  const auto frames = [&](std::uint64_t ReadCounts::*count) {
    return sum(stations, [&](const mavlink::Endpoint& e) { return e.link_counts().frames.*count; });
  };
  return {{"schema", "gnbv-fly-1"},
          {"scenario", scenario.name},
          {"preset", scenario.vehicle.preset},
          {"seed", scenario.seed},
          {"end", kServeEndNames.at(static_cast<std::size_t>(result.end))},
          {"flight_time_s", static_cast<double>(vehicle.tick()) * kTick_s},
          {"wall_s", result.wall_s},
          {"energy_wh", vehicle.energy_wh()},
          {"datagrams", link(&LinkCounts::datagrams)},
          {"accepted", link(&LinkCounts::accepted)},
          {"setpoints", obeyed(&EndpointCounts::setpoints)},
          {"refused_setpoints", obeyed(&EndpointCounts::refused_setpoints)},
          {"commands", obeyed(&EndpointCounts::commands)},
          {"questions", obeyed(&EndpointCounts::questions)},
          {"ignored", obeyed(&EndpointCounts::ignored)},
          {"sent", obeyed(&EndpointCounts::sent)},
          {"unsaid", obeyed(&EndpointCounts::unsaid)},
          {"dropped",
           {{"bad_crc", frames(&ReadCounts::bad_crc)},
            {"truncated", frames(&ReadCounts::truncated)},
            {"oversized", frames(&ReadCounts::oversized)},
            {"unknown", frames(&ReadCounts::unknown)},
            {"oversized_datagrams", link(&LinkCounts::oversized_datagrams)},
            {"foreign_datagrams", link(&LinkCounts::foreign_datagrams)}}}};
}

/// The same figures in two lines.
std::string text_of(const nlohmann::ordered_json& s) {
  std::string dropped;
  for (const auto& [reason, count] : s.at("dropped").items()) {
    dropped +=
        fmt::format("{}{} {}", dropped.empty() ? "" : ", ", count.get<std::uint64_t>(), reason);
  }
  const auto count = [&](const char* key) { return s.at(key).get<std::uint64_t>(); };
  return fmt::format(
      "{}: {:.2f} s simulated in {:.2f} s, {:.2f} Wh, end: {}\n"
      "frames: {} accepted ({} setpoints, {} refused, {} commands, {} questions, {} ignored), {} "
      "sent; dropped: {}\n",
      s.at("scenario").get<std::string>(), s.at("flight_time_s").get<double>(),
      s.at("wall_s").get<double>(), s.at("energy_wh").get<double>(), s.at("end").get<std::string>(),
      count("accepted"), count("setpoints"), count("refused_setpoints"), count("commands"),
      count("questions"), count("ignored"), count("sent"), dropped);
}

void need_ground_and_rotors(const Scenario& scenario) {
  if (scenario.vehicle.kind != VehicleKind::quadrotor) {
    throw BadInput("vehicle.kind: `gnbv fly` flies the quadrotor; set it to quadrotor");
  }
  if (!scenario.structure.ground && scenario.terrain.path.empty()) {
    throw BadInput("structure.ground: `gnbv fly` starts on the ground; set it to true");
  }
}

/// Where a mission of this scenario would begin, for a vehicle that stands on the ground below.
ViewPose ground_start(const Scenario& scenario, const World& world, const RayScene& scene) {
  const ViewPose start = start_pose(scenario, scene);
  const AirframeParameters& airframe = scenario.vehicle.airframe;
  const double half_height_m = 0.5 * airframe.hull_height_m;
  const double clearance_m = std::hypot(airframe.hull_radius_m, half_height_m);
  const double ground_m = ground_height_m(world, start.p_world_m);
  if (std::isinf(ground_m)) {
    throw BadInput("start.position_m: there is no terrain below x {:.2f} y {:.2f} m",
                   start.p_world_m.x(), start.p_world_m.y());
  }
  const Vec3 on_ground_world_m(start.p_world_m.x(), start.p_world_m.y(), ground_m + half_height_m);
  constexpr unsigned kStands = kStructurePart | kObstaclePart;
  if (scene.distance_m(kStands, on_ground_world_m, clearance_m) >= clearance_m) return start;
  throw BadInput(
      "start.position_m: a vehicle on the ground at x {:.2f} y {:.2f} m, below the start, is "
      "within {:.2f} m of what stands there, which its hull takes: move the start away from it",
      start.p_world_m.x(), start.p_world_m.y(), clearance_m);
}

void warn_beyond_loopback(const mavlink::Meeting& meeting) {
  if (mavlink::is_loopback(meeting.address)) return;
  const std::string url = mavlink::url_of(meeting.address);
  if (meeting.speaks_first) {
    say("warning: {} is another machine, and MAVLink asks for no key: whoever can send from there "
        "flies the vehicle",
        url);
  } else {
    say("warning: {} can be reached from other machines, and MAVLink asks for no key: whoever "
        "speaks to it first flies the vehicle; 127.0.0.1 is this machine alone",
        url);
  }
}

/// Where, and what stands there, in the line that scripts wait for.
void say_ready(const FlyOptions& options, const mavlink::Meeting& meeting,
               const mavlink::Address& bound, const VehicleConfig& vehicle, const ViewPose& start) {
  const std::string where =
      meeting.speaks_first
          ? fmt::format("speaking to udpout{} from {}", mavlink::url_of(meeting.address).substr(3),
                        mavlink::url_of(bound))
          : fmt::format("listening on {}", mavlink::url_of(bound));
  say("{}, {} {} at x {:.2f} y {:.2f} m, speed {}; Ctrl-C ends", where, vehicle.preset,
      vehicle.system_id, start.p_world_m.x(), start.p_world_m.y(), options.speed);
}

/// What the cameras see, for others, if they are to; what MAVLink says of it is then aboard.
std::unique_ptr<CameraStream> stream_of(const FlyOptions& options, const Scenario& scenario,
                                        const RayScene& scene, mavlink::Aboard& aboard) {
  CameraStreamOptions stream = options.cameras;
  if (stream.folder.empty() && stream.video_url.empty()) return nullptr;
  stream.seed = scenario.seed;
  stream.speed = options.speed;
  std::vector<CameraModel> cameras;
  for (const CameraConfig& camera : scenario.cameras) cameras.push_back(make_camera_model(camera));
  if (!stream.video_url.empty() && !cameras.empty()) {
    const CameraModel& first = cameras.front();
    aboard.video =
        mavlink::VideoStream{.camera = first.config.name,
                             .width_px = first.config.width_px,
                             .height_px = first.config.height_px,
                             .rate_hz = stream.rate_hz,
                             .fov_x_deg = rad_to_deg(first.sight_rad.sizes().x()),
                             .port = mavlink::resolve_partner(stream.video_url, kRtp).port};
  }
  return std::make_unique<CameraStream>(scene, std::move(cameras), std::move(stream));
}

[[noreturn]] void fail_of_collision(const Scenario& scenario, const RayScene& scene,
                                    const Quadrotor& vehicle) {
  const Vec3 p_world_m = vehicle.state().T_world_body.translation();
  const AirframeParameters& airframe = scenario.vehicle.airframe;
  const double reach_m = std::hypot(airframe.hull_radius_m, 0.5 * airframe.hull_height_m) + 0.05;
  const bool is_structure = !std::isinf(scene.distance_to_structure_m(p_world_m, reach_m));
  const double time_s = static_cast<double>(vehicle.tick()) * kTick_s;
  throw CommandFailed("the vehicle hit {} at [{:.2f}, {:.2f}, {:.2f}] m after {:.2f} s",
                      is_structure ? "the structure" : "an obstacle", p_world_m.x(), p_world_m.y(),
                      p_world_m.z(), time_s);
}

void fly(const FlyOptions& options) {
  const Scenario scenario = resolve_scenario(options.scenario);
  need_ground_and_rotors(scenario);
  std::vector<mavlink::Meeting> meetings;
  for (const std::string& url : options.urls) {
    const mavlink::Meeting meeting = mavlink::resolve_meeting(url);
    if (meeting.address.port != 0 && std::ranges::find(meetings, meeting) != meetings.end()) {
      throw BadInput("--mavlink: value '{}': that client is served already", url);
    }
    meetings.push_back(meeting);
  }
  std::vector<std::string> warnings;
  const World world = load_world(scenario, warnings);
  for (const std::string& warning : warnings) say(warning);
  const RayScene scene(world);
  const ViewPose start = ground_start(scenario, world, scene);
  Quadrotor vehicle(scenario.vehicle, world, start, scenario.seed, Px4::Start::on_ground,
                    scenario.wind);
  mavlink::Aboard aboard{.system_id = static_cast<std::uint8_t>(scenario.vehicle.system_id),
                         .battery_wh = scenario.vehicle.power.battery_wh};
  if (options.local_origin == "home") {
    aboard.origin_world_m = vehicle.estimate().T_world_body.translation();
  }
  const std::unique_ptr<CameraStream> cameras = stream_of(options, scenario, scene, aboard);
  Stations stations;
  for (const mavlink::Meeting& meeting : meetings) {
    stations.push_back(std::make_unique<Station>(aboard, meeting));
  }

  const InterruptGuard interrupt;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const mavlink::Meeting& meeting = meetings[i];
    const mavlink::Address bound = stations[i]->socket.address();
    warn_beyond_loopback(meeting.speaks_first ? meeting : mavlink::Meeting{bound});
    say_ready(options, meeting, bound, scenario.vehicle, start);
  }
  const auto on_lag = [&options] {
    say("this machine does not always keep up with --speed {}: it does not catch up lost time",
        options.speed);
  };
  const auto show = [&cameras](const Quadrotor& flown) {
    if (!cameras) return;
    cameras->offer(flown.state().T_world_body, kTick_s * static_cast<double>(flown.tick()));
  };
  const ServeResult result = serve(vehicle, aboard, stations,
                                   {.speed = options.speed,
                                    .duration_s = options.duration_s,
                                    .should_stop = InterruptGuard::requested,
                                    .on_lag = on_lag,
                                    .on_turn = show});
  const nlohmann::ordered_json summary = summary_of(scenario, vehicle, stations, result);
  fmt::print("{}", options.json ? summary.dump(2) + "\n" : text_of(summary));
  if (result.end == ServeEnd::collision) fail_of_collision(scenario, scene, vehicle);
}

}  // namespace

void add_fly_command(CLI::App& app) {
  auto options = std::make_shared<FlyOptions>();
  CLI::App* const command = app.add_subcommand("fly", "serve the vehicle to a MAVLink client");
  command->footer(
      "The vehicle stands on the ground at the scenario's start, disarmed. It is\n"
      "component 1 of the system that vehicle.system_id names.\n\n"
      "udpout: the vehicle speaks first, as PX4 does. MAVSDK and pymavlink wait at\n"
      "port 14540 of this machine, QGroundControl at 14550. It hears nobody else.\n\n"
      "udpin: the vehicle waits, and answers the first client that sends it a good\n"
      "frame. While it is armed it hears nobody else. While it is not, it turns to\n"
      "another client after the first was silent for 5 s, or when another asks for\n"
      "something and the first asked for nothing in 5 s.\n\n"
      "Local NED counts from where the vehicle stands, as PX4's does. With\n"
      "--local-origin scenario it counts from the scenario's origin: north is y, east\n"
      "is x. That origin lies at 47.397742 N 8.545594 E, with z = 0 at sea level.");
  add_scenario_options(*command, options->scenario);
  command
      ->add_option("--mavlink", options->urls,
                   "udpout://HOST:PORT to speak to, or udpin://HOST:PORT (or udp://) to listen at; "
                   "port 0 finds a free one; repeatable")
      ->allow_extra_args(false)
      ->capture_default_str();
  command
      ->add_option("--local-origin", options->local_origin,
                   "where local NED is 0, 0, 0: home or scenario")
      ->check(CLI::IsMember({"home", "scenario"}))
      ->capture_default_str();
  command
      ->add_option("--speed", options->speed,
                   "simulated seconds per second. Setpoints have to come within COM_OF_LOSS_T / "
                   "speed of wall time")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--duration", options->duration_s, "simulated seconds (default: until Ctrl-C)")
      ->check(CLI::Range(0.004, 1e9));
  command->add_option("--frames", options->cameras.folder,
                      "folder for the newest frame of each camera, CAMERA.npy: numpy.load() reads "
                      "depth, colour, K and time; under /dev/shm it is memory");
  command
      ->add_option("--video", options->cameras.video_url,
                   "rtp://HOST:PORT, to which ffmpeg sends the colour of the first camera as "
                   "H.264; QGroundControl waits at port 5600")
      ->check([](const std::string& url) {
        return url.starts_with(kRtp) ? "" : fmt::format("value '{}': write rtp://HOST:PORT", url);
      });
  command
      ->add_option("--frames-hz", options->cameras.rate_hz,
                   "frames of each camera a simulated second, as far as the machine keeps up")
      ->check(CLI::Range(0.01, 250.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "print the summary as JSON");
  command->callback([options] { fly(*options); });
}

}  // namespace gnbv

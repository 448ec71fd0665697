// What clients of PX4 count on beyond commands and streams: places from home, go-to, several links.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/sim/mavlink/mavlink_session.hpp"

namespace gnbv::mavlink {
namespace {

enum Command : std::uint16_t { kNavTakeoff = 22, kDoChangeSpeed = 178, kDoReposition = 192 };

const ViewPose kStart = {Vec3(7, -3, 0), 0.4};

/// Local NED counts from where it stands, as `gnbv fly` has it.
Session at_home(std::uint8_t system_id = 1) {
  return Session({.system_id = system_id, .origin_world_m = Vec3(7, -3, 0.055)}, std::nullopt,
                 kStart);
}

void take_off(Session& session) {
  session.command(kArmDisarm, 1);
  session.send(CommandLong{.param = {0, 0, 0, 0, 0, 0, std::nanf("")},
                           .command = kNavTakeoff,
                           .target_system = 1,
                           .target_component = 1});
  session.step_for(8);
}

Vec3 place(Session& session) { return session.vehicle().state().T_world_body.translation(); }

TEST(MavlinkParity, LocalPlacesCountFromHomeAndHoveringThereIsAboveTheStart) {
  Session session = at_home();
  session.send(Heartbeat{});
  session.step_for(1);
  for (const float coordinate : session.last<LocalPositionNed>().p_ned_m) {
    EXPECT_NEAR(coordinate, 0.0, 1e-3);
  }
  const auto hover = [&] {
    session.send(SetPositionTargetLocalNed{.p_m = {0, 0, -2},
                                           .type_mask = 2552,
                                           .target_system = 1,
                                           .target_component = 1,
                                           .coordinate_frame = 1});
  };
  hover();
  session.command(kDoSetMode, 1, 6);
  session.command(kArmDisarm, 1);
  for (int tick = 0; tick < 15 * kTicksPerSecond; ++tick) {
    if (tick % 10 == 0) hover();
    session.step();
  }
  EXPECT_LT((place(session) - Vec3(7, -3, 2.055)).norm(), 0.1);
  EXPECT_NEAR(session.last<Odometry>().p_m[2], -2.0, 0.1);
  EXPECT_EQ(session.last<Heartbeat>().custom_mode, 6U << 16);
  EXPECT_EQ(session.last<ExtendedSysState>().landed_state, 2);
  std::string said;
  for (const auto& text : session.all<StatusText>()) said += std::string(text.text.data()) + "\n";
  EXPECT_NE(said.find("Local NED counts from world x 7.00 y -3.00\n"), std::string::npos) << said;
  // the globe stays the world's: home is where the origin of local places is
  const auto home = session.last<HomePosition>();
  EXPECT_EQ(home.place.lat_deg_e7, place_of(kStart.p_world_m).lat_deg_e7);
  EXPECT_NEAR(home.p_ned_m[0], 0.0, 1e-3);
}

TEST(MavlinkParity, APlaceOnTheGlobeIsOnePlaceInBothDirections) {
  for (const Vec3& p_m : {Vec3(0, 0, 0), Vec3(120, -80, 35), Vec3(-5e3, 2e3, -1)}) {
    const GlobalPlace at = place_of(p_m);
    const Vec3 back = world_of_place(1e-7 * at.lat_deg_e7, 1e-7 * at.lon_deg_e7, 1e-3 * at.alt_mm);
    EXPECT_LT((back - p_m).norm(), 0.02) << p_m.transpose();  // 1e-7 deg is 11 mm
  }
}

TEST(MavlinkParity, GoesWhereItIsSentByLatitudeOrLocallyAndStays) {
  Session session = at_home();
  take_off(session);
  const GlobalPlace goal = place_of(Vec3(12, 5, 4));
  CommandInt go{.param = {-1, 1, 0, std::nanf("")},
                .x = goal.lat_deg_e7,
                .y = goal.lon_deg_e7,
                .z = 4,
                .command = kDoReposition,
                .target_system = 1,
                .target_component = 1,
                .frame = 6};
  EXPECT_EQ(session.answers<CommandAck>(go).at(0).result, 0);
  session.step_for(15);
  EXPECT_LT((place(session) - Vec3(12, 5, 4)).norm(), 0.1);
  EXPECT_EQ(session.vehicle().px4().nav_state(), NavState::hold);
  go.frame = 1;  // 1e-4 m north and east of home
  go.x = go.y = 0;
  go.z = -2;
  go.param[0] = 1;  // slowly
  EXPECT_EQ(session.answers<CommandAck>(go).at(0).result, 0);
  double top_m_s = 0.0;
  for (int i = 0; i < 20 * kTicksPerSecond; ++i) {
    session.step();
    top_m_s = std::max(top_m_s, session.vehicle().state().v_world_m_s.head<2>().norm());
  }
  EXPECT_LT((place(session) - Vec3(7, -3, 2.055)).norm(), 0.1);
  EXPECT_NEAR(top_m_s, 1.0, 0.15);
  for (const auto& [param2, frame, z, result] :
       {std::tuple{0, 6, 4.0F, 3}, {3, 6, 4.0F, 3}, {1, 7, 4.0F, 2}, {1, 6, 3e38F, 2}}) {
    go.param[1] = static_cast<float>(param2);
    go.frame = static_cast<std::uint8_t>(frame);
    go.z = z;
    EXPECT_EQ(session.answers<CommandAck>(go).at(0).result, result) << frame << " " << z;
  }
  EXPECT_LT((place(session) - Vec3(7, -3, 2.055)).norm(), 0.1) << "nothing moved";
  Session standing = at_home();
  EXPECT_EQ(standing
                .answers<CommandAck>(CommandLong{.param = {-1, 1},
                                                 .command = kDoReposition,
                                                 .target_system = 1,
                                                 .target_component = 1})
                .at(0)
                .result,
            2)
      << "0 N 0 E";
}

TEST(MavlinkParity, AGlobalSetpointIsThatPlace) {
  Session session = at_home();
  const GlobalPlace goal = place_of(Vec3(9, -1, 3));
  const auto stream = [&] {
    session.send(SetPositionTargetGlobalInt{.lat_deg_e7 = goal.lat_deg_e7,
                                            .lon_deg_e7 = goal.lon_deg_e7,
                                            .alt_m = 3,
                                            .type_mask = 2552,
                                            .target_system = 1,
                                            .target_component = 1,
                                            .coordinate_frame = 6});
  };
  stream();
  session.command(kDoSetMode, 1, 6);
  session.command(kArmDisarm, 1);
  for (int tick = 0; tick < 15 * kTicksPerSecond; ++tick) {
    if (tick % 10 == 0) stream();
    session.step();
  }
  EXPECT_LT((place(session) - Vec3(9, -1, 3)).norm(), 0.1);
}

TEST(MavlinkParity, ChangingSpeedIsAcceptedWithinTheVehiclesAndElseDenied) {
  Session session;
  for (const auto& [kind, speed, result] :
       {std::tuple(1.0F, 3.0F, 0), std::tuple(0.0F, -1.0F, 0), std::tuple(1.0F, -2.0F, 0),
        std::tuple(1.0F, 100.0F, 2), std::tuple(1.0F, 0.0F, 2), std::tuple(1.0F, std::nanf(""), 2),
        std::tuple(2.0F, 1.0F, 3)}) {
    EXPECT_EQ(session.result_of(kDoChangeSpeed, kind, speed), result) << kind << " " << speed;
  }
}

TEST(MavlinkParity, OnlyWhatIsForItsSystemIsHeardAndSaidUnderItsNumber) {
  Session session = at_home(7);
  session.command(kArmDisarm, 1);  // for system 1
  EXPECT_FALSE(session.vehicle().px4().is_armed());
  session.send(CommandLong{.param = {1}, .command = kArmDisarm, .target_system = 7});
  EXPECT_TRUE(session.vehicle().px4().is_armed());
  Aboard aboard{.system_id = 7};
  Endpoint endpoint(aboard, kClient);
  ReadCounts counts;
  for (const auto& bytes : endpoint.take_outgoing(0.0, session.vehicle(), {})) {
    EXPECT_EQ(read_frames(bytes, counts).at(0).system_id, 7);
  }
  EXPECT_GT(counts.read, 5U);
}

TEST(MavlinkParity, EveryLinkHearsTheNewsAndItsOwnAnswersAlone) {
  Quadrotor vehicle({}, World{}, ViewPose{}, 1, Px4::Start::on_ground);
  Aboard aboard;
  const Address other{0x7f000001, 40002};
  std::array endpoints = {Endpoint(aboard, kClient), Endpoint(aboard, other)};
  const CommandLong arm{
      .param = {1}, .command = kArmDisarm, .target_system = 1, .target_component = 1};
  endpoints[0].receive(write_frame({0, 255, 190, CommandLong::kInfo.id, payload_of(arm)}), kClient,
                       0.0, vehicle);
  const ParamSet set{4.0F, 1, 1, id_of("MIS_TAKEOFF_ALT"), 9};
  endpoints[0].receive(write_frame({1, 255, 190, ParamSet::kInfo.id, payload_of(set)}), kClient,
                       0.0, vehicle);
  const News news = take_news(aboard, vehicle);
  EXPECT_EQ(news.texts.size(), 2U) << "armed, and where local places count from";
  for (std::size_t i = 0; i < endpoints.size(); ++i) {
    std::size_t texts = 0, acks = 0, values = 0;
    ReadCounts counts;
    for (const auto& bytes : endpoints[i].take_outgoing(0.0, vehicle, news)) {
      const Frame frame = read_frames(bytes, counts).at(0);
      texts += frame.message_id == StatusText::kInfo.id ? 1 : 0;
      acks += frame.message_id == CommandAck::kInfo.id ? 1 : 0;
      if (frame.message_id != ParamValue::kInfo.id) continue;
      EXPECT_EQ(message_of<ParamValue>(frame.payload).param_value, 4.0F);
      ++values;
    }
    EXPECT_EQ(texts, 2U) << i;
    EXPECT_EQ(acks, i == 0 ? 1U : 0U);
    EXPECT_EQ(values, 1U);
  }
  EXPECT_TRUE(take_news(aboard, vehicle).were_set.empty()) << "told once";
}

/// Oracle: what an accelerometer feels, turned and without gravity, adds up to the velocity.
TEST(MavlinkParity, TheInertialUnitFeelsTheFlight) {
  Session session;
  session.send(Heartbeat{});
  session.step_for(1);
  const auto rest = session.last<HighresImu>();
  EXPECT_NEAR(rest.a_frd_m_s2[2], -9.8066, 0.02) << "standing, it feels the ground";
  EXPECT_NEAR(rest.pressure_hpa, 1013.25, 0.1);
  session.command(kArmDisarm, 1);
  session.command(kNavTakeoff);
  Vec3 v_world_m_s = session.vehicle().state().v_world_m_s;
  for (int tick = 0; tick < 6 * kTicksPerSecond; ++tick) {
    session.step();
    const Quadrotor& vehicle = session.vehicle();
    v_world_m_s +=
        kTick_s * (vehicle.state().T_world_body.linear() * vehicle.specific_force_body_m_s2() -
                   Vec3(0, 0, 9.8066));
  }
  EXPECT_LT((v_world_m_s - session.vehicle().state().v_world_m_s).norm(), 1e-9);
}

TEST(MavlinkParity, OdometryHasTheBodysSpeeds) {
  VehicleState state;
  state.T_world_body.linear() = Eigen::AngleAxisd(kPi / 2, Vec3::UnitZ()).toRotationMatrix();
  state.v_world_m_s = Vec3(0, 3, 1);  // the body looks north, which is world y
  const auto told = said<Odometry>({.estimate = state, .origin_world_m = Vec3(1, 2, 0)});
  const std::array<float, 3> v_m_s = told.v_m_s, p_m = told.p_m;
  EXPECT_NEAR(v_m_s[0], 3.0, 1e-6) << "forward";
  EXPECT_NEAR(v_m_s[1], 0.0, 1e-6);
  EXPECT_NEAR(v_m_s[2], -1.0, 1e-6) << "down";
  EXPECT_NEAR(p_m[0], -2.0, 1e-6);
  EXPECT_NEAR(p_m[1], -1.0, 1e-6);
  EXPECT_TRUE(std::isnan(told.pose_covariance[0]));
}

TEST(MavlinkParity, ThereIsAlwaysAVoltageAndItFallsWithTheCharge) {
  double before_mv = 1e9;
  for (const double used_wh : {0.0, 10.0, 20.0, 40.0, 60.0}) {
    const auto told = said<BatteryStatus>({.energy_wh = used_wh, .battery_wh = 40.0});
    const double cell_mv = told.voltages_mv[0];
    EXPECT_TRUE(cell_mv < before_mv || used_wh == 60.0) << used_wh;
    EXPECT_GE(cell_mv, 3600.0);
    EXPECT_LE(cell_mv, 4050.0);
    before_mv = cell_mv;
  }
  EXPECT_EQ(said<BatteryStatus>({}).voltages_mv[3], 4050) << "one that is never empty";
}

TEST(MavlinkParity, ParametersOfWhatIsNotHereAreKeptAndUnknownOnesAreOnlyToldOf) {
  Session session;
  const auto read = [&](std::string_view name) {
    return std::bit_cast<std::int32_t>(
        session.answers<ParamValue>(ParamRequestRead{-1, 1, 1, id_of(name)}).at(0).param_value);
  };
  EXPECT_EQ(read("NAV_RCL_ACT"), 2);
  session.send(ParamSet{std::bit_cast<float>(1), 1, 1, id_of("NAV_RCL_ACT"), 6});
  EXPECT_EQ(read("NAV_RCL_ACT"), 1);
  EXPECT_EQ(read("SYS_HITL"), 0);
  EXPECT_EQ(read("MAV_SYS_ID"), 1);
  session.answers<StatusText>(ParamSet{1.0F, 1, 1, id_of("NO_SUCH"), 9});
  EXPECT_EQ(session.last<StatusText>().severity, kSeverityInfo);
}

}  // namespace
}  // namespace gnbv::mavlink

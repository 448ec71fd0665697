// Arms, takes off by a stream of setpoints, flies a 5 m square 3 m above the ground, lands.
//
// usage: node square.mjs URL       such as udp://127.0.0.1:14540
// exit: 0 all of that happened, 1 it did not (stderr says what)
import { Vehicle } from './vehicle.mjs';

const ARM_DISARM = 400;
const DO_SET_MODE = 176;
const NAV_LAND = 21;
const OFFBOARD = 6; // PX4's main mode
const TEMPORARILY_REJECTED = 1; // MAV_RESULT
const SIDE_M = 5;
const HEIGHT_M = 3;
const TOLERANCE_M = 0.5;

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** Commands, and again while that is rejected for the moment, as when the stream was late. */
async function accepted(what, vehicle, ...command) {
  let ack = await vehicle.command(...command);
  for (let again = 0; again < 10 && ack === TEMPORARILY_REJECTED; again += 1) {
    await new Promise(resolve => setTimeout(resolve, 200));
    ack = await vehicle.command(...command);
  }
  if (ack !== 0) throw new Error(`${what}: MAV_RESULT ${ack}, not accepted`);
}

async function flySquare(vehicle) {
  await vehicle.until('first telemetry', 20,
    () => vehicle.latest.Heartbeat && vehicle.latest.LocalPositionNed);
  const [north, east, down] = vehicle.position;
  const corners = [[0, 0], [SIDE_M, 0], [SIDE_M, SIDE_M], [0, SIDE_M], [0, 0]].map(
    ([n, e]) => [north + n, east + e, down - HEIGHT_M]);

  vehicle.flyTo(corners[0]);
  const beginMs = vehicle.timeMs;
  await vehicle.until('a second of stream', 10, () => vehicle.timeMs - beginMs > 1000);
  await accepted('OFFBOARD', vehicle, DO_SET_MODE, 1, OFFBOARD);
  await accepted('arming', vehicle, ARM_DISARM, 1);
  // a heartbeat tells it, which comes once a second of wall time
  await vehicle.until('armed in OFFBOARD', 20,
    () => vehicle.isArmed && vehicle.mainMode === OFFBOARD);

  for (const corner of corners) {
    vehicle.flyTo(corner);
    await vehicle.until(`corner ${corner.map(x => x.toFixed(1))}`, 30,
      () => distance(vehicle.position, corner) < TOLERANCE_M);
    console.log(`corner ${corner.map(x => x.toFixed(2))} reached to ` +
      `${distance(vehicle.position, corner).toFixed(2)} m at ${vehicle.timeMs / 1000} s`);
  }
  await accepted('landing', vehicle, NAV_LAND);
  vehicle.stopStream();
  await vehicle.until('landed and disarmed', 60, () => !vehicle.isArmed);
  const error = distance(vehicle.position, [north, east, down]);
  if (error > 1) throw new Error(`landed ${error.toFixed(2)} m from the start`);
  console.log(`landed ${error.toFixed(2)} m from the start at ${vehicle.timeMs / 1000} s`);
}

const url = process.argv[2];
if (url === undefined) {
  console.error('usage: node square.mjs udp://HOST:PORT');
  process.exit(2);
}
const vehicle = new Vehicle(url);
try {
  await flySquare(vehicle);
  for (const kind of ['Heartbeat', 'Attitude', 'LocalPositionNed', 'BatteryStatus', 'StatusText']) {
    if (!vehicle.count[kind]) throw new Error(`no ${kind} was heard`);
  }
  if (vehicle.badCrc > 0) throw new Error(`${vehicle.badCrc} frames with a bad CRC were heard`);
  console.log(`heard ${JSON.stringify(vehicle.count)}`);
} catch (error) {
  console.error(`square.mjs: ${error.message}`);
  process.exitCode = 1;
} finally {
  vehicle.close();
}

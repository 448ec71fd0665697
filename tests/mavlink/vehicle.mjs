// A MAVLink vehicle as a companion computer sees it, through node-mavlink alone.
import dgram from 'node:dgram';
import { PassThrough } from 'node:stream';
import mavlink from 'node-mavlink';

const { minimal, common, createMavLinkStream, MavLinkProtocolV2 } = mavlink;

const TELEMETRY = [minimal.Heartbeat, common.Attitude, common.LocalPositionNed,
  common.CommandAck, common.BatteryStatus, common.ExtendedSysState, common.StatusText];
const POSITION_AND_YAW = 2552; // type mask: all but these ignored

export class Vehicle {
  /** @param {string} url udp://HOST:PORT where the vehicle listens */
  constructor(url) {
    const { hostname, port } = new URL(url);
    this.latest = {};   // the last message of each kind, by class name
    this.count = {};    // how many of each
    this.badCrc = 0;
    this.texts = [];
    this.waiting = [];  // { predicate, resolve }
    this.sequence = 0;
    this.protocol = new MavLinkProtocolV2(255, 190);

    const bytes = new PassThrough();
    const reader = createMavLinkStream(bytes, { onCrcError: () => { this.badCrc += 1; } });
    reader.on('data', packet => this.#take(packet));
    this.socket = dgram.createSocket('udp4');
    this.socket.on('message', datagram => bytes.write(datagram));
    this.socket.connect(Number(port), hostname);
    this.socket.once('connect', () => {
      this.#every(1000, () => this.#heartbeat());
    });
    // a vehicle that is gone refuses datagrams; the client notices by the silence
    this.socket.on('error', () => {});
    this.timers = [];
  }

  close() {
    this.timers.forEach(clearInterval);
    this.socket.close();
  }

  get timeMs() { return this.latest.LocalPositionNed?.timeBootMs ?? 0; }
  get position() { const p = this.latest.LocalPositionNed; return [p.x, p.y, p.z]; }
  get isArmed() { return (this.latest.Heartbeat.baseMode & 128) !== 0; }
  get mainMode() { return this.latest.Heartbeat.customMode >>> 16 & 0xff; }

  /** Resolves when the predicate holds; rejects after that much simulated time, counted from the
   *  first that is known, or when that time stands still. */
  until(what, simulatedSeconds, predicate) {
    return new Promise((resolve, reject) => {
      const fail = why => {
        done();
        reject(new Error(`${what}: ${why}; position ${this.latest.LocalPositionNed &&
          this.position.map(x => x.toFixed(2))}, texts: ${this.texts.slice(-5).join(' | ')}`));
      };
      let beginMs = this.latest.LocalPositionNed?.timeBootMs;
      let lastMs = this.timeMs;
      let lastProgress = Date.now();
      const watch = setInterval(() => {
        if (this.timeMs !== lastMs) lastProgress = Date.now();
        lastMs = this.timeMs;
        if (Date.now() - lastProgress > 30000) fail('the simulation has stood still for 30 s');
      }, 1000);
      const check = () => {
        beginMs ??= this.latest.LocalPositionNed?.timeBootMs;
        if (predicate()) {
          done();
          resolve();
        } else if (this.timeMs - beginMs > 1000 * simulatedSeconds) {
          fail(`not within ${simulatedSeconds} s of the simulation`);
        }
      };
      const done = () => {
        clearInterval(watch);
        this.waiting = this.waiting.filter(other => other !== check);
      };
      this.waiting.push(check);
    });
  }

  /** Sends until it is acknowledged; the MAV_RESULT. */
  async command(id, ...params) {
    const message = new common.CommandLong();
    message.command = id;
    message.targetSystem = 1;
    message.targetComponent = 1;
    for (let i = 1; i <= 7; i += 1) message[`_param${i}`] = params[i - 1] ?? 0;
    this.latest.CommandAck = undefined;
    const send = () => { this.#send(message); message.confirmation += 1; };
    send();
    const again = setInterval(send, 1000);
    try {
      await this.until(`acknowledgement of ${id}`, 60, () => this.latest.CommandAck?.command === id);
    } finally {
      clearInterval(again);
    }
    return this.latest.CommandAck.result;
  }

  /** From now on this position is what the stream of setpoints asks for, heading north. */
  flyTo(position) {
    this.target = position;
    this.stream ??= this.#every(20, () => this.#setpoint());
  }

  stopStream() {
    clearInterval(this.stream);
    this.stream = undefined;
  }

  #setpoint() {
    const message = new common.SetPositionTargetLocalNed();
    message.timeBootMs = this.timeMs;
    [message.x, message.y, message.z] = this.target;
    Object.assign(message, { vx: 0, vy: 0, vz: 0, afx: 0, afy: 0, afz: 0, yaw: 0, yawRate: 0 });
    message.typeMask = POSITION_AND_YAW;
    message.targetSystem = 1;
    message.targetComponent = 1;
    message.coordinateFrame = common.MavFrame.LOCAL_NED;
    this.#send(message);
  }

  #heartbeat() {
    const message = new minimal.Heartbeat();
    message.type = minimal.MavType.GCS;
    message.autopilot = minimal.MavAutopilot.INVALID;
    message.systemStatus = minimal.MavState.ACTIVE;
    message.mavlinkVersion = 3;
    this.#send(message);
  }

  #send(message) {
    this.socket.send(this.protocol.serialize(message, this.sequence));
    this.sequence = (this.sequence + 1) % 256;
  }

  #every(milliseconds, action) {
    action();
    const timer = setInterval(action, milliseconds);
    this.timers.push(timer);
    return timer;
  }

  #take(packet) {
    const kind = TELEMETRY.find(candidate => candidate.MSG_ID === packet.header.msgid);
    if (kind === undefined) return;
    const message = packet.protocol.data(packet.payload, kind);
    this.latest[kind.name] = message;
    this.count[kind.name] = (this.count[kind.name] ?? 0) + 1;
    if (kind === common.StatusText) this.texts.push(message.text);
    [...this.waiting].forEach(check => check());
  }
}

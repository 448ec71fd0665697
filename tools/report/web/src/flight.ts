// One run as a function of effort: how many views there were, and where the vehicle was.
import { Quaternion, Vector3 } from "three";
import type { Clock, Effort } from "./clock";
import { Bytes, type CameraData, type RunData } from "./data";

export interface Pose {
  p: Vector3; // metres, world
  q: Quaternion; // body in world
}

/** Index of the last element of ascending `values` that is at most `x`; -1 if none is. */
export function lastAtMost(values: ArrayLike<number>, x: number): number {
  let low = -1;
  let high = values.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] <= x) low = middle; else high = middle;
  }
  return low;
}

export class Flight {
  readonly count: number; // of views
  readonly points: Float32Array | null; // of the flown path
  private readonly efforts: Record<Effort, number[]>; // after n views
  private readonly times: number[]; // of the mission, likewise
  private readonly pathTimes: Float32Array | null;
  private readonly pathQuaternions: Int16Array | null;

  constructor(readonly data: RunData, readonly bytes: Bytes, readonly index: number) {
    const views = data.views;
    this.count = views.x.length;
    this.efforts = {
      views: Array.from({ length: this.count + 1 }, (_, n) => n),
      metres: [0, ...views.metres],
      seconds: [0, ...views.seconds],
    };
    this.points = data.path && bytes.points(data.path.points);
    this.pathTimes = data.path && bytes.f32(data.path.time);
    this.pathQuaternions = data.path && bytes.i16(data.path.quaternion);
    const begin = data.profile_end_s ?? this.pathTimes?.[0] ?? views.time[0] ?? 0;
    this.times = [begin, ...views.time];
  }

  /** After `n` views. */
  effort(n: number, effort: Effort): number { return this.efforts[effort][n]; }
  last(effort: Effort): number { return this.efforts[effort][this.count]; }

  /** The first view may be reached at an effort of 0: before it the clock is below 0. */
  viewsAt(clock: Clock): number {
    if (clock.at < 0) return 0;
    return Math.max(0, lastAtMost(this.efforts[clock.effort], clock.at + 1e-9));
  }

  /** Of the mission, in seconds; between two views as far as the effort between them is spent. */
  timeAt(clock: Clock): number {
    const n = this.viewsAt(clock);
    if (n === this.count) return this.times[n];
    const [from, to] = [this.effort(n, clock.effort), this.effort(n + 1, clock.effort)];
    const share = to > from ? Math.min(1, Math.max(0, (clock.at - from) / (to - from))) : 0;
    return this.times[n] + share * (this.times[n + 1] - this.times[n]);
  }

  /** At a view, the pose that iterations.csv records; between views, the flown one. */
  poseAt(clock: Clock): Pose | null {
    const n = this.viewsAt(clock);
    const isBetween = n < this.count && clock.at > this.effort(n, clock.effort) + 1e-6;
    if (n > 0 && !(isBetween && this.pathTimes)) return this.viewPose(n - 1);
    return this.flownPose(this.timeAt(clock)) ?? (this.count > 0 ? this.viewPose(0) : null);
  }

  /** The cameras as the gimbal had them at a view; fixed ones as ever. */
  camerasAt(view: number): CameraData[] {
    const mountings = this.data.views.T_body_camera?.[view];
    if (!mountings) return this.data.cameras;
    return this.data.cameras.map((camera, i) => ({ ...camera, T_body_camera: mountings[i] }));
  }

  viewPose(view: number): Pose {
    const { x, y, z, yaw } = this.data.views;
    return {
      p: new Vector3(x[view], y[view], z[view]),
      q: new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), yaw[view]),
    };
  }

  /** Samples of the path flown by then. */
  samplesBy(time: number): number {
    return this.pathTimes ? lastAtMost(this.pathTimes, time + 1e-4) + 1 : 0;
  }

  /** The first sample that belongs to the views, not to the profile. */
  firstViewSample(): number {
    const begin = this.data.views_begin_s ?? this.data.views.time[0];
    return begin === undefined ? Infinity : this.samplesBy(begin);
  }

  /** Where the vehicle is before the first view, x y z; empty where no path was recorded. */
  profileEnd(): number[] { return this.flownPose(this.times[0])?.p.toArray() ?? []; }

  private flownPose(time: number): Pose | null {
    if (!this.pathTimes) return null;
    const i = Math.max(0, lastAtMost(this.pathTimes, time));
    const j = Math.min(i + 1, this.pathTimes.length - 1);
    const step = this.pathTimes[j] - this.pathTimes[i];
    const share = step > 0 ? Math.min(1, Math.max(0, (time - this.pathTimes[i]) / step)) : 0;
    const sample = (k: number): Pose => ({
      p: new Vector3().fromArray(this.points!, 3 * k),
      q: new Quaternion().fromArray(Array.from(
        this.pathQuaternions!.subarray(4 * k, 4 * k + 4), (c) => c / 32767)).normalize(),
    });
    const from = sample(i);
    const to = sample(j);
    return { p: from.p.lerp(to.p, share), q: from.q.slerp(to.q, share) };
  }
}

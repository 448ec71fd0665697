// One run as a function of effort: how many views there were, and where the vehicle was.
import { Matrix4, Quaternion, Vector3 } from "three";
import type { Clock, Effort } from "./clock";
import type { CameraData, RunData } from "./data";

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

/** Of several cameras how far they see. */
export const rangeOf = (cameras: CameraData[]) =>
  Math.max(...cameras.map(({ range_m }) => range_m));

export class Flight {
  readonly count: number; // of views
  readonly points: Float32Array | null; // of the flown path
  private readonly efforts: Record<Effort, number[]>; // after n views
  private readonly times: number[]; // of the mission, likewise

  constructor(readonly data: RunData, readonly index: number) {
    const { views, path } = data;
    this.count = views.time.length;
    this.efforts = {
      views: Array.from({ length: this.count + 1 }, (_, n) => n),
      metres: [0, ...views.metres],
      seconds: [0, ...views.seconds],
    };
    this.points = path && path.points;
    this.times = [data.profile_end_s ?? path?.time[0] ?? views.time[0] ?? 0, ...views.time];
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
    if (n > 0 && !(isBetween && this.points)) return this.viewPose(n - 1);
    return this.flownPose(this.timeAt(clock)) ?? (this.count > 0 ? this.viewPose(0) : null);
  }

  /** The cameras as the gimbal had them at a view; fixed ones as ever. */
  camerasAt(view: number): CameraData[] {
    const { cameras, views: { T_body_camera: turned } } = this.data;
    return !turned ? cameras : cameras.map((camera, i) => {
      const at = 16 * (view * cameras.length + i);
      return { ...camera, T_body_camera: [...turned.subarray(at, at + 16)] };
    });
  }

  /** Each of them in the world. */
  camerasInWorld(view: number): { camera: CameraData; T: Matrix4 }[] {
    const { p, q } = this.viewPose(view);
    const T_world_body = new Matrix4().makeRotationFromQuaternion(q).setPosition(p);
    return this.camerasAt(view).map((camera) => ({ camera,
      T: T_world_body.clone().multiply(new Matrix4().fromArray(camera.T_body_camera)) }));
  }

  viewPose(view: number): Pose {
    const [x, y, z, yaw] = this.data.views.pose.subarray(4 * view, 4 * view + 4);
    return { p: new Vector3(x, y, z),
      q: new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), yaw) };
  }

  /** Of the box in which the vehicle may fly. */
  workspace(): { centre: Vector3; size_m: number } {
    const min = new Vector3(...this.data.workspace_min);
    const max = new Vector3(...this.data.workspace_max);
    return { centre: min.clone().add(max).multiplyScalar(0.5), size_m: min.distanceTo(max) };
  }

  /** Samples of the path flown by then. */
  samplesBy(time: number): number {
    return this.data.path ? lastAtMost(this.data.path.time, time + 1e-4) + 1 : 0;
  }

  /** The first sample that belongs to the views, not to the profile. */
  firstViewSample(): number {
    const begin = this.data.views_begin_s ?? this.data.views.time[0];
    return begin === undefined ? Infinity : this.samplesBy(begin);
  }

  /** Where the vehicle is before the first view, x y z; empty where no path was recorded. */
  profileEnd(): number[] { return this.flownPose(this.times[0])?.p.toArray() ?? []; }

  private flownPose(at: number): Pose | null {
    if (!this.data.path) return null;
    const { points, time, quaternion } = this.data.path;
    const i = Math.max(0, lastAtMost(time, at));
    const j = Math.min(i + 1, time.length - 1);
    const step = time[j] - time[i];
    const share = step > 0 ? Math.min(1, Math.max(0, (at - time[i]) / step)) : 0;
    const sample = (k: number): Pose => ({
      p: new Vector3().fromArray(points, 3 * k),
      q: new Quaternion().fromArray(quaternion, 4 * k).normalize(),
    });
    const [from, to] = [sample(i), sample(j)];
    return { p: from.p.lerp(to.p, share), q: from.q.slerp(to.q, share) };
  }
}

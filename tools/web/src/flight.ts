// One run as a function of effort: how many views there were, and where the vehicle was.
import { Box3, MathUtils, Matrix4, Quaternion, Vector3 } from "three";
import type { Clock, Effort } from "./clock";
import type { CameraData, RunData } from "./data";
import { number } from "./dom";

interface Pose {
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

/** How far along it is from one number to another, within [0, 1]. */
const shareOf = (at: number, from: number, to: number) =>
  (to > from ? MathUtils.clamp((at - from) / (to - from), 0, 1) : 0);

export class Flight {
  readonly count: number; // of views
  readonly points: Float32Array | null; // of the flown path
  readonly workspace: Box3; // in which the vehicle may fly
  readonly size_m: number; // from corner to corner of it
  readonly range_m: number; // of the camera that sees farthest
  readonly sight_m: number; // farther than this what it sees would fill the picture
  private readonly efforts: Record<Effort, number[]>; // after n views
  private readonly times: number[]; // of the mission, likewise

  constructor(readonly data: RunData, readonly index: number, private readonly clock: Clock) {
    const { views, path, cameras, workspace_min, workspace_max } = data;
    const [metres, seconds, wh] = views.from_take_off.map((spent) => [...spent]);
    this.count = views.time.length;
    this.efforts = { views: [...Array(this.count + 1).keys()], metres: [0, ...views.metres],
      seconds: [0, ...views.seconds], metres_with_profile: metres ?? [],
      seconds_with_profile: seconds ?? [], wh_with_profile: wh ?? [] };
    this.points = path && path.points;
    this.times = [data.profile_end_s ?? path?.time[0] ?? views.time[0] ?? 0, ...views.time];
    this.workspace = new Box3(new Vector3(...workspace_min), new Vector3(...workspace_max));
    this.size_m = this.workspace.min.distanceTo(this.workspace.max);
    this.range_m = Math.max(...cameras.map(({ range_m }) => range_m));
    this.sight_m = Math.min(this.range_m, 0.25 * this.size_m);
  }

  knows(effort: Effort): boolean { return this.efforts[effort].length > 0; }
  /** After `n` views. */
  effort(n: number, effort: Effort): number { return this.efforts[effort][n]; }
  last(effort: Effort): number { return this.efforts[effort][this.count]; }

  /** Of the first `n` views those up to the first one of the last one's plan. */
  planOf(n: number): number { return n === 0 ? 0 : n + 1 - this.data.views.plan_view[n - 1]; }

  /** "view 3 of the burst planned at view 41"; empty where the view was decided alone. */
  burstWords(view: number): string {
    const { plan_view } = this.data.views;
    const isAlone = plan_view[view] === 1 && (plan_view[view + 1] ?? 1) === 1;
    return isAlone ? "" : `view ${number(plan_view[view])} of the burst planned at view `
      + number(this.planOf(view + 1));
  }

  /** How many views there were by now. */
  get n(): number {
    const { at, effort } = this.clock;
    return Math.max(0, lastAtMost(this.efforts[effort], at + 1e-9));
  }

  /** Now of the mission, in seconds; between two views as far as the effort between is spent. */
  time(): number {
    const { n, clock: { at, effort } } = this;
    if (n === this.count) return this.times[n];
    const share = shareOf(at, this.effort(n, effort), this.effort(n + 1, effort));
    return MathUtils.lerp(this.times[n], this.times[n + 1], share);
  }

  /** At a view, the pose that iterations.csv records; between views, the flown one. */
  pose(): Pose | null {
    const { n, clock: { at, effort } } = this;
    const isBetween = n < this.count && at > this.effort(n, effort) + 1e-6;
    if (n > 0 && !(isBetween && this.points)) return this.viewPose(n - 1);
    return this.flownPose(this.time()) ?? (this.count > 0 ? this.viewPose(0) : null);
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

  /** Samples of the path flown by then. */
  samplesBy(time: number): number {
    return this.data.path ? lastAtMost(this.data.path.time, time + 1e-4) + 1 : 0;
  }

  /** How many samples belong to the profile, not to the views. */
  profileSamples(): number {
    const begin = this.data.views_begin_s ?? this.data.views.time[0] ?? Infinity;
    return this.samplesBy(begin);
  }

  /** Where the vehicle is before the first view, x y z; empty where no path was recorded. */
  profileEnd(): number[] { return this.flownPose(this.times[0])?.p.toArray() ?? []; }

  private flownPose(at: number): Pose | null {
    if (!this.data.path) return null;
    const { points, time, quaternion } = this.data.path;
    const i = Math.max(0, lastAtMost(time, at));
    const j = Math.min(i + 1, time.length - 1);
    const share = shareOf(at, time[i], time[j]);
    const place = (k: number) => new Vector3().fromArray(points, 3 * k);
    const turn = (k: number) => new Quaternion().fromArray(quaternion, 4 * k).normalize();
    return { p: place(i).lerp(place(j), share), q: turn(i).slerp(turn(j), share) };
  }
}

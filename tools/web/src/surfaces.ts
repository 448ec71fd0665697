// What the run measured of the surface: the points of the cloud, the voxels, how many each holds.
import * as three from "three";
import { colourOf, isDark, rampHex } from "./colours";
import type { RunData, VoxelData } from "./data";
import { lastAtMost } from "./flight";
import type { SplatSource } from "./painter";

/** Of a cell by its index along each axis, 16 bits each; exact in a double. */
export const keyOf = (x: number, y: number, z: number) => ((x + 32768) * 65536 + y + 32768) * 65536
  + z + 32768;

/**
 * How many of the cloud's points each voxel holds at a state of the mission, with a ceiling that
 * leaves out the densest few of the last one.
 */
class Densities {
  readonly count: Uint32Array; // at this state
  readonly most: number;
  private state = 0; // of how many the gains are in `count`
  private readonly cells = new Map<number, number>();

  constructor(readonly voxels: VoxelData) {
    const { index, gains_after } = voxels;
    this.count = new Uint32Array(index.length / 3);
    this.count.forEach((_, i) =>
      this.cells.set(keyOf(index[3 * i], index[3 * i + 1], index[3 * i + 2]), i));
    this.seek(gains_after.length - 1);
    this.most = this.count.toSorted()[Math.floor(0.98 * (this.count.length - 1))] || 1;
  }

  /** To the counts after `views` views. */
  seek(views: number) {
    for (; this.state <= views; ++this.state) this.add(this.state, 1);
    for (; this.state > views + 1; --this.state) this.add(this.state - 1, -1);
  }

  private add(state: number, sign: number) {
    const { gains, gains_after } = this.voxels;
    const begin = state > 0 ? gains_after[state - 1] : 0;
    for (let i = begin, voxel = 0; i < gains_after[state]; i += 2) {
      voxel += gains[i];
      this.count[voxel] += sign * gains[i + 1];
    }
  }

  centre(voxel: number) {
    return new three.Vector3().fromArray(this.voxels.index, 3 * voxel).addScalar(0.5)
      .multiplyScalar(this.voxels.size_m);
  }

  /** How far a ray goes until it meets one of the first `known` voxels; `far` if it meets none. */
  firstHit(from: three.Vector3, way: three.Vector3, far: number, known: number): number {
    const { size_m } = this.voxels;
    for (let t = size_m; t < far; t += 0.4 * size_m) {
      const voxel = this.voxelAt(from.x + t * way.x, from.y + t * way.y, from.z + t * way.z);
      if (voxel >= 0 && voxel < known) return t;
    }
    return far;
  }

  /** Of the voxel in which the point lies; -1 where rounding put it into one without points. */
  voxelAt(x: number, y: number, z: number): number {
    const cell = (c: number) => Math.floor(c / this.voxels.size_m);
    return this.cells.get(keyOf(cell(x), cell(y), cell(z))) ?? -1;
  }
}

/** Colours by what the point is like; `real` is what the cameras saw. */
export type Colouring = "height" | "density" | "iteration" | "error" | "real";

/** Of voxels: no camera saw their colours, and their errors are not known. */
export const ofVoxels = (by: Colouring): Colouring =>
  (by === "real" || by === "error" ? "height" : by);

const kNotOfStructure = 255; // among errors

/** A quarter of a colour and three of the page's, so that something else shows. */
const faded = (rgb: number, page: number) => (rgb >> 2 & 0x3f3f3f) + 3 * (page >> 2 & 0x3f3f3f);

const kNoVoxels: VoxelData = { size_m: 1, index: new Int16Array(), after: new Uint32Array(),
  gains: new Uint32Array(), gains_after: new Uint32Array() };

/** Points and voxels of a run; both are there after as many views as show() says. */
export class Model {
  readonly voxels: three.InstancedMesh;
  readonly heights: [number, number];
  readonly densities: Densities;
  readonly points: Float32Array;
  showsPoints = true;
  isFaded = false; // but for the points of the last view
  private readonly colours: Uint32Array; // of points, 0xrrggbb
  private readonly cloudAfter: Uint32Array;
  private pointVoxels: Int32Array | null = null; // of each point, once asked for
  private by: Colouring = "height";
  private views = -1; // shown

  constructor(private readonly data: RunData) {
    this.points = data.cloud?.points ?? new Float32Array();
    this.colours = new Uint32Array(this.points.length / 3);
    this.cloudAfter = data.cloud?.after ?? new Uint32Array(data.views.time.length + 1);
    const { min: { z: low }, max: { z: high } } = new three.Box3().setFromArray(this.points);
    this.heights = [low, Math.max(high, low + 1e-6)];
    this.densities = new Densities(data.voxels ?? kNoVoxels);
    const edge_m = 0.94 * this.densities.voxels.size_m;
    this.voxels = new three.InstancedMesh(new three.BoxGeometry(edge_m, edge_m, edge_m),
      new three.MeshLambertMaterial(), this.densities.count.length);
    const T = new three.Matrix4();
    this.densities.count.forEach((_, i) =>
      this.voxels.setMatrixAt(i, T.setPosition(this.densities.centre(i))));
  }

  /** How many points the last of the first `n` views brought. */
  newPoints(n: number) { return n > 0 ? this.cloudAfter[n] - this.cloudAfter[n - 1] || 0 : 0; }

  colour(by: Colouring) {
    this.by = by;
    const colourOfPoint = this.pointColours(by);
    for (let i = 0; i < this.colours.length; ++i) this.colours[i] = colourOfPoint(i);
    const { count, voxels: { after } } = this.densities;
    const colourOfVoxel =
      this.ramp(ofVoxels(by), (i) => this.densities.centre(i).z, (i) => count[i], after);
    const colour = new three.Color();
    count.forEach((_, i) => this.voxels.setColorAt(i, colour.setHex(colourOfVoxel(i))));
    if (this.voxels.instanceColor) this.voxels.instanceColor.needsUpdate = true;
  }

  /** Voxels that held points before the view. */
  voxelsKnown(view: number): number { return this.densities.voxels.after[view] ?? 0; }

  /** The points that are shown: place, and the view that brought each (-1 the profile). */
  *shownPoints(): Generator<{ at: three.Vector3; view: number }> {
    const at = new three.Vector3();
    for (let state = 0, i = 0; this.showsPoints && state <= this.views; ++state) {
      for (; i < this.cloudAfter[state]; ++i) {
        yield { at: at.fromArray(this.points, 3 * i), view: state - 1 };
      }
    }
  }

  /** After `n` views. */
  show(n: number) {
    if (n === this.views) return;
    this.views = n;
    this.densities.seek(n);
    if (this.by === "density") this.colour(this.by); // as dense as it was then
    this.voxels.count = this.voxelsKnown(n);
  }

  /** The points that are shown; those of the last view are marked. */
  splats(): SplatSource[] {
    if (!this.showsPoints || this.points.length === 0) return [];
    const { colours, isFaded } = this;
    const newFrom = this.views > 0 ? this.cloudAfter[this.views - 1] : Infinity;
    const ofNew = colourOf("new_points");
    const page = isDark() ? 0x252b33 : 0xe2e6eb;
    return [{ places: this.points, least_px: 1.6, most_px: 14, nearer_m: 0,
      count: this.cloudAfter[this.views], size_m: 1.5 * Math.max(this.data.cloud!.cell_m, 0.02),
      isRound: true, largerFrom: newFrom,
      colourOf: (i) => (i >= newFrom ? ofNew : isFaded ? faded(colours[i], page) : colours[i]) }];
  }

  /** Of a colouring; `after` says how many elements there are after each state. */
  private ramp(by: Colouring, height: (i: number) => number, density: (i: number) => number,
      after: Uint32Array): (i: number) => number {
    const [low, high] = this.heights;
    const states = Math.max(1, this.data.views.time.length);
    const { most } = this.densities;
    if (by === "iteration") return (i) => rampHex("path", (lastAtMost(after, i) + 1) / states);
    if (by === "density") return (i) => rampHex("amount", density(i) / most);
    return (i) => rampHex("amount", (height(i) - low) / (high - low));
  }

  private pointColours(by: Colouring): (point: number) => number {
    const { points, densities, data: { cloud } } = this;
    if (by === "real" && cloud?.colour) {
      const rgb = cloud.colour;
      return (i) => rgb[3 * i] << 16 | rgb[3 * i + 1] << 8 | rgb[3 * i + 2];
    }
    if (by === "error" && cloud?.error) {
      const { error, error_most_mm } = cloud;
      return (i) => (error[i] === kNotOfStructure ? 0x808080
        : rampHex("error", error[i] / error_most_mm));
    }
    const voxels = by !== "density" ? [] : this.pointVoxels ??= Int32Array.from(this.colours,
      (_, i) => densities.voxelAt(points[3 * i], points[3 * i + 1], points[3 * i + 2]));
    return this.ramp(by, (i) => points[3 * i + 2], (i) => densities.count[voxels[i]] ?? 0,
      this.cloudAfter);
  }
}

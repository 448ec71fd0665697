// What the run measured of the surface: the points of the cloud, the voxels.
import * as three from "three";
import { colourOf, isDark, rampHex } from "./colours";
import type { RunData } from "./data";
import { Densities } from "./densities";
import type { SplatSource } from "./splats";

/** Colours by what the point is like; `real` is what the cameras saw. */
export type Colouring = "height" | "density" | "iteration" | "error" | "real";

/** Of voxels: no camera saw their colours, and their errors are not known. */
export const ofVoxels = (by: Colouring): Colouring =>
  (by === "real" || by === "error" ? "height" : by);

/** Of each element by the state after which it was there first. */
function firstStates(after: Uint32Array, count: number): Uint16Array {
  const first = new Uint16Array(count);
  for (let n = 1; n < after.length; ++n) first.fill(n, after[n - 1], after[n]);
  return first;
}

const kNotOfStructure = 255; // among errors

/** A quarter of a colour and three of the page's, so that something else shows. */
const faded = (rgb: number, page: number) => (rgb >> 2 & 0x3f3f3f) + 3 * (page >> 2 & 0x3f3f3f);

/** Points and voxels of a run; both are there after as many views as show() says. */
export class Model {
  readonly voxels: three.InstancedMesh | null = null;
  readonly heights: [number, number];
  readonly densities: Densities | null = null;
  readonly points: Float32Array;
  showsPoints = true;
  isFaded = false; // but for the points of the last view
  private readonly colours: Uint32Array; // of points, 0xrrggbb
  private readonly cloudAfter: Uint32Array;
  private readonly voxelsAfter: Uint32Array;
  private pointVoxels: Int32Array | null = null; // of each point, once asked for
  private by: Colouring = "height";
  private views = -1; // shown

  constructor(private readonly data: RunData) {
    const { cloud, voxels } = data;
    this.points = cloud?.points ?? new Float32Array();
    this.colours = new Uint32Array(this.points.length / 3);
    this.cloudAfter = cloud?.after ?? new Uint32Array(data.views.time.length + 1);
    this.voxelsAfter = voxels?.after ?? new Uint32Array();
    const { min: { z: low }, max: { z: high } } = new three.Box3().setFromArray(this.points);
    this.heights = [low, Math.max(high, low + 1e-6)];
    if (!voxels) return;
    this.densities = new Densities(voxels);
    this.voxels = this.makeVoxels(this.densities);
  }

  /** How many points the last of the first `n` views brought. */
  newPoints(n: number) { return n > 0 ? this.cloudAfter[n] - this.cloudAfter[n - 1] || 0 : 0; }

  colour(by: Colouring) {
    this.by = by;
    const colourOfPoint = this.pointColours(by);
    for (let i = 0; i < this.colours.length; ++i) this.colours[i] = colourOfPoint(i);
    if (!this.voxels || !this.densities) return;
    const { count } = this.densities;
    const ramp = this.ramp(ofVoxels(by));
    const first = firstStates(this.voxelsAfter, count.length);
    const colour = new three.Color();
    for (let i = 0; i < count.length; ++i) {
      this.voxels.setColorAt(i,
        colour.setHex(ramp(this.densities.middle(i, 2), count[i], first[i])));
    }
    this.voxels.instanceColor!.needsUpdate = true;
  }

  /** Voxels that held points before the view. */
  voxelsKnown(view: number): number { return this.voxelsAfter[view] ?? 0; }

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
    if (n !== this.views) {
      this.views = n;
      this.densities?.seek(n);
      if (this.by === "density") this.colour(this.by); // as dense as it was then
    }
    if (this.voxels) this.voxels.count = this.voxelsAfter[n];
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

  /** Of a colouring: by height, points of the voxel, and the state after which it was there. */
  private ramp(by: Colouring): (height: number, density: number, state: number) => number {
    const [low, high] = this.heights;
    const states = Math.max(1, this.data.views.time.length);
    const most = this.densities?.most ?? 1;
    if (by === "iteration") return (_, __, state) => rampHex("path", state / states);
    if (by === "density") return (_, density) => rampHex("amount", density / most);
    return (height) => rampHex("amount", (height - low) / (high - low));
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
    const ramp = this.ramp(by);
    const first = firstStates(this.cloudAfter, points.length / 3);
    const voxels = by === "density" ? this.voxelsOfPoints() : null;
    return (i) => ramp(points[3 * i + 2], voxels ? densities?.count[voxels[i]] ?? 0 : 0, first[i]);
  }

  private voxelsOfPoints(): Int32Array {
    const { points } = this;
    return this.pointVoxels ??= Int32Array.from(this.colours, (_, i) =>
      this.densities?.voxelAt(points[3 * i], points[3 * i + 1], points[3 * i + 2]) ?? -1);
  }

  private makeVoxels(densities: Densities): three.InstancedMesh {
    const { count, voxels: { size_m } } = densities;
    const box = new three.BoxGeometry(0.94 * size_m, 0.94 * size_m, 0.94 * size_m);
    const mesh = new three.InstancedMesh(box, new three.MeshLambertMaterial(), count.length);
    const T = new three.Matrix4();
    for (let i = 0; i < count.length; ++i) {
      const [x, y, z] = [0, 1, 2].map((axis) => densities.middle(i, axis));
      mesh.setMatrixAt(i, T.makeTranslation(x, y, z));
    }
    mesh.frustumCulled = false;
    return mesh;
  }
}

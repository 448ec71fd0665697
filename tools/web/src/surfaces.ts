// What the run measured of the surface: the points of the cloud, the voxels.
import * as three from "three";
import { colourOf, isDark, ramp, rampAt, rampTable, type RampName } from "./colours";
import type { RunData } from "./data";
import { Densities } from "./densities";
import { lastAtMost } from "./flight";
import { bgr, type SplatSource } from "./splats";

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

/** What of a ramp a point takes, from 0 to 1. */
type Share = (height: number, density: number, state: number) => number;

const kFaded = 0.7; // of the way to a pale colour, so that something else shows
const kNotOfStructure = 255; // among errors

/** Points and voxels of a run; both are there after as many views as show() says. */
export class Model {
  readonly voxels: three.InstancedMesh | null = null;
  readonly heights: [number, number] = [Infinity, -Infinity];
  readonly densities: Densities | null = null;
  readonly points: Float32Array;
  showsPoints = true;
  isFaded = false; // but for the points of the last view
  private readonly rgb: Uint8Array;
  private readonly cloudAfter: Uint32Array;
  private readonly voxelsAfter: Uint32Array;
  private pointVoxels: Int32Array | null = null; // of each point, once asked for
  private by: Colouring = "height";
  private views = -1; // shown

  constructor(private readonly data: RunData) {
    const { cloud, voxels } = data;
    this.points = cloud?.points ?? new Float32Array();
    this.rgb = new Uint8Array(this.points.length);
    this.cloudAfter = cloud?.after ?? new Uint32Array(data.views.time.length + 1);
    this.voxelsAfter = voxels?.after ?? new Uint32Array();
    for (let i = 2; i < this.points.length; i += 3) {
      this.heights[0] = Math.min(this.heights[0], this.points[i]);
      this.heights[1] = Math.max(this.heights[1], this.points[i]);
    }
    if (this.heights[0] >= this.heights[1] || !cloud) this.heights[1] = this.heights[0] + 1e-6;
    if (!voxels) return;
    this.densities = new Densities(voxels);
    this.voxels = this.makeVoxels();
  }

  /** How many points the last of the first `n` views brought. */
  newPoints(n: number) { return n > 0 ? this.cloudAfter[n] - this.cloudAfter[n - 1] || 0 : 0; }

  colour(by: Colouring) {
    this.by = by;
    this.colourCloud(by);
    if (!this.voxels || !this.densities) return;
    const { count, voxels: { index, size_m } } = this.densities;
    const [name, share] = this.ramp(ofVoxels(by));
    const first = firstStates(this.voxelsAfter, count.length);
    for (let i = 0; i < count.length; ++i) {
      this.voxels.setColorAt(i,
        ramp(name, share(size_m * (index[3 * i + 2] + 0.5), count[i], first[i])));
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

  /** x, y, z and the view that brought it (-1 the profile); null beyond the last one. */
  point(i: number): number[] | null {
    if (3 * i >= this.points.length) return null;
    return [...this.points.subarray(3 * i, 3 * i + 3), lastAtMost(this.cloudAfter, i)];
  }

  /** Points of the whole cloud in the voxels, as they are shown. */
  countedPoints(): number { return this.densities?.count.reduce((a, b) => a + b, 0) ?? 0; }

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
    const { rgb } = this;
    const newFrom = this.views > 0 ? this.cloudAfter[this.views - 1] : Infinity;
    const fade = this.isFaded ? kFaded : 0;
    const [r, g, b] = (isDark() ? [0x25, 0x2b, 0x33] : [0xe2, 0xe6, 0xeb]).map((c) => fade * c);
    const keep = 1 - fade;
    const ofNew = bgr(colourOf("new_points"));
    return [{ places: this.points, toWorld: new three.Matrix4(), least_px: 1.6, most_px: 14,
      count: this.cloudAfter[this.views], size_m: 1.5 * Math.max(this.data.cloud!.cell_m, 0.02),
      isRound: true, largerFrom: newFrom,
      colourOf: (i) => (i >= newFrom ? ofNew
        : (keep * rgb[3 * i] + r) | (keep * rgb[3 * i + 1] + g) << 8
          | (keep * rgb[3 * i + 2] + b) << 16) }];
  }

  /** Of a colouring. */
  private ramp(by: Colouring): [RampName, Share] {
    const [low, high] = this.heights;
    const states = Math.max(1, this.data.views.time.length);
    const most = this.densities?.most ?? 1;
    if (by === "iteration") return ["path", (_, __, state) => state / states];
    if (by === "density") return ["amount", (_, density) => density / most];
    return ["amount", (height) => (height - low) / (high - low)];
  }

  private colourCloud(by: Colouring) {
    const { points, rgb, data: { cloud } } = this;
    if (by === "real" && cloud?.colour) {
      rgb.set(cloud.colour);
    } else if (by === "error" && cloud?.error) {
      const table = rampTable("error");
      cloud.error.forEach((error, i) => {
        const at = rampAt(error / cloud.error_most_mm);
        const isKnown = error !== kNotOfStructure;
        for (let k = 0; k < 3; ++k) rgb[3 * i + k] = isKnown ? table[at + k] : 128;
      });
    } else {
      const [name, share] = this.ramp(by);
      const table = rampTable(name);
      const first = firstStates(this.cloudAfter, points.length / 3);
      const voxels = by === "density" ? this.voxelsOfPoints() : null;
      for (let i = 0; 3 * i < points.length; ++i) {
        const density = voxels ? this.densities?.count[voxels[i]] ?? 0 : 0;
        const at = rampAt(share(points[3 * i + 2], density, first[i]));
        for (let k = 0; k < 3; ++k) rgb[3 * i + k] = table[at + k];
      }
    }
  }

  private voxelsOfPoints(): Int32Array {
    const points = this.points;
    return this.pointVoxels ??= Int32Array.from({ length: points.length / 3 }, (_, i) =>
      this.densities?.voxelAt(points[3 * i], points[3 * i + 1], points[3 * i + 2]) ?? -1);
  }

  private makeVoxels(): three.InstancedMesh {
    const { count, voxels: { index, size_m } } = this.densities!;
    const box = new three.BoxGeometry(0.94 * size_m, 0.94 * size_m, 0.94 * size_m);
    const mesh = new three.InstancedMesh(box, new three.MeshLambertMaterial(), count.length);
    const place = new three.Matrix4();
    for (let i = 0; i < count.length; ++i) {
      mesh.setMatrixAt(i, place.makeTranslation(size_m * (index[3 * i] + 0.5),
        size_m * (index[3 * i + 1] + 0.5), size_m * (index[3 * i + 2] + 0.5)));
    }
    mesh.frustumCulled = false;
    return mesh;
  }
}

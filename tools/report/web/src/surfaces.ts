// What the run measured of the surface: the points of the cloud, the voxels.
import * as three from "three";
import { isDark, ramp, rampTable } from "./colours";
import { errorScale, type ErrorScale } from "./error_scale";
import { kPointLayer } from "./depth_shading";
import type { Bytes, RampName, RunData } from "./data";
import { Densities } from "./densities";
import { lastAtMost } from "./flight";
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

const kPointVertex = `
uniform float uSize;
uniform float uPxPerTan;
uniform int uNewFrom;
uniform vec4 uFade; // the colour that points fade to, and how much
attribute vec3 rgb;
varying vec3 vColour;
void main() {
  vec4 p = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * p;
  gl_PointSize = clamp(uSize * uPxPerTan / -p.z, 1.6, 14.0);
  bool isNew = gl_VertexID >= uNewFrom;
  vColour = isNew ? vec3(0.0, 0.66, 1.0) : rgb;
  if (!isNew) vColour = mix(vColour, uFade.rgb, uFade.a);
  if (isNew) gl_PointSize += 1.0;
}`;
// Colours come as sRGB bytes: eight bits of linear light would crush the dark ones.
const kPointFragment = `
varying vec3 vColour;
void main() {
  vec2 d = gl_PointCoord - 0.5;
  if (dot(d, d) > 0.25) discard;
  gl_FragColor = sRGBTransferEOTF(vec4(vColour, 1.0));
}`;

/** What of a ramp a point takes, from 0 to 1. */
type Share = (height: number, density: number, state: number) => number;

const kFaded = 0.7; // of the way to a pale colour, so that something else shows
/** Of points of the last view: far from the red of what was missed, for the colour-blind, too. */
export const kNewColour = 0x00a8ff;
const kNewSplat = kNewColour >> 16 | kNewColour & 0xff00 | (kNewColour & 255) << 16; // 0xbbggrr

/** Points and voxels of a run; both are there after as many views as show() says. */
export class Model {
  readonly cloud: three.Points | null = null;
  readonly voxels: three.InstancedMesh | null = null;
  readonly heights: [number, number] = [0, 1];
  readonly densities: Densities | null = null;
  readonly errors: ErrorScale | null = null;
  isFaded = false; // but for the points of the last view
  private readonly points: Float32Array = new Float32Array();
  private readonly cloudAfter: Uint32Array = new Uint32Array();
  private readonly voxelsAfter: Uint32Array = new Uint32Array();
  private pointVoxels: Int32Array | null = null; // of each point, once asked for
  private by: Colouring = "height";
  private views = -1; // shown

  constructor(readonly data: RunData, private readonly bytes: Bytes) {
    if (data.voxels) {
      this.densities = new Densities(data.voxels, bytes);
      this.voxelsAfter = bytes.u32(data.voxels.after);
      this.voxels = this.makeVoxels();
    }
    if (data.cloud) {
      this.points = bytes.points(data.cloud.points);
      this.cloudAfter = bytes.u32(data.cloud.after);
      const { min, size } = data.cloud.points;
      this.heights = [min[2], min[2] + Math.max(size[2], 1e-6)];
      this.cloud = this.makeCloud();
      if (data.cloud.error) this.errors = errorScale(bytes.u8(data.cloud.error));
    }
  }

  /** How many points the last of the first `n` views brought. */
  newPoints(n: number) { return n > 0 ? this.cloudAfter[n] - this.cloudAfter[n - 1] || 0 : 0; }

  colour(by: Colouring) {
    this.by = by;
    if (this.cloud) this.colourCloud(by);
    if (!this.voxels || !this.densities) return;
    const { index, count, size } = this.densities;
    const [name, share] = this.ramp(ofVoxels(by));
    const first = firstStates(this.voxelsAfter, count.length);
    const colour = new three.Color();
    for (let i = 0; i < count.length; ++i) {
      const [r, g, b] = ramp(name, share(size * (index[3 * i + 2] + 0.5), count[i], first[i]));
      this.voxels.setColorAt(i, colour.setRGB(r / 255, g / 255, b / 255, three.SRGBColorSpace));
    }
    this.voxels.instanceColor!.needsUpdate = true;
  }

  /** Voxels that held points before the view. */
  voxelsKnown(view: number): number { return this.voxelsAfter[view] ?? 0; }

  /** The points that are shown: place, and the view that brought each (-1 the profile). */
  *shownPoints(): Generator<{ at: three.Vector3; view: number }> {
    const at = new three.Vector3();
    for (let state = 0, i = 0; state <= this.views; ++state) {
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

  /** After `n` views; the points of the last one are marked. */
  show(n: number, pxPerTan: number) {
    if (n !== this.views) {
      this.views = n;
      this.densities?.seek(n);
      if (this.by === "density") this.colour(this.by); // as dense as it was then
    }
    if (this.cloud) {
      this.cloud.geometry.setDrawRange(0, this.cloudAfter[n]);
      const { uniforms } = this.cloud.material as three.ShaderMaterial;
      uniforms.uNewFrom.value = this.newFrom();
      uniforms.uPxPerTan.value = pxPerTan;
      uniforms.uFade.value = this.fade();
    }
    if (this.voxels) this.voxels.count = this.voxelsAfter[n];
  }

  /** The points that are shown, for those who draw them themselves. */
  splats(): SplatSource[] {
    if (!this.cloud?.visible) return [];
    const rgb = this.cloud.geometry.getAttribute("rgb").array;
    const newFrom = this.newFrom();
    const fade = this.fade();
    const keep = 1 - fade.w;
    const [r, g, b] = [fade.x, fade.y, fade.z].map((part) => 255 * fade.w * part);
    return [{ places: this.points, toWorld: new three.Matrix4(), least_px: 1.6, most_px: 14,
      count: this.cloudAfter[this.views], size_m: this.pointSize(),
      isRound: true, largerFrom: newFrom,
      colourOf: (i) => (i >= newFrom ? kNewSplat
        : (keep * rgb[3 * i] + r) | (keep * rgb[3 * i + 1] + g) << 8
          | (keep * rgb[3 * i + 2] + b) << 16) }];
  }

  /** For a look at what some points cost: until show(), no more than `count` are there. */
  limit(count: number) {
    this.cloud?.geometry.setDrawRange(0, Math.min(count, this.cloudAfter[this.views]));
  }

  /** The colour that points fade to, and how much of it they take. */
  private fade(): three.Vector4 {
    const { r, g, b } = new three.Color().setHex(isDark() ? 0x252b33 : 0xe2e6eb,
      three.LinearSRGBColorSpace); // bytes, as those of the points
    return new three.Vector4(r, g, b, this.isFaded ? kFaded : 0);
  }

  private newFrom() { return this.views > 0 ? this.cloudAfter[this.views - 1] : 0x7fffffff; }

  /** Of a colouring. */
  private ramp(by: Colouring): [RampName, Share] {
    const [low, high] = this.heights;
    const states = Math.max(1, this.data.views.x.length);
    const most = this.densities?.most ?? 1;
    if (by === "iteration") return ["path", (_, __, state) => state / states];
    if (by === "density") return ["amount", (_, density) => density / most];
    return ["amount", (height) => (height - low) / (high - low)];
  }

  private colourCloud(by: Colouring) {
    const points = this.points;
    const count = points.length / 3;
    const attribute = this.cloud!.geometry.getAttribute("rgb") as three.BufferAttribute;
    const rgb = attribute.array as Uint8Array;
    if (by === "real" && this.data.cloud?.colour) {
      rgb.set(this.bytes.u8(this.data.cloud.colour));
    } else if (by === "error" && this.data.cloud?.error) {
      const table = rampTable("amount");
      const { most_mm } = this.errors!;
      this.bytes.u8(this.data.cloud.error).forEach((error, i) => {
        const at = 3 * Math.round(255 * Math.min(error / most_mm, 1));
        for (let k = 0; k < 3; ++k) rgb[3 * i + k] = error === 255 ? 128 : table[at + k];
      });
    } else {
      const [name, share] = this.ramp(by);
      const table = rampTable(name);
      const first = firstStates(this.cloudAfter, count);
      const voxels = by === "density" ? this.voxelsOfPoints() : null;
      for (let i = 0; i < count; ++i) {
        const density = voxels ? this.densities?.count[voxels[i]] ?? 0 : 0;
        const at = 3 * Math.round(
          255 * Math.min(Math.max(share(points[3 * i + 2], density, first[i]), 0), 1));
        for (let k = 0; k < 3; ++k) rgb[3 * i + k] = table[at + k];
      }
    }
    attribute.needsUpdate = true;
  }

  private voxelsOfPoints(): Int32Array {
    const points = this.points;
    return this.pointVoxels ??= Int32Array.from({ length: points.length / 3 }, (_, i) =>
      this.densities?.voxelAt(points[3 * i], points[3 * i + 1], points[3 * i + 2]) ?? -1);
  }

  private pointSize() { return 1.5 * Math.max(this.data.cloud!.cell_m, 0.02); }

  private makeCloud(): three.Points {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(this.points, 3));
    geometry.setAttribute("rgb",
      new three.BufferAttribute(new Uint8Array(this.points.length), 3, true));
    const material = new three.ShaderMaterial({
      vertexShader: kPointVertex,
      fragmentShader: kPointFragment,
      uniforms: { uSize: { value: this.pointSize() }, uPxPerTan: { value: 1 },
        uNewFrom: { value: 0 }, uFade: { value: new three.Vector4() } },
    });
    const points = new three.Points(geometry, material);
    points.frustumCulled = false;
    points.layers.set(kPointLayer);
    return points;
  }

  private makeVoxels(): three.InstancedMesh {
    const { index, count, size } = this.densities!;
    const box = new three.BoxGeometry(0.94 * size, 0.94 * size, 0.94 * size);
    const mesh = new three.InstancedMesh(box, new three.MeshLambertMaterial(), count.length);
    const place = new three.Matrix4();
    for (let i = 0; i < count.length; ++i) {
      place.makeTranslation(size * (index[3 * i] + 0.5), size * (index[3 * i + 1] + 0.5),
        size * (index[3 * i + 2] + 0.5));
      mesh.setMatrixAt(i, place);
    }
    mesh.frustumCulled = false;
    return mesh;
  }
}

// The voxels of the true surface: found by a run so far, missed, or found by another run alone.
import * as three from "three";
import { rampTable } from "./colours";
import type { Bytes, SurfaceData } from "./data";
import { kPointLayer } from "./depth_shading";
import type { SplatSource } from "./splats";

export const kNeverFound = 0xffff;

/** Of a cell by its index along each axis; exact in a double. */
export const keyOf = (x: number, y: number, z: number) => ((x + 32768) * 65536 + y + 32768) * 65536
  + z + 32768;

/** sRGB; what was missed as in the pictures of coverage, what was found far from frontiers' blue. */
export const foundColours = {
  found: 0xa9bd92,
  missed: 0xd5420a,
  missedInOrder: 0x98a0ab, // beside the colours of an order, which has an orange of its own
  onlyOther: 0x9b2fae, // missed here, found by another run that is shown
};

const kNearer = 2; // voxels that missed ones lie before where they are, so that no point hides them

const kVertex = `
uniform float uVoxel;
uniform float uNearer; // metres that missed ones are drawn before where they are
uniform float uPxPerTan;
uniform float uNow;
uniform float uStates;
uniform bvec2 uShows; // found, missed
uniform bool uByOrder;
uniform vec3 uFound;
uniform vec3 uMissed;
uniform vec3 uOnlyOther;
uniform sampler2D uRamp;
attribute float first;
attribute float foundByOther;
varying vec3 vColour;
void main() {
  bool isFound = first <= uNow;
  if (isFound ? !uShows.x : !uShows.y) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 0.0;
    return;
  }
  vec4 p = modelViewMatrix * vec4(uVoxel * (position + 0.5), 1.0);
  gl_Position = projectionMatrix * p;
  if (!isFound) { // over points beside it
    vec4 nearer = projectionMatrix * (p + vec4(0.0, 0.0, uNearer, 0.0));
    gl_Position.z = nearer.z / nearer.w * gl_Position.w;
  }
  gl_PointSize = clamp(1.3 * uVoxel * uPxPerTan / -p.z, isFound ? 1.6 : 2.5, 64.0);
  vec3 found = uByOrder ? texture2D(uRamp, vec2(first / uStates, 0.5)).rgb : uFound;
  vColour = isFound ? found : foundByOther > 0.5 ? uOnlyOther : uMissed;
}`;
const kFragment = `
varying vec3 vColour;
void main() { gl_FragColor = sRGBTransferEOTF(vec4(vColour, 1.0)); }`;

const srgb = (hex: number) =>
  new three.Vector3((hex >> 16) / 255, (hex >> 8 & 255) / 255, (hex & 255) / 255);

function rampTexture(): three.DataTexture {
  const rgba = new Uint8Array(4 * 256).fill(255);
  for (let i = 0; i < 256; ++i) rgba.set(rampTable("path").subarray(3 * i, 3 * i + 3), 4 * i);
  const texture = new three.DataTexture(rgba, 256, 1);
  texture.needsUpdate = true;
  return texture;
}

export class TrueSurface {
  readonly object: three.Points;
  readonly size_m: number;
  readonly voxels: Int16Array; // x y z index each
  private readonly material: three.ShaderMaterial;
  private others: TrueSurface[] = [];
  private readonly foundByOther: Uint8Array; // of each voxel whether
  private othersAt = ""; // after how many views of each of them

  /** `found`: of each voxel after how many views it was found, or kNeverFound. */
  constructor(data: SurfaceData, bytes: Bytes, readonly found: Uint16Array, states: number) {
    this.size_m = data.size_m;
    this.voxels = bytes.i16(data.index);
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(this.voxels, 3));
    geometry.setAttribute("first", new three.BufferAttribute(found, 1));
    this.foundByOther = new Uint8Array(found.length);
    geometry.setAttribute("foundByOther", new three.BufferAttribute(this.foundByOther, 1));
    this.material = new three.ShaderMaterial({
      vertexShader: kVertex,
      fragmentShader: kFragment,
      uniforms: { uVoxel: { value: this.size_m }, uPxPerTan: { value: 1 },
        uNearer: { value: kNearer * this.size_m }, uNow: { value: 0 },
        uStates: { value: Math.max(1, states) },
        uShows: { value: new three.Vector2(0, 0) }, uByOrder: { value: false },
        uFound: { value: srgb(foundColours.found) }, uMissed: { value: srgb(foundColours.missed) },
        uOnlyOther: { value: srgb(foundColours.onlyOther) }, uRamp: { value: rampTexture() } },
    });
    this.object = new three.Points(geometry, this.material);
    this.object.frustumCulled = false;
    this.object.layers.set(kPointLayer);
  }

  setLayers(showsFound: boolean, showsMissed: boolean) {
    this.material.uniforms.uShows.value = new three.Vector2(+showsFound, +showsMissed);
    this.object.visible = showsFound || showsMissed;
  }

  colourByOrder(isByOrder: boolean) {
    const { uByOrder, uMissed } = this.material.uniforms;
    uByOrder.value = isByOrder;
    uMissed.value = srgb(isByOrder ? foundColours.missedInOrder : foundColours.missed);
  }

  /** What other runs of the same structure found is told from what none did. */
  compareWith(others: TrueSurface[]) {
    this.others = others;
    this.othersAt = "not yet";
  }

  /** After `n` views of this run, and so many of each of the others. */
  show(n: number, ofOthers: number[], pxPerTan: number) {
    const { uniforms } = this.material;
    uniforms.uNow.value = n;
    uniforms.uPxPerTan.value = pxPerTan;
    if (this.object.visible && this.othersAt !== ofOthers.join()) this.markOthers(ofOthers);
  }

  private markOthers(views: number[]) {
    this.othersAt = views.join();
    for (let i = 0; i < this.found.length; ++i) {
      this.foundByOther[i] = Number(this.others.some(({ found }, k) => found[i] <= views[k]));
    }
    this.object.geometry.getAttribute("foundByOther").needsUpdate = true;
  }

  /** The voxels that are shown, for those who draw them themselves. */
  splats(): SplatSource[] {
    if (!this.object.visible) return [];
    const { uNow, uShows, uByOrder, uStates } = this.material.uniforms;
    const [now, states] = [uNow.value, uStates.value];
    const colours = [foundColours.found,
      uByOrder.value ? foundColours.missedInOrder : foundColours.missed, foundColours.onlyOther]
      .map((hex) => hex >> 16 | hex & 0xff00 | (hex & 255) << 16);
    const table = uByOrder.value ? rampTable("path") : null;
    const foundColour = (i: number) => {
      const first = this.found[i];
      if (first > now || !table) return first > now ? -1 : colours[0];
      const at = 3 * Math.round(255 * first / states);
      return table[at] | table[at + 1] << 8 | table[at + 2] << 16;
    };
    const missedColour = (i: number) => (this.found[i] <= now ? -1
      : colours[this.foundByOther[i] ? 2 : 1]);
    const all = { places: this.voxels, count: this.found.length, size_m: 1.3 * this.size_m,
      most_px: 64, isRound: false, largerFrom: Infinity,
      toWorld: new three.Matrix4().makeScale(this.size_m, this.size_m, this.size_m)
        .multiply(new three.Matrix4().makeTranslation(0.5, 0.5, 0.5)) };
    return [...uShows.value.x > 0 ? [{ ...all, least_px: 1.6, colourOf: foundColour }] : [],
      ...uShows.value.y > 0 ? [{ ...all, least_px: 2.5, nearer_m: kNearer * this.size_m,
        colourOf: missedColour }] : []];
  }

  /** How many voxels there are of each kind, as they are shown. */
  counts(): { found: number; missed: number; onlyOther: number } {
    const { uNow } = this.material.uniforms;
    const counts = { found: 0, missed: 0, onlyOther: 0 };
    this.found.forEach((first, i) => {
      if (first <= uNow.value) ++counts.found;
      else if (this.foundByOther[i]) ++counts.onlyOther;
      else ++counts.missed;
    });
    return counts;
  }

  centre(voxel: number): three.Vector3 {
    return new three.Vector3().fromArray(this.voxels, 3 * voxel).addScalar(0.5)
      .multiplyScalar(this.size_m);
  }

  isShown(voxel: number): boolean {
    const { uShows, uNow } = this.material.uniforms;
    const isFound = this.found[voxel] <= uNow.value;
    return this.object.visible && (isFound ? uShows.value.x : uShows.value.y) > 0;
  }
}

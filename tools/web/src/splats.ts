// Points: projected and drawn into a picture by this very program, which then lies in the scene as
// a sheet with depths of its own. That takes some nanoseconds a point, with a graphics card or
// without, where renderers in software take microseconds.
import * as three from "three";
import { kFullVertex, kGistRatio, kSurfaceLayer, type Shot } from "./painter";

const kFragment = `
uniform sampler2D uColour;
uniform sampler2D uDepth;
varying vec2 vAt;
void main() {
  float depth = texture2D(uDepth, vAt).x;
  if (depth >= 1.0) discard;
  gl_FragColor = sRGBTransferEOTF(vec4(texture2D(uColour, vAt).bgr, 1.0)); // of 0xrrggbb
  gl_FragDepth = depth;
}`;

export interface SplatSource {
  readonly places: Float32Array | Float64Array; // x y z each
  readonly count: number;
  readonly size_m: number;
  readonly least_px: number;
  readonly most_px: number;
  readonly isRound: boolean; // else squares
  readonly nearer_m: number; // than it is, for what would be hidden
  readonly largerFrom: number; // points by one pixel, from this one on
  /** 0xrrggbb as sRGB; below 0 what is not drawn. */
  colourOf(point: number): number;
}

export class Splats {
  private width = 0;
  private height = 0;
  private colour = new Uint32Array();
  private depth = new Float32Array();
  private readonly material = new three.ShaderMaterial({ vertexShader: kFullVertex,
    fragmentShader: kFragment, uniforms: { uColour: { value: null }, uDepth: { value: null } } });
  readonly object = new three.Mesh(new three.PlaneGeometry(2, 2), this.material);

  constructor() {
    this.object.frustumCulled = false;
    this.object.layers.set(kSurfaceLayer);
  }

  /** All of `sources`. */
  show(sources: SplatSource[], { camera, pxPerTan, isWhole }: Shot) {
    this.object.visible = sources.length > 0;
    if (sources.length === 0) return;
    const height = Math.max(1, Math.round(2 * pxPerTan
      * Math.tan(three.MathUtils.degToRad(camera.fov) / 2)));
    this.clear(Math.max(1, Math.round(height * camera.aspect)), height);
    camera.updateMatrixWorld();
    for (const source of sources) this.add(source, camera, pxPerTan, isWhole ? 1 : kGistRatio);
    for (const { value } of Object.values(this.material.uniforms)) value.needsUpdate = true;
  }

  private clear(width: number, height: number) {
    if (width !== this.width || height !== this.height) {
      [this.width, this.height] = [width, height];
      this.colour = new Uint32Array(width * height);
      this.depth = new Float32Array(width * height);
      const { uColour, uDepth } = this.material.uniforms;
      for (const { value } of [uColour, uDepth]) value?.dispose();
      uColour.value = new three.DataTexture(new Uint8Array(this.colour.buffer), width, height);
      uDepth.value = new three.DataTexture(this.depth, width, height, three.RedFormat,
        three.FloatType);
    }
    this.depth.fill(1);
  }

  /** With `pxRatio` pixels on a side of one of their sizes. */
  private add(source: SplatSource, camera: three.PerspectiveCamera, pxPerTan: number,
      pxRatio: number) {
    const { places, count } = source;
    const { width, height, colour, depth } = this;
    const m = new three.Matrix4().multiplyMatrices(camera.projectionMatrix,
      camera.matrixWorldInverse).elements;
    const perMetre = -camera.projectionMatrix.elements[10]; // of clip depth
    for (let i = 0, at = 0; i < count; ++i, at += 3) {
      const [x, y, z] = [places[at], places[at + 1], places[at + 2]];
      const w = m[3] * x + m[7] * y + m[11] * z + m[15];
      if (w <= 0) continue;
      const px = (0.5 + 0.5 * (m[0] * x + m[4] * y + m[8] * z + m[12]) / w) * width;
      const py = (0.5 + 0.5 * (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) * height;
      if (!(px > -8 && py > -8 && px < width + 8 && py < height + 8)) continue;
      const rgb = source.colourOf(i);
      if (rgb < 0) continue;
      const nearer = Math.min(source.nearer_m, 0.5 * w);
      const depthOf = m[2] * x + m[6] * y + m[10] * z + m[14] - perMetre * nearer;
      const d = 0.5 + 0.5 * depthOf / (w - nearer);
      const size_px = Math.min(Math.max(source.size_m * pxPerTan / w, pxRatio * source.least_px),
        pxRatio * source.most_px);
      const radius = 0.5 * (size_px + (i >= source.largerFrom ? pxRatio : 0));
      // the pixels whose middles lie in it, as of the renderer's points
      const last = Math.min(height - 1, Math.floor(py + radius - 0.5));
      for (let row = Math.max(0, Math.ceil(py - radius - 0.5)); row <= last; ++row) {
        const reach = source.isRound
          ? Math.sqrt(radius * radius - (row + 0.5 - py) ** 2) : radius;
        const end = row * width + Math.min(width - 1, Math.floor(px + reach - 0.5));
        for (let pixel = row * width + Math.max(0, Math.ceil(px - reach - 0.5));
            pixel <= end; ++pixel) {
          if (d >= depth[pixel]) continue;
          depth[pixel] = d;
          colour[pixel] = rgb;
        }
      }
    }
  }
}

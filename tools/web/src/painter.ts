// Draws the panes of the 3D view, surfaces with eye-dome lighting: a pixel is darkened by how far
// its neighbours stand out before it, which gives a cloud without normals its shape (Boucheny 2009).
// Lines and other marks are drawn afterwards, or each would wear a dark halo.
import * as three from "three";
import { FullScreenQuad } from "three/addons/postprocessing/Pass.js";
import { isDark } from "./colours";
import type { RunScene, Side } from "./run_scene";

/** What a picture is taken with; whole, or the gist of it. */
export interface Shot {
  camera: three.PerspectiveCamera;
  pxPerTan: number; // pixels that it draws a unit of tangent
  isWhole: boolean;
}

/** Pixels on a side of the gist of a picture, of those of the whole one. */
export const kGistRatio = 0.5;

/** Of what fills the picture. */
const kFullVertex = `
varying vec2 vAt;
void main() { vAt = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }`;

const kFragment = `
uniform sampler2D uColour;
uniform sampler2D uDepth;
uniform float uReach; // in pixels
uniform float uNear;
uniform float uFar;
uniform int uNeighbours;
uniform float uRelief; // in metres; 0: none
uniform float uPxPerTan;
uniform vec3 uSun; // seen from the camera
varying vec2 vAt;
vec2 size() { return vec2(textureSize(uDepth, 0)); }
float logDepth(vec2 at) {
  float z = texture2D(uDepth, at).x;
  return log2(uNear * uFar / (uFar - z * (uFar - uNear)));
}
vec3 placeAt(vec2 at) {
  float away = exp2(logDepth(at));
  return vec3((at - 0.5) * size() / uPxPerTan * away, -away);
}
/** Of the two steps along a way the flatter one: the other may lead off an edge. */
vec3 stepAlong(vec3 here, vec2 way) {
  vec3 on = placeAt(vAt + way) - here;
  vec3 back = here - placeAt(vAt - way);
  return abs(on.z) < abs(back.z) ? on : back;
}
float light() {
  vec3 here = placeAt(vAt);
  vec2 px = clamp(uRelief * uPxPerTan / -here.z, 2.0, 40.0) / size();
  vec3 normal = normalize(cross(stepAlong(here, vec2(px.x, 0.0)), stepAlong(here, vec2(0.0, px.y))));
  return 0.62 + 0.46 * max(dot(normal, uSun), 0.0);
}
void main() {
  vec4 colour = texture2D(uColour, vAt);
  float here = logDepth(vAt);
  float before = 0.0;
  for (int i = 0; i < uNeighbours; ++i) {
    float angle = 6.283185 * float(i) / float(uNeighbours);
    before += max(0.0, here - logDepth(vAt + uReach / size() * vec2(cos(angle), sin(angle))));
  }
  float isSomething = step(texture2D(uDepth, vAt).x, 0.99999);
  colour.rgb *= mix(1.0, max(0.25, exp(-9.0 * before / float(uNeighbours))), isSomething);
  if (uRelief > 0.0 && isSomething > 0.5) colour.rgb *= light();
  gl_FragColor = linearToOutputTexel(vec4(colour.rgb, 1.0));
  gl_FragDepth = texture2D(uDepth, vAt).x;
}`;

/** What is shaded, and what is drawn over it. */
export const kSurfaceLayer = 0;
export const kMarkLayer = 1;

export const kSun = new three.Vector3(-0.5, -0.8, 1.4);

export interface Pane { left: number; top: number; width: number; height: number }

export class Painter {
  private readonly renderer: three.WebGLRenderer;
  private readonly background = new three.Color();
  private readonly target = new three.WebGLRenderTarget(4, 4, { type: three.HalfFloatType,
    depthTexture: new three.DepthTexture(4, 4, three.UnsignedIntType) });
  private readonly shading = new three.ShaderMaterial({
    vertexShader: kFullVertex, fragmentShader: kFragment,
    depthFunc: three.AlwaysDepth, // brings the surfaces' depths along, for the marks
  });
  private readonly quad = new FullScreenQuad(this.shading);

  /** Throws where there is no WebGL. */
  constructor(canvas: HTMLCanvasElement) {
    this.renderer = new three.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setScissorTest(true);
    this.renderer.autoClear = false;
    this.renderer.debug.checkShaderErrors = false; // asking waits for the compiler
  }

  fitCanvas(width: number, height: number, ratio: number) {
    const size = this.renderer.getSize(new three.Vector2());
    if (size.x === width && size.y === height && this.renderer.getPixelRatio() === ratio) return;
    this.renderer.setDrawingBufferSize(width, height, ratio); // once: it takes its time
  }

  /** A scene into its pane; `share` of it is the truth where a surface is beside it. */
  paint(scene: RunScene, shot: Shot, { left: x, top, width, height }: Pane, share: number) {
    const y = this.renderer.getSize(new three.Vector2()).y - top - height; // from below
    this.renderer.setViewport(x, y, width, height);
    const line = Math.round(width * share);
    const sides: [Side, number, number][] = scene.isSwiped()
      ? [["truth", 0, line], ["surface", line, width]] : [["all", 0, width]];
    for (const [side, from, to] of sides) {
      scene.showSide(side);
      scene.show(shot);
      this.renderer.setScissor(x + from, y, to - from, height);
      this.render(scene, shot, width, height);
    }
  }

  /** Until it is drawn: what was asked for so far is only in a queue. */
  wait() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Into the present viewport; with smooth edges where it is a whole picture. */
  private render(scene: RunScene, { camera, pxPerTan, isWhole }: Shot, width: number,
      height: number) {
    const { renderer, target } = this;
    const ratio = renderer.getPixelRatio();
    const samples = isWhole ? 4 : 0;
    if (target.samples !== samples) target.dispose();
    target.samples = samples;
    const [w, h] = [width, height].map((side) => Math.max(1, Math.round(side * ratio)));
    target.setSize(w, h);
    const values = { uColour: target.texture, uDepth: target.depthTexture, uReach: 1.2 * ratio,
      uNear: camera.near, uFar: camera.far, uNeighbours: isWhole ? 8 : 4,
      uRelief: scene.relief_m(), uPxPerTan: pxPerTan,
      uSun: kSun.clone().transformDirection(camera.matrixWorldInverse) };
    for (const [name, value] of Object.entries(values)) this.shading.uniforms[name] = { value };
    renderer.setRenderTarget(target);
    // here, since it is converted for the present target
    renderer.setClearColor(this.background.setHex(isDark() ? 0x14181e : 0xf4f6f9));
    renderer.clear();
    camera.layers.set(kSurfaceLayer);
    renderer.render(scene.scene, camera);
    renderer.setRenderTarget(null);
    renderer.clear();
    this.quad.render(renderer);
    camera.layers.set(kMarkLayer);
    renderer.render(scene.scene, camera);
  }
}

const kSplatFragment = `
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

/**
 * Points: projected and drawn into a picture by this very program, which then lies in the scene as
 * a sheet with depths of its own. That takes some nanoseconds a point, with a graphics card or
 * without, where renderers in software take microseconds.
 */
export class Splats {
  private width = 0;
  private height = 0;
  private colour = new Uint32Array();
  private depth = new Float32Array();
  private readonly material = new three.ShaderMaterial({ vertexShader: kFullVertex,
    fragmentShader: kSplatFragment, uniforms: { uColour: { value: null }, uDepth: { value: null } } });
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
    this.fit(Math.max(1, Math.round(height * camera.aspect)), height);
    this.depth.fill(1);
    camera.updateMatrixWorld();
    for (const source of sources) this.add(source, camera, pxPerTan, isWhole ? 1 : kGistRatio);
    for (const { value } of Object.values(this.material.uniforms)) value.needsUpdate = true;
  }

  private fit(width: number, height: number) {
    if (width === this.width && height === this.height) return;
    [this.width, this.height] = [width, height];
    this.colour = new Uint32Array(width * height);
    this.depth = new Float32Array(width * height);
    const { uColour, uDepth } = this.material.uniforms;
    for (const { value } of [uColour, uDepth]) value?.dispose();
    uColour.value = new three.DataTexture(new Uint8Array(this.colour.buffer), width, height);
    uDepth.value = new three.DataTexture(this.depth, width, height, three.RedFormat,
      three.FloatType);
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

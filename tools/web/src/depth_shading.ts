// Eye-dome lighting: a pixel is darkened by how far its neighbours stand out before it, which gives
// a cloud without normals its shape (Boucheny 2009). Lines and other marks are drawn afterwards, or
// each would wear a dark halo.
import * as three from "three";
import { FullScreenQuad } from "three/addons/postprocessing/Pass.js";

/** Of what fills the picture. */
export const kFullVertex = `
varying vec2 vAt;
void main() { vAt = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }`;

const kFragment = `
uniform sampler2D uColour;
uniform sampler2D uDepth;
uniform vec2 uPixel;
uniform float uNear;
uniform float uFar;
uniform int uNeighbours;
uniform float uRelief; // in metres; 0: none
uniform float uPxPerTan;
uniform vec3 uSun; // seen from the camera
varying vec2 vAt;
float logDepth(vec2 at) {
  float z = texture2D(uDepth, at).x;
  return log2(uNear * uFar / (uFar - z * (uFar - uNear)));
}
vec3 placeAt(vec2 at) {
  vec2 size = vec2(textureSize(uDepth, 0));
  float away = exp2(logDepth(at));
  return vec3((at - 0.5) * size / uPxPerTan * away, -away);
}
/** Of the two steps along a way the flatter one: the other may lead off an edge. */
vec3 stepAlong(vec3 here, vec2 way) {
  vec3 on = placeAt(vAt + way) - here;
  vec3 back = here - placeAt(vAt - way);
  return abs(on.z) < abs(back.z) ? on : back;
}
float light() {
  vec3 here = placeAt(vAt);
  vec2 px = clamp(uRelief * uPxPerTan / -here.z, 2.0, 40.0) / vec2(textureSize(uDepth, 0));
  vec3 normal = normalize(cross(stepAlong(here, vec2(px.x, 0.0)), stepAlong(here, vec2(0.0, px.y))));
  return 0.62 + 0.46 * max(dot(normal, uSun), 0.0);
}
void main() {
  vec4 colour = texture2D(uColour, vAt);
  float here = logDepth(vAt);
  float before = 0.0;
  for (int i = 0; i < uNeighbours; ++i) {
    float angle = 6.283185 * float(i) / float(uNeighbours);
    before += max(0.0, here - logDepth(vAt + uPixel * vec2(cos(angle), sin(angle))));
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

const kSun = new three.Vector3(-0.5, -0.8, 1.4).normalize();

export class DepthShading {
  readonly background = new three.Color();
  private readonly whole = DepthShading.makeTarget(4);
  private readonly quick = DepthShading.makeTarget(0);
  private readonly material: three.ShaderMaterial;
  private readonly quad: FullScreenQuad;

  constructor() {
    this.material = new three.ShaderMaterial({
      vertexShader: kFullVertex, fragmentShader: kFragment,
      depthFunc: three.AlwaysDepth, // brings the surfaces' depths along, for the marks
      uniforms: {
        uColour: { value: this.whole.texture },
        uDepth: { value: this.whole.depthTexture },
        uPixel: { value: new three.Vector2() },
        uNear: { value: 0.1 },
        uFar: { value: 100 },
        uNeighbours: { value: 8 },
        uRelief: { value: 0 },
        uPxPerTan: { value: 1 },
        uSun: { value: new three.Vector3() },
      },
    });
    this.quad = new FullScreenQuad(this.material);
  }

  private static makeTarget(samples: number) {
    const target = new three.WebGLRenderTarget(4, 4, { type: three.HalfFloatType, samples });
    target.depthTexture = new three.DepthTexture(4, 4, three.UnsignedIntType);
    return target;
  }

  /**
   * Draws the scene into the renderer's present viewport, which is `width` x `height` CSS px; with
   * smooth edges where it is a whole picture.
   */
  render(renderer: three.WebGLRenderer, scene: three.Scene, camera: three.PerspectiveCamera,
      width: number, height: number, isWhole: boolean, relief_m = 0) {
    const target = isWhole ? this.whole : this.quick;
    const ratio = renderer.getPixelRatio();
    const [w, h] = [width, height].map((side) => Math.max(1, Math.round(side * ratio)));
    if (target.width !== w || target.height !== h) target.setSize(w, h);
    const { uColour, uDepth, uPixel, uNear, uFar, uNeighbours, uRelief, uPxPerTan, uSun } =
      this.material.uniforms;
    uColour.value = target.texture;
    uDepth.value = target.depthTexture;
    uNeighbours.value = isWhole ? 8 : 4;
    uPixel.value.set(1.2 * ratio / w, 1.2 * ratio / h);
    uNear.value = camera.near;
    uFar.value = camera.far;
    uRelief.value = relief_m;
    uPxPerTan.value = 0.5 * h / Math.tan(three.MathUtils.degToRad(camera.fov) / 2);
    uSun.value.copy(kSun).transformDirection(camera.matrixWorldInverse);
    renderer.setRenderTarget(target);
    renderer.setClearColor(this.background); // here, since it is converted for the present target
    renderer.clear();
    camera.layers.set(kSurfaceLayer);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.clear();
    this.quad.render(renderer);
    camera.layers.set(kMarkLayer);
    renderer.render(scene, camera);
  }
}

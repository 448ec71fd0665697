// Eye-dome lighting: a pixel is darkened by how far its neighbours stand out before it, which gives
// a cloud without normals its shape (Boucheny 2009). Lines and other marks are drawn afterwards, or
// each would wear a dark halo.
import * as three from "three";

const kVertex = `
varying vec2 vAt;
void main() { vAt = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }`;

const kFragment = `
uniform sampler2D uColour;
uniform sampler2D uDepth;
uniform vec2 uPixel;
uniform float uNear;
uniform float uFar;
uniform int uNeighbours;
varying vec2 vAt;
float logDepth(vec2 at) {
  float z = texture2D(uDepth, at).x;
  return log2(uNear * uFar / (uFar - z * (uFar - uNear)));
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
  gl_FragColor = linearToOutputTexel(vec4(colour.rgb, 1.0));
  gl_FragDepth = texture2D(uDepth, vAt).x;
}`;

/** What is shaded, and what is drawn over it. */
export const kSurfaceLayer = 0;
export const kMarkLayer = 1;

export class DepthShading {
  readonly background = new three.Color();
  private readonly whole = DepthShading.makeTarget(4);
  private readonly quick = DepthShading.makeTarget(0);
  private readonly material: three.ShaderMaterial;
  private readonly quad: three.Mesh;
  private readonly screen = new three.OrthographicCamera(-1, 1, 1, -1, 0, 1);

  constructor() {
    this.material = new three.ShaderMaterial({
      vertexShader: kVertex,
      fragmentShader: kFragment,
      depthFunc: three.AlwaysDepth, // brings the surfaces' depths along, for the marks
      uniforms: {
        uColour: { value: this.whole.texture },
        uDepth: { value: this.whole.depthTexture },
        uPixel: { value: new three.Vector2() },
        uNear: { value: 0.1 },
        uFar: { value: 100 },
        uNeighbours: { value: 8 },
      },
    });
    this.quad = new three.Mesh(new three.PlaneGeometry(2, 2), this.material);
    this.quad.frustumCulled = false;
  }

  private static makeTarget(samples: number) {
    const target = new three.WebGLRenderTarget(4, 4, { type: three.HalfFloatType, samples });
    target.depthTexture = new three.DepthTexture(4, 4, three.UnsignedIntType);
    return target;
  }

  /**
   * Draws the scene into the renderer's present viewport, which is `width` x `height` CSS px;
   * without smooth edges where it is to be quick.
   */
  render(renderer: three.WebGLRenderer, scene: three.Scene, camera: three.PerspectiveCamera,
      width: number, height: number, isWhole: boolean) {
    const target = isWhole ? this.whole : this.quick;
    const ratio = renderer.getPixelRatio();
    const [w, h] = [width, height].map((side) => Math.max(1, Math.round(side * ratio)));
    if (target.width !== w || target.height !== h) target.setSize(w, h);
    const { uColour, uDepth, uPixel, uNear, uFar, uNeighbours } = this.material.uniforms;
    uColour.value = target.texture;
    uDepth.value = target.depthTexture;
    uNeighbours.value = isWhole ? 8 : 4;
    uPixel.value.set(1.2 * ratio / w, 1.2 * ratio / h);
    uNear.value = camera.near;
    uFar.value = camera.far;
    renderer.setRenderTarget(target);
    renderer.setClearColor(this.background); // here, since it is converted for the present target
    renderer.clear();
    camera.layers.set(kSurfaceLayer);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.clear();
    renderer.render(this.quad, this.screen);
    camera.layers.set(kMarkLayer);
    renderer.render(scene, camera);
  }
}

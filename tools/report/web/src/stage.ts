// The 3D view: a pane for each run that is shown, and one camera for all of them.
import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { isDark } from "./colours";
import type { Clock } from "./clock";
import { make } from "./dom";
import { DepthShading } from "./depth_shading";
import type { View3d } from "./controls";
import type { Layers, RunScene } from "./run_scene";
import type { Colouring } from "./surfaces";

/** In the place of the view, where the browser cannot draw it. */
class NoStage implements View3d {
  readonly canDraw = false;
  readonly element = make("div", { class: "stage none" }, make("p", { class: "nothing" },
    "3D needs WebGL, which this browser or its settings do not offer."));
  setShown() {}
  setLayers() {}
  colour() {}
  setFollows() {}
  setTheme() {}
  frame() {}
  cameraPosition() { return []; }
}

export function makeStage(scenes: RunScene[], clock: Clock): View3d {
  try {
    return new Stage(scenes, clock);
  } catch (error) {
    console.warn(error);
    return new NoStage();
  }
}

class Stage implements View3d {
  readonly canDraw = true;
  readonly element: HTMLElement;
  private readonly canvas = make("canvas", { tabindex: 0, role: "img", "aria-label":
    "3D view of the mission. Drag to turn, wheel to zoom, right drag to move, "
    + "arrow keys to replay." });
  private readonly labels = make("div", { class: "panes" });
  private readonly renderer: three.WebGLRenderer;
  private readonly camera = new three.PerspectiveCamera(38, 1, 0.1, 1000);
  private readonly controls: OrbitControls;
  private readonly shading = new DepthShading();
  private shown: RunScene[];
  private isStale = true;
  private isFramed = false;
  private follows = false;

  constructor(private readonly scenes: RunScene[], private readonly clock: Clock) {
    this.shown = scenes;
    this.element = make("div", { class: "stage" }, this.canvas, this.labels);
    this.renderer = new three.WebGLRenderer({ canvas: this.canvas, antialias: true });
    this.renderer.setScissorTest(true);
    this.renderer.autoClear = false;
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.maxPolarAngle = 0.55 * Math.PI;
    this.controls.addEventListener("change", () => this.invalidate());
    this.canvas.addEventListener("dblclick", () => this.frame());
    new ResizeObserver(() => this.resize()).observe(this.element);
    clock.onChange(() => this.invalidate());
    this.setTheme();
    this.setShown(scenes);
  }

  invalidate() {
    if (this.isStale) return;
    this.isStale = true;
    requestAnimationFrame(() => this.draw());
  }

  setShown(scenes: RunScene[]) {
    this.shown = scenes;
    this.labels.replaceChildren(...scenes.map((scene) => make("div", { class: "pane" },
      this.scenes.length > 1
        ? make("span", { class: `chip run-${scene.flight.index}` }, scene.flight.data.label)
        : null)));
    this.resize();
  }

  setLayers(layers: Layers) {
    for (const scene of this.scenes) scene.setLayers(layers);
    this.invalidate();
  }

  colour(by: Colouring) {
    for (const scene of this.scenes) scene.colour(by);
    this.invalidate();
  }

  setFollows(follows: boolean) {
    this.follows = follows;
    if (follows && this.shown.length > 0) {
      const target = this.shown[0].vehicle.position;
      const direction = this.camera.position.clone().sub(this.controls.target).normalize();
      this.camera.position.copy(target).addScaledVector(direction, 14);
      this.controls.target.copy(target);
      this.controls.update();
    }
    this.invalidate();
  }

  setTheme() {
    this.shading.background.setHex(isDark() ? 0x14181e : 0xf4f6f9);
    this.invalidate();
  }

  cameraPosition() { return this.camera.position.toArray(); }

  /** Puts the camera where it sees all of the structure. */
  frame() {
    const outlines = this.shown.map((scene) => scene.outline());
    const box = new three.Box3();
    for (const outline of outlines) box.union(new three.Box3().setFromArray(outline));
    const centre = box.getCenter(new three.Vector3());
    const { width, height } = this.paneSize();
    const tan = 0.86 * Math.tan(three.MathUtils.degToRad(this.camera.fov) / 2);
    const back = new three.Vector3(0.55, -0.8, 0.5).normalize();
    const right = new three.Vector3(-back.y, back.x, 0).normalize();
    const up = back.clone().cross(right);
    const at = new three.Vector3();
    let away = 1; // the nearest that sees every point
    for (const outline of outlines) {
      for (let i = 0; i < outline.length; i += 3) {
        at.fromArray(outline, i).sub(centre);
        away = Math.max(away, at.dot(back) + Math.abs(at.dot(up)) / tan,
          at.dot(back) + Math.abs(at.dot(right)) / tan * height / width);
      }
    }
    this.isFramed = true;
    this.setDepths(away);
    this.camera.position.copy(centre).addScaledVector(back, away);
    this.controls.target.copy(centre);
    this.controls.update();
    this.invalidate();
  }

  /** So that nothing is cut off, as far as anybody may go from a picture taken at `away`. */
  private setDepths(away: number) {
    const all = new three.Box3();
    for (const scene of this.shown) all.union(scene.bounds());
    const extent = all.isEmpty() ? 1 : all.getSize(new three.Vector3()).length();
    this.controls.maxDistance = 4 * Math.max(away, extent);
    this.camera.far = this.controls.maxDistance + 2 * extent;
    this.camera.near = this.camera.far / 2500;
    this.camera.updateProjectionMatrix();
  }

  private isColumn() { return this.element.clientWidth < 560; }

  private paneSize() {
    const count = Math.max(1, this.shown.length);
    const { clientWidth: w, clientHeight: h } = this.element;
    return this.isColumn() ? { width: w, height: h / count } : { width: w / count, height: h };
  }

  private resize() {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.labels.classList.toggle("column", this.isColumn());
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(clientWidth, clientHeight, false);
    const { width, height } = this.paneSize();
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.isFramed) this.frame();
    this.isStale = true;
    this.draw(); // now, or a resized canvas would show one empty picture
  }

  private draw() {
    this.isStale = false;
    const { width, height } = this.paneSize();
    const total = this.element.clientHeight;
    const pxPerTan = 0.5 * height * this.renderer.getPixelRatio() /
      Math.tan(three.MathUtils.degToRad(this.camera.fov) / 2);
    if (this.follows && this.shown.length > 0) this.moveAlong(pxPerTan);
    this.shown.forEach((scene, i) => {
      scene.show(this.clock, this.camera, pxPerTan);
      const [x, y] = this.isColumn() ? [0, total - (i + 1) * height] : [i * width, 0];
      this.renderer.setViewport(x, y, width, height);
      this.renderer.setScissor(x, y, width, height);
      this.shading.render(this.renderer, scene.scene, this.camera, width, height);
    });
  }

  /** Keeps the camera's place beside the first vehicle. */
  private moveAlong(pxPerTan: number) {
    const lead = this.shown[0];
    lead.show(this.clock, this.camera, pxPerTan);
    const step = lead.vehicle.position.clone().sub(this.controls.target);
    this.camera.position.add(step);
    this.controls.target.add(step);
  }
}

// The 3D view: a pane for each run that is shown, and one camera for all of them.
import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Clock } from "./clock";
import { Detail } from "./detail";
import { make, ofRun, saveFile } from "./dom";
import { Axes, Swipe } from "./overlays";
import { Painter, kGistRatio, type Pane } from "./painter";
import { PaneCamera, nearestThatSees } from "./pane_camera";
import { Pointing, pick } from "./pointing";
import type { Layers, RunScene } from "./run_scene";
import type { Colouring } from "./surfaces";

const kLeastPane_px = 400; // narrower ones stand one above the other
const kAround = 0.35; // of the structure's extent, how far a camera stands from a part at least
const kPointer_px = 9;
const kAim_px = 60; // of the middle, which a key asks about
const kTurn_rad = Math.PI / 24; // by a key
const kZoom = 1.15;
const kPan = 0.07; // of the view's height

export class Stage {
  readonly element: HTMLElement;
  readonly detail = new Detail(() => this.request());
  private readonly canvas = make("canvas", { tabindex: 0, role: "img", "aria-label":
    "3D view of the mission. Drag or a, d, w, s to turn, wheel or + and - to zoom, right drag or "
    + "j, l, i, k to move, 0 to fit, a click or Enter in the middle tells what is there, "
    + "arrow keys replay." });
  private readonly labels = make("div", { class: "panes" });
  private readonly painter = new Painter(this.canvas);
  private readonly camera = new three.PerspectiveCamera(38, 1, 0.1, 1000);
  private readonly paneCameras: Map<RunScene, PaneCamera>;
  private readonly controls: OrbitControls;
  private readonly pointing: Pointing;
  private readonly axes = new Axes();
  private readonly swipe = new Swipe(() => this.invalidate());
  private shown: RunScene[];
  private isStale = false;
  private size = ""; // drawn last
  private isFramed = false;
  private isPrinted = false;

  /** Null where the browser cannot draw it. */
  static make(...args: ConstructorParameters<typeof Stage>): Stage | null {
    try {
      return new Stage(...args);
    } catch (error) {
      console.warn(error);
      return null;
    }
  }

  constructor(private readonly scenes: RunScene[], clock: Clock, private readonly name: string) {
    this.shown = scenes;
    this.pointing = new Pointing((view) => clock.seek(view + 1));
    this.element = make("div", { class: "stage" }, this.canvas, this.labels, this.axes.element,
      this.pointing.element, make("span", { class: "aim" }), this.swipe.element);
    this.paneCameras = new Map(scenes.map((scene) =>
      [scene, new PaneCamera(scenes[0].flight, scene.flight)]));
    for (const scene of scenes) scene.onLoad = () => this.invalidate();
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.maxPolarAngle = 0.55 * Math.PI;
    this.onChange(() => this.invalidate());
    clock.onChange(() => this.invalidate());
    this.listen();
    this.setShown(scenes);
  }

  private listen() {
    this.canvas.addEventListener("dblclick", () => this.frame());
    this.canvas.addEventListener("keydown", (event) => this.handleKey(event));
    let from = [0, 0];
    this.canvas.addEventListener("pointerdown", ({ clientX, clientY }) => {
      from = [clientX, clientY];
    });
    this.canvas.addEventListener("pointerup", ({ clientX, clientY, offsetX, offsetY }) => {
      const hasMoved = Math.hypot(clientX - from[0], clientY - from[1]) > 4;
      if (!hasMoved) this.pickAt(offsetX, offsetY, kPointer_px);
    });
    new ResizeObserver(() => { if (this.sizeNow() !== this.size) this.resize(); })
      .observe(this.element);
    addEventListener("beforeprint", () => this.print(true));
    addEventListener("afterprint", () => this.print(false));
  }

  invalidate() {
    this.detail.change();
    this.request();
  }

  /** Before the browser would ask for it: who prints at once asks for none. */
  drawNow() {
    this.resize();
    this.draw();
  }

  /** For paper in its own shape, a whole picture; and back. */
  private print(isPrinted: boolean) {
    this.isPrinted = isPrinted;
    this.element.classList.toggle("printed", isPrinted);
    this.resize();
    if (isPrinted && this.isStale) this.drawWhole(); // or it has been drawn in its new size
  }

  private request() {
    if (this.isStale) return;
    this.isStale = true;
    requestAnimationFrame(() => { if (this.isStale) this.draw(); });
  }

  setShown(scenes: RunScene[]) {
    this.shown = scenes;
    for (const scene of scenes) scene.compareWith(scenes.filter((other) => other !== scene));
    this.labels.replaceChildren(...scenes.map(({ flight: { index, data } }) =>
      make("div", { class: "pane" },
        this.scenes.length > 1 ? ofRun("chip", index, data.label) : null)));
    this.resize();
  }

  setLayers(layers: Layers) {
    for (const scene of this.scenes) scene.setLayers(layers);
    this.swipe.element.hidden = !this.scenes.some((scene) => scene.isSwiped());
    this.invalidate();
  }

  colour(by: Colouring) {
    for (const scene of this.scenes) scene.colour(by);
    this.invalidate();
  }

  buttons() {
    const button = (text: string, title: string, click: () => void) =>
      make("button", { class: "small", title, click }, text);
    return [button("Fit", "Show everything that is shown; a double click does it, too",
      () => this.frame()), this.pointing.button,
    button("Save PNG", "The 3D view as a picture file", () => this.save()),
    button("Full screen", "Escape leaves it", () => {
      if (document.fullscreenElement) void document.exitFullscreen();
      else void this.element.closest(".view")?.requestFullscreen();
    })];
  }

  onChange(listener: () => void) { this.controls.addEventListener("change", listener); }

  cameraState() { return [...this.camera.position.toArray(), ...this.controls.target.toArray()]; }

  setCamera(state: number[]) {
    this.frame(); // for the depths
    this.camera.position.fromArray(state, 0);
    this.controls.target.fromArray(state, 3);
    this.controls.update();
  }

  /** At a place of the scene's and what stands around it, from `back` of it. */
  lookAt(scene: RunScene, centre: three.Vector3, back: three.Vector3, radius_m: number) {
    const { toFirst, scale } = this.paneCameras.get(scene)!;
    const away_m = scale * Math.max(3.2 * radius_m, kAround * scene.flight.size_m);
    this.controls.target.copy(centre).applyMatrix4(toFirst);
    this.camera.position.copy(this.controls.target).addScaledVector(back, away_m);
    this.controls.update();
    this.invalidate();
  }

  private save() {
    this.drawWhole(); // in this very task, or the browser would have cleared the canvas
    this.canvas.toBlob((blob) => saveFile(blob, `${this.name}.png`));
  }

  private handleKey(event: KeyboardEvent) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { controls, canvas: { clientWidth, clientHeight } } = this;
    const pan_px = kPan * clientHeight;
    const actions: Record<string, () => void> = {
      enter: () => this.pickAt(clientWidth / 2, clientHeight / 2, kAim_px),
      0: () => this.frame(),
      a: () => controls.rotateLeft(kTurn_rad), d: () => controls.rotateLeft(-kTurn_rad),
      w: () => controls.rotateUp(kTurn_rad), s: () => controls.rotateUp(-kTurn_rad),
      "+": () => controls.dollyIn(1 / kZoom), "=": () => controls.dollyIn(1 / kZoom),
      "-": () => controls.dollyOut(1 / kZoom),
      j: () => controls.pan(pan_px, 0), l: () => controls.pan(-pan_px, 0),
      i: () => controls.pan(0, pan_px), k: () => controls.pan(0, -pan_px),
    };
    actions[event.key.toLowerCase()]?.();
  }

  private pickAt(x: number, y: number, near_px: number) {
    this.shown.forEach((scene, i) => {
      const { left, top, width, height } = this.pane(i);
      const [u, v] = [x - left, y - top];
      if (u < 0 || v < 0 || u >= width || v >= height) return;
      this.pointing.tell(pick(scene, this.cameraOf(scene), u, v, width, height, near_px), scene);
    });
  }

  /** Puts the camera where it sees all that is shown. */
  frame() {
    const outlines = this.shown.map((scene) =>
      scene.outline().applyMatrix4(this.paneCameras.get(scene)!.toFirst));
    const box = new three.Box3();
    for (const outline of outlines) box.union(new three.Box3().setFromBufferAttribute(outline));
    const centre = box.getCenter(new three.Vector3());
    const { width, height } = this.pane(0);
    const back = new three.Vector3(0.55, -0.8, 0.5).normalize();
    const away = Math.max(1, ...outlines.map((outline) =>
      nearestThatSees(outline, centre, back, this.camera.fov, height / width)));
    this.isFramed = true;
    // so that nothing is cut off, as far as anybody may go from such a picture
    const extent = this.scenes[0].flight.size_m;
    this.controls.maxDistance = 4 * Math.max(away, extent);
    this.camera.far = this.controls.maxDistance + 2 * extent;
    this.camera.near = this.camera.far / 2500;
    this.camera.updateProjectionMatrix();
    this.camera.position.copy(centre).addScaledVector(back, away);
    this.controls.target.copy(centre);
    this.controls.update();
    this.invalidate();
  }

  private cameraOf(scene: RunScene) { return this.paneCameras.get(scene)!.of(this.camera); }

  private sizeNow() { return `${this.element.clientWidth}x${this.element.clientHeight}`; }

  /** Where the pane of a run that is shown lies; where none is, the place of one. */
  private pane(i: number): Pane {
    const { offsetLeft: left, offsetTop: top, offsetWidth: width, offsetHeight: height } =
      (this.labels.children[i] ?? this.labels) as HTMLElement;
    return { left, top, width, height };
  }

  private resize() {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    const { length } = this.shown;
    this.labels.classList.toggle("column", this.isPrinted ? length === 2
      : clientWidth < kLeastPane_px * length);
    this.detail.change();
    const { width, height } = this.pane(0);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.isFramed) this.frame();
    const size = this.sizeNow();
    const isResized = this.size !== "" && this.size !== size;
    this.size = size;
    if (!isResized) this.request();
    // now, or a resized canvas would show one empty picture; paper does not wait for the whole one
    else if (this.isPrinted || matchMedia("print").matches) this.drawWhole();
    else this.draw();
  }

  private drawWhole() {
    this.detail.isWhole = true;
    this.draw();
  }

  private draw() {
    this.isStale = false;
    const { isWhole } = this.detail;
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    const begin = performance.now();
    const ratio = (this.isPrinted ? 2 : Math.min(2, devicePixelRatio)) * (isWhole ? 1 : kGistRatio);
    this.painter.fitCanvas(clientWidth, clientHeight, ratio);
    const perTan = 0.5 * ratio / Math.tan(three.MathUtils.degToRad(this.camera.fov) / 2);
    this.axes.show(this.camera);
    this.shown.forEach((scene, i) => {
      const pane = this.pane(i);
      this.painter.paint(scene,
        { camera: this.cameraOf(scene), pxPerTan: perTan * pane.height, isWhole }, pane,
        this.swipe.share);
    });
    this.painter.wait();
    this.detail.drawn(performance.now() - begin);
  }
}
